"""Every function of the 3-D way against Pinocchio.

The model is read off Pinocchio's here, and the order (v, ω) is turned into (ω, v) by hand, so that
neither the package's loader nor its bridge has a part in the comparison.
"""

from __future__ import annotations

from importlib import metadata
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from twistwrench import newton_euler_3d as ne

pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")

TOLERANCE = 1e-12
ANGULAR_FIRST = [3, 4, 5, 0, 1, 2]
GO2 = Path(__file__).parents[2] / "models" / "go2.urdf"
TALOS = "cmeel.prefix/share/example-robot-data/robots/talos_data/robots/talos_full_v2.urdf"


# ---------------------------------------------------------------- models


def go2():
    return pin.buildModelFromUrdf(str(GO2), pin.JointModelFreeFlyer())


def talos():
    try:
        path = metadata.distribution("example-robot-data").locate_file(TALOS)
    except metadata.PackageNotFoundError:
        pytest.skip("example-robot-data is not installed: Talos is skipped")
    return pin.buildModelFromUrdf(str(path), pin.JointModelFreeFlyer())


def grown(joints, parents, seed):
    """Grow a tree with oblique placements and random inertias, with armature, in a slanted gravity."""
    rng = np.random.default_rng(seed)
    model = pin.Model()
    for k, (joint, parent) in enumerate(zip(joints(rng), parents, strict=True), start=1):
        model.addJoint(parent, joint, pin.SE3.Random(), f"joint_{k}")
        A = rng.standard_normal((3, 3))
        inertia = pin.Inertia(rng.uniform(0.5, 2), rng.uniform(-0.3, 0.3, 3), A @ A.T * 0.02 + 0.02 * np.eye(3))
        model.appendBodyToJoint(k, inertia, pin.SE3.Random())
    tool = pin.Frame("tool", model.njoints - 1, 0, pin.SE3.Random(), pin.FrameType.OP_FRAME)
    model.addFrame(tool)
    model.gravity.linear = np.array([1.0, -2.0, -9.0])
    model.armature = np.array([0.0 if "FreeFlyer" in kind else 0.1 for kind in kinds_of_v(model)])
    return model


def kinds_of_v(model):
    return [j.shortname() for j in list(model.joints)[1:] for _ in range(j.nv)]


def oblique_arm():
    pin.seed(3)

    def joints(rng):
        return [pin.JointModelRevoluteUnaligned(unit(rng)) for _ in range(7)]

    return grown(joints, range(7), 3)


def every_joint():
    pin.seed(4)

    def joints(rng):
        return [
            pin.JointModelFreeFlyer(),
            pin.JointModelPrismaticUnaligned(unit(rng)),
            pin.JointModelPlanar(),
            pin.JointModelRUBX(),
            pin.JointModelSpherical(),
            pin.JointModelRUBY(),
            pin.JointModelPX(),
            pin.JointModelRZ(),
            pin.JointModelRevoluteUnaligned(unit(rng)),
            pin.JointModelHelicalUnaligned(unit(rng), 0.3),
        ]

    return grown(joints, [0, 1, 2, 1, 4, 5, 6, 5, 4, 9], 4)  # depth first: Pinocchio needs it


def oblique_wheels():
    """Read from URDF: in Python, Pinocchio takes no axis for a continuous joint."""
    link = """<link name="{}"><inertial><origin xyz="0.1 -0.2 0.3" rpy="0.4 0.5 0.6"/><mass value="1.5"/>
        <inertia ixx="0.1" iyy="0.12" izz="0.14" ixy="0.01" ixz="0.02" iyz="0.03"/></inertial></link>"""
    wheel = """<joint name="{}" type="continuous"><parent link="{}"/><child link="{}"/>
        <origin xyz="0.3 0.2 0.1" rpy="1 2 3"/><axis xyz="1 2 3"/></joint>"""
    links = "".join(link.format(name) for name in "abc")
    return pin.buildModelFromXML(
        f'<robot name="r">{links}{wheel.format("j", "a", "b")}{wheel.format("k", "b", "c")}</robot>'
    )


def unit(rng):
    x = rng.standard_normal(3)
    return x / np.sqrt(x @ x)


# ---------------------------------------------------------------- Pinocchio's model, read by attributes

KINDS = {
    "FreeFlyer": "free_flyer",
    "Planar": "planar",
    "Spherical": "spherical",
    "RevoluteUnboundedUnaligned": "continuous",
    **{f"RUB{axis}": "continuous" for axis in "XYZ"},
}
"""The joints that have a formula of their own; all others have one coordinate, and are the screw that their S says."""


