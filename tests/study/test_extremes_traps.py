"""The table at the head of docs/extremes.md: each row's number is computed here, another way than by reading it."""

import re
from fractions import Fraction

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench import newton_euler_3d as slow

from ..pages import page

BENT, STILL = np.linspace(0.1, 1, 10), np.zeros(10)


def off(got, expected):
    return np.abs(got - expected).max() / np.abs(expected).max()


def heavy_tip():
    model, pushed = tw.chain(10, mass_ratio=1e9), np.array([1.0, -1.0] * 5)
    with mpmath.workdps(50):
        right = slow.forward_dynamics(model, *(slow.as_mpmath(x) for x in (BENT, STILL, pushed))).astype(float)
    solved = np.linalg.solve(tw.crba(model, BENT), pushed - tw.nonlinear_effects(model, BENT, STILL))
    return off(solved, right), off(tw.aba(model, BENT, STILL, pushed), right)


def single():
    model, straight = tw.chain(64), np.zeros(64, np.float32)
    a = np.random.default_rng(0).standard_normal(64).astype(np.float32)
    tau = tw.rnea(model, straight, 0 * a, a)
    return off(tw.aba(model, straight, 0 * a, tau), tw.aba(model, *(x.astype(float) for x in (straight, 0 * a, tau))))


def in_the_world():
    go2, q = tw.load("go2"), tw.load("go2").standing()
    q[0] = 1e6
    placement, M = tw.forward_kinematics(go2, q).placement, np.diag(go2.armature)
    for i in range(1, go2.nbodies):
        J = tw.frame_jacobian(go2, q, go2.joint_names[i], "world")
        M = M + J.mT @ go2.inertia[i].transform(placement[i]).matrix() @ J
    right = tw.crba(go2, q)
    return np.abs((M - right) / np.sqrt(np.outer(np.diag(right), np.diag(right)))).max()


def printed_formula():
    I, V = tw.load("go2").inertia[1].matrix(), np.array([0.1, -0.2, 0.3, 1e4, 2e4, -3e4])
    exact_I, exact_V = np.vectorize(Fraction)(I), np.vectorize(Fraction)(V)
    return off(tw.cross_force(V) @ (I @ V), (tw.cross_force(exact_V) @ (exact_I @ exact_V)).astype(float))


def other_units():
    def one(scale):
        robot = tw.Builder("one", gravity=[0, 0, -8.0 * scale])
        body = tw.SpatialInertia(2.0, [0, 0, 0.1 * scale], np.diag([0.02, 0.02, 0.01]) * scale**2)
        robot.link("rod", parent="base_link", joint=tw.Revolute("x"), inertia=body)
        return tw.aba(robot.build(), [0.7], [0.3], [0.0])

    return off(one(2.0**-30), one(1.0))


def long_quaternion():
    x, y, z, w = (1 + 1e-9) * np.array([0.5, -0.1, 0.3, 0.8]) / np.linalg.norm([0.5, -0.1, 0.3, 0.8])
    R = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                  [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                  [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])  # fmt: skip
    return np.abs(R @ R.T - np.eye(3)).max()


def acos_of_the_trace():
    R = tw.exp3(1e-8 * np.array([0.36, 0.48, -0.8]))
    return abs(np.arccos(np.clip((np.trace(R) - 1) / 2, -1, 1)) - 1e-8) / 1e-8


def far_body():
    body = tw.SpatialInertia(2.0, [0, 0, 0.1], np.diag([0.02, 0.02, 0.01]))
    there = body.transform(tw.SE3(np.eye(3), [1e6, 0, 0]))
    return off(tw.SpatialInertia.from_matrix(there.matrix()).inertia_at_com, body.inertia_at_com)


def wheel():
    n = np.array([1, 2, 2]) / 3
    fan, disc = tw.Builder("fan"), tw.SpatialInertia(0.1, [0, 0, 0], 0.1 * 0.03**2 / 4 * (np.eye(3) + np.outer(n, n)))
    fan.link("disc", parent="base_link", joint=tw.Revolute(n), inertia=disc)
    return abs(tw.aba(fan.build(), [0.3], [1047.0], [0.0])[0])


ROWS = [
    lambda: np.linalg.cond(tw.crba(tw.chain(10, mass_ratio=1e-9), BENT)),
    heavy_tip,
    single,
    in_the_world,
    printed_formula,
    other_units,
    long_quaternion,
    acos_of_the_trace,
    far_body,
    wheel,
]


@pytest.mark.parametrize("language", ["", ".zh-CN"])
def test_each_row_has_the_number_that_is_computed(language):
    text = page("extremes", language).read_text(encoding="utf-8").partition("<!-- traps -->")[2].partition("\n\n")[0]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.strip().splitlines()[2:]]
    assert len(rows) == len(ROWS)
    for (trap, number, cure), compute in zip(rows, ROWS):
        assert cure
        said = [float(x) for x in re.findall(r"\d+(?:e[+-]?\d+)?", number)]
        for x, found in zip(said, np.atleast_1d(compute())):
            assert found == x == 0 or 1 / 3 < found / x < 3, (trap, x, found)
