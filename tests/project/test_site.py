"""The site: algorithms quoted line by line, links that lead somewhere, one page in both languages, and checks that see.

`python docs/build.py --check` builds all of it with warnings as errors, and is a stage of .ci/run.
"""

import re
import sys
from pathlib import Path
from types import ModuleType

import pytest

import twistwrench as tw

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))

from website import beside, browser, formulas, links, pages, steps, tables, thumbnails  # noqa: E402

from ..sampling import drawn  # noqa: E402

TEXTS = sorted(path.name for path in pages.TEXT.glob("*.md") if not path.stem.endswith(".zh-CN"))


# ---------------------------------------------------------------- the source beside the chapter


@pytest.mark.parametrize("name", beside.names())
def test_every_line_of_an_algorithm_stands_beside_its_step(name):
    for part in beside.read(name)["part"]:
        lines = beside.body(part["file"], part["function"])
        pieces = beside.cut(lines, [step["at"] for step in part["step"]], part["file"])
        assert [line for piece in pieces for line in piece.text] == lines.text
        source = (beside.SOURCE / part["file"]).read_text(encoding="utf-8").splitlines()
        for piece in pieces:
            assert source[piece.first - 1 : piece.first - 1 + len(piece.text)] == piece.text


def test_the_values_on_a_go2_are_told_in_chinese():
    english, chinese = ("".join(steps.section(beside.read(name), k) for name in steps.CODE) for k in pages.LANGUAGES)
    assert all(english.count(word) for word in steps.CHINESE)
    assert set(re.findall("<caption>.*?</caption>", chinese, re.DOTALL)) == {
        f"<caption>{steps.CAPTION['zh'].format(name)}</caption>" for name in steps.CODE
    }
    assert not any(word in table for table in chinese.split("<details>")[1:] for word in steps.CHINESE)


def test_the_algorithms_of_the_chapter_have_their_page():
    assert {"rnea", "aba", "crba"} <= set(beside.names())
    assert {path.stem for path in beside.FOLDER.glob("*.toml")} == set(beside.ORDER)


@pytest.mark.one_case
@pytest.mark.parametrize("name", beside.names())
def test_both_languages_tell_the_same_steps(name):
    said = beside.read(name)
    for part in said["part"]:
        for step in part["step"]:
            assert re.search("[\u4e00-\u9fff]", step["zh"])
            assert not re.search("[\u4e00-\u9fff]", step["en"])
            assert sorted(re.findall(r"\$[^$]+\$", step["en"])) == sorted(re.findall(r"\$[^$]+\$", step["zh"]))
    shown = [re.findall(r"^```\{code-block\}.*?^```", beside.page(name, k), re.M | re.S) for k in pages.LANGUAGES]
    assert shown[0] == shown[1]


@pytest.mark.parametrize(
    ("steps", "said"),
    [
        (["49.6 A0", "49.6 V", "49.6 speed"], "expected 49.6 speed, got 49.6 A"),
        (["49.6 A0, 49.6 V"], "expected None, got 49.6 A"),
        (["49.6 A0"] * 2, "expected 49.6 A0, got 49.6 V"),
    ],
)
def test_a_step_that_is_gone_is_noticed(steps, said):
    with pytest.raises(LookupError, match=said):
        beside.cut(beside.body("algorithms/rnea.py", "newton_euler"), steps, "algorithms/rnea.py")


def test_a_function_that_is_gone_is_noticed():
    with pytest.raises(LookupError, match="no function rneaa"):
        beside.body("algorithms/rnea.py", "rneaa")


# ---------------------------------------------------------------- pages


@pytest.mark.parametrize("name", TEXTS)
def test_both_languages_have_a_page_with_the_same_links(name):
    texts = [(pages.TEXT / pages.twin(name, language)).read_text(encoding="utf-8") for language in pages.LANGUAGES]
    targets = [sorted(re.findall(r"\]\(([^)]+)\)", text)) for text in texts]
    assert targets[0] == targets[1]
    entries = [re.findall(r"<([\w/]+)>\n", text) + re.findall(r"^<!-- .* -->$", text, re.M) for text in texts]
    assert entries[0] == entries[1]


