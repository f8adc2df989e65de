"""The extremes: closed forms, no silent bad cell, a study that goes on where it stopped."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.study.extremes.robots import Recipe


@pytest.mark.parametrize("length", [1e-9, 1e-3, 1.0, 1e3])
def test_a_solver_s_choice_of_pivots_does_not_depend_on_units(length):
    """`fast.aba` of one state solved the base's 6 × 6 equations in kg and m: 2e-9 was lost where rotors are heavy."""
    recipe = Recipe(length=length, rotor=1e9)
    q, v, a = recipe.state
    tau = np.random.default_rng(0).standard_normal(12) * np.abs(tw.rnea(recipe.model, q, v, a))
    slow, fast = tw.aba(recipe.model, q, v, tau), tw.fast.aba(recipe.model, q, v, tau)
    assert np.abs(fast / slow - 1).max() < 1e-12
