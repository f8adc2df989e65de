"""Exponential and logarithm of SE(3): screw motions, group laws, SciPy, Pinocchio, and 50 digits."""

import warnings

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.errors import ShapeError
from twistwrench.spatial import SE3, cross_motion, exp3, exp6, hat, log6
from twistwrench.spatial._elementary import cosine_defect, sine_defect_root

EPS = 2.0**-52
SHAPES = [(), (1,), (3, 1, 2), (0,)]
DTYPES = [np.float32, np.float64, np.longdouble, np.complex64, np.complex128, np.clongdouble]
# Both sides of the two series: below 1 in exp6, below a half angle of 1 in log6.
EDGES = [np.nextafter(1, 0), 1.0, np.nextafter(1, 2), np.nextafter(2, 0), 2.0, np.nextafter(2, 3)]
ANGLES = [1e-300, 3e-162, 1e-30, 1e-8, 1e-3, 0.5, *EDGES, 3.0, np.pi - 1e-7, np.pi - 1e-13]


def twists(angle, n, seed):
    rng = np.random.default_rng(seed)
    w, v = rng.normal(size=(2, n, 3))
    return np.concatenate([angle * w / np.sqrt((w * w).sum(-1, keepdims=True)), v], axis=-1)


@pytest.fixture
def mp():
    mpmath = pytest.importorskip("mpmath", reason="mpmath is not installed: the comparison with 50 digits is skipped")
    with mpmath.workdps(60):
        yield mpmath


# --- closed forms --------------------------------------------------------------------------------


@pytest.mark.parametrize(("wz", "vx"), [(0.5, 1.0), (np.pi / 2, 2.0), (-3.0, 0.1), (1e-9, 1.0), (7.0, -2.0)])
def test_exercise_49_2_2_driving_while_turning_goes_round_a_circle(wz, vx):
    T = exp6([0, 0, wz, vx, 0, 0])
    c, s = np.cos(wz), np.sin(wz)
    np.testing.assert_allclose(T.rotation, [[c, -s, 0], [s, c, 0], [0, 0, 1]], rtol=0, atol=4 * EPS)
    arc = [vx * s / wz, 2 * vx * np.sin(wz / 2) ** 2 / wz, 0]
    np.testing.assert_allclose(T.translation, arc, rtol=0, atol=4 * EPS * abs(vx))


def test_exercise_49_2_2_a_quarter_turn_at_unit_speed_ends_at_two_over_pi():
    T = exp6([0, 0, np.pi / 2, 1, 0, 0])
    np.testing.assert_allclose(T.translation, [2 / np.pi, 2 / np.pi, 0], rtol=4 * EPS)


def test_a_translation_is_its_own_exponential():
    np.testing.assert_array_equal(exp6([0, 0, 0, 1, -2, 3]).translation, [1, -2, 3])
    np.testing.assert_array_equal(log6(SE3(np.eye(3), [1, -2, 3])), [0, 0, 0, 1, -2, 3])


def test_a_screw_motion_turns_about_its_axis_and_advances_by_the_pitch():
    axis, point, pitch, angle = np.array([2.0, -1.0, 2.0]) / 3, np.array([0.3, 1.0, -0.5]), 0.25, 2.5
    v = -np.cross(axis, point) + pitch * axis
    T = exp6(angle * np.concatenate([axis, v]))
    np.testing.assert_allclose(T.act(point), point + pitch * angle * axis, rtol=0, atol=4e-15)
    arm = np.array([0.1, 0.2, 0.3])
    np.testing.assert_allclose(T.act(point + arm) - T.act(point), exp3(angle * axis) @ arm, rtol=0, atol=4e-15)


# --- invariants ----------------------------------------------------------------------------------


def test_motions_along_one_screw_add():
    V = twists(1.0, 20, 0)
    T, sum_ = exp6(0.4 * V) @ exp6(1.7 * V), exp6(2.1 * V)
    np.testing.assert_allclose(T.matrix(), sum_.matrix(), rtol=0, atol=1e-14)


def test_the_opposite_twist_leads_back():
    V = twists(2.2, 20, 1)
    np.testing.assert_allclose(exp6(-V).matrix(), exp6(V).inverse().matrix(), rtol=0, atol=1e-14)


@pytest.mark.parametrize("angle", ANGLES)
def test_logarithm_undoes_the_exponential(angle):
    V = twists(angle, 40, 2)
    back = log6(exp6(V))
    np.testing.assert_allclose(back[:, :3], V[:, :3], rtol=0, atol=8 * EPS * angle)
    np.testing.assert_allclose(back[:, 3:], V[:, 3:], rtol=0, atol=2e-14)


