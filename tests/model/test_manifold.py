"""Derivatives of ⊕ and ⊖, interpolation and distance, for every kind of joint: steps, Pinocchio, and each other."""

import mpmath
import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge
from twistwrench import newton_euler_3d as slow
from twistwrench.model import KINDS, Joint

from ..robots import shared
from ..sampling import sampled
from ..spatial.test_jacobians import truth

SHAPES = [(), (1,), (3, 1, 2), (0,)]


def tree(kind, seed=0):
    return tw.random_tree(4, rng=seed, kinds=(kind,), base="floating" if kind == "free_flyer" else "fixed")


def states(model, seed, shape=()):
    rng = np.random.default_rng(seed)
    flat = np.prod(shape, dtype=int)
    q = [np.reshape([model.random_configuration(rng=rng) for _ in range(flat)], (*shape, model.nq)) for _ in range(2)]
    return *q, rng.normal(size=(*shape, model.nv))


KIND = pytest.mark.parametrize("kind", KINDS)
THREE_KINDS = pytest.mark.parametrize("kind", sampled(KINDS, 3))


def test_every_kind_of_joint_is_looked_at():
    ours = {kind for kind, joint in Joint.kinds.items() if joint.__module__.startswith("twistwrench.")}
    assert ours <= {*KINDS}


@pytest.mark.one_case
@KIND
def test_a_complex_step_gives_the_derivatives(kind):
    model, h = tree(kind), 1e-30
    q0, q1, v = states(model, 1)
    end, way, one = model.integrate(q0, v), model.difference(q0, q1), np.eye(model.nv)
    J_q, J_v = model.d_integrate(q0, v)
    J_0, J_1 = model.d_difference(q0, q1)
    for k, dv in enumerate(1j * h * one):
        ends = model.integrate(model.integrate(q0, dv), v), model.integrate(q0, v + dv)
        for J, moved in zip((J_q, J_v), ends):
            np.testing.assert_allclose(J[:, k], model.difference(end, moved).imag / h, rtol=0, atol=2e-14)
        ways = model.difference(model.integrate(q0, dv), q1), model.difference(q0, model.integrate(q1, dv))
        for J, changed in zip((J_0, J_1), ways):
            np.testing.assert_allclose(J[:, k], changed.imag / h, rtol=0, atol=5e-14)
            np.testing.assert_allclose(changed.real, way, rtol=0, atol=1e-14)


@THREE_KINDS
def test_the_derivatives_are_those_of_exp_to_fifty_digits(kind):
    """∂⊕ is S⁺ J_r(S v) S by v and S⁺ Ad(exp(−S v)) S by q, J_r by its series; ∂⊖ is S⁺ J_r⁻¹ S and −S⁺ J_l⁻¹ S."""
    model = tw.random_tree(1, rng=2, kinds=(kind,), base="floating" if kind == "free_flyer" else "fixed")
    q0, q1, v = states(model, 6)
    with mpmath.workdps(60):
        S = mpmath.matrix(model.joints[1].subspace().tolist())
        back = (S.T * S) ** -1 * S.T

        def restricted(J):
            return np.array((back * J * S).tolist(), float)

        V, way = (model.joints[1].subspace() @ x for x in (v, model.difference(q0, q1)))
        turned = mpmath.expm(mpmath.matrix((-tw.cross_motion(V)).tolist()))
        by_v, by_1, by_0 = truth(mpmath, V), truth(mpmath, way) ** -1, -(truth(mpmath, -way) ** -1)
        exact = [restricted(J) for J in (turned, by_v, by_0, by_1)]
    for J, right in zip((*model.d_integrate(q0, v), *model.d_difference(q0, q1)), exact):
        np.testing.assert_allclose(J, right, rtol=0, atol=4e-15 * np.abs(right).max())


