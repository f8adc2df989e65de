"""Rotations (section 49.2): closed forms, group laws, SciPy, and 50 digits."""

import numpy as np
import pytest

from twistwrench.errors import ShapeError, SingularError
from twistwrench.spatial import (
    exp3,
    log3,
    quaternion_to_rotation,
    rotation_to_quaternion,
    rpy_to_rotation,
    skew,
    unskew,
)

EPS = 2.0**-52
SHAPES = [(), (1,), (3, 1, 2), (0,)]
DTYPES = [np.float32, np.float64, np.longdouble, np.complex64, np.complex128, np.clongdouble]
# Down to where the square of an angle is zero, up to where the sign of the axis is about to be lost.
ANGLES = [1e-300, 3e-162, 1e-154, 1e-30, 1e-9, 1.5e-8, 1e-3, 0.5, 1.0, 2.0, 3.0, np.pi - 1e-7, np.pi - 1e-13]


def directions(n, seed):
    u = np.random.default_rng(seed).normal(size=(n, 3))
    return u / np.sqrt((u * u).sum(-1, keepdims=True))


def rotation_in_50_digits(mp, w):
    """R as mpmath numbers, by the power series of the matrix exponential alone."""
    x, y, z = (mp.mpf(float(value)) for value in w)
    return mp.expm(mp.matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]]))


@pytest.fixture
def mp():
    mpmath = pytest.importorskip("mpmath", reason="mpmath is not installed: the comparison with 50 digits is skipped")
    with mpmath.workdps(60):
        yield mpmath


# --- closed forms --------------------------------------------------------------------------------


def test_skew_matrix_times_vector_is_the_cross_product():
    rng = np.random.default_rng(0)
    a, b = rng.normal(size=(2, 5, 3))
    np.testing.assert_allclose(np.matvec(skew(a), b), np.cross(a, b), rtol=0, atol=1e-15)
    np.testing.assert_array_equal(skew([1, 2, 3]), [[0, -3, 2], [3, 0, -1], [-2, 1, 0]])


@pytest.mark.parametrize("angle", [-7.0, -1e-3, 0.0, 0.1, np.pi / 2, np.pi, 10.0])
def test_turning_about_a_coordinate_axis_is_the_plane_rotation(angle):
    c, s = np.cos(angle), np.sin(angle)
    about = {
        0: [[1, 0, 0], [0, c, -s], [0, s, c]],
        1: [[c, 0, s], [0, 1, 0], [-s, 0, c]],
        2: [[c, -s, 0], [s, c, 0], [0, 0, 1]],
    }
    for axis, R in about.items():
        np.testing.assert_allclose(exp3(angle * np.eye(3)[axis]), R, rtol=0, atol=4 * EPS)
        np.testing.assert_allclose(rpy_to_rotation(angle * np.eye(3)[axis]), R, rtol=0, atol=EPS)
        half = np.append(np.sin(angle / 2) * np.eye(3)[axis], np.cos(angle / 2))
        np.testing.assert_allclose(quaternion_to_rotation(half), R, rtol=0, atol=4 * EPS)


def test_a_third_of_a_turn_about_the_diagonal_permutes_the_axes():
    R = exp3(2 * np.pi / 3 * np.ones(3) / np.sqrt(3))
    np.testing.assert_allclose(R, [[0, 0, 1], [1, 0, 0], [0, 1, 0]], rtol=0, atol=4 * EPS)
    np.testing.assert_allclose(rotation_to_quaternion(R), [0.5, 0.5, 0.5, 0.5], rtol=0, atol=2 * EPS)


# --- invariants ----------------------------------------------------------------------------------


@pytest.mark.parametrize("angle", [*ANGLES, 100.0])
def test_exponential_is_a_rotation_that_leaves_its_axis_alone(angle):
    u = directions(40, 1)
    R = exp3(angle * u)
    np.testing.assert_allclose(R.mT @ R, np.broadcast_to(np.eye(3), R.shape), rtol=0, atol=2e-15)
    np.testing.assert_allclose(np.linalg.det(R), 1, rtol=0, atol=4e-15)
    np.testing.assert_allclose(np.matvec(R, u), u, rtol=0, atol=2e-15)
    np.testing.assert_array_equal(exp3(-angle * u), R.mT)


