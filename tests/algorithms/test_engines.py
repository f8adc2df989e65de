"""MuJoCo and Drake, where they are installed, about M⁻¹, Λ⁻¹, the parts of a robot and its centre of mass.

What they say of M, h, τ, J, p_G and h_G is held in tests/project/test_conventions.py.
"""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw

from ..invariants import close
from ..pages import numbered, page, run


@pytest.fixture(scope="module")
def conventions():
    start, parts = numbered("conventions")
    return run(page("conventions"), [*start, *(block for part in parts for block in part.blocks)])


@pytest.fixture(params=["go2", "humanoid"])
def state(request):
    path = next(robot.path for robot in tw.robots() if robot.name == request.param)
    model, rng = tw.load(request.param, base="floating"), np.random.default_rng(15)
    q, v, a = model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv))
    return path, model, q, v, a, tw.forward_kinematics(model, q).placement[1].rotation


def links(model, there):
    """The links of both that carry a joint of their own, with their bodies."""
    own = {name: f.body for name, f in model.frames.items() if f.body and (f.placement.matrix() == np.eye(4)).all()}
    return {name: body for name, body in own.items() if name in there}


def test_mujoco(state, conventions):
    mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: what it says is not checked")
    path, model, q, v, _, R = state
    spec = mujoco.MjSpec.from_file(str(path))
    spec.compiler.fusestatic = False
    spec.worldbody.first_body().add_freejoint()
    there = spec.compile()
    order = conventions["joint_order"](model, [there.joint(i).name for i in range(1, there.njnt)])
    B, data = conventions["mujoco_map"](R, order), mujoco.MjData(there)  # their velocity is B v
    data.qpos[:], data.qvel[:] = conventions["mujoco_q"](q, order), B @ v
    mujoco.mj_forward(there, data)
    mujoco.mj_subtreeVel(there, data)

    solved = np.zeros((model.nv, model.nv))
    mujoco.mj_solveM(there, data, solved, np.eye(model.nv))
    M_inv = np.linalg.solve(B, np.linalg.solve(B, solved).T)
    assert close(tw.inverse_mass_matrix(model, q), M_inv, 1e-11)  # cond(M) of this humanoid: 1.5e5
    frames = links(model, [there.body(i).name for i in range(there.nbody)])
    assert len(frames) >= model.nbodies - 1
    for name in frames:
        part, i = tw.subtree(model, q, name), there.body(name).id
        assert close(part.mass, there.body_subtreemass[i])
        assert close(part.center_of_mass, data.subtree_com[i], size=1.0)
        assert close(part.jacobian @ v, data.subtree_linvel[i], size=np.abs(v).max())
        assert close((part.momentum_map @ v)[:3], data.subtree_angmom[i], size=1.0)


def test_drake(state, conventions):
    reason = "Drake is not installed: what it says is not checked"
    plants = pytest.importorskip("pydrake.multibody.plant", reason=reason)
    parsing = pytest.importorskip("pydrake.multibody.parsing", reason=reason)
    trees = pytest.importorskip("pydrake.multibody.tree", reason=reason)
    path, model, q, v, a, R = state
    plant = plants.MultibodyPlant(0.0)
    (robot,) = parsing.Parser(plant).AddModels(str(path))
    plant.Finalize()
    joints = [plant.get_joint(i) for i in plant.GetJointIndices(robot)]
    moving = sorted((j for j in joints if j.num_velocities() == 1), key=lambda joint: joint.velocity_start())
    order = conventions["joint_order"](model, [joint.name() for joint in moving])
    B, context = conventions["drake_map"](R, order), plant.CreateDefaultContext()
    plant.SetPositions(context, conventions["drake_q"](q, order))
    plant.SetVelocities(context, B @ v)

    assert close(tw.center_of_mass_velocity(model, q, v), plant.CalcCenterOfMassTranslationalVelocityInWorld(context))
    kV, world = trees.JacobianWrtVariable.kV, plant.world_frame()
    J = plant.CalcJacobianCenterOfMassTranslationalVelocity(context, kV, world, world)
    assert close(tw.centroidal_map(model, q)[3:] / model.mass, J @ B, size=1.0)
    bias = plant.CalcBiasCenterOfMassTranslationalAcceleration(context, kV, world, world)
    there = J @ B @ (a + conventions["bend"](v)) + bias
    assert close(tw.center_of_mass_acceleration(model, q, v, a), there, size=(v**2).sum())
    bodies = plant.GetBodyIndices(robot)
    total = plant.CalcSpatialInertia(context, world, bodies)
    about_G = total.Shift(total.get_com())
    inertia = tw.centroidal_inertia(model, q)
    assert close(inertia, about_G.CopyToFullMatrix6())