def test_logarithm_at_half_a_turn_leads_to_the_same_placement():
    T = exp6(twists(np.pi, 40, 3))
    np.testing.assert_allclose(exp6(log6(T)).matrix(), T.matrix(), rtol=0, atol=2e-14)


def test_a_twist_in_another_frame_has_the_conjugate_exponential():
    A, V = exp6(twists(1.3, 10, 4)), twists(2.0, 10, 5)
    moved = exp6(np.matvec(A.motion_transform(), V))
    np.testing.assert_allclose(moved.matrix(), (A @ exp6(V) @ A.inverse()).matrix(), rtol=0, atol=2e-14)


# --- outside oracles -----------------------------------------------------------------------------


def test_scipy_has_the_same_matrix_exponentials():
    linalg = pytest.importorskip("scipy.linalg", reason="SciPy is not installed")
    for angle in (1e-9, 0.7, 2.9):
        V = twists(angle, 5, 6)
        T = exp6(V)
        np.testing.assert_allclose(T.matrix(), linalg.expm(hat(V)), rtol=0, atol=1e-14)
        # exp(V×) is the change of frame: the sign of every block of V× and of X is in this line.
        np.testing.assert_allclose(T.motion_transform(), linalg.expm(cross_motion(V)), rtol=0, atol=2e-14)


def test_pinocchio_has_the_same_exponentials_and_logarithms():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    swap = [3, 4, 5, 0, 1, 2]
    for angle in (0.2, 1.5, 2.9):
        for V in twists(angle, 5, 7):
            theirs = pin.exp6(pin.Motion(V[swap]))
            np.testing.assert_allclose(exp6(V).matrix(), theirs.homogeneous, rtol=0, atol=1e-14)
            # Pinocchio's own logarithm is good to about 1e-12.
            np.testing.assert_allclose(log6(theirs.homogeneous), pin.log6(theirs).vector[swap], rtol=0, atol=1e-11)


@pytest.mark.parametrize("angle", ANGLES)
def test_exponential_and_logarithm_are_good_to_a_few_units_in_the_last_place(mp, angle):
    for V in twists(angle, 4, 8):
        truth = mp.expm(mp.matrix(hat(V).tolist()))
        rounded = np.array(truth.tolist(), dtype=float)
        size = np.sqrt((V[3:] ** 2).sum())
        error = mp.matrix(exp6(V).translation.tolist()) - truth[:3, 3]
        assert mp.norm(error) <= 4 * EPS * size
        back = log6(rounded)
        assert np.abs(back[:3] - V[:3]).max() <= 4 * EPS * angle
        # Near π, rounding R alone moves v by about ten units.
        assert np.abs(back[3:] - V[3:]).max() <= 12 * EPS * size


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
def test_coefficients_are_good_to_a_few_units_in_the_last_place_on_both_sides_of_their_series(mp, dtype):
    one, eps = dtype(1), np.finfo(dtype).eps
    x = np.array(
        [1e-18, 1e-9, 1e-4, 0.01, 0.3, 0.9, np.nextafter(one, 0 * one), 1, np.nextafter(one, 2 * one), 1.5], dtype
    )
    for k, exact in enumerate(mp.mpf(str(value)) for value in x):
        with mp.workdps(100):  # 36 are lost at 1e-18
            defects = {
                sine_defect_root: mp.sqrt((exact - mp.sin(exact)) / exact**3),
                cosine_defect: (mp.sin(exact) - exact * mp.cos(exact)) / exact**3,
            }
        for function, truth in defects.items():
            assert abs(mp.mpf(str(function(x)[k])) / truth - 1) <= 8 * mp.mpf(float(eps))
    assert sine_defect_root(np.zeros(1, dtype)) == np.sqrt(one / 6)
    assert cosine_defect(np.zeros(1, dtype)) == one / 3


@pytest.mark.parametrize(
    ("dtype", "angle"),
    [(np.float64, 1e4), (np.float64, 1e110), (np.float64, 1e160), (np.complex128, 1e300), (np.float32, 1e13),
     (np.float32, 1e38), (np.complex64, 1e38), (np.longdouble, "1e3000")],
)  # fmt: skip
def test_a_body_that_turns_very_far_only_advances_along_its_axis(mp, dtype, angle):
    if mp.mpf(str(np.finfo(dtype).max)) < mp.mpf(angle):
        pytest.skip("longdouble is no wider than float64 on this machine")
    angle, eps = np.array(angle).astype(dtype), float(np.finfo(dtype).eps)
    p = exp6(np.array([angle, 0, 0, 3, 1, 0.5], dtype)).translation
    with mp.workdps(6000):  # sin needs all digits of the angle before the point
        x = mp.mpf(int(angle.real))
        s, b = float(mp.sin(x) / x), float(2 * mp.sin(x / 2) ** 2 / x)
    np.testing.assert_allclose(p, [3, s - 0.5 * b, b + 0.5 * s], rtol=0, atol=8 * eps)
    # About an axis that no number holds exactly, the angle is off by more than a turn; the advance is not.
    n = np.array([2, -1, 2], dtype) / 3
    if angle.real > 1e12:
        p = exp6(np.concatenate([n * angle / 3, np.array([3, 1, 0.5], dtype)])).translation
        np.testing.assert_allclose(p, 2 * n, rtol=0, atol=16 * eps)


