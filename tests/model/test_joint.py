"""The joints, one kind at a time: their manifold, and that S is how they move."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import twistwrench as tw
from twistwrench import bridge
from twistwrench.model import KINDS, AxisJoint, Joint

from ..strategies import examples

OBLIQUE = np.array([0.48, -0.6, 0.64])
JOINTS = {kind: Joint.kinds[kind].sample(np.random.default_rng(0)) for kind in KINDS}
JOINTS |= {
    f"{kind} {axis}": replace(joint, axis=axis)
    for axis, (kind, joint) in product("xyz", JOINTS.items())
    if isinstance(joint, AxisJoint)
}
TURNING = {name: joint for name, joint in JOINTS.items() if joint.unit is not None}
QUATERNIONS = {name: joint for name, joint in JOINTS.items() if name in ("spherical", "free_flyer")}

every_joint = pytest.mark.parametrize("joint", JOINTS.values(), ids=JOINTS)
turning_joint = pytest.mark.parametrize("joint", TURNING.values(), ids=TURNING)


def draw(joint, rng, dtype=np.float64):
    free = np.full(joint.nq, np.inf)
    q = joint.random(rng, -free, free).astype(dtype)
    return joint.normalize(q)


def same_placement(A, B, tolerance=1e-13):
    return bool(np.abs(A.matrix() - B.matrix()).max() < tolerance)


# ---------------------------------------------------------------- what each joint does, by hand


def test_each_kind_moves_its_frame_as_its_name_says():
    c, s = np.cos(0.3), np.sin(0.3)
    about_z = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    half = [0.0, 0.0, np.sin(0.15), np.cos(0.15)]
    cases = [
        (tw.Revolute("z"), [0.3], about_z, [0, 0, 0]),
        (tw.Revolute([0, 0, -2]), [-0.3], about_z, [0, 0, 0]),
        (tw.Continuous("z"), [c, s], about_z, [0, 0, 0]),
        (tw.Prismatic([0, 3, 4]), [0.5], np.eye(3), [0, 0.3, 0.4]),
        (tw.Helical("z", 0.5), [0.3], about_z, [0, 0, 0.15]),
        (tw.Helical([0, 0, -2], -0.5), [-0.3], about_z, [0, 0, -0.15]),
        (tw.Planar(), [1, 2, c, s], about_z, [1, 2, 0]),
        (tw.Spherical(), half, about_z, [0, 0, 0]),
        (tw.FreeFlyer(), [1, 2, 3, *half], about_z, [1, 2, 3]),
    ]
    for joint, q, R, p in cases:
        T = joint.transform(np.array(q, dtype=float))
        assert np.allclose(T.rotation, R, rtol=0, atol=1e-15), joint
        assert np.allclose(T.translation, p, rtol=0, atol=1e-15), joint


def test_oblique_axis_stays_where_it_is_while_the_rest_turns():
    T = tw.Revolute(OBLIQUE).transform(np.array([2.0]))
    assert np.allclose(T.rotation @ OBLIQUE, OBLIQUE, rtol=0, atol=1e-15)
    assert np.isclose(np.trace(T.rotation), 1 + 2 * np.cos(2.0), rtol=1e-14)
    across = np.cross(OBLIQUE, [1.0, 0, 0])
    assert np.cross(across, T.rotation @ across) @ OBLIQUE > 0  # right-handed for an angle below π


def test_planar_velocity_is_that_of_the_moved_frame():
    joint, q = tw.Planar(), np.array([0.0, 0.0, 0.0, 1.0])  # turned by 90°: its x is the joint frame's y
    assert np.allclose(joint.integrate(q, np.array([1.0, 0, 0])), [0, 1, 0, 1], rtol=0, atol=1e-15)


@every_joint
def test_neutral_moves_nothing(joint):
    assert joint.neutral().shape == (joint.nq,)
    assert (joint.transform(joint.neutral()).matrix() == np.eye(4)).all()


@every_joint
def test_subspace_has_one_unit_twist_per_degree_of_freedom(joint):
    """Unit in its turn, or in its slide where it does not turn; orthonormal where difference() reads it by Sᵀ."""
    S = joint.subspace()
    assert S.shape == (6, joint.nv)
    assert np.linalg.matrix_rank(S) == joint.nv
    for column in S.mT:
        assert np.isclose(np.linalg.norm(column[:3] if column[:3].any() else column[3:]), 1, rtol=0, atol=1e-15)
    if joint.unit is not None:
        assert np.allclose(S.mT @ S, np.eye(joint.nv), rtol=0, atol=1e-15)


# ---------------------------------------------------------------- S is the derivative of the placement


@every_joint
def test_subspace_is_the_derivative_of_the_placement(joint):
    rng = np.random.default_rng(0)
    for _ in range(5):
        q, v = draw(joint, rng), rng.standard_normal(joint.nv)
        T, moved = joint.transform(q), joint.transform(joint.integrate(q, 1e-20j * v))
        rate = moved.matrix().imag / 1e-20
        body_twist = tw.vee(np.linalg.inv(T.matrix()) @ rate)
        assert np.allclose(body_twist, joint.subspace() @ v, rtol=0, atol=1e-14)


@turning_joint
def test_step_is_the_exponential_of_its_twist(joint):
    rng = np.random.default_rng(1)
    for _ in range(5):
        q, v = draw(joint, rng), rng.standard_normal(joint.nv)
        stepped = joint.transform(joint.integrate(q, v))
        assert same_placement(stepped, joint.transform(q) @ tw.exp6(joint.subspace() @ v))


# ---------------------------------------------------------------- there and back on the manifold


@every_joint
@given(seed=st.integers(0, 2**32 - 1), size=st.sampled_from([1e-300, 1e-12, 1e-6, 1e-3, 1.0, 3.1]))
@examples(25)
def test_difference_undoes_integrate_for_turns_below_pi(joint, seed, size):
    rng = np.random.default_rng(seed)
    q, dv = draw(joint, rng), rng.standard_normal(joint.nv)
    dv *= size / np.sqrt((dv**2).sum())
    back = joint.difference(q, joint.integrate(q, dv))
    # q has entries of order 1: a step below 1e-16 is lost on it, whatever is done.
    assert np.abs(back - dv).max() < 1e-13 * max(1.0, 1 / (np.pi - size) if size > 3 else 1.0)


@every_joint
@given(seed=st.integers(0, 2**32 - 1))
@examples(25)
def test_integrate_undoes_difference_up_to_the_sign_of_a_quaternion(joint, seed):
    rng = np.random.default_rng(seed)
    q0, q1 = draw(joint, rng), draw(joint, rng)
    there = joint.integrate(q0, joint.difference(q0, q1))
    assert same_placement(joint.transform(there), joint.transform(q1))
    if joint.unit is not None:
        assert np.isclose((there[joint.unit] ** 2).sum(), 1.0, rtol=0, atol=1e-15)


@every_joint
def test_steps_add_up(joint):
    rng = np.random.default_rng(2)
    q, dv = draw(joint, rng), rng.standard_normal(joint.nv)
    halfway = joint.integrate(q, dv / 2)
    assert np.allclose(joint.integrate(halfway, dv / 2), joint.integrate(q, dv), rtol=0, atol=1e-14)
    assert np.allclose(joint.integrate(q, 0 * dv), q, rtol=0, atol=1e-15)
    assert np.allclose(joint.difference(q, q), 0, rtol=0, atol=1e-15)


@pytest.mark.parametrize("joint", QUATERNIONS.values(), ids=QUATERNIONS)
def test_both_signs_of_a_quaternion_are_the_same_turn_and_a_step_keeps_the_sign(joint):
    rng = np.random.default_rng(3)
    for _ in range(10):
        q, dv = draw(joint, rng), 0.1 * rng.standard_normal(joint.nv)
        other = q.copy()
        other[joint.unit] *= -1
        assert same_placement(joint.transform(q), joint.transform(other), 1e-15)
        stepped, mirrored = joint.integrate(q, dv), joint.integrate(other, dv)
        assert stepped[joint.unit] @ q[joint.unit] > 0.9  # no jump to the other side
        assert np.allclose(mirrored[joint.unit], -stepped[joint.unit], rtol=0, atol=1e-15)
        assert np.allclose(joint.difference(other, stepped), dv, rtol=0, atol=1e-14)
        assert np.abs(joint.difference(q, other)).max() < 1e-14


@pytest.mark.parametrize("joint", QUATERNIONS.values(), ids=QUATERNIONS)
def test_half_turn_is_a_step_of_pi(joint):
    q = joint.neutral()
    q[joint.unit] = [0.6, 0.0, 0.8, 0.0]
    dv = joint.difference(joint.neutral(), q)
    assert np.allclose(dv[:3], np.pi * np.array([0.6, 0, 0.8]), rtol=0, atol=1e-14)


def test_difference_of_continuous_joints_is_the_short_way_round():
    joint = tw.Continuous("x")
    a, b = (np.array([np.cos(t), np.sin(t)]) for t in (3.0, -3.0))
    assert np.isclose(joint.difference(a, b)[0], 2 * np.pi - 6.0, rtol=1e-14)


# ---------------------------------------------------------------- normalize, random


@turning_joint
@pytest.mark.parametrize("size", [1e-300, 1e-150, 1e-8, 1.0, 1e8, 1e150, 1e300])
def test_normalize_neither_overflows_nor_loses_small_numbers(joint, size):
    rng = np.random.default_rng(4)
    q = draw(joint, rng)
    scaled = q.copy()
    scaled[joint.unit] *= size
    before = scaled.copy()
    assert np.allclose(joint.normalize(scaled), q, rtol=0, atol=1e-15)
    assert (scaled == before).all()


@every_joint
def test_normalize_leaves_all_but_the_unit_part_alone(joint):
    q = np.arange(2.0, 2.0 + joint.nq)
    normal = joint.normalize(q)
    kept = np.ones(joint.nq, bool)
    if joint.unit is not None:
        kept[joint.unit] = False
        assert np.isclose((normal[joint.unit] ** 2).sum(), 1.0, rtol=0, atol=1e-15)
    assert (normal[kept] == q[kept]).all()
    assert not np.shares_memory(normal, q)


@turning_joint
def test_zero_has_no_direction(joint):
    q = joint.neutral()
    q[joint.unit] = 0
    with pytest.raises(ValueError, match="all zero"):
        joint.normalize(q)


@every_joint
def test_random_configurations_respect_the_limits_and_are_finite_without(joint):
    rng = np.random.default_rng(5)
    free = np.full(joint.nq, np.inf)
    bounded = np.ones(joint.nq, bool)
    if joint.unit is not None:
        bounded[joint.unit] = False
    span = np.pi if joint.nq == 1 and joint.subspace()[:3].any() else 1.0
    for lower, upper in [
        (-free, free),
        (np.full(joint.nq, -0.2), np.full(joint.nq, 0.1)),
        (np.full(joint.nq, 5.0), free),
        (-free, np.full(joint.nq, -5.0)),
        (np.full(joint.nq, 0.25), np.full(joint.nq, 0.25)),
    ]:
        q = np.array([joint.random(rng, lower, upper) for _ in range(50)])
        assert np.isfinite(q).all()
        inside = q[:, bounded]
        assert (inside >= lower[bounded]).all()
        assert (inside <= upper[bounded]).all()
        if np.isinf(lower).all() and np.isinf(upper).all():
            assert (np.abs(inside) <= span).all()
        elif inside.size and not (lower == upper).all():
            assert np.ptp(inside) > 0
        if joint.unit is not None:
            assert np.allclose((q[:, joint.unit] ** 2).sum(-1), 1.0, rtol=0, atol=1e-14)


@every_joint
def test_many_are_drawn_at_once_as_one_by_one(joint):
    """Each entry of q has the same distribution: here its quantiles."""
    free = np.full(joint.nq, 0.5)
    one_by_one = np.array([joint.random(np.random.default_rng(k), -free, free) for k in range(2000)])
    at_once = joint.random(np.random.default_rng(7), -free, free, (40, 50))
    assert at_once.shape == (40, 50, joint.nq)
    quantiles = [np.quantile(q.reshape(2000, -1), [0.1, 0.3, 0.5, 0.7, 0.9], axis=0) for q in (one_by_one, at_once)]
    np.testing.assert_allclose(*quantiles, rtol=0, atol=0.1)
    if joint.unit is not None:
        np.testing.assert_allclose((at_once[..., joint.unit] ** 2).sum(-1), 1, rtol=0, atol=1e-14)


def test_a_model_draws_any_batch_and_one_as_it_always_did():
    model = tw.load("go2")
    for size, shape in (((), (19,)), (0, (0, 19)), (3, (3, 19)), ((2, 3), (2, 3, 19)), ([2], (2, 19))):
        q = model.random_configuration(size, rng=1)
        assert q.shape == shape
        assert ((model.lower <= q) & (q <= model.upper)).all()
    joints = [joint for joint in model.joints if joint]
    rng = np.random.default_rng(1)
    parts = [j.random(rng, model.lower[s], model.upper[s]) for j, s in zip(joints, model.q_slice[1:])]
    np.testing.assert_array_equal(model.random_configuration(rng=1), np.concatenate(parts))
    assert len({*model.random_configuration(100, rng=1)[:, 7]}) == 100
    for wrong in (-1, 1.5, (2, -1), "3"):
        with pytest.raises(ValueError, match="size"):
            model.random_configuration(wrong)


def test_random_turns_favour_no_direction():
    # The mean of R over all rotations is 0; over N draws it is about 1/√(3N).
    rng, joint = np.random.default_rng(6), tw.Spherical()
    free = np.full(4, np.inf)
    q = np.array([joint.random(rng, -free, free) for _ in range(4000)])
    assert np.abs(joint.transform(q).rotation.mean(0)).max() < 0.04


# ---------------------------------------------------------------- number types and batches


@every_joint
@pytest.mark.parametrize("dtype", [np.float32, np.longdouble, np.complex64, np.complex128, np.clongdouble])
def test_number_type_is_kept_and_used_to_its_end(joint, dtype):
    rng = np.random.default_rng(7)
    real = np.zeros((), dtype).real.dtype
    q, dv = draw(joint, rng, real).astype(dtype), rng.standard_normal(joint.nv).astype(dtype)
    q1 = joint.integrate(q, dv)
    T = joint.transform(q1)
    for x in (q1, T.rotation, T.translation, joint.difference(q, q1), joint.normalize(q1), joint.subspace(dtype)):
        assert x.dtype == dtype
    eps = np.finfo(dtype).eps
    assert np.abs(T.rotation.mT @ T.rotation - np.eye(3)).max() < 8 * eps
    assert np.abs(joint.difference(q, q1) - dv).max() < 100 * eps


@every_joint
@pytest.mark.parametrize("batch", [(), (1,), (3, 1, 2), (0,)], ids=str)
def test_batch_is_moved_item_by_item(joint, batch):
    rng = np.random.default_rng(8)
    q = np.array([draw(joint, rng) for _ in range(int(np.prod(batch)))]).reshape(*batch, joint.nq)
    dv = rng.standard_normal((*batch, joint.nv))
    q1, T = joint.integrate(q, dv), joint.transform(q)
    back, normal = joint.difference(q, q1), joint.normalize(q)
    assert (q1.shape, normal.shape, back.shape) == (q.shape, q.shape, dv.shape)
    assert (T.rotation.shape, T.translation.shape) == ((*batch, 3, 3), (*batch, 3))
    for k in np.ndindex(*batch):
        assert np.allclose(q1[k], joint.integrate(q[k], dv[k]), rtol=0, atol=1e-15)
        assert np.allclose(back[k], joint.difference(q[k], q1[k]), rtol=0, atol=1e-15)
        assert np.allclose(T.rotation[k], joint.transform(q[k]).rotation, rtol=0, atol=1e-15)


# ---------------------------------------------------------------- the axis


def test_axis_is_normalised_whatever_its_length():
    for size in (1e-200, 1e-3, 1.0, 7.0, 1e200):
        for kind in (tw.Revolute, tw.Prismatic, tw.Continuous):
            assert np.allclose(kind(OBLIQUE * size).axis, OBLIQUE, rtol=0, atol=1e-15)
    assert tw.Revolute("y") == tw.Revolute([0, 5, 0])
    assert tw.Revolute("y") != tw.Prismatic("y")


@pytest.mark.parametrize("axis", ["w", "xy", [0, 0, 0], [1, 0], [[1, 0, 0]], [np.nan, 0, 1], [np.inf, 0, 0]], ids=str)
def test_axis_that_is_none_is_refused(axis):
    with pytest.raises(ValueError, match="axis"):
        tw.Revolute(axis)


@pytest.mark.parametrize("pitch", [np.nan, np.inf, "0.1", None, [0.1, 0.2], True], ids=str)
def test_pitch_that_is_no_finite_number_is_refused(pitch):
    with pytest.raises(ValueError, match="pitch"):
        tw.Helical("z", pitch)


def test_a_screw_without_pitch_is_a_hinge():
    q = np.array([0.7])
    assert same_placement(tw.Helical(OBLIQUE, 0.0).transform(q), tw.Revolute(OBLIQUE).transform(q), 1e-16)


def test_joints_are_frozen():
    with pytest.raises(AttributeError):
        JOINTS["revolute"].axis = (1.0, 0.0, 0.0)


# ---------------------------------------------------------------- Pinocchio


@every_joint
def test_manifold_is_pinocchios(joint):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    builder = tw.Builder("one")
    builder.link("body", parent="base_link", joint=joint)
    model = builder.build()
    there = bridge.to_pinocchio_model(model)
    assert (there.nq, there.nv) == (joint.nq, joint.nv)
    assert (pin.neutral(there) == joint.neutral()).all()
    rng = np.random.default_rng(9)
    for _ in range(20):
        # Turns below π: beyond, Pinocchio lets the quaternion of a ball joint change sign, and we do not.
        q0, q1, dv = draw(joint, rng), draw(joint, rng), rng.uniform(-1.8, 1.8, joint.nv)
        step = bridge.to_pinocchio_tangent(model, dv)
        stepped = pin.integrate(there, q0, step)
        assert np.allclose(joint.integrate(q0, dv), stepped, rtol=0, atol=1e-12)
        # Pinocchio's log6 is itself off by up to 1e-12, more as the turn nears π.
        back = bridge.from_pinocchio_tangent(model, pin.difference(there, q0, q1))
        assert np.allclose(joint.difference(q0, q1), back, rtol=0, atol=1e-10)
        q = q0 * 3
        assert np.allclose(joint.normalize(q), pin.normalize(there, q), rtol=0, atol=1e-15)
        pin.forwardKinematics(there, data := there.createData(), q0)
        assert np.allclose(joint.transform(q0).matrix(), data.oMi[1].homogeneous, rtol=0, atol=1e-14)
        subspace = there.joints[1].createData()
        there.joints[1].calc(subspace, q0, step)
        V = bridge.from_pinocchio_motion(subspace.v)
        assert np.allclose(joint.subspace() @ dv, V, rtol=0, atol=1e-15)
