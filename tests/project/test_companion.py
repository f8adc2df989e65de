"""docs/companion.md, mirror.md, glossary.md: the chapter's goals, sheet, faults and plan, its headings, its words."""

import json
import re
import runpy
from functools import reduce
from pathlib import Path

import pytest

from twistwrench.exercises.chapter import COURSE

from ..pages import DOCS, FENCE, names_author_and_licence, page, run
from .test_docs import tables

NAMES = ("companion", "mirror", "glossary")
LANGUAGES = ("", ".zh-CN")
LINK = re.compile(r"\]\((?!https?:)([^)#]*)(?:#([^)]*))?\)")


def slug(title: str) -> str:
    """The anchor that code hosts and the site give a heading."""
    return re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")


def headings(path: Path) -> set[str]:
    """The anchors of a page or of a notebook."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        cells = json.loads(text)["cells"]
        text = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    text = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    return {slug(line) for line in re.findall(r"^#{1,4} (.+)$", text, re.MULTILINE)}


@pytest.mark.parametrize("path", sorted(DOCS.glob("*.md")), ids=lambda path: path.name)
def test_every_link_leads_to_a_file_and_to_a_heading_of_it(path: Path) -> None:
    links = LINK.findall(path.read_text(encoding="utf-8"))
    assert links
    for target, anchor in links:
        file = (DOCS / target).resolve() if target else path
        assert file.exists(), target
        if anchor:
            assert anchor in headings(file), (target, anchor)


@pytest.mark.parametrize("name", NAMES)
def test_both_languages_name_the_author_and_lead_to_the_same_places(name: str) -> None:
    assert names_author_and_licence(page(name))
    assert names_author_and_licence(page(name, ".zh-CN"))
    targets = [[target for target, _ in LINK.findall(page(name, x).read_text(encoding="utf-8"))] for x in LANGUAGES]
    english, chinese = ([t.replace(".zh-CN", "").replace("/zh/", "/en/") for t in side] for side in targets)
    assert english == chinese
    assert [len(row) for row in tables(page(name))] == [len(row) for row in tables(page(name, ".zh-CN"))]


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_mirror_has_all_headings_of_the_chapter_and_a_place_for_each(language: str) -> None:
    rows = [row for row in tables(page("mirror", language)) if row[0].isdigit()]
    assert [int(row[0]) for row in rows] == list(range(1, 99))
    assert [row for row in rows if not LINK.search(row[3])] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_fourteen_days_have_every_exercise(language: str) -> None:
    rows = [row for row in tables(page("companion", language)) if row[0].isdigit()]
    assert [int(row[0]) for row in rows] == list(range(1, 15))
    planned = " ".join(row[3] for row in rows).replace("49.0.1–5", " ".join(f"49.0.{k}" for k in range(1, 6)))
    ids = [exercise.id for section in COURSE.sections for exercise in COURSE.of_section(section)]
    assert [i for i in ids if not re.search(rf"{re.escape(i)}(?!\d)", planned)] == []


def test_the_cache_of_the_second_stage_runs_and_is_the_same_in_both_languages() -> None:
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the cache wraps it")
    blocks = [FENCE.findall(page("companion", language).read_text(encoding="utf-8")) for language in LANGUAGES]
    assert blocks[0] == blocks[1]
    run(page("companion"), blocks[0])


@pytest.mark.slow
def test_the_cost_grows_as_the_table_has_it() -> None:
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the complexity is measured with it")
    growth = runpy.run_path(str(DOCS / "chapter" / "complexity.py"), run_name="complexity")["growth"]
    chain = growth(40, 160, legs=False)
    assert (chain[[0, 1, 4]] < 1.4).all()  # measured 0.97, 0.96, 0.93; other programs may run meanwhile
    assert chain[2] > 1.4  # 1.9
    assert chain[3] > 1.9  # 2.7
    assert growth(40, 160, legs=True)[3] < 2.2  # 1.6: the zeros of the tree stay zeros


def test_the_glossary_is_one_table_in_both_languages_and_each_word_stands_once() -> None:
    rows, twin = (tables(page("glossary", language))[1:] for language in LANGUAGES)
    assert rows == twin
    for column in (0, 1):
        words = [row[column] for row in rows]
        assert len(set(words)) == len(words)


def test_pinocchio_has_every_name_of_the_glossary() -> None:
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its names are not checked")
    starts = {"data": pin.Data, "model": pin.Model}
    named = [name for row in tables(page("glossary"))[1:] for name in re.findall(r"`([\w.]+)`", row[4])]
    assert len(named) > 40
    unknown = []
    for name in named:
        first, _, rest = name.partition(".")
        try:
            reduce(getattr, rest.split(".") if first in starts else name.split("."), starts.get(first, pin))
        except AttributeError:
            try:
                getattr(pin.ContactType, name)
            except AttributeError:
                unknown.append(name)
    assert unknown == []