@pytest.mark.parametrize("angle", [0.0, 1e-9, 0.6, 1.4, 2.5])
def test_complex_step_gives_the_derivative_of_the_exponential(mp, angle):
    V = twists(angle, 1, 9)[0]
    for k in range(6):
        E = hat(np.eye(6)[k])
        block = mp.expm(mp.matrix(np.block([[hat(V), E], [np.zeros((4, 4)), hat(V)]]).tolist()))
        truth = np.array(block[:4, 4:].tolist(), dtype=float)
        got = exp6(V + 1e-30j * np.eye(6)[k])
        np.testing.assert_allclose(got.rotation.imag / 1e-30, truth[:3, :3], rtol=0, atol=1e-14)
        np.testing.assert_allclose(got.translation.imag / 1e-30, truth[:3, 3], rtol=0, atol=1e-14)


@pytest.mark.parametrize("angle", [0.0, 1e-9, 0.6, 1.4, 2.5])
def test_complex_step_gives_the_derivative_of_the_logarithm(mp, angle):
    # dT = T hat(a) turns V by the inverse of the right Jacobian, the top right block of exp [[−V×, 1], [0, 0]].
    V = twists(angle, 1, 10)[0]
    block = mp.expm(mp.matrix(np.block([[-cross_motion(V), np.eye(6)], [np.zeros((6, 12))]]).tolist()))
    jacobian = np.array(mp.inverse(block[:6, 6:]).tolist(), dtype=float)
    T = exp6(V).matrix()
    got = np.stack([log6(T + 1e-30j * T @ hat(a)).imag / 1e-30 for a in np.eye(6)], axis=-1)
    np.testing.assert_allclose(got, jacobian, rtol=0, atol=2e-14)


# --- shapes, types, bad input --------------------------------------------------------------------


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("dtype", DTYPES)
def test_batch_axes_and_number_types_are_kept(shape, dtype):
    V = np.random.default_rng(11).uniform(-1, 1, size=(*shape, 6)).astype(dtype)
    V.flags.writeable = False
    T = exp6(V)
    assert T.rotation.shape == (*shape, 3, 3)
    assert T.translation.shape == (*shape, 3)
    assert T.rotation.dtype == T.translation.dtype == log6(T).dtype == log6(T.matrix()).dtype == dtype
    np.testing.assert_allclose(log6(T), V, rtol=0, atol=16 * float(np.finfo(dtype).eps))
    np.testing.assert_array_equal(log6(T), log6(T.matrix()))


def test_a_batch_may_mix_every_case():
    V = np.concatenate([twists(angle, 1, 12) for angle in [0.0, *ANGLES, np.pi]])
    np.testing.assert_array_equal(exp6(V).matrix(), [exp6(x).matrix() for x in V])
    np.testing.assert_array_equal(log6(exp6(V)), [log6(exp6(x)) for x in V])


def test_wrong_arguments_are_refused():
    with pytest.raises(ShapeError, match=r"V: expected shape \(\.\.\., 6\), got \(4, 4\)"):
        exp6(np.eye(4))
    with pytest.raises(ShapeError, match=r"T: expected shape \(\.\.\., 4, 4\), got \(6,\)"):
        log6(np.zeros(6))
    with pytest.raises(ShapeError, match="last row"):
        log6(np.ones((4, 4)))
    with pytest.raises(ShapeError, match="rotation"):
        log6(np.diag([1.0, 2.0, 1.0, 1.0]))


@pytest.mark.parametrize("size", [1.2e308, 1.7e308])
def test_a_length_beyond_all_numbers_is_refused_by_name(size):
    """Its square root would be finite, √3 times it is not."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValueError, match=r"^w: expected smaller numbers"):
            tw.exp3(np.full(3, size))
        with pytest.raises(ValueError, match=r"^V: expected smaller numbers"):
            tw.exp6(np.full(6, size))
        with pytest.raises(ValueError, match=r"^x: expected smaller numbers"):
            tw.screw(np.full(6, size))
        with pytest.raises(ValueError, match=r"^F, V: expected smaller numbers"):
            tw.power(np.full(6, size), np.full(6, size))
        assert np.allclose(tw.unskew(tw.skew(np.full(3, size))) / size, 1)
        assert np.isfinite(tw.exp3([size, 0, 0])).all()  # as large as its length, and no larger
