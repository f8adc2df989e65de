"""The same robot hung from another link: built from the other end, the same motion and energy, Pinocchio."""

from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge
from twistwrench.spatial import SE3, SpatialInertia

from ..robots import shared

UPPER = SpatialInertia(2.0, [0.1, 0.0, -0.2], np.diag([0.03, 0.04, 0.02]))
LOWER = SpatialInertia(1.0, [0.0, 0.05, -0.1], np.diag([0.01, 0.02, 0.015]))
KNEE = SE3(np.eye(3), [0.0, 0.1, -0.4])
FOOT = SE3(tw.exp3([0.1, 0.2, 0.3]), [0.05, 0.0, -0.3])


def free_tree(seed):
    """Return a random tree whose joints of several axes have no rotors, which belong to one direction of the joint."""
    model = tw.random_tree(8, rng=seed, base="floating")
    single = np.repeat([joint.nv == 1 for joint in model.joints[1:]], [joint.nv for joint in model.joints[1:]])
    return replace(model, armature=np.where(single, model.armature, 0))


def leg():
    robot = tw.Builder("leg", base="floating", root="thigh", root_inertia=UPPER)
    robot.link("shank", parent="thigh", joint=tw.Revolute("y"), placement=KNEE, inertia=LOWER, joint_name="knee")
    robot.link("foot", parent="shank", placement=FOOT)
    return robot.build()


def test_a_leg_built_from_its_foot_is_the_leg_hung_from_its_foot():
    back = FOOT.inverse()
    robot = tw.Builder("leg", base="floating", root_inertia=LOWER.transform(back), root="shank")
    thigh = UPPER.transform(KNEE.inverse())  # in the frame of the knee
    robot.link("thigh", parent="shank", joint=tw.Revolute([0, -1, 0]), placement=back, inertia=thigh, joint_name="knee")
    built, hung = robot.build(), tw.reroot(leg(), "foot").model
    q, v = built.random_configuration(rng=0), np.linspace(-1, 1, 7)
    np.testing.assert_allclose(tw.crba(hung, q), tw.crba(built, q), rtol=0, atol=1e-14)
    np.testing.assert_allclose(tw.nonlinear_effects(hung, q, v), tw.nonlinear_effects(built, q, v), rtol=0, atol=1e-13)


@pytest.mark.parametrize("seed", range(12))
def test_the_motion_the_energy_and_the_momentum_are_the_same(seed):
    model, rng = free_tree(seed), np.random.default_rng(seed)
    carried = [name for name, f in model.frames.items() if model.support(f.body)[-1:] == [1]]
    there = tw.reroot(model, carried[rng.integers(len(carried))])
    q = np.stack([model.random_configuration(rng=rng) for _ in range(3)])
    v, a = rng.standard_normal((2, 3, model.nv))
    state = there.convert(q, v, a)
    for got, right in zip(there.revert(*state), (q, v, a)):
        np.testing.assert_allclose(got, right, rtol=0, atol=1e-12)
    for name in model.frames:
        for k, (robot, (p, u, b)) in enumerate(((model, (q, v, a)), (there.model, state))):
            T = tw.frame_placement(robot, p, name).matrix()
            J, bias = tw.frame_jacobian(robot, p, name), tw.frame_bias_acceleration(robot, p, u, name)
            found = [T, np.matvec(J, u), np.matvec(J, b) + bias]
            right = found if k == 0 else right
        for got, one in zip(found, right):
            np.testing.assert_allclose(got, one, rtol=0, atol=1e-11)
    p, u, b = state
    for function in (tw.kinetic_energy, tw.centroidal_momentum):
        np.testing.assert_allclose(function(there.model, p, u), function(model, q, v), rtol=1e-12, atol=1e-12)
    power = (np.vecdot(tw.rnea(model, q, v, a), v), np.vecdot(tw.rnea(there.model, p, u, b), u))
    np.testing.assert_allclose(*power, rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("frame", ["FL_foot", "RR_hip_joint", "base"])
def test_pinocchio_moves_a_go2_hung_from_a_foot_as_one_hung_from_its_trunk(frame):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    go2, rng = shared("go2"), np.random.default_rng(1)
    there = tw.reroot(go2, frame)
    q, v, motors = go2.random_configuration(rng=rng), rng.standard_normal(18), rng.standard_normal(12)
    tau = np.concatenate([np.zeros(6), motors])
    p, u = there.convert(q, v)
    old = [go2.joint_names.index(name) for name in there.model.joint_names[2:]]
    torque = np.concatenate([np.zeros(6), tau[[go2.v_slice[i].start for i in old]]])
    other = bridge.to_pinocchio_model(there.model)
    u_pin, torque = bridge.to_pinocchio_tangent(there.model, u), bridge.to_pinocchio_tangent(there.model, torque)
    found = bridge.from_pinocchio_tangent(there.model, pin.aba(other, other.createData(), p, u_pin, torque))
    a = there.revert(p, u, found)[2]
    np.testing.assert_allclose(a, tw.aba(go2, q, v, tau), rtol=1e-11, atol=1e-10)


def test_named_postures_and_feet_go_with_it():
    go2 = shared("go2")
    there = tw.reroot(go2, "FR_foot").model
    stand = there.standing()
    for foot in there.feet:
        here = tw.frame_placement(go2, go2.standing(), foot).translation
        np.testing.assert_allclose(tw.frame_placement(there, stand, foot).translation, here, rtol=0, atol=1e-14)


@pytest.mark.parametrize(
    ("model", "frame", "said"),
    [
        (shared("planar_arm"), "tool", "planar_arm.*floating"),
        (tw.attach(leg(), leg(), None, prefix="b_"), "b_foot", "b_foot.*the base"),
        (replace(leg(), armature=np.ones(7)), "foot", "root_joint.*armature"),
    ],
)
def test_what_has_no_other_root_is_refused_by_name(model, frame, said):
    with pytest.raises(tw.ModelError, match=said):
        tw.reroot(model, frame)


@pytest.mark.parametrize("key", ["armature", "damping", "velocity_limit"])
def test_a_rotor_of_a_joint_of_several_axes_is_not_turned_round(key):
    robot = tw.Builder("sled", base="floating", root_inertia=UPPER)
    robot.link("sled", parent="base_link", joint=tw.Planar(), inertia=LOWER)
    with pytest.raises(tw.ModelError, match=f"sled.*{key}"):
        tw.reroot(
            replace(robot.build(), **{key: 0.5})
            if key != "armature"
            else replace(robot.build(), armature=np.r_[np.zeros(6), 0.1 * np.ones(3)]),
            "sled",
        )