def test_turns_about_one_axis_add():
    u = directions(20, 2)
    np.testing.assert_allclose(exp3(0.7 * u) @ exp3(1.9 * u), exp3(2.6 * u), rtol=0, atol=4e-15)


def test_logarithm_undoes_the_exponential_up_to_half_a_turn():
    for angle in ANGLES:
        w = angle * directions(40, 3)
        np.testing.assert_allclose(log3(exp3(w)), w, rtol=0, atol=8 * EPS * angle)


def test_half_turns_give_the_axis_up_to_its_sign():
    u = np.concatenate([np.eye(3), directions(40, 4), [[1, 1, 0], [0, -1, 1], [-1, 0, 1]] / np.sqrt([[2]])])
    w = log3(exp3(np.pi * u))
    sign = np.sign((w * u).sum(-1, keepdims=True))
    np.testing.assert_allclose(w * sign, np.pi * u, rtol=0, atol=4e-15)
    exact = log3(2 * u[:, :, None] * u[:, None, :] - np.eye(3))  # symmetric: sin π is 0, not 1e-16
    np.testing.assert_allclose(exact * np.sign((exact * u).sum(-1, keepdims=True)), np.pi * u, rtol=0, atol=4e-15)
    assert (np.take_along_axis(exact, np.abs(exact).argmax(-1)[:, None], axis=-1) > 0).all()


def test_beyond_half_a_turn_the_logarithm_takes_the_short_way():
    u = directions(40, 5)
    np.testing.assert_allclose(log3(exp3(4.0 * u)), (4.0 - 2 * np.pi) * u, rtol=0, atol=8e-15)


def test_logarithm_of_no_rotation_is_exactly_zero():
    np.testing.assert_array_equal(log3(np.eye(3)), np.zeros(3))
    np.testing.assert_array_equal(exp3(np.zeros(3)), np.eye(3))


def test_quaternion_and_matrix_agree_whichever_component_is_largest():
    q = np.random.default_rng(6).normal(size=(400, 4))
    q[:4] = np.eye(4)
    q[4:10] = [[1, 1, 0, 0], [1, 0, 0, 1], [0, 0, 1, 1], [1, -1, 1, -1], [-1, -1, -1, 1], [0, 1, 0, 1e-9]]
    assert set(np.abs(q).argmax(-1)) == {0, 1, 2, 3}
    unit = q / np.sqrt((q * q).sum(-1, keepdims=True))
    back = rotation_to_quaternion(quaternion_to_rotation(q))
    assert (back[:, 3] >= 0).all()
    np.testing.assert_allclose(back * np.sign((back * unit).sum(-1, keepdims=True)), unit, rtol=0, atol=1e-15)


@pytest.mark.parametrize("scale", [1e-200, 1 - 1e-9, 1 + 1e-9, 3.0, 1e200])
def test_the_length_of_a_quaternion_does_not_scale_the_rotation(scale):
    q = np.random.default_rng(7).normal(size=(10, 4))
    np.testing.assert_allclose(quaternion_to_rotation(scale * q), quaternion_to_rotation(q), rtol=0, atol=2e-15)


def test_roll_pitch_yaw_turn_about_fixed_axes_in_this_order():
    rpy = np.random.default_rng(8).uniform(-4, 4, size=(10, 3))
    x, y, z = (exp3(rpy[:, k, None] * np.eye(3)[k]) for k in range(3))
    np.testing.assert_allclose(rpy_to_rotation(rpy), z @ y @ x, rtol=0, atol=4e-15)


def test_unskew_undoes_skew_exactly():
    w = np.random.default_rng(9).normal(size=(4, 3))
    np.testing.assert_array_equal(unskew(skew(w)), w)


# --- outside oracles -----------------------------------------------------------------------------


