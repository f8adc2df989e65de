"""The wrench through a weld: by hand, the same robot with a joint there, Pinocchio, MuJoCo's sensors."""

from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge

from ..robots import shared

TOOL = tw.SpatialInertia(0.8, [0.01, -0.02, 0.06], np.diag([2e-3, 3e-3, 1e-3]))
SENSOR = tw.SE3(tw.exp3([0.3, -0.2, 0.5]), [0.05, 0.0, 0.1])
URDF = """<robot name="arm"><link name="base"/><link name="hand">{0}</link><link name="sensor">{0}</link>
<link name="tool">{0}</link><link name="finger">{0}</link><link name="camera">{0}</link>
<joint name="wrist" type="continuous"><parent link="base"/><child link="hand"/><axis xyz="0 1 0"/></joint>
<joint name="mount" type="{1}"><parent link="hand"/><child link="sensor"/><axis xyz="1 0 0"/>
<limit effort="1" velocity="1" lower="-1" upper="1"/><origin xyz="0.1 0.02 0.3" rpy="0.1 0.2 0.3"/></joint>
<joint name="bolt" type="fixed"><parent link="sensor"/><child link="tool"/><origin xyz="0 0 0.05" rpy="0 1 0"/></joint>
<joint name="grip" type="prismatic"><parent link="tool"/><child link="finger"/><axis xyz="0 1 0"/>
<limit effort="1" velocity="1" lower="-1" upper="1"/></joint>
<joint name="glue" type="fixed"><parent link="hand"/><child link="camera"/><origin xyz="0.2 0 0"/></joint></robot>"""
INERTIAL = """<inertial><origin xyz="0.01 0.02 0.03"/><mass value="1.5"/>
<inertia ixx="0.02" iyy="0.03" izz="0.04" ixy="0.001" ixz="0" iyz="0.002"/></inertial>"""


def drawn(model, seed):
    """A state, an acceleration and wrenches from outside on all bodies."""
    rng = np.random.default_rng(seed)
    f_ext = rng.standard_normal((model.nbodies, 6))
    f_ext[0] = 0
    return model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv)), f_ext


# ---------------------------------------------------------------- by hand


def test_a_tool_at_rest_is_carried_and_one_that_is_swung_is_pulled_in():
    robot = tw.Builder("wrist")
    robot.link("hand", parent="base_link", joint=tw.Revolute("z"), inertia=TOOL)
    robot.link("tool", parent="hand", inertia=TOOL, placement=tw.SE3(np.eye(3), [0.5, 0.0, 0.0]))
    model, c = robot.build(), TOOL.com
    weight = 0.8 * 9.81
    still = [weight * c[1], -weight * c[0], 0, 0, 0, weight]
    np.testing.assert_allclose(tw.frame_wrench(model, [0.7], [0.0], [0.0], "tool"), still, rtol=1e-14, atol=1e-15)
    pull = tw.frame_wrench(model, [0.7], [3.0], [0.0], "tool")[3:] - [0, 0, weight]
    np.testing.assert_allclose(pull, [-0.8 * 9 * (0.5 + c[0]), -0.8 * 9 * c[1], 0], rtol=1e-13, atol=1e-14)


def test_a_plate_under_the_robot_carries_its_base_too():
    robot = tw.Builder("on a plate", base="fixed", root="floor")
    robot.link("plate", parent="floor", placement=tw.SE3(np.eye(3), [0, 0, 0.2]), inertia=TOOL)
    robot.link("arm", parent="plate", joint=tw.Revolute("x"), inertia=TOOL)
    model = robot.build()
    assert tw.frame_wrench(model, [0.0], [0.0], [0.0], "plate")[5] == pytest.approx(2 * 0.8 * 9.81, rel=1e-14)
    assert tw.joint_wrenches(model, [0.0], [0.0], [0.0])[0, 5] == pytest.approx(0.8 * 9.81, rel=1e-14)


# ---------------------------------------------------------------- a joint at the weld