def test_links_between_files_become_links_between_pages(tmp_path):
    text = "[简体中文](README.zh-CN.md) · [README](README.md)\n\n[a](docs/map.md#x) [b](notebooks/en/00_first.ipynb) [c](https://d.org/e.md)\n"
    text += "```sh\n[f](docs/map.md)\n```\n[g](LICENSE) [h](docs/no.md)\n"
    moved = pages.moved(text, "README.md", "readme", tmp_path)
    assert moved == (
        "[a](map.md#x) [b](chapter/00_first.ipynb) [c](https://d.org/e.md)\n"
        "```sh\n[f](docs/map.md)\n```\n[g](files/LICENSE) [h](docs/no.md)\n"
    )
    assert (tmp_path / "files" / "LICENSE").read_bytes() == (ROOT / "LICENSE").read_bytes()


def test_chinese_pages_link_to_chinese_pages(tmp_path):
    assert pages.moved("[a](../README.zh-CN.md) [b](map.zh-CN.md)", "docs/traps.zh-CN.md", "traps", tmp_path) == (
        "[a](readme.md) [b](map.md)"
    )


def test_a_picture_for_light_and_dark_becomes_two_of_which_the_theme_shows_one(tmp_path):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    moved = pages.moved(text, "README.md", "readme", tmp_path)
    shown = re.findall(r"^```\{image\} (\S+)\n:alt: .*157\.8 N\n:class: (\S+)\n```$", moved, re.MULTILINE)
    assert shown == [(f"files/docs/pictures/door_{name}.svg", f"only-{name}") for name in ("light", "dark")]
    assert "<picture>" not in moved
    assert all((tmp_path / path).is_file() for path, _ in shown)


def test_the_line_that_leads_to_the_other_language_goes_and_other_links_stay(tmp_path):
    text = "# A\n\n[English](map.md) · [README](../README.zh-CN.md)\n\nB\n"
    assert pages.moved(text, "docs/traps.zh-CN.md", "traps", tmp_path) == "# A\n\nB\n"
    text = "# A\n\n[English](map.md) · [B](glossary.zh-CN.md)\n\nC\n"
    assert pages.moved(text, "docs/traps.zh-CN.md", "traps", tmp_path) == "# A\n\n[B](glossary.md)\n\nC\n"
    text = "# A\n\n[English](map.md) · [词汇表](glossary.zh-CN.md)\n\nC\n"
    assert pages.moved(text, "docs/traps.zh-CN.md", "traps", tmp_path) == "# A\n\nC\n"


def test_lines_of_chinese_are_joined_without_a_blank(tmp_path):
    text = "# 标题\n第一行，\n第二行\n\n第三行\n- 一\n- 二\n"
    assert pages.moved(text, "docs/x.zh-CN.md", "x", tmp_path) == "# 标题\n第一行，第二行\n\n第三行\n- 一\n- 二\n"
    listed = "- 第一行，\n  第二行\uff1b\n  model 与\n- **二**\n"
    assert pages.moved(listed, "docs/x.zh-CN.md", "x", tmp_path) == "- 第一行，第二行；model 与\n- **二**\n"
    assert pages.moved("中文\n中文\n", "docs/x.md", "x", tmp_path) == "中文\n中文\n"


def test_headings_follow_each_other(tmp_path):
    assert pages.moved("# A\n### 1. B\n", "docs/x.md", "x", tmp_path) == "# A\n## 1. B\n"
    assert pages.moved("# A\n## B\n### C\n", "docs/x.md", "x", tmp_path) == "# A\n## B\n### C\n"


TABLE = "<!-- table: t -->\n| | time | many |\n|---|---|---|\n| `a(x)` | 3.0 ms (2 … 4) | 1 |\n| b (c) | 1 s | 2 |\n"


