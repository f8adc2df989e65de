"""Every entry of docs/errata.md that has code is run, each by itself, against the installed Pinocchio."""

import ast
import re
from pathlib import Path
from typing import NamedTuple

import pytest

from ..pages import DOCS, cut, names_author_and_licence, run

ENGLISH, CHINESE = DOCS / "errata.md", DOCS / "errata.zh-CN.md"
HEADING = re.compile(r"^### (\d+)\. (49(?:\.\d+)*) (.+)$", re.MULTILINE)


class Entry(NamedTuple):
    number: int
    section: str
    title: str
    text: str
    blocks: list[str]


def read(path: Path) -> tuple[str, list[Entry]]:
    """The lines that all blocks start from, and the entries."""
    (preamble,), parts = cut(path, HEADING)
    return preamble, [Entry(int(h[1]), h[2], h[3], text, blocks) for h, text, blocks in parts]


PREAMBLE, ENTRIES = read(ENGLISH)
SHOWN = [entry for entry in ENTRIES if entry.blocks]


@pytest.mark.parametrize("entry", SHOWN, ids=[f"{e.number}: {e.section} {e.title}" for e in SHOWN])
def test_what_the_entry_calls_true_is_true(entry: Entry) -> None:
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the chapter is judged by it")
    run(ENGLISH, [PREAMBLE, *entry.blocks])


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
    assert names_author_and_licence(ENGLISH)
    assert names_author_and_licence(CHINESE)
