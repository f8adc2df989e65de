"""docs/conventions.md: it runs, and Pinocchio, MuJoCo and Drake, where they are installed, do what it says."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import twistwrench as tw

from ..pages import numbered, page, run
from ..simulators import LIBRARIES, State, mujoco_answers, ours


@pytest.fixture(scope="module")
def conventions() -> dict[str, Any]:
    """What the page defines, run from top to bottom, as it says."""
    start, parts = numbered("conventions")
    return run(page("conventions"), [*start, *(block for part in parts for block in part.blocks)])


def test_the_page_of_conventions_runs_from_top_to_bottom(conventions: dict[str, Any]) -> None:
    assert len(numbered("conventions")[1]) == 15
    assert conventions["go2"].nv == 18


def test_the_letters_with_several_meanings_are_as_many_as_the_page_says() -> None:
    for language, said in (("", "Fifteen letters have more than one meaning"), (".zh-CN", "十五个字母")):
        text = page("conventions", language).read_text(encoding="utf-8")
        rows = re.findall(r"^\| (\w) \| (.+) \| .+ \|$", text.partition("### 2.")[0], re.MULTILINE)
        meanings = [len(re.split("[;；]", what)) for _, what in rows]
        assert len({letter for letter, _ in rows}) == len(rows) == 15
        assert (min(meanings), meanings.count(3)) == (2, 7)
        assert said in text


@pytest.fixture(params=["go2", "humanoid"])
def state(request: pytest.FixtureRequest) -> State:
    """On the humanoid MuJoCo and Drake begin with the waist and the arms, we with the left leg."""
    path = next(robot.path for robot in tw.robots() if robot.name == request.param)
    model, rng = tw.load(request.param, base="floating"), np.random.default_rng(49)
    q, (v, a) = model.random_configuration(rng=rng), rng.standard_normal((2, model.nv))
    return State(path, model, {"go2": "FR_calf", "humanoid": "left_foot"}[request.param], q, v, a)


def assert_the_same(answers: dict[str, Any], wanted: dict[str, Any]) -> None:
    assert answers.keys() == wanted.keys()
    for name, value in wanted.items():
        np.testing.assert_allclose(answers[name], value, rtol=0, atol=1e-12 * np.abs(value).max(), err_msg=name)


@pytest.mark.parametrize("library", LIBRARIES)
def test_a_library_says_the_same_as_we_do_once_the_page_has_converted_it(
    library: str, state: State, conventions: dict[str, Any]
) -> None:
    assert_the_same(LIBRARIES[library](state, conventions), ours(state))


MJCF = """<mujoco><compiler angle="radian"/><option gravity="0 0 -3.7"><flag constraint="disable"/></option><worldbody>
<body name="trunk"><freejoint/>
  <inertial mass="5" pos="0.02 0.01 -0.03" fullinertia="0.05 0.08 0.1 0.004 -0.003 0.002"/>
  <body name="tail" pos="-0.3 0 0.1"><joint name="wag" axis="0 0 1" armature="0.01"/>
    <inertial mass="0.4" pos="-0.2 0 0" diaginertia="0.0002 0.004 0.004"/></body>
  <body name="leg" pos="0.1 0.2 -0.1"><joint name="lift" type="slide" axis="0.6 0 0.8"/>
    <inertial mass="1.2" pos="0 0.05 -0.2" diaginertia="0.01 0.02 0.015"/></body>
