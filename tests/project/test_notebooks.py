"""The notebooks: in step with their sources, alike in both languages, and right when they are run."""

import ast
import base64
import importlib.util
import io
import re
import time
import tomllib
from pathlib import Path

import pytest

import twistwrench as tw
from twistwrench.exercises.asking import questions
from twistwrench.exercises.chapter import COURSE

nbformat = pytest.importorskip("nbformat", reason="nbformat is not installed: the notebooks are not checked")
pytest.importorskip("jupytext", reason="jupytext is not installed: the notebooks are not checked")

FOLDER = Path(__file__).resolve().parents[2] / "notebooks"


def script(name):
    spec = importlib.util.spec_from_file_location(f"notebooks_{name}", FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


build, execute = script("build"), script("execute")

SOURCES = build.sources()
SECTIONS = [source for source in SOURCES if source.stem.startswith("49")]
SLOWEST = 60  # s, a notebook


def by_name(source):
    return source.stem


def notebook(source, language):
    return nbformat.read(build.target(source, language), as_version=4)


def code(source):
    return [cell.source for cell in build.cells(source) if cell.cell_type == "code"]


def texts(source, language):
    return [cell.source for cell in notebook(source, language).cells if cell.cell_type == "markdown"]


# ---------------------------------------------------------------- in step


def test_every_source_is_built_and_every_notebook_has_a_source():
    assert {path.stem for path in (FOLDER / "source").glob("*.py")} == {source.stem for source in SOURCES}
    for language in build.LANGUAGES:
        kept = {path.name for path in (FOLDER / language).glob("*.ipynb")}
        assert kept == {build.target(source, language).name for source in SOURCES}


@pytest.mark.parametrize("language", build.LANGUAGES)
@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_a_notebook_is_what_its_source_says(source, language):
    path = build.target(source, language)
    expected = build.with_outputs(build.build(source, language), path)
    assert path.read_text(encoding="utf-8") == expected, "run: python notebooks/build.py"


def test_a_stale_notebook_is_noticed_and_mended(tmp_path, monkeypatch, capsys):
    (tmp_path / "source").mkdir()
    (tmp_path / "source" / "00_first.py").write_text("# %%\n1 + 1\n", encoding="utf-8")
    monkeypatch.setattr(build, "HERE", tmp_path)
    assert build.main(["--check"]) == 1
    assert not (tmp_path / "en").exists()
    assert build.main([]) == 0
    assert build.main(["--check"]) == 0
    stale = tmp_path / "zh" / "00_first.ipynb"
    stale.write_text(stale.read_text(encoding="utf-8").replace("1 + 1", "1 + 2"), encoding="utf-8")
    capsys.readouterr()
    assert build.main(["--check"]) == 1
    assert capsys.readouterr().out == "zh/00_first.ipynb: out of step with its source\n"


def test_what_a_notebook_shows_is_kept_as_long_as_its_code_is(tmp_path, monkeypatch):
    source = tmp_path / "source" / "00_first.py"
    source.parent.mkdir()
    monkeypatch.setattr(build, "HERE", tmp_path)

    def shown(text, code):
        words = (f'# %% [markdown] lang="{language}"\n# {text}\n' for language in build.LANGUAGES)
        source.write_text(f"{''.join(words)}# %%\n{code}\n", encoding="utf-8")
        build.main([])
        text, cell = nbformat.read(tmp_path / "zh" / "00_first.ipynb", as_version=4).cells
        return text.source, cell.outputs

    assert shown("one", "print(1)") == ("one", [])
    path = tmp_path / "zh" / "00_first.ipynb"
    done = nbformat.read(path, as_version=4)
    done.cells[1].outputs = [nbformat.v4.new_output("stream", text="1\n")]
    nbformat.write(done, path)
    assert shown("two", "print(1)") == ("two", done.cells[1].outputs)
    assert build.main(["--check"]) == 0
    assert shown("two", "print(2)") == ("two", [])


def test_what_a_second_run_does_not_repeat_is_not_kept():
    def result(number, count):
        return nbformat.v4.new_output("execute_result", data={"text/plain": number}, execution_count=count)

    def ran(*outputs):
        return nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("x", outputs=[one]) for one in outputs])

    notebook = ran(result("0", None), result("0", None))
    runs = ran(result("7", 1), result("0.1 ms", 2)), ran(result("7", 3), result("0.2 ms", 4))
    kept = execute.keep(notebook, runs, "en").cells
    assert [cell.outputs for cell in kept[:1]] == [[result("7", None)]]
    assert [output.text for output in kept[1].outputs] == [execute.VARIES["en"]]


