"""The quadratic programme that keeps contact forces within their limits: the least z with A z ≤ b.

Solved by DAQP (Arnström, Bemporad and Axehill, 2022), a dual active-set method, where it is installed: its answers are
right to rounding, and it is quick. Every answer is checked: where it gives none, or one that is outside the limits,
and where it is not installed, the same programme is solved as nonnegative least squares (Lawson and Hanson, 1974,
chapter 23.4).
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array
from .nonnegative import nonnegative_least_squares

__all__ = ["FEASIBLE", "least_breach", "least_with_multipliers", "least_within"]

FEASIBLE = 1e-10
"""How far a limit may be overstepped, relative to the size of the numbers in b."""

SOLVED = 1
NEWTON_STEPS = 50


def least_within(A: Array, b: Array, size: float) -> tuple[Array, Array] | None:
    """Return the z of least norm with A z ≤ b, and its active rows; None if no z was found.

    `size` is the scale of the numbers of b.
    """
    found = least_with_multipliers(A, b, size)
    return None if found is None else (found[0], found[1] > 0)


def least_with_multipliers(A: Array, b: Array, size: float) -> tuple[Array, Array] | None:
    """Return the z of least norm with A z ≤ b, and the multipliers u ≥ 0 of the rows, z = −Aᵀ u; None if none is found.

    `size` is the scale of the numbers of b.
    """
    if (b >= -FEASIBLE * size).all():
        return np.zeros(A.shape[1]), np.zeros(len(b))
    if A.shape[1] == 0:
        return None
    for method in (_by_daqp, _by_least_squares):
        z, u = method(A, b / size)
        if np.isfinite(z).all() and (A @ z - b / size).max() <= 2 * FEASIBLE:
            return size * z, size * u
    return None


def _by_daqp(A: Array, b: Array) -> tuple[Array, Array]:
    """Return z and the multipliers, by DAQP; NaN where it finds no solution, or is not installed."""
    n, nothing = A.shape[1], (np.full(A.shape[1], np.nan), np.zeros(len(b)))
    try:
        import daqp
    except ModuleNotFoundError:
        return nothing
    z, _, flag, info = daqp.solve(np.eye(n), np.zeros(n), np.ascontiguousarray(A), b, primal_tol=FEASIBLE)
    return (z, np.maximum(info["lam"], 0)) if flag == SOLVED else nothing


def _by_least_squares(A: Array, b: Array) -> tuple[Array, Array]:
    """Return z and the multipliers: of r in Aᵀ u + r₁ = 0, bᵀ u + r₂ = 1 with u ≥ 0, z is r₁ over −r₂."""
    E = np.concatenate([-A.mT, -b[None]])
    u, r = nonnegative_least_squares(E, np.concatenate([np.zeros(len(E) - 1), [1.0]]))
    leans = u > 0
    if not r[-1] > 0 or not leans.any():
        return np.full(len(E) - 1, np.nan), u
    return np.linalg.lstsq(A[leans], b[leans])[0], u / r[-1]  # active rows are met to rounding


def least_breach(A: Array, b: Array, size: float) -> Array:
    """Return the violations of A z ≤ b, row by row, with the least sum of squares.

    Newton's method for a function that is quadratic in pieces, with its step halved until it goes down; z itself has a
    tiny weight, so that the minimum is unique.
    """
    b, z, free = b / size, np.zeros(A.shape[1]), 1e-4 * np.eye(A.shape[1])

    def total(z: Array) -> float:
        return float((np.maximum(A @ z - b, 0) ** 2).sum() + 1e-8 * z @ z)

    for _ in range(NEWTON_STEPS):
        over, share = A @ z - b > 0, 1.0
        goal = np.linalg.lstsq(np.concatenate([A[over], free]), np.concatenate([b[over], np.zeros(len(z))]))[0]
        while share > 1e-3 and total(z + share * (goal - z)) >= total(z):
            share /= 2
        if share <= 1e-3:
            break
        z = z + share * (goal - z)
    return np.asarray(size * np.maximum(A @ z - b, 0))
