"""The programs of a step of time stepping: to its middle and what the robot is there, and to its end.

What `straight`, M and the rows of the points do one after the other is one program, in which they share their work.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..algorithms.crba import crba
from ..algorithms.factorization import factorize, inboard_dofs, solve_inward
from ..arrays import Array
from ..contact import SurfaceContact
from ..contact.decomposition import cholesky_factors
from ..contact.programs import Once
from ..contact.rows import ContactRows, contact_rows
from ..fast.program import Results
from ..fast.programs import cached_program
from ..fast.quantity import Quantity
from ..fast.watch import pivots
from ..model import Model, tree_terms
from ..spatial._elementary import sqrt
from .straight import shifted_and_turned, turned

__all__ = ["arrive", "middle_of_step", "placements_of"]

DOUBLE = np.dtype(np.float64)


def middle_of_step(model: Model, frames: tuple[str, ...], q: Array, v: Array, half: Array, damping: Array) -> Results:
    """Return what a robot is after a way `half` from q.

    q and v in the axes there; M, and `white`, with whiteᵀ white the inverse of M plus the damping on its diagonal;
    `rows`, J of the frames, shape (c, 6, nv); `frames`, their placements in the world, (c, 3, 4), `start` those in q.
    """

    def asked() -> Iterator[Quantity]:
        there = Once(lambda q, u: shifted_and_turned(model, q, u))
        rows = Once(lambda q: rows_of(model, frames, q))

        def white(q: Array, u: Array, damping: Array) -> tuple[Array, list[Any]]:
            return white_inverse(model, there(q, u), damping)

        yield Quantity("q", ("q", "a"), lambda q, u: (there(q, u), []))
        yield Quantity("v", ("v", "a"), lambda v, u: (turned(model, v, u), []))
        yield Quantity("M", ("q", "a"), lambda q, u: (crba(model, there(q, u)), []))
        yield Quantity("white", ("q", "a", "tau"), white)
        yield Quantity("rows", ("q", "a"), lambda q, u: (stacked_rows(rows(there(q, u))), []))
        yield Quantity("frames", ("q", "a"), lambda q, u: (stacked_places(rows(there(q, u))), []))
        yield Quantity("start", ("q",), lambda q: (stacked_places(rows_of(model, frames, q)), []))

    key = ("middle of a step", frames)
    found: Results = cached_program(model, key, DOUBLE, lambda: [*asked()])(q, v, half, damping)
    return found


def arrive(model: Model, frames: tuple[str, ...], q: Array, v: Array, back: Array, way: Array) -> Results:
    """Return the robot after a way from q: q, v, and `frames`, the placements of frames in the world.

    v and the way are in axes to which `back` leads from those that are asked for.
    """

    def asked() -> Iterator[Quantity]:
        here = Once(lambda way, back: turned(model, way, back))
        there = Once(lambda q, u: shifted_and_turned(model, q, u))

        def place(q: Array, back: Array, way: Array) -> tuple[Array, list[Any]]:
            return there(q, here(way, back)), []

        def speed(v: Array, back: Array, way: Array) -> tuple[Array, list[Any]]:
            return turned(model, turned(model, v, back), here(way, back)), []

        def places(q: Array, back: Array, way: Array) -> tuple[Array, list[Any]]:
            return stacked_places(rows_of(model, frames, there(q, here(way, back)))), []

        yield Quantity("q", ("q", "a", "tau"), place)
        yield Quantity("v", ("v", "a", "tau"), speed)
        yield Quantity("frames", ("q", "a", "tau"), places)

    key = ("end of a step", frames)
    found: Results = cached_program(model, key, DOUBLE, lambda: [*asked()])(q, v, back, way)
    return found


def placements_of(model: Model, frames: tuple[str, ...], q: Array) -> Array:
    """Return the placements of frames in the world, shape (..., c, 3, 4)."""

    def asked() -> list[Quantity]:
        return [Quantity("frames", ("q",), lambda q: (stacked_places(rows_of(model, frames, q)), []))]

    found: Array = cached_program(model, ("frames of a ground", q.dtype, frames), q.dtype, asked, single=True)(q)
    return found


def rows_of(model: Model, frames: tuple[str, ...], q: Array) -> ContactRows:
    """Return all six rows of frames, as of soles."""
    every = [SurfaceContact(name, (1.0, 1.0), 0.0) for name in frames]
    return contact_rows(model, q, np.zeros((*q.shape[:-1], model.nv), q.dtype), every)


def stacked_rows(rows: ContactRows) -> Array:
    """Return J, shape (..., c, 6, nv)."""
    J = rows.J
    return J.reshape(*J.shape[:-2], J.shape[-2] // 6, 6, J.shape[-1])


def stacked_places(rows: ContactRows) -> Array:
    """Return the placements, shape (..., c, 3, 4)."""
    at = [T.matrix()[..., None, :3, :] for T in rows.placement]
    return np.concatenate([np.zeros((*rows.J.shape[:-2], 0, 3, 4), rows.J.dtype), *at], axis=-3)


def white_inverse(model: Model, q: Array, damping: Array) -> tuple[Array, list[Any]]:
    """Return F with Fᵀ F = (M + damping)⁻¹, and what is to be watched: D^−½ L⁻ᵀ of M = LᵀDL, which has M's zeros."""
    M = crba(model, q)
    M = M + damping[..., None] * np.eye(model.nv, dtype=M.dtype)
    if q.dtype != object:
        return cholesky_factors(model, M)[1], []
    tree = tree_terms(model, q)
    inboard = inboard_dofs(tree)
    L, D = factorize(M, inboard)
    F = solve_inward(L, inboard, np.eye(model.nv, dtype=object)) / sqrt(D)[..., None]
    return F, [*pivots(model, tree, [np.diag(1 / D[s]) for s in model.v_slice], DOUBLE)]
