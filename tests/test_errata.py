"""Every entry of docs/errata.md that has code is run, each by itself, against the installed Pinocchio."""

import ast
import re
from pathlib import Path
from typing import Any, NamedTuple

import pytest

DOCS = Path(__file__).resolve().parents[1] / "docs"
ENGLISH, CHINESE = DOCS / "errata.md", DOCS / "errata.zh-CN.md"
HEADING = re.compile(r"^### (\d+)\. (49(?:\.\d+)*) (.+)$", re.MULTILINE)
FENCE = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class Entry(NamedTuple):
    number: int
    section: str
    title: str
    text: str
    blocks: list[str]  # each behind as many newlines as stand before it on the page, so that a failure names its line


def blocks(page: str, start: int, end: int) -> list[str]:
    return ["\n" * page.count("\n", 0, m.start(1)) + m[1] for m in FENCE.finditer(page, start, end)]


def read(path: Path) -> tuple[str, list[Entry]]:
    """The lines that all blocks start from, and the entries."""
    page = path.read_text(encoding="utf-8")
    headings = list(HEADING.finditer(page))
    ends = [*(heading.start() for heading in headings[1:]), len(page)]
    (preamble,) = blocks(page, 0, headings[0].start())
    return preamble, [
        Entry(int(h[1]), h[2], h[3], page[h.end() : end], blocks(page, h.end(), end))
        for h, end in zip(headings, ends, strict=True)
    ]


PREAMBLE, ENTRIES = read(ENGLISH)
SHOWN = [entry for entry in ENTRIES if entry.blocks]


@pytest.mark.parametrize("entry", SHOWN, ids=[f"{e.number}: {e.section} {e.title}" for e in SHOWN])
def test_what_the_entry_calls_true_is_true(entry: Entry) -> None:
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the chapter is judged by it")
    namespace: dict[str, Any] = {"__name__": f"errata_{entry.number}"}
    for source in (PREAMBLE, *entry.blocks):
        exec(compile(source, str(ENGLISH), "exec"), namespace)


@pytest.mark.parametrize("entry", SHOWN, ids=lambda entry: str(entry.number))
def test_each_block_is_short_and_asserts_something(entry: Entry) -> None:
    (block,) = entry.blocks
    lines = block.strip("\n").splitlines()
    assert 3 <= len(lines) <= 13
    assert max(map(len, lines)) <= 120
    assert any(isinstance(node, ast.Assert) for node in ast.walk(ast.parse(block)))


def test_entries_are_numbered_in_the_order_of_the_chapter() -> None:
    assert [entry.number for entry in ENTRIES] == list(range(1, len(ENTRIES) + 1))
    sections = [[int(part) for part in entry.section.split(".")[:2]] for entry in SHOWN]
    assert sections == sorted(sections)


def test_entries_without_code_come_last_and_name_a_year_or_a_source() -> None:
    assert ENTRIES[: len(SHOWN)] == SHOWN
    for entry in ENTRIES[len(SHOWN) :]:
        true = entry.text.partition("**What is true.**")[2]
        assert re.search(r"\b1[789]\d\d\b|\b20\d\d\b|https://", true), entry.title


def test_each_entry_says_what_the_chapter_says_and_what_is_true() -> None:
    marks = {ENGLISH: ("**The chapter says.**", "**What is true.**"), CHINESE: ("**本章说**", "**实际上**")}
    for path, (says, true) in marks.items():
        for entry in read(path)[1]:
            assert entry.text.count(says) == entry.text.count(true) == 1, f"{path.name}, entry {entry.number}"


def test_both_languages_have_the_same_entries_and_the_same_code() -> None:
    preamble, entries = read(CHINESE)
    assert preamble.strip("\n") == PREAMBLE.strip("\n")

    def skeleton(entry: Entry) -> tuple[int, str, list[str]]:
        return entry.number, entry.section, [block.strip("\n") for block in entry.blocks]

    assert [skeleton(entry) for entry in entries] == [skeleton(entry) for entry in ENTRIES]


def test_both_pages_name_the_author_and_the_licence() -> None:
    for path in (ENGLISH, CHINESE):
        head = path.read_text(encoding="utf-8")[:1000]
        assert "Pengfei Guo" in head
        assert "CC BY 4.0" in head
