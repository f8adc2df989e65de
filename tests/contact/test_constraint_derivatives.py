"""Derivatives of q̈, λ and of the velocity after an impact, of robots in contact: Pinocchio's analytic ones.

No function here returns them: they follow from the two equations M q̈ + h = τ + Jᵀ λ and J q̈ + J̇ v = −2 ζ ω J v − ω² δ
by one solution with their matrix, whose right side complex steps give. Pinocchio counts J v in the axes of the robot's
frame, which turn, and we in those of the world: both agree along all changes of q and v that the contacts allow.
"""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg

import twistwrench as tw
from twistwrench import bridge

from ..sampling import sampled
from ..strategies import Recipe

pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: its constrained derivatives are not asked")

H = 1e-20
MODEL = Recipe(8, seed=4, base="floating", branching=0.7).model
Q, RATE, _, TAU, _ = Recipe(8, seed=4, base="floating", branching=0.7).state()
STEPS = 1j * H * np.eye(MODEL.nv)
POINT, WELD = "joint_6", "joint_0"
# the contacts, and for each the kind of Pinocchio's: six directions or three, where they are counted
CASES = {
    "both": [tw.PointContact(POINT, 0.5), tw.SurfaceContact(WELD, (0.1, 0.1), 0.5)],
    "point": [tw.PointContact(POINT, 0.5)],
    "sole": [tw.SurfaceContact(WELD, (0.1, 0.1), 0.5)],
    "none": [],
    "loop of points": [tw.LoopClosure(POINT, WELD)],
    "loop of welds": [tw.LoopClosure(POINT, WELD, welded=True)],
}
cases = pytest.mark.parametrize("case", CASES)


def solved(case, stabilise=0.0):
    """The velocity, q̈ and λ, and their derivatives by q, v and τ."""
    contacts = CASES[case]
    V = tw.impact(MODEL, Q, RATE, contacts).v
    got = tw.contact_forward_dynamics(MODEL, Q, V, TAU, contacts)
    J = tw.constraint_jacobian(MODEL, Q, contacts)
    if stabilise:
        back = tw.Baumgarte(stabilise, tw.contact_placements(MODEL, Q, contacts), 1.0)
        got = tw.contact_forward_dynamics(MODEL, Q, V, TAU, contacts, stabilise=back)
    forces = np.concatenate([got.forces[c.frame] for c in contacts]) if contacts else np.zeros(0)

    def left(q, v):
        """What both equations leave of q̈ and λ, with q or v a step along each entry."""
        rows = tw.constraint_jacobian(MODEL, q, contacts)
        moved = tw.rnea(MODEL, q, v, got.qdd) - np.matvec(rows.mT, forces)
        held = np.matvec(rows, got.qdd) + tw.constraint_bias(MODEL, q, v, contacts) + 2 * stabilise * np.matvec(rows, v)
        return np.concatenate([moved, held], axis=-1).imag.mT / H

    by_q, by_v = left(MODEL.integrate(Q, STEPS), V), left(Q, V + STEPS)
    by_q[MODEL.nv :] += stabilise**2 * J
    none = np.zeros((len(J), len(J)))
    matrix = np.block([[tw.crba(MODEL, Q), -J.T], [J, none]])
    by_tau = np.eye(len(matrix), MODEL.nv)
    return V, got, [np.linalg.solve(matrix, x) for x in (-by_q, -by_v, by_tau)]


def allowed(case, V):
    """The changes of (q, v) that keep the contacts where they are and at rest, in columns."""
    J = tw.constraint_jacobian(MODEL, Q, CASES[case])
    turned = np.matvec(tw.constraint_jacobian(MODEL, MODEL.integrate(Q, STEPS), CASES[case]), V).imag.mT / H
    return scipy.linalg.null_space(np.block([[J, 0 * J], [turned, J]])) if len(J) else np.eye(2 * MODEL.nv)


def theirs(case, stabilise=0.0):
    there = bridge.to_pinocchio_model(MODEL)
    models, datas = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
    anchors = tw.contact_placements(MODEL, Q, CASES[case])
    for c in CASES[case]:
        f, at = there.frames[there.getFrameId(c.frame)], anchors[c.frame]
        six = isinstance(c, tw.SurfaceContact) or getattr(c, "welded", False)
        kind, place = (
            pin.ContactType.CONTACT_6D if six else pin.ContactType.CONTACT_3D,
            pin.SE3(at.rotation, at.translation),
        )
        if c.to is None:
            ends = (f.parentJoint, f.placement, 0, place)
        else:
            to = there.frames[there.getFrameId(c.to)]
            ends = (f.parentJoint, f.placement, to.parentJoint, to.placement * place)
        models.append(pin.RigidConstraintModel(kind, there, *ends, pin.LOCAL))
        models[-1].setBaumgarteCorrectorParameters(pin.BaumgarteCorrectorParameters(stabilise**2, 2 * stabilise))
        datas.append(models[-1].createData())
    return there, there.createData(), models, datas


