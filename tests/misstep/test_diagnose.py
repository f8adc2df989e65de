"""What is wrong with a function is named: by a slip, by its own line, by a right solution, by what it returns."""

import numpy as np
import pytest

from misstep.calls import call_or_none
from misstep.diagnose import diagnose

from .functions import CENTER, FIELD, PROJECTILE, SPREAD, STIFFNESS, written


def diagnosis(tmp_path, part, text, **how):
    function = written(tmp_path, text)
    cases = list(part.cases(np.random.default_rng(1)))
    answers = [call_or_none(part, function, arguments) for arguments in cases]
    return diagnose(part, function, answers, cases, FIELD, **how)


def test_a_slip_of_the_list_is_named_with_its_reason_and_the_line(tmp_path):
    text = "def projectile(speed, angle, t):\n    fall = 9.81 * t**2 / 2\n"
    text += "    return np.array([speed * np.cos(angle) * t, speed * np.sin(angle) * t + fall])\n"
    found = diagnosis(tmp_path, PROJECTILE, text)
    assert (found.how, found.slips) == ("slip", ("falls-up",))
    assert "Kind of slip: sign." in [x.en for x in found.lines]
    assert "It pulls down" in found.help[0].en
    assert "ine 3" in found.cure[0].en
    assert "np.sin(angle) * t - fall" in found.cure[0].en


@pytest.mark.parametrize(
    ("part", "text", "line", "after"),
    [
        (
            PROJECTILE,
            "return np.array([speed * np.sin(angle) * t, speed * np.sin(angle) * t - 9.81 * t**2 / 2])",
            2,
            "cos",
        ),
        (PROJECTILE, "a = angle\nreturn t * np.array([speed * np.cos(a), speed * np.sin(a) - 9.81 * t])", 3, "/ 2"),
        (STIFFNESS, "return R.T @ K @ R", 2, "R @ K @ R.T"),
        (STIFFNESS, "turned = R @ K\nreturn turned @ R", 3, "R.T"),
        (CENTER, "c = 0\nfor a, p in zip(m, r):\n    c = a * p\nreturn c / sum(m)", 4, "added up"),
    ],
)
def test_the_line_that_is_wrong_is_named_with_what_makes_it_right(tmp_path, part, text, line, after):
    head = f"def {part.name}({part.arguments}):\n"
    found = diagnosis(tmp_path, part, head + "\n".join("    " + x for x in text.split("\n")) + "\n")
    said = " ".join(x.en for x in found.cure)
    assert found.how == "line"
    assert f"ine {line}" in said
    assert after in said
    assert f"line {line}" in found.help[0].en
    assert after not in found.message("en", level=2)


def test_a_helper_in_the_same_file_is_searched_as_well(tmp_path):
    text = "def fall(t):\n    return 9.81 * t / 2\n\n\ndef projectile(speed, angle, t):\n"
    text += "    return np.array([speed * np.cos(angle) * t, speed * np.sin(angle) * t - fall(t)])\n"
    found = diagnosis(tmp_path, PROJECTILE, text)
    assert found.how == "line"
    assert any("ine 2" in x.en or "ine 6" in x.en for x in found.cure)


def test_a_solution_without_source_is_compared_with_edits_of_a_right_one():
    cases = list(CENTER.cases(np.random.default_rng(2)))
    answers = [m @ r for m, r in cases]
    found = diagnose(CENTER, np.vdot, answers, cases, FIELD)
    assert found.how == "reference"
    assert "total / np.sum(m)" in found.cure[0].en


def test_each_of_several_results_is_explained_by_itself(tmp_path):
    text = "def mean_and_spread(x):\n    return -np.mean(x), np.std(x)\n"
    found = diagnosis(tmp_path, SPREAD, text)
    assert found.slips == ("divided-by-n",)
    assert [x.en.split(":")[0] for x in (*found.help, *found.cure)] == ["In spread", "In mean"]


def test_results_in_the_other_order(tmp_path):
    found = diagnosis(tmp_path, SPREAD, "def mean_and_spread(x):\n    return np.std(x, ddof=1), np.mean(x)\n")
    assert found.how == "structure"
    assert "mean and spread are exchanged" in found.lines[0].en


@pytest.mark.parametrize(
    ("body", "says"),
    [
        ("pass", "returned None"),
        ("return 1, 2", "shape"),
        ("return 'far'", "numbers"),
    ],
)
def test_what_shows_before_any_number_is_compared(tmp_path, body, says):
    text = f"def projectile(speed, angle, t):\n    {body}\n"
    function = written(tmp_path, text)
    function.__globals__["projectile"] = PROJECTILE.solution
    cases = list(PROJECTILE.cases(np.random.default_rng(1)))
    if says == "shape":
        answers = [np.zeros(3)] * len(cases)
    else:
        answers = [call_or_none(PROJECTILE, function, arguments) for arguments in cases]
    found = diagnose(PROJECTILE, function, answers, cases, FIELD, search_code=False)
    assert found.how == "structure"
    assert says in found.lines[0].en


def test_numbers_from_nowhere_are_only_compared(tmp_path):
    found = diagnosis(tmp_path, PROJECTILE, "def projectile(speed, angle, t):\n    return np.array([0.123, 4.5])\n")
    assert found.how in ("numbers", "located")
    assert not found.slips


def test_a_change_must_hold_in_the_special_cases(tmp_path):
    text = "def center(m, r):\n    return np.mean(r, axis=0)\n"
    cases = [(np.ones(n), np.arange(3.0 * n).reshape(n, 3) + 0.5) for n in (2, 4)]
    function = written(tmp_path, text)
    answers = [function(*c) + 1 for c in cases]
    other = [(np.array([1.0, 3.0]), np.eye(3)[:2])]
    found = diagnose(CENTER, function, answers, cases, FIELD, special_cases=lambda: other)
    assert found.how != "slip"


def test_the_same_answer_gives_the_same_diagnosis(tmp_path):
    text = "def stiffness(K, R):\n    return R.T @ K @ R\n"
    assert diagnosis(tmp_path, STIFFNESS, text) == diagnosis(tmp_path, STIFFNESS, text)
