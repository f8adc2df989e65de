"""Velocity, acceleration and Jacobian of points given at run time: complex steps, Pinocchio, a frame at the point."""

from fractions import Fraction

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge
from twistwrench.algorithms.mimic import follow
from twistwrench.spatial import SE3

from ..robots import shared
from ..strategies import BATCHES, random_state
from .test_factorization import wheels

POINT = np.array([0.3, -0.2, 0.5])


def case(seed):
    model = tw.random_tree(5, rng=seed, base=("fixed", "floating")[seed % 2])
    return model, model.joint_names[-1], random_state(model, rng=seed)


@pytest.mark.parametrize("seed", range(6))
def test_a_complex_step_in_time_gives_velocity_and_acceleration(seed):
    model, frame, (q, v, a, _, _) = case(seed)
    h = 1e-30
    x = tw.frame_placement(model, model.integrate(q, 1j * h * v), frame).act(POINT)
    np.testing.assert_allclose(tw.point_velocity(model, q, v, frame, POINT), x.imag / h, rtol=0, atol=1e-13)
    later = tw.point_velocity(model, model.integrate(q, 1j * h * v), v + 1j * h * a, frame, POINT)
    np.testing.assert_allclose(tw.point_acceleration(model, q, v, a, frame, POINT), later.imag / h, rtol=0, atol=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_pinocchio_has_the_same_of_a_frame_at_the_point(seed):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    model, frame, (q, v, a, _, _) = case(seed)
    there, (V, A) = bridge.to_pinocchio_model(model), (bridge.to_pinocchio_tangent(model, x) for x in (v, a))
    i, at = model.frame(frame).body, model.frame(frame).placement @ SE3(np.eye(3), POINT)
    k = there.addFrame(pin.Frame("point", i, 0, bridge.to_pinocchio_se3(at), pin.FrameType.OP_FRAME))
    data, aligned = there.createData(), pin.LOCAL_WORLD_ALIGNED
    pin.forwardKinematics(there, data, q, V, A)
    velocity = pin.getFrameVelocity(there, data, k, aligned).linear
    np.testing.assert_allclose(tw.point_velocity(model, q, v, frame, POINT), velocity, rtol=0, atol=1e-13)
    acceleration = pin.getFrameClassicalAcceleration(there, data, k, aligned).linear
    np.testing.assert_allclose(tw.point_acceleration(model, q, v, a, frame, POINT), acceleration, rtol=0, atol=1e-12)
    J = bridge.from_pinocchio_jacobian(model, pin.computeFrameJacobian(there, data, q, k, aligned))[3:]
    np.testing.assert_allclose(tw.point_jacobian(model, q, frame, POINT), J, rtol=0, atol=1e-13)


def test_a_force_at_the_point_does_the_same_as_its_wrench():
    model, q = shared("go2"), shared("go2").standing()
    f, i = np.array([1.0, 2, 3]), model.frame("FR_calf").body
    f_ext, T = np.zeros((model.nbodies, 6)), tw.frame_placement(model, q, model.joint_names[i])
    at = model.frame("FR_calf").placement.act(POINT)
    f_ext[i] = tw.Wrench.from_force(T.rotation.T @ f, at).vector
    zero = np.zeros(model.nv)
    tau = tw.rnea(model, q, zero, zero) - tw.rnea(model, q, zero, zero, f_ext)
    np.testing.assert_allclose(tw.point_jacobian(model, q, "FR_calf", POINT).T @ f, tau, rtol=0, atol=1e-13)


def test_points_in_a_circle_move_on_circles():
    pendulum = shared("pendulum")
    points = np.array([[0, 0, -1.0], [0.5, 0, 0], [0, 2, 0]])
    x = tw.frame_placement(pendulum, [0.3], "bob").act(points)
    v = tw.point_velocity(pendulum, [0.3], [2.0], "bob", points)
    np.testing.assert_allclose(v, np.cross([0, 2.0, 0], x), rtol=0, atol=1e-15)
    a = tw.point_acceleration(pendulum, [0.3], [2.0], [0.0], "bob", points)
    np.testing.assert_allclose(a, -4 * x * [1, 0, 1], rtol=0, atol=1e-14)


def test_batches_of_states_and_a_mimic_model():
    model, frame, _ = case(1)
    s = random_state(model, rng=0, batch=(2, 3))
    J = tw.point_jacobian(model, s.q, frame, POINT)
    assert J.shape == (2, 3, 3, model.nv)
    each = tw.point_acceleration(model, s.q[1, 2], s.v[1, 2], s.a[1, 2], frame, POINT)
    np.testing.assert_allclose(
        tw.point_acceleration(model, s.q, s.v, s.a, frame, POINT)[1, 2], each, rtol=0, atol=1e-13
    )
    arm = shared("planar_arm")
    mimic = follow(arm, {"wrist": ("elbow", -1.0, 0.5)})
    full, rates = mimic.expand([0.1, 0.2], [1.0, 2.0])
    expected = tw.point_velocity(arm, full, rates, "tool", POINT)
    np.testing.assert_allclose(
        tw.point_velocity(mimic, [0.1, 0.2], [1, 2], "tool", POINT), expected, rtol=0, atol=1e-15
    )


@pytest.mark.parametrize("dtype", [np.float32, np.longdouble, np.complex128])
@pytest.mark.parametrize("batch", BATCHES, ids=str)
def test_every_number_type_and_batch_is_kept(dtype, batch):
    model, frame, _ = case(1)
    s, point = random_state(model, rng=0, batch=batch, dtype=dtype), POINT.astype(dtype)
    found = (
        tw.point_velocity(model, s.q, s.v, frame, point),
        tw.point_acceleration(model, s.q, s.v, s.a, frame, point),
        tw.point_jacobian(model, s.q, frame, point),
    )
    for x, tail in zip(found, ((3,), (3,), (3, model.nv))):
        assert (x.dtype, x.shape) == (dtype, (*batch, *tail))
    if not batch and dtype != np.complex128:
        q, v, a, there = (x.astype(float) for x in (*s[:3], point))
        double = tw.point_acceleration(model, model.normalize(q), v, a, frame, there)
        np.testing.assert_allclose(found[1], double, rtol=0, atol=300 * max(np.finfo(dtype).eps, 2.0**-52))


def test_fractions_and_symbols_stay_exact():
    model, third = wheels(), Fraction(1, 3)
    q = np.array([Fraction(3, 5), Fraction(4, 5), Fraction(5, 13), Fraction(-12, 13), third])
    v, a = np.array([third, Fraction(2), Fraction(-1, 7)]), np.array([Fraction(1), -third, Fraction(0)])
    point = [third, 0, Fraction(2, 7)]
    J = tw.point_jacobian(model, q, "b", point)
    assert (tw.point_velocity(model, q, v, "b", point) == J @ v).all()
    of_v = tw.point_acceleration(model, q, v, 0 * a, "b", point)
    assert (tw.point_acceleration(model, q, v, a, "b", point) == J @ a + of_v).all()
    assert all(isinstance(x, Fraction) for x in of_v)
    sympy = pytest.importorskip("sympy", reason="SymPy is not installed: no symbols")
    angle, rate = sympy.symbols("q w", real=True)
    x, _, z = tw.point_velocity(shared("pendulum"), [angle], [rate], "bob", [0, 0, -1])
    assert sympy.simplify(x + 2 * rate * sympy.cos(angle)) == sympy.simplify(z - 2 * rate * sympy.sin(angle)) == 0


def test_errors_name_the_argument():
    model = shared("pendulum")
    with pytest.raises(tw.ShapeError, match="point: expected shape"):
        tw.point_jacobian(model, [0.0], "bob", [1, 2])
    with pytest.raises(tw.NameNotFound, match="unknown frame 'bib'"):
        tw.point_velocity(model, [0.0], [0.0], "bib", POINT)
