"""Forward dynamics by the articulated-body algorithm (49.7).

Given the forces at the joints, how does the robot accelerate? No mass matrix is needed, only the
apparent inertia at each joint while all joints outboard of it are free: three passes, O(N).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, check_overflow
from ..errors import SingularError
from ..model import Model, Tree, check_state, columns, stack_columns, tree_terms, wrenches
from ..spatial.formulas import bias_wrench, cross_motion, inverse, symmetric
from ._mimic import also_of_mimics
from .singular import refuse_singular, refuse_weightless
from .terms import AbaTerms

__all__ = ["aba", "aba_terms", "articulated_body"]


def articulated_body(tree: Tree, qd: list[Array], tau: list[Array], f_ext: list[Array]) -> AbaTerms:
    """Run the ABA, three passes (RBDA table 7.1).

    The index is the frame: V[i] is the twist of body i in frame i. Inertias and wrenches go inward by X[i]ᵀ, the
    book's ^λX_i*, where the chapter writes X*. Beyond the book: the rotors' inertia in D; Ia made symmetric, since an
    asymmetry that rounding leaves would grow from link to link; wrenches f_ext in the bodies' own frames.
    """
    parent, S, I, X, rotor = tree.parent, tree.S, tree.I, tree.X, tree.rotor
    V, c, B, pA, U, D, D_inv, u, Ia, pa, A, qdd = tree.zeros(12)

    IA = [*I]  # 49.7 IA: at first the body's own
    for i in tree.outward:  # pass 1: twists, and what depends on them alone
        vJ = S[i] @ qd[i]
        V[i] = X[i] @ V[parent[i]] + vJ  # 49.7 V: twist
        c[i] = cross_motion(V[i]) @ vJ  # 49.7 c: bias acceleration
        pA[i] = B[i] = bias_wrench(I[i], V[i]) - f_ext[i]  # 49.7 pA: bias wrench
    for i in tree.inward:  # pass 2: articulated-body inertias and their bias wrenches
        p = parent[i]
        U[i] = IA[i] @ S[i]  # 49.7 U
        D[i] = S[i].mT @ U[i] + rotor[i]  # 49.7 D
        D_inv[i] = inverse(D[i])  # 49.7 D_inv
        u[i] = tau[i] - S[i].mT @ pA[i]  # 49.7 u
        Ia[i] = symmetric(IA[i] - U[i] @ D_inv[i] @ U[i].mT)  # 49.7 Ia: Schur complement
        pa[i] = pA[i] + Ia[i] @ c[i] + U[i] @ D_inv[i] @ u[i]  # 49.7 pa
        IA[p] = IA[p] + symmetric(X[i].mT @ Ia[i] @ X[i])  # 49.7 IA_p
        pA[p] = pA[p] + X[i].mT @ pa[i]  # 49.7 pA_p
    A[0] = -tree.gravity  # 49.7 A0: gravity, as a world that rises
    for i in tree.outward:  # pass 3: accelerations
        a = X[i] @ A[parent[i]] + c[i]  # 49.7 a: what the parent brings
        qdd[i] = D_inv[i] @ (u[i] - U[i].mT @ a)  # 49.7 qdd
        A[i] = a + S[i] @ qdd[i]  # 49.7 A
    return AbaTerms.of(  # 49.7 ABA
        tree.batch, V=V, c=c, B=B, IA=IA, pA=pA, U=U, D=D, D_inv=D_inv, u=u, Ia=Ia, pa=pa, A=A, qdd=stack_columns(qdd)
    )


@also_of_mimics
def aba(model: Model, q: ArrayLike, v: ArrayLike, tau: ArrayLike, f_ext: ArrayLike | None = None) -> Array:
    """Return the acceleration under given joint forces: q̈ = M⁻¹ (τ − h + Σ Jᵢᵀ f_ext[i]).

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
        Configuration.
    v, tau : array_like, shape (..., nv)
        Velocity; joint forces, N m or N. The first six of a floating base are a wrench (τ, f) on it, in its frame.
    f_ext : array_like, shape (..., nbodies, 6), optional
        Wrench (τ, f) on each body, in its frame; row 0, the world's, must be zero.

    Returns
    -------
    ndarray, shape (..., nv)
        rad/s² or m/s²; of a floating base the rate of its body twist (ω, v).

    Raises
    ------
    SingularError
        If a joint moves no inertia above rounding, so that q̈ is not determined. The message names the joint.
    ShapeError, ValueError
        As `rnea`.

    Notes
    -----
    Section 49.7; Featherstone, RBDA table 7.1. The loops are in `articulated_body`; `twistwrench.aba_terms` returns
    what they compute. `twistwrench.rnea` is the inverse.

    Examples
    --------
    A Go2 without torques falls freely:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest = np.zeros(model.nv)
    >>> tw.aba(model, model.standing(), rest, rest)[:6].round(12) + 0.0
    array([ 0.  ,  0.  ,  0.  ,  0.  ,  0.  , -9.81])
    """
    return aba_terms(model, q, v, tau, f_ext).qdd


def aba_terms(model: Model, q: ArrayLike, v: ArrayLike, tau: ArrayLike, f_ext: ArrayLike | None = None) -> AbaTerms:
    """Return what the ABA computes on its way: twists, articulated-body inertias, bias wrenches, accelerations.

    Parameters
    ----------
    model, q, v, tau, f_ext
        As `aba`.

    Returns
    -------
    AbaTerms
        V, c, B, IA, pA, U, D, D_inv, u, Ia, pa, A for each body, and qdd.

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `aba`.

    Examples
    --------
    With its joints free, the trunk of a Go2 has an apparent mass of 13.4 kg of its 16.1 when it is lifted:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest = np.zeros(model.nv)
    >>> tw.aba_terms(model, model.standing(), rest, rest).IA[1][5, 5].round(1)
    np.float64(13.4)
    """
    q, v, tau, f_ext = check_state(model, q, v=v, tau=tau, f_ext=f_ext)
    tree = tree_terms(model, q)
    try:
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # D singular: `refuse_singular`
            terms = articulated_body(tree, columns(model, v), columns(model, tau), wrenches(f_ext))
    except ZeroDivisionError:  # fractions raise where floats are infinite
        refuse_weightless(model, tree)
        raise SingularError("a joint moves no inertia with its outboard joints free: q̈ is not determined") from None
    refuse_singular(model, tree, terms)
    check_overflow(terms.qdd, "v, tau, f_ext")
    return terms