def test_scipy_has_the_same_rotations():
    Rotation = pytest.importorskip("scipy.spatial.transform", reason="SciPy is not installed").Rotation
    w = np.random.default_rng(10).normal(size=(50, 3))
    R = exp3(w)
    np.testing.assert_allclose(R, Rotation.from_rotvec(w).as_matrix(), rtol=0, atol=4e-15)
    np.testing.assert_allclose(log3(R), Rotation.from_matrix(R).as_rotvec(), rtol=0, atol=4e-15)
    np.testing.assert_allclose(rotation_to_quaternion(R), Rotation.from_matrix(R).as_quat(canonical=True), atol=4e-15)
    np.testing.assert_allclose(
        quaternion_to_rotation(w @ np.eye(3, 4) + 1),
        Rotation.from_quat(w @ np.eye(3, 4) + 1).as_matrix(),
        rtol=0,
        atol=4e-15,
    )
    np.testing.assert_allclose(rpy_to_rotation(w), Rotation.from_euler("xyz", w).as_matrix(), rtol=0, atol=4e-15)


@pytest.mark.parametrize("angle", ANGLES)
def test_exponential_and_logarithm_are_good_to_a_few_units_in_the_last_place(mp, angle):
    # Exponential: 8 units of 1. Its antisymmetric part, where w is read off: 4 units of |w|. Logarithm: 4 units of |w|.
    for w in angle * directions(6, 11):
        truth = rotation_in_50_digits(mp, w)
        R = exp3(w)
        assert mp.mnorm(mp.matrix(R.tolist()) - truth, "f") <= 8 * EPS
        if angle < 3:
            part = mp.matrix((R - R.T).tolist())
            assert mp.mnorm(part - (truth - truth.T), "f") <= 8 * EPS * mp.mnorm(truth - truth.T, "f")
        got = log3(np.array(truth.tolist(), dtype=float))
        assert np.abs(got - w).max() <= 4 * EPS * angle


def test_complex_step_gives_the_derivative_of_the_exponential(mp):
    # The derivative of a matrix exponential along E is the top right block of the exponential of [[W, E], [0, W]].
    for w in [np.zeros(3), np.array([1e-200, 0, 0]), np.array([0.3, -0.4, 1.2]), np.array([0, 3.1, 0.2])]:
        W = skew(w)
        for k in range(3):
            E = skew(np.eye(3)[k])
            block = mp.expm(mp.matrix(np.block([[W, E], [np.zeros((3, 3)), W]]).tolist()))
            truth = np.array(block[:3, 3:].tolist(), dtype=float)
            got = exp3(w + 1e-30j * np.eye(3)[k]).imag / 1e-30
            np.testing.assert_allclose(got, truth, rtol=0, atol=4e-15)


def test_complex_step_gives_the_derivative_of_the_logarithm(mp):
    # dR = R [a]× turns w by the inverse of the right Jacobian, the top right block of exp [[−W, 1], [0, 0]].
    for w in [np.zeros(3), np.array([1e-200, 0, 0]), np.array([0.3, -0.4, 1.2]), np.array([0, 3.1, 0.2])]:
        block = mp.expm(mp.matrix(np.block([[-skew(w), np.eye(3)], [np.zeros((3, 6))]]).tolist()))
        jacobian = np.array(mp.inverse(block[:3, 3:]).tolist(), dtype=float)
        R = exp3(w)
        got = np.stack([log3(R + 1e-30j * R @ skew(a)).imag / 1e-30 for a in np.eye(3)], axis=-1)
        np.testing.assert_allclose(got, jacobian, rtol=0, atol=2e-14)


# --- shapes, types, bad input --------------------------------------------------------------------


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("dtype", DTYPES)
def test_batch_axes_and_number_types_are_kept(shape, dtype):
    w = np.random.default_rng(12).uniform(-1, 1, size=(*shape, 3)).astype(dtype)
    w.flags.writeable = False
    R = exp3(w)
    assert R.shape == (*shape, 3, 3)
    q = rotation_to_quaternion(R)
    assert q.shape == (*shape, 4)
    for x in (R, q, log3(R), skew(w), unskew(skew(w)), quaternion_to_rotation(q), rpy_to_rotation(w)):
        assert x.dtype == dtype
    tolerance = 8 * float(np.finfo(dtype).eps)
    np.testing.assert_allclose(log3(R), w, rtol=0, atol=tolerance)
    np.testing.assert_allclose(quaternion_to_rotation(q), R, rtol=0, atol=tolerance)


