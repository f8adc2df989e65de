"""What turns while it flies is pushed by nothing: closed forms of free bodies, by every method."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.simulation import METHODS
from twistwrench.simulation.straight import go_straight, in_turned_axes, straight_rate

from ..robots import shared

EXPLICIT = ("euler", "semi-implicit", "midpoint", "rk4")


def ball(gravity=(0.0, 0.0, 0.0)):
    """A ball of 1 kg and 0.1 m that floats freely."""
    inertia = tw.SpatialInertia.from_sphere(1.0, 0.1)
    return tw.Builder("ball", base="floating", root="ball", root_inertia=inertia, gravity=gravity).build()


@pytest.mark.one_case
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("direction", [(0, 0, 1), (1, 0, 0), (0.6, -0.48, 0.64)])
def test_a_spinning_ball_goes_straight_on(method, direction):
    model = ball()
    v = np.concatenate([35.0 * np.array(direction), [3.5, 0.0, 0.0]])
    motion = tw.simulate(model, model.neutral(), v, dt=4e-3, duration=2.0, method=method)
    np.testing.assert_allclose(np.linalg.norm(motion.v[:, 3:], axis=-1), 3.5, rtol=1e-12)
    np.testing.assert_allclose(motion.q[-1, :3], [7.0, 0, 0], rtol=0, atol=1e-11)


@pytest.mark.one_case
@pytest.mark.parametrize("method", METHODS)
def test_a_spinning_puck_goes_straight_on(method):
    builder = tw.Builder("ice", base="fixed", gravity=(0, 0, 0))
    builder.link("puck", parent="base_link", joint=tw.Planar(), inertia=tw.SpatialInertia.from_sphere(1.0, 0.1))
    model = builder.build()
    motion = tw.simulate(model, model.neutral(), [1.0, 0, 20.0], dt=5e-3, duration=2.0, method=method)
    np.testing.assert_allclose(np.hypot(*motion.v[-1, :2]), 1.0, rtol=1e-12)
    np.testing.assert_allclose(motion.q[-1, :2], [2.0, 0.0], rtol=0, atol=1e-12)


@pytest.mark.parametrize("method", EXPLICIT)
def test_a_spinning_ball_falls_on_a_parabola(method):
    """To the order of the method: Euler's two are off by g t dt / 2, the others by nothing."""
    model, g, dt, t = ball((0.0, 0.0, -10.0)), 10.0, 5e-3, 1.0
    motion = tw.simulate(model, model.neutral(), [0, 35.0, 0, 1.0, 0, 2.0], dt=dt, duration=t, method=method)
    late = {"euler": dt, "semi-implicit": -dt}.get(method, 0.0)
    np.testing.assert_allclose(motion.q[-1, :3], [t, 0, 2 * t - g * t * (t - late) / 2], rtol=0, atol=1e-11)


@pytest.mark.parametrize("method", METHODS)
def test_the_order_of_a_tumbling_body_is_the_methods(method):
    """Its frame is beside its centre of mass; the reference is SciPy's DOP853 in the world's axes."""
    integrate = pytest.importorskip("scipy.integrate", reason="SciPy is not installed")
    I, com = np.diag([0.02, 0.05, 0.06]), np.array([0.05, 0.02, -0.03])
    body = tw.SpatialInertia(1.3, com, I)
    model = tw.Builder("tumbling", base="floating", root="body", root_inertia=body).build()
    v, duration = np.array([3.0, 1, -2, 0.4, 0.3, 0.7]), 0.4

    def rates(t, y):
        """Euler's equations: of R and of ω in the body's axes."""
        R, w = y[:9].reshape(3, 3), y[9:]
        return np.concatenate([(R @ tw.skew(w)).ravel(), np.linalg.solve(I, -np.cross(w, I @ w))])

    start = np.concatenate([np.eye(3).ravel(), v[:3]])
    end = integrate.solve_ivp(rates, (0, duration), start, method="DOP853", rtol=1e-13, atol=1e-13).y[:9, -1]
    R = end.reshape(3, 3)
    at_com = com + duration * (v[3:] + np.cross(v[:3], com)) + np.array([0, 0, -9.81]) * duration**2 / 2
    place = at_com - R @ com

    def error(dt):
        motion = tw.simulate(model, model.neutral(), v, dt=dt, duration=duration, method=method)
        T = tw.frame_placement(model, motion.q[-1], "body")
        return max(np.abs(T.rotation - R).max(), np.abs(T.translation - place).max())

    slope = np.log2(error(0.02) / error(0.01))
    assert slope == pytest.approx(METHODS[method].order, abs=0.15)


def test_the_rate_of_a_straight_way_is_its_derivative():
    """What u + dt u̇ leads to is where v leads to from there, to the fourth order in u and the second in dt."""
    model = ball()
    rng = np.random.default_rng(1)
    q, v = model.random_configuration(rng=rng), rng.standard_normal(model.nv)
    u, dt = 0.04 * rng.standard_normal(model.nv), 1e-4
    there = go_straight(model, q, u)
    further, rate = dt * in_turned_axes(model, v, u), dt * straight_rate(model, u, v)
    ahead = model.difference(*(go_straight(model, there, s * further) for s in (-1, 1)))
    by_rate = model.difference(*(go_straight(model, q, u + s * rate) for s in (-1, 1)))
    assert np.abs(ahead - by_rate).max() < 1e-8 * 2 * dt  # without the second product 7e-5


def test_the_semi_implicit_method_keeps_the_energy_nearly_where_m_is_constant():
    """A pendulum, and a spinning ball on a spring: the error of the last swings is that of the first."""
    swings = tw.simulate(shared("pendulum"), [2.0], [0.0], dt=0.02, steps=4000, method="semi-implicit")
    model = ball()

    def spring(t, q, v):
        pull = tw.frame_placement(model, q, "ball").rotation.T @ (-40.0 * q[:3])
        return np.r_[0, 0, 0, pull]

    start = model.neutral() + np.r_[0.3, np.zeros(6)]
    flies = tw.simulate(model, start, [5.0, 20, 30, 0, 1, 0], dt=0.01, steps=1500, tau=spring, method="semi-implicit")
    stored = {"pendulum": swings.energy, "ball": flies.energy + 20.0 * (flies.q[:, :3] ** 2).sum(axis=-1)}
    for energy in stored.values():
        error, part = np.abs(energy - energy[0]), len(energy) // 5
        assert error[-part:].max() < 1.05 * error[:part].max()