@THREE_KINDS
def test_a_third_of_the_way_three_times_is_the_way_to_fifty_digits(kind):
    """(T₀⁻¹ T)³ = T₀⁻¹ T₁ for the placements of each joint; of a ball joint the distance is the angle."""
    model = tw.random_tree(1, rng=2, kinds=(kind,), base="floating" if kind == "free_flyer" else "fixed")
    q0, q1, _ = states(model, 7)

    def placement(q):
        R, p = (x[1] for x in slow.placements(model, slow.as_mpmath(q)))
        return mpmath.matrix(np.block([[R, p[:, None]], [np.zeros((1, 3), int), np.ones((1, 1), int)]]).tolist())

    with mpmath.workdps(50):
        start, there, end = (placement(q) for q in (q0, model.interpolate(q0, q1, 1 / 3), q1))
        step, whole = start**-1 * there, start**-1 * end
        assert mpmath.mnorm(step * step * step - whole) < 4e-15 * mpmath.mnorm(whole)
        if kind == "spherical":
            angle = mpmath.acos((whole[0, 0] + whole[1, 1] + whole[2, 2] - 1) / 2)
            assert abs(float(angle - float(model.distance(q0, q1)))) < 4e-15


@KIND
def test_pinocchio_has_the_same_derivatives_way_and_distance(kind):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    model = tree(kind, seed=3)
    there, (q0, q1, v) = bridge.to_pinocchio_model(model), states(model, 2)
    theirs = *pin.dIntegrate(there, q0, bridge.to_pinocchio_tangent(model, v)), *pin.dDifference(there, q0, q1)
    ours = *model.d_integrate(q0, v), *model.d_difference(q0, q1)
    for J, P in zip(ours, theirs):
        # Pinocchio's Jlog6 is good to about 1e-12.
        np.testing.assert_allclose(J, bridge.from_pinocchio_matrix(model, P), rtol=0, atol=2e-12)
    between = pin.interpolate(there, q0, q1, 0.3)
    assert model.distance(between, model.interpolate(q0, q1, 0.3)) < 1e-11
    assert model.distance(q0, q1) == pytest.approx(pin.distance(there, q0, q1), rel=1e-11)


@KIND
def test_the_derivatives_undo_each_other(kind):
    model = tree(kind, seed=1)
    q0, _, v = states(model, 3)
    q1 = model.integrate(q0, 0.5 * v)  # by less than half a turn, where ⊖ leads back
    v = model.difference(q0, q1)
    J_q, J_v = model.d_integrate(q0, v)
    J_0, J_1 = model.d_difference(q0, q1)
    np.testing.assert_allclose(J_1 @ J_v, np.eye(model.nv), rtol=0, atol=5e-14)  # q ⊕ v ⊖ q = v
    np.testing.assert_allclose(J_0 + J_1 @ J_q, np.zeros((model.nv, model.nv)), rtol=0, atol=5e-14)


@KIND
@pytest.mark.parametrize("shape", SHAPES)
def test_batch_axes_and_number_types_are_kept(kind, shape):
    model = tree(kind)
    q0, q1, v = states(model, 4, shape)
    for dtype in (np.float32, np.float64, np.longdouble, np.complex128):
        a, b, c = (x.astype(dtype) for x in (q0, q1, v))
        for J in (*model.d_integrate(a, c), *model.d_difference(a, b)):
            assert (J.shape, J.dtype) == ((*shape, model.nv, model.nv), dtype)
        assert model.interpolate(a, b, dtype(0.5).real).dtype == model.distance(a, b).dtype == dtype
    J_0, _ = model.d_difference(q0, q1)
    for k in np.ndindex(shape):
        np.testing.assert_allclose(J_0[k], model.d_difference(q0[k], q1[k])[0], rtol=0, atol=1e-15)


