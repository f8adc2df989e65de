"""Models and states from MuJoCo: M, h, placements and accelerations of models with every joint that MuJoCo has."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge

mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: the bridge to it is not asked")

EVERY_JOINT = """
<mujoco model="every joint">
  <compiler angle="radian" autolimits="true"/>
  <option gravity="0.3 -0.2 -9.7"/>
  <worldbody>
    <body name="base" pos="0.1 0.2 0.3" quat="0.8 0 0.6 0">
      <freejoint name="root"/>
      <inertial pos="0.02 -0.01 0.03" quat="0.9 0.1 -0.2 0.3" mass="3" diaginertia="0.03 0.04 0.05"/>
      <body name="shoulder" pos="0.2 0 0.1" quat="0.7 0.1 0.2 -0.3">
        <joint name="pitch" axis="0 1 0" pos="0 0.05 0.02" ref="0.4" range="-1 2" armature="0.02" damping="0.3"/>
        <joint name="slide" type="slide" axis="1 2 0" ref="-0.1" range="-0.5 0.5" frictionloss="0.7"/>
        <joint name="yaw" axis="0.1 0 1" pos="0.03 0 0"/>
        <inertial pos="0.1 0 0" mass="1.5" diaginertia="0.01 0.02 0.015"/>
        <body name="cover" pos="0 0 0.1" quat="0.5 0.5 0.5 0.5">
          <inertial pos="0 0.02 0" mass="0.4" diaginertia="0.002 0.001 0.002"/>
          <body name="hand" pos="0.1 0 0">
            <joint name="ball" type="ball" pos="0 0 0.04" armature="0.01"/>
            <inertial pos="0 0 0.1" mass="0.7" fullinertia="0.004 0.005 0.006 0.001 -0.0005 0.0007"/>
            <site name="tip" pos="0 0 0.2" quat="0.6 0 0 0.8"/>
          </body>
        </body>
      </body>
      <body pos="-0.2 0 0"><joint axis="1 0 0"/><geom size="0.1" mass="0.5" pos="0 0.1 0"/></body>
    </body>
    <body name="second" pos="1 0 0"><freejoint/><geom type="box" size="0.1 0.2 0.3" mass="2" pos="0.05 0 0"/></body>
  </worldbody>
  <keyframe><key name="up" qpos="0 0 1 1 0 0 0  0 0 0  1 0 0 0  0  0 0 2 0 0 0 1"/></keyframe>
</mujoco>"""

FIXED = """
<mujoco model="fixed"><worldbody><body name="arm" pos="0 0 0.5">
<joint name="arm" axis="0 1 0" pos="0.1 0 0" stiffness="5"/><geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.03"/>
<body name="pad" pos="0.5 0 0" gravcomp="1"><geom size="0.05"/></body></body></worldbody></mujoco>"""


def both(xml, seed):
    """Return MuJoCo's model and data, our model, and one state of both."""
    there, rng = mujoco.MjModel.from_xml_string(xml), np.random.default_rng(seed)
    here, data = bridge.from_mujoco_model(there), mujoco.MjData(there)
    q, v = here.random_configuration(rng=rng), rng.normal(size=here.nv)
    data.qpos[:], data.qvel[:] = bridge.to_mujoco_configuration(here, q), bridge.to_mujoco_tangent(here, q, v)
    mujoco.mj_forward(there, data)
    return there, data, here, q, v


def mass_matrix(there, data):
    M = np.zeros((there.nv, there.nv))
    mujoco.mj_fullM(there, data, M)
    return M


