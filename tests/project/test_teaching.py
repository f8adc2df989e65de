"""The teacher's pages: plans that add up to ninety minutes, rubrics that add up to their points, slides, Gradescope."""

import json
import re
import shutil
import subprocess
import sys
import tomllib

import nbformat
import pytest

import twistwrench as tw
from twistwrench.exercises.asking import SECTIONS as ASKED
from twistwrench.exercises.asking import questions
from twistwrench.exercises.pencil import SECTIONS

from ..pages import DOCS, FENCE, names_author_and_licence, page

ROOT = DOCS.parent
sys.path.insert(0, str(DOCS))

SUFFIXES = {"en": "", "zh": ".zh-CN"}
LANGUAGES = list(SUFFIXES)


def sections(name: str, language: str) -> dict[str, str]:
    """What stands under each section of a page, by its number."""
    text = page(name, SUFFIXES[language]).read_text(encoding="utf-8")
    return dict(re.findall(r"^## (49\.\d+) [^\n]*\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL))


@pytest.mark.parametrize("name", ["teaching", "exam"])
def test_both_languages_name_the_author_and_have_every_section(name):
    for language, suffix in SUFFIXES.items():
        assert names_author_and_licence(page(name, suffix))
        assert tuple(sections(name, language)) == SECTIONS


# ---------------------------------------------------------------- the board


def rows(text: str) -> list[list[str]]:
    """The rows of a plan: minutes, board, question, what is shown."""
    cells = [re.split(r"(?<!\\)\|", line.strip("|")) for line in text.splitlines() if re.match(r"\| \d", line)]
    return [[cell.strip() for cell in row] for row in cells]


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_plan_fills_ninety_minutes(language):
    for section, text in sections("teaching", language).items():
        times = [tuple(map(int, row[0].split("–"))) for row in rows(text)]
        assert times[0][0] == 0, section
        assert times[-1][1] == 90, section
        assert [end for _, end in times[:-1]] == [start for start, _ in times[1:]], section
        assert all(len(row) == 4 and all(row) for row in rows(text)), section


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_plan_names_what_there_is(language):
    known = {name for section in ASKED for name in questions(section)}
    cards = {
        tomllib.loads(path.read_text(encoding="utf-8"))["title"][language]
        for path in (DOCS / "website" / "hands").glob("*.toml")
    }
    for section, text in sections("teaching", language).items():
        assert set(re.findall(r"`(49\.\d+-\w+)`", text)) <= known, section
        assert all(1 <= int(k) <= 10 for k in re.findall(r"(?:pencil|纸笔题) (\d+)", text)), section
        assert {name for row in rows(text) for name in re.findall(r"(?<![\w*])\*([^*]+)\*(?!\w)", row[3])} <= cards, (
            section
        )


def test_both_languages_plan_the_same():
    for section in SECTIONS:
        en, zh = (sections("teaching", language)[section] for language in LANGUAGES)
        for pattern in (r"^\| (\d+–\d+)", r"`([^`]+)`", r"(?:exercise|练习) (49\.\d+\.\d)"):
            assert re.findall(pattern, en, re.MULTILINE) == re.findall(pattern, zh, re.MULTILINE), (section, pattern)
        assert re.findall(r"pencil (\d+)", en) == re.findall(r"纸笔题 (\d+)", zh), section


def test_a_plan_uses_the_questions_of_its_own_section():
    for section, text in sections("teaching", "en").items():
        found = re.findall(r"`(49\.\d+)-\w+`", text)
        assert set(found) <= {section}
        assert len(found) >= 3 or section == "49.0", section


# ---------------------------------------------------------------- the exam


QUESTION = re.compile(
    r"^### (49\.\d+[a-c]) [^\n]*?[(（](\d+) ?(?:points|分)[)）]\n(.*?)(?=^### |\Z)", re.MULTILINE | re.DOTALL
)


def asked(language: str) -> dict[str, tuple[int, list[int]]]:
    """For each question of the exam its points, and those of the rows of its rubric."""
    found = {}
    for section, text in sections("exam", language).items():
        for name, points, body in QUESTION.findall(text):
            assert name[:-1] == section
            assert re.search(r"^\*(?:Usual wrong sentence|常见的错误说法)[:：]\*", body, re.MULTILINE), name
            found[name] = int(points), [int(row) for row in re.findall(r"^\| (\d+) \|", body, re.MULTILINE)]
    return found


def test_a_rubric_adds_up_and_both_languages_have_the_same():
    en, zh = map(asked, LANGUAGES)
    assert en == zh
    assert [name for name, (points, parts) in en.items() if points != sum(parts)] == []
    assert all(2 <= sum(name[:-1] == section for name in en) <= 3 for section in SECTIONS)


def test_what_the_exam_says_of_the_trot_and_of_m_is_so():
    facts = tw.ask("49.10-shift").facts
    assert round(facts["truth"] / facts["weight"]) == 9
    between_legs = 4 * 3 * 3 * 3
    assert f"{between_legs} of Go2's 324" in page("exam").read_text(encoding="utf-8")


# ---------------------------------------------------------------- slides


def tool():
    pytest.importorskip("markdown_it", reason="the docs extra is not installed: no slides")
    pytest.importorskip("mdit_py_plugins", reason="the docs extra is not installed: no slides")
    import slides

    return slides


@pytest.mark.parametrize("language", LANGUAGES)
def test_slides_show_every_question_and_picture_and_no_assert(language):
    for path in sorted((ROOT / "notebooks" / language).glob("49_0[67]*.ipynb")):
        notebook = nbformat.read(path, as_version=4)
        found = tool().slides(notebook)
        everything = "".join(found)
        asks = [cell for cell in notebook.cells if cell.cell_type == "code" and "tw.ask(" in cell.source]
        assert sum('class="tw-check tw-ask"' in slide for slide in found) == len(asks)
        outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
        pictures = sum("image/" in " ".join(output.get("data", {})) for output in outputs)
        assert everything.count("<img") + everything.count("<figure") == pictures
        assert "<summary>" in everything
        seen = re.sub(r"<details>.*?</details>", "", everything, flags=re.DOTALL)
        assert "# Set-up" not in seen
        assert "# 准备" not in seen
        assert not re.search(r"^(?:<[^>]*>)*assert\b", seen, re.MULTILINE)
        assert len(found) > 25


@pytest.mark.slow
def test_slides_need_no_network(tmp_path):
    pytest.importorskip("sphinx-mathjax-offline", reason="the docs extra is not installed: no MathJax")
    if tool().main(["49_07", "--out", str(tmp_path)]):
        raise AssertionError
    (written,) = tmp_path.rglob("*.html")
    html = written.read_text(encoding="utf-8")
    assert not re.search(r"""(?:src|href)=["'](?!data:|#)""", html.partition("<script>")[0])
    assert len(html) > 2e6  # MathJax is inside
    beside = tool().page(ROOT / "notebooks" / "zh" / "49_07_aba.ipynb", "zh", "../mathjax.js")
    assert beside.rstrip().endswith('<script src="../mathjax.js"></script>')


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("chromium") is None, reason="chromium is not installed: nothing is printed")
def test_printing_gives_a_page_for_each_slide(tmp_path):
    pytest.importorskip("sphinx-mathjax-offline", reason="the docs extra is not installed: no MathJax")
    tool().main(["49_07", "--out", str(tmp_path)])
    (written,) = tmp_path.rglob("*.html")
    command = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=20000"]
    command += [
        f"--user-data-dir={tmp_path / 'profile'}",
        f"--print-to-pdf={tmp_path / 'slides.pdf'}",
        written.as_uri(),
    ]
    subprocess.run(command, check=True, capture_output=True, timeout=120)
    pages = re.findall(rb"/Type\s*/Page\b", (tmp_path / "slides.pdf").read_bytes())
    assert len(pages) == written.read_text(encoding="utf-8").count('<section><div class="fit">')


def test_formulas_of_slides_stay_tex_and_links_become_words():
    html = tool().text(r"Take $a_i < b$ from [Felt mass](../hands/felt.md):" "\n\n$$\nF = m a\n$$\n")
    assert r"\(a_i &lt; b\)" in html
    assert r"\[" in html
    assert "<em>Felt mass</em>" in html
    assert "href" not in html


# ---------------------------------------------------------------- Gradescope


def results(language: str) -> str:
    text = page("instructors", SUFFIXES[language]).read_text(encoding="utf-8")
    return next(block for block in FENCE.findall(text) if "results.json" in block)


def test_the_results_for_gradescope_are_those_of_the_csv(tmp_path):
    (tmp_path / "results").mkdir()
    (tmp_path / "results.py").write_text(results("en"), encoding="utf-8")
    submission = tmp_path / "submission"
    submission.mkdir()
    right, wrong = (
        "import numpy as np\n\n\ndef skew(w):\n    return np.cross(np.eye(3), w)\n",
        "def act(R, p, x):\n    return R @ x - p\n",
    )
    (submission / "ex_49_0.py").write_text(f"{right}\n\n{wrong}", encoding="utf-8")
    grade = [sys.executable, "-m", "twistwrench", "exercises", "grade", "submission", "--csv", "marks.csv"]
    for command in ([*grade, "--only", "49.0.1", "49.0.2", "49.0.3"], [sys.executable, "results.py"]):
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    tests = json.loads((tmp_path / "results" / "results.json").read_text(encoding="utf-8"))["tests"]
    marks = {test["name"]: (test["score"], test["max_score"]) for test in tests}
    assert marks == {"49.0.1 skew": (1, 1), "49.0.2 act": (0, 1), "49.0.3 adjoint": (0, 1)}
    assert all(test["output"] for test in tests)


def test_gradescope_says_which_files_were_found(tmp_path):
    for folder in ("results", "submission"):
        (tmp_path / folder).mkdir()
    (tmp_path / "results.py").write_text(results("en"), encoding="utf-8")
    (tmp_path / "submission" / "final.py").write_text("def skew(w):\n    return w\n", encoding="utf-8")
    grade = [sys.executable, "-m", "twistwrench", "exercises", "grade", "submission", "--csv", "marks.csv"]
    for command in ([*grade, "--only", "49.0.1"], [sys.executable, "results.py"]):
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    assert "final.py" in json.loads((tmp_path / "results" / "results.json").read_text(encoding="utf-8"))["output"]


def test_both_languages_give_gradescope_the_same():
    en, zh = (re.sub(r"  # .*", "", results(language)) for language in LANGUAGES)
    assert en == zh
