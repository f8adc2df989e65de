"""Programs against the textbook in many states of a cell: the errors are right, and a worse program is found."""

import json

import mpmath
import numpy as np
import pytest
from study.extremes import grid
from study.extremes.programs import Compared, compared, counts, medians, shown
from study.extremes.robots import Recipe
from study.extremes.truth import truth

import twistwrench as tw
from study import __main__ as command

SYMBOLS = {"rnea": "tau", "crba": "M", "centroidal map": "A_G", "aba, steered": "steered", "aba, pushed": "pushed"}


@pytest.mark.slow
def test_errors_against_32_digits_are_those_against_50():
    recipe = Recipe(bodies=2, mass_ratio=1e3)
    model, s = recipe.model, recipe.state
    with mpmath.workdps(50):
        right = truth(model, s)
        q, v, a, steered, pushed = (x[None] for x in (*s, right.torques["steered"], right.torques["pushed"]))
        answers = {
            "rnea": lambda by: by.rnea(model, q, v, a),
            "crba": lambda by: by.crba(model, q),
            "centroidal map": lambda by: by.centroidal_map(model, q),
            "aba, steered": lambda by: by.aba(model, q, v, steered),
            "aba, pushed": lambda by: by.aba(model, q, v, pushed),
        }
        found = list(compared(recipe, 1))
        assert [one.quantity for one in found] == [*answers]
        for one in found:
            for by, error in ((tw, one.textbook), (tw.fast, one.program)):
                expected = right.error(SYMBOLS[one.quantity], answers[one.quantity](by)[0])
                assert error[0] == pytest.approx(expected, rel=1e-2, abs=1e-18), (one.quantity, by)


def test_many_states_of_a_cell_are_different_and_the_first_is_that_of_the_maps():
    recipe = Recipe(bodies=3)
    assert all(np.array_equal(x, y) for x, y in zip(recipe.state, recipe.drawn(0), strict=True))
    assert not any((x == y).any() for x, y in zip(recipe.state, recipe.drawn(1), strict=True))


def test_a_robot_that_is_not_physical_has_no_errors():
    assert list(compared(Recipe(edge=-1e-3), 2)) == []


def test_a_program_that_rounds_worse_is_found():
    """Three times the textbook's error in every state; and states with the same bits do not hide it."""
    error, same = np.array([1e-16, 2e-16, 3e-16, 0.0]), np.array([False, False, False, True])
    fair = Compared("rnea", "usual", error, error[[1, 0, 2, 3]], same)
    worse = Compared("rnea", "odd", error, 3 * error, same)
    (found,) = counts([fair, worse])
    assert (found["cells"], found["states"], found["same"]) == (2, 6, 2)
    assert found["missed"] == ["odd"]
    assert found["above"] == pytest.approx(3 / 6)
    assert (found["cell_median"], found["cell_worst"]) == (pytest.approx(2.0), pytest.approx(3.0))
    assert "more than twice: odd" in shown([found])
    assert medians([worse]) == {"odd": {"rnea": [1.5e-16, 4.5e-16]}}


@pytest.mark.slow
def test_the_command_counts_and_writes(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(grid, "cells", lambda full: [Recipe(bodies=2), Recipe(bodies=100)])
    monkeypatch.setattr(command, "STATES", 20)
    path = tmp_path / "programs.json"
    assert command.main(["extremes", "--programs", "--json", str(path)]) == 0
    found = json.loads(path.read_text(encoding="utf-8"))
    assert found["states"] == 20
    assert [one["cells"] for one in found["counts"]] == [1] * 5
    assert set(found["cells"]) == {"bodies 2"}
    assert "centroidal map" in capsys.readouterr().out
