"""What runs in a page: cells as a notebook runs them, exercises as the shell checks them, and the files for it."""

import base64
import io
import json
import runpy
import sys
import threading
import zipfile
from pathlib import Path
from types import SimpleNamespace

import pytest

from twistwrench import exercises

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "docs"), str(ROOT / "docs" / "website" / "run")]

import classroom  # noqa: E402
import runtime  # noqa: E402
from website import inpage  # noqa: E402

if sys.platform != "emscripten":
    sys.path.remove(str(ROOT / "docs" / "website" / "run"))  # its IPython is for the page alone

TRANSPOSED = {"49.0.1": "def skew(w):\n    return tw.skew(w).T\n"}


@pytest.fixture(autouse=True)
def _no_traces(tmp_path, monkeypatch, no_other_process):
    monkeypatch.setattr(classroom, "ANSWERS", tmp_path / "answers")
    monkeypatch.setattr(classroom, "SPACES", {})
    classroom.OUTPUTS.clear()


def test_a_cell_prints_and_shows_its_last_value():
    assert classroom.run("print(1)\nx = 2\nx + 1", "page", "cell 1") == [("out", "1\n"), ("out", "3\n")]
    assert classroom.run("x;", "page", "cell 2") == classroom.run("None", "page", "cell 3") == []
    assert classroom.run("x", "other", "cell 1")[0][0] == "error"
    assert classroom.run(r"print('10 %\r', end=''); print('99 %\rdone')", "page", "cell 4") == [("out", "done\n")]


def test_a_value_is_shown_as_a_notebook_shows_it():
    shown = classroom.run("import twistwrench as tw\ntw.SE3.identity()", "page", "cell 1")
    assert [kind for kind, _ in shown] == ["latex"]
    assert [kind for kind, _ in classroom.run("tw.robots()", "page", "cell 2")] == ["html"]


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("def f():\n    return 1 / 0\nf()", 'File "cell 1", line 2, in f\n    return 1 / 0'),
        ("def f(:", 'File "cell 1", line 1\n    def f(:'),
        ("raise SystemExit(3)", "SystemExit: 3"),
    ],
)
def test_an_error_names_the_line_of_the_cell_and_none_of_ours(source, said):
    [(kind, text)] = classroom.run(source, "page", "cell 1")
    assert kind == "error"
    assert said in text
    assert "classroom.py" not in text


def test_a_package_that_can_be_had_is_asked_for_and_another_is_missing(monkeypatch):
    for name in ("sympy", "nowhere"):
        monkeypatch.setitem(sys.modules, name, None)
    assert classroom.run("import sympy", "page", "cell 1") == [("needs", "sympy")]
    assert classroom.run("import nowhere", "page", "cell 1")[0][0] == "error"


def test_a_figure_becomes_a_picture():
    pytest.importorskip("matplotlib").use("svg")
    outputs = classroom.run("import matplotlib.pyplot as plt\nplt.plot([1, 2]);", "page", "cell 1")
    assert [kind for kind, _ in outputs] == ["figure"]
    assert outputs[0][1].startswith("<svg")
    assert classroom.run("1;", "page", "cell 2") == []


@pytest.mark.one_case
@pytest.mark.parametrize(
    ("language", "slip"), [("en", "the skew-symmetric matrix is transposed"), ("zh", "反对称矩阵")]
)
def test_a_check_says_what_kind_of_slip_it_is_and_the_button_which(language, slip):
    [(kind, text)] = classroom.check("49.0.1", TRANSPOSED, "", language)
    assert kind == "wrong"
    assert {"en": "Kind of slip: sign.", "zh": "错误类型：符号。"}[language] in text
    assert slip not in text
    assert slip in classroom.hint("49.0.1", TRANSPOSED, "", language)[0][1].replace("\n", " ")
    assert "twistwrench exercises" not in text
    right = {"49.0.1": "def skew(w):\n    return np.cross(w, np.eye(3)).T\n"}
    assert classroom.check("49.0.1", right, "", language)[0][0] == "right"


@pytest.mark.parametrize("language", ["en", "zh"])
def test_lines_are_counted_from_the_first_one_of_the_answer(language):
    [(_, text)] = classroom.check("49.0.1", {"49.0.1": "def skew(w):\n    return w[7] * np.eye(3)\n"}, "", language)
    assert {"en": "line 2", "zh": "第 2 行"}[language] in text


def test_markdown_is_shown_as_far_as_the_notebooks_use_it():
    shim = runpy.run_path(str(ROOT / "docs" / "website" / "run" / "IPython" / "display.py"))
    table = shim["Markdown"]("| a | b |\n|---|--:|\n| `x<1` | 2 |")
    row = "<tr><td><code>x&lt;1</code></td><td>2</td></tr>"
    assert table._repr_html_() == f'<table class="table"><tr><th>a</th><th>b</th></tr>{row}</table>'
    assert shim["Markdown"]("one\ntwo")._repr_html_() == "<p>one<br>two</p>"
    shim["display"](table, 3)
    assert [kind for kind, _ in classroom.OUTPUTS] == ["html", "out"]
    classroom.OUTPUTS.clear()


def test_a_check_in_a_cell_needs_no_thread_in_a_browser(monkeypatch):
    def no_thread(*given):
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(sys, "platform", "emscripten")
    monkeypatch.setattr(threading.Thread, "start", no_thread)
    cell = "import twistwrench as tw\ndef act(R, p, x):\n    return R @ x + p\ntw.exercises.check('49.0.2', act)"
    assert [kind for kind, _ in classroom.run(cell, "page", "cell 1")] == ["html"]


