"""The step of a robot that stands is one program: the same motion as by the general step, whatever interrupts it."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw
from straightline.llvm import available
from twistwrench.simulation import sticking
from twistwrench.simulation.ground import GroundPoints
from twistwrench.simulation.stepping import TimeStepping

pytestmark = pytest.mark.skipif(not available(), reason="llvmlite is not installed: there is no machine code")

SLOPE = tw.Ground(height=0.3, normal=[0.0, np.sin(0.1), np.cos(0.1)])


def go2():
    model = tw.load("go2")
    return model, model.standing(), [tw.PointContact(foot, 0.6) for foot in model.feet]


def humanoid():
    model = tw.load("humanoid")
    soles = [tw.SurfaceContact(f"{side}_sole", (0.076, 0.0275), 0.6) for side in ("left", "right")]
    return model, model.standing(), soles


def on_slope():
    model, q, feet = go2()
    turn = np.array([-0.1, 0.0, 0.0])
    q = model.integrate(q, np.concatenate([turn, np.zeros(model.nv - 3)]))
    q[:3] = tw.exp3(turn) @ q[:3] + 0.301 * np.array(SLOPE.normal)
    return model, q, feet


CASES = {
    "Go2 that stands": (go2, tw.Ground(), 60.0, 2.0, 0.0),
    "Go2 that is pulled up": (go2, tw.Ground(), 60.0, 2.0, 260.0),
    "Go2 that lands on a slope": (on_slope, SLOPE, 60.0, 2.0, 0.0),
    "humanoid on its soles": (humanoid, tw.Ground(), 20.0, 0.02, 0.0),
}


def motion(case, steps=60):
    made, ground, kp, kd, lift = CASES[case]
    model, q, contacts = made()
    stands = model.standing()

    def tau(t, q, v):
        base = np.array([0, 0, 0, 0, 0, lift if 0.02 < t < 0.04 else 0.0])
        return np.concatenate([base, kp * (stands - q)[7:] - kd * v[6:]])

    return tw.simulate(model, q, np.zeros(model.nv), dt=1e-3, steps=steps, contacts=contacts, ground=ground, tau=tau)


@pytest.fixture
def counted(monkeypatch):
    """How many steps were the program's."""
    stood, stand = [], TimeStepping.stand

    def counting(self, *args):
        found = stand(self, *args)
        stood.append(found is not None)
        return found

    monkeypatch.setattr(TimeStepping, "stand", counting)
    return stood


@pytest.mark.parametrize(
    ("case", "least"),
    [
        pytest.param(case, least, marks=[pytest.mark.slow] * (case not in ("Go2 that is pulled up",)))
        for case, least in zip(CASES, (55, 10, 10, 40), strict=True)
    ],
)
def test_a_motion_is_the_same_whichever_step_makes_it(case, least, monkeypatch, counted):
    general = motion(case)
    assert not counted
    monkeypatch.setattr(sticking, "MIN_STEPS", 1)
    quick = motion(case)
    assert least <= sum(counted)
    assert sum(counted) < 60
    np.testing.assert_allclose(quick.q, general.q, rtol=0, atol=1e-11)
    np.testing.assert_allclose(quick.v, general.v, rtol=0, atol=1e-10)
    for frame, force in general.contact_forces.items():
        np.testing.assert_allclose(quick.contact_forces[frame], force, rtol=0, atol=1e-7)


def test_what_bounces_or_moves_with_its_ground_is_left_to_the_general_step(monkeypatch, counted):
    monkeypatch.setattr(sticking, "MIN_STEPS", 1)
    model, q, feet = go2()
    belt = [tw.PointContact(foot, 0.6, velocity=[0.1, 0, 0]) for foot in model.feet]
    rest = np.zeros(model.nv)
    for contacts, ground in ((feet, tw.Ground(restitution=0.2)), (belt, tw.Ground())):
        tw.simulate(model, q, rest, dt=1e-3, steps=3, contacts=contacts, ground=ground)
    assert not counted


@pytest.mark.one_case
@pytest.mark.parametrize("made", [go2, humanoid])
def test_heights_of_many_states_are_those_of_each(made):
    model, q, contacts = made()
    points = GroundPoints(model, contacts, SLOPE)
    rng = np.random.default_rng(2)
    many = np.stack([[model.integrate(q, 0.1 * rng.standard_normal(model.nv)) for _ in range(3)] for _ in range(2)])
    heights = points.height(many)
    assert heights.shape == (2, 3, len(points.mu))
    for k in np.ndindex(2, 3):
        np.testing.assert_allclose(heights[k], points.height(many[k]), rtol=0, atol=1e-15)
        np.testing.assert_allclose(heights[k], points.terms(many[k]).place[:, 2], rtol=0, atol=1e-14)
