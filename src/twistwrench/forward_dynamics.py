"""Forward dynamics by the articulated-body algorithm (49.7).

Given the forces at the joints, how does the robot accelerate? The question is answered without the
mass matrix, by asking of each joint which inertia it feels when all joints behind it are free: three
passes, O(N).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import Array, resolution
from .errors import SingularError
from .inertia import cross_force, cross_motion
from .inverse_dynamics import external
from .model import Model
from .tree import Tree, composite_inertias, join, split, walk

__all__ = ["aba"]


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
    q, v, tau, f_ext = model.state(q, v=v, tau=tau, f_ext=external(model, f_ext))
    tree, n = walk(model, q), model.nbodies
    S, X, qd, rotor = tree.S, tree.X, split(model, v), split(model, model.constants(q.dtype).armature)
    tau, IA, felt = split(model, tau), [*tree.I], inertia_felt(model, tree)
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
        D_inv[i] = invert(S[i].mT @ U[i] + _diagonal(rotor[i]), felt[i], model.joint_names[i])
        u[i] = tau[i] - np.matvec(S[i].mT, pA[i])
        Ia = IA[i] - U[i] @ D_inv[i] @ U[i].mT  # what is felt through the joint: Schur complement
        Ia = (Ia + Ia.mT) / 2  # an asymmetry left by rounding would grow from link to link
        pa = pA[i] + np.matvec(Ia, c[i]) + np.matvec(U[i] @ D_inv[i], u[i])
        IA[p] = IA[p] + X[i].mT @ Ia @ X[i]
        pA[p] = pA[p] + np.matvec(X[i].mT, pa)
    for i in tree.outward:  # pass 3: accelerations
        A[i] = np.matvec(X[i], A[tree.parent[i]]) + c[i]
        qdd[i] = np.matvec(D_inv[i], u[i] - np.matvec(U[i].mT, A[i]))
        A[i] = A[i] + np.matvec(S[i], qdd[i])
    return join(qdd)


def inertia_felt(model: Model, tree: Tree) -> list[Array]:
    """Return for each joint the diagonal of Sᵀ I^C S: what it feels when the joints behind are locked.

    It is the diagonal of the mass matrix, and the measure of what a pivot of `aba` has lost. Where
    it is zero nothing behind the joint has inertia.
    """
    rotor = split(model, model.constants(tree.I[0].dtype).armature)
    felt = [((IC @ S) * S).sum(axis=-2) + r for IC, S, r in zip(composite_inertias(tree), tree.S, rotor)]
    massless = [model.joint_names[i] for i in tree.outward if (felt[i].real <= 0).any()]
    if massless:
        raise SingularError(f"no inertia behind joint {', '.join(map(repr, massless))}: q̈ is not determined there")
    return felt


def invert(D: Array, felt: Array, name: str) -> Array:
    """Return D⁻¹, shape (..., n, n), of the inertia that a joint feels when those behind it are free.

    By Gauss-Jordan without pivoting, which a positive definite D does not need, in any number type.
    A pivot that has lost all digits against `felt` is zero: the joint's motion is that of others.
    """
    n = D.shape[-1]
    D, inverse = D.copy(), np.broadcast_to(np.eye(n, dtype=D.dtype), D.shape).copy()
    for k in range(n):
        pivot = D[..., k, k]
        if (pivot.real <= 4 * n * resolution(D.dtype) * felt[..., k].real).any():
            raise SingularError(f"joint {name!r}: with the joints behind it free it feels no inertia here (entry {k})")
        inverse[..., k, :], D[..., k, :] = inverse[..., k, :] / pivot[..., None], D[..., k, :] / pivot[..., None]
        for j in set(range(n)) - {k}:
            factor = D[..., j, k, None].copy()
            inverse[..., j, :] = inverse[..., j, :] - factor * inverse[..., k, :]
            D[..., j, :] = D[..., j, :] - factor * D[..., k, :]
    return inverse


def _diagonal(x: Array) -> Array:
    diagonal: Array = x[..., None] * np.eye(x.shape[-1], dtype=x.dtype)
    return diagonal
