"""Inverse dynamics by the recursive Newton-Euler algorithm (49.6).

Given a motion, which forces at the joints make it happen? Twists and accelerations are passed from
the base to the tips, wrenches from the tips back to the base: two passes, O(N).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..model import Model, Tree, check_model, check_state, columns, stack_columns, tree_terms, wrenches
from ..spatial.formulas import bias_wrench, cross_motion
from ._mimic import also_of_mimics
from .terms import RneaTerms

__all__ = ["gravity", "joint_wrenches", "newton_euler", "nonlinear_effects", "rnea", "rnea_terms"]


def newton_euler(tree: Tree, qd: list[Array], qdd: list[Array], f_ext: list[Array]) -> RneaTerms:
    """Run the RNEA, two passes (RBDA table 5.1).

    The index is the frame: V[i] is the twist of body i in frame i. Wrenches go inward by X[i]ᵀ, where the chapter
    writes X*; and F[i] is set in pass 1, before the children add to it. B[i] keeps what F[i] is then: the wrench that
    the motion of body i alone needs, less f_ext[i]. `bias_wrench` is V ×* I V, what a steady motion needs. The rotor of
    the motor, geared to joint i, adds rotor[i] q̈ to τ there.
    """
    parent, S, I, X, rotor = tree.parent, tree.S, tree.I, tree.X, tree.rotor
    V, A, B, F, tau = tree.zeros(5)

    A[0] = -tree.gravity  # 49.6 A0: gravity, as a world that rises
    for i in tree.outward:  # pass 1, from the base to the tips
        p = parent[i]
        vJ = S[i] @ qd[i]
        V[i] = X[i] @ V[p] + vJ  # 49.6 V: twist
        A[i] = X[i] @ A[p] + S[i] @ qdd[i] + cross_motion(V[i]) @ vJ  # 49.6 A: acceleration
        F[i] = B[i] = I[i] @ A[i] + bias_wrench(I[i], V[i]) - f_ext[i]  # 49.6 F: Newton and Euler
    for i in tree.inward:  # pass 2, from the tips to the base
        p = parent[i]
        tau[i] = S[i].mT @ F[i] + rotor[i] @ qdd[i]  # 49.6 tau: F along S
        F[p] = F[p] + X[i].mT @ F[i]  # 49.6 F_p: action and reaction
    return RneaTerms.of(tree.batch, V, A, B, F, stack_columns(tau))  # 49.6 RNEA


@also_of_mimics
def rnea(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike, f_ext: ArrayLike | None = None) -> Array:
    """Return the joint forces that make a motion happen: τ = M(q) a + h(q, v) − Σ Jᵢᵀ f_ext[i].

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
        Configuration.
    v, a : array_like, shape (..., nv)
        Velocity and acceleration; those of a floating base are (ω, v) and its rate, in its frame.
    f_ext : array_like, shape (..., nbodies, 6), optional
        Wrench (τ, f) on each body, in its frame, N m and N; row 0, the world's, must be zero.

    Returns
    -------
    ndarray, shape (..., nv)
        N m or N. The first six entries of a floating base are the wrench on it from outside, in its frame.

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`; and a wrench on the world, which could change nothing.

    Notes
    -----
    Section 49.6; Featherstone, RBDA table 5.1. The loops are in `newton_euler`; `twistwrench.rnea_terms` returns what
    they compute. `twistwrench.aba` is the inverse.

    Examples
    --------
    A standing Go2 needs its own weight, 16.085 kg · 9.81 m/s², at the base:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest = np.zeros(model.nv)
    >>> tw.rnea(model, model.standing(), rest, rest)[5].round(3)
    np.float64(157.794)
    """
    return rnea_terms(model, q, v, a, f_ext).tau


def rnea_terms(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike, f_ext: ArrayLike | None = None) -> RneaTerms:
    """Return what the RNEA computes on its way: twists, accelerations, wrenches and the joint forces.

    Parameters
    ----------
    model, q, v, a, f_ext
        As `rnea`.

    Returns
    -------
    RneaTerms
        V, A, B, F for each body, and tau.

    Raises
    ------
    ShapeError, ValueError
        As `rnea`.

    Examples
    --------
    Both links of a double pendulum hang on its first joint:

    >>> import twistwrench as tw
    >>> terms = tw.rnea_terms(tw.load("double_pendulum"), [0.0, 0.0], [0.0, 0.0], [0.0, 0.0])
    >>> terms.F[1].round(3) + 0.0, terms.F[2].round(3) + 0.0
    (array([ 0.  ,  0.  ,  0.  ,  0.  ,  0.  , 19.62]), array([0.  , 0.  , 0.  , 0.  , 0.  , 9.81]))
    """
    q, v, a, f_ext = check_state(model, q, v=v, a=a, f_ext=f_ext)
    return newton_euler(tree_terms(model, q), columns(model, v), columns(model, a), wrenches(f_ext))


@also_of_mimics
def joint_wrenches(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike, f_ext: ArrayLike | None = None) -> Array:
    """Return the wrench that each joint transmits to its body, in the body's frame.

    Parameters
    ----------
    model, q, v, a, f_ext
        As `rnea`.

    Returns
    -------
    ndarray, shape (..., nbodies, 6)
        (τ, f) of the joint on body i; the weight is in it. Row 0 is what the ground must bear, in the
        world's frame; the others are Pinocchio's ``data.f`` after its ``rnea``.

    Raises
    ------
    ShapeError, ValueError
        As `rnea`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("pendulum")
    >>> tw.joint_wrenches(model, [0.0], [0.0], [0.0])[1].round(6)  # hanging: its weight, no moment
    array([0.  , 0.  , 0.  , 0.  , 0.  , 9.81])
    """
    return np.stack(rnea_terms(model, q, v, a, f_ext).F, axis=-2)


@also_of_mimics
def nonlinear_effects(model: Model, q: ArrayLike, v: ArrayLike) -> Array:
    """Return h(q, v) = C(q, v) v + g(q), what is left of τ without acceleration (49.6).

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)

    Returns
    -------
    ndarray, shape (..., nv)
        N m or N.

    Raises
    ------
    ShapeError, ValueError
        As `rnea`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("cart_pole")
    >>> q, v = [0.0, 0.3], [0.0, 2.0]
    >>> bool((tw.nonlinear_effects(model, q, v) == tw.rnea(model, q, v, [0, 0])).all())
    True
    """
    check_model(model)
    return rnea(model, q, v, np.zeros(model.nv, int))  # 49.6 h


@also_of_mimics
def gravity(model: Model, q: ArrayLike) -> Array:
    """Return g(q), the joint forces that hold the model at rest against gravity.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    ndarray, shape (..., nv)
        N m or N.

    Raises
    ------
    ShapeError, ValueError
        As `rnea`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.gravity(tw.load("pendulum"), [0.0])  # hanging
    array([0.])
    """
    check_model(model)
    rest = np.zeros(model.nv, int)  # integers do not affect the number type
    return rnea(model, q, rest, rest)  # 49.6 g
