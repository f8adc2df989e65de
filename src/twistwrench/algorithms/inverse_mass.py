"""The inverse of the mass matrix, without the mass matrix: the ABA for all unit forces at once (49.7, 49.8)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..model import Model, Tree, check_state, tree_terms
from ..spatial.formulas import symmetric
from .articulated import find_inertias
from .terms import ArticulatedTerms

__all__ = ["inverse_mass_matrix", "unit_force_responses", "unit_forces"]


def unit_force_responses(tree: Tree, terms: ArticulatedTerms) -> Array:
    """Return M⁻¹: column k is the q̈ of a unit force at the degree of freedom k, at rest and without gravity.

    Passes 2 and 3 of the ABA; u[i] and A[i] have a column for each k. Outward the columns from joint i's on are enough,
    since M⁻¹ is symmetric.
    """
    parent, S, X, U, D_inv = tree.parent, tree.S, tree.X, terms.U, terms.D_inv
    end = [int(k) for k in np.cumsum(tree.nv)]
    u, zero = unit_forces(tree, terms), np.zeros((*tree.batch, 6, end[-1]), X[0].dtype)
    A = [zero] * len(parent)
    M_inv = np.zeros((*tree.batch, end[-1], end[-1]), zero.dtype)

    for i in tree.outward:
        p, own, rest = parent[i], slice(end[i - 1], end[i]), slice(end[i - 1], None)
        a = X[i] @ A[p][..., rest]
        qdd = D_inv[i] @ (u[i][..., rest] - U[i].mT @ a)  # 49.8 inverse_outward
        A[i] = np.concatenate([zero[..., : end[i - 1]], a + S[i] @ qdd], axis=-1)
        M_inv[..., own, rest], M_inv[..., rest, own] = qdd, qdd.mT
        M_inv[..., own, own] = symmetric(M_inv[..., own, own])
    return M_inv


def unit_forces(tree: Tree, terms: ArticulatedTerms) -> list[Array]:
    """Return u[i], what is left at joint i of a unit force at each degree of freedom k: pass 2 of the ABA.

    A force at k is passed inboard of k only: pA[i] and u[i] are zero but in the columns of the joints that body i
    carries. M⁻¹ is Σ u[i]ᵀ D[i]⁻¹ u[i] (G. Rodriguez, A. Jain and K. Kreutz-Delgado, 1991).
    """
    parent, S, X, U, D_inv = tree.parent, tree.S, tree.X, terms.U, terms.D_inv
    end = [int(k) for k in np.cumsum(tree.nv)]
    unit, zero = np.eye(end[-1], dtype=X[0].dtype), np.zeros((*tree.batch, 6, end[-1]), X[0].dtype)
    pA, u = [zero] * len(parent), [zero[..., :0, :]] * len(parent)

    for i in tree.inward:
        p = parent[i]
        u[i] = unit[end[i - 1] : end[i]] - S[i].mT @ pA[i]
        pA[p] = pA[p] + X[i].mT @ (pA[i] + U[i] @ D_inv[i] @ u[i])  # 49.8 inverse_inward
    return u


def inverse_mass_matrix(model: Model, q: ArrayLike) -> Array:
    """Return M(q)⁻¹, without M: column k is the acceleration for a unit force at k, at rest and without gravity.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    ndarray, shape (..., nv, nv)
        Symmetric, full: what pushes one leg moves the base, and with it all others.

    Raises
    ------
    SingularError
        If a joint moves no inertia, to rounding. Names the joints.
    ShapeError, ValueError
        As `Model.state`.

    Notes
    -----
    Sections 49.7 and 49.8; J. Carpentier, Analytical inverse of the joint space inertia matrix, 2018 (Pinocchio's
    ``computeMinverse``). As `aba` it keeps the digits where heavy bodies hang on light ones. For one right-hand side
    `aba` or `solve_mass_matrix` is less work. `unit_force_responses` has the loops.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> M = tw.crba(model, model.standing())
    >>> np.allclose(tw.inverse_mass_matrix(model, model.standing()) @ M, np.eye(18), rtol=0, atol=1e-11)
    True
    """
    (q,) = check_state(model, q)
    tree = tree_terms(model, q)
    return unit_force_responses(tree, find_inertias(model, tree))
