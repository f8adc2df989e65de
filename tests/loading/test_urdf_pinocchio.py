"""Every robot of example-robot-data becomes the model that Pinocchio makes of it."""

import numpy as np
import pytest

from twistwrench.loading import load, robots
from twistwrench.loading.catalogue import example_robot_data_folder

TOLERANCE = 1e-13

FOLDER = example_robot_data_folder()
FILES = [robot for robot in robots() if robot.source == "example-robot-data"]


def relative(ours, theirs, scale=None):
    scale = np.abs(theirs).max(initial=0.0) if scale is None else scale
    return np.abs(np.asarray(ours) - theirs).max(initial=0.0) / (scale or 1.0)


def pinocchio_model(path, base):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    root = [pin.JointModelFreeFlyer()] if base == "floating" else []
    return pin, pin.buildModelFromUrdf(str(path), *root)


@pytest.mark.skipif(FOLDER is None, reason="example-robot-data is not installed: its robots are not compared")
@pytest.mark.parametrize("base", ["fixed", "floating"])
@pytest.mark.parametrize("robot", FILES, ids=lambda robot: robot.name)
def test_model_equals_pinocchio(robot, base):
    pin, theirs = pinocchio_model(robot.path, base)
    ours = load(robot.name, base=base, physical=False, mimic="independent")
    assert ours.joint_names == tuple(theirs.names)
    assert (ours.nq, ours.nv) == (theirs.nq, theirs.nv)
    assert ours.parent[1:] == tuple(theirs.parents)[1:]
    np.testing.assert_array_equal(ours.gravity, theirs.gravity.linear)
    for i in range(1, ours.nbodies):
        compare_body(ours.inertia[i], theirs.inertias[i])
        assert relative(ours.placement[i].matrix(), theirs.jointPlacements[i].homogeneous) <= TOLERANCE
        compare_joint(pin, ours, theirs, i)
    compare_frames(pin, ours, theirs)


def compare_body(ours, theirs):
    size = theirs.mass * (theirs.lever @ theirs.lever) + np.abs(theirs.inertia).max()  # about the frame's origin
    assert relative(ours.mass, theirs.mass) <= TOLERANCE
    assert relative(ours.com, theirs.lever) <= TOLERANCE
    assert relative(ours.inertia_at_com, theirs.inertia, size) <= TOLERANCE


def compare_joint(pin, ours, theirs, i):
    joint = theirs.joints[i]
    data = joint.createData()
    joint.calc(data, pin.neutral(theirs)[joint.idx_q : joint.idx_q + joint.nq])
    S = np.asarray(data.S).reshape(6, -1)[[3, 4, 5, 0, 1, 2]]
    if ours.joints[i].kind == "free_flyer":
        S = S[:, [3, 4, 5, 0, 1, 2]]
    assert relative(ours.joints[i].subspace(), S) <= TOLERANCE
    if ours.joint_names[i] == "root_joint":
        return
    q, v = ours.q_slice[i], ours.v_slice[i]
    where = f"joint {ours.joint_names[i]!r}"
    if any(entry.where == where and entry.found == "neither lower nor upper limit" for entry in ours.report):
        assert (ours.lower[q], ours.upper[q]) == (-np.inf, np.inf)
        assert (theirs.lowerPositionLimit[q], theirs.upperPositionLimit[q]) == (0, 0)  # Pinocchio locks it
    elif ours.joints[i].nq == 1:  # Pinocchio puts ±1.01 around a cosine and a sine
        np.testing.assert_array_equal(ours.lower[q], theirs.lowerPositionLimit[q])
        np.testing.assert_array_equal(ours.upper[q], theirs.upperPositionLimit[q])
    np.testing.assert_array_equal(ours.velocity_limit[v], theirs.velocityLimit[v])
    np.testing.assert_array_equal(ours.effort_limit[v], theirs.effortLimit[v])


def compare_frames(pin, ours, theirs):
    names = set()
    for frame in list(theirs.frames)[1:]:  # without the universe
        kind = "link" if frame.type == pin.FrameType.BODY else "joint"
        name = frame.name if frame.name in ours.frames else f"{kind}:{frame.name}"
        names.add(name)
        mine = ours.frame(name)
        assert mine.body == frame.parentJoint
        assert relative(mine.placement.matrix(), frame.placement.homogeneous) <= TOLERANCE, name
    assert names == set(ours.frame_names)


def one_joint(folder, kind, extra):
    limit = '<limit lower="-1" upper="2" effort="3" velocity="4"/>' if kind in ("revolute", "prismatic") else ""
    ends = '<parent link="base"/><child link="body"/>'
    path = folder / "robot.urdf"
    path.write_text(
        '<robot name="robot"><link name="base"/><link name="body"/>'
        f'<joint name="j" type="{kind}">{ends}{limit}{extra}</joint></robot>'
    )
    return path


@pytest.mark.parametrize("kind", ["revolute", "continuous", "prismatic", "planar", "floating"])
def test_each_joint_type_equals_pinocchios(tmp_path, kind):
    axis = '<axis xyz="0 0 1"/>' if kind == "planar" else '<axis xyz="1 -2 2"/>'
    path = one_joint(tmp_path, kind, axis)
    pin, theirs = pinocchio_model(path, "fixed")
    ours = load(path)
    assert (ours.nq, ours.nv) == (theirs.nq, theirs.nv)
    rng = np.random.default_rng(0)
    q = pin.integrate(theirs, pin.neutral(theirs), rng.standard_normal(theirs.nv))
    data = theirs.createData()
    pin.forwardKinematics(theirs, data, q)
    np.testing.assert_allclose(ours.joints[1].transform(q).matrix(), data.oMi[1].homogeneous, atol=1e-15)
