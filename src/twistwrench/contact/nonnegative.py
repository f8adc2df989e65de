"""Nonnegative least squares: the x ≥ 0 with E x nearest to f, and the residual.

C. L. Lawson and R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23: an active-set method that needs nothing
but NumPy. The residual r = f − E x is a certificate: its product with each column of E is not positive, and with f
it is ‖r‖². So no x ≥ 0 is nearer.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array

__all__ = ["nonnegative_least_squares"]

TURNS = 1e-14
"""A column enters if the cosine of its angle with the residual is larger."""


def nonnegative_least_squares(E: Array, f: Array, start: Array | None = None) -> tuple[Array, Array]:
    """Return x ≥ 0, shape (n,), for which E x is nearest to f, and f − E x, shape (m,).

    Columns of any length are treated alike, and one of zeros stays out. It begins with the columns of `start`, bool of
    shape (n,), if these alone have a positive answer: those of a problem nearly alike.
    """
    length = np.sqrt((E * E).sum(axis=0))
    E = E / np.where(length > 0, length, 1)
    x, enters, barred = np.zeros(E.shape[1]), np.zeros(E.shape[1], bool), length == 0
    r, size = f, float(np.sqrt(f @ f))
    if start is not None and start.any():
        guess, _, rank, _ = np.linalg.lstsq(E[:, start], f)
        if rank == start.sum() and (guess > 0).all():
            x[start], enters, r = guess, start.copy(), _left(E[:, start], f)
    for _ in range(3 * (E.shape[1] + 1)):
        left = float(np.sqrt(r @ r))
        gain = np.where(enters | barred, -np.inf, E.mT @ r)
        new = int(gain.argmax()) if len(gain) else 0
        if left <= np.finfo(np.float64).eps * size or not (gain > TURNS * left).any():
            break
        enters[new] = True
        x_new = _step(E, f, x, enters, new)
        if x_new is None:
            enters[new], barred[new] = False, True
            continue
        x, barred = x_new, length == 0
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