@pytest.mark.parametrize("seed", range(10))
def test_a_locked_joint_passes_what_the_same_joint_passes_that_could_move(seed):
    """Joints of any kind on random trees, the tree that floats and the one that stands."""
    rng = np.random.default_rng(seed)
    full = tw.random_tree(9, rng=seed, base=("fixed", "floating")[seed % 2])
    names = [name for name in full.joint_names[1 + seed % 2 :] if rng.random() < 0.5]
    small = tw.lock_joints(full, names, full.random_configuration(rng=rng))
    q, v, a, _ = drawn(small.model, seed)
    (q_full, v_full), a_full = small.expand(q, v), small.expand(q, a)[1]
    expected = tw.joint_wrenches(full, q_full, v_full, a_full)
    size = np.abs(expected).max()
    for i, name in enumerate(full.joint_names[1:], start=1):
        got = tw.frame_wrench(small.model, q, v, a, name)
        np.testing.assert_allclose(got, expected[i], rtol=0, atol=1e-13 * size, err_msg=name)


@pytest.mark.parametrize("frame", ["sensor", "mount"])
def test_a_weld_of_a_file_is_the_joint_of_another_file(tmp_path, frame):
    welded, hinged = tmp_path / "welded.urdf", tmp_path / "hinged.urdf"
    welded.write_text(URDF.format(INERTIAL, "fixed"))
    hinged.write_text(URDF.format(INERTIAL, "revolute"))
    small, full = tw.load(welded), tw.load(hinged)
    q, v, a, f_ext = drawn(small, 0)
    moving = np.insert(q, 2, 0), np.insert(v, 1, 0), np.insert(a, 1, 0)
    outside = np.zeros((4, 6))
    outside[2] = small.frame("sensor").placement.motion_transform().T @ f_ext[1]  # of the hand, beyond the sensor
    outside[3] = f_ext[2]
    expected = tw.joint_wrenches(full, *moving, outside)[2]
    np.testing.assert_allclose(tw.frame_wrench(small, q, v, a, frame, f_ext), expected, rtol=0, atol=1e-12)
    batch = tw.frame_wrench(small, np.stack([q, q]), v, a, frame, f_ext)
    np.testing.assert_allclose(batch, [expected] * 2, rtol=0, atol=1e-12)


def test_a_gripper_that_is_attached_hangs_on_the_frame_and_on_all_that_carry_it():
    palm = tw.Builder("gripper", base="floating", root="palm", root_inertia=TOOL)
    palm.link("finger", parent="palm", joint=tw.Prismatic("x"), inertia=TOOL)
    robot = tw.Builder("arm")
    robot.link("hand", parent="base_link", joint=tw.Revolute([1, 2, 2]), inertia=TOOL)
    robot.link("sensor", parent="hand", placement=SENSOR, inertia=TOOL)
    robot.link("flange", parent="sensor", placement=SENSOR)
    both = tw.attach(robot.build(), palm.build(), "flange", placement=SENSOR, prefix="a_")
    q, v, a, _ = drawn(both, 1)
    twice = tw.attach(both, palm.build(), "hand", prefix="b_")  # beside the sensor, not beyond it
    for model, more in ((both, []), (twice, [0.3])):
        wrench = tw.frame_wrench(model, [*q, *more], [*v, *more], [*a, *more], "sensor")
        inner = tw.frame_wrench(model, [*q, *more], [*v, *more], [*a, *more], "a_palm")
        V = SENSOR.inverse().motion_transform() @ tw.forward_kinematics(both, q, v).twist[1]
        A = SENSOR.inverse().motion_transform() @ tw.rnea_terms(both, q, v, a).A[1]
        own = TOOL.matrix() @ A + tw.cross_force(V) @ TOOL.matrix() @ V
        moved = (SENSOR @ SENSOR).force_transform() @ inner
        np.testing.assert_allclose(wrench, own + moved, rtol=0, atol=1e-12)


# ---------------------------------------------------------------- others