def test_a_question_is_asked_and_judged_in_a_page():
    def shown(cell):
        ((kind, text),) = classroom.run(f"import twistwrench as tw\n{cell}", "page", "cell 1")
        assert kind == "html"
        return text

    assert "tw-to-do" in shown('tw.ask("49.7-knees", ...)')
    assert "tw-wrong" in shown('tw.ask("49.7-knees", "a", language="zh")')
    assert "tw-right" in shown('tw.ask("49.7-knees", "c")')


def test_hints_come_one_by_one_and_then_the_solution():
    state, texts = "", []
    for _ in range(3):
        texts.append(classroom.hint("49.0.1", {}, state, "en")[0][1])
        state = classroom.remembered()
    assert [text.splitlines()[0].partition(": ")[2] for text in texts] == ["hint 1 of 2", "hint 2 of 2", "a solution"]
    assert not any("twistwrench exercises" in text for text in texts)


def test_an_answer_runs_below_what_its_file_begins_with():
    answer = {"49.0.1": TRANSPOSED["49.0.1"] + "skew([1.0, 2.0, 3.0])[0, 1]"}
    assert classroom.try_out("49.0.1", answer, "", "en") == [("out", "np.float64(3.0)\n")]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_folder_is_that_of_the_shell_with_the_answers_in_their_places(tmp_path, language):
    exercises.start(tmp_path / "shell", language=language)
    content = io.BytesIO(base64.b64decode(classroom.archive(TRANSPOSED, "", language)))
    with zipfile.ZipFile(content) as archive:
        packed = {Path(name).name: archive.read(name).decode() for name in archive.namelist()}
    shell = {path.name: path.read_text(encoding="utf-8") for path in (tmp_path / "shell").iterdir()}
    assert set(packed) == set(shell)
    assert [name for name in shell if shell[name] != packed[name]] == ["ex_49_0.py"]
    assert TRANSPOSED["49.0.1"] in packed["ex_49_0.py"]
    assert "return ..." in packed["ex_49_0.py"]  # the other exercises of the section


def test_answers_are_read_back_from_the_folder():
    given = TRANSPOSED | {"49.4.1": "# nothing\nx = 1", "project.1": "def f():\n    return 1"}
    folder = classroom.folder(given, "", "en")
    files = {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}
    assert dict(classroom.answers(files)) == {number: answer.strip() for number, answer in given.items()}
    assert classroom.answers({"notes.txt": "mine"}) == []


if sys.platform == "emscripten":  # test_browser.py comes here

    @pytest.mark.parametrize("name", [path.stem for path in sorted((ROOT / "notebooks" / "en").glob("*.ipynb"))])
    def test_every_cell_of_a_notebook_runs_in_the_page(name):
        notebook = json.loads((ROOT / "notebooks" / "en" / f"{name}.ipynb").read_text(encoding="utf-8"))
        for k, cell in enumerate(cell for cell in notebook["cells"] if cell["cell_type"] == "code"):
            outputs = classroom.run("".join(cell["source"]), name, f"cell {k + 1}")
            failed = [text for kind, text in outputs if kind in ("error", "needs")]
            assert not failed, failed[0]


def test_what_is_unpacked_in_the_page_can_be_imported(tmp_path):
    with zipfile.ZipFile(io.BytesIO(inpage.package())) as archive:
        names = archive.namelist()
    assert {"classroom.py", "twistwrench/__init__.py", "twistwrench/models/go2.urdf"} <= set(names)
    assert not [name for name in names if name.endswith(".pyc")]
    assert inpage.package() == inpage.package()


def test_the_runtime_stands_beside_the_pages_where_it_was_gathered(tmp_path, monkeypatch):
    monkeypatch.setattr(inpage, "files", lambda: iter([("core", "a.gz", b"abc"), ("base", "b.zip", b"d")]))
    monkeypatch.setattr(runtime, "is_complete", lambda: True)
    inpage.write_runtime(tmp_path)
    written = (tmp_path / "runtime" / "a.gz.js").read_text()
    assert written == 'twistwrenchFile("a.gz","YWJj");\n'
    assert (tmp_path / "runtime" / "groups.js").read_text() == (
        'twistwrenchGroups({"core": [["a.gz", 4]], "base": [["b.zip", 4]]});\n'
    )
    monkeypatch.setattr(runtime, "is_complete", lambda: False)
    inpage.write_runtime(tmp_path)
    assert not (tmp_path / "runtime").exists()


@pytest.mark.parametrize("here", [True, False])
def test_a_page_says_whether_it_can_be_run(monkeypatch, here):
    monkeypatch.setattr(runtime, "is_complete", lambda: here)
    monkeypatch.setattr(inpage, "files", lambda: iter([("core", "a", bytes(3_000_000)), ("sympy", "b", bytes(10**7))]))
    handlers, scripts = [], []
    app = SimpleNamespace(connect=lambda event, handler: handlers.append(handler), add_js_file=scripts.append)
    inpage.connect(app, "en", ["00_first"])
    for page in ("chapter/00_first", "chapter/exercises", "errata", "00_first"):
        context = {"body": "<h1>Title</h1><p>Text</p>"}
        handlers[0](app, page, "page.html", context, None)
        runs = page.startswith("chapter")
        assert ("run-bar" in context["body"]) == runs
        assert ("docs/runtime.py" in context["body"]) == (not here and runs)
        assert ("(4 MB)" in context["body"]) == (here and runs)
        assert ('href="00_first.ipynb" download' in context["body"]) == (page == "chapter/00_first")
    assert scripts == ["run.js"] * 2 * here