def test_a_picture_is_kept_with_few_colours():
    image = pytest.importorskip("PIL.Image", reason="Pillow is not installed: no picture is made")
    noise = image.effect_noise((90, 60), 80).convert("RGB")
    content = io.BytesIO()
    noise.save(content, "PNG")
    png = base64.b64encode(content.getvalue()).decode()
    output = nbformat.v4.new_output("display_data", data={"image/png": png, "text/plain": "<Figure size 90x60>"})
    small = execute.small(output)
    assert list(small.data) == ["image/png"]
    assert len(small.data["image/png"]) < len(png)
    with image.open(io.BytesIO(base64.b64decode(small.data["image/png"]))) as picture:
        assert picture.size == (90, 60)
        assert len(picture.getcolors()) <= execute.COLOURS
    assert output.data["image/png"] == png


def test_the_paths_of_an_svg_are_kept_to_a_tenth_of_a_point_and_its_words_as_they_are():
    svg = '<svg id="1.2345"><path d="M 1.2345 6\nL -7.0456 8.999 \nz"/><text>0.12345</text></svg>'
    small = execute.small(nbformat.v4.new_output("display_data", data={"image/svg+xml": svg})).data["image/svg+xml"]
    assert small == '<svg id="1.2345"><path d="M 1.2 6 L -7.0 8.9 z"/><text>0.12345</text></svg>'


# ---------------------------------------------------------------- in both languages


@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_both_languages_have_the_same_code_and_as_much_text(source):
    english, chinese = (notebook(source, language).cells for language in build.LANGUAGES)
    assert [cell.cell_type for cell in english] == [cell.cell_type for cell in chinese]
    for one, other in zip(english, chinese):
        if one.cell_type == "code":
            plain = other.source.replace(f"\n{build.CHINESE_FIGURES}", "").replace(', language="zh")', ")")
            assert without_words(one.source) == without_words(plain)
        else:
            assert one.source != other.source


def without_words(code):
    """The code without what its strings say; the values in an f-string are code."""
    tree = ast.parse(code)
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            node.value = ""
        if isinstance(node, ast.JoinedStr):
            node.values = sorted(ast.dump(part) for part in node.values if isinstance(part, ast.FormattedValue))
    return re.sub(r"Constant\(value='[^']*'\)", "", ast.dump(tree))


@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_comments_figures_and_what_is_printed_are_chinese_in_the_chinese_notebook(source):
    cells = [cell.source for cell in notebook(source, "zh").cells if cell.cell_type == "code"]
    words = tomllib.loads(build.WORDS.read_text(encoding="utf-8"))
    as_they_are = {text for part in ("all", source.stem) for text, own in words[part].items() if not own}
    english = {text for cell in cells for *_, text in build.said(cell) if build.needs_chinese(text)} - as_they_are
    assert {text for text in english if not re.search("[\u4e00-\u9fff]", text)} == set()
    assert [
        text for text in labels("\n".join(cells)) if re.match("[^\u4e00-\u9fff(]*[a-z]{4}[^\u4e00-\u9fff(]*$", text)
    ] == []


def labels(code):
    """The words that are given to a figure as a title, the name of an axis or of a line."""
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.keyword) and node.arg in ("label", "title", "xlabel", "ylabel", "zlabel"):
            parts = (part.value for part in ast.walk(node.value) if isinstance(part, ast.Constant))
            yield from (part for part in parts if isinstance(part, str))