def joint(model, data, q):
    model.calc(data, q)
    name = model.shortname().removeprefix("JointModel")
    kind = KINDS.get(name, name)
    S = np.asarray(data.S)  # (v, ω) per unit rate
    axis = S[3:].ravel() if kind == "continuous" else None
    unit = None if model.nq == model.nv else "some of it"
    column = S[ANGULAR_FIRST].reshape(6, -1)
    return SimpleNamespace(kind=kind, axis=axis, nq=model.nq, nv=model.nv, unit=unit, subspace=column.astype)


def place(M):
    return SimpleNamespace(rotation=np.array(M.rotation), translation=np.array(M.translation))


def read(model):
    """Return what the package reads of a model, and where each of its entries of v stands in Pinocchio's."""
    n = model.njoints
    pairs = zip(list(model.joints)[1:], list(model.createData().joints)[1:], strict=True)
    joints = [None, *(joint(*pair, pin.neutral(model)) for pair in pairs)]
    order = np.arange(model.nv)
    for j in range(1, n):
        if joints[j].kind == "free_flyer":
            order[model.idx_vs[j] + np.arange(6)] = model.idx_vs[j] + np.array(ANGULAR_FIRST)
    inertias = [pin.Inertia.Zero(), *list(model.inertias)[1:]]
    ours = SimpleNamespace(
        nbodies=n,
        nq=model.nq,
        nv=model.nv,
        joints=joints,
        joint_names=list(model.names),
        parent=[-1, *list(model.parents)[1:]],
        placement=[place(M) for M in model.jointPlacements],
        inertia=[SimpleNamespace(mass=I.mass, com=I.lever.copy(), inertia_at_com=I.inertia.copy()) for I in inertias],
        q_slice=[slice(0, 0), *(slice(model.idx_qs[j], model.idx_qs[j] + model.nqs[j]) for j in range(1, n))],
        v_slice=[slice(0, 0), *(slice(model.idx_vs[j], model.idx_vs[j] + model.nvs[j]) for j in range(1, n))],
        gravity=model.gravity.linear.copy(),
        armature=np.array(model.armature)[order],
        frames={f.name: SimpleNamespace(body=f.parentJoint, placement=place(f.placement)) for f in model.frames},
    )
    return ours, order


class Case:
    """One robot in one random state, for both."""

    def __init__(self, make):
        self.pin = make()
        self.model, self.order = read(self.pin)
        self.data = self.pin.createData()
        rng = np.random.default_rng(7)
        nv = self.pin.nv
        self.q = pin.integrate(self.pin, pin.neutral(self.pin), rng.uniform(-2, 2, nv))
        self.v, self.a, self.tau = rng.standard_normal((3, nv))
        self.f_ext = rng.standard_normal((self.pin.njoints, 6)) * 5
        self.f_ext[0] = 0

    def theirs(self, x):
        """Return a vector of ours in Pinocchio's order."""
        out = np.empty_like(x)
        out[self.order] = x
        return out

    @property
    def arguments(self):
        return self.pin, self.data, self.q, self.theirs(self.v), self.theirs(self.a)

    @property
    def forces(self):
        forces = pin.StdVec_Force()
        for f in self.f_ext:
            forces.append(pin.Force(f[3:], f[:3]))
        return forces


ROBOTS = {
    "go2": go2,
    "talos": talos,
    "oblique_arm": oblique_arm,
    "every_joint": every_joint,
    "oblique_wheels": oblique_wheels,
}


@pytest.fixture(params=ROBOTS)
def case(request):
    return Case(ROBOTS[request.param])


def close(got, want):
    """Compare to the largest entry (or to 1: what should vanish has no scale)."""
    assert np.shape(got) == np.shape(want)
    scale = max(1.0, abs(np.asarray(want)).max())
    return bool(abs(np.asarray(got) - want).max() <= TOLERANCE * scale)


def rows(vectors):
    return np.stack([x.vector[ANGULAR_FIRST] for x in list(vectors)[1:]])


# ---------------------------------------------------------------- the comparison


