"""What Pinocchio's own tests ask of functions that have no namesake here: the same numbers, by one line of ours each.

One tree with a floating base and planar, spherical, prismatic, continuous and helical joints; fast, since nothing is
compiled. Functions with a namesake are compared in the tests of that function.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge

from ..strategies import Recipe

pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its functions are not asked")

MODEL = Recipe(8, seed=4, base="floating", branching=0.7).model
Q, V, A, _, F_EXT = Recipe(8, seed=4, base="floating", branching=0.7).state()
FRAME, POINT, H = "joint_7", np.array([0.3, -0.2, 0.5]), 1e-20
REST, LATER = np.zeros(MODEL.nv), MODEL.integrate(Q, 1j * H * np.eye(MODEL.nv))  # a step along each entry of v
TWISTS = np.random.default_rng(1).standard_normal((2, 6))
BODY = tw.SpatialInertia(1.3, [0.1, -0.2, 0.3], np.diag([0.3, 0.4, 0.5]) + 0.02)
MATRIX = BODY.matrix()


def there():
    """Pinocchio's model, new data, q, and the rates (v, a) as it orders them."""
    model = pinocchio_model()
    return model, model.createData(), Q, *(bridge.to_pinocchio_tangent(MODEL, x) for x in (V, A))


@cache
def pinocchio_model():
    return bridge.to_pinocchio_model(MODEL)


def columns(x) -> np.ndarray:
    """A matrix of Pinocchio's whose columns belong to its v."""
    return bridge.from_pinocchio_contact_jacobian(MODEL, x)


def twists(x) -> np.ndarray:
    """The same with rows (v, ω), as ours with (ω, v)."""
    return bridge.from_pinocchio_jacobian(MODEL, x)


def rates(function) -> np.ndarray:
    """The derivative of a function of q along each entry of v, in columns, by complex steps."""
    return np.moveaxis(function(LATER).imag / H, 0, -1)


def frame_twist(q):
    return np.matvec(tw.frame_jacobian(MODEL, q, FRAME), V)


def frame_acceleration(q):
    return np.matvec(tw.frame_jacobian(MODEL, q, FRAME), A) + tw.frame_bias_acceleration(MODEL, q, V, FRAME)


def point_in_its_axes(q):
    R = tw.frame_placement(MODEL, q, FRAME).rotation
    return np.matvec(R.mT, tw.point_velocity(MODEL, q, V, FRAME, POINT))


def point_acceleration_in_its_axes(q):
    R = tw.frame_placement(MODEL, q, FRAME).rotation
    return np.matvec(R.mT, tw.point_acceleration(MODEL, q, V, A, FRAME, POINT))


def frame_derivatives(name, *where):
    """What Pinocchio derives of a frame, or of a point of a joint, in its own axes."""
    m, d, q, v, a = there()
    pin.computeForwardKinematicsDerivatives(m, d, q, v, a)
    return [np.asarray(x) for x in getattr(pin, name)(m, d, *where, pin.LOCAL)]


def frame_id():
    return pinocchio_model().getFrameId(FRAME)


def regressor(name, *rates):
    """A regressor times the ten numbers of all bodies."""
    m, d, q, *_ = there()
    numbers = np.concatenate([I.parameters() for I in MODEL.inertia[1:]])
    return np.squeeze(getattr(pin, name)(m, d, q, *rates) @ numbers)


def static_regressor():
    """Of mass and first moments of all bodies: the centre of mass."""
    m, d, q, *_ = there()
    return pin.computeStaticRegressor(m, d, q) @ np.concatenate([I.parameters()[:4] for I in MODEL.inertia[1:]])


def static_torque():
    m, d, q, *_ = there()
    return pin.computeStaticTorque(m, d, q, bridge.to_pinocchio_f_ext(MODEL, F_EXT))


def static_torque_derivatives():
    m, d, q, *_ = there()
    found = pin.computeStaticTorqueDerivatives(m, d, q, bridge.to_pinocchio_f_ext(MODEL, F_EXT))
    return bridge.from_pinocchio_matrix(MODEL, found)


def center_velocity_derivatives():
    m, d, q, v, _ = there()
    pin.computeAllTerms(m, d, q, v)
    return columns(pin.getCenterOfMassVelocityDerivatives(m, d))


def subtree_masses():
    m, d, *_ = there()
    pin.computeSubtreeMasses(m, d)
    return np.array(d.mass)[1:]


