"""Bounds of compiled programs in the cells of the extremes' grid: they hold, and the study counts it."""

import json

import numpy as np
import pytest
from study.__main__ import main as study_main
from study.extremes import grid
from study.extremes.bounds import Measured, counts, measured, shown
from study.extremes.robots import Recipe

pytest.importorskip("mpmath")

FEW = [Recipe(bodies=2, mass_ratio=1e3), Recipe(bodies=2, edge=-1e-3)]


def test_a_bound_below_an_error_is_found():
    good = Measured("tau", "float64", "usual", np.array([1.0, 0.0, 3.0]), np.array([2.0, 0.0, np.inf]))
    bad = Measured("tau", "float64", "odd", np.array([2.0]), np.array([1.9]))
    none = Measured("tau", "float64", "none", None, None)
    (found,) = counts([good, bad, none])
    assert [found[name] for name in ("cells", "raised", "entries", "held", "infinite")] == [3, 1, 4, 3, 1]
    assert (found["median"], found["worst"], found["broken"]) == (pytest.approx(1.475), 2.0, ["odd"])
    assert "does not hold: odd" in shown([found])
    noisy = bad._replace(noise=0.2)
    assert counts([noisy])[0]["held"] == 1


@pytest.mark.slow
def test_bounds_hold_in_a_few_cells(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(grid, "cells", lambda full: FEW)
    path = tmp_path / "bounds.json"
    assert study_main(["extremes", "--bounds", "--json", str(path)]) == 0
    found = json.loads(path.read_text(encoding="utf-8"))
    assert found["cells"] == len(FEW)
    assert len(found["bounds"]) == 8
    for one in found["bounds"]:
        assert one["held"] == one["entries"] > 0, one
        assert one["raised"] >= 1, one  # the robot that is not physical
        assert 1 <= one["median"] < 1.01, one
    assert "A_G       float32" in capsys.readouterr().out


@pytest.mark.slow
def test_bounds_hold_in_every_sixtieth_cell():
    recipes = [recipe for recipe in grid.cells(full=False) if recipe.bodies <= 10][::60]
    found = counts(one for recipe in recipes for one in measured(recipe))
    assert [one for one in found if one["broken"]] == []
    assert all(one["median"] < 30 for one in found)