def test_bodies(case):
    m, d = case.model, case.data
    pin.forwardKinematics(*case.arguments)
    R, p = ne.placements(m, case.q)
    assert close(R[1:], np.stack([M.rotation for M in list(d.oMi)[1:]]))
    assert close(p[1:], np.stack([M.translation for M in list(d.oMi)[1:]]))
    assert close(ne.body_twists(m, case.q, case.v)[1:], rows(d.v))
    assert close(ne.body_accelerations(m, case.q, case.v, case.a)[1:], rows(d.a))
    moving = ne.motion(m, case.q, case.v, case.a)
    aligned = pin.LOCAL_WORLD_ALIGNED
    for i in range(1, case.pin.njoints):
        twist, classical = (
            pin.getVelocity(case.pin, d, i, aligned),
            pin.getClassicalAcceleration(case.pin, d, i, aligned),
        )
        assert close(moving.angular_velocity[i], twist.angular)
        assert close(moving.velocity[i], twist.linear)
        assert close(moving.angular_acceleration[i], classical.angular)
        assert close(moving.acceleration[i], classical.linear)


@pytest.mark.parametrize("reference", ["local", "world", "local_world_aligned"])
def test_frames(case, reference):
    m, d, theirs = case.model, case.data, getattr(pin, reference.upper())
    q, v = case.arguments[2:4]
    pin.computeJointJacobians(case.pin, d, q)
    pin.computeJointJacobiansTimeVariation(case.pin, d, q, v)
    pin.updateFramePlacements(case.pin, d)
    for k in range(0, case.pin.nframes, 7):
        name = case.pin.frames[k].name
        R, p = ne.frame_placement(m, q, name)
        assert close(R, d.oMf[k].rotation)
        assert close(p, d.oMf[k].translation)
        J = pin.getFrameJacobian(case.pin, d, k, theirs)[ANGULAR_FIRST][:, case.order]
        assert close(ne.frame_jacobian(m, q, name, reference), J)
        bias = pin.getFrameJacobianTimeVariation(case.pin, d, k, theirs) @ v
        assert close(ne.frame_bias_acceleration(m, q, case.v, name, reference), bias[ANGULAR_FIRST])


def test_forces(case):
    m, q, v, a, order = case.model, case.q, case.v, case.a, case.order
    h = pin.nonLinearEffects(*case.arguments[:4])[order]
    g = pin.computeGeneralizedGravity(*case.arguments[:3])[order]
    tau = pin.rnea(*case.arguments, case.forces)[order]
    assert close(ne.nonlinear_effects(m, q, v), h)
    assert close(ne.gravity(m, q), g)
    assert close(ne.inverse_dynamics(m, q, v, a, case.f_ext), tau)
    assert close(ne.joint_wrenches(m, q, v, a, case.f_ext)[1:], rows(case.data.f))


def test_matrices(case):
    m, q, v, square = case.model, case.q, case.v, np.ix_(case.order, case.order)
    assert close(ne.mass_matrix(m, q), pin.crba(*case.arguments[:3])[square])
    assert close(ne.coriolis_matrix(m, q, v), pin.computeCoriolisMatrix(*case.arguments[:4])[square])


def test_forward_dynamics(case):
    a = ne.forward_dynamics(case.model, case.q, case.v, case.tau, case.f_ext)
    want = pin.aba(*case.arguments[:4], case.theirs(case.tau), case.forces)[case.order]
    assert close(a, want)


def test_momentum_and_energy(case):
    m, q, v, a = case.model, case.q, case.v, case.a
    model, d, q_pin, v_pin, a_pin = case.arguments
    assert close(ne.center_of_mass(m, q), pin.centerOfMass(model, d, q_pin))
    assert close(ne.centroidal_map(m, q), pin.computeCentroidalMap(model, d, q_pin)[ANGULAR_FIRST][:, case.order])
    momentum = pin.computeCentroidalMomentum(model, d, q_pin, v_pin).vector
    assert close(ne.centroidal_momentum(m, q, v), momentum[ANGULAR_FIRST])
    momentum_rate = pin.computeCentroidalMomentumTimeVariation(model, d, q_pin, v_pin, a_pin).vector
    assert close(ne.centroidal_momentum_rate(m, q, v, a), momentum_rate[ANGULAR_FIRST])
    # Pinocchio 4.1.0's own function leaves out the rotors of oblique revolute joints, which its M has.
    assert close(ne.kinetic_energy(m, q, v), v_pin @ pin.crba(model, d, q_pin) @ v_pin / 2)
    m.armature = 0 * m.armature
    model.armature = m.armature
    assert close(ne.kinetic_energy(m, q, v), pin.computeKineticEnergy(model, d, q_pin, v_pin))
    assert close(ne.potential_energy(m, q), pin.computePotentialEnergy(model, d, q_pin))
