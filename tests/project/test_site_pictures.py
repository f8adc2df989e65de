"""The pictures of the site: what they are called, what they show, and the boxes and sliders that go with them."""

import base64
import hashlib
import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "docs"), str(ROOT / "docs" / "pictures")]

from website import browser, digits, folds, handled, orders, pages, sketches, steps  # noqa: E402

RECORDS = json.loads((ROOT / "benchmarks" / "results" / "trade_go2.json").read_text(encoding="utf-8"))["records"]


@pytest.fixture
def figures():
    pytest.importorskip("myst_nb", reason="MyST-NB is not installed: the gallery is not checked")
    from website import figures

    return figures


def notebook(*cells):
    """Return a notebook: text is Markdown, a pair is code and the picture that it draws."""
    nbformat = pytest.importorskip("nbformat", reason="nbformat is not installed: the notebooks are not checked")
    made = []
    for cell in cells:
        if isinstance(cell, str):
            made.append(nbformat.v4.new_markdown_cell(cell))
        else:
            shown = [nbformat.v4.new_output("display_data", {"image/png": base64.b64encode(cell[1]).decode()})]
            made.append(nbformat.v4.new_code_cell(cell[0], outputs=shown if cell[1] else []))
    return nbformat.v4.new_notebook(cells=made)


# ---------------------------------------------------------------- pictures of the notebooks


@pytest.mark.parametrize(
    ("heading", "told"), [("The map", "The map. "), ("What holds it up?", "What holds it up? "), ("对照表", "对照表。")]
)
def test_a_heading_ends_as_a_sentence(figures, heading, told):
    assert figures._sentence(heading) == told


def test_a_picture_is_told_by_its_heading_and_the_words_before_it(figures):
    shown = notebook(
        "# A\n\nFirst.",
        "## The **screw** as $\\boldsymbol\\omega \\to 0$\n\nAlong $\\dot q$, [a leg](b.md).\n\n$$x$$\n\n"
        "**Exercise 49.2.2.** Do.",
        ("draw()", b"a"),
        ("1 + 1", b""),
        "中文。",
        ("draw()", b"b"),
    )
    first, second = figures.figures(shown)
    assert first.says == "The screw as ω→0. Along q̇, a leg."
    assert second.says == "The screw as ω→0. 中文。"
    assert first.file == f"{hashlib.sha256(b'a').hexdigest()}.png"
    cells = figures.with_words(shown).cells
    assert [c.metadata.get("mystnb", {}).get("image", {}).get("alt") for c in cells] == [
        None, None, first.says, None, None, second.says,
    ]  # fmt: skip


def test_words_for_a_picture_are_whole_sentences_where_there_are_any(figures):
    long = "One sentence that is quite long, and says what the picture shows to those who cannot see it. " * 4
    (figure,) = figures.figures(notebook(f"# A\n\n{long}", ("draw()", b"a")))
    assert len(figure.says) <= figures.LONGEST
    assert figure.says.endswith("see it.")


def test_a_picture_of_a_page_has_words_and_a_program_in_both_languages(figures, tmp_path):
    doors = {language: [*figures._of_pages(tmp_path, language)] for language in pages.LANGUAGES}
    assert len(doors["en"]) == len(doors["zh"]) > 20
    for english, chinese in zip(doors["en"], doors["zh"], strict=True):
        programs = [re.search(r"\[`([^`]+\.py)`\]", door)[1] for door in (english, chinese)]
        assert programs[0] == programs[1]
        assert (ROOT / programs[0]).exists()
        assert re.search("[\u4e00-\u9fff]", chinese.partition("](")[0])
    shown = {file for door in doors["en"] for file in re.findall(r"pictures/(\w+)\.png", door)}
    text = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "docs").glob("*.md"))
    assert all(f"{path.stem}.png" in text for path in (ROOT / "docs" / "pictures").glob("*.png"))
    assert shown >= {"trade_go2", "errata_25", "templates", "mass_matrix_fill_in"}