def test_every_word_in_chinese_is_used():
    words = tomllib.loads(build.WORDS.read_text(encoding="utf-8"))
    used = {
        source.stem: {
            text for cell in code(source) for part, _ in build.unfolded(cell) for *_, text in build.said(part)
        }
        for source in SOURCES
    }
    assert {stem: set(own) - used[stem] for stem, own in words.items() if stem != "all"} == {
        stem: set() for stem in used
    }
    assert set(words["all"]) <= set().union(*used.values())


@pytest.mark.parametrize(
    ("cell", "set_"),
    [
        ("x = 1  # one thing\n", "x = 1  # 一件事\n"),
        ('print("µ of the floor", x)\n', 'print("地面的 µ", x)\n'),
        ('ax.legend(loc="upper left")\nleft = "upper left"\n', 'ax.legend(loc="upper left")\nleft = "左上"\n'),
        ('print(f"{x:.1f} N of it")\n', 'print(f"其中 {x:.1f} N")\n'),
        (
            "import matplotlib.pyplot as plt\nx = 1",
            f"import matplotlib.pyplot as plt\n\n{build.CHINESE_FIGURES}\nx = 1",
        ),
    ],
)
def test_a_code_cell_is_set_in_chinese(cell, set_):
    words = {
        "# one thing": "# 一件事",
        "µ of the floor": "地面的 µ",
        "upper left": "左上",
        "{x:.1f} N of it": "其中 {x:.1f} N",
    }
    assert build.in_chinese(cell, words) == set_


@pytest.mark.parametrize("cell", ["x = 1  # one thing", 'print("the floor", x)', 'print(f"{x} of it")'])
def test_english_without_its_chinese_is_refused(cell):
    with pytest.raises(ValueError, match=r"zh\.toml: expected the Chinese of"):
        build.in_chinese(cell, {})


@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_each_language_is_that_language(source):
    assert not any(re.search("[\u4e00-\u9fff]", text) for text in texts(source, "en"))
    assert all(re.search("[\u4e00-\u9fff]", text) for text in texts(source, "zh"))


@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_both_languages_show_the_same_formulas(source):
    def formulas(text):
        displayed = re.findall(r"\$\$(.+?)\$\$", text, re.DOTALL)
        return [re.sub(r"\\(text|mathrm|quad|qquad)\b(\{[^}]*\})?|[\s.,;]", "", formula) for formula in displayed]

    for english, chinese in zip(texts(source, "en"), texts(source, "zh"), strict=True):
        assert formulas(english) == formulas(chinese)


@pytest.mark.parametrize(
    ("cells", "message"),
    [
        ('# %% [markdown] lang="en"\n# yes\n', "the last English cell"),
        ('# %% [markdown] lang="en"\n# yes\n# %%\n1\n', "cell 1: each English cell is followed"),
        ('# %% [markdown] lang="zh"\n# 是\n', "cell 0: each English cell is followed"),
        ("# %% [markdown]\n# yes\n", 'cell 0: expected lang="en"'),
    ],
)
def test_a_text_without_its_twin_is_refused(tmp_path, cells, message):
    source = tmp_path / "49_01.py"
    source.write_text(cells, encoding="utf-8")
    with pytest.raises(ValueError, match=message):
        build.cells(source)


