"""The quadratic programme that keeps contact forces within their limits: the least z with A z ≤ b.

Solved by DAQP (Arnström, Bemporad and Axehill, 2022), a dual active-set method: its answers are right to rounding, it
needs nothing but NumPy, and it comes as a wheel for Linux, macOS and Windows.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..checks import Array

__all__ = ["least_breach", "least_within"]

FEASIBLE = 1e-10
"""How far a limit may be overstepped, relative to the size of the numbers in b."""

SOLVED, INFEASIBLE = 1, -1


def least_within(A: Array, b: Array, size: float) -> tuple[Array, Array] | None:
    """Return the z of least norm with A z ≤ b, and which rows it leans on; None if there is no such z.

    `size` is what counts as large among the numbers of b.
    """
    if (b >= -FEASIBLE * size).all():
        return np.zeros(A.shape[1]), np.zeros(len(b), bool)
    n = A.shape[1]
    if n == 0:
        return None
    z, _, flag, info = _solver().solve(np.eye(n), np.zeros(n), np.ascontiguousarray(A), b / size, primal_tol=FEASIBLE)
    if flag == INFEASIBLE:
        return None
    if flag != SOLVED:
        raise RuntimeError(f"the solver of the quadratic programme gave up: flag {flag} of daqp")
    return size * z, info["lam"] > 0


def least_breach(A: Array, b: Array, size: float) -> Array:
    """Return by how much each row of A z ≤ b is broken where the sum of the squares of that is least."""
    m, n = A.shape
    weights = np.concatenate([np.full(n, 1e-4), np.ones(m)])  # of z next to nothing, so that it is free
    both = np.concatenate([A, -np.eye(m)], axis=1) / weights
    x, *_ = _solver().solve(np.eye(n + m), np.zeros(n + m), both, b / size, primal_tol=FEASIBLE)
    return np.asarray(size * np.maximum(x[n:], 0))


def _solver() -> Any:
    try:
        import daqp
    except ModuleNotFoundError:
        raise ModuleNotFoundError(
            'the quadratic programme needs the solver daqp: pip install "twistwrench[qp]"', name="daqp"
        ) from None
    return daqp
