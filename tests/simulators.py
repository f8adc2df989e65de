"""Pinocchio, MuJoCo and Drake, asked about one state of one robot; what they say is brought to our terms.

The conversions are those that docs/conventions.md defines (`page`): here they meet the libraries.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

import twistwrench as tw

Page = dict[str, Any]
Answers = dict[str, Any]


class State(NamedTuple):
    path: Path
    model: tw.Model
    frame: str  # a link of every library
    q: Any
    v: Any
    a: Any

    @property
    def rotation(self) -> Any:
        return tw.forward_kinematics(self.model, self.q).placement[1].rotation


def ours(s: State) -> Answers:
    model, q, v, a = s.model, s.q, s.v, s.a
    J = tw.frame_jacobian(model, q, s.frame, "local_world_aligned")
    return {
        "M": tw.crba(model, q),
        "h": tw.nonlinear_effects(model, q, v),
        "tau": tw.rnea(model, q, v, a),
        "J": J,
        "V": J @ v,
        "A": J @ a + tw.frame_bias_acceleration(model, q, v, s.frame, "local_world_aligned"),
        "com": tw.center_of_mass(model, q),
        "h_G": tw.centroidal_momentum(model, q, v),
    }


def ask_pinocchio(s: State, page: Page) -> Answers:
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the page's column is not checked")
    there = pin.buildModelFromUrdf(str(s.path), pin.JointModelFreeFlyer())
    data, bridge, aligned = there.createData(), tw.bridge, pin.LOCAL_WORLD_ALIGNED
    v, a = (bridge.to_pinocchio_tangent(s.model, x) for x in (s.v, s.a))
    frame = there.getFrameId(s.frame)
    pin.forwardKinematics(there, data, s.q, v, a)
    com, h_G = pin.centerOfMass(there, data, s.q), pin.computeCentroidalMomentum(there, data, s.q, v)
    J = pin.computeFrameJacobian(there, data, s.q, frame, aligned)
    pin.forwardKinematics(there, data, s.q, v, a)
    return {
        "M": bridge.from_pinocchio_matrix(s.model, pin.crba(there, data, s.q)),
        "h": bridge.from_pinocchio_tangent(s.model, pin.nonLinearEffects(there, data, s.q, v)),
        "tau": bridge.from_pinocchio_tangent(s.model, pin.rnea(there, there.createData(), s.q, v, a)),
        "J": bridge.from_pinocchio_jacobian(s.model, J),
        "V": bridge.from_pinocchio_motion(pin.getFrameVelocity(there, data, frame, aligned)),
        "A": bridge.from_pinocchio_motion(pin.getFrameClassicalAcceleration(there, data, frame, aligned)),
        "com": com,
        "h_G": bridge.from_pinocchio_force(h_G),
    }


def ask_mujoco(s: State, page: Page) -> Answers:
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: the page's column is not checked")
    spec = mujoco.MjSpec.from_file(str(s.path))
    spec.compiler.fusestatic = False
    spec.worldbody.first_body().add_freejoint()
    there = spec.compile()
    off = mujoco.mjtDisableBit
    there.opt.disableflags |= off.mjDSBL_CONTACT | off.mjDSBL_LIMIT
    return mujoco_answers(mujoco, there, [there.joint(i).name for i in range(1, there.njnt)], s, page)


def mujoco_answers(mujoco: Any, there: Any, names: list[str], s: State, page: Page) -> Answers:
    """Ask a MuJoCo model whose first joint is the free one and whose other joints have these names."""
    order = page["joint_order"](s.model, names)
    B, body, data = page["mujoco_map"](s.rotation, order), there.body(s.frame).id, mujoco.MjData(there)
    data.qpos[:], data.qvel[:] = page["mujoco_q"](s.q, order), B @ s.v
    mujoco.mj_forward(there, data)
    M, (jacp, jacr), six = np.zeros((s.model.nv, s.model.nv)), np.zeros((2, 3, s.model.nv)), np.zeros(6)
    for column, unit in zip(M, np.eye(s.model.nv), strict=True):
        mujoco.mj_mulM(there, data, column, unit)
    mujoco.mj_jacBody(there, data, jacp, jacr, body)
    mujoco.mj_objectVelocity(there, data, mujoco.mjtObj.mjOBJ_XBODY, body, six, 0)
    V = six.copy()
    mujoco.mj_subtreeVel(there, data)
    data.qacc[:] = B @ (s.a + page["bend"](s.v))
    mujoco.mj_inverse(there, data)
    tau = data.qfrc_inverse.copy()
    mujoco.mj_rnePostConstraint(there, data)
    mujoco.mj_objectAcceleration(there, data, mujoco.mjtObj.mjOBJ_XBODY, body, six, 0)
    return {
        "M": B.T @ M @ B,
        "h": B.T @ data.qfrc_bias + B.T @ M @ B @ page["bend"](s.v),
        "tau": B.T @ tau,
        "J": np.r_[jacr, jacp] @ B,
        "V": V,
        "A": six + np.r_[0, 0, 0, there.opt.gravity],  # it has 9.81 m/s² upward in it at rest
        "com": data.subtree_com[0],
        "h_G": np.r_[data.subtree_angmom[0], s.model.mass * data.subtree_linvel[0]],
    }


def ask_drake(s: State, page: Page) -> Answers:
    reason = "Drake is not installed: the page's column is not checked"
    plants = pytest.importorskip("pydrake.multibody.plant", reason=reason)
    parsing = pytest.importorskip("pydrake.multibody.parsing", reason=reason)
    trees = pytest.importorskip("pydrake.multibody.tree", reason=reason)
    plant = plants.MultibodyPlant(0.0)
    (robot,) = parsing.Parser(plant).AddModels(str(s.path))
    plant.Finalize()
    joints = [plant.get_joint(i) for i in plant.GetJointIndices(robot)]
    moving = sorted((j for j in joints if j.num_velocities() == 1), key=lambda joint: joint.velocity_start())
    order = page["joint_order"](s.model, [joint.name() for joint in moving])
    B, context = page["drake_map"](s.rotation, order), plant.CreateDefaultContext()
    plant.SetPositions(context, page["drake_q"](s.q, order))
    plant.SetVelocities(context, B @ s.v)
    forces = trees.MultibodyForces(plant)
    plant.CalcForceElementsContribution(context, forces)
    body, world, o = plant.GetBodyByName(s.frame), plant.world_frame(), np.zeros(3)
    where = (context, trees.JacobianWrtVariable.kV, body.body_frame(), o, world, world)
    M, J, a = plant.CalcMassMatrix(context), plant.CalcJacobianSpatialVelocity(*where), B @ (s.a + page["bend"](s.v))
    g, com = -plant.CalcGravityGeneralizedForces(context), plant.CalcCenterOfMassPositionInWorld(context)
    return {
        "M": B.T @ M @ B,
        "h": B.T @ (plant.CalcBiasTerm(context) + g) + B.T @ M @ B @ page["bend"](s.v),
        "tau": B.T @ plant.CalcInverseDynamics(context, a, forces),
        "J": J @ B,
        "V": plant.EvalBodySpatialVelocityInWorld(context, body).get_coeffs(),
        "A": J @ a + plant.CalcBiasSpatialAcceleration(*where).get_coeffs(),
        "com": com,
        "h_G": plant.CalcSpatialMomentumInWorldAboutPoint(context, com).get_coeffs(),
    }


LIBRARIES: dict[str, Callable[[State, Page], Answers]] = {
    "Pinocchio": ask_pinocchio,
    "MuJoCo": ask_mujoco,
    "Drake": ask_drake,
}