@pytest.mark.parametrize(
    ("typed", "set_"),
    [
        ("质心在\n脚的中间", "质心在脚的中间"),
        ("质心,\n脚", "质心\uff0c脚"),
        ("用 `q`,\n然后", "用 `q`\uff0c然后"),
        ("转动:\n$\\omega$ 是", "转动\uff1a$\\omega$ 是"),
        ("如下:\n\n$$x$$", "如下\uff1a\n\n$$x$$"),
        ("如下:\n- 一\n- 二", "如下\uff1a\n- 一\n- 二"),
        ("# 题目\n正文", "# 题目\n正文"),
        ("| 量 |\n| 力 |", "| 量 |\n| 力 |"),
        ("算 `f(x, y)` 与 (ω, v)", "算 `f(x, y)` 与 (ω, v)"),
        ("七个数(位置):`nq`", "七个数\uff08位置\uff09\uff1a`nq`"),
        ("用它 (见 $f(x)$ 与 (ω, v)) 算", "用它\uff08见 $f(x)$ 与 (ω, v)\uff09算"),
        ("矩阵(49.3)", "矩阵\uff0849.3\uff09"),
        ("[这里](docs/x.md)", "[这里](docs/x.md)"),
        ("1. 忘记 $p$;\n2. 运行 `a`;`b`", "1. 忘记 $p$\uff1b\n2. 运行 `a`\uff1b`b`"),
        ('说"对偶"', "说“对偶”"),
        ("螺距为 $h$;twist 的轴", "螺距为 $h$\uff1btwist 的轴"),
        ("$S$(49.8)与**压力中心**(COP)", "$S$\uff0849.8\uff09与**压力中心**\uff08COP\uff09"),
        ("10 N m 与 2 kg m²", "10 N·m 与 2 kg·m²"),
        ("真的吗?真的!", "真的吗\uff1f真的\uff01"),
        ("取 $t = 1$ s;$V$ 本身", "取 $t = 1$ s\uff1b$V$ 本身"),
        ("滑动(Mozzi,1763)。", "滑动\uff08Mozzi\uff0c1763\uff09。"),
        ("一次乘法 $x$;49.3 把它展开", "一次乘法 $x$\uff1b49.3 把它展开"),
        ("那一块,$k$:\n\n$$x$$", "那一块\uff0c$k$\uff1a\n\n$$x$$"),
        ("长度是 1:7 + 12", "长度是 1\uff1a7 + 12"),
        ("多少 N?多少 rad/s²?", "多少 N\uff1f多少 rad/s²\uff1f"),
        ("1,000 个,12:30 开始", "1,000 个\uff0c12:30 开始"),
        ("在 (1, 0.5) m 处,转 $O(a, b)$", "在 (1, 0.5) m 处\uff0c转 $O(a, b)$"),
    ],
)
def test_chinese_is_set_as_chinese(typed, set_):
    assert build.chinese(typed) == set_


WIDE_OR_CODE = re.compile(r"`[^`]+`|\$\$[^$]+\$\$|\$[^$]+\$|\]\([^)]*\)|\([^()\u4e00-\u9fff]*\)|\d[,:]\d\d|://")


@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_no_mark_of_a_chinese_notebook_is_as_narrow_as_in_english(source):
    words = [WIDE_OR_CODE.sub("", text) for text in texts(source, "zh")]
    assert [text[max(0, k.start() - 12) : k.end() + 12] for text in words for k in re.finditer("[,;:?!()]", text)] == []


# ---------------------------------------------------------------- links

LINK = re.compile(r"\]\(([^)\s]+)\)")


@pytest.mark.parametrize("language", build.LANGUAGES)
@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_a_link_of_a_notebook_leads_somewhere_in_the_repository(source, language):
    links = [link for text in texts(source, language) for link in LINK.findall(text)]
    here = build.target(source, language).parent
    assert [link for link in links if "://" not in link and not (here / link.split("#")[0]).exists()] == []


@pytest.mark.parametrize("language", build.LANGUAGES)
@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_a_page_that_only_the_site_has_is_called_by_name_and_the_site_links_it(source, language, monkeypatch):
    monkeypatch.syspath_prepend(FOLDER.parent / "docs")
    from website import beside, hands, notebooks

    pages = {f"../hands/{name}.md" for name in hands.names()} | {f"../algorithms/{name}.md" for name in beside.names()}
    own = [cell.source for cell in build.cells(source) if cell.metadata.get("lang") == language]
    expected = [found[0] for text in own for found in build.SITE_PAGE.finditer(text)]
    linked = notebooks.linked(notebook(source, language))
    found = [link for cell in linked.cells for link in LINK.findall(cell.source) if "://" not in link]
    assert len(found) == len(expected)
    assert set(found) <= pages


