"""The quadratic programme that keeps contact forces within their limits: the least z with A z ≤ b.

Solved by DAQP (Arnström, Bemporad and Axehill, 2022), a dual active-set method, where it is installed: its answers are
right to rounding, and it is quick. Every answer is checked: where it gives none, or one that is outside the limits,
and where it is not installed, the same programme is solved as nonnegative least squares.

Nonnegative least squares are the x ≥ 0 with E x nearest to f: C. L. Lawson and R. J. Hanson, Solving Least Squares
Problems, 1974, chapter 23, an active-set method that needs nothing but NumPy; 23.4 makes a quadratic programme of it.
The residual r = f − E x is a certificate: its product with each column of E is not positive, and with f it is ‖r‖². So
no x ≥ 0 is nearer.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array

__all__ = ["LIMIT_RTOL", "least_breach", "least_with_multipliers", "least_within", "nonnegative_least_squares"]

LIMIT_RTOL = 1e-10
"""How far a limit may be overstepped, relative to the size of the numbers in b."""

DAQP_SOLVED = 1
NEWTON_STEPS = 50

MIN_COSINE = 1e-14
"""A column enters if the cosine of its angle with the residual is larger."""


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
    if (b >= -LIMIT_RTOL * size).all():
        return np.zeros(A.shape[1]), np.zeros(len(b))
    if A.shape[1] == 0:
        return None
    for method in (_by_daqp, _by_least_squares):
        z, u = method(A, b / size)
        if np.isfinite(z).all() and (A @ z - b / size).max() <= 2 * LIMIT_RTOL:
            return size * z, size * u
    return None


def _by_daqp(A: Array, b: Array) -> tuple[Array, Array]:
    """Return z and the multipliers, by DAQP; NaN where it finds no solution, or is not installed."""
    n = A.shape[1]
    nothing = (np.full(A.shape[1], np.nan), np.zeros(len(b)))
    try:
        import daqp
    except ModuleNotFoundError:
        return nothing
    z, _, flag, info = daqp.solve(np.eye(n), np.zeros(n), np.ascontiguousarray(A), b, primal_tol=LIMIT_RTOL)
    return (z, np.maximum(info["lam"], 0)) if flag == DAQP_SOLVED else nothing


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
    b = b / size
    z = np.zeros(A.shape[1])
    free = 1e-4 * np.eye(A.shape[1])

    def total(z: Array) -> float:
        return float((np.maximum(A @ z - b, 0) ** 2).sum() + 1e-8 * z @ z)

    for _ in range(NEWTON_STEPS):
        over = A @ z - b > 0
        share = 1.0
        goal = np.linalg.lstsq(np.concatenate([A[over], free]), np.concatenate([b[over], np.zeros(len(z))]))[0]
        while share > 1e-3 and total(z + share * (goal - z)) >= total(z):
            share /= 2
        if share <= 1e-3:
            break
        z = z + share * (goal - z)
    return np.asarray(size * np.maximum(A @ z - b, 0))


def nonnegative_least_squares(E: Array, f: Array, start: Array | None = None) -> tuple[Array, Array]:
    """Return x ≥ 0, shape (n,), for which E x is nearest to f, and f − E x, shape (m,).

    Columns of any length are treated alike, and one of zeros stays out. It begins with the columns of `start`, bool of
    shape (n,), if these alone have a positive answer: those of a problem nearly alike.
    """
    length = np.sqrt((E * E).sum(axis=0))
    E = E / np.where(length > 0, length, 1)
    x = np.zeros(E.shape[1])
    enters = np.zeros(E.shape[1], bool)
    barred = length == 0
    r = f
    size = float(np.sqrt(f @ f))
    if start is not None and start.any():
        guess, _, rank, _ = np.linalg.lstsq(E[:, start], f)
        if rank == start.sum() and (guess > 0).all():
            x[start], enters, r = guess, start.copy(), _left(E[:, start], f)
    for _ in range(3 * (E.shape[1] + 1)):
        left = float(np.sqrt(r @ r))
        gain = np.where(enters | barred, -np.inf, E.mT @ r)
        new = int(gain.argmax()) if len(gain) else 0
        if left <= np.finfo(np.float64).eps * size or not (gain > MIN_COSINE * left).any():
            break
        enters[new] = True
        x_new = _step(E, f, x, enters, new)
        if x_new is None:
            enters[new], barred[new] = False, True
            continue
        x = x_new
        barred = length == 0
        enters = x > 0
        r = _left(E[:, enters], f)
    return x / np.where(length > 0, length, 1), r


def _step(E: Array, f: Array, x: Array, enters: Array, new: int) -> Array | None:
    """Return the least squares of the columns that enter, without those that would become negative on the way.

    None if the new column depends on the others, or does not become positive: it entered by rounding only.
    """
    enters = enters.copy()
    while True:
        goal = np.zeros(len(x))
        goal[enters], _, rank, _ = np.linalg.lstsq(E[:, enters], f)
        negative = enters & (goal <= 0)
        if rank < enters.sum() or (x[new] == 0 and negative[new]):
            return None
        if not negative.any():
            return goal
        share = x[negative] / (x[negative] - goal[negative])
        x = x + share.min() * (goal - x)
        enters[np.flatnonzero(negative)[share <= share.min()]] = False
        x = np.where(enters, x, 0)


def _left(E: Array, f: Array) -> Array:
    """Return f without its part along the columns of E, orthogonal to them to rounding, however little it is."""
    Q = np.linalg.qr(E)[0]
    r = f - Q @ (Q.mT @ f)
    return np.asarray(r - Q @ (Q.mT @ r))