@pytest.mark.one_case
@pytest.mark.parametrize("case", sampled(CASES, 2))
def test_derivatives_of_the_acceleration_are_pinocchios(case):
    stabilise = 5.0 * ([*CASES].index(case) % 2)
    V, got, ours = solved(case, stabilise)
    there, data, models, datas = theirs(case, stabilise)
    pin.initConstraintDynamics(there, data, models, datas)
    v, tau = (bridge.to_pinocchio_tangent(MODEL, x) for x in (V, TAU))
    exactly = pin.ProximalSettings(1e-14, 1e-14, 0.0, 1)
    a = bridge.from_pinocchio_tangent(MODEL, pin.constraintDynamics(there, data, Q, v, tau, models, datas, exactly))
    np.testing.assert_allclose(got.qdd, a, rtol=0, atol=1e-11 * np.abs(a).max())
    pin.computeConstraintDynamicsDerivatives(there, data, models, datas, exactly)
    by_q, by_v, by_tau = (bridge.from_pinocchio_matrix(MODEL, x) for x in (data.ddq_dq, data.ddq_dv, data.ddq_dtau))
    near = {"rtol": 0, "atol": 1e-10 * np.abs(by_q).max()}
    np.testing.assert_allclose(ours[2][: MODEL.nv], by_tau, **near)
    ways = allowed(case, V)
    np.testing.assert_allclose(np.hstack(ours[:2])[: MODEL.nv] @ ways, np.hstack([by_q, by_v]) @ ways, **near)


@pytest.mark.slow
@cases
def test_they_are_what_differences_of_our_function_say(case):
    V, got, ours = solved(case)
    size, h = np.abs(got.qdd).max(), 1e-6
    for k in range(0, MODEL.nv, 3):
        dv = h * np.eye(MODEL.nv)[k]
        ways = [((MODEL.integrate(Q, s * dv), V, TAU), (Q, V + s * dv, TAU), (Q, V, TAU + s * dv)) for s in (1, -1)]
        for d, ends in zip(ours, zip(*ways, strict=True), strict=True):
            plus, minus = (tw.contact_forward_dynamics(MODEL, *end, CASES[case]).qdd for end in ends)
            np.testing.assert_allclose(d[: MODEL.nv, k], (plus - minus) / (2 * h), rtol=0, atol=1e-6 * size)


@pytest.mark.parametrize("case", sampled(["both", "point", "sole", "none"], 1))
def test_derivatives_of_an_impact_are_pinocchios(case):
    contacts, restitution = CASES[case], 0.3
    hit = tw.impact(MODEL, Q, RATE, contacts, restitution=restitution)
    V = RATE
    J, M = tw.constraint_jacobian(MODEL, Q, contacts), tw.crba(MODEL, Q)
    given = np.concatenate([hit.impulses[c.frame] for c in contacts]) if contacts else np.zeros(0)
    q = MODEL.integrate(Q, STEPS)
    rows = tw.constraint_jacobian(MODEL, q, contacts)
    left = [np.matvec(tw.crba(MODEL, q), hit.v - V) - np.matvec(rows.mT, given), rows @ (hit.v + restitution * V)]
    by_q = np.concatenate(left, axis=-1).imag.mT / H
    by_v = np.concatenate([-M, restitution * J])
    matrix = np.block([[M, -J.T], [J, np.zeros((len(J), len(J)))]])
    there, data, models, datas = theirs(case)
    pin.initConstraintDynamics(there, data, models, datas)
    v = bridge.to_pinocchio_tangent(MODEL, V)
    settings = pin.ProximalSettings(1e-14, 1e-14, 0.0, 1)
    after = pin.impulseDynamics(there, data, Q, v, models, datas, restitution, settings)
    after = bridge.from_pinocchio_tangent(MODEL, after)
    np.testing.assert_allclose(hit.v, after, rtol=0, atol=1e-11 * np.abs(after).max())
    pin.computeImpulseDynamicsDerivatives(there, data, models, datas, restitution, settings)
    jump = -np.eye(MODEL.nv)  # Pinocchio's derivative by v is that of v⁺ − v⁻
    for x, expected, less in ((by_q, data.ddq_dq, 0), (by_v, data.ddq_dv, jump)):
        d = less - np.linalg.solve(matrix, x)[: MODEL.nv]
        expected = bridge.from_pinocchio_matrix(MODEL, expected)
        np.testing.assert_allclose(d, expected, rtol=0, atol=1e-10 * max(1.0, np.abs(d).max()))
