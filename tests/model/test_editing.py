"""Two models as one, and a body with another inertia: statics, Pinocchio, and the same robot from one file."""

import dataclasses

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge
from twistwrench.spatial import SE3, SpatialInertia, exp3

from ..robots import shared

AT = SE3(exp3([0.3, -0.5, 0.2]), [0.1, 0.2, -0.3])


def trees(seed):
    return tw.random_tree(4, rng=seed, base="floating"), tw.random_tree(3, rng=seed + 50, base="floating")


@pytest.mark.parametrize("seed", range(4))
def test_pinocchio_welds_to_the_same_model(seed):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    a, b = (tw.random_tree(4, rng=seed + k, base="floating", kinds=("revolute", "prismatic")) for k in (0, 50))
    a, b = (dataclasses.replace(m, armature=0 * m.armature) for m in (a, b))  # appendModel does not keep it
    frame = a.joint_names[-1]
    both = tw.attach(a, b, frame, placement=AT, prefix="b_")
    mine, other = bridge.to_pinocchio_model(a), bridge.to_pinocchio_model(b)
    for i in range(1, other.njoints):
        other.names[i] = f"b_{other.names[i]}"
    for one in other.frames:
        one.name = f"b_{one.name}"
    hand = pin.buildReducedModel(other, [1], pin.neutral(other))
    there = pin.appendModel(mine, hand, mine.getFrameId(frame), bridge.to_pinocchio_se3(AT))
    assert tuple(there.names)[1:] == both.joint_names[1:]
    q = both.random_configuration(rng=seed)
    M = bridge.from_pinocchio_matrix(both, pin.crba(there, there.createData(), q))
    np.testing.assert_allclose(tw.crba(both, q), M, rtol=0, atol=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_energy_and_placements_are_those_of_the_parts(seed):
    a, b = trees(seed)
    frame = a.joint_names[2]
    both = tw.attach(a, b, frame, placement=AT, prefix="b_")
    assert both.nv == a.nv + b.nv - 6
    rng = np.random.default_rng(seed)
    qa, qb, v = a.random_configuration(rng=rng), b.random_configuration(rng=rng), rng.normal(size=both.nv)
    q, va = np.concatenate([qa, qb[7:]]), v[: a.nv]
    root = tw.frame_placement(a, qa, frame) @ AT
    twist = np.matvec(AT.inverse().motion_transform(), tw.frame_jacobian(a, qa, frame) @ va)
    qb[:7] = tw.FreeFlyer().from_placement(root, qb[:7])
    vb = np.concatenate([twist, v[a.nv :]])
    for name in b.joint_names[2:]:
        T = tw.frame_placement(both, q, f"b_{name}")
        np.testing.assert_allclose(T.matrix(), tw.frame_placement(b, qb, name).matrix(), rtol=0, atol=1e-13)
    energy = tw.kinetic_energy(a, qa, va) + tw.kinetic_energy(b, qb, vb)
    assert tw.kinetic_energy(both, q, v) == pytest.approx(energy, rel=1e-13)
    potential = tw.potential_energy(a, qa) + tw.potential_energy(b, qb)
    assert tw.potential_energy(both, q) == pytest.approx(potential, rel=1e-12)


def test_an_arm_on_a_dog_and_two_hands_on_an_arm():
    dog, arm = shared("go2"), tw.load("planar_arm", base="floating")
    both = tw.attach(dog, arm, "base", placement=SE3(np.eye(3), [0, 0, 0.1]))
    assert both.joint_names[-3:] == ("shoulder", "elbow", "wrist")
    assert both.feet == dog.feet
    np.testing.assert_array_equal(both.standing(), [*dog.standing(), 0, 0, 0])
    twice = tw.attach(tw.attach(dog, arm, "base", prefix="left/"), arm, "base", prefix="right/")
    assert twice.nv == dog.nv + 6
    with pytest.raises(tw.ModelError, match="is taken in model 'go2': prefix= keeps the two apart"):
        tw.attach(both, arm, "base")


def test_on_the_world_the_root_never_moves():
    floor = tw.Builder("floor", root="floor").build()
    arm = tw.attach(floor, tw.load("planar_arm", base="floating"), "floor")
    q = [0.3, -0.5, 0.2]
    np.testing.assert_allclose(tw.crba(arm, q), tw.crba(shared("planar_arm"), q), rtol=0, atol=1e-15)
    assert arm.base == "fixed"


def test_bad_parts_are_named():
    dog = shared("go2")
    with pytest.raises(tw.ModelError, match="other: expected a floating base: a fixed one has dropped the mass"):
        tw.attach(dog, shared("planar_arm"), "base")
    with pytest.raises(tw.NameNotFound, match="unknown frame 'bse'"):
        tw.attach(dog, dog, "bse")
    with pytest.raises(TypeError, match="placement: expected an SE3"):
        tw.attach(dog, dog, "base", placement=np.eye(4))


# --- another inertia -----------------------------------------------------------------------------


def test_a_body_gets_the_inertia_that_is_given_in_a_frame():
    dog, box = shared("go2"), SpatialInertia.from_box(1.0, [0.1, 0.2, 0.3])
    changed = tw.replace_inertia(dog, "FR_foot", box)
    i = dog.frame("FR_foot").body
    assert changed.inertia[i] == box.transform(dog.frame("FR_foot").placement)
    assert [k for k in range(dog.nbodies) if changed.inertia[k] != dog.inertia[k]] == [i]
    assert changed.mass == pytest.approx(dog.mass - float(dog.inertia[i].mass) + 1, rel=1e-14)
    q = dog.standing()
    assert not np.array_equal(tw.crba(changed, q), tw.crba(dog, q))  # no constant of the old one is kept


def test_pinocchio_with_that_inertia_and_a_program_of_it_have_the_same_mass_matrix():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    model = tw.random_tree(7, rng=129, base="floating")  # every kind of joint
    name, body = model.joint_names[4], SpatialInertia(1.5, [0.1, 0.2, -0.1], np.diag([0.1, 0.2, 0.15]))
    changed, q = tw.replace_inertia(model, name, body), model.random_configuration(rng=0)
    there = bridge.to_pinocchio_model(model)
    there.inertias[4] = bridge.to_pinocchio_inertia(body)
    M = bridge.from_pinocchio_matrix(model, pin.crba(there, there.createData(), q))
    np.testing.assert_allclose(tw.crba(changed, q), M, rtol=0, atol=1e-12 * np.abs(M).max())
    np.testing.assert_allclose(tw.compile(changed, "M")(q), M, rtol=0, atol=1e-12 * np.abs(M).max())


def test_a_payload_weighs_what_it_weighs():
    arm, q = shared("planar_arm"), [0.3, -0.7, 0.4]
    i, g = arm.frame("tool").body, 9.81
    load = SpatialInertia.from_point(2.0).transform(arm.frame("tool").placement)
    loaded = tw.replace_inertia(arm, arm.joint_names[i], arm.inertia[i] + load)
    J = tw.frame_jacobian(arm, q, "tool", "local_world_aligned")
    np.testing.assert_allclose(tw.gravity(loaded, q) - tw.gravity(arm, q), J[5] * 2 * g, rtol=0, atol=1e-14)


def test_what_cannot_be_replaced_is_named():
    arm = shared("planar_arm")
    with pytest.raises(tw.ModelError, match="link 'tool': the largest principal moment"):
        tw.replace_inertia(arm, "tool", SpatialInertia(1, [0, 0, 0], np.diag([1, 1, 3])))
    tw.replace_inertia(arm, "tool", SpatialInertia(1, [0, 0, 0], np.diag([1, 1, 3])), physical=False)
    with pytest.raises(tw.ModelError, match="it is fixed to the world"):
        tw.replace_inertia(arm, "base_link", SpatialInertia.zero())
    with pytest.raises(TypeError, match="inertia: expected a SpatialInertia"):
        tw.replace_inertia(arm, "tool", np.eye(6))
