"""Joints that other projects have as one kind and we as a chain of massless links: universal, translation, Euler.

Pinocchio's `JointModelUniversal`, `Translation`, `SphericalZYX` and `Composite` take the same q, entry for entry, and
give the same motion and forces; RBDL's Euler joints and helical joints are asked by the rates of the angles.
"""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge

from ..strategies import Recipe

X, Y, Z = np.eye(3)
BODY = tw.SpatialInertia(1.3, [0.1, -0.2, 0.3], np.diag([0.3, 0.4, 0.5]) + 0.02)
CARRIED = tw.SpatialInertia(0.7, [0.2, 0.1, -0.1], np.diag([0.02, 0.03, 0.04]))
AT, NEXT = tw.SE3(tw.exp3([0.3, -0.2, 0.5]), [0.1, 0.2, -0.3]), tw.SE3(tw.exp3([0.1, 0.4, 0]), [0.3, 0, 0.2])
OBLIQUE, ACROSS = np.array([0.6, 0, 0.8]), np.array([0.8, 0, -0.6])
CHAINS = {
    "universal, x and y": ("JointModelUniversal", (X, Y), [tw.Revolute("x"), tw.Revolute("y")]),
    "universal, oblique": ("JointModelUniversal", (OBLIQUE, ACROSS), [tw.Revolute(OBLIQUE), tw.Revolute(ACROSS)]),
    "translation": ("JointModelTranslation", (), [tw.Prismatic(a) for a in "xyz"]),
    "Euler zyx": ("JointModelSphericalZYX", (), [tw.Revolute(a) for a in "zyx"]),
    "composite of turns": ("RX RY RZ", (), [tw.Revolute(a) for a in "xyz"]),
    "composite of slides": ("PX PZ", (), [tw.Prismatic(a) for a in "xz"]),
    "composite of both": (
        "PX RY PZ RX",
        (),
        [tw.Prismatic("x"), tw.Revolute("y"), tw.Prismatic("z"), tw.Revolute("x")],
    ),
}


def chain(joints, base="fixed"):
    """The joints in a row, a body on the last, and another one with a hinge on that."""
    builder, parent, place = tw.Builder("chain", base=base), "base_link", AT
    for k, joint in enumerate(joints):
        body = BODY if k == len(joints) - 1 else None
        builder.link(f"l{k}", parent=parent, joint=joint, placement=place, inertia=body)
        parent, place = f"l{k}", None
    builder.link("tip", parent=parent, joint=tw.Revolute("y"), placement=NEXT, inertia=CARRIED)
    return builder.build()


def close(x, y, tolerance=1e-13):
    np.testing.assert_allclose(x, y, rtol=0, atol=tolerance * max(1.0, np.abs(y).max()))


@pytest.mark.parametrize("name", CHAINS)
def test_a_chain_of_massless_links_is_the_joint_of_many_axes(name):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its joints are not asked")
    kind, axes, joints = CHAINS[name]
    if hasattr(pin, kind):
        joint = getattr(pin, kind)(*axes)
    else:
        joint = pin.JointModelComposite()
        for part in kind.split():
            joint.addJoint(getattr(pin, f"JointModel{part}")())
    ours, there = chain(joints), pin.Model()
    there.gravity.linear = ours.gravity
    se3 = [pin.SE3(T.rotation, T.translation) for T in (AT, NEXT)]
    first = there.addJoint(0, joint, se3[0], "many")
    second = there.addJoint(first, pin.JointModelRY(), se3[1], "tip")
    for i, body in ((first, BODY), (second, CARRIED)):
        there.appendBodyToJoint(i, bridge.to_pinocchio_inertia(body), pin.SE3.Identity())
    data, rng = there.createData(), np.random.default_rng(2)
    q, v, a, tau = rng.uniform(-1.2, 1.2, (4, ours.nv))
    assert there.nq == ours.nq
    close(tw.rnea(ours, q, v, a), pin.rnea(there, data, q, v, a))
    close(tw.aba(ours, q, v, tau), pin.aba(there, data, q, v, tau), 1e-12)
    close(tw.crba(ours, q), pin.crba(there, data, q))
    close(tw.inverse_mass_matrix(ours, q), pin.computeMinverse(there, data, q), 1e-12)
    pin.forwardKinematics(there, data, q, v, a)
    pin.computeJointJacobians(there, data, q)
    moved = tw.forward_kinematics(ours, q, v, a)
    for i, k in ((first, len(joints)), (second, len(joints) + 1)):
        close(moved.placement[k].matrix(), data.oMi[i].homogeneous)
        close(moved.twist[k], bridge.from_pinocchio_motion(data.v[i]))
        close(moved.acceleration[k], bridge.from_pinocchio_motion(data.a[i]))
        J = tw.frame_jacobian(ours, q, ours.joint_names[k])
        close(J, bridge.from_pinocchio_jacobian(ours, pin.getJointJacobian(there, data, i, pin.LOCAL)))