def test_a_gallery_has_a_door_for_each_page_with_a_picture_and_its_first_sentence(tmp_path, monkeypatch):
    monkeypatch.setattr(pages, "thumbnail", lambda name, text, language: f"<svg {name} {language}>\n")
    pages.write(tmp_path / "a.md", "# A page\n\n![seen](a.png)\n\nOne `x.y` and [two](b.md). Three.\n")
    pages.write(tmp_path / "b.md", "# 一页\n\n第一句。第二句。\n")
    first, second = pages.gallery(["a", "b"], tmp_path, "zh").split(":::{container} door\n")[1:]
    assert first == "```{raw} html\n<svg a zh>\n```\n\n**[A page](a.md)**\n\nOne `x.y` and two.\n:::\n"
    assert second == "```{raw} html\n<svg b zh>\n```\n\n**[一页](b.md)**\n\n第一句。\n:::\n::::"


@pytest.mark.parametrize(
    ("own", "shown"),
    [
        ({"column": 1, "rows": [1, 0]}, [("b", "1 s"), ("a", "3.0 ms")]),
        ({"columns": [1, 2], "row": 0}, [("time", "3.0 ms"), ("many", "1")]),
    ],
)
def test_a_picture_shows_cells_of_a_table(own, shown):
    assert thumbnails.cells({"table": "t", **own}, f"| x |\n|---|\n| 9 |\n\n{TABLE}") == shown
    assert thumbnails.cells({"table": 0, **own}, TABLE) == shown


def test_bars_are_as_long_as_their_numbers_and_points_lie_by_their_logarithms():
    bars = thumbnails.lines([("a", "2"), ("b", "4")], log=False)
    assert [float(x) - 5 for x in re.findall(r"H([\d.]+)\" stroke=\"#", bars)] == [83.0, 166.0]
    points = thumbnails.lines([("a", "1 ms"), ("b", "10 ms"), ("c", "1e-1 s")], log=True)
    assert re.findall(r'cx="([\d.]+)"', points) == ["5.0", "88.0", "171.0"]
    with pytest.raises(ValueError, match="no number in the cell 'none'"):
        thumbnails.lines([("a", "none")], log=False)


@pytest.mark.slow
@pytest.mark.parametrize("language", pages.LANGUAGES)
def test_every_study_has_a_picture_whose_letters_can_be_read(language):
    studies = [(path, name) for path, name in pages.pages().items() if name in pages.studies()]
    for path, name in drawn(studies, 6):
        text = (ROOT / pages.twin(path, language)).read_text(encoding="utf-8")
        picture = thumbnails.thumbnail(name, text, language)
        label = re.search(r'aria-label="([^"]+)"', picture)[1]
        assert bool(re.search("[\u4e00-\u9fff]", label)) == (language == "zh")
        rows = re.findall(r'<text x="3" [^>]*>([^<]*)</text><text [^>]*>([^<]*)<', picture)
        assert all(len(row) + len(cell) < 29 for row, cell in rows)  # of 6 units each, in 176


def test_a_page_without_a_chinese_file_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(pages, "pages", lambda: {"CHANGELOG.md": "changelog"})
    pages.write_pages(tmp_path, "zh")
    assert "本页只有英文" in (tmp_path / "changelog.md").read_text(encoding="utf-8")


def test_the_log_of_changes_alone_is_in_english_only():
    assert [path for path in pages.pages() if not (ROOT / pages.twin(path, "zh")).exists()] == ["CHANGELOG.md"]


@pytest.fixture(scope="module")
def interface():
    pytest.importorskip("sphinx", reason="Sphinx is not installed: the interface is not checked")
    from website import interface

    return interface


def test_every_room_and_every_public_name_has_a_line_of_chinese(interface):
    names = {name for names in interface.by_page().values() for name in names}
    assert set(interface.chinese()) == names | {f"{room}/" for room in interface.by_room()}


