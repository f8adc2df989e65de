"""Inverse dynamics of all links at once (49.6).

The twists of `twistwrench.rnea` are taken apart here into angular velocity and the velocity of the link's own
origin, in the axes of the base: going from link to link then costs a cross product and no 6 × 6 matrix, and no
digits, however far the base is from the world's origin or the link from the base's.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array
from .frames import Frames, Inertias
from .plan import Plan
from .vectors import CYCLE, cross, dot, times, transposed_times, unfold

__all__ = ["add_external", "base_acceleration", "coriolis", "forces", "inward", "outward", "rates", "spins"]


def outward(plan: Plan, x: Array) -> Array:
    """Add to every link the values of its ancestors; in place."""
    for level in plan.levels:
        x[:, level.here] += x[:, level.up]
    return x


def inward(plan: Plan, x: Array, moved: Array | None = None) -> Array:
    """Add to every link the values of its children, moved to the link's origin; in place."""
    for level in reversed(plan.levels):
        coming = x[:, level.here] if moved is None else x[:, level.here] + moved[:, level.here]
        for parents, children in level.inward:
            x[:, parents] += coming[:, children]
    return x


def forces(
    plan: Plan, frames: Frames, inertias: Inertias, v: Array, a: Array | None = None, f_ext: Array | None = None
) -> Array:
    """Return τ, shape (nv, b), that makes the motion happen; without `a` for no acceleration.

    v and a have shape (nv, b), f_ext (nbodies, 6, b).
    """
    w = spins(plan, frames, v)
    dw = _angular_acceleration(plan, frames, w, v, a)
    K = rates(w, dw)
    acc = np.empty_like(w)  # of the origins, the world rising
    acc[:, 0] = base_acceleration(plan, frames, v, a)
    coriolis_term = coriolis(plan, frames, w, v, a)
    for level in plan.levels:
        here, up = level.here, level.up
        acc[:, here] = times(K[:, :, up], frames.offset[:, here])
        acc[:, here] += acc[:, up]
        if coriolis_term is not None:
            acc[:, here] += coriolis_term[:, here]
    I, h = unfold(inertias.about_origin), inertias.moment
    f = acc * plan.mass + times(K, h)  # Newton
    n = times(I, dw) + cross(w, times(I, w)) + cross(h, acc)  # Euler, about the link's origin
    if f_ext is not None:
        add_external(plan, frames, -f_ext, n, f)
    f = inward(plan, f)
    n = inward(plan, n, moved=cross(frames.offset, f))
    return _at_joints(plan, frames, n, f) + (0 if a is None else plan.rotor * a)


def spins(plan: Plan, frames: Frames, v: Array) -> Array:
    """Return the angular velocities ω, shape (3, 1 + n, b)."""
    w = np.empty_like(frames.offset)
    w[:, 0] = v[:3] if plan.floats else 0
    w[:, 1:] = frames.spin[:, 1:] * v[plan.entry[1:]]
    return outward(plan, w)


def _angular_acceleration(plan: Plan, frames: Frames, w: Array, v: Array, a: Array | None) -> Array:
    """Return ω̇, shape (3, 1 + n, b): each joint adds its axis times q̈, and the turning of that axis times q̇."""
    dw = np.empty_like(w)
    dw[:, 0] = a[:3] if plan.floats and a is not None else 0
    dw[:, 1:] = cross(w[:, plan.last], frames.spin[:, 1:] * v[plan.entry[1:]])
    if a is not None:
        dw[:, 1:] += frames.spin[:, 1:] * a[plan.entry[1:]]
    return outward(plan, dw)


def rates(w: Array, dw: Array | None = None) -> Array:
    """Return K = ω×ω× + ω̇×, shape (3, 3, 1 + n, b): a point at r from a link's origin is accelerated by K r."""
    K, squares = np.empty((3, *w.shape), w.dtype), w * w
    for i, j, k in CYCLE:
        np.add(squares[j], squares[k], out=K[i, i])
        np.negative(K[i, i], out=K[i, i])
        np.multiply(w[i], w[j], out=K[i, j])
        K[j, i] = K[i, j]
        if dw is not None:
            K[i, j] -= dw[k]
            K[j, i] += dw[k]
    return K


def base_acceleration(plan: Plan, frames: Frames, v: Array, a: Array | None) -> Array:
    """Return the acceleration of the base's origin, shape (3, b), in a world that rises instead of weighing."""
    if frames.base is None:
        return np.broadcast_to(-plan.gravity, (3, v.shape[-1]))
    rising = cross(v[:3], v[3:6]) - transposed_times(frames.base, plan.gravity)
    return rising if a is None else rising + a[3:6]


def coriolis(plan: Plan, frames: Frames, w: Array, v: Array, a: Array | None = None) -> Array | None:
    """Return the accelerations of the origins from sliding, shape (3, 1 + n, b); None where nothing slides.

    The link's velocity u turns with ω: ω × u. And the velocity of the carrier differs from place to
    place: ω × u again, with the ω of the carrier.
    """
    if frames.slide is None:
        return None
    coriolis_term = np.zeros_like(w)
    coriolis_term[:, 1:] = cross(w[:, plan.before] + w[:, plan.last], frames.slide[:, 1:] * v[plan.entry[1:]])
    if a is not None:
        coriolis_term[:, 1:] += frames.slide[:, 1:] * a[plan.entry[1:]]
    return coriolis_term


def add_external(plan: Plan, frames: Frames, f_ext: Array, n: Array, f: Array) -> None:
    """Add wrenches on the bodies, shape (nbodies, 6, b) in their frames, to those on the links; in place."""
    for link, body, axes in plan.bodies:
        of_body = np.einsum("kib,kc->icb", frames.axes[:, :, link], axes)  # the body's axes in those of the base
        n[:, link] += times(of_body, f_ext[body, :3])
        f[:, link] += times(of_body, f_ext[body, 3:])


def _at_joints(plan: Plan, frames: Frames, n: Array, f: Array) -> Array:
    """Return the joints' components of the wrenches through them, shape (nv, b)."""
    tau = np.empty((plan.nv, n.shape[-1]), n.dtype)
    tau[plan.entry[1:]] = dot(frames.spin[:, 1:], n[:, 1:])
    if frames.slide is not None:
        tau[plan.entry[1:]] += dot(frames.slide[:, 1:], f[:, 1:])
    if plan.floats:
        tau[:3], tau[3:6] = n[:, 0], f[:, 0]
    return tau
