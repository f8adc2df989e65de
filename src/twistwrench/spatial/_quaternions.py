"""Quaternions where a rotation matrix would be a detour: steps and their sums, and rotations as fractions (49.2)."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from ..arrays import Array, convert
from ._elementary import cos, length, sinc
from .rotation import cross_matrix, quaternion_matrix, rotation_to_quaternion, skew_part

__all__ = ["exact_rotation", "exp_quaternion", "quaternion_product"]


def exp_quaternion(w: Array) -> Array:
    """Return the quaternion of exp3(w): (w sin ½θ / θ, cos ½θ)."""
    theta = length(w)[..., None]
    return np.concatenate([sinc(theta / 2) / 2 * w, cos(theta / 2)], axis=-1)


def quaternion_product(p: Array, q: Array) -> Array:
    """Return the quaternion of both turns, (p₀ u + q₀ w + w × u, p₀ q₀ − w·u) of p = (w, p₀) and q = (u, q₀)."""
    w = p[..., :3]
    u = q[..., :3]
    p0 = p[..., 3:]
    q0 = q[..., 3:]
    turned = p0 * u + q0 * w + np.matvec(cross_matrix(w), u)
    return np.concatenate([turned, p0 * q0 - (w * u).sum(-1, keepdims=True)], axis=-1)


def exact_rotation(R: Array) -> Array:
    """Return an exact rotation of fractions, within 1e-50 of the one that is nearest to this R of floats, shape (3, 3).

    Newton's iteration R ← R (3 − RᵀR)/2 leads to the nearest one; 4 u uᵀ of its quaternion u is linear in R (49.2), and
    of any quaternion, whatever its length, `quaternion_matrix` is a rotation exactly.
    """
    whole = R.round()
    if np.abs(R - whole).max() < 1e-15:  # along the axes
        return convert(whole, object)
    near = convert(R, object)
    one = convert(np.eye(3), object)
    for _ in range(2):
        near = near @ (3 * one - near.mT @ near) / 2
        near = np.array([[Fraction(round(x * 2**220), 2**220) for x in row] for row in near], object)
    square = near.trace() * np.eye(3, dtype=int)
    symmetric = near + near.mT + one - square
    skewed = skew_part(2 * near)
    u = convert(rotation_to_quaternion(R), object)
    return quaternion_matrix(
        np.array([*(symmetric @ u[:3] + skewed * u[3]), skewed @ u[:3] + (1 + near.trace()) * u[3]])
    )
