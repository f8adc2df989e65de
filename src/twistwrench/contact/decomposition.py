"""The singular value decomposition of J M⁻¹ Jᵀ, which all of this folder shares.

With M = L Lᵀ and Y = L⁻¹ Jᵀ the matrix J M⁻¹ Jᵀ is YᵀY: Y holds the rows of J in units of kinetic energy, which
weighs a radian and a metre in v by the inertia that they move. Its singular values decide the rank, without squaring
them. Every row of J must be a velocity in m/s; `row_scaling` sees to that.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..algorithms.mimic import MimicModel
from ..algorithms.singular import ROUNDINGS
from ..arrays import Array, convert, resolution
from ..errors import SingularError
from ..model import Model
from ..spatial import SE3
from .types import Contact

__all__ = ["Decomposition", "block_diagonal", "decompose", "point_map", "row_scaling"]


class Decomposition(NamedTuple):
    """Y = L⁻¹ Jᵀ = U diag(s) Vᵀ, of which only the singular values above rounding are inverted."""

    L: Array
    """Lower triangle, shape (..., n, n): M = L Lᵀ."""
    U: Array
    """Shape (..., n, k), k = min(n, m)."""
    s_inv: Array
    """1/s, and 0 where s is zero to rounding, shape (..., k)."""
    V: Array
    """Shape (..., m, k)."""

    @property
    def rank(self) -> Array:
        """How many rows of J are independent."""
        return np.asarray((self.s_inv > 0).sum(axis=-1))

    def respond(self, change: Array) -> tuple[Array, Array]:
        """Return the least x, in units of √(2 × kinetic energy), and the least λ that bring J a nearest to `change`.

        x = Lᵀ a with M a = Jᵀ λ: Gauss's principle of least constraint.
        """
        asked = np.matvec(self.V.mT, change) * self.s_inv
        return np.matvec(self.U, asked), np.matvec(self.V, asked * self.s_inv)

    def within(self, change: Array) -> Array:
        """Return the part of `change` in the range of J: all of it where the rows of J are independent."""
        part: Array = np.matvec(self.V, np.matvec(self.V.mT, change) * (self.s_inv > 0))
        return part

    def unwhiten(self, x: Array) -> Array:
        """Return a of x = Lᵀ a."""
        return np.asarray(np.linalg.solve(self.L.mT, x[..., None])[..., 0])

    def balance(self, b: Array) -> Array:
        """Return the least λ that brings Jᵀ λ nearest to b, in the metric of M."""
        white = np.linalg.solve(self.L, b[..., None])[..., 0]
        least: Array = np.matvec(self.V, np.matvec(self.U.mT, white) * self.s_inv)
        return least

    def size(self, b: Array) -> Array:
        """Return the norm of b in the metric of M, whatever its units."""
        return np.asarray(np.abs(np.linalg.solve(self.L, b[..., None])).max(axis=(-2, -1), initial=0))


def decompose(model: Model | MimicModel, M: Array, J: Array) -> Decomposition:
    """Decompose J M⁻¹ Jᵀ without forming it; M is the mass matrix of all joints of a model, or of the first.

    Rounding in Y comes from J and from the elimination with L, and goes through L⁻¹: a bound for both, entry by entry,
    is ε |L⁻¹| (|L| |Y| + |Jᵀ|). It scales as Y does, whatever the units of v.
    """
    L, L_inv = cholesky_factors(model, M)
    Y = np.linalg.solve(L, J.mT)
    U, s, Vt = np.linalg.svd(Y, full_matrices=False)
    bound = np.abs(L_inv) @ (np.abs(L) @ np.abs(Y) + np.abs(J.mT))
    noise = resolution(np.float64) * np.sqrt((bound**2).sum(axis=(-2, -1)))[..., None]
    kept = s > ROUNDINGS * noise
    return Decomposition(L, U, np.where(kept, 1 / np.where(kept, s, 1), 0), Vt.mT)


def cholesky_factors(model: Model | MimicModel, M: Array) -> tuple[Array, Array]:
    """Return L, M = L Lᵀ, and L⁻¹; M is the mass matrix of all joints of a model, or of the first.

    Raises
    ------
    SingularError
        If M is not positive definite; the message names the joints that move nothing.
    """
    try:
        L: Array = np.linalg.cholesky(M)
        L_inv: Array = np.linalg.inv(L)
    except np.linalg.LinAlgError:
        L = L_inv = np.full_like(M, np.nan)  # which is what a browser's NumPy gives instead of raising
    if not (np.isfinite(L).all() and np.isfinite(L_inv).all()):
        raise SingularError(f"the mass matrix is not positive definite: {_without_inertia(model, M)}")
    return L, L_inv


def _without_inertia(model: Model | MimicModel, M: Array) -> str:
    """Return the message with the joints that move nothing that has inertia."""
    own = np.diagonal(M, axis1=-2, axis2=-1)
    names = [repr(name) for name, s in zip(model.joint_names, model.v_slice) if (own[..., s] <= 0).any()]
    return f"no inertia outboard of joint {', '.join(names)}" if names else "some joints have none when moved together"


def row_scaling(contacts: Sequence[Contact], at: Sequence[SE3]) -> Array:
    """Return W, shape (..., m, m), for which W J v is in m/s: a turn counts as it moves the points of its contact.

    λ = Wᵀ μ; the least μ stands for the least forces at the points, since WᵀW = G Gᵀ for the contact's `grasp_map` G.
    The row of a coupling stays as it is: there 1 rad/s counts as 1 m/s.
    """
    return block_diagonal(
        [c.row_rotation(T.rotation) @ convert(c.grasp_cholesky, T.rotation.dtype) for c, T in zip(contacts, at)]
    ).mT


def point_map(contacts: Sequence[Contact], at: Sequence[SE3]) -> Array:
    """Return P, shape (..., m, 3 k): λ = P f of the forces f at all points, each in its contact's axes."""
    return block_diagonal([c.row_rotation(T.rotation) @ c.grasp_map for c, T in zip(contacts, at)])


def block_diagonal(blocks: Sequence[Array]) -> Array:
    """Return matrices one after the other along the diagonal of one, shape (..., rows, columns)."""
    batch = blocks[0].shape[:-2] if blocks else ()
    shape = (*batch, sum(B.shape[-2] for B in blocks), sum(B.shape[-1] for B in blocks))
    whole = np.zeros(shape, blocks[0].dtype if blocks else float)
    row = column = 0
    for B in blocks:
        below, right = row + B.shape[-2], column + B.shape[-1]
        whole[..., row:below, column:right] = B
        row, column = below, right
    return whole
