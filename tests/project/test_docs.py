"""docs/conventions.md, map.md and traps.md: one code in both languages, no stale row, every trap still there.

What conventions.md says of the libraries is asked in test_conventions.py.
"""

import ast
import importlib
import re
from functools import reduce
from pathlib import Path
from typing import Any, NamedTuple

import pytest

import twistwrench as tw
from twistwrench.tracing.anchors import anchors

from ..pages import DOCS, Part, names_author_and_licence, numbered, page, run

PAGES = ("conventions", "map", "traps")
LONGEST_BLOCK = {"conventions": 20, "traps": 10}


# ---------------------------------------------------------------- both languages


@pytest.mark.parametrize("name", PAGES)
def test_both_languages_name_the_author_and_the_licence(name: str) -> None:
    assert names_author_and_licence(page(name))
    assert names_author_and_licence(page(name, ".zh-CN"))


@pytest.mark.parametrize("name", LONGEST_BLOCK)
def test_both_languages_have_the_same_entries_and_the_same_code(name: str) -> None:
    (first, parts), (erste, teile) = numbered(name), numbered(name, ".zh-CN")
    assert [b.strip("\n") for b in first] == [b.strip("\n") for b in erste]
    code, twin = ([(p.heading[1], [b.strip("\n") for b in p.blocks]) for p in side] for side in (parts, teile))
    assert code == twin


def tables(path: Path) -> list[list[str]]:
    """The cells of every row of every table."""
    lines = re.sub(r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL).splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")]


@pytest.mark.parametrize("name", PAGES)
def test_the_tables_of_both_languages_have_the_same_cells_and_the_same_code(name: str) -> None:
    rows, twin = tables(page(name)), tables(page(name, ".zh-CN"))
    assert [len(row) for row in rows] == [len(row) for row in twin]
    for row, other in zip(rows, twin, strict=True):
        code, its = ([sorted(re.findall(r"`[^`]+`", cell)) for cell in side] for side in (row, other))
        assert code == its, row


@pytest.mark.parametrize("name", LONGEST_BLOCK)
def test_entries_are_numbered_and_each_has_one_short_block_that_asserts(name: str) -> None:
    _, parts = numbered(name)
    assert [int(part.heading[1]) for part in parts] == list(range(1, len(parts) + 1))
    for part in parts:
        (block,) = part.blocks
        lines = block.strip("\n").splitlines()
        assert 3 <= len(lines) <= LONGEST_BLOCK[name], part.heading[0]
        assert max(map(len, lines)) <= 120, part.heading[0]
        assert any(isinstance(node, ast.Assert) for node in ast.walk(ast.parse(block))), part.heading[0]


@pytest.mark.parametrize("path", sorted(DOCS.glob("*.md")), ids=lambda path: path.name)
def test_links_between_pages_lead_somewhere(path: Path) -> None:
    targets = re.findall(r"\]\((?!https?:)([^)#]+)", path.read_text(encoding="utf-8"))
    assert targets
    assert [target for target in targets if not (DOCS / target).exists()] == []


# ---------------------------------------------------------------- map.md

SOURCE = DOCS.parent / "src" / "twistwrench"


class Row(NamedTuple):
    what: str
    formula: str
    call: str
    file: str
    line: str
    pinocchio: str


ROWS = [Row(*(cell.strip("`") for cell in row)) for row in tables(page("map")) if row[4].startswith("`")]


def stale(row: Row) -> list[str]:
    """What a row says of this package that is not so."""
    wrong, (first, *more) = [], row.call.split(".")
    if any(name.startswith("_") and not name.endswith("__") for name in (first, *more)):
        wrong.append(f"{row.call} is private")
    try:
        start = getattr(tw, first) if first in tw.__all__ else importlib.import_module(f"twistwrench.{first}")
        reduce(getattr, more, start)
    except (AttributeError, ImportError):
        wrong.append(f"no {row.call} in twistwrench")
    file = SOURCE / row.file
    if not file.is_file():
        wrong.append(f"no file {row.file}")
    elif row.line in anchors():
        wrong += [] if anchors()[row.line].file == row.file else [f"no such line in {row.file}: {row.line}"]
    elif row.line not in [line.strip() for line in file.read_text(encoding="utf-8").splitlines()]:
        wrong.append(f"no such line in {row.file}: {row.line}")
    return wrong


def unknown_to_pinocchio(row: Row, pin: Any) -> list[str]:
    first, *more = row.pinocchio.split(".")
    try:
        reduce(getattr, more, {"pin": pin, "data": pin.Data, "model": pin.Model}[first])
    except AttributeError:
        return [row.pinocchio]
    return []


def test_every_row_of_the_map_holds() -> None:
    assert len(ROWS) >= 123  # no table is overlooked
    assert [(row.what, wrong) for row in ROWS if (wrong := stale(row))] == []


def test_pinocchio_has_every_name_of_the_map() -> None:
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its names are not checked")
    named = [row for row in ROWS if row.pinocchio]
    assert len(named) > 80
    assert [unknown for row in named for unknown in unknown_to_pinocchio(row, pin)] == []


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"call": "rneaa"}, "no rneaa"),
        ({"call": "SpatialInertia.weight"}, "no SpatialInertia.weight"),
        ({"call": "spatial._vector"}, "private"),
        ({"file": "inverse.py"}, "no file inverse.py"),
        ({"file": "algorithms/aba.py"}, "no such line in algorithms/aba.py"),
        ({"line": "49.6 taus"}, "no such line in algorithms/rnea.py"),
    ],
)
def test_a_stale_row_is_noticed(change: dict[str, str], said: str) -> None:
    row = next(row for row in ROWS if row.line == "49.6 tau")
    assert stale(row) == []
    (wrong,) = stale(row._replace(**change))
    assert said in wrong


def test_a_name_that_pinocchio_does_not_have_is_noticed() -> None:
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its names are not checked")
    for name in ("pin.rneaa", "data.om", "model.parent", "pin.SE3.actions"):
        assert unknown_to_pinocchio(ROWS[0]._replace(pinocchio=name), pin) == [name]


def test_every_public_name_stands_on_the_map() -> None:
    text = page("map").read_text(encoding="utf-8")
    named = {name for code in re.findall(r"`([\w.]+)`", text) for name in code.split(".")}
    assert [name for name in tw.__all__ if name not in named] == []
    assert [name for name in tw.bridge.__all__ if name.startswith("to_") and name not in named] == []


def test_both_languages_map_the_same_rows() -> None:
    def numbers(path: Path) -> list[list[str]]:
        return [row[1:] for row in tables(path) if len(row) == 6 and row[2].startswith("`")]

    assert numbers(page("map")) == numbers(page("map", ".zh-CN"))
    assert len(numbers(page("map"))) == len(ROWS)


# ---------------------------------------------------------------- traps.md

START, TRAPS = numbered("traps")
ASK_PINOCCHIO = {"pin", "model", "data"}


@pytest.mark.parametrize("trap", TRAPS, ids=[f"{t.heading[1]}: {t.heading[2]}" for t in TRAPS])
def test_the_trap_is_there_as_the_page_shows_it(trap: Part, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In a folder of its own, for those that write a file."""
    monkeypatch.chdir(tmp_path)
    (block,), (ours, pinocchios) = trap.blocks, START
    if {node.id for node in ast.walk(ast.parse(block)) if isinstance(node, ast.Name)} & ASK_PINOCCHIO:
        pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its traps are not shown")
        run(page("traps"), [ours, pinocchios, block])
    else:
        run(page("traps"), [ours, block])