def test_the_pages_of_the_interface_follow_the_chapter(interface):
    pages = list(interface.by_page())
    numbers = [int(s.partition(".")[2]) for p in pages if "/" in p and (s := interface.sections().get(p))]
    assert numbers == sorted(numbers)
    assert set(numbers) == set(range(2, 12))
    assert (pages[0], pages[-1]) == ("newton_euler_3d", "errors")


def test_every_public_name_has_one_page_and_so_have_the_records(interface):
    names = [name for names in interface.by_page().values() for name in names]
    assert len(names) == len(set(names))
    packages = {name for name in tw.__all__ if isinstance(getattr(tw, name), ModuleType)}
    assert set(tw.__all__) - packages <= set(names)
    assert {f"{name}.{own}" for name in packages for own in getattr(tw, name).__all__} <= set(names)
    returned = {tw.rnea_terms, tw.aba_terms, tw.crba_terms, tw.centroidal_terms}
    records = {f"{f.__module__}.{f.__annotations__['return']}".rpartition(".")[2] for f in returned}
    assert records | {"LoadReport", "Entry"} <= {name.rpartition(".")[2] for name in names}


def test_only_what_differs_is_touched_and_what_is_gone_goes(tmp_path):
    old, new = tmp_path / "old", tmp_path / "new"
    for tree, files in (
        (old, {"same": "1", "other": "1", "gone": "1"}),
        (new, {"same": "1", "other": "2", "a/b": "3"}),
    ):
        for name, text in files.items():
            pages.write(tree / name, text)
    before = (old / "same").stat()
    assert pages.replace(old, new)
    assert {p.relative_to(old).as_posix(): p.read_text() for p in old.rglob("*") if p.is_file()} == {
        "same": "1",
        "other": "2",
        "a/b": "3",
    }
    assert (old / "same").stat().st_ino == before.st_ino
    assert not pages.replace(old, old)


def test_chinese_is_found_by_pairs_of_characters():
    pytest.importorskip("sphinx", reason="Sphinx is not installed: the site's search is not checked")
    from website.chinese import PairsOfCharacters

    search = PairsOfCharacters({})
    assert search.split("质量矩阵 M(q), CRBA。") == ["质量", "量矩", "矩阵", "M", "q", "CRBA"]


# ---------------------------------------------------------------- notebooks


def test_outputs_are_shared_by_equal_code_only():
    pytest.importorskip("myst_parser", reason="MyST is not installed: the site is not checked")
    nbformat = pytest.importorskip("nbformat", reason="nbformat is not installed: the notebooks are not checked")
    from website import notebooks

    def notebook(code, outputs=()):
        return nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(code, outputs=list(outputs))])

    printed = nbformat.v4.new_output("stream", text="2")
    assert notebooks.with_outputs(notebook("1 + 1"), notebook("1 + 1", [printed])).cells[0].outputs == [printed]
    with pytest.raises(ValueError, match="different code"):
        notebooks.with_outputs(notebook("1 + 1"), notebook("1 + 2", [printed]))
    assert len({notebooks.key(notebook(c), k) for c in ("1 + 1", "1 + 2") for k in "ab"}) == 4


# ---------------------------------------------------------------- formulas, and what is looked for


RAW = (
    "<head><script>window.MathJax = {}</script><script defer src='../x/tex-svg-full.js?v=1'></script></head><body>"
    '<p><span class="math notranslate nohighlight">\\(a &lt; b\\)</span></p>'
    '<div class="math notranslate nohighlight" id="e">\n\\[x\\]</div><code>\\(a\\)</code></body>'
)


