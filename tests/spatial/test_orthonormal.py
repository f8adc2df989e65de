"""Rotations that have lost digits: what is refused, what is repaired, and what a finer number type changes."""

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench.arrays import conversion as checks
from twistwrench.model import state
from twistwrench.spatial import rotation, rpy_to_rotation
from twistwrench.spatial._elementary import series

BITS_113 = 2.0**-112
"""Spacing of the numbers next to 1 in a long double of Linux on ARM and of WebAssembly."""


def turns(n=5, seed=0):
    return tw.exp3(np.random.default_rng(seed).standard_normal((n, 3)))


def polar(R):
    """The orthogonal factor of the polar decomposition, by singular values."""
    U, _, Vt = np.linalg.svd(R)
    return U @ Vt


@pytest.mark.parametrize("lose", [lambda R: R.round(7), lambda R: R.astype(np.float32).astype(float)])
def test_a_rotation_that_was_rounded_is_refused_with_its_repair_and_repaired(lose):
    R = lose(turns())
    for function in (lambda x: tw.SE3(x, np.zeros(3)), tw.log3, rotation.rotation_to_quaternion):
        with pytest.raises(tw.ShapeError, match=r"\|RᵀR − 1\| = .*; nearest_rotation\((R|rotation)\) repairs it$"):
            function(R)
    repaired = tw.nearest_rotation(R)
    tw.SE3(repaired, np.zeros(3))
    np.testing.assert_allclose(repaired.mT @ repaired, np.broadcast_to(np.eye(3), (5, 3, 3)), rtol=0, atol=1e-15)
    np.testing.assert_allclose(repaired, polar(R), rtol=0, atol=1e-14)  # what the singular values lose
    np.testing.assert_allclose(tw.log3(repaired), tw.log3(turns()), rtol=0, atol=1e-6)


@pytest.mark.parametrize("size", [1e-3, 1e-2, 0.03, 0.1, 0.3])
def test_the_nearest_rotation_is_the_polar_factor(size):
    R = turns(50) @ (np.eye(3) + size * np.random.default_rng(1).uniform(-1, 1, (50, 3, 3)))
    np.testing.assert_allclose(tw.nearest_rotation(R), polar(R), rtol=0, atol=1e-14)


@pytest.mark.parametrize("stretch", [[2, 2, 2], [1e200, 1e199, 1e200], [1e-160] * 3, [1, 1e-3, 1e3], [1, 1e-6, 1]])
def test_scaled_and_stretched_matrices_are_projected(stretch):
    """R P with P symmetric and positive definite: R is the rotation, whatever P."""
    R, axes = turns(20, 3), turns(20, 4)
    P = axes @ (np.array(stretch)[:, None] * axes.mT)
    room = 1e-15 * max(stretch) / min(stretch) + 1e-14
    np.testing.assert_allclose(tw.nearest_rotation(R @ P), R, rtol=0, atol=room)
    near = np.concatenate([R, R @ P])  # some items are rotations already
    np.testing.assert_allclose(tw.nearest_rotation(near), np.concatenate([R, R]), rtol=0, atol=room)
    np.testing.assert_allclose(tw.nearest_rotation((2 * R).astype(np.float32)), R, rtol=0, atol=1e-6)


def test_a_measured_rotation_is_projected_as_mujoco_does():
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: it is not asked")
    for R in turns(10) + np.random.default_rng(6).normal(0, 0.1, (10, 3, 3)):
        quaternion, there = np.array([1.0, 0, 0, 0]), np.zeros(9)
        mujoco.mju_mat2Rot(quaternion, R.ravel())
        mujoco.mju_quat2Mat(there, quaternion)
        np.testing.assert_allclose(tw.nearest_rotation(R), there.reshape(3, 3), rtol=0, atol=1e-6)


def test_a_matrix_of_rank_two_has_no_determinant_whatever_sign_rounding_leaves():
    given = np.arange(1.0, 10).reshape(3, 3)
    for R in (given, given[::-1], given[[1, 0, 2]], given.T):
        with pytest.raises(ValueError, match="positive determinant, got zero"):
            tw.nearest_rotation(R)


@pytest.mark.parametrize("bad", [np.diag([1, 1, -1.0]), np.zeros((3, 3)), np.ones((3, 3)), np.diag([1, 1, 0.0])])
def test_without_a_positive_determinant_no_rotation_is_the_nearest(bad):
    with pytest.raises(ValueError, match=r"^R: .* positive determinant, .* at index \(1,\)$") as e:
        tw.nearest_rotation([np.eye(3), bad])
    assert not isinstance(e.value, tw.ShapeError)


