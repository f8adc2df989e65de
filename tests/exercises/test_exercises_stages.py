"""Help in stages: first where it is wrong and what kind of slip it is; which slip and the cure on request, counted."""

import json

import pytest

from misstep.checked import Checked, ladder
from misstep.errors import CourseError
from misstep.grading import grade
from misstep.judge import judge
from misstep.sheets import as_csv
from misstep.workbook import Workbook
from twistwrench.cli import main
from twistwrench.exercises import check, hint, start
from twistwrench.exercises.chapter import COURSE
from twistwrench.exercises.slips import SLIPS

ACT = "return R @ x - p"


def act(R, p, x):
    return R @ x - p


def write(folder, body, name="act", section="49.0"):
    """Write the body of a function into a started folder."""
    file = folder / COURSE.file_name(section)
    before, found, after = file.read_text(encoding="utf-8").partition(f"def {name}(")
    file.write_text(before + found + after.replace("return ...", body, 1), encoding="utf-8")


@pytest.fixture
def folder(tmp_path, no_other_process):
    start(tmp_path, language="en")
    write(tmp_path, ACT)
    return tmp_path


def test_the_first_message_has_the_place_and_the_kind_and_each_level_adds_to_it():
    slip = SLIPS["translation-sign"]
    first, second, third = (judge(*COURSE.find_part("act"), act).message("en", level) for level in (1, 2, 3))
    assert "Kind of slip: sign." in first
    assert "Wrong in " in first
    assert slip.title.en not in first
    assert slip.title.en in second
    assert "in place of" not in second
    assert "`R @ x + p` in place of `R @ x - p`" in third
    for language, kind in (("en", "Kind of slip: sign."), ("zh", "错误类型：符号。")):
        assert kind in judge(*COURSE.find_part("act"), act).message(language)


def thrice(R, p, x):
    return R @ x + 3 * p


def test_an_answer_that_is_not_in_the_list_has_its_line_second_and_the_cure_last():
    found = judge(*COURSE.find_part("act"), thrice)
    assert found.how == "line"
    assert [bool(x) for x in (found.lines, found.help, found.cure)] == [True] * 3
    assert "`" not in found.message("en", level=2).replace("`case`", "")
    assert "3 * p" in found.message("en", level=3)


@pytest.mark.parametrize("name", ["time_ratio", "forward_dynamics_two_ways", "arc", "torques_two_ways", "on_all_rows"])
def test_the_hints_are_those_of_the_function(name):
    """Others of the same exercise are about other things: clocks, a matrix, S."""
    exercise, part = COURSE.find_part(name)
    others = {x for other in exercise.parts if other is not part for x in other.hints}
    assert part.hints
    assert not {*part.hints} & others
    assert "machine" not in COURSE.find_part("forward_dynamics_two_ways")[1].hints[0].en


def test_hints_of_a_wrong_answer_begin_with_the_slip_and_end_with_the_cure(folder):
    _, part = COURSE.find_part("act")
    n = len(part.hints) + 2
    said = [hint("act", folder) for _ in range(n)]
    assert [x.splitlines()[0] for x in said] == [f"49.0.2 act: hint {k} of {n}" for k in range(1, n + 1)]
    assert SLIPS["translation-sign"].title.en in said[0].replace("\n", " ")
    assert "in place of" in said[-1]
    assert hint("act", folder, again=True) == said[-1] == hint("act", folder)
    write_again = (folder / "ex_49_0.py").read_text(encoding="utf-8").replace(ACT, "return R.T @ x + p")
    (folder / "ex_49_0.py").write_text(write_again, encoding="utf-8")
    assert SLIPS["rotation-transposed"].title.en in hint("act", folder).replace(
        "\n", " "
    )  # another slip: from its start


def test_what_was_asked_for_is_counted_for_each_function(folder, monkeypatch):
    (before,) = grade(COURSE, [folder], only=["49.0.2"], jobs=1)
    assert before.marks["49.0.2"].hints == {"act": 0}
    hint("act", folder)
    monkeypatch.chdir(folder)
    assert check("49.0.2", act, level=2, language="en", time_limit=0).hints["act"] == 1  # the same slip, not again
    assert check("49.0.2", act, level=3, language="en", time_limit=0).hints["act"] == 2
    (after,) = grade(COURSE, [folder], only=["49.0.1", "49.0.2"], jobs=1)
    rows = {row.split(",")[2]: row.split(",")[6] for row in as_csv([after], 0, "en").splitlines()}
    assert (rows["act"], rows["skew"]) == ("2", "0")


@pytest.mark.slow
def test_pytest_counts_the_level(folder, capfd):
    pytest.main(["-p", "no:cacheprovider", "-k", "act", "--level", "2", "--rootdir", str(folder), str(folder)])
    assert SLIPS["translation-sign"].title.en in capfd.readouterr().out.replace("\n", " ")
    assert Workbook(COURSE, folder).hints(COURSE.exercise("49.0.2")) == {"act": 1}


def test_an_instructor_can_leave_the_cure_out(tmp_path, monkeypatch, no_other_process):
    assert main(["exercises", "start", str(tmp_path), "--language", "en", "--no-cure"]) == 0
    write(tmp_path, ACT)
    assert json.loads((tmp_path / ".twistwrench.json").read_text(encoding="utf-8"))["cure"] is False
    assert "in place of" not in hint("act", tmp_path, every=True)
    monkeypatch.chdir(tmp_path)
    found = check("49.0.2", act, level=3, language="en", time_limit=0)
    assert found.verdicts["act"].cure
    assert "in place of" not in repr(found) + found._repr_html_()


def test_a_cell_folds_what_can_be_asked_for():
    found = check("49.0.2", act, language="en", time_limit=0)
    texts = ladder(found.exercise.part("act"), found.verdicts["act"], 3)
    html = found._repr_html_()
    assert html.count("<details><summary>hint ") == len(texts)
    assert (
        html.index("Kind of slip: sign.") < html.index("<details><summary>hint 1") < html.index("the translation has")
    )
    assert isinstance(found, Checked)


def test_there_is_no_fourth_level():
    with pytest.raises(CourseError, match=r"level: expected one of \(1, 2, 3\), got 4"):
        check("49.0.2", act, level=4)