@pytest.mark.parametrize("seed", range(4))
def test_every_joint_moves_and_weighs_the_same(seed):
    there, data, here, q, v = both(EVERY_JOINT, seed)
    assert (here.nq, here.nv, here.base) == (there.nq, there.nv, "floating")
    for name in ("base", "shoulder", "cover", "hand", "second"):
        T = tw.frame_placement(here, q, name)
        np.testing.assert_allclose(T.translation, data.body(name).xpos, rtol=0, atol=1e-14)
        np.testing.assert_allclose(T.rotation, data.body(name).xmat.reshape(3, 3), rtol=0, atol=1e-14)
    tip = tw.frame_placement(here, q, "tip")
    np.testing.assert_allclose(tip.translation, data.site("tip").xpos, rtol=0, atol=1e-14)
    B = np.stack([bridge.to_mujoco_tangent(here, q, e) for e in np.eye(here.nv)], axis=-1)
    np.testing.assert_allclose(B @ tw.crba(here, q) @ B.T, mass_matrix(there, data), rtol=0, atol=1e-13)
    np.testing.assert_allclose(B @ tw.gravity(here, q), _gravity(there, data), rtol=0, atol=1e-13)
    assert tw.kinetic_energy(here, q, v) == pytest.approx(v @ B.T @ mass_matrix(there, data) @ B @ v / 2, rel=1e-13)


def _gravity(there, data):
    still = mujoco.MjData(there)
    still.qpos[:] = data.qpos
    mujoco.mj_forward(there, still)
    return still.qfrc_bias


@pytest.mark.parametrize("seed", range(4))
def test_the_acceleration_is_the_same_but_for_the_turning_of_a_free_joint(seed):
    there, data, here, q, v = both(EVERY_JOINT, seed)
    there.dof_damping[:] = there.dof_frictionloss[:] = 0
    there.jnt_limited[:] = 0
    there.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    tau = np.random.default_rng(seed).normal(size=here.nv)
    data.qfrc_applied[:] = bridge.to_mujoco_tangent(here, q, tau)
    mujoco.mj_forward(there, data)
    a = bridge.from_mujoco_acceleration(here, q, v, data.qacc)
    np.testing.assert_allclose(tw.aba(here, q, v, tau), a, rtol=0, atol=1e-11 * np.abs(a).max())
    assert abs(bridge.from_mujoco_tangent(here, q, data.qacc) - a).max() > 0.1  # ω × v: MuJoCo's is a point's
    back = bridge.to_mujoco_acceleration(here, np.stack([q, q]), v, a)
    np.testing.assert_allclose(back, np.stack([data.qacc] * 2), rtol=0, atol=1e-12 * np.abs(a).max())


def test_the_bias_force_is_that_of_its_own_acceleration_of_zero():
    _, data, here, q, v = both(EVERY_JOINT, 0)
    bias = bridge.from_mujoco_tangent(here, q, data.qfrc_bias)
    resting = bridge.from_mujoco_acceleration(here, q, v, np.zeros(here.nv))
    np.testing.assert_allclose(tw.rnea(here, q, v, resting), bias, rtol=0, atol=1e-12 * np.abs(bias).max())
    assert np.abs(tw.nonlinear_effects(here, q, v) - bias).max() > 0.1


def test_states_go_both_ways():
    *_, here, q, v = both(EVERY_JOINT, 0)
    qs, vs = np.stack([q, q]), np.stack([v, 2 * v])
    there = bridge.to_mujoco_configuration(here, qs)
    assert there[0, 3] == q[6]  # the scalar of the first quaternion
    np.testing.assert_array_equal(bridge.from_mujoco_configuration(here, there), qs)
    back = bridge.from_mujoco_tangent(here, qs, bridge.to_mujoco_tangent(here, qs, vs))
    np.testing.assert_allclose(back, vs, rtol=0, atol=1e-15)
    force = np.random.default_rng(1).normal(size=here.nv)
    power = bridge.to_mujoco_tangent(here, q, force) @ bridge.to_mujoco_tangent(here, q, v)
    assert power == pytest.approx(force @ v, rel=1e-13)


def test_limits_armature_damping_and_keyframes_are_read():
    _, _, here, _, _ = both(EVERY_JOINT, 0)
    at = here.q_slice[here.joint_id("pitch")].start
    np.testing.assert_array_equal([here.lower[at], here.upper[at]], [-1, 2])
    dof = here.v_slice[here.joint_id("pitch")].start
    assert (here.armature[dof], here.damping[dof], here.friction[dof + 1]) == (0.02, 0.3, 0.7)
    np.testing.assert_array_equal(here.postures["up"][3:7], [0, 0, 0, 1])
    assert {"joint6", "tip", "ball"} <= {*here.frame_names} | {*here.joint_names}


