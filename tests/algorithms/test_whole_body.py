"""All terms of the equation of a floating base in one call."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw

from ..robots import shared

GO2 = shared("go2")


def test_dynamics_returns_what_the_separate_functions_do():
    rng = np.random.default_rng(2)
    q, v = GO2.random_configuration(rng=rng), rng.standard_normal(18)
    d = tw.dynamics(GO2, q, v)
    assert (tw.crba(GO2, q) == d.M).all()
    assert (d.h == tw.nonlinear_effects(GO2, q, v)).all()
    assert (d.J_c == tw.contact_jacobian(GO2, q, GO2.feet)).all()
    assert (tw.centroidal_map(GO2, q) == d.A_G).all()
    two = tw.dynamics(GO2, q, v, contacts=["FR_foot", "base"])
    assert (two.J_c == tw.contact_jacobian(GO2, q, ["FR_foot", "base"])).all()


@pytest.mark.parametrize("wanted", [[], ["h"], ("M", "A_G"), {"J_c"}], ids=str)
def test_dynamics_returns_what_is_wanted_and_nothing_else(wanted):
    d = tw.dynamics(GO2, GO2.standing(), np.zeros(18), want=wanted)
    for name in ("M", "h", "J_c", "A_G"):
        assert (getattr(d, name) is not None) == (name in wanted)