def test_pinocchio_has_the_same_wrench_at_a_joint_of_its_own(tmp_path):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    welded, hinged = tmp_path / "welded.urdf", tmp_path / "hinged.urdf"
    welded.write_text(URDF.format(INERTIAL, "fixed"))
    hinged.write_text(URDF.format(INERTIAL, "revolute"))
    there, (q, v, a, _) = pin.buildModelFromUrdf(str(hinged)), drawn(tw.load(welded), 2)
    data = there.createData()
    pin.rnea(there, data, np.insert(q, 2, 0), np.insert(v, 1, 0), np.insert(a, 1, 0))
    expected = bridge.from_pinocchio_force(data.f[there.getJointId("mount")])
    expected = getattr(expected, "vector", expected)
    np.testing.assert_allclose(tw.frame_wrench(tw.load(welded), q, v, a, "sensor"), expected, rtol=0, atol=1e-12)


def test_the_sensors_of_mujoco_read_it():
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: the comparison with it is skipped")
    xml = """<mujoco><compiler angle="radian"/><option><flag contact="disable"/></option><worldbody><body>
    <joint name="hinge" axis="0 1 0"/><inertial pos="0 0 0.1" mass="2" diaginertia="0.1 0.1 0.1"/>
    <body pos="0.1 0.2 0.3" quat="0.9 0.1 0.3 0.2"><inertial pos="0.01 -0.02 0.06" mass="0.8"
    diaginertia="2e-3 3e-3 1e-3"/><site name="sensor"/></body></body></worldbody>
    <sensor><force site="sensor"/><torque site="sensor"/></sensor></mujoco>"""
    there = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(there)
    data.qpos[:], data.qvel[:] = 0.4, 1.3
    mujoco.mj_forward(there, data)
    w, x, y, z = np.array([0.9, 0.1, 0.3, 0.2]) / np.linalg.norm([0.9, 0.1, 0.3, 0.2])
    turn = tw.spatial.quaternion_to_rotation([x, y, z, w])
    robot = tw.Builder("arm")
    body = tw.SpatialInertia(2.0, [0, 0, 0.1], 0.1 * np.eye(3))
    robot.link("hand", parent="base_link", joint=tw.Revolute("y"), inertia=body)
    robot.link("tool", parent="hand", placement=tw.SE3(turn, [0.1, 0.2, 0.3]), inertia=TOOL)
    got = tw.frame_wrench(robot.build(), data.qpos, data.qvel, data.qacc, "tool")
    np.testing.assert_allclose(got, np.r_[data.sensordata[3:], data.sensordata[:3]], rtol=0, atol=1e-12)


# ---------------------------------------------------------------- what is not known


def test_where_the_parts_of_a_body_are_not_known_it_is_said():
    go2 = shared("go2")
    rest = np.zeros(18)
    for model in (tw.reroot(go2, "FL_foot").model, replace(go2, inertia=(go2.inertia[0], *[TOOL] * 13))):
        with pytest.raises(tw.ModelError, match=r"'FL_foot'.*beyond it is not known"):
            tw.frame_wrench(model, model.neutral(), rest, rest, "FL_foot")
    with pytest.raises(tw.NameNotFound, match="FL_foo"):
        tw.frame_wrench(go2, go2.neutral(), rest, rest, "FL_foo")
    with pytest.raises(tw.ShapeError, match="a: expected"):
        tw.frame_wrench(go2, go2.neutral(), rest, rest[1:], "FL_foot")


def test_complex_numbers_and_symbols_pass():
    robot = tw.Builder("wrist")
    robot.link("hand", parent="base_link", joint=tw.Revolute("y"), inertia=TOOL)
    robot.link("tool", parent="hand", inertia=TOOL, placement=SENSOR)
    model = robot.build()
    step = 1e-30
    exact = tw.frame_wrench(model, [0.3 + 1j * step], [0.2], [0.1], "tool").imag / step
    near = [tw.frame_wrench(model, [0.3 + e], [0.2], [0.1], "tool") for e in (1e-6, -1e-6)]
    np.testing.assert_allclose(exact, (near[0] - near[1]) / 2e-6, rtol=0, atol=1e-8)