def test_what_has_a_force_there_and_none_here_is_reported():
    _, data, here, q, v = both(FIXED, 0)
    assert [(entry.where, entry.read_as) for entry in here.report] == [
        ("joint 'arm'", "left out"),
        ("body 'pad'", "left out"),
    ]
    assert here.base == "fixed"
    np.testing.assert_allclose(tw.nonlinear_effects(here, q, v), data.qfrc_bias, rtol=0, atol=1e-13)
    assert {"body:arm", "joint:arm"} & {*here.frame_names}  # one name, two places


def test_the_range_of_a_ball_is_reported():
    xml = '<mujoco><worldbody><body><joint name="hip" type="ball" range="0 40"/><geom size="0.1"/></body></worldbody>'
    here = bridge.from_mujoco_model(mujoco.MjModel.from_xml_string(f"{xml}</mujoco>"))
    assert [(entry.where, entry.read_as) for entry in here.report] == [("joint 'hip'", "no limit")]
    assert "0.698" in here.report[0].found


def test_what_cannot_be_converted_is_named():
    with pytest.raises(TypeError, match=r"there: expected a mujoco.MjModel, got str"):
        bridge.from_mujoco_model("humanoid.xml")
    with pytest.raises(tw.ModelError, match="MuJoCo has no planar joint"):
        bridge.to_mujoco_configuration(tw.random_tree(2, rng=0, kinds=("planar",)), np.zeros(8))
    there = mujoco.MjModel.from_xml_string(EVERY_JOINT)
    there.dof_armature[0] = 1.0
    with pytest.raises(tw.ModelError, match="joint 'root': expected one armature in all directions"):
        bridge.from_mujoco_model(there)


# -------------------------------------------------------------------- actuators

DRIVEN = """
<mujoco model="driven"><compiler angle="radian"/><option gravity="0 0 0"/><worldbody><body>
<joint name="motor" axis="1 0 0"/><joint name="servo" type="slide"/><joint name="two" axis="0 1 0"/>
<geom size="0.1" mass="2"/><body>
<joint name="bounded" axis="0 0 1" actuatorfrcrange="-3 3"/><joint name="one way" type="slide" axis="1 0 0"/>
<joint name="general" type="slide" axis="0 1 0"/><joint name="free" axis="1 1 0"/><geom size="0.1" mass="2"/>
<body><joint name="ball" type="ball"/><geom size="0.1" pos="0.2 0 0"/></body></body></body></worldbody>
<actuator>
<motor joint="motor" gear="-2" ctrlrange="-5 5"/>
<position joint="servo" kp="1e6" ctrlrange="-1 1" forcerange="-45 45" gear="0.5"/>
<motor joint="two" gear="3" ctrlrange="-1 1"/><motor joint="two" gear="10" ctrlrange="-9 9" forcerange="-2 2"/>
<motor joint="bounded" gear="7" ctrlrange="-1 1"/>
<motor joint="one way" ctrlrange="0 4"/>
<general joint="general" gainprm="6" ctrlrange="-2 2" biastype="affine"/>
<motor joint="ball" gear="1 -2 0 0 0 0" ctrlrange="-3 3"/>
</actuator></mujoco>"""


def test_efforts_reach_their_limits_and_none_is_larger():
    """All controls at ±1e9: MuJoCo clamps them, and what its motors then do to each joint is the limit."""
    there = mujoco.MjModel.from_xml_string(DRIVEN)
    here, data = bridge.from_mujoco_model(there), mujoco.MjData(there)
    largest = np.zeros(there.nv)
    for sign in (1, -1):
        data.ctrl[:] = sign * 1e9
        mujoco.mj_forward(there, data)
        largest = np.maximum(largest, np.abs(data.qfrc_actuator))
    driven = largest > 0
    np.testing.assert_allclose(here.effort_limit[driven], largest[driven], rtol=1e-15)
    np.testing.assert_array_equal(here.effort_limit[driven], [10, 22.5, 23, 3, 4, 12, 3, 6])
    assert np.isinf(here.effort_limit[~driven]).all()
    assert [(entry.where, entry.read_as) for entry in here.report] == [
        ("the file", "limits of effort; what they are told is left out"),
        ("joint 'one way'", "effort limit 4"),
    ]


