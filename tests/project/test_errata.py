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

    @property
    def severity(self) -> str:
        found = re.search(r"\*\*(?:Severity\.\*\* |程度\*\*：)([^.。]+)", self.text)
        return found[1].lower() if found else ""


def read(path: Path) -> tuple[str, list[Entry]]:
    """The lines that all blocks start from, and the entries."""
    (preamble,), parts = cut(path, HEADING)
    return preamble, [Entry(int(h[1]), h[2], h[3], text, blocks) for h, text, blocks in parts]


def slug(title: str) -> str:
    """The anchor that code hosts and the site give a heading."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


PREAMBLE, ENTRIES = read(ENGLISH)
SEVERITIES = (["wrong number", "crash", "misleading", "history"], ["数值错误", "报错中断", "误导", "史实"])
_TEXT = ENGLISH.read_text(encoding="utf-8")
_SOURCES, _APPENDIX, _LATER = (
    int(HEADING.search(_TEXT, _TEXT.index(f"\n## {name}"))[1])  # type: ignore[index]
    for name in ("Not shown by code", "Appendix", "Found later")
)
PARTS = {
    "main": ENTRIES[: _SOURCES - 1],
    "sources": ENTRIES[_SOURCES - 1 : _APPENDIX - 1],
    "appendix": ENTRIES[_APPENDIX - 1 : _LATER - 1],
    "later": ENTRIES[_LATER - 1 :],
}
SHOWN = [entry for entry in ENTRIES if entry.blocks]


@pytest.mark.parametrize(
    "entry",
    [
        pytest.param(e, id=f"{e.number}: {e.section} {e.title}", marks=[pytest.mark.slow] * ("seconds(" in e.blocks[0]))
        for e in SHOWN
    ],
)
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


def test_entries_are_numbered_and_each_part_is_in_the_order_of_the_chapter() -> None:
    assert [entry.number for entry in ENTRIES] == list(range(1, len(ENTRIES) + 1))
    for part in PARTS.values():
        sections = [[int(k) for k in e.section.split(".")[:2]] for e in part if e.blocks]
        assert sections == sorted(sections)


def test_entries_without_code_come_last_in_their_part_and_name_a_year_or_a_source() -> None:
    assert [bool(e.blocks) for e in PARTS["main"]] == [True] * len(PARTS["main"])
    assert not any(e.blocks for e in PARTS["sources"])
    assert sum(not entry.blocks for entry in ENTRIES) == 10  # "all but ten"
    for entry in ENTRIES:
        true = entry.text.partition("**What is true.**")[2]
        assert entry.blocks or re.search(r"\b1[789]\d\d\b|\b20\d\d\b|https://", true), entry.title


def test_the_table_of_severities_lists_every_entry_once_in_both_languages() -> None:
    tables = [path.read_text(encoding="utf-8").partition("\n## 49.1")[0] for path in (ENGLISH, CHINESE)]
    for head, entries, names in zip(tables, (ENTRIES, read(CHINESE)[1]), SEVERITIES, strict=True):
        for name in names:
            row = next(line for line in head.splitlines() if line.startswith(f"| {name} |"))
            listed = [int(k) for k in re.findall(r"\d+", row.rsplit("|", 2)[1])]
            assert listed == [entry.number for entry in entries if entry.severity == name]
    assert {entry.severity for entry in ENTRIES} == set(SEVERITIES[0])
    translated = dict(zip(SEVERITIES[1], SEVERITIES[0], strict=True))
    assert [translated[e.severity] for e in read(CHINESE)[1]] == [e.severity for e in ENTRIES]


def test_the_ten_at_the_top_are_entries_of_the_page() -> None:
    for path in (ENGLISH, CHINESE):
        text = path.read_text(encoding="utf-8")
        anchors = {slug(h[0].removeprefix("### ")) for h in HEADING.finditer(text)}
        links = re.findall(r"\]\(#([^)]+)\)", text.partition("\n## 49.1")[0])
        assert len(links) == 10
        assert set(links) <= anchors


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
