"""Where the links are: the first step of every quantity."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..arrays import Array
from .plan import Placed, Plan
from .vectors import SYMMETRIC, rotation

__all__ = ["Frames", "Inertias", "frames_of", "inertias_of", "origins_of"]


class Frames(NamedTuple):
    """The links at a configuration, in the axes of the base or of the world.

    Attributes
    ----------
    axes : ndarray, shape (3, 3, 1 + n, b)
        ``axes[0]``, ``axes[1]`` and ``axes[2]`` are the axes x, y and z of the links.
    offset : ndarray, shape (3, 1 + n, b)
        From the parent's origin to the link's, m.
    spin, slide : ndarray, shape (3, 1 + n, b); slide is None where no link slides
        The angular velocity of a link for a unit rate, and the velocity with which it slides. Entry 0 means nothing.
    base : ndarray, shape (3, 3, b), or None
        The rotation from the axes of a floating base to those of the world.
    in_world : bool
        Whether all this is in the axes of the world.
    """

    axes: Array
    offset: Array
    spin: Array
    slide: Array | None
    base: Array | None
    in_world: bool


class Inertias(NamedTuple):
    """The inertias of the links, in the axes of the base about their own origins.

    Attributes
    ----------
    about_origin : ndarray, shape (6, 1 + n, b)
        The entries `vectors.SYMMETRIC` of the inertia, kg m².
    moment : ndarray, shape (3, 1 + n, b)
        Mass times the vector to the centre of mass, kg m.
    """

    about_origin: Array
    moment: Array


def frames_of(plan: Plan, q: Array, *, in_world: bool = False) -> Frames:
    """Place the links, with q of shape (nq, b), in the axes of the base, or of the world if it is asked for.

    Only the axes can be the world's. Positions are seen from the base: far from the world's origin they would lose
    their digits.
    """
    b = q.shape[-1]
    base = _base(plan, q) if plan.floats else None
    in_world = in_world or base is None
    axes, offset = np.empty((3, 3, 1 + plan.n, b), q.dtype), np.zeros((3, 1 + plan.n, b), q.dtype)
    axes[:, :, 0] = np.eye(3)[..., None] if base is None or not in_world else base.swapaxes(0, 1)
    cos, sin = _cos_sin(plan, q)
    for level, placed in zip(plan.levels, plan.placed):
        here, k = level.here, slice(level.here.start - 1, level.here.stop - 1)
        constant = np.empty((4, 3, here.stop - here.start, b), q.dtype)  # axes and offset before the joint moves
        by_component = axes[:, :, level.up].transpose(1, 2, 0, 3), constant.transpose(1, 2, 0, 3)
        np.matmul(plan.fixed[k], by_component[0], out=by_component[1])
        x, y, axes[2, :, here], offset[:, here] = constant
        np.add(cos[k] * x, sin[k] * y, out=axes[0, :, here])
        np.subtract(cos[k] * y, sin[k] * x, out=axes[1, :, here])
        for one in placed:
            number = here.start + one.link
            _place(one, q, constant[:, :, one.link], axes[:, :, number], offset[:, number])
    spin, slide = axes[2] if plan.turn is None else axes[2] * plan.turn, _slide(plan, axes)
    if slide is not None:
        links, lengths = plan.lengths
        offset[:, 1:][:, links] += slide[:, 1:][:, links] * q[lengths]
    return Frames(axes, offset, spin, slide, base, in_world)


def _slide(plan: Plan, axes: Array) -> Array | None:
    """Return the velocities with which links slide for unit rates; most of them along z."""
    if plan.slide is None:
        return None
    slide: Array = axes[2] * plan.slide[2]
    for axis, part in zip(axes[:2], plan.slide[:2]):
        if part.any():
            slide += axis * part
    return slide


def _base(plan: Plan, q: Array) -> Array:
    """Return the rotation from the axes of a floating base to those of the world, shape (3, 3, b)."""
    R = rotation(q[3:7])
    return R if (plan.under == np.eye(3)).all() else np.einsum("ij,jkb->ikb", plan.under, R)


def _cos_sin(plan: Plan, q: Array) -> tuple[Array, Array]:
    """Return cosine and sine of every link's turn, shape (n, b); 1 and 0 where q does not turn it by an angle.

    Of an angle by one tangent of its half, which NumPy computes in a quarter of the time that cosine and sine
    take together: cos = (1 − t²)/(1 + t²), sin = 2t/(1 + t²).
    """
    links, angles = plan.angles
    t = np.tan(q[angles] / 2)
    s = 2 / (1 + t * t)
    if len(angles) == plan.n:
        return s - 1, s * t
    cos, sin = np.ones((plan.n, q.shape[-1]), q.dtype), np.zeros((plan.n, q.shape[-1]), q.dtype)
    cos[links], sin[links] = s - 1, s * t
    links, begin = plan.circles
    c, s = q[begin], q[begin + 1]
    norm = np.sqrt(c * c + s * s)
    cos[links], sin[links] = c / norm, s / norm
    return cos, sin


def _place(one: Placed, q: Array, constant: Array, axes: Array, offset: Array) -> None:
    """Place, in `axes` and `offset`, the first link of a joint by the joint's `transform`."""
    T = one.joint.transform(q[one.q].mT)
    R, p = T.rotation.transpose(1, 2, 0), T.translation.mT
    axes[:] = np.einsum("cib,cdb,dk->kib", constant[:3], R, one.axes)
    offset += np.einsum("cib,cb->ib", constant[:3], p)


def inertias_of(plan: Plan, frames: Frames) -> Inertias:
    """Turn the inertias of the links into the axes of the base: R I Rᵀ and R h."""
    axes = frames.axes
    half = np.empty((3, 4, *axes.shape[2:]), axes.dtype)  # component by component: the rows of I Rᵀ, and R h
    np.matmul(plan.inertia, axes.transpose(1, 2, 0, 3), out=half.transpose(0, 2, 1, 3))
    about_origin = np.empty((6, *axes.shape[2:]), axes.dtype)
    for out, (i, j) in zip(about_origin, SYMMETRIC):
        np.einsum("knb,knb->nb", axes[:, i], half[j, :3], out=out)
    return Inertias(about_origin, half[:, 3])


def origins_of(plan: Plan, frames: Frames) -> Array:
    """Return where the origins are, seen from the base's, shape (3, 1 + n, b)."""
    origin = frames.offset.copy()
    for level in plan.levels:
        origin[:, level.here] += origin[:, level.up]
    return origin
