"""The exact values: those that `newton_euler_3d` does not give directly in the shape that is compared (49.1).

All functions take one state, of mpmath numbers or of floats.
"""

from __future__ import annotations

import numpy as np

from .. import newton_euler_3d as ne
from ..arrays import Array
from ..errors import SingularError
from ..model import Model
from ..newton_euler_3d.bodies import cross
from .states import States

__all__ = ["action", "contact_jacobian", "dual_action", "frame_placements", "homogeneous", "static_equilibrium"]


def homogeneous(R: Array, p: Array) -> Array:
    """Return 4 × 4 matrices of placements, shape (..., 4, 4)."""
    T = np.zeros((*p.shape[:-1], 4, 4), p.dtype)
    T[..., :3, :3], T[..., :3, 3], T[..., 3, 3] = R, p, 1
    return T


def action(R: Array, p: Array) -> Array:
    """Return X = [R 0; p×R R] of placements, shape (n, 6, 6)."""
    zero = np.zeros_like(R)
    return np.block([[R, zero], [_cross_columns(p, R), R]])


def dual_action(R: Array, p: Array) -> Array:
    """Return X* = [R p×R; 0 R] of placements, shape (n, 6, 6)."""
    zero = np.zeros_like(R)
    return np.block([[R, _cross_columns(p, R)], [zero, R]])


def _cross_columns(p: Array, R: Array) -> Array:
    return np.stack([cross(pi[:, None], Ri) for pi, Ri in zip(p, R, strict=True)])


def frame_placements(model: Model, s: States) -> Array:
    """Return the placements of the frames, shape (frames, 4, 4)."""
    return np.stack([homogeneous(*ne.frame_placement(model, s.q, name)) for name in s.frames])


def contact_jacobian(model: Model, s: States) -> Array:
    """Return the linear rows at the feet, shape (3 k, nv)."""
    J = [ne.frame_jacobian(model, s.q, foot, "local_world_aligned")[3:] for foot in model.feet]
    return np.concatenate(J)


def static_equilibrium(model: Model, s: States) -> Array:
    """Return (tau, contact forces): of all forces that carry the base rows of g the least; shape (n + 3 k,).

    Raises
    ------
    SingularError
        If these contacts cannot carry every weight: two points cannot stop a turn about their line.
    """
    J, g = contact_jacobian(model, s), ne.gravity(model, s.q)
    B = J[:, :6].mT
    carried = J[:, 6:].mT
    if np.linalg.matrix_rank(B.astype(float)) < 6:
        raise SingularError(f"{len(model.feet)} point contacts cannot hold the base of {model.name!r}")
    forces = B.mT @ _solve(B @ B.mT, g[:6])
    return np.concatenate([g[6:] - carried @ forces, forces])


def _solve(A: Array, b: Array) -> Array:
    """Solve A x = b for a symmetric positive definite A of any kind of number, by elimination."""
    A, x = A.copy(), b.copy()
    n = len(x)
    for k in range(n):
        for i in range(k + 1, n):
            factor = A[i, k] / A[k, k]
            A[i] = A[i] - factor * A[k]
            x[i] = x[i] - factor * x[k]
    for k in reversed(range(n)):
        x[k] = (x[k] - A[k, k + 1 :] @ x[k + 1 :]) / A[k, k] if k < n - 1 else x[k] / A[k, k]
    return x