def test_formulas_are_set_in_the_page_and_the_script_goes():
    assert formulas.unset(RAW) == [r"\(a < b\)", r"\[x\]"]
    done = {r"\(a < b\)": '<use xlink:href="#MJX-1"></use>', r"\[x\]": "<b>x</b>"}
    page = formulas.with_formulas(RAW, done, {"MJX-1": '<path id="MJX-1"/>', "MJX-2": "unused"}, "p {}")
    assert formulas.unset(page) == []
    assert '<span class="math notranslate nohighlight"><use xlink:href="#MJX-1"></use></span>' in page
    assert '<div class="math notranslate nohighlight" id="e"><b>x</b></div>' in page
    assert page.index("<style>p {}</style>") < page.index("</head>") < page.index('<path id="MJX-1"/>')
    assert not any(gone in page for gone in ("tex-svg", "window.MathJax", "unused"))
    assert r"<code>\(a\)</code>" in page  # code that looks like a formula is code


def test_a_chinese_mark_stays_with_its_formula():
    raw = '<body><p><span class="math notranslate nohighlight">\\(x\\)</span>。</p>'
    page = formulas.with_formulas(raw, {r"\(x\)": "<b>x</b>"}, {}, "")
    formula = '<span class="math notranslate nohighlight"><b>x</b></span>'
    assert f'<p><span class="with-mark">{formula}。</span></p>' in page


def test_a_head_that_is_empty_is_a_cell():
    html = '<tr><th class="head"></th><th class="head x"><p>A</p></th><th class="head"><p></p></th></tr>'
    cells = tables.without_empty_heads(html)
    assert cells == '<tr><td class="head"></td><th class="head x"><p>A</p></th><td class="head"></td></tr>'


def test_a_number_and_its_unit_are_not_parted():
    pytest.importorskip("sphinx", reason="Sphinx is not installed: the site's units are not checked")
    from website.units import POWER, kept_together

    assert kept_together("6e-14 N m, 1.26 ms, 40 °") == "6e-14\u00a0N\u00a0m, 1.26\u00a0ms, 40\u00a0°"
    assert kept_together("6 × 6") == "6\u00a0×\u00a06"
    assert kept_together("8 states, 3 m's, the N most") == "8 states, 3 m's, the N most"
    assert POWER.split("up to 2e-14, e-mail") == ["up to ", "2e-14", ", e-mail"]


@pytest.mark.parametrize(
    ("line", "left"),
    [
        ("[简体中文](a.zh-CN.md)\n\n", ""),
        ("[English](a.md) · [README](../README.zh-CN.md)\n\n", ""),
        ("[简体中文](a.zh-CN.md) · [glossary](glossary.md)\n", ""),
        ("[English](a.md) · [README](../R.zh-CN.md) · [词汇表](glossary.zh-CN.md) · [B](b.md)\n", "[B](b.md)\n"),
    ],
)
def test_a_page_of_the_site_does_not_lead_to_its_twin_by_a_link_of_its_own(line, left):
    assert pages.TO_THE_TWIN.sub("", f"# A\n\n{line}B\n") == f"# A\n\n{left}B\n"


def test_the_first_use_of_a_word_leads_to_the_glossary():
    from website.glossary import Words, rows

    def found(language, text, used=()):
        pieces = [*Words(language).pieces(text, used := {*used})]
        assert "".join(piece.text for piece in pieces) == text
        assert used >= {piece.anchor for piece in pieces if piece.anchor}
        return [(piece.text, piece.anchor.removeprefix("term-")) for piece in pieces if piece.anchor]

    assert len({anchor for anchor, _ in rows()}) == len(rows()) > 50
    assert found("en", "Twists; a wrench, wrenches; twistwrench, a twisted rod.") == [
        ("Twists", "twist"),
        ("wrench", "wrench"),
    ]
    assert found("en", "six degrees of freedom", {"term-twist"}) == [("degrees of freedom", "degree-of-freedom")]
    assert found("en", "a wrench", {"term-wrench"}) == []
    assert found("zh", "复合刚体惯量，twistwrench，刚体") == [
        ("复合刚体惯量", "composite-rigid-body-inertia"),
        ("刚体", "body-rigid-body"),
    ]


