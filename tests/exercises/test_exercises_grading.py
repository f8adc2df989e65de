"""A class is graded: each folder by itself, points for each function, and what was used to get there."""

import csv
import io
import re
from xml.etree import ElementTree

import pytest

import twistwrench as tw
from twistwrench.cli import main
from twistwrench.exercises import catalogue, hint, solution, start
from twistwrench.exercises.course.grading import grade
from twistwrench.exercises.course.sheets import as_csv, as_html, as_junit, as_table
from twistwrench.exercises.folder import skeletons

from .test_exercises_isolation import write

FOUR = ["49.0.1", "49.0.2", "49.6.3", "49.3.3"]


@pytest.fixture(scope="module")
def room(tmp_path_factory):
    folder = tmp_path_factory.mktemp("class")
    for name in ("ada", "bela", "chen", "dora", "emil"):
        start(folder / name, language="zh" if name == "chen" else "en")
    for section in ("49.0", "49.3", "49.6"):
        file = folder / "ada" / catalogue.file_name(section)
        file.write_text(skeletons.solved(section, "en"), encoding="utf-8")
    write(folder / "bela", "49.0", {"skew": "while True:\n    pass", "act": "return R @ x + p"})
    body = "import os\nos._exit(0)"
    write(folder / "chen", "49.0", {"skew": body, "act": "return R @ x - p"}, more='\nanswer_49_0_3 = "=1+1 <b>"\n')
    by_rnea = "return tw.rnea(model, q, np.zeros(model.nv), np.zeros(model.nv))[:6]"
    write(folder / "dora", "49.6", {"base_wrench_at_rest": by_rnea})
    write(folder / "dora", "49.0", {"skew": "return mine('skew')(w)"})
    hint("49.0.1", folder / "bela")
    hint("49.0.1", folder / "bela")
    solution("49.0.2", folder / "bela")
    (folder / "emil" / "ex_49_0.py").write_text("def broken(:\n", encoding="utf-8")
    (folder / "notes.txt").write_text("not a folder", encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def found(room):
    return grade([room], only=[*FOUR, "49.0.3"], seed=5, time_limit=1.5)


def test_each_student_has_the_points_of_what_is_right(found):
    points = {one.student: {number: mark.points for number, mark in one.marks.items()} for one in found}
    assert list(points) == ["ada", "bela", "chen", "dora", "emil"]
    assert set(points["ada"].values()) == {1}
    assert points["bela"] == {"49.0.1": 0, "49.0.2": 1, "49.0.3": 0, "49.3.3": 0, "49.6.3": 0}
    assert sum(points["chen"].values()) == sum(points["dora"].values()) == sum(points["emil"].values()) == 0


def test_a_part_of_an_exercise_gives_a_part_of_its_point(room, tmp_path):
    start(tmp_path / "one", language="en")
    half = "rest = np.zeros(18)\nreturn tw.rnea(tw.load('go2'), tw.load('go2').neutral(), rest, rest)[:6]"
    write(tmp_path / "one", "49.6", {"go2_base_wrench": half})
    (one,) = grade([tmp_path / "one"], only=["49.6.3"])
    assert one.points == 0.5


def test_the_rows_say_what_was_used_and_why_there_are_no_points(found):
    text = as_csv(found, 5, "en")
    assert text.startswith("\ufeff")
    rows = {(r["student"], r["function"]): r for r in csv.DictReader(io.StringIO(text.removeprefix("\ufeff")))}
    assert rows["bela", "skew"]["hints"] == "2"
    assert rows["bela", "skew"]["solution"] == "0"
    assert rows["bela", "act"]["solution"] == "1"
    assert rows["bela", "skew"]["reason"].startswith("It did not finish in 1.5 s")
    assert rows["chen", "skew"]["reason"] == "It ended the whole Python process."
    assert rows["chen", "act"]["slips"] == "translation-sign"
    assert "calls tw.rnea" in rows["dora", "base_wrench_at_rest"]["reason"]
    assert "that you are to write here" in rows["dora", "skew"]["reason"]
    assert "SyntaxError" in rows["emil", "act"]["reason"]
    assert rows["chen", "answer_49_0_3"]["words"] == "'=1+1 <b>"
    assert {row["seed"] for row in rows.values()} == {"5"}


def test_the_page_has_the_points_and_the_words_beside_the_model_answer(found):
    for language in ("en", "zh"):
        page = as_html(found, 5, language)
        model = catalogue.exercise("49.0.3").answer.of(language).strip().split("\n")[0]
        assert page.index(model[:20]) < page.index("=1+1 &lt;b&gt;")
        assert page.count("<details") == page.count("</details>")
        assert "<script" not in page
        links = re.findall(r'href="#([^"]+)"', page)
        assert len(links) == sum(
            any(v.state == "wrong" for v in m.verdicts.values()) for x in found for m in x.marks.values()
        )
        assert all(page.count(f'id="{link}"') == 1 for link in links)
    assert "--seed 5" in as_html(found, 5, "en")


def test_the_xml_has_the_name_of_the_student(found):
    root = ElementTree.fromstring(as_junit(found, 5, "en"))
    assert [suite.get("name") for suite in root] == ["ada", "bela", "chen", "dora", "emil"]
    bela = {case.get("name"): case for case in root[1]}
    assert {case.get("classname") for case in root[1]} == {"bela"}
    assert "It did not finish" in bela["49_0_1-skew"][0].text
    assert len(bela["49_0_2-act"]) == 0
    assert root[1].get("failures") == "1"


def test_the_command_writes_what_is_asked_for(room, tmp_path, capsys):
    files = [tmp_path / name for name in ("a.csv", "a.html", "a.xml")]
    command = ["exercises", "grade", str(room / "ada"), str(room / "dora"), "--only", "49.0.2", "--seed", "3"]
    for option, file in zip(("--csv", "--html", "--junit"), files, strict=True):
        command += [option, str(file)]
    assert main([*command, "--language", "en"]) == 0
    out = capsys.readouterr().out
    assert "ada      1.00 / 1" in out
    assert "--seed 3" in out
    assert all(file.stat().st_size > 100 for file in files)


def test_a_folder_without_exercises_is_a_line_and_not_an_end(room, tmp_path):
    (tmp_path / "late").mkdir()
    found = grade([tmp_path / "late", room / "ada"], only=["49.0.1"])
    assert [one.points for one in found] == [0, 1]
    assert "No exercises were found here" in as_table(found, 0, "en")


def test_what_is_not_there_is_an_error(room, tmp_path):
    with pytest.raises(tw.ModelError, match="expected the folder of a student"):
        grade([tmp_path / "nobody"])
    with pytest.raises(tw.NameNotFound, match="exercise or section"):
        grade([room], only=["49.60"])