def test_a_draft_takes_the_last_result_of_the_same_code(tmp_path):
    pytest.importorskip("myst_parser", reason="MyST is not installed: the site is not checked")
    nbformat = pytest.importorskip("nbformat", reason="nbformat is not installed: the notebooks are not checked")
    from website import notebooks

    ours = tmp_path / "a.ipynb"
    nbformat.write(notebook("# A", ("1 + 1", b"")), ours)
    assert notebooks.run_before(ours, tmp_path / "cache") is None
    (tmp_path / "cache").mkdir()
    for name, code in (("a-1", "1 + 1"), ("a-2", "1 + 2"), ("b-1", "1 + 1")):
        nbformat.write(notebook((code, b"")), tmp_path / "cache" / f"{name}.ipynb")
    assert notebooks.run_before(ours, tmp_path / "cache").stem == "a-1"


# ---------------------------------------------------------------- drawings


def test_the_drawings_of_orders_are_those_of_the_package_and_of_pinocchio():
    drawn, go2 = orders.orders(), tw.load("go2")
    assert list(drawn) == ["Here", "The chapter", "The book", "Pinocchio", "MuJoCo", "Drake"]
    at = go2.neutral()[:7].tolist().index(1.0)  # the real part of a quaternion that turns by nothing
    assert drawn["Here"].q.index("qw") == drawn["Pinocchio"].q.index("qw") == at
    v = np.r_[[1.0, 1, 1], np.zeros(go2.nv - 3)]  # ω
    assert drawn["Here"].v == ["ω", "v"]
    assert (
        drawn["Pinocchio"].v == ["v", "ω"] == ["ω" if x else "v" for x in tw.bridge.to_pinocchio_tangent(go2, v)[:6:3]]
    )
    assert {name for name, order in drawn.items() if order.axes["v"] == "world"} == {"MuJoCo", "Drake"}


@pytest.mark.parametrize("language", pages.LANGUAGES)
def test_every_library_has_a_drawing_and_every_algorithm_a_sketch(language):
    html = orders.with_drawings("`<!-- drawings -->`\n\n<!-- drawings -->\n\nb", language)
    assert html.count("<svg") == html.count("aria-label=") == len(orders.orders())
    for name in sketches.SAYS:
        drawn = sketches.sketch(name, language)
        assert bool(re.search("[\u4e00-\u9fff]", drawn)) == (language == "zh")
        assert len(re.findall("<path", drawn)) > 10


def test_the_film_has_its_formula_and_its_line():
    data = handled.film()
    assert data["lines"] == ["V[i] = X[i] @ V[p] + vJ", "F[p] = F[p] + X[i].mT @ F[i]"]
    assert [re.sub("<[^>]*>", "", formulas[13]) for formulas in data["formulas"]] == [
        "V13 = X13 V12 + S13 q̇13",
        "F12 ← F12 + X13T F13",
    ]


def test_the_front_page_ends_with_the_whole_weight_or_with_nothing():
    walk = handled.walk()
    held, carried = (tw.trace(walk.model, "rnea", walk.q, walk.v, walk.a, f_ext=f) for f in (None, walk.ground))
    assert held["F"][1][5] > 0.9 * 9.81 * walk.model.mass
    assert np.abs(carried["F"][1]).max() < 1e-9


@pytest.mark.parametrize("call", steps.STEPPED)
def test_every_algorithm_begins_with_its_stepper(call):
    page = steps.step_through({"call": call}, "zh")
    assert page.startswith('```{raw} html\n<div class="tw-stepper" lang="zh-CN"')
    assert '"playing":true' in page


def test_the_pictures_of_errata_show_what_their_entries_say():
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: the pictures are not drawn")
    import errata

    terms = tw.rnea_terms(errata.GO2, errata.STAND, errata.REST, errata.REST)
    tree = errata.tree_terms(errata.GO2, errata.STAND)
    np.testing.assert_allclose(errata.inward(tree, terms.B, "Xᵀ"), np.stack(terms.F), atol=1e-12)
    assert round(errata.inward(tree, terms.B, "X*")[1, 5]) == 89
    assert round(float(np.linalg.norm(terms.B[1][3:]))) == 71
    titles = [ax.get_title() for ax in errata.standing_still().axes]
    assert ["156.74 N" in titles[0], "157.79 N of 157.79 N, 0.0" in titles[1]] == [True, True]