def delassus():
    m, d, q, *_ = there()
    models, datas = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
    f = m.frames[frame_id()]
    models.append(pin.RigidConstraintModel(pin.ContactType.CONTACT_6D, m, f.parentJoint, f.placement, pin.LOCAL))
    datas.append(models[0].createData())
    found = pin.computeDelassusMatrix(m, d, q, models, datas)
    return np.block([[found[3:, 3:], found[3:, :3]], [found[:3, 3:], found[:3, :3]]])


def of_body(name, *arguments):
    """A 6 × 6 matrix of Pinocchio's inertia, in our order."""
    X = np.asarray(getattr(bridge.to_pinocchio_inertia(BODY), name)(*arguments))
    return np.block([[X[3:, 3:], X[3:, :3]], [X[:3, 3:], X[:3, :3]]])


def motion(k=0):
    return pin.Motion(bridge.to_pinocchio_motion(TWISTS[k]))


def body_regressor():
    wrench = pin.bodyRegressor(motion(0), motion(1)) @ BODY.parameters()
    return bridge.from_pinocchio_force(pin.Force(wrench))


def newton_euler():
    return MATRIX @ TWISTS[1] + tw.cross_force(TWISTS[0]) @ MATRIX @ TWISTS[0]


def loop_jacobian():
    m, d, q, *_ = there()
    ends = [m.frames[m.getFrameId(name)] for name in ("joint_0", FRAME)]
    at = tw.contact_placements(MODEL, Q, [tw.LoopClosure(FRAME, "joint_0")])[FRAME]
    place = ends[0].placement * pin.SE3(at.rotation, at.translation)
    loop = pin.RigidConstraintModel(
        pin.ContactType.CONTACT_6D, m, ends[0].parentJoint, place, ends[1].parentJoint, ends[1].placement, pin.LOCAL
    )
    held = loop.createData()
    pin.computeJointJacobians(m, d, q)
    loop.calc(m, d, held)
    J = twists(pin.getConstraintJacobian(m, d, loop, held))  # of joint_0 in the other, in the frame's own axes
    return -np.concatenate([at.rotation @ J[:3], at.rotation @ J[3:]])


def supported_inertia():
    """Pinocchio's counts a body by its frames, which the bridge leaves without mass: the joint's own body is added."""
    m, d, q, *_ = there()
    pin.forwardKinematics(m, d, q)
    found = pin.computeSupportedInertiaByFrame(m, d, m.getFrameId("joint_3"), True)
    return (bridge.from_pinocchio_inertia(found) + MODEL.inertia[MODEL.joint_id("joint_3")]).matrix()


def composite_inertia():
    i, place = MODEL.joint_id("joint_3"), tw.forward_kinematics(MODEL, Q).placement
    bodies = [k for k in range(MODEL.nbodies) if i in MODEL.support(k)]
    return sum(MODEL.inertia[k].transform(place[i].inverse() @ place[k]) for k in bodies).matrix()


def supported_force():
    """With the wrench that the joint's own body needs, which Pinocchio leaves out for the same reason."""
    m, d, q, v, a = there()
    pin.rnea(m, d, q, v, a)
    found = bridge.from_pinocchio_force(pin.computeSupportedForceByFrame(m, d, m.getFrameId("joint_3")))
    i, moved = MODEL.joint_id("joint_3"), tw.forward_kinematics(MODEL, Q, V, A)
    a_free = moved.acceleration[i] - np.r_[0, 0, 0, moved.placement[i].rotation.T @ MODEL.gravity]
    I = MODEL.inertia[i].matrix()
    return found + I @ a_free + tw.cross_force(moved.twist[i]) @ I @ moved.twist[i]


def centroidal_derivatives():
    m, d, q, v, a = there()
    pin.computeRNEADerivatives(m, d, q, v, a)
    return np.stack([twists(x) for x in pin.getCentroidalDynamicsDerivatives(m, d)])


def momentum_rates():
    """Of h_G and its rate by q, of the rate by v and by a."""
    by_v = [tw.centroidal_momentum_rate(MODEL, Q, x, A).imag.mT / H for x in (V + 1j * H * np.eye(MODEL.nv),)]
    by_a = tw.centroidal_map(MODEL, Q)
    return np.stack([rates(lambda q: tw.centroidal_momentum(MODEL, q, V)),
                     rates(lambda q: tw.centroidal_momentum_rate(MODEL, q, V, A)), *by_v, by_a])  # fmt: skip


