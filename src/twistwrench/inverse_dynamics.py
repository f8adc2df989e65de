"""Inverse dynamics by the recursive Newton-Euler algorithm (49.6).

Given a motion, which forces at the joints make it happen? Twists and accelerations are passed from
the base to the tips, wrenches from the tips back to the base: two passes, O(N).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import Array
from .door import check_model, state_of
from .inertia import cross_force, cross_motion
from .model import Model
from .tree import join, split, walk

__all__ = ["gravity", "joint_wrenches", "nonlinear_effects", "rnea"]


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
        Wrench (τ, f) on each body, in its frame; row 0, the world's, must be zero. N m and N.

    Returns
    -------
    ndarray, shape (..., nv)
        N m or N. The first six of a floating base are the wrench, in its frame, that would have to
        act on it from outside.

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`; and a wrench on the world, which could change nothing.

    See Also
    --------
    twistwrench.aba : the inverse.

    Notes
    -----
    Section 49.6; Featherstone, RBDA table 5.1. Gravity enters as an upward acceleration of the world.
    The chapter's backward pass sets F[i] after the children have added to it, and uses X* where Xᵀ
    is meant: here F[i] is set in the forward pass and goes inward by X[i]ᵀ.

    Examples
    --------
    A standing Go2 needs its own weight, 16.085 kg · 9.81 m/s², at the base:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest = np.zeros(model.nv)
    >>> tw.rnea(model, model.standing(), rest, rest)[5].round(3)
    np.float64(157.794)
    """
    return _rnea(model, q, v, a, f_ext)[0]


def _rnea(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike, f_ext: ArrayLike | None) -> tuple[Array, list[Array]]:
    """Return the joint forces, and the wrench that each joint passes on to its body."""
    q, v, a, f_ext = state_of(model, q, v=v, a=a, f_ext=f_ext)
    tree, n = walk(model, q), model.nbodies
    S, I, X, qd, qdd = tree.S, tree.I, tree.X, split(model, v), split(model, a)
    V, A, F, tau = ([np.zeros(6, q.dtype)] * n for _ in range(4))

    A[0] = -model.constants(q.dtype).gravity  # the world rises
    F[0], tau[0] = np.zeros((*q.shape[:-1], 6), q.dtype), q[..., :0]
    for i in tree.outward:  # pass 1, from the base to the tips
        p = tree.parent[i]
        vJ = np.matvec(S[i], qd[i])
        V[i] = np.matvec(X[i], V[p]) + vJ  # twist
        A[i] = np.matvec(X[i], A[p]) + np.matvec(S[i], qdd[i]) + np.matvec(cross_motion(V[i]), vJ)  # acceleration
        h = np.matvec(I[i], V[i])  # momentum
        F[i] = np.matvec(I[i], A[i]) + np.matvec(cross_force(V[i]), h) - f_ext[..., i, :]  # Newton-Euler
    for i in tree.inward:  # pass 2, from the tips to the base
        p = tree.parent[i]
        tau[i] = np.matvec(S[i].mT, F[i])  # the part that the joint does not bear by itself
        F[p] = F[p] + np.matvec(X[i].mT, F[i])  # the rest is the parent's
    return join(tau) + model.constants(q.dtype).armature * a, F


def joint_wrenches(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike, f_ext: ArrayLike | None = None) -> Array:
    """Return the wrench that each joint transmits to its body, in the body's frame.

    Parameters
    ----------
    model, q, v, a, f_ext
        As `rnea`.

    Returns
    -------
    ndarray, shape (..., nbodies, 6)
        (τ, f) of the joint on body i, gravity carried. Row 0 is what the ground must bear, in the
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
    return np.stack(_rnea(model, q, v, a, f_ext)[1], axis=-2)


def nonlinear_effects(model: Model, q: ArrayLike, v: ArrayLike) -> Array:
    """Return h(q, v) = C(q, v) v + g(q), what is left of τ without acceleration (49.9).

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
    return rnea(model, q, v, np.zeros(model.nv, int))


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
    rest = np.zeros(model.nv, int)  # integers have no say in the number type
    return rnea(model, q, rest, rest)