def test_a_complex_vector_whose_squares_cancel_is_no_special_case():
    w = np.array([1e-9, 1e-9j, 0])
    np.testing.assert_allclose(log3(exp3(w)), w, rtol=0, atol=1e-24)


def test_a_batch_may_mix_every_case():
    w = np.array([[0, 0, 0], [1e-300, 0, 0], [0, 1e-8, 0], [0.1, 0.2, 0.3], [0, 0, np.pi]])
    np.testing.assert_array_equal(exp3(w), [exp3(x) for x in w])
    np.testing.assert_array_equal(log3(exp3(w)), [log3(exp3(x)) for x in w])


@pytest.mark.parametrize(
    ("function", "name", "n"),
    [(skew, "w", 3), (exp3, "w", 3), (rpy_to_rotation, "rpy", 3), (quaternion_to_rotation, "xyzw", 4)],
)
def test_a_vector_of_five_is_refused(function, name, n):
    with pytest.raises(ShapeError, match=rf"^{name}: expected shape \(\.\.\., {n}\), got \(5,\)"):
        function(np.ones(5))


@pytest.mark.parametrize("function", [log3, rotation_to_quaternion])
def test_a_matrix_that_is_no_rotation_is_refused(function):
    with pytest.raises(ShapeError, match=r"^R: expected shape \(\.\.\., 3, 3\), got \(4, 4\)"):
        function(np.eye(4))
    nearly, mirror = (1 - 1e-9) * np.eye(3), np.diag([1.0, 1.0, -1.0])
    with pytest.raises(ShapeError, match=r"reflection, det R = −1 at index \(1,\)"):
        function(np.stack([nearly, mirror]))
    with pytest.raises(ShapeError, match=r"^R: .*\|RᵀR − 1\| = 3 at index \(1,\)"):
        function(np.stack([np.eye(3), 2 * np.eye(3)]))
    with pytest.raises(ShapeError, match=r"\|RᵀR − 1\| = (inf|nan)"):
        function(np.full((3, 3), 1e200))
    # Squares that overflow: some machines make NaN of their difference, which no comparison with a tolerance sees.
    for big in (1e200, np.finfo(np.longdouble).max / 4):
        with pytest.raises(ShapeError, match=r"\|RᵀR − 1\| = (inf|nan)"):
            function(big * np.array([[1, 1, 0], [1, -1, 0], [0, 0, 1]]))


def test_the_room_for_a_rotation_ends_at_the_square_root_of_the_resolution():
    off = EPS**0.5
    np.testing.assert_allclose(log3(np.eye(3) * (1 + 0.49 * off)), np.zeros(3))
    with pytest.raises(ShapeError):
        log3(np.eye(3) * (1 + 0.51 * off))


def test_a_matrix_that_is_not_skew_is_refused_with_its_distance():
    with pytest.raises(ShapeError, match=r"\|M \+ Mᵀ\| = 0\.5"):
        unskew(skew([1, 2, 3]) + 0.25 * np.eye(3))
    with pytest.raises(ShapeError, match=r"^M: expected shape \(\.\.\., 3, 3\), got \(3,\)"):
        unskew(np.zeros(3))
    np.testing.assert_allclose(unskew(skew([1, 2, 3]) + 1e-9 * np.ones((3, 3))), [1, 2, 3], rtol=1e-12)
    np.testing.assert_array_equal(unskew(np.zeros((3, 3))), np.zeros(3))


def test_the_room_for_a_skew_matrix_ends_at_the_square_root_of_the_resolution():
    W, off = skew([0, 0, 1]), np.diag([EPS**0.5, 0, 0]) / 2  # |M + Mᵀ| is twice the entry
    np.testing.assert_array_equal(unskew(W + 0.9 * off), [0, 0, 1])
    with pytest.raises(ShapeError):
        unskew(W + 1.1 * off)


def test_the_zero_quaternion_is_refused_with_its_place_in_the_batch():
    with pytest.raises(SingularError, match=r"zero quaternion is not a rotation at index \(1,\)"):
        quaternion_to_rotation([[0, 0, 0, 1], [0, 0, 0, 0]])


def test_numbers_that_are_not_finite_are_refused():
    with pytest.raises(ValueError, match="expected finite numbers, got nan"):
        exp3([0, np.nan, 0])