def test_a_way_has_its_ends_and_as_many_points_as_asked_for():
    model = shared("go2")
    q0, q1, _ = states(model, 5)
    way = model.interpolate(q0, q1, np.linspace(0, 1, 7))
    assert way.shape == (7, model.nq)
    ends = model.distance(way[[0, -1]], [q0, q1])
    np.testing.assert_allclose(ends, 0, atol=1e-13)
    steps = model.distance(way[:-1], way[1:])
    np.testing.assert_allclose(steps, np.full(6, model.distance(q0, q1) / 6), rtol=1e-13)


def test_a_joint_of_ones_own_without_a_unit_part_needs_no_derivative():
    class Sliding(Joint):
        kind, nq, nv = "sliding of test_manifold", 2, 2

        def subspace(self, dtype=np.float64):
            return np.eye(6, dtype=dtype)[:, 3:5]

        def transform(self, q):
            return tw.SE3(np.eye(3), np.concatenate([q, np.zeros_like(q[..., :1])], axis=-1))

    builder = tw.Builder("slider")
    builder.link("table", parent="base_link", joint=Sliding())
    model = builder.build()
    for J in model.d_integrate([1, 2], [3, 4]):
        np.testing.assert_array_equal(J, np.eye(2))
    np.testing.assert_array_equal(model.d_difference([1, 2], [3, 4])[0], -np.eye(2))
    Joint.kinds.pop(Sliding.kind)


def test_a_mimic_model_has_them_too():
    arm = shared("planar_arm")
    from twistwrench.algorithms.mimic import follow

    mimic = follow(arm, {"wrist": ("elbow", -1.0, 0.5)})
    np.testing.assert_array_equal(mimic.d_integrate([0.1, 0.2], [1, 2])[1], np.eye(2))
    assert mimic.distance([0, 0], [3, 4]) == 5


def test_errors_name_the_argument():
    model = shared("go2")
    with pytest.raises(tw.ShapeError, match="v_dt: expected shape"):
        model.d_integrate(model.neutral(), np.ones(19))
    with pytest.raises(ValueError, match="q1: joint 'root_joint': the quaternion"):
        model.d_difference(model.neutral(), 2 * model.neutral())
    with pytest.raises(ValueError, match="u: expected numbers"):
        model.interpolate(model.neutral(), model.neutral(), "half")


@pytest.mark.parametrize("kind", ["free_flyer", "planar"])
def test_a_difference_far_from_the_origin_and_a_small_turn_keep_their_digits(kind):
    """Positions and quaternions are subtracted first, which rounds nothing where they are close."""
    model = tree(kind)
    q0, _, _ = states(model, 3)
    joint, s = model.joints[1], model.q_slice[1]
    q0[s][: joint.unit.start] = [1e6, -3e6, 2e6][: joint.unit.start]
    q1 = q0.copy()
    q1[s.start] += 2.0**-20
    R = joint.transform(q0[s]).rotation
    expected = joint.subspace().mT @ np.concatenate([np.zeros(3), R[0] * 2.0**-20])
    np.testing.assert_allclose(model.difference(q0, q1)[model.v_slice[1]], expected, rtol=0, atol=1e-21)
    q1 = q0.copy()
    k = s.start + joint.unit.start
    q1[k] = np.nextafter(q1[k], 2)  # a turn of about 1e-16, right to all its digits
    with mpmath.workdps(50):
        a, b = (slow.as_mpmath(q[s][joint.unit]) for q in (q0, q1))
        if kind == "planar":
            turn = mpmath.atan2(a[0] * b[1] - a[1] * b[0], a @ b)
            ours = model.difference(q0, q1)[model.v_slice[1]][2]
            assert abs(ours - turn) < 1e-15 * abs(turn)
        else:
            turn = 2 * (a[3] * b[:3] - b[3] * a[:3] - slow.bodies.cross(a[:3], b[:3])) / (a @ a)
            ours = model.difference(q0, q1)[model.v_slice[1]][:3]
            assert abs(ours - turn).max() < 1e-15 * abs(turn).max()
