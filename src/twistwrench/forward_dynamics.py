"""Forward dynamics by the articulated-body algorithm (49.7).

Given the forces at the joints, how does the robot accelerate? The question is answered without the
mass matrix, by asking of each joint which inertia it feels when all joints behind it are free: three
passes, O(N).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ._scalars import which
from .checks import Array, resolution
from .door import state_of
from .errors import SingularError
from .inertia import cross_force, cross_motion
from .model import Model
from .tree import Tree, composite_inertias, join, split, walk

__all__ = ["aba"]

ROUNDINGS = 100
"""An inertia of fewer times the rounding in it counts as none."""


def aba(model: Model, q: ArrayLike, v: ArrayLike, tau: ArrayLike, f_ext: ArrayLike | None = None) -> Array:
    """Return the acceleration under given joint forces: q̈ = M⁻¹ (τ − h + Σ Jᵢᵀ f_ext[i]).

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
        Configuration.
    v, tau : array_like, shape (..., nv)
        Velocity; joint forces in N m or N, of which the first six of a floating base are a wrench
        (τ, f) on it from outside, in its frame.
    f_ext : array_like, shape (..., nbodies, 6), optional
        Wrench (τ, f) on each body, in its frame; row 0, the world's, must be zero.

    Returns
    -------
    ndarray, shape (..., nv)
        rad/s² or m/s²; of a floating base the rate of its body twist (ω, v).

    Raises
    ------
    SingularError
        If a joint moves nothing that has inertia: q̈ is not determined. Names the joints.
    ShapeError, ValueError
        As `rnea`.

    See Also
    --------
    twistwrench.rnea : the inverse.

    Notes
    -----
    Section 49.7; Featherstone, RBDA table 7.1. As in `rnea`, wrenches and inertias go inward by
    X[i]ᵀ, where the chapter's pseudocode writes X*.

    Examples
    --------
    A Go2 without torques falls freely:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest = np.zeros(model.nv)
    >>> tw.aba(model, model.standing(), rest, rest)[:6].round(12) + 0.0
    array([ 0.  ,  0.  ,  0.  ,  0.  ,  0.  , -9.81])
    """
    q, v, tau, f_ext = state_of(model, q, v=v, tau=tau, f_ext=f_ext)
    tree, n = walk(model, q), model.nbodies
    S, X, qd, rotor = tree.S, tree.X, split(model, v), split(model, model.constants(q.dtype).armature)
    refuse_weightless(model, tree)
    tau, IA, doubt = split(model, tau), [*tree.I], [rounding(I) for I in tree.I]
    V, A, c, pA, U, D_inv, u, qdd = ([np.zeros(6, q.dtype)] * n for _ in range(8))

    A[0], qdd[0] = -model.constants(q.dtype).gravity, q[..., :0]  # the world rises
    for i in tree.outward:  # pass 1: twists, and what depends on them alone
        vJ = np.matvec(S[i], qd[i])
        V[i] = np.matvec(X[i], V[tree.parent[i]]) + vJ
        c[i] = np.matvec(cross_motion(V[i]), vJ)  # bias acceleration
        pA[i] = np.matvec(cross_force(V[i]), np.matvec(IA[i], V[i])) - f_ext[..., i, :]  # bias wrench
    for i in tree.inward:  # pass 2: articulated inertia IA and bias wrench pA
        p = tree.parent[i]
        U[i] = IA[i] @ S[i]
        D = S[i].mT @ U[i] + _diagonal(rotor[i])
        D_inv[i] = invert(D, S[i].mT @ doubt[i] @ S[i], model.joint_names[i])
        u[i] = tau[i] - np.matvec(S[i].mT, pA[i])
        given = U[i] @ D_inv[i] @ U[i].mT  # what the joint gives way
        Ia = IA[i] - given  # what is felt through the joint: Schur complement
        Ia = (Ia + Ia.mT) / 2  # an asymmetry left by rounding would grow from link to link
        pa = pA[i] + np.matvec(Ia, c[i]) + np.matvec(U[i] @ D_inv[i], u[i])
        IA[p] = IA[p] + X[i].mT @ Ia @ X[i]
        doubt[p] = doubt[p] + passed_on(doubt[i], X[i] - S[i] @ D_inv[i] @ U[i].mT @ X[i], X[i], IA[i], given)
        pA[p] = pA[p] + np.matvec(X[i].mT, pa)
    for i in tree.outward:  # pass 3: accelerations
        A[i] = np.matvec(X[i], A[tree.parent[i]]) + c[i]
        qdd[i] = np.matvec(D_inv[i], u[i] - np.matvec(U[i].mT, A[i]))
        A[i] = A[i] + np.matvec(S[i], qdd[i])
    return join(qdd)


def refuse_weightless(model: Model, tree: Tree) -> None:
    """Raise SingularError with the names of all joints behind which nothing has inertia."""
    rotor = split(model, model.constants(tree.I[0].dtype).armature)
    felt = [((IC @ S) * S).sum(axis=-2) + r for IC, S, r in zip(composite_inertias(tree), tree.S, rotor)]
    names = [model.joint_names[i] for i in tree.outward if (felt[i].real <= 0).any()]
    if names:
        raise SingularError(f"no inertia behind joint {', '.join(map(repr, names))}: q̈ is not determined there")


def rounding(*terms: Array) -> Array:
    """Return how far rounding may move a sum of inertias, in units of the number type's resolution.

    A diagonal matrix, by which every motion's inertia is bounded: an entry (i, j) of a positive
    semidefinite term is no larger than the mean of the entries (i, i) and (j, j).
    """
    size: Array = sum(np.abs(np.diagonal(term.real, axis1=-2, axis2=-1)) for term in terms)
    return _diagonal(size)


def passed_on(doubt: Array, moved: Array, X: Array, IA: Array, given: Array) -> Array:
    """Return how far rounding may have moved Xᵀ (IA − given) X, in units of the resolution.

    What moved IA goes inward with it: `moved` takes the parent's motion to what is left of it behind
    the free joint, 1 − S D⁻¹ Uᵀ after X. To that comes the rounding of the terms of the sum here.
    """
    X = np.abs(X.real)
    here = X.mT @ (np.abs(IA.real) + np.abs(given.real)) @ X
    inward: Array = moved.real.mT @ doubt @ moved.real + rounding(here)
    return inward


def invert(D: Array, doubt: Array, name: str) -> Array:
    """Return D⁻¹, shape (..., n, n), of the inertia that a joint feels when those behind it are free.

    Where a motion of the joint feels no more than a hundred times what rounding may have moved D by,
    it feels nothing that could be told from zero: it is one of the motions of the joints behind.
    By Gauss-Jordan without pivoting, which a positive definite D does not need, in any number type.
    """
    n = D.shape[-1]
    size = np.abs(np.diagonal(D.real, axis1=-2, axis2=-1)) + np.diagonal(doubt.real, axis1=-2, axis2=-1)
    unit = np.sqrt(np.where(size == 0, 1, size))
    scaled = (D.real / unit[..., :, None] / unit[..., None, :]).astype(np.float64)
    lost = np.asarray((np.linalg.eigvalsh(scaled) < ROUNDINGS * resolution(D.dtype)).any(axis=-1))
    if lost.any():
        raise SingularError(
            f"joint {name!r}: with the joints behind it free it feels no inertia beyond rounding{which(lost)}"
        )
    D, inverse = D.copy(), np.broadcast_to(np.eye(n, dtype=D.dtype), D.shape).copy()
    for k in range(n):
        pivot = D[..., k, k, None].copy()
        inverse[..., k, :], D[..., k, :] = inverse[..., k, :] / pivot, D[..., k, :] / pivot
        for j in set(range(n)) - {k}:
            factor = D[..., j, k, None].copy()
            inverse[..., j, :] = inverse[..., j, :] - factor * inverse[..., k, :]
            D[..., j, :] = D[..., j, :] - factor * D[..., k, :]
    return inverse


def _diagonal(x: Array) -> Array:
    diagonal: Array = x[..., None] * np.eye(x.shape[-1], dtype=x.dtype)
    return diagonal