ASKED = {
    "computeSupportedInertiaByFrame": (supported_inertia, composite_inertia),
    "computeSupportedForceByFrame": (
        supported_force,
        lambda: tw.joint_wrenches(MODEL, Q, V, A)[MODEL.joint_id("joint_3")],
    ),
    "getCentroidalDynamicsDerivatives": (centroidal_derivatives, momentum_rates),
    "computeStaticTorque": (
        static_torque,
        lambda: bridge.to_pinocchio_tangent(MODEL, tw.rnea(MODEL, Q, REST, REST, F_EXT)),
    ),
    "computeStaticTorqueDerivatives": (
        static_torque_derivatives,
        lambda: rates(lambda q: tw.rnea(MODEL, q, REST, REST, F_EXT)),
    ),
    "computeMechanicalEnergy": (
        lambda: pin.computeMechanicalEnergy(*there()[:4]),
        lambda: tw.kinetic_energy(MODEL, Q, V) + tw.potential_energy(MODEL, Q),
    ),
    "computeKineticEnergyRegressor": (
        lambda: regressor("computeKineticEnergyRegressor", there()[3]),
        lambda: tw.kinetic_energy(MODEL, Q, V) - sum(MODEL.armature * V**2) / 2,
    ),
    "computePotentialEnergyRegressor": (
        lambda: regressor("computePotentialEnergyRegressor"),
        lambda: tw.potential_energy(MODEL, Q),
    ),
    "computeStaticRegressor": (static_regressor, lambda: tw.center_of_mass(MODEL, Q)),
    "bodyRegressor": (body_regressor, newton_euler),
    "computeSubtreeMasses": (
        subtree_masses,
        lambda: np.array([tw.subtree(MODEL, Q, name).mass for name in MODEL.joint_names[1:]]),
    ),
    "computeDelassusMatrix": (
        delassus,
        lambda: tw.delassus_matrix(MODEL, Q, tw.frame_jacobian(MODEL, Q, FRAME)),
    ),
    "getConstraintJacobian": (
        loop_jacobian,
        lambda: tw.constraint_jacobian(MODEL, Q, [tw.LoopClosure(FRAME, "joint_0", welded=True)]),
    ),
    "getFrameVelocityDerivatives": (
        lambda: twists(frame_derivatives("getFrameVelocityDerivatives", frame_id())[0]),
        lambda: rates(frame_twist),
    ),
    "getFrameAccelerationDerivatives": (
        lambda: twists(frame_derivatives("getFrameAccelerationDerivatives", frame_id())[1]),
        lambda: rates(frame_acceleration),
    ),
    "getPointVelocityDerivatives": (
        lambda: columns(
            frame_derivatives("getPointVelocityDerivatives", MODEL.joint_id(FRAME), pin.SE3(np.eye(3), POINT))[0]
        ),
        lambda: rates(point_in_its_axes),
    ),
    "getPointClassicAccelerationDerivatives": (
        lambda: columns(
            frame_derivatives(
                "getPointClassicAccelerationDerivatives", MODEL.joint_id(FRAME), pin.SE3(np.eye(3), POINT)
            )[1]
        ),
        lambda: rates(point_acceleration_in_its_axes),
    ),
    "getCenterOfMassVelocityDerivatives": (
        center_velocity_derivatives,
        lambda: rates(lambda q: tw.center_of_mass_velocity(MODEL, q, V)),
    ),
    "Inertia.vxi": (lambda: of_body("vxi", motion()), lambda: tw.cross_force(TWISTS[0]) @ MATRIX),
    "Inertia.ivx": (lambda: of_body("ivx", motion()), lambda: MATRIX @ tw.cross_motion(TWISTS[0])),
    "Inertia.variation": (
        lambda: of_body("variation", motion()),
        lambda: tw.cross_force(TWISTS[0]) @ MATRIX - MATRIX @ tw.cross_motion(TWISTS[0]),
    ),
    "Inertia.inverse": (lambda: of_body("inverse"), lambda: np.linalg.inv(MATRIX)),
    "Inertia.vtiv": (
        lambda: bridge.to_pinocchio_inertia(BODY).vtiv(motion()),
        lambda: 2 * BODY.kinetic_energy(TWISTS[0]),
    ),
}


@pytest.mark.parametrize("name", ASKED)
def test_pinocchio_has_the_same(name):
    theirs, ours = (np.asarray(function()) for function in ASKED[name])
    assert theirs.shape == ours.shape
    assert np.abs(ours).max() > 0
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-12 * np.abs(theirs).max())
