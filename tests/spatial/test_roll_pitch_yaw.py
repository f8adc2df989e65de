"""Roll, pitch and yaw: back from a rotation, and their rates. What Pinocchio's, Drake's and spatialmath's tests ask."""

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench.spatial import rotation_to_quaternion, rotation_to_rpy, rpy_jacobian, rpy_to_rotation

SHAPES = [(), (1,), (3, 1, 2), (0,)]
ANGLES = np.stack(np.meshgrid([-np.pi, -2.0, 0, 0.1, 3], [-1.5, -0.3, 0, 1.2], [-3, 0, 0.7, np.pi]), axis=-1)


def test_angles_come_back_where_the_pitch_is_below_a_quarter_turn():
    off = rotation_to_rpy(rpy_to_rotation(ANGLES)) - ANGLES
    np.testing.assert_allclose((off + np.pi) % (2 * np.pi) - np.pi, 0, rtol=0, atol=3e-15)
    beyond = rotation_to_rpy(rpy_to_rotation([0.2, 2.0, 0.4]))  # the same turn with a pitch of π − 2
    np.testing.assert_allclose(beyond, [0.2 - np.pi, np.pi - 2.0, 0.4 - np.pi], rtol=0, atol=1e-15)
    np.testing.assert_array_equal(rotation_to_rpy(np.eye(3)), 0)


@pytest.mark.parametrize("sign", [1, -1])
def test_near_the_gimbal_lock_the_three_angles_make_the_rotation_to_its_last_digits(sign):
    """Roll and yaw, read each by itself, would leave 1e-16 / cos(pitch) of it wrong."""
    x = np.linspace(-3, 3, 40)
    for away in (1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.0):
        R = rpy_to_rotation(np.stack([x, 0 * x + sign * (np.pi / 2 - away), 2 - x], axis=-1))
        R = tw.nearest_rotation(R)
        np.testing.assert_allclose(rpy_to_rotation(rotation_to_rpy(R)), R, rtol=0, atol=6e-16)
    locked = np.array([[0.0, 0, sign], [0, 1, 0], [-sign, 0, 0]])
    np.testing.assert_array_equal(rotation_to_rpy(locked), [0, sign * np.pi / 2, 0])
    with pytest.raises(
        tw.SingularError, match=r"^R: roll and yaw have no derivative at a pitch of ±π/2 at index \(1,\)"
    ):
        rotation_to_rpy(np.stack([np.eye(3), locked]).astype(complex))


def test_the_jacobian_is_the_rate_of_the_rotation():
    rates, h = np.array([-2.1, 3.3, 5.7]), 1e-30
    R, J = rpy_to_rotation(ANGLES), rpy_jacobian(ANGLES)
    turned = rpy_to_rotation(ANGLES + 1j * h * rates).imag / h  # Ṙ = R [ω]×
    omega = tw.unskew(R.mT @ turned)
    np.testing.assert_allclose(np.matvec(J, rates), omega, rtol=0, atol=1e-14)
    np.testing.assert_allclose(rpy_jacobian(ANGLES, "world"), R @ J, rtol=0, atol=1e-15)
    back = rotation_to_rpy(R + 1j * h * turned).imag / h
    np.testing.assert_allclose(back, np.broadcast_to(rates, back.shape), rtol=0, atol=2e-13)  # 1/cos 1.5 = 14
    np.testing.assert_allclose(np.linalg.det(J), np.cos(ANGLES[..., 1]), rtol=0, atol=1e-15)
    assert np.linalg.matrix_rank(rpy_jacobian([0.2, np.pi / 2, 0.4])) == 2  # what Drake and Pinocchio refuse to invert


