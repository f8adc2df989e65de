"""The failing case is handed over: its inputs, expected and got, and a line that makes it again."""

import subprocess
import sys

import numpy as np
import pytest

import twistwrench as tw
from misstep.cases import cases
from misstep.errors import CourseError
from misstep.judge import judge
from twistwrench.cli import main
from twistwrench.errors import NameNotFound
from twistwrench.exercises import case, start
from twistwrench.exercises.chapter import COURSE

from ..sampling import sampled
from .test_exercises_isolation import said, write

PARTS = [part for number in COURSE.numbers for part in COURSE.exercise(number).parts]


def verdict(name, function, **how):
    return judge(*COURSE.find_part(name), function, **how)


def test_the_case_is_the_first_wrong_one_and_can_be_made_again():
    def wrong_where_x_is_positive(R, p, x):
        return R @ x + p * (1 if x[0] < 0 else 1.001)

    for seed in range(5):
        found = verdict("act", wrong_where_x_is_positive, seed=seed).case
        tried = cases(COURSE.find_part("act")[1], seed)
        assert found.number == [x[0] < 0 for _, _, x in tried].index(False)
        for (name, shown), again, argument in zip(
            found.inputs, case("act", found.number, seed=seed), tried[found.number], strict=True
        ):
            assert name in ("R", "p", "x")
            assert np.array_equal(shown, again)
            assert np.array_equal(shown, argument)


def test_the_line_for_a_cell_runs_and_fails_in_the_same_way():
    answer = verdict("act", lambda R, p, x: R @ x - p, seed=4)
    names = {"tw": tw}
    exec(answer.case.cell, names)  # as the student pastes it
    (compared,) = answer.case.compared
    assert np.array_equal(names["R"] @ names["x"] - names["p"], compared.got)
    assert np.array_equal(names["R"] @ names["x"] + names["p"], compared.expected)


def test_the_line_for_a_shell_prints_the_same_numbers(capsys):
    answer = verdict("act", lambda R, p, x: R @ x - p, seed=4)
    assert main(answer.case.shell.split()[1:]) == 0
    printed = capsys.readouterr().out
    assert repr(float(answer.case.inputs[1][1][0])) in printed
    right = printed.split("x_A = array(")[1].split("]")[0].strip("[")
    np.testing.assert_array_equal([float(x) for x in right.split(",")], answer.case.compared[0].expected)


def test_what_differs_is_marked():
    def wrong(model, q, v, a):
        tau = tw.rnea(model, q, v, a)
        return tau, np.concatenate([tau[:4], tau[4:5] + 1, tau[5:]])

    found = verdict("torques_two_ways", wrong).case
    first, second = found.compared
    assert first.is_right
    assert np.argwhere(second.wrong).tolist() == [[4]]
    text = found.text("en")
    assert text.count("[") - text.count("[..]") >= 1
    assert "应为" in found.text("zh")


@pytest.mark.slow
def test_a_large_block_lists_its_first_wrong_entries():
    found = verdict("mass_matrix_by_rnea", lambda model, q: tw.crba(model, q) + 1).case
    assert "more entries differ" in found.text("en") or len(found.text("en").splitlines()) < 60


@pytest.mark.slow
def test_a_number_by_hand_is_not_given_away():
    by_hand = [part for part in PARTS if not part.arguments]
    assert by_hand
    for part in by_hand:
        exercise = COURSE.find_part(part.name)[0]
        answer = tuple(1e9 for _ in part.returns)
        found = judge(exercise, part, lambda answer=answer: answer if len(answer) > 1 else answer[0])
        assert found.state == "wrong"
        assert found.case.compared == ()
        assert found.report("en") == found.message("en")


@pytest.mark.parametrize("part", sampled(PARTS, 12), ids=lambda part: part.name)
def test_every_slip_hands_its_case_over_on_a_screen(part):
    slip = next(iter(part.slips))
    found = judge(COURSE.find_part(part.name)[0], part, part.slips[slip], seed=3)
    for language in ("en", "zh"):
        text = found.case.text(language)
        assert len(text.splitlines()) <= 60
        assert bool(text) == bool(part.arguments)


def test_a_case_that_is_not_there_is_an_error():
    with pytest.raises(CourseError, match=r"act has the cases 0 to \d+, got 1000"):
        case("act", 1000)
    with pytest.raises(NameNotFound, match="adjoint"):
        case("adjont")


@pytest.mark.slow
def test_an_exception_and_an_endless_loop_have_their_case_too(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {"act": "if x[0] > 0:\n    while True:\n        pass\nreturn R @ x + p"})
    first = next(k for k, (_, _, x) in enumerate(cases(COURSE.find_part("act")[1], 0)) if x[0] > 0)
    assert f"twistwrench exercises case act {first} --seed 0" in said(tmp_path, "act", seed=0)[1]
    assert verdict("act", lambda R, p, x: x[9], seed=2).case.shell.endswith("act 0 --seed 2")


def test_a_measurement_of_too_few_calls_is_not_shown_as_a_number():
    found = verdict("time_ratio", lambda first, second, calls, clock: 3.0 + 0 * clock())
    assert "are not called `calls` times" in found.message("en", level=2)
    assert found.case.compared == ()


@pytest.mark.slow
def test_pytest_draws_its_cases_anew_and_prints_the_seed(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {"act": "return R @ x - p"})

    def seed(*more):
        command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-k", "act", *more]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
        assert "In a shell:  twistwrench exercises case act 0 --seed" in done.stdout
        return done.stdout.split("The same random cases again: python -m pytest --seed ")[1].split()[0]

    assert seed() != seed()
    assert seed("--seed", "7") == "7"
