"""Forward dynamics by articulated inertias, level by level (49.7).

Three passes as in `twistwrench.aba`, but with all links of a level at once, in the axes of the base, each about its
own origin. An articulated inertia [A, H; Hᵀ, L] takes (ω̇, acceleration of the origin) to (moment, force). A and L
are kept as six entries each: an asymmetry from rounding would grow from link to link.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..arrays import Array, resolution
from .dofs import Level
from .forces import add_external, base_acceleration, coriolis, rates, spins
from .frames import Frames, Inertias
from .plan import Plan
from .vectors import CYCLE, SYMMETRIC, cross, dot, symmetric_times, times, transposed_times, unfold

__all__ = ["NearlySingular", "accelerations", "floors"]


class NearlySingular(ArithmeticError):
    """A joint may have no apparent inertia. The textbook decides, and names the joint."""


class Articulated(NamedTuple):
    """Articulated-body inertias and bias wrenches of the links, views of `entries`.

    Attributes
    ----------
    entries : ndarray, shape (27, 1 + n, b)
    A, L : ndarray, shape (6, 1 + n, b)
        In the order of `vectors.SYMMETRIC`.
    H : ndarray, shape (3, 3, 1 + n, b)
    n, f : ndarray, shape (3, 1 + n, b)
        Moment and force that are needed without acceleration.
    """

    entries: Array
    A: Array
    L: Array
    H: Array
    n: Array
    f: Array

    @classmethod
    def of(cls, entries: Array) -> Articulated:
        """Take the 27 entries apart."""
        H = entries[12:21].reshape(3, 3, *entries.shape[1:])
        return cls(entries, entries[:6], entries[6:12], H, entries[21:24], entries[24:])

    def at(self, level: Level) -> Articulated:
        """Return the part of a level."""
        return Articulated(*(x[..., level.here, :] for x in self))


class Bias(NamedTuple):
    """The bias accelerations of the links, relative to their parents."""

    angular: Array
    linear: Array


class Joints(NamedTuple):
    """The terms of a level that pass 3 needs: q̈ = (u − Uᵀ a) / D."""

    U_angular: Array
    U_linear: Array
    D: Array
    u: Array


def accelerations(
    plan: Plan, frames: Frames, inertias: Inertias, v: Array, tau: Array, f_ext: Array | None = None
) -> Array:
    """Return q̈, shape (nv, b). v and tau have shape (nv, b), f_ext (nbodies, 6, b).

    Raises
    ------
    NearlySingular
        If a joint may have no apparent inertia.
    """
    IA, c = _start(plan, frames, inertias, v, f_ext)
    floor, base_floor = _floors(plan, frames)
    joints = []
    for level in reversed(plan.levels):  # pass 2
        here, r = IA.at(level), frames.offset[:, level.here]
        joints.append(_free(plan, frames, level, here, tau, floor))
        _feel_through(here, joints[-1], Bias(c.angular[:, level.here], c.linear[:, level.here]))
        _move(here, r)
        for parents, children in level.inward:
            IA.entries[:, parents] += here.entries[:, children]
    qdd, dw, acc = np.empty_like(v), np.empty_like(IA.n), np.empty_like(IA.n)
    dw[:, 0], acc[:, 0] = 0, base_acceleration(plan, frames, v, None)
    if plan.floats:
        qdd[:6] = _base(plan, IA, tau, acc[:, 0], base_floor)
        dw[:, 0], acc[:, 0] = qdd[:3], acc[:, 0] + qdd[3:6]
    for level, joint in zip(plan.levels, reversed(joints)):  # pass 3
        links, up = level.here, level.up
        dw[:, links] = dw[:, up] + c.angular[:, links]
        acc[:, links] = acc[:, up] + cross(dw[:, up], frames.offset[:, links]) + c.linear[:, links]
        rate = joint.u - dot(joint.U_angular, dw[:, links]) - dot(joint.U_linear, acc[:, links])
        rate /= joint.D
        dw[:, links] += frames.spin[:, links] * rate
        if frames.slide is not None:
            acc[:, links] += frames.slide[:, links] * rate
        qdd[plan.entry[links]] = rate
    return qdd


def _start(plan: Plan, frames: Frames, inertias: Inertias, v: Array, f_ext: Array | None) -> tuple[Articulated, Bias]:
    """Pass 1: the terms that depend on positions and velocities alone."""
    w, h = spins(plan, frames, v), inertias.moment
    K = rates(w)
    IA = Articulated.of(np.zeros((27, *w.shape[1:]), w.dtype))
    IA.A[:], IA.L[:3] = inertias.about_origin, plan.mass
    for i, j, k in CYCLE:
        IA.H[j, i] = h[k]
        np.negative(h[k], out=IA.H[i, j])
    IA.n[:], IA.f[:] = cross(w, symmetric_times(inertias.about_origin, w)), times(K, h)
    if f_ext is not None:
        add_external(plan, frames, -f_ext, IA.n, IA.f)
    angular, coriolis_term = np.zeros_like(w), coriolis(plan, frames, w, v)
    angular[:, 1:] = cross(w[:, plan.last], frames.spin[:, 1:] * v[plan.entry[1:]])
    linear = np.zeros_like(w) if coriolis_term is None else coriolis_term
    for level in plan.levels:
        linear[:, level.here] += times(K[:, :, level.up], frames.offset[:, level.here])
    return IA, Bias(angular, linear)


def _free(plan: Plan, frames: Frames, level: Level, here: Articulated, tau: Array, floor: Array) -> Joints:
    """Return the joint terms of a level: U = I S, D = Sᵀ U and u = τ − Sᵀ p."""
    entries, spin = plan.entry[level.here], frames.spin[:, level.here]
    U_angular, U_linear = symmetric_times(here.A, spin), transposed_times(here.H, spin)
    u = tau[entries] - dot(spin, here.n)
    D = plan.rotor[entries] + dot(spin, U_angular)
    if frames.slide is not None:
        slide = frames.slide[:, level.here]
        U_angular += times(here.H, slide)
        U_linear += symmetric_times(here.L, slide)
        u -= dot(slide, here.f)
        D = plan.rotor[entries] + dot(spin, U_angular) + dot(slide, U_linear)
    if not (D.real > floor[level.here]).all():
        raise NearlySingular
    return Joints(U_angular, U_linear, D, u)


def _feel_through(here: Articulated, joint: Joints, c: Bias) -> None:
    """Replace, in place, the articulated inertias by those seen through the free joints: I − U Uᵀ / D."""
    x, y = joint.U_angular / joint.D, joint.U_linear / joint.D
    for k, (i, j) in enumerate(SYMMETRIC):
        here.A[k] -= joint.U_angular[i] * x[j]
        here.L[k] -= joint.U_linear[i] * y[j]
    for i in range(3):
        here.H[i] -= joint.U_angular[i] * y
    here.n[:] += symmetric_times(here.A, c.angular) + times(here.H, c.linear) + x * joint.u
    here.f[:] += transposed_times(here.H, c.angular) + symmetric_times(here.L, c.linear) + y * joint.u


def _move(here: Articulated, r: Array) -> None:
    """Refer, in place, inertias and wrenches to the origins of the parents, from which the links are at r.

    With G = H + r×L/2: H + r×L, and A + r×Gᵀ + (r×Gᵀ)ᵀ.
    """
    half = cross(r[:, None], unfold(here.L))
    half /= 2
    here.H[:] += half
    rG = cross(r[:, None], here.H.swapaxes(0, 1))
    here.H[:] += half
    for k, (i, j) in enumerate(SYMMETRIC):
        here.A[k] += rG[i, j] + rG[j, i]
    here.n[:] += cross(r, here.f)


def _base(plan: Plan, IA: Articulated, tau: Array, rising: Array, floor: Array) -> Array:
    """Return the acceleration of a floating base, shape (6, b): six equations by elimination."""
    I = np.empty((6, 6, *rising.shape[1:]), rising.dtype)
    A, L, H = unfold(IA.A[:, 0]), unfold(IA.L[:, 0]), IA.H[:, :, 0]
    I[:3, :3], I[:3, 3:], I[3:, :3], I[3:, 3:] = A, H, H.swapaxes(0, 1), L
    I[range(6), range(6)] += plan.rotor[:6]
    x = tau[:6].copy()
    x[:3] -= IA.n[:, 0] + times(H, rising)
    x[3:] -= IA.f[:, 0] + times(L, rising)
    with np.errstate(divide="ignore", invalid="ignore"):
        for k in range(5):
            factor = I[k + 1 :, k] / I[k, k]
            I[k + 1 :, k + 1 :] -= factor[:, None] * I[k, k + 1 :]
            x[k + 1 :] -= factor * x[k]
    pivots = I[range(6), range(6)]
    if not (pivots.real > floor).all():
        raise NearlySingular
    for k in reversed(range(6)):
        x[k] = (x[k] - dot(I[k, k + 1 :], x[k + 1 :])) / pivots[k]
    return x


def _floors(plan: Plan, frames: Frames) -> tuple[Array, Array]:
    """Return `floors`, computed once where they do not depend on the state."""
    if plan.reach is None:
        return floors(plan, np.sqrt((frames.offset * frames.offset).real.sum(axis=0).max(axis=-1)))
    if "floors" not in plan.kept:
        plan.kept["floors"] = floors(plan, plan.reach)
    kept: tuple[Array, Array] = plan.kept["floors"]
    return kept


def floors(plan: Plan, reach: Array) -> tuple[Array, Array]:
    """Return the D below which the textbook takes over, for the links, (1 + n, 1), and for the base, (6, 1).

    That is a millionth of the apparent inertia with the outboard joints locked, or so little that half of the digits
    go. There the textbook runs instead, which bounds each rounding and loses less: in the axes of the joints many
    terms are zero, in those of the base they only cancel. The inertia with locked joints is bounded by the largest
    distances of the links from their parents: `reach`, shape (1 + n,).
    """
    mass, first, second = plan.carried[:, 0], plan.first.copy(), plan.second.copy()
    for level in reversed(plan.levels):
        r, m, near, far = (x[level.here] for x in (reach, mass, first, second))
        for parents, children in level.inward:
            second[parents] += (far + 2 * r * near + r * r * m)[children]
            first[parents] += (near + r * m)[children]
    turn = 1 if plan.turn is None else plan.turn[:, 0]
    slide = 0 if plan.slide is None else np.sqrt((plan.slide[..., 0] ** 2).sum(axis=0))
    locked = turn * turn * second + 2 * turn * slide * first + slide * slide * mass
    locked[1:] += plan.rotor[plan.entry[1:], 0]
    base = np.repeat([second[0], mass[0]], 3) + (plan.rotor[:6, 0] if plan.floats else 0)
    lost = max(1e-6, math.sqrt(resolution(mass.dtype)))
    return lost * locked[:, None], lost * base[:, None]
