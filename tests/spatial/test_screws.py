"""Twists and wrenches made of their screws, and wrenches of forces at points: the way back from `screw`."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench.spatial import SE3, Screw, Twist, Wrench, exp6, screw

BOTH = pytest.mark.parametrize("kind", [Twist, Wrench])


@BOTH
def test_a_screw_and_its_numbers_lead_to_each_other(kind):
    x = kind(np.random.default_rng(0).normal(size=(3, 4, 6)), frame="base")
    back = kind.from_screw(*screw(x), frame="base")
    assert back.frame == "base"
    np.testing.assert_allclose(back.vector, x.vector, rtol=0, atol=4e-15)


@BOTH
def test_any_point_of_the_axis_will_do(kind):
    rng = np.random.default_rng(1)
    axis, point, along = rng.normal(size=3), rng.normal(size=3), np.linspace(-5, 5, 7)[:, None]
    x = kind.from_screw(axis, point + along * axis, 0.3, 2.0)
    np.testing.assert_allclose(x.vector, np.broadcast_to(x.vector[3], (7, 6)), rtol=0, atol=1e-14)
    found = screw(x)
    np.testing.assert_allclose(found.axis, np.broadcast_to(axis / np.linalg.norm(axis), (7, 3)), rtol=0, atol=1e-15)
    np.testing.assert_allclose(found.pitch, 0.3, rtol=1e-13)
    np.testing.assert_allclose(found.magnitude, 2.0, rtol=1e-15)


def test_the_numbers_of_modern_robotics():
    # ScrewToAxis: q = (3, 0, 0), s = (0, 0, 1), h = 2 gives (0, 0, 1, 0, -3, 2)
    np.testing.assert_array_equal(Twist.from_screw([0, 0, 1], [3, 0, 0], 2).vector, [0, 0, 1, 0, -3, 2])


def test_the_points_of_the_axis_move_along_it():
    axis, point, pitch = np.array([2.0, -1, 2]) / 3, np.array([0.3, 1, -0.5]), 0.25
    V = Twist.from_screw(axis, point, pitch, 2.5)
    np.testing.assert_allclose(exp6(V).act(point), point + pitch * 2.5 * axis, rtol=0, atol=4e-15)


@BOTH
def test_both_ways_are_right_to_fifty_digits(kind):
    """s and q × s + h s, times the magnitude; back, the pitch ω·v / ω² and the point ω × v / ω² next to the origin."""
    rng = np.random.default_rng(4)
    for axis, point, (pitch, size) in zip(*rng.normal(size=(2, 5, 3)), rng.uniform(0.2, 2, (5, 2))):
        x = kind.from_screw(axis, point, pitch, size)
        with mpmath.workdps(50):
            n = np.array([mpmath.mpf(k) for k in axis])
            n = size * n / mpmath.sqrt(n @ n)
            turning, along = n, np.cross(point, n) + pitch * n
            exact = np.r_[turning, along] if kind is Twist else np.r_[along, turning]
            np.testing.assert_allclose(x.vector, exact.astype(float), rtol=0, atol=1e-15 * np.abs(x.vector).max())
            w, v = (
                np.array([mpmath.mpf(k) for k in part]) for part in np.split(x.vector, 2)[:: 1 - 2 * (kind is Wrench)]
            )
            back = Screw(w / mpmath.sqrt(w @ w), np.cross(w, v) / (w @ w), w @ v / (w @ w), mpmath.sqrt(w @ w))
        for ours, right in zip(screw(x), back):
            np.testing.assert_allclose(ours, np.array(right, float), rtol=0, atol=4e-15 * max(1, np.abs(ours).max()))


def test_a_force_at_a_point_stays_exact_and_is_pinocchios():
    third = Fraction(1, 3)
    F = Wrench.from_force([third, 0, 1], [0, third, 2]).vector
    assert F.tolist() == [third, 2 * third, -(third**2), third, 0, 1]
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    f, p = np.random.default_rng(5).normal(size=(2, 3))
    there = pin.SE3(np.eye(3), p).act(pin.Force(f, np.zeros(3)))
    np.testing.assert_allclose(Wrench.from_force(f, p).vector, [*there.angular, *there.linear], rtol=0, atol=1e-15)


@BOTH
def test_an_infinite_pitch_is_a_translation_or_a_couple(kind):
    x = kind.from_screw([0, 3, 4], [7, 7, 7], np.inf, 2.0)
    assert x == (Twist([0, 0, 0, 0, 1.2, 1.6]) if kind is Twist else Wrench([0, 1.2, 1.6, 0, 0, 0]))
    assert screw(x).pitch == np.inf
    mixed = kind.from_screw([0, 0, 1], pitch=[0.5, np.inf], magnitude=[1.0, 2.0])
    assert mixed.vector.shape == (2, 6)
    np.testing.assert_array_equal(screw(mixed).pitch, [0.5, np.inf])


def test_a_force_at_a_point_spends_its_power_on_the_velocity_of_that_point():
    rng = np.random.default_rng(2)
    f, p, V, couple = *rng.normal(size=(2, 5, 3)), rng.normal(size=(5, 6)), rng.normal(size=3)
    velocity = V[:, 3:] + np.cross(V[:, :3], p)
    np.testing.assert_allclose(Wrench.from_force(f, p).power(V), (f * velocity).sum(-1), rtol=0, atol=4e-15)
    more = Wrench.from_force(f, p, couple) - Wrench.from_force(f, p)
    np.testing.assert_allclose(more.vector, np.broadcast_to([*couple, 0, 0, 0], (5, 6)), rtol=0, atol=4e-15)


def test_a_force_at_a_point_is_a_pure_force_in_another_frame():
    f, p = np.array([1.0, 2, 3]), np.array([0.5, -1, 2])
    there = Wrench([0, 0, 0, *f]).transform(SE3(np.eye(3), p))
    np.testing.assert_array_equal(Wrench.from_force(f, p).vector, there.vector)
    np.testing.assert_allclose(screw(Wrench.from_force(f, p)).pitch, 0, atol=1e-16)


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble, np.complex128])
@pytest.mark.parametrize("shape", [(), (1,), (3, 1, 2), (0,)])
def test_batch_axes_and_number_types_are_kept(dtype, shape):
    x = Twist(np.random.default_rng(3).normal(size=(*shape, 6)).astype(dtype))
    back = Twist.from_screw(*screw(x)).vector
    assert (back.shape, back.dtype) == ((*shape, 6), dtype)
    np.testing.assert_allclose(back, x.vector, rtol=0, atol=30 * np.finfo(dtype).eps)
    F = Wrench.from_force(x.linear, x.angular)
    assert (F.vector.shape, F.vector.dtype) == ((*shape, 6), dtype)


def test_errors_name_the_argument():
    with pytest.raises(tw.SingularError, match=r"axis: the zero vector has no direction at index \(1,\)"):
        Twist.from_screw([[0, 0, 1], [0, 0, 0]])
    with pytest.raises(ValueError, match="magnitude: expected finite numbers"):
        Twist.from_screw([0, 0, 1], magnitude=np.inf)
    with pytest.raises(tw.ShapeError, match="point: expected shape"):
        Wrench.from_force([1, 2, 3], [1, 2])
    assert Screw._fields == ("axis", "point", "pitch", "magnitude")  # the order of from_screw's arguments
