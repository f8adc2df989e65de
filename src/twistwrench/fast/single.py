"""One state, in a few products with constant matrices.

For one state a call costs more than its arithmetic, so the number of calls decides; `.dot` is the cheapest.
All is written in 4 × 4 matrices, in which a placement, a twist, an acceleration and an inertia are one kind of thing,
and a robot is a stack of them:

    T   a placement: the points of a link, x̄ = (x, 1), are at T x̄, seen from the base
    Ŝ   a twist: points that move with it have the velocity Ŝ x̄
    B   an acceleration: T̈ = B T
    J   an inertia: ∫ x̄ x̄ᵀ dm, with second moments, first moments and mass

The momentum of a unit rate is Ŝ J, the force of an acceleration B J, and a joint's part of either is the sum of
its entries times those of the joint's Ŝ. Outboard of a joint that moves with Ŝq̇ on a carrier that moves with V it is

    T̈ = (B + 2 V Ŝq̇ + (Ŝq̇)²) T = (B + (V + V') Ŝq̇) T,    V' = V + Ŝq̇,

so that B is a sum over the ancestors, as V is. Positions are relative to the base: rounding depends on
the size of the robot, not on where it is.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from .products import TURN, TWISTS
from .single_plan import ContactRows, JointTerms, SinglePlan

__all__ = ["placements", "single_dynamics", "single_rnea", "turned"]

Parts = dict[str, Array]
ONES = np.ones(16)
ROW, COLUMN = np.indices((9, 4)).reshape(2, 36)
UNTURNED = np.eye(3).reshape(9)


class Place(NamedTuple):
    """Where the links of one state are.

    Attributes
    ----------
    pose : ndarray, shape (1 + n, 4, 4)
        The matrices T.
    twist : ndarray, shape (nv, 16)
        The matrices Ŝ of unit rates, row by row.
    turn : ndarray, shape (9,)
        The rotation from the axes of the base to those of the world, row by row.
    """

    pose: Array
    twist: Array
    turn: Array


def place(plan: SinglePlan, q: Array) -> Place:
    """Place the links of one state."""
    T, stack = placements(plan, q)
    for links, others in plan.chain:
        stack[links] = stack[others] @ stack[links]
    S = plan.twist.copy()
    products = (T[plan.origin] * T[plan.axis]).reshape(-1, 12)  # of p̄ and z
    products.dot(TURN, out=S[plan.base :])
    if plan.turn is not None:
        S[plan.base :] *= plan.turn
    if plan.sliding.size:
        slide = stack[1 + plan.sliding, :3, :3] @ plan.slide
        S.reshape(-1, 4, 4)[plan.base + plan.sliding, :3, 3] += slide[:, :, 0]
    return Place(stack, S, turned(plan, q))


def placements(plan: SinglePlan, q: Array) -> tuple[Array, Array]:
    """Return the placements of the links in their parents' axes, as one vector and, the same memory, as a stack."""
    done = _done(plan.joint_terms, q)
    T = plan.pose.copy()
    if plan.local.ndim == 2:
        plan.local.dot(done, out=T[16:])
    else:
        T[16:] = np.matmul(plan.local, done[plan.joint_terms.gather, None]).reshape(-1)
    stack = T.reshape(-1, 4, 4)
    for link, placed, own in plan.placed:
        moved = placed.joint.transform(q[placed.q]).matrix()
        moved[:3, :3] = moved[:3, :3] @ placed.axes
        stack[link] = own @ moved
    return T, stack


def _done(joint_terms: JointTerms, q: Array) -> Array:
    """Return the joint terms of q: see `JointTerms`."""
    done, angles = joint_terms.constant.copy(), q[joint_terms.angles]
    n = angles.size
    np.cos(angles, done[1 : n + 1])
    np.sin(angles, done[n + 1 : 2 * n + 1])
    if 2 * n + 2 < done.size:
        cos_sin, lengths = q[joint_terms.circles], q[joint_terms.lengths]
        cos_sin /= np.sqrt((cos_sin * cos_sin).sum(axis=0))
        done[2 * n + 1 : -1] = np.concatenate([cos_sin.reshape(-1), lengths])
    return done