def test_a_name_stands_where_a_notebook_cannot_link():
    text, links = build.without_site("See [exp against 1 + [V] t](../hands/exponential.md), [here](x.md).", "en")
    assert text == "See *exp against 1 + [V] t*, [here](x.md)."
    assert links == {"*exp against 1 + [V] t*": "[exp against 1 + [V] t](../hands/exponential.md)"}


@pytest.mark.parametrize("language", build.LANGUAGES)
@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_at_most_one_cell_that_draws_stands_for_the_notebook(source, language):
    marked = [cell for cell in notebook(source, language).cells if build.THUMBNAIL in cell.metadata.get("tags", ())]
    assert len(marked) == sum("thumbnail" in cell.metadata for cell in build.cells(source)) <= 1
    assert all("plt.show()" in cell.source for cell in marked)


# ---------------------------------------------------------------- what is in them


def shows(body):
    """Whether statements print or draw, or end with a question, wherever they are run."""
    last = body[-1:] and ast.unparse(body[-1]).startswith("tw.ask(")
    calls = [node.value for node in body if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)]
    loops = [node for node in body if isinstance(node, ast.For | ast.With)]
    return last or any(ast.unparse(c.func) in ("print", "plt.show") for c in calls) or any(shows(n.body) for n in loops)


@pytest.mark.parametrize("language", build.LANGUAGES)
@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_a_notebook_shows_what_its_cells_print_and_nothing_of_the_machine(source, language):
    cells = [cell for cell in notebook(source, language).cells if cell.cell_type == "code"]
    assert {cell.execution_count for cell in cells} == {None}
    assert any(cell.outputs for cell in cells), "its code has changed; run: python notebooks/execute.py"
    assert [cell.source for cell in cells if shows(ast.parse(cell.source).body) and not cell.outputs] == []
    texts = list(filter(None, (said(output) for cell in cells for output in cell.outputs)))
    assert texts
    for text in texts:
        assert not re.search(r"\b0x[0-9a-f]{6,}|/(?:home|root|tmp|work|Users)/|[A-Z]:\\\\|site-packages", text), text
    size = build.target(source, language).stat().st_size
    assert size < 1_000_000


def said(output):
    """The text of an output; of HTML and SVG, the source."""
    data = output.get("data", {})
    parts = [output.get("text", ""), *(data[kind] for kind in data if not kind.startswith("image/png"))]
    return "\n".join(parts)


@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_every_code_cell_compiles_and_claims_are_asserted(source):
    trees = [ast.parse(cell) for cell in code(source)]
    asserts = [node for tree in trees for node in ast.walk(tree) if isinstance(node, ast.Assert)]
    assert len(asserts) >= 5