# ---------------------------------------------------------------- lists and sliders


def test_only_what_has_no_sections_in_it_is_folded():
    inner = '<section id="b">\n<span id="c"></span><h3>B</h3><p>b</p></section>'
    page = folds.folded(f'<section id="a"><h2>A</h2>{inner}</section>', 3)
    assert page.count("<details") == 1
    assert page.startswith('<section id="a"><h2>A</h2><section id="b">')
    assert folds.folded(f'<section id="a"><h2>A</h2>{inner}</section>', 2).count("<details") == 0


@pytest.fixture(scope="module")
def chromium():
    """Yield a browser for all tests of this file: a start takes more than most of them."""
    if reason := browser.missing():
        pytest.skip(reason)
    from playwright.sync_api import sync_playwright

    with sync_playwright() as play:
        chromium = play.chromium.launch(executable_path=browser.chromium(), args=["--no-sandbox"])
        yield chromium
        chromium.close()


@pytest.fixture
def opened(tmp_path, chromium):
    """Yield a function that opens HTML, with the site's script, in a browser."""
    script, errors = (ROOT / "docs/website/static/site.js").read_text(encoding="utf-8"), []
    context = chromium.new_context(offline=True)
    page = context.new_page()
    page.on("pageerror", lambda error: errors.append(str(error)))

    def show(html, place=""):
        (tmp_path / "a.html").write_text(f"<!doctype html><meta charset=utf-8><script>{script}</script>{html}", "utf-8")
        page.goto((tmp_path / "a.html").as_uri() + place)
        return page

    yield show
    context.close()
    assert not errors


def test_the_box_finds_entries_and_a_link_opens_its_own(opened):
    entries = "".join(f'<section id="e{k}"><h3>{k}</h3><p>{w}</p></section>' for k, w in enumerate(("one two", "two")))
    body = (
        f'<section id="t"><h1>T</h1>{folds.box("errata", "en")}<section id="s"><h2>S</h2>{entries}</section></section>'
    )
    page = opened(folds.folded(body, 3), "#e1")
    shown = "() => [...document.querySelectorAll('.entry')].map((e) => [e.open, e.hidden])"
    assert page.evaluate(shown) == [[False, False], [True, False]]
    page.locator("input").fill("ONE two")
    assert page.evaluate(shown) == [[False, False], [True, True]]
    assert page.locator(".find span").inner_text() == "1 of 2"
    page.locator("input").fill("three")
    assert page.locator("#s").is_hidden()
    page.locator("input").fill("")
    page.get_by_role("button", name="Open all").click()
    assert page.evaluate(shown) == [[True, False]] * 2


@pytest.mark.one_case
@pytest.mark.parametrize("wanted", [5, 12, 25, 40])
@pytest.mark.parametrize("quantity", ["ID", "FD"])
def test_the_slider_names_the_quickest_way_with_so_many_digits(opened, quantity, wanted):
    page = opened(digits.picture("go2", "en").removeprefix("```{raw} html\n").removesuffix("```"))
    page.select_option("select", quantity)
    page.evaluate("(x) => { const i = document.querySelector('input'); i.value = x; i.oninput(); }", wanted)
    enough = [r for r in RECORDS if r["quantity"] == quantity and 0 < (r["error"] or 1) <= 10.0**-wanted]
    said = page.locator(".digits-answer").inner_text().replace("\u00a0", " ")
    for text, are_many in (("For one state at a time: ", False), ("For many in one call: ", True)):
        found = [r["seconds"] for r in enough if (r.get("states", 1) > 1) == are_many]
        assert (text in said) == bool(found)
        if found:
            assert digits.time_of(min(found)).replace("\u00a0", " ") in said.split(text)[1]