</body></worldbody></mujoco>"""


def trunk_with_tail_and_leg() -> tw.Model:
    def inertia(m: float, c: list[float], xx: float, yy: float, zz: float, *off: float) -> tw.SpatialInertia:
        xy, xz, yz = off or (0.0, 0.0, 0.0)
        return tw.SpatialInertia(m, c, [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])

    trunk = inertia(5, [0.02, 0.01, -0.03], 0.05, 0.08, 0.1, 0.004, -0.003, 0.002)
    robot = tw.Builder("trunk", base="floating", root="trunk", root_inertia=trunk, gravity=(0, 0, -3.7))
    tail, leg = inertia(0.4, [-0.2, 0, 0], 0.0002, 0.004, 0.004), inertia(1.2, [0, 0.05, -0.2], 0.01, 0.02, 0.015)
    behind, under = tw.SE3(np.eye(3), [-0.3, 0, 0.1]), tw.SE3(np.eye(3), [0.1, 0.2, -0.1])
    wag, lift = tw.Revolute("z"), tw.Prismatic([3, 0, 4])
    robot.link("tail", parent="trunk", joint=wag, joint_name="wag", placement=behind, inertia=tail, armature=0.01)
    robot.link("leg", parent="trunk", joint=lift, joint_name="lift", placement=under, inertia=leg)
    return robot.build()


def test_a_floating_robot_written_as_mjcf_is_the_one_that_the_builder_makes(conventions: dict[str, Any]) -> None:
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: the page's column is not checked")
    model, rng = trunk_with_tail_and_leg(), np.random.default_rng(49)
    q, (v, a) = model.random_configuration(rng=rng), rng.standard_normal((2, model.nv))
    state, there = State(Path(), model, "leg", q, v, a), mujoco.MjModel.from_xml_string(MJCF)
    assert model.joint_names[2:] == ("lift", "wag")  # by name; in the document the tail comes first
    assert_the_same(mujoco_answers(mujoco, there, ["wag", "lift"], state, conventions), ours(state))


def test_what_the_page_says_of_mujoco_alone(conventions: dict[str, Any]) -> None:
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: the page's column is not checked")
    there = mujoco.MjModel.from_xml_string(
        """<mujoco><worldbody><body euler="30 40 50"><freejoint/>
        <inertial pos="0.1 0.2 0.3" mass="2" fullinertia="0.03 0.04 0.05 0.001 0.002 0.003"/>
        <body><joint type="ball"/><inertial pos="0 0 0.1" mass="1" diaginertia="1 1 1"/></body>
        <body><joint range="-90 90" limited="true"/><inertial pos="0 0 0.1" mass="1" diaginertia="1 1 1"/></body>
        </body></worldbody></mujoco>"""
    )
    data, close = mujoco.MjData(there), np.testing.assert_allclose
    mujoco.mj_forward(there, data)
    R, turns = data.xmat[1].reshape(3, 3).copy(), [tw.exp3(np.radians(x)) for x in ([30, 0, 0], [0, 40, 0], [0, 0, 50])]
    close(R, turns[0] @ turns[1] @ turns[2], atol=1e-15, err_msg="euler")
    close(there.jnt_range[-1], [-np.pi / 2, np.pi / 2], err_msg="degrees")
    axes, body = np.zeros(9), conventions["body"]
    mujoco.mju_quat2Mat(axes, there.body_iquat[1])
    axes = axes.reshape(3, 3)
    close(axes @ np.diag(there.body_inertia[1]) @ axes.T, body.inertia_at_com, atol=1e-15, err_msg="principal axes")
    close(there.body_ipos[1], body.com)

    data.qpos[7:11], data.qvel[6:9], six = [0.5, 0.5, -0.5, 0.5], [1, 2, 3], np.zeros(6)
    mujoco.mj_forward(there, data)
    mujoco.mj_objectVelocity(there, data, mujoco.mjtObj.mjOBJ_XBODY, 2, six, 1)
    close(six, [1, 2, 3, 0, 0, 0], atol=1e-15, err_msg="a ball's ω is in the axes that turn")
    still = data.qacc.copy()
    data.xfrc_applied[1] = [1, 2, 3, 4, 5, 6]  # force, torque
    mujoco.mj_forward(there, data)
    change, arm = np.zeros(there.nv), data.xipos[1] - data.xpos[1]
    mujoco.mj_mulM(there, data, change, data.qacc - still)
    close(change[:6], np.r_[1, 2, 3, R.T @ (np.array([4, 5, 6]) + np.cross(arm, [1, 2, 3]))], atol=1e-12)
    mujoco.mj_rnePostConstraint(there, data)
    arm = data.xipos[1] - data.subtree_com[1]
    close(data.cfrc_ext[1], np.r_[np.array([4, 5, 6]) + np.cross(arm, [1, 2, 3]), 1, 2, 3], atol=1e-12)


def test_what_the_page_says_of_drake_alone(conventions: dict[str, Any]) -> None:
    reason = "Drake is not installed: the page's column is not checked"
    trees = pytest.importorskip("pydrake.multibody.tree", reason=reason)
    plants, body = pytest.importorskip("pydrake.multibody.plant", reason=reason), conventions["body"]
    I, close = conventions["drake_unit_inertia"], np.testing.assert_allclose
    unit = trees.UnitInertia(*I.diagonal(), I[0, 1], I[0, 2], I[1, 2])
    inertia = trees.SpatialInertia(body.mass, body.com, unit)
    close(inertia.CopyToFullMatrix6(), body.matrix(), atol=1e-15, err_msg="unit inertia about the origin")
    plant = plants.MultibodyPlant(0.0)
    table, ball = (plant.AddRigidBody(name, inertia) for name in ("table", "ball"))
    plant.AddJoint(trees.PlanarJoint("plane", plant.world_frame(), table.body_frame(), [0, 0, 0]))
    plant.AddJoint(trees.BallRpyJoint("ball", table.body_frame(), ball.body_frame()))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    plant.SetPositions(context, [2.0, 1.0, 0.7, 0.3, 0.4, 0.5])
    plant.SetVelocities(context, [0.3, 0.4, 0.0, 1.0, 2.0, 3.0])
    close(plant.EvalBodySpatialVelocityInWorld(context, table).get_coeffs(), [0, 0, 0, 0.3, 0.4, 0], atol=1e-15)
    R = plant.EvalBodyPoseInWorld(context, table).rotation().matrix()
    relative = R.T @ plant.EvalBodyPoseInWorld(context, ball).rotation().matrix()
    close(relative, conventions["urdf"], atol=1e-15, err_msg="roll, pitch, yaw")
    omega = plant.EvalBodySpatialVelocityInWorld(context, ball).rotational()
    close(R.T @ omega, [1, 2, 3], atol=1e-14, err_msg="a ball's ω is in the axes of the parent")


def test_what_the_page_says_of_pinocchio_alone(conventions: dict[str, Any]) -> None:
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the page's column is not checked")
    there = tw.bridge.to_pinocchio_inertia(conventions["body"])
    close = np.testing.assert_allclose
    close(there.toDynamicParameters(), conventions["pinocchio_parameters"], atol=1e-15)
    close(pin.rpy.rpyToMatrix(0.3, 0.4, 0.5), conventions["urdf"], atol=1e-15)
    model = tw.bridge.to_pinocchio_model(conventions["go2"])
    data = model.createData()
    pin.aba(model, data, conventions["q"], np.zeros(18), np.zeros(18))
    calf = data.joints[model.getJointId("FL_calf_joint")]
    close(calf.S.reshape(6), [0, 0, 0, 0, 1, 0])
    close(calf.U @ calf.S, 1 / calf.Dinv[0, 0])  # D = Sᵀ U
    assert not model.inertias[0].matrix().any()


def test_the_base_that_is_fixed_counts_in_mujoco_and_drake_only() -> None:
    path = next(str(robot.path) for robot in tw.robots() if robot.name == "go2")
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: the page's column is not checked")
    spec = mujoco.MjSpec.from_file(path)
    spec.compiler.fusestatic = False
    assert spec.compile().body_subtreemass[0] == pytest.approx(16.085, rel=1e-12)
    reason = "Drake is not installed: the page's column is not checked"
    plants = pytest.importorskip("pydrake.multibody.plant", reason=reason)
    plant = plants.MultibodyPlant(0.0)
    pytest.importorskip("pydrake.multibody.parsing", reason=reason).Parser(plant).AddModels(path)
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("base"))
    plant.Finalize()
    assert plant.CalcTotalMass(plant.CreateDefaultContext()) == pytest.approx(16.085, rel=1e-12)
