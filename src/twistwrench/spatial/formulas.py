"""The formulas that the recursions share: arithmetic on columns and matrices, of any kind of number.

Nothing is checked or compared here: + − × ÷ are all that a number must offer. A twist is a column,
shape (..., 6, 1), so that a product reads as in the chapter: ``X @ V``.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from ..arrays import Array
from .cross import force_cross_matrix, motion_cross_matrix
from .rotation import cross_matrix

__all__ = ["bias_wrench", "cross_force", "cross_motion", "inverse", "symmetric"]


def cross_motion(V: Array) -> Array:
    """Return V× = [[ω]×, 0; [v]×, [ω]×], shape (..., 6, 6), of a column V (49.5)."""
    return motion_cross_matrix(V[..., 0])


def cross_force(V: Array) -> Array:
    """Return V×* = −(V×)ᵀ, shape (..., 6, 6), of a column V (49.5)."""
    return force_cross_matrix(V[..., 0])


def bias_wrench(I: Array, V: Array) -> Array:
    """Return V ×* I V, the wrench of a twist that does not change (49.5), without the term v × m v, which is zero.

    With v = 0 it is ω × each half of I (ω, 0); v adds I (0, ω × v), as if the body's origin were accelerated by ω × v.
    In V ×* (I V) as written, v × m v leaves rounding of m v², however slowly the body turns.
    """
    w = cross_matrix(V[..., :3, 0])
    h = I[..., :, :3] @ V[..., :3, :]  # momentum of the turning alone
    turning = np.concatenate([w @ h[..., :3, :], w @ h[..., 3:, :]], axis=-2)
    wrench: Array = turning + I[..., :, 3:] @ (w @ V[..., 3:, :])
    return wrench


def symmetric(A: Array) -> Array:
    """Return A with its upper triangle in place of the lower one, too: rounding alone makes a difference.

    An asymmetry would grow from link to link.
    """
    return A[..., *_upper(A.shape[-1])]


@cache
def _upper(n: int) -> tuple[Array, Array]:
    """Return for each entry of a symmetric matrix the place of it, or of its mirror image, in the upper triangle."""
    k = np.arange(n)
    return np.minimum.outer(k, k), np.maximum.outer(k, k)


def inverse(D: Array) -> Array:
    """Return D⁻¹, shape (..., n, n), by Gauss-Jordan without pivoting, which a positive definite D does not need."""
    n = D.shape[-1]
    D, inverse = D.copy(), np.broadcast_to(np.eye(n, dtype=D.dtype), D.shape).copy()
    for k in range(n):
        pivot = D[..., k, k, None].copy()
        inverse[..., k, :], D[..., k, :] = inverse[..., k, :] / pivot, D[..., k, :] / pivot
        for j in set(range(n)) - {k}:
            factor = D[..., j, k, None].copy()
            inverse[..., j, :] = inverse[..., j, :] - factor * inverse[..., k, :]
            D[..., j, :] = D[..., j, :] - factor * D[..., k, :]
    return inverse
