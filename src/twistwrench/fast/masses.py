"""Mass matrix and centroidal momentum of all links at once (49.8, 49.10).

Sums of inertias need no 6 × 6 matrices here: in the axes of the base, moving an inertia from a link's origin to its
parent's is no more than the parallel-axis theorem.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..arrays import Array
from .dofs import Index
from .forces import inward
from .frames import Frames, Inertias
from .plan import Plan
from .vectors import CYCLE, cross, dot, matrix_product, symmetric_times, unfold

__all__ = ["Momenta", "centroidal_matrix", "composite", "mass_matrix", "momenta"]


class Momenta(NamedTuple):
    """The momentum of all that a link carries, for a unit rate of that link alone.

    Attributes
    ----------
    angular : ndarray, shape (3, 1 + n, b)
        About the link's origin. Entry 0 means nothing.
    linear : ndarray, shape (3, 1 + n, b)
    """

    angular: Array
    linear: Array


def composite(plan: Plan, frames: Frames, inertias: Inertias) -> Inertias:
    """Return the inertias of the links with all that they carry, the joints locked."""
    r = frames.offset
    moved = r * plan.carried  # mass times the way to the parent's origin
    h = inward(plan, inertias.moment.copy(), moved=moved)
    # About the parent's origin it is I + r gᵀ + g rᵀ − 2 (r·g) 1 with g = −h − m r/2.
    g = moved
    g *= -0.5
    g -= h
    shift, along = np.empty_like(inertias.about_origin), -2 * (r * g)
    for i, j, k in CYCLE:
        np.add(along[j], along[k], out=shift[i])
        np.multiply(r[j], g[k], out=shift[3 + i])
        shift[3 + i] += r[k] * g[j]
    return Inertias(inward(plan, inertias.about_origin.copy(), moved=shift), h)


def momenta(plan: Plan, frames: Frames, carried: Inertias) -> Momenta:
    """Return the momenta I S of unit rates, from the inertias that the links carry."""
    h = carried.moment
    n, f = symmetric_times(carried.about_origin, frames.spin), cross(frames.spin, h)
    if frames.slide is not None:
        n += cross(h, frames.slide)
        f += frames.slide * plan.carried
    return Momenta(n, f)


def mass_matrix(plan: Plan, frames: Frames, origin: Array, carried: Inertias, momenta: Momenta, M: Array) -> None:
    """Write the mass matrix to M, shape (nv, nv, b).

    All momenta are shifted to the base together, one link per step, and projected on the joints on the way.
    """
    n, f, e = momenta.angular.copy(), momenta.linear, plan.entry
    M[plan.apart] = 0
    M[e[1:], e[1:]] = _joint_part(frames, slice(1, None), n[:, 1:], f[:, 1:])
    if plan.floats:
        at_base = n + cross(origin, f)
        _base_rows(plan, carried, at_base, f, M)
    for movers, left, reached in plan.steps:
        n[:, movers] += cross(frames.offset[:, left], f[:, movers])
        part = _joint_part(frames, reached, n[:, movers], f[:, movers])
        M[e[reached], e[movers]] = part
        M[e[movers], e[reached]] = part
    diagonal = np.arange(plan.nv)
    M[diagonal, diagonal] += plan.rotor


def _joint_part(frames: Frames, links: Index, n: Array, f: Array) -> Array:
    """Return Sᵀ F of wrenches or momenta F = (n, f) at the origins of links."""
    part = dot(frames.spin[:, links], n)
    if frames.slide is not None:
        part += dot(frames.slide[:, links], f)
    return part


def _base_rows(plan: Plan, carried: Inertias, n: Array, f: Array, M: Array) -> None:
    """Write the rows and columns of a floating base: the momentum about its origin, in its axes."""
    e = plan.entry[1:]
    M[:3, e], M[3:6, e] = n[:, 1:], f[:, 1:]
    M[e, :3], M[e, 3:6] = n[:, 1:].swapaxes(0, 1), f[:, 1:].swapaxes(0, 1)
    angular, linear = _of_base(carried)
    M[:3, :3], M[3:6, :3] = angular, linear
    M[:3, 3:6] = linear.swapaxes(0, 1)
    M[3:6, 3:6] = plan.carried[0] * np.eye(3, dtype=M.dtype)[..., None]


def _of_base(carried: Inertias) -> tuple[Array, Array]:
    """Return angular and linear momentum about the base's origin for unit turns of the base, (3, 3, b) each."""
    h, linear = carried.moment[:, 0], np.zeros((3, 3, carried.moment.shape[-1]), carried.moment.dtype)
    for i, j, k in CYCLE:
        linear[i, j], linear[j, i] = h[k], -h[k]  # e_j × h
    return unfold(carried.about_origin[:, 0]), linear


def centroidal_matrix(plan: Plan, frames: Frames, origin: Array, carried: Inertias, momenta: Momenta, A: Array) -> None:
    """Write the centroidal momentum matrix to A, shape (6, nv, b)."""
    e, m, h = plan.entry[1:], plan.carried[0], carried.moment[:, 0]
    com = (h / m)[:, None]
    A[:3, e] = momenta.angular[:, 1:] + cross(origin[:, 1:] - com, momenta.linear[:, 1:])
    A[3:, e] = momenta.linear[:, 1:]
    if frames.base is None:
        return
    turns = frames.base if frames.in_world else np.eye(3, dtype=h.dtype)[..., None]
    linear = cross(turns, h[:, None])  # the base turns about its own axes
    A[:3, :3], A[3:, :3] = matrix_product(unfold(carried.about_origin[:, 0]), turns) - cross(com, linear), linear
    A[:3, 3:6], A[3:, 3:6] = 0, m * turns
    if not frames.in_world:
        A[:3], A[3:] = matrix_product(frames.base, A[:3]), matrix_product(frames.base, A[3:])
