"""Whether a matrix is a rotation, and the rotation nearest to one that has lost digits (section 49.2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, judged, tolerance
from ..errors import ShapeError
from ._elementary import at_first_index, largest

__all__ = ["check_rotation", "nearest_rotation"]

NEAR = 0.1
"""How far RᵀR may be off 1 for Newton's iteration to be started: it converges below 1, to the nearest rotation."""


def nearest_rotation(R: ArrayLike) -> Array:
    """Rotation nearest to a matrix that is a rotation but for rounding (section 49.2).

    Newton's step R ← R (3 − RᵀR)/2 doubles the number of digits to which RᵀR is 1; it is repeated as long as it
    halves what is off. The limit is the orthogonal factor of the polar decomposition, which of all rotations
    has the least sum of squared differences from R.

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)
        A rotation that has lost digits: rounded for printing, or widened from float32. RᵀR may be off 1 by 0.1.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Orthonormal to the resolution of its dtype, which is that of `R`.

    Raises
    ------
    ShapeError
        If the last two axes are not 3 by 3, RᵀR is off 1 by more than 0.1, or the matrix is a reflection.

    Examples
    --------
    >>> from twistwrench.spatial.rotation import exp3
    >>> R = exp3([0.3, -0.2, 0.1]).round(7)  # SE3 and log3 reject it
    >>> R = nearest_rotation(R)
    >>> bool(abs(R.T @ R - np.eye(3)).max() < 1e-15)
    True
    """
    R = as_array(R, "R", 3, 3)
    off = largest(_defect(R), 2)
    _refuse(R, ~(off <= NEAR), off, "R: expected a matrix near a rotation")
    while True:
        nearer = R @ (3 * np.eye(3, dtype=R.dtype) - R.mT @ R) / 2
        left = largest(_defect(nearer), 2)
        better = left < off / 2  # rounding can gain an ulp a step for ever
        if not better.any():
            return R.real + 1j * nearer.imag if R.dtype.kind == "c" else R  # the derivative of a complex step, too
        R, off = np.where(better[..., None, None], nearer, R), np.where(better, left, off)


def check_rotation(R: Array, name: str) -> None:
    """Raise ShapeError unless RᵀR = 1 and det R = 1, to the square root of the resolution."""
    off = largest(_defect(R), 2)
    known = ~np.isnan(judged(R)).any((-2, -1))  # a symbol has no value to check
    mend = f"; nearest_rotation({name}) repairs it" if (off <= NEAR).all() and not _reflects(R).any() else ""
    _refuse(R, ~(off <= tolerance(R.dtype)) & known, off, f"{name}: expected a rotation matrix", mend)


def _defect(R: Array) -> Array:
    """Return RᵀR − 1 of the real parts."""
    real = judged(R)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray(real.mT @ real - np.eye(3))


def _reflects(R: Array) -> Array:
    """Return whether det R is negative."""
    with np.errstate(over="ignore", invalid="ignore"):
        x, y, z = np.moveaxis(judged(R), -1, 0)
        return np.asarray((np.cross(x, y) * z).sum(-1) < 0)


def _refuse(R: Array, wrong: Array, off: Array, expected: str, mend: str = "") -> None:
    if wrong.any():
        raise ShapeError(f"{expected}, got |RᵀR − 1| = {off[wrong][0]:.3g}{at_first_index(wrong)}{mend}")
    wrong = _reflects(R)
    if wrong.any():
        raise ShapeError(f"{expected}, got a reflection, det R = −1{at_first_index(wrong)}")
