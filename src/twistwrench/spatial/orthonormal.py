"""Whether a matrix is a rotation, and the rotation nearest to one that has lost digits (section 49.2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, comparable, resolution, tolerance
from ..errors import ShapeError
from ._elementary import at_first_index, largest

__all__ = ["check_rotation", "nearest_rotation"]

MAX_GRAM_ERROR = 0.1
"""How far RᵀR may be off 1 for the iteration without an inverse: it converges below 1, to the nearest rotation."""


def nearest_rotation(R: ArrayLike) -> Array:
    """Rotation nearest to a matrix with a positive determinant (section 49.2).

    Of all rotations it has the least sum of squared differences from R: the orthogonal factor of the polar
    decomposition. Far from a rotation Newton's step R ← (γ R + R⁻ᵀ/γ)/2 leads towards it, where γ makes both terms
    equally large. Near one R ← R (3 − RᵀR)/2 doubles the number of digits to which RᵀR is 1; it is repeated as long as
    it halves what is off.

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)
        A rotation that has lost digits, was scaled, or was measured.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Orthonormal to the resolution of its dtype, which is that of `R`.

    Raises
    ------
    ShapeError
        If the last two axes are not 3 by 3.
    ValueError
        If the determinant is negative, or zero to rounding.

    Examples
    --------
    >>> from twistwrench.spatial.rotation import exp3
    >>> given = exp3([0.3, -0.2, 0.1]).round(7)  # SE3 and log3 reject it
    >>> R = nearest_rotation(given)
    >>> bool(abs(R.T @ R - np.eye(3)).max() < 1e-15)
    True
    >>> np.linalg.norm(R - given) < 1e-7  # how far away it was
    np.True_
    """
    R = _near_rotation(as_array(R, "R", 3, 3))
    off = largest(_defect(R), 2)
    while True:
        nearer = R @ (3 * np.eye(3, dtype=R.dtype) - R.mT @ R) / 2
        left = largest(_defect(nearer), 2)
        better = left < off / 2  # rounding can gain an ulp a step for ever
        if not better.any():
            return R.real + 1j * nearer.imag if R.dtype.kind == "c" else R  # the derivative of a complex step, too
        R = np.where(better[..., None, None], nearer, R)
        off = np.where(better, left, off)


def _near_rotation(R: Array) -> Array:
    """Return matrices of the same nearest rotations, with RᵀR within `MAX_GRAM_ERROR` of 1; near ones stay."""
    far = ~(largest(_defect(R), 2) <= MAX_GRAM_ERROR)
    size = largest(R.real, 2)
    R = np.where(far[..., None, None], R / np.where(size == 0, 1, size)[..., None, None], R)  # nothing overflows
    det = (R[..., 0, :] * _cofactors(R)[..., 0, :]).sum(-1).real
    rows = np.sqrt((R.real**2).sum(-1)).prod(-1)
    least = 8 * resolution(R.dtype) * rows  # below which rounding may have made all of it
    wrong = np.asarray(det <= least)
    if wrong.any():
        got = "a negative one: it reflects" if (det < -least)[wrong][0] else "zero"
        raise ValueError(f"R: expected a matrix with a positive determinant, got {got}{at_first_index(wrong)}")
    while far.any():
        C = _cofactors(R)
        inverse = C / (R[..., :1, :] * C[..., :1, :]).sum(-1, keepdims=True)  # R⁻ᵀ
        ratio = np.sqrt((inverse.real**2).sum((-2, -1)) / (R.real**2).sum((-2, -1)))
        g = np.sqrt(ratio)[..., None, None]
        R = np.where(far[..., None, None], (g * R + inverse / g) / 2, R)
        far = ~(largest(_defect(R), 2) <= MAX_GRAM_ERROR)
    return R


def _cofactors(R: Array) -> Array:
    """Return det R · R⁻ᵀ, whose rows are the cross products of the other two rows."""
    a, b, c = np.moveaxis(R, -2, 0)
    return np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=-2)


def check_rotation(R: Array, name: str) -> None:
    """Raise ShapeError unless RᵀR = 1 and det R = 1, to the square root of the resolution."""
    off = largest(_defect(R), 2)
    known = ~np.isnan(comparable(R)).any((-2, -1))  # a symbol has no value to check
    mend = f"; nearest_rotation({name}) repairs it" if (off <= MAX_GRAM_ERROR).all() and not _reflects(R).any() else ""
    _refuse(R, ~(off <= tolerance(R.dtype)) & known, off, f"{name}: expected a rotation matrix", mend)


def _defect(R: Array) -> Array:
    """Return RᵀR − 1 of the real parts."""
    real = comparable(R)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray(real.mT @ real - np.eye(3))


def _reflects(R: Array) -> Array:
    """Return whether det R is negative."""
    with np.errstate(over="ignore", invalid="ignore"):
        x, y, z = np.moveaxis(comparable(R), -1, 0)
        return np.asarray((np.cross(x, y) * z).sum(-1) < 0)


def _refuse(R: Array, wrong: Array, off: Array, expected: str, mend: str = "") -> None:
    if wrong.any():
        raise ShapeError(f"{expected}, got |RᵀR − 1| = {off[wrong][0]:.3g}{at_first_index(wrong)}{mend}")
    wrong = _reflects(R)
    if wrong.any():
        raise ShapeError(f"{expected}, got a reflection, det R = −1{at_first_index(wrong)}")