@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_nothing_that_the_package_has_is_defined_again(source):
    cells = [cell for cell in code(source) if "tw.exercises.check(" not in cell]  # in those, the student's
    nodes = [node for cell in cells for node in ast.walk(ast.parse(cell))]
    defined = {node.name for node in nodes if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    assert defined & (set(dir(tw)) | set(dir(tw.newton_euler_3d))) == set()


@pytest.mark.parametrize(
    ("name", "listing"),
    [
        ("49_06", "newton_euler"),
        ("49_07", "articulated_body"),
        ("49_08", "composite_rigid_body"),
        ("49_10", "centroidal_composite"),
    ],
)
def test_the_algorithms_are_shown_as_they_stand_in_the_package(name, listing):
    (source,) = (source for source in SOURCES if source.stem == name)
    text = "\n".join(code(source))
    assert f"print(inspect.getsource({listing}))" in text
    assert "settrace" not in text


@pytest.mark.parametrize("language", build.LANGUAGES)
@pytest.mark.parametrize("source", SECTIONS, ids=by_name)
def test_a_section_ends_with_its_exercises(source, language):
    number = source.stem.replace("_0", ".").replace("_", ".")
    last = texts(source, language)[-1]
    assert f"{number}.1" in last
    assert "twistwrench exercises start" in last


# ---------------------------------------------------------------- run


def number(source):
    """The section of a notebook."""
    return source.stem.replace("_0", ".").replace("_", ".")


ASKS = re.compile(r'^(?:\w+ = )?tw\.ask\("([\w.-]+)", \.\.\.\)$', re.MULTILINE)


@pytest.mark.parametrize("source", SECTIONS, ids=by_name)
def test_a_section_asks_five_to_eight_questions_and_all_that_it_has(source):
    asked = [name for cell in code(source) for name in ASKS.findall(cell)]
    assert asked == list(questions(number(source)))
    assert 5 <= len(asked) <= 8
    chinese = "\n".join(cell.source for cell in notebook(source, "zh").cells if cell.cell_type == "code")
    assert [chinese.count(f'tw.ask("{name}", ..., language="zh")') for name in asked] == [1] * len(asked)


@pytest.mark.parametrize("source", SECTIONS, ids=by_name)
def test_an_exercise_is_set_before_its_answer_is_told(source):
    """What tells the answer is folded away with its outputs, and the exercise stands before it, with its own cell."""
    there: list[str] = []  # the exercises that have been set so far
    for cell in build.cells(source):
        there += re.findall(r"^\*\*Exercise ([\d.]+\d)\.\*\*", cell.source, re.MULTILINE)
        assert "after" not in cell.metadata or cell.metadata["after"] in there
    checked = re.findall(r'^tw\.exercises\.check\("([\d.]+)"', "\n".join(code(source)), re.MULTILINE)
    assert checked == there
    assert {exercise.id for exercise in COURSE.of_section(number(source))} <= set(there)


@pytest.mark.parametrize("source", SECTIONS, ids=by_name)
def test_the_cells_for_the_student_have_the_names_of_the_exercises(source):
    turns = [cell for cell in code(source) if "tw.exercises.check(" in cell]
    chinese = [cell.source for cell in notebook(source, "zh").cells if "tw.exercises.check(" in cell.source]
    assert len(turns) == len(chinese) > 0
    for turn, other in zip(turns, chinese):
        (name,) = (node.name for node in ast.parse(turn).body if isinstance(node, ast.FunctionDef))
        exercise, part = COURSE.find_part(name)
        assert turn.endswith(f'tw.exercises.check("{exercise.id}", {name})')
        assert other.endswith(f', {name}, language="zh")')
        assert f"def {name}({part.arguments}):" in turn


@pytest.mark.parametrize("source", SECTIONS, ids=by_name)
def test_a_notebook_begins_with_lines_that_a_student_reads(source):
    first = next(cell for cell in notebook(source, "en").cells if cell.cell_type == "code").source
    assert first.startswith("import twistwrench as tw\n")
    assert len([line for line in first.split("\n") if line]) <= 4


@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_asserts_and_drawing_are_folded_away(source):
    cells = [cell for cell in notebook(source, "en").cells if cell.cell_type == "code"]
    folded = [cell for cell in cells if cell.metadata.get("jupyter", {}).get("source_hidden")]
    shown = [node for cell in cells if cell not in folded for node in ast.parse(cell.source).body]
    assert not any(isinstance(node, ast.Assert) for node in shown)
    after = tuple(f"# {build.AFTER['en'].format(name)}" for name in COURSE.numbers)
    assert all(cell.source.startswith((build.CLAIMS, build.DRAWING, build.SETUP["en"], *after)) for cell in folded)
    assert (
        len([node for cell in folded for node in ast.walk(ast.parse(cell.source)) if isinstance(node, ast.Assert)]) > 5
    )


@pytest.mark.parametrize(
    ("cell", "parts"),
    [
        ("x = 1\nassert x\ny = 2  # two", ["x = 1\ny = 2  # two", "# The claims above, checked\nassert x"]),
        ("for k in a:\n    assert k", ["# The claims above, checked\nfor k in a:\n    assert k"]),
        ("for k in a:\n    b = k\n    assert b", ["for k in a:\n    b = k\n    assert b"]),
        (
            "x = 1\n# why\nax = plot.axes_2d()\nplt.show()",
            ["x = 1", "# The picture\n# why\nax = plot.axes_2d()\nplt.show()"],
        ),
        ("import matplotlib.pyplot as plt\nx = 1", ["import matplotlib.pyplot as plt\nx = 1"]),
    ],
)
def test_a_cell_is_parted_into_what_is_computed_drawn_and_claimed(cell, parts):
    assert [text for text, _ in build.unfolded(cell)] == parts


def test_the_extra_of_the_notebooks_brings_the_solver_that_one_of_them_asks():
    """Whether a scene can stand is a quadratic programme; the tests have its solver from an extra of their own."""
    assert any("can_stand()" in source.read_text(encoding="utf-8") for source in SOURCES)
    project = tomllib.loads((FOLDER.parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    brought = re.findall(r"\w+", " ".join(extras["notebooks"]))
    assert "qp" in brought
    assert "validate" not in brought  # Pinocchio: without it the comparisons say that they are skipped
    assert any(solver.startswith("daqp") for solver in extras["qp"])


def mentions(node, name):
    return any(isinstance(inner, ast.Name) and inner.id == name for inner in ast.walk(node))


@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_without_pinocchio_a_notebook_skips_what_needs_it(source):
    """Where it is not installed `pin` is None, or not there: only a condition, or what is called later, may name it."""
    asked = [node for cell in code(source) for node in ast.parse(cell).body if mentions(node, "pin")]
    later = ast.Try, ast.If, ast.FunctionDef
    bare = [
        ast.unparse(node) for node in asked if not isinstance(node, later) and "if pin else" not in ast.unparse(node)
    ]
    assert bare == []
    tests = [ast.unparse(node.test) for node in asked if isinstance(node, ast.If)]
    assert set(tests) <= {"pin"}


@pytest.mark.slow
@pytest.mark.parametrize("language", build.LANGUAGES)
@pytest.mark.parametrize("source", SOURCES, ids=by_name)
def test_a_notebook_runs_in_a_minute_and_its_claims_hold(source, language, monkeypatch):
    """The site shows these outputs: it runs the other notebooks, and none again of which nothing has changed."""
    pytest.importorskip("nbclient", reason="nbclient is not installed: the notebooks are not run")
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: the notebooks are not run")
    monkeypatch.syspath_prepend(FOLDER.parent / "docs")
    from website import notebooks

    cache, path, start = FOLDER.parent / "build/site/cache", build.target(source, language), time.perf_counter()
    cache.mkdir(parents=True, exist_ok=True)
    result = notebooks.kept(path, cache, notebooks.common_key())
    if not result.exists():
        notebooks.execute(path, result)
    assert time.perf_counter() - start < SLOWEST
    kept = [cell.outputs for cell in notebook(source, language).cells if cell.cell_type == "code"]
    if any(kept) and importlib.util.find_spec("pinocchio"):  # without it, comparisons are skipped
        anew = [cell.outputs for cell in nbformat.read(result, as_version=4).cells if cell.cell_type == "code"]
        for ours, theirs in zip(kept, anew, strict=True):
            if [execute.VARIES[language]] != [output.get("text") for output in ours]:
                assert_alike(ours, list(map(execute.small, theirs)))


def assert_alike(kept, anew):
    """The same outputs: the same words, and the same numbers but for rounding. Pictures are not compared."""
    assert [sorted(output.get("data", ())) for output in kept] == [sorted(output.get("data", ())) for output in anew]
    number = r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?"
    for one, other in zip(kept, anew):
        (words, numbers), (their_words, their_numbers) = (
            (re.sub(rf"\s*{number}", "#", text), [float(x) for x in re.findall(number, text)])
            for text in (plain(one), plain(other))
        )
        assert words == their_words
        assert numbers == pytest.approx(their_numbers, rel=1e-3, abs=1e-9)


def plain(output):
    """The text of an output."""
    return output.get("text") or output.get("data", {}).get("text/plain", "")