def test_what_is_looked_for_leads_to_pages_that_are_there():
    pytest.importorskip("sphinx", reason="Sphinx is not installed: the site's search is not checked")
    from website import hands, interface, keywords, notebooks

    there = {*pages.pages().values(), "chapter/exercises", *(f"chapter/{name}" for name in notebooks.names())}
    there |= {f"api/{name}" for name in interface.by_page()}
    assert set(keywords.KEYWORDS) <= there | {f"hands/{name}" for name in hands.names()}
    words = [word for own in keywords.KEYWORDS.values() for word in own]
    assert len(words) == len(set(words))
    assert all(word == word.lower() for word in words)


def test_names_and_sections_lead_to_where_they_are_explained():
    pytest.importorskip("sphinx", reason="Sphinx is not installed: the site's links are not checked")
    from website.crosslinks import chapter, cut, place_of

    names, modules = {"rnea": ("api/rnea", "n"), "Scene.cheapest": ("api/scene", "c")}, {"model": ("api/model", "m")}
    place = lambda code: place_of(code, names, modules)  # noqa: E731
    assert place("rnea") == place("tw.rnea(model, q)") == place("twistwrench.rnea") == ("api/rnea", "n")
    assert place("Scene.cheapest(0.1)") == ("api/scene", "c")
    assert place("tw.model") == ("api/model", "m")
    assert all(place(code) is None for code in ("model", "pin.rnea", "rnea + h", "rnea()[0]", "crba"))
    sections = chapter() | {"49.6.2": ("chapter/exercises", "e")}
    assert sections["49.6"] == ("chapter/49_06_rnea", "")
    six, two = sections["49.6"], sections["49.6.2"]
    said = [("(", None), ("49.6", six), (") and ", None), ("49.6.2", two), (", 49.6.9 or 149.6 or 49.60.", None)]
    assert [*cut("(49.6) and 49.6.2, 49.6.9 or 149.6 or 49.60.", sections)] == said
    assert [*cut("49.6.", sections)] == [("49.6", six), (".", None)]


# ---------------------------------------------------------------- the checks see what is wrong


def test_links_that_lead_nowhere_are_found(tmp_path):
    (tmp_path / "a.html").write_text(
        '<h1 id="top"></h1><a href="#top"></a><a href="b.html#here"></a><a href="https://x.org"></a>'
        '<a href="c.html"></a><a href="b.html#there"></a><script src="https://x.org/y.js"></script><img src="z.png">'
    )
    (tmp_path / "b.html").write_text('<a id="here" href="a.html"></a>')
    assert sorted(links.check(tmp_path)) == [
        "a.html: fetches https://x.org/y.js",
        "a.html: no file for c.html",
        "a.html: no file for z.png",
        "a.html: no such place: b.html#there",
    ]


BAD = """<!doctype html><html lang="en"><title>A page</title><body style="background: white">
<main><h1>Bad</h1><p style="color: #bbb">pale</p><img src="no.png" alt=""><div style="width: 3000px">wide</div>
<span class="math">\\(x\\)</span><script>console.error("something is wrong")</script></main></body></html>"""


@pytest.mark.slow
def test_what_is_wrong_with_a_page_is_seen_in_the_browser(tmp_path):
    if reason := browser.missing():
        pytest.skip(reason)
    from playwright.sync_api import sync_playwright

    (tmp_path / "bad.html").write_text(BAD, encoding="utf-8")
    with sync_playwright() as play:
        chromium = play.chromium.launch(executable_path=browser.chromium(), args=["--no-sandbox"])
        page = chromium.new_page(viewport=browser.NARROW)
        looks = "\n".join(browser.looks(page, tmp_path / "bad.html"))
        reach, accessible = list(browser.reach(page)), "\n".join(browser.accessible(page, "bad"))
        chromium.close()
    assert "1 formulas not set" in looks
    assert "figures not shown: ['no.png']" in looks
    assert "px wider than the window" in looks
    assert "on the console: something is wrong" in looks
    assert reach == [f"the language switch is not reached with {browser.MOST_TABS} tabs"]
    assert "color-contrast" in accessible
