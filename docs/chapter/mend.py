"""Make ten patches for the chapter from corrections.toml, for the author to take one by one.

usage:  python docs/chapter/mend.py CHAPTER.md PATCHES     writes PATCHES/01-….patch to PATCHES/10-….patch
        for patch in PATCHES/*.patch; do patch CHAPTER.md "$patch"; done

CHAPTER.md is a copy of Chapter 49 in UTF-8, its Markdown source or the text of the page; the chapter itself is not part
of this repository. The patches are in order of the damage that they mend. Each is made for a chapter that has those
before it. What was not found in that copy is reported on stderr, and the exit status is 1.
"""

import argparse
import difflib
import re
import sys
import tomllib
from pathlib import Path
from typing import NamedTuple

CORRECTIONS = Path(__file__).with_name("corrections.toml")

CODE = re.compile(r"`([^`\n]+)`")
BETWEEN = r"(?:\n[ \t]*>|\s|`|\*\*)*"
"""What may stand between two characters of a passage: a line end, indentation, the marks of quotes, code and bold."""


class Correction(NamedTuple):
    """A passage of the chapter and what to write instead; `entry` is the title in docs/errata.md that says why."""

    entry: str
    find: str
    replace: str
    times: int = 1


class Patch(NamedTuple):
    """What belongs together: `entries` are the titles in docs/errata.md, `shows` says how one sees the damage."""

    name: str
    title: str
    shows: str
    entries: list[str]


def corrections() -> list[Correction]:
    """Return all corrections, in the order of the chapter."""
    found = tomllib.loads(CORRECTIONS.read_text(encoding="utf-8"))["correction"]
    return [Correction(**each) for each in found]


def patches() -> list[Patch]:
    """Return the ten patches, the worst damage first."""
    found = tomllib.loads(CORRECTIONS.read_text(encoding="utf-8"))["patch"]
    return [Patch(**each) for each in found]


def pattern(passage: str) -> re.Pattern[str]:
    """Return what finds a passage, however it is indented, quoted, wrapped, and marked as code, bold or formula."""
    letters = re.findall(r"\\[()]|\S", passage.replace("**", ""))
    formula = {r"\(": r"(?:\\\(|\$)", r"\)": r"(?:\\\)|\$)"}
    return re.compile(BETWEEN.join(formula.get(letter, re.escape(letter)) for letter in letters))


def whole(chapter: str, found: re.Match[str]) -> tuple[int, int]:
    """Return where a passage begins and ends with the marks of code and of bold that it would leave without a twin."""
    start, end = found.span()
    for mark in ("`", "**"):
        if chapter[start:end].count(mark) % 2:
            if chapter[:start].endswith(mark):
                start -= len(mark)
            elif chapter.startswith(mark, end):
                end += len(mark)
    return start, end


def dressed(text: str, chapter: str, start: int, end: int) -> str:
    """Return a replacement as the chapter writes: its formulas, its marks of code, its indentation."""
    if r"\(" not in chapter:
        text = re.sub(r"\\[()]", "$", text)
    for code in sorted(set(CODE.findall(chapter[start:end])), key=len, reverse=True):
        text = re.sub(rf"(?<![\w.`]){re.escape(code)}(?![\w.`])", f"`{code}`", text, flags=re.ASCII)
    line = chapter[chapter.rfind("\n", 0, start) + 1 : start]
    indentation = line[: len(line) - len(line.lstrip(" \t>"))]
    return text.replace("\n", f"{line_end(chapter)}{indentation}")


def line_end(chapter: str) -> str:
    """Return how the lines of a chapter end."""
    return "\r\n" if "\r\n" in chapter else "\n"


def mend(chapter: str, wanted: list[Correction]) -> tuple[str, list[Correction]]:
    """Return the corrected chapter, and the corrections whose passage is not there as often as expected."""
    missed = []
    for correction in wanted:
        places = [whole(chapter, found) for found in pattern(correction.find).finditer(chapter)]
        if len(places) != correction.times:
            missed.append(correction)
            continue
        for start, end in reversed(places):
            chapter = chapter[:start] + dressed(correction.replace, chapter, start, end) + chapter[end:]
    return chapter, missed


def difference(old: str, new: str, name: str) -> str:
    """Return what turns one text into the other, as a unified diff."""
    lines = (re.findall(r"[^\n]*\n|[^\n]+", text) for text in (old, new))  # a form feed ends no line of a patch
    found = difflib.unified_diff(*lines, f"a/{name}", f"b/{name}", n=1)
    return "".join(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in found)


def main(arguments: list[str] | None = None) -> int:
    """Write the patches."""
    parser = argparse.ArgumentParser(description="Make ten patches for the chapter from corrections.toml.")
    parser.add_argument("chapter", type=Path, help="a copy of the chapter")
    parser.add_argument("patches", type=Path, help="the folder to write them into")
    asked = parser.parse_args(arguments)
    asked.patches.mkdir(parents=True, exist_ok=True)
    text, missed = asked.chapter.read_bytes().decode("utf-8"), []  # with its line ends
    for k, patch in enumerate(patches(), 1):
        mended, not_there = mend(text, [each for each in corrections() if each.entry in patch.entries])
        head = f"{patch.title}\n\n{patch.shows}\n\n"
        body = head + difference(text, mended, asked.chapter.name)
        (asked.patches / f"{k:02}-{patch.name}.patch").write_bytes(body.encode("utf-8"))
        text, missed = mended, missed + not_there
    for correction in missed:
        print(f"not found {correction.times} time(s): {correction.find!r} ({correction.entry})", file=sys.stderr)
    return int(bool(missed))


if __name__ == "__main__":
    sys.exit(main())
