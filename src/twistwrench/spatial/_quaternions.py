"""Quaternions where a rotation matrix would be a detour: steps, sums and differences, exact rotations (49.2)."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from ..arrays import Array, convert
from ._elementary import chosen, cos, length, sinc
from .rotation import cross_matrix, quaternion_matrix, rotation_to_quaternion, rotation_vector, skew_part

__all__ = ["exact_rotation", "exp_quaternion", "quaternion_product", "turn_between"]


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


def turn_between(p: Array, q: Array) -> Array:
    """Return the rotation vector that leads from one quaternion to another, log3 of p⁻¹ q: a turn of at most π.

    Of q and −q, the same turn, the one closer to p counts. With d = q − p the vector part is that of p⁻¹ d, since p⁻¹ p
    has none: so a small turn keeps all digits that p and q have of it. Of half a turn, where both signs of the axis are
    right, the largest component is positive, as in `log3`.
    """
    cosine = (p * q).sum(-1, keepdims=True)
    d = chosen(-cosine, -q, q) - p
    xyz = p[..., 3:] * d[..., :3] - d[..., 3:] * p[..., :3] - np.matvec(cross_matrix(p[..., :3]), d[..., :3])
    w = chosen(-cosine, -cosine, cosine)
    x, y, z = xyz[..., :1], xyz[..., 1:2], xyz[..., 2:]
    most = chosen(y * y - x * x, y, x)
    most = chosen(z * z - most * most, z, most)
    return rotation_vector(chosen(w, xyz, chosen(-most, -xyz, xyz)), w)


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
