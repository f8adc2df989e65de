"""What `Simulation.step_error` says of one step is what SciPy's DOP853 finds."""

import pickle
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.simulation import METHODS
from twistwrench.spatial import quaternion_to_rotation

from ..robots import shared


class Example(NamedTuple):
    """A motion of docs/simulation.md or docs/control.md, or the beginning of it."""

    model: tw.Model
    q: np.ndarray
    v: np.ndarray
    dt: float
    tau: Callable | None = None
    dt_control: float | None = None
    contacts: tuple = ()


def rest(name, q, dt, **options):
    model = tw.load(name)
    return Example(model, np.array(q), np.zeros(model.nv), dt, **options)


def tumbling():
    inertia = tw.SpatialInertia(2.0, np.zeros(3), np.diag([1.0, 2.0, 3.0]))
    model = tw.Builder("body", base="floating", root_inertia=inertia, gravity=np.zeros(3)).build()
    return Example(model, model.neutral(), np.array([0.1, 2.0, 0.1, 0.5, 1.0, 0]), 0.02)


def raised():
    model = shared("pendulum")

    def tau(t, q, v):
        return tw.gravity(model, q) + 20.0 * (np.pi / 2 - q) - 6.0 * v

    return rest("pendulum", [0.0], 0.001, tau=tau, dt_control=0.01)


def cart_pole():
    def tau(t, q, v):
        return np.array([-4.0 * q[0] - 2.0 * v[0] + 3.0 * np.sin(q[1]), 0.0])

    return rest("cart_pole", [0.0, 2.5], 0.01, tau=tau)


def go2_on_its_feet():
    model = shared("go2")
    posture, feet = model.standing(), tuple(tw.PointContact(foot, 0.6) for foot in model.feet)
    hold = tw.static_equilibrium(model, posture).tau

    def tau(t, q, v):
        return np.r_[np.zeros(6), hold - 60.0 * (q[7:] - posture[7:]) - 1.0 * v[6:]]

    v = tw.impact(model, posture, np.array([0, 0, 0, 0.5, 0.3] + 13 * [0.0]), feet).v
    return Example(model, posture, v, 0.002, tau, contacts=feet)


EXAMPLES = {
    "pendulum": lambda: rest("pendulum", [2.0], 0.01),
    "damped pendulum": lambda: rest("pendulum", [2.0], 0.01, tau=lambda t, q, v: -0.5 * v),
    "double pendulum": lambda: rest("double_pendulum", [1.0, 0.5], 0.01),
    "arm": lambda: rest("planar_arm", [0.3, 0.6, 0.9], 0.005, tau=lambda t, q, v: np.sin(3 * t) - 0.2 * v),
    "tumbling body": tumbling,
    "pendulum that is raised": raised,
    "cart-pole": cart_pole,
    "Go2 on its feet": go2_on_its_feet,
}


def q_rate(model, q, v):
    """q̇, of a floating base by quaternions."""
    if model.base == "fixed":
        return v
    x, y, z, s = q[3:7]
    turn = np.array([[s, -z, y], [z, s, -x], [-y, x, s], [-x, -y, -z]]) @ v[:3] / 2
    return np.r_[quaternion_to_rotation(q[3:7] / np.linalg.norm(q[3:7])) @ v[3:6], turn, v[6:]]


def largest_error(motion, example, samples):
    """The largest error of the steps that `step_error` makes again, of q and of v."""
    integrate = pytest.importorskip("scipy.integrate", reason="SciPy is not installed")
    model, worst, nq = example.model, np.zeros(2), example.model.nq
    for k in np.unique(np.linspace(0, len(motion.tau) - 1, samples).astype(int)):

        def rates(t, x, k=k):
            q, v = model.normalize(x[:nq]), x[nq:]
            held = example.tau is None or example.dt_control is not None
            tau = motion.tau[k] if held else example.tau(t, q, v)
            if example.contacts:
                a = tw.contact_forward_dynamics(model, q, v, tau, example.contacts).qdd
            else:
                a = tw.fast.aba(model, q, v, tau)
            return np.r_[q_rate(model, x[:nq], v), a]

        times, start = (motion.t[k], motion.t[k] + example.dt), np.r_[motion.q[k], motion.v[k]]
        end = integrate.solve_ivp(rates, times, start, method="DOP853", rtol=1e-13, atol=1e-15).y[:, -1]
        off = model.difference(model.normalize(end[:nq]), motion.q[k + 1]), motion.v[k + 1] - end[nq:]
        worst = np.maximum(worst, [np.abs(x).max() for x in off])
    return worst


@pytest.mark.parametrize("method", ["euler", "semi-implicit", "midpoint", "rk4", "variational"])
@pytest.mark.parametrize("name", EXAMPLES)
def test_the_error_of_a_step_is_the_one_that_dop853_finds(name, method):
    example = EXAMPLES[name]()
    if example.contacts and not METHODS[method].contacts:
        pytest.skip("takes no contacts")
    options = {"tau": example.tau, "dt_control": example.dt_control, "contacts": example.contacts, "method": method}
    motion = tw.simulate(example.model, example.q, example.v, dt=example.dt, steps=20, **options)
    np.testing.assert_allclose(motion.step_error(5), largest_error(motion, example, 5), rtol=0.15, atol=2e-15)


def test_forces_that_were_held_are_held_again():
    calls = []

    def policy(t, q, v):
        calls.append(t)
        return -v

    motion = tw.simulate(shared("pendulum"), [1.0], [0.0], dt=0.01, steps=20, tau=policy, dt_control=0.02)
    asked = len(calls)
    error = motion.step_error()
    assert len(calls) == asked == 10
    assert 0 < max(error) < 1e-7


@pytest.mark.slow
def test_a_motion_and_an_error_under_a_lambda_leave_a_worker():
    """As a process does it: by a pickle, in which the policy stays behind."""

    def moved(gain):
        return tw.simulate(shared("pendulum"), [1.0], [0.0], dt=0.01, steps=2000, tau=lambda t, q, v: gain * v)

    with pytest.raises(tw.DivergenceError) as raised:
        moved(1e3)
    failed = pickle.loads(pickle.dumps(raised.value))
    assert str(failed) == str(raised.value)
    assert (failed.motion.q == raised.value.motion.q).all()
    motion = moved(-1.0)
    there = pickle.loads(pickle.dumps(motion))
    assert (there.q == motion.q).all()
    with pytest.raises(ValueError, match="policy"):
        there.step_error()
    assert "a step is off" in str(motion)
    assert "a step is off" not in str(there)