def test_pinocchio_has_the_same_angles_jacobian_and_rate_of_it():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    h, rates = 1e-30, np.array([0.3, -1.2, 0.8])
    for rpy in ANGLES.reshape(-1, 3)[::3]:
        R = rpy_to_rotation(rpy)
        np.testing.assert_allclose(R, pin.rpy.rpyToMatrix(rpy), rtol=0, atol=1e-15)
        np.testing.assert_allclose(rpy_to_rotation(pin.rpy.matrixToRpy(R)), R, rtol=0, atol=1e-15)
        for reference, there in (("local", pin.LOCAL), ("world", pin.WORLD)):
            J = rpy_jacobian(rpy, reference)
            np.testing.assert_allclose(J, pin.rpy.computeRpyJacobian(rpy, there), rtol=0, atol=1e-15)
            inverse = pin.rpy.computeRpyJacobianInverse(rpy, there)
            np.testing.assert_allclose(np.linalg.inv(J), inverse, rtol=0, atol=1e-13)
            slope = rpy_jacobian(rpy + 1j * h * rates, reference).imag / h
            theirs = pin.rpy.computeRpyJacobianTimeDerivative(rpy, rates, there)
            np.testing.assert_allclose(slope, theirs, rtol=0, atol=2e-15)


def test_the_numbers_of_drake_and_spatialmath():
    """`RotationMatrixToQuaternion` of three angles; `tr2rpy` of 20°, 10°, 30°; the body rates of (0.2, 0.3, 0.4)."""
    r, p, _ = rpy = np.array([0.2, 0.3, 0.4])
    half = [(np.cos(a / 2), np.sin(a / 2)) for a in rpy]
    (cr, sr), (cp, sp), (cy, sy) = half
    expected = [sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
                cr * cp * cy + sr * sp * sy]  # fmt: skip
    np.testing.assert_allclose(rotation_to_quaternion(rpy_to_rotation(rpy)), expected, rtol=0, atol=2e-16)
    rates = np.array([-2.1, 3.3, 5.7])
    local = [rates[0] - np.sin(p) * rates[2], np.cos(r) * rates[1] + np.sin(r) * np.cos(p) * rates[2],
             np.cos(p) * np.cos(r) * rates[2] - np.sin(r) * rates[1]]  # fmt: skip
    np.testing.assert_allclose(rpy_jacobian(rpy) @ rates, local, rtol=0, atol=2e-15)
    back = rotation_to_rpy(
        tw.exp3([0, 0, np.radians(30)]) @ tw.exp3([0, np.radians(10), 0]) @ tw.exp3([np.radians(20), 0, 0])
    )
    np.testing.assert_allclose(np.degrees(back), [20, 10, 30], rtol=1e-15)


def test_three_angles_are_right_to_fifty_digits():
    with mpmath.workdps(50):
        for rpy in ANGLES.reshape(-1, 3)[::7]:
            R = rpy_to_rotation(rpy)
            (cr, sr), (cp, sp), (cy, sy) = ((mpmath.cos(float(a)), mpmath.sin(float(a))) for a in rpy)
            truth = [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]]  # fmt: skip
            assert max(abs(mpmath.mpf(float(R[i, j])) - truth[i][j]) for i in range(3) for j in range(3)) < 3e-16
            J = np.diag(rpy_jacobian(rpy))
            assert max(abs(mpmath.mpf(float(a)) - b) for a, b in zip(J, (1, cr, cr * cp), strict=True)) < 3e-16


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble, np.complex64, np.complex128])
def test_batch_axes_and_number_types_are_kept(shape, dtype):
    rpy = np.random.default_rng(5).uniform(-1, 1, (*shape, 3)).astype(dtype)
    R, J = rpy_to_rotation(rpy), rpy_jacobian(rpy, "world")
    back = rotation_to_rpy(R)
    assert R.shape == J.shape == (*shape, 3, 3)
    assert back.shape == (*shape, 3)
    assert {x.dtype for x in (R, J, back)} == {np.dtype(dtype)}
    np.testing.assert_allclose(back, rpy, rtol=0, atol=16 * np.finfo(dtype).eps)


def test_errors_name_the_argument():
    for function in (rpy_to_rotation, rpy_jacobian):
        with pytest.raises(tw.ShapeError, match=r"^rpy: expected shape \(\.\.\., 3\), got \(4,\)"):
            function(np.ones(4))
    with pytest.raises(tw.ShapeError, match=r"^R: expected a rotation matrix"):
        rotation_to_rpy(2 * np.eye(3))
    with pytest.raises(ValueError, match="reference: expected 'local' or 'world', got 'body'"):
        rpy_jacobian(np.zeros(3), "body")