@pytest.mark.parametrize("size", [1e-7, 1e-3, 0.03])
def test_the_nearest_rotation_is_right_to_fifty_digits(size):
    """The orthogonal factor by Newton's iteration, X ← ½ (X + X⁻ᵀ), in mpmath's numbers."""
    R = turns(3) @ (np.eye(3) + size * np.random.default_rng(5).uniform(-1, 1, (3, 3, 3)) / 3)
    for ours, given in zip(tw.nearest_rotation(R), R):
        with mpmath.workdps(50):
            X = mpmath.matrix(given.tolist())
            for _ in range(8):
                X = (X + (X**-1).T) / 2
        np.testing.assert_allclose(ours, np.array(X.tolist(), float), rtol=0, atol=1e-15)


def test_batch_axes_are_kept():
    for shape in ((1,), (3, 1, 2), (0,)):
        R = tw.exp3(np.random.default_rng(6).normal(size=(*shape, 3)))
        assert tw.nearest_rotation(R).shape == (*shape, 3, 3)


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
def test_it_keeps_the_number_type_and_what_is_right_already(dtype):
    R = tw.exp3(np.array([0.3, -0.2, 0.1], dtype))
    repaired = tw.nearest_rotation(R)
    assert repaired.dtype == dtype
    assert abs(repaired - R).max() <= 4 * np.finfo(dtype).eps
    assert abs(repaired.T @ repaired - np.eye(3, dtype=dtype)).max() <= 4 * np.finfo(dtype).eps
    widened = tw.nearest_rotation(tw.exp3([0.3, -0.2, 0.1]).astype(np.longdouble))
    assert abs(widened.T @ widened - np.eye(3)).max() <= 4 * np.finfo(np.longdouble).eps


def test_it_ends_where_rounding_gains_an_ulp_with_every_step():
    """Near the gimbal lock of roll and yaw, entries of 1e-7 next to 1: a billion steps of one ulp each."""
    for away in 10.0 ** -np.arange(5, 17):
        R = rpy_to_rotation(np.stack([x := np.linspace(-3, 3, 200), 0 * x + np.pi / 2 - away, 2 - x], axis=-1))
        repaired = tw.nearest_rotation(R)
        np.testing.assert_allclose(repaired, R, rtol=0, atol=1e-15)


def test_a_complex_step_differentiates_the_nearest_rotation():
    rng = np.random.default_rng(2)
    for R in (turns(1)[0], turns(1)[0].round(4), turns(1)[0] @ (np.eye(3) + rng.uniform(-0.2, 0.2, (3, 3)))):
        step = rng.standard_normal((3, 3))
        slope = tw.nearest_rotation(R + 1e-30j * step).imag / 1e-30
        central = (polar(R + 1e-5 * step) - polar(R - 1e-5 * step)) / 2e-5
        np.testing.assert_allclose(slope, central, rtol=0, atol=1e-9)


# ---------------------------------------------------------------- a long double of 113 bits


@pytest.fixture
def _of_113_bits(monkeypatch):
    original = checks.resolution
    for module in (checks, state):
        monkeypatch.setattr(module, "resolution", lambda t: BITS_113 if np.dtype(t) == np.longdouble else original(t))


@pytest.mark.usefixtures("_of_113_bits")
def test_what_is_right_as_doubles_is_right_in_113_bits():
    R = turns(200)
    assert np.finfo(np.longdouble).eps <= np.finfo(np.float64).eps
    assert abs(R.mT @ R - np.eye(3)).max() > BITS_113**0.5  # more than the root of that resolution
    wide = R.astype(np.longdouble)
    assert tw.log3(wide).dtype == np.longdouble
    tw.SE3(wide, np.zeros(3))
    tw.SE3.from_matrix(tw.SE3(wide, np.zeros(3)).matrix())
    tw.unskew(tw.skew(tw.log3(wide)))
    model, rng = tw.load("go2"), np.random.default_rng(3)
    for _ in range(20):
        q = model.random_configuration(rng=rng).astype(np.longdouble)  # its quaternion has norm 1 as doubles have
        v = np.zeros(model.nv, np.longdouble)
        tau = tw.rnea(model, q, v, v)
        assert tau.dtype == np.longdouble
        np.testing.assert_allclose(tau.astype(float), tw.rnea(model, *(x.astype(float) for x in (q, v, v))), atol=1e-11)
    with pytest.raises(tw.ShapeError, match="nearest_rotation"):
        tw.log3(wide + np.longdouble(1e-12))


@pytest.mark.parametrize("bits", [24, 53, 64, 113, 237])
def test_the_series_of_exp_have_as_many_terms_as_the_resolution_asks_for(bits):
    with mpmath.workprec(2 * bits + 50):
        eps = mpmath.mpf(2) ** (1 - bits)
        for x in (mpmath.mpf(1), mpmath.mpf("0.999"), mpmath.mpf("0.5"), mpmath.mpf("1e-3")):
            here = np.array([x], object)
            sine = series(here, 4, 5, float(eps))[0] / 6 * x**3
            cosine = series(here, 2, 5, float(eps))[0] / 3 * x**3
            assert abs(sine / (x - mpmath.sin(x)) - 1) <= eps
            assert abs(cosine / (mpmath.sin(x) - x * mpmath.cos(x)) - 1) <= eps
