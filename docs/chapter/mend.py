"""Make a patch for the chapter from corrections.toml, for the author to take.

usage:  python docs/chapter/mend.py CHAPTER.md > chapter.patch     and then  patch CHAPTER.md chapter.patch

CHAPTER.md is a copy of Chapter 49 in UTF-8; the chapter itself is not part of this repository. What was not found in
that copy is reported on stderr, and the exit status is 1.
"""

import argparse
import difflib
import sys
import tomllib
from pathlib import Path
from typing import NamedTuple

CORRECTIONS = Path(__file__).with_name("corrections.toml")


class Correction(NamedTuple):
    """A passage of the chapter and what to write instead; `entry` is the title in docs/errata.md that says why."""

    entry: str
    find: str
    replace: str
    times: int = 1


def corrections() -> list[Correction]:
    """Return all corrections, in the order of the chapter."""
    found = tomllib.loads(CORRECTIONS.read_text(encoding="utf-8"))["correction"]
    return [Correction(**each) for each in found]


def mended(chapter: str) -> tuple[str, list[Correction]]:
    """Return the corrected chapter, and the corrections whose passage is not there as often as expected."""
    missed = []
    for correction in corrections():
        if chapter.count(correction.find) != correction.times:
            missed.append(correction)
        else:
            chapter = chapter.replace(correction.find, correction.replace)
    return chapter, missed


def main(arguments: list[str] | None = None) -> int:
    """Write the patch to stdout."""
    parser = argparse.ArgumentParser(description="Make a patch for the chapter from corrections.toml.")
    parser.add_argument("chapter", type=Path, help="a copy of the chapter")
    path = parser.parse_args(arguments).chapter
    old = path.read_text(encoding="utf-8")
    new, missed = mended(old)
    lines = (text.splitlines(keepends=True) for text in (old, new))
    for line in difflib.unified_diff(*lines, f"a/{path.name}", f"b/{path.name}", n=1):
        sys.stdout.write(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n")
    for correction in missed:
        print(f"not found {correction.times} time(s): {correction.find!r} ({correction.entry})", file=sys.stderr)
    return int(bool(missed))


if __name__ == "__main__":
    sys.exit(main())
