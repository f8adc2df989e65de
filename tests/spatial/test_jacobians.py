"""Jacobians of exp and log, and the way between two placements: closed forms, the group, Pinocchio, and 50 digits."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.spatial import SE3, Jexp3, Jexp6, Jlog3, Jlog6, cross_motion, exp3, exp6, interpolate, log3, log6, skew

EPS = 2.0**-52
SHAPES = [(), (1,), (3, 1, 2), (0,)]
DTYPES = [np.float32, np.float64, np.longdouble, np.complex128]
SIDES = ["right", "left"]
ANGLES = [0.0, 1e-300, 1e-160, 1e-30, 1e-8, 1e-3, 0.5, 1.0, np.nextafter(2, 3), 3.0, np.pi - 1e-7, np.pi - 1e-13, np.pi]
SWAP = [3, 4, 5, 0, 1, 2]


def twists(angle, n, seed):
    rng = np.random.default_rng(seed)
    w, v = rng.normal(size=(2, n, 3))
    return np.concatenate([angle * w / np.sqrt((w * w).sum(-1, keepdims=True)), v], axis=-1)


@pytest.fixture
def mp():
    mpmath = pytest.importorskip("mpmath", reason="mpmath is not installed: the comparison with 50 digits is skipped")
    with mpmath.workdps(60):
        yield mpmath


def truth(mp, V):
    """Σ (−V×)ᵏ/(k + 1)!, the right Jacobian by its definition as a series."""
    step, term, total = mp.matrix((-cross_motion(V)).tolist()), mp.eye(6), mp.eye(6)
    for k in range(2, 100):
        term = term * step / k
        total += term
        if mp.mnorm(term) < 1e-50:
            break
    return total


def error(mp, matrix, exact):
    return np.abs(np.array((mp.matrix(matrix.tolist()) - exact).tolist(), dtype=float)).max()


# --- closed forms --------------------------------------------------------------------------------


@pytest.mark.parametrize("angle", [1e-9, 0.7, 3.0, 6.0])
def test_about_one_axis_the_jacobian_is_that_of_a_circle(angle):
    s, c = np.sin(angle) / angle, 2 * np.sin(angle / 2) ** 2 / angle
    expected = [[s, c, 0], [-c, s, 0], [0, 0, 1]]
    np.testing.assert_allclose(Jexp3([0, 0, angle]), expected, rtol=0, atol=2 * EPS)


def test_at_a_translation_the_jacobian_is_linear_in_it():
    v = np.array([1.0, -2.0, 3.0])
    expected = np.block([[np.eye(3), np.zeros((3, 3))], [-skew(v) / 2, np.eye(3)]])
    np.testing.assert_array_equal(Jexp6([0, 0, 0, *v]), expected)
    np.testing.assert_array_equal(Jlog6(SE3(np.eye(3), v)), 2 * np.eye(6) - expected)


# --- invariants ----------------------------------------------------------------------------------


@pytest.mark.parametrize("angle", ANGLES)
def test_the_two_sides_differ_by_the_change_of_frame_and_by_a_sign(angle):
    V = twists(angle, 10, 0)
    X = exp6(V).motion_transform()
    np.testing.assert_allclose(Jexp6(V, "left"), X @ Jexp6(V), rtol=0, atol=2e-14)
    np.testing.assert_array_equal(Jexp6(V, "left"), Jexp6(-V))
    np.testing.assert_array_equal(Jexp3(V[..., :3], "left"), Jexp3(V[..., :3]).mT)


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("angle", ANGLES)
def test_the_jacobians_of_exp_and_log_are_inverse(angle, side):
    T = exp6(twists(angle, 10, 1))
    V, one = log6(T), np.eye(6)
    np.testing.assert_allclose(Jlog6(T, side) @ Jexp6(V, side), np.broadcast_to(one, (10, 6, 6)), rtol=0, atol=1e-14)
    product = Jlog3(T.rotation, side) @ Jexp3(V[..., :3], side)
    np.testing.assert_allclose(product, np.broadcast_to(one[:3, :3], (10, 3, 3)), rtol=0, atol=1e-14)


@pytest.mark.parametrize("side", SIDES)
def test_a_complex_step_through_exp_and_log_gives_the_jacobians(side):
    h = 1e-30
    for V in twists(2.2, 5, 2):
        T = exp6(V)
        for dV in np.eye(6):
            change = exp6(V + 1j * h * dV)
            there = (T.inverse() @ change) if side == "right" else (change @ T.inverse())
            step = np.r_[tw.unskew(there.rotation.imag - there.rotation.imag.mT), 2 * there.translation.imag] / (2 * h)
            if side == "left":
                step[3:] = there.translation.imag / h
            np.testing.assert_allclose(Jexp6(V, side) @ dV, step, rtol=0, atol=5e-15)
            small = exp6(1j * h * dV)
            back = log6(T @ small if side == "right" else small @ T).imag / h
            np.testing.assert_allclose(Jlog6(T, side) @ dV, back, rtol=0, atol=2e-14)


def test_the_translation_of_exp6_is_the_left_jacobian_of_its_turn():
    V = twists(2.5, 10, 3)
    p = np.matvec(Jexp3(V[..., :3], "left"), V[..., 3:])
    np.testing.assert_allclose(exp6(V).translation, p, rtol=0, atol=2e-15)


def test_a_rotation_vector_that_changes_turns_with_the_rate_of_the_jacobian():
    w, rate, h = np.array([0.3, 2.0, -0.5]), np.array([0.4, -1.0, 2.0]), 1e-30
    R, dR = exp3(w), exp3(w + 1j * h * rate).imag / h
    np.testing.assert_allclose(R.T @ dR, skew(Jexp3(w) @ rate), rtol=0, atol=2e-15)
    np.testing.assert_allclose(dR @ R.T, skew(Jexp3(w, "left") @ rate), rtol=0, atol=2e-15)


# --- outside oracles -----------------------------------------------------------------------------


@pytest.mark.parametrize("angle", [*ANGLES, 5.0, 6.2, 20.0])
def test_the_jacobians_are_good_to_a_few_units_in_the_last_place(mp, angle):
    for V in twists(angle, 2, 4):
        size = max(1, np.abs(V).max())
        assert error(mp, Jexp6(V), truth(mp, V)) <= 3 * EPS * size
        assert error(mp, Jexp3(V[:3]), truth(mp, V)[:3, :3]) <= 3 * EPS  # with musl's sine 2.2
        if angle <= np.pi:
            T = exp6(V)
            exact = truth(mp, log6(T)) ** -1
            assert error(mp, Jlog6(T), exact) <= 4 * EPS * size
            assert error(mp, Jlog3(T.rotation), exact[:3, :3]) <= 2 * EPS


def test_a_long_double_keeps_its_digits(mp):
    eps = np.finfo(np.longdouble).eps
    if eps == EPS:
        pytest.skip("long double is double here")
    V = twists(1e-3, 1, 5)[0]
    exact, J = truth(mp, V), Jexp6(V.astype(np.longdouble))
    low = (J - J.astype(float)).astype(float)  # what a double cannot hold
    whole = mp.matrix(J.astype(float).tolist()) + mp.matrix(low.tolist())
    assert np.abs(np.array((whole - exact).tolist(), dtype=float)).max() < 16 * eps  # of 113 bits 14


def test_pinocchio_has_the_same_jacobians():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    for angle in (0.2, 1.5, 2.9):
        for V in twists(angle, 5, 6):
            T, w = pin.exp6(pin.Motion(V[SWAP])), V[:3]
            np.testing.assert_allclose(Jexp3(w), pin.Jexp3(w), rtol=0, atol=1e-14)
            np.testing.assert_allclose(Jexp6(V), pin.Jexp6(pin.Motion(V[SWAP]))[SWAP][:, SWAP], rtol=0, atol=1e-13)
            # Pinocchio's own logarithm is good to about 1e-12.
            np.testing.assert_allclose(Jlog3(T.rotation), pin.Jlog3(T.rotation), rtol=0, atol=1e-11)
            np.testing.assert_allclose(Jlog6(T.homogeneous), pin.Jlog6(T)[SWAP][:, SWAP], rtol=0, atol=1e-11)


def test_pinocchio_interpolates_along_the_same_screw():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    A, B = exp6(twists(1.0, 5, 7)), exp6(twists(2.0, 5, 8))
    for k in range(5):
        theirs = pin.SE3.Interpolate(*(pin.SE3(T.rotation[k], T.translation[k]) for T in (A, B)), 0.3)
        np.testing.assert_allclose(interpolate(A, B, 0.3).matrix()[k], theirs.homogeneous, rtol=0, atol=1e-12)


# --- interpolation -------------------------------------------------------------------------------


def test_a_way_has_its_ends_and_a_constant_twist():
    A, B, u = exp6(twists(0.5, 4, 9)), exp6(twists(2.5, 4, 10)), np.linspace(0, 1, 5)[:, None]
    way = interpolate(A, B, u)
    assert way.translation.shape == (5, 4, 3)
    np.testing.assert_allclose(way.matrix()[0], A.matrix(), rtol=0, atol=2e-15)
    np.testing.assert_allclose(way.matrix()[-1], B.matrix(), rtol=0, atol=1e-14)
    steps = log6(SE3(way.rotation[:-1], way.translation[:-1]).inverse() @ SE3(way.rotation[1:], way.translation[1:]))
    np.testing.assert_allclose(steps, np.broadcast_to(steps[:1], steps.shape), rtol=0, atol=2e-14)


def test_the_way_does_not_depend_on_the_frame():
    A, B, moved = (exp6(twists(angle, 1, 11)[0]) for angle in (0.5, 2.0, 1.0))
    np.testing.assert_allclose(
        interpolate(moved @ A, moved @ B, 0.3).matrix(), (moved @ interpolate(A, B, 0.3)).matrix(), rtol=0, atol=5e-15
    )


# --- number types, batches, errors ---------------------------------------------------------------


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("dtype", DTYPES)
def test_batch_axes_and_number_types_are_kept(shape, dtype):
    V = np.random.default_rng(12).normal(size=(*shape, 6)).astype(dtype)
    T = exp6(V)
    results = Jexp3(V[..., :3]), Jlog3(T.rotation), Jexp6(V), Jlog6(T)
    assert [J.shape for J in results] == [(*shape, n, n) for n in (3, 3, 6, 6)]
    assert {J.dtype for J in results} == {np.dtype(dtype)}
    for k in np.ndindex(shape):
        np.testing.assert_allclose(Jexp6(V)[k], Jexp6(V[k]), rtol=0, atol=2 * np.finfo(dtype).eps)


def test_errors_name_the_argument():
    with pytest.raises(tw.ShapeError, match=r"w: expected shape \(\.\.\., 3\)"):
        Jexp3(np.ones(4))
    with pytest.raises(ValueError, match="side: expected 'right' or 'left', got 'both'"):
        Jexp6(np.ones(6), "both")
    with pytest.raises(TypeError, match="V: expected a Twist"):
        Jexp6(tw.Wrench(np.ones(6)))
    with pytest.raises(TypeError, match="T1: expected an SE3"):
        interpolate(SE3.identity(), np.eye(4), 0.5)
    assert log3(np.eye(3)).shape == (3,)