LEFT_OUT = """
<mujoco model="left out"><worldbody><body><freejoint name="root"/><geom size="0.1"/><site name="tip"/>
<body><joint name="hinge" actuatorfrcrange="-8 8"/><geom size="0.1"/>
<body><joint name="last"/><geom size="0.1"/></body></body></body></worldbody>
<tendon><fixed name="cord"><joint joint="hinge" coef="1"/></fixed></tendon>
<actuator><motor name="a" tendon="cord" ctrlrange="-1 1"/><motor name="b" site="tip"/><motor name="c" joint="root"/>
<motor name="d" joint="last"/><motor name="e" joint="hinge"/></actuator></mujoco>"""


def test_actuators_that_are_left_out_are_named():
    here = bridge.from_mujoco_model(mujoco.MjModel.from_xml_string(LEFT_OUT))
    assert [entry.found for entry in here.report if entry.where.startswith("actuator")] == [
        "drives a tendon",
        "drives a site",
        "drives joint 'root' in axes of the world or its parent",
        "a force without a limit",
    ]
    np.testing.assert_array_equal(here.effort_limit, [*[np.inf] * 6, 8, np.inf])


ROTORS = """
<mujoco model="rotors"><worldbody><body><joint name="a" axis="0 1 0" armature="0.1" damping="0.2"/>
<geom size="0.1" mass="2"/><body pos="0.3 0 0"><joint name="b" axis="0 0 1"/><geom size="0.1" pos="0.1 0 0"/></body>
</body></worldbody><actuator><motor joint="a" gear="2" armature="0.5" damping="0.3"/>
<motor joint="b" gear="-3" armature="0.01"/></actuator></mujoco>"""


def test_rotors_and_friction_of_actuators_are_the_joints_by_the_square_of_the_gear():
    try:
        there, data, here, q, v = both(ROTORS, 0)
    except ValueError:
        pytest.skip("this MuJoCo has no armature of actuators")
    np.testing.assert_allclose(tw.crba(here, q), mass_matrix(there, data), rtol=0, atol=1e-14)
    np.testing.assert_allclose(here.armature, [0.1 + 4 * 0.5, 9 * 0.01], rtol=1e-15)
    np.testing.assert_allclose(-here.damping * v, data.qfrc_passive, rtol=1e-14)


def test_gravity_that_is_disabled_is_none_and_a_fluid_is_reported():
    air = FIXED.replace(
        "<worldbody>", '<option density="1.2" viscosity="2e-5"><flag gravity="disable"/></option><worldbody>'
    )
    there = mujoco.MjModel.from_xml_string(air)
    here = bridge.from_mujoco_model(there)
    assert not here.gravity.any()
    found = [entry.found for entry in here.report]
    assert {"a fluid of density 1.2", "a fluid of viscosity 2e-05"} <= {*found}


@pytest.mark.parametrize("off", ["damper", "frictionloss", "limit"])
def test_what_the_file_switches_off_is_not_there(off):
    xml = f"""<mujoco><option><flag {off}="disable"/></option><worldbody><body><joint name="h" axis="0 1 0" damping="2"
    frictionloss="3" range="-57 57" limited="true"/><geom size="0.1" mass="2"/></body></worldbody></mujoco>"""
    model = bridge.from_mujoco_model(mujoco.MjModel.from_xml_string(xml))
    found = {"damper": model.damping[0], "frictionloss": model.friction[0], "limit": float(np.isfinite(model.upper[0]))}
    assert [name for name, x in found.items() if not x] == [off]
