"""Vectors whose components come first: x[0], x[1], x[2] are whole arrays over links and states.

A sum or product of two such arrays runs over memory from end to end. `np.einsum` adds products without writing
them down in between and follows the same order; it was the faster of the two wherever a sum has three terms.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array

__all__ = [
    "CYCLE",
    "SYMMETRIC",
    "cross",
    "dot",
    "matrix_product",
    "rotation",
    "symmetric_times",
    "times",
    "transposed_times",
    "unfold",
]

CYCLE = ((0, 1, 2), (1, 2, 0), (2, 0, 1))

SYMMETRIC = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
"""Which entries of a symmetric 3 × 3 matrix are kept, and in which order: xx, yy, zz, yz, xz, xy."""


def cross(a: Array, b: Array) -> Array:
    """Return a × b."""
    (ax, ay, az), (bx, by, bz) = a, b
    x = ay * bz
    out = np.empty((3, *x.shape), x.dtype)
    np.subtract(x, az * by, out=out[0])
    np.subtract(az * bx, ax * bz, out=out[1])
    np.subtract(ax * by, ay * bx, out=out[2])
    return out


def dot(a: Array, b: Array) -> Array:
    """Return aᵀ b."""
    out: Array = np.einsum("i...,i...->...", a, b)
    return out


def times(A: Array, x: Array) -> Array:
    """Return A x for matrices A, shape (3, 3, ...)."""
    out: Array = np.einsum("ij...,j...->i...", A, x)
    return out


def transposed_times(A: Array, x: Array) -> Array:
    """Return Aᵀ x for matrices A, shape (3, 3, ...)."""
    out: Array = np.einsum("ji...,j...->i...", A, x)
    return out


def matrix_product(A: Array, B: Array) -> Array:
    """Return A B for matrices A, shape (3, 3, ...), and B, shape (3, k, ...)."""
    out: Array = np.einsum("ij...,jk...->ik...", A, B)
    return out


def symmetric_times(S: Array, x: Array) -> Array:
    """Return S x for symmetric matrices of which six entries are kept."""
    xx, yy, zz, yz, xz, xy = S
    a, b, c = x
    first = xx * a
    out = np.empty((3, *first.shape), first.dtype)
    np.add(first + xy * b, xz * c, out=out[0])
    np.add(xy * a + yy * b, yz * c, out=out[1])
    np.add(xz * a + yz * b, zz * c, out=out[2])
    return out


def unfold(S: Array) -> Array:
    """Return symmetric matrices, shape (3, 3, ...), from their six entries."""
    return S[[0, 5, 4, 5, 1, 3, 4, 3, 2]].reshape(3, 3, *S.shape[1:])


def _rotation_from_products() -> Array:
    """Return the matrix from the products of a unit quaternion's entries to its rotation."""
    out = np.zeros((3, 3, 4, 4))
    for i, j, k in CYCLE:
        out[i, i, [3, i, j, k], [3, i, j, k]] = 1, 1, -1, -1
        out[i, j, i, j] = out[j, i, i, j] = 2
        out[i, j, k, 3], out[j, i, k, 3] = -2, 2
    return out.reshape(9, 16)


ROTATION = _rotation_from_products()


def rotation(quaternion: Array) -> Array:
    """Return the rotation, shape (3, 3, ...), of a quaternion (x, y, z, w), shape (4, ...), of any length."""
    products = (quaternion[:, None] * quaternion).reshape(16, -1)
    R: Array = np.matmul(ROTATION.astype(products.real.dtype), products).reshape(3, 3, *quaternion.shape[1:])
    R /= dot(quaternion, quaternion)
    return R