def turned(plan: SinglePlan, q: Array) -> Array:
    """Return the rotation from the axes of the base to those of the world, row by row, shape (9,)."""
    if plan.base == 0:
        return UNTURNED
    x, y, z, w = q[3:7].tolist()  # for so few numbers Python's floats are quicker
    s = 2 / (x * x + y * y + z * z + w * w)
    a, b, c = s * x, s * y, s * z
    R: Array = np.array(
        (
            *(1 - b * y - c * z, a * y - c * w, a * z + b * w),
            *(a * y + c * w, 1 - a * x - c * z, b * z - a * w),
            *(a * z - b * w, b * z + a * w, 1 - a * x - b * y),
        )
    )
    return R if plan.under is None else plan.under.dot(R.reshape(3, 3)).reshape(9)


def single_rnea(plan: SinglePlan, q: Array, v: Array, a: Array) -> Array:
    """Return τ for one motion, shape (nv,)."""
    at = place(plan, q)
    return forces(plan, at, _inertias(plan, at), v, a)


def _inertias(plan: SinglePlan, at: Place) -> Array:
    """Return the inertias of the links seen from the base: T J Tᵀ."""
    J: Array = at.pose @ plan.J @ at.pose.mT
    return J


def forces(plan: SinglePlan, at: Place, J: Array, v: Array, a: Array | None = None) -> Array:
    """Return τ for one motion, shape (nv,), from the inertias seen from the base."""
    joint, around = plan.sums.moving(at.twist * v[:, None])
    B = around @ joint  # (V + V') Ŝq̇
    if a is not None:
        B += plan.sums.moving(at.twist * a[:, None])[0]
    B[0, :3, 3] -= plan.gravity.dot(at.turn.reshape(3, 3))  # the world rises
    B = plan.sums.outward(B.reshape(-1, 16)).reshape(-1, 4, 4)
    force = plan.sums.outboard((B @ J).reshape(-1, 16))
    tau: Array = (at.twist * force).dot(ONES)
    return tau if a is None or plan.rotor is None else tau + plan.rotor * a


def single_dynamics(
    plan: SinglePlan, want: Collection[str], contacts: ContactRows | None, q: Array, v: Array | None = None
) -> Parts:
    """Return what is wanted of one state, by name; only h needs v, and only J_c contacts."""
    at, parts = place(plan, q), {}
    if contacts is not None:
        parts["J_c"] = contact_jacobian(at, contacts)
    if len(want) == len(parts):
        return parts
    J = _inertias(plan, at)
    if v is not None and "h" in want:
        parts["h"] = forces(plan, at, J, v)
    if "M" in want or "A_G" in want:
        carried = plan.sums.carried(J.reshape(-1, 16)).reshape(-1, 4, 4)
        momenta = (at.twist.reshape(-1, 4, 4) @ carried[1:]).reshape(-1, 16).mT
        # The momenta of unit rates, projected on the joints or on the unit twists of the base.
        along = at.twist.dot(momenta) if "M" in want or plan.base else TWISTS.dot(momenta)
        if "M" in want:
            parts["M"] = mass_matrix(plan, along)
        if "A_G" in want:
            of_base = along[:6] if plan.base else TWISTS.dot(momenta)
            parts["A_G"] = centroidal_matrix(plan, at, of_base, carried[0, 3])
    return parts


def mass_matrix(plan: SinglePlan, along: Array) -> Array:
    """Return M, from the momenta of unit rates projected on the joints: above the diagonal, and 0 if unrelated."""
    M = along.take(plan.upper)
    M *= plan.related
    if plan.rotor is not None:
        M.flat[:: len(M) + 1] += plan.rotor
    return M


def centroidal_matrix(plan: SinglePlan, at: Place, momentum: Array, moment: Array) -> Array:
    """Return A_G, from the momenta of unit rates about the origin and in the axes of the base; moment is m (c, 1)."""
    to_com = plan.to_com.dot(at.turn[ROW] * moment[COLUMN]).reshape(6, 6)
    A_G: Array = to_com.dot(momentum)
    return A_G


def contact_jacobian(at: Place, contacts: ContactRows) -> Array:
    """Return the linear rows of the contacts, shape (3 k, nv)."""
    if contacts.placed is not None:
        points = contacts.placed.dot(at.pose.reshape(-1))
    else:
        points = (at.pose.take(contacts.link, axis=0) @ contacts.point).reshape(-1)
    velocity = at.turn[contacts.row] * points[contacts.column]
    J_c: Array = velocity.reshape(-1, 16).dot(at.twist.mT)
    J_c *= contacts.moved
    return J_c