@pytest.mark.parametrize("order", ["zyx", "xyz", "yxz", "zxy"])
def test_three_hinges_are_a_ball_joint_in_other_coordinates(order):
    """RBDL's EulerZYX, XYZ, YXZ and ZXY against its spherical joint: with ω = E q̇, M, τ and q̈ go over by E and Ė."""
    hinges, ball = chain([tw.Revolute(a) for a in order]), chain([tw.Spherical()])
    rng, h = np.random.default_rng(7), 1e-30
    q, v, tau = rng.uniform(-1.2, 1.2, (3, 4))

    def turn(q):
        R = [tw.exp3(q[..., k, None] * np.eye(3)["xyz".index(a)]) for k, a in enumerate(order)]
        return R[0] @ R[1] @ R[2]

    def rates(q):  # the body's angular velocity for each rate
        E = np.zeros((*q.shape[:-1], 4, 4), q.dtype)
        R = [tw.exp3(q[..., k, None] * np.eye(3)["xyz".index(a)]) for k, a in enumerate(order)]
        outboard = [R[1] @ R[2], R[2], np.eye(3)]
        for k, a in enumerate(order):
            E[..., :3, k] = outboard[k].mT[..., :, "xyz".index(a)]
        E[..., 3, 3] = 1
        return E

    E, E_dot = rates(q), rates(q + 1j * h * v).imag / h
    there = np.r_[tw.spatial.rotation_to_quaternion(turn(q)), q[3]]
    for k, frame in enumerate((hinges.joint_names[3], hinges.joint_names[4])):
        ours = tw.frame_placement(hinges, q, frame)
        close(ours.matrix(), tw.frame_placement(ball, there, ball.joint_names[1 + k]).matrix())
    close(tw.crba(hinges, q), E.T @ tw.crba(ball, there) @ E)
    close(tw.rnea(hinges, q, v, 0 * v), E.T @ tw.rnea(ball, there, E @ v, E_dot @ v))
    qdd = tw.aba(hinges, q, v, tau)
    close(E @ qdd + E_dot @ v, tw.aba(ball, there, E @ v, np.linalg.solve(E.T, tau)), 1e-12)


@pytest.mark.parametrize("axis", [X, OBLIQUE])
@pytest.mark.parametrize("pitch", [0.4, -1.3, 0.0])
def test_a_screw_is_a_slide_and_a_hinge_that_a_gear_couples(axis, pitch):
    """Pinocchio's helical joint against PX and RX; RBDL's screw with a Jacobian; Drake's screw mobilizer."""
    screw, both = chain([tw.Helical(axis, pitch)]), chain([tw.Prismatic(axis), tw.Revolute(axis)])
    S = np.array([[pitch, 0], [1, 0], [0, 1]])
    rng = np.random.default_rng(9)
    q, v, a, tau = rng.standard_normal((4, 2))
    close(tw.crba(screw, q), S.T @ tw.crba(both, S @ q) @ S)
    close(tw.rnea(screw, q, v, a), S.T @ tw.rnea(both, S @ q, S @ v, S @ a))
    geared = [tw.Coupling(both.joint_names[1], {both.joint_names[2]: pitch})]
    held = tw.contact_forward_dynamics(both, S @ q, S @ v, [0, *tau], geared)
    close(held.qdd, S @ tw.aba(screw, q, v, tau), 1e-12)
    T = tw.Helical(axis, pitch).transform(q[0])
    close(T.translation, pitch * q[0] * axis)
    close(T.rotation, tw.exp3(q[0] * axis))
    J = tw.frame_jacobian(screw, q, screw.joint_names[1])[:, 0]
    close(J, np.r_[axis, pitch * axis])


def test_rates_of_q_follow_from_v_and_back():
    """N(q) with q̇ = N v, and its left inverse, of every kind of joint: Drake and RBD.jl have them by name."""
    model, h = Recipe(8, seed=4, base="floating", branching=0.7).model, 1e-30
    assert {type(j).__name__ for j in model.joints[1:]} >= {"FreeFlyer", "Spherical", "Planar", "Continuous"}
    rng = np.random.default_rng(1)
    q, v = model.random_configuration(rng=rng), rng.standard_normal(model.nv)
    N = np.stack([model.integrate(q, 1j * h * e).imag / h for e in np.eye(model.nv)], axis=-1)
    assert N.shape == (model.nq, model.nv)
    close((model.integrate(q, 1e-6 * v) - model.integrate(q, -1e-6 * v)) / 2e-6, N @ v, 1e-9)
    back = np.stack([model.difference(q, model.normalize(q + 1j * h * e)).imag / h for e in np.eye(model.nq)], axis=-1)
    close(back @ N, np.eye(model.nv))
