"""The order of time stepping on a ground, by closed forms of a ball that slides and then rolls, and a box that tips."""

import numpy as np
import pytest

import twistwrench as tw

from ..mechanisms import G
from .test_ground import BOX, HALF, corners
from .test_spinning import ball

R, MU = 0.05, 0.2


def sliding_then_rolling(dt):
    """v₀ − μ g t until 2 v₀ / (7 μ g), and 5/7 v₀ from there."""
    touch, until = [tw.SphereContact("s", R, MU)], 2 / 7 / (MU * G)
    start, v = [0, 0, R, 0, 0, 0, 1], [0, 0, 0, 1.0, 0, 0]
    s = tw.simulate(ball(R), start, v, dt=dt, duration=0.4, contacts=touch, ground=tw.Ground())
    return s.q[-1, 0] - (until - MU * G * until**2 / 2 + 5 / 7 * (0.4 - until))


def tipping(dt):
    """About an edge, let go 0.1 rad beyond the balance: a pendulum, by Jacobi's elliptic functions."""
    special = pytest.importorskip("scipy.special", reason="SciPy is not installed")
    past, t, arm, corner = 0.1, 0.2, np.hypot(HALF[0], HALF[2]), np.arctan2(HALF[0], HALF[2])
    lean = past + corner
    start = [0, 0, arm * np.cos(past), 0, np.sin(lean / 2), 0, np.cos(lean / 2)]
    s = tw.simulate(BOX, start, np.zeros(6), dt=dt, duration=t, contacts=corners(1e6), ground=tw.Ground())
    about_edge = tw.SpatialInertia.from_box(2.0, 2 * HALF).inertia_at_com[1, 1] / 2.0 + arm**2
    m = np.cos(past / 2) ** 2  # of a pendulum that hangs, let go at π − 0.1
    sn = special.ellipj(special.ellipk(m) - np.sqrt(G * arm / about_edge) * t, m)[0]
    x, _, z = tw.frame_placement(BOX, s.q[-1], "box").rotation[:, 2]
    return np.arctan2(x, z) - corner - (np.pi - 2 * np.arcsin(np.cos(past / 2) * sn))


@pytest.mark.parametrize(("error", "size"), [(sliding_then_rolling, 0.15), (tipping, 1.5)])
def test_time_stepping_has_order_1(error, size):
    """In the error at the end, m or rad, which is below `size` times dt."""
    off = [abs(error(dt)) for dt in (0.004, 0.002, 0.001)]
    assert off[0] < size * 0.004
    assert np.log2(np.divide(off[:-1], off[1:])) == pytest.approx([1, 1], abs=0.1)
