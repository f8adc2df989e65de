"""The matrices of the equation of motion, and its solution for the acceleration (49.1; 49.7 to 49.9 are faster)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..errors import SingularError
from .bodies import Body, bodies_in_world, cross
from .forces import virtual_power
from .state import State, take

__all__ = ["coriolis_matrix", "forward_dynamics", "mass_matrix"]


def mass_matrix(model: Any, q: ArrayLike) -> Array:
    """Return the mass matrix M(q) = Σ m JvᵀJv + Jωᵀ I Jω, with the armature on its diagonal.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)

    Returns
    -------
    ndarray, shape (nv, nv)
        Symmetric.

    Raises
    ------
    ShapeError, ValueError
        If `q` is not one configuration of finite numbers.

    Notes
    -----
    Jv and Jω are those of each body's centre of mass. The faster way is 49.8.

    Examples
    --------
    The base of a Go2 moves the same mass in every direction:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> np.diag(mass_matrix(model, model.neutral()))[3:6].round(3)
    array([16.085, 16.085, 16.085])
    """
    state = take(model, q=q)
    return _mass_matrix(state, bodies_in_world(state))


def coriolis_matrix(model: Any, q: ArrayLike, v: ArrayLike) -> Array:
    """Return C(q, v), with C v + g = h and Ṁ − 2C skew-symmetric.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v : array_like, shape (nv,)

    Returns
    -------
    ndarray, shape (nv, nv)

    Raises
    ------
    ShapeError, ValueError
        If an argument is not that of one state, or not finite.

    Notes
    -----
    C v = h − g does not determine C. Newton's part, Σ m Jvᵀ J̇v, is unique. In Euler's part,
    Σ Jωᵀ (I J̇ω + B Jω), only B ω = ω × I ω is required; Ṁ − 2C is skew if also B + Bᵀ = İ, where
    İ x = ω × I x − I (ω × x). Both hold for 2 B x = ω × I x − I (ω × x) − (I ω) × x. Of those that
    obey both it is the one of Echeandia and Wensing (2021), which is also Pinocchio's.

    Examples
    --------
    >>> import twistwrench as tw
    >>> from twistwrench.newton_euler_3d import gravity, nonlinear_effects
    >>> model = tw.load("go2")
    >>> q, v = model.random_configuration(rng=0), np.linspace(-1, 1, model.nv)
    >>> h = coriolis_matrix(model, q, v) @ v + gravity(model, q)
    >>> bool(abs(h - nonlinear_effects(model, q, v)).max() < 1e-12 * abs(h).max())
    True
    """
    state = take(model, q=q, v=v)
    C = state.number.zeros(model.nv, model.nv)
    for body in bodies_in_world(state)[1:]:
        I, w, k = body.inertia, body.omega, body.hinges.index
        Jw, Jv = body.hinges.jacobian(body.com)
        Jw_rate, Jv_rate = body.hinges.jacobian_rate(body.com, body.at(body.com)[0])
        B_Jw = (cross(w, I @ Jw) - I @ cross(w, Jw) - cross(I @ w, Jw)) / 2  # (6)
        C[np.ix_(k, k)] += body.mass * (Jv.mT @ Jv_rate) + Jw.mT @ (I @ Jw_rate + B_Jw)
    return C


def forward_dynamics(model: Any, q: ArrayLike, v: ArrayLike, tau: ArrayLike, f_ext: ArrayLike | None = None) -> Array:
    """Return the acceleration that joint forces cause: the a of M a = τ − h + Σ Jᵀ f_ext.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v : array_like, shape (nv,)
    tau : array_like, shape (nv,)
        N m and N.
    f_ext : array_like, shape (nbodies, 6), optional
        As `inverse_dynamics`.

    Returns
    -------
    ndarray, shape (nv,)

    Raises
    ------
    ShapeError, ValueError
        If an argument is not that of one state, or not finite.
    SingularError
        If a joint moves no inertia, so that its acceleration is not determined. Names the joints.

    Notes
    -----
    The faster way is 49.7.

    Examples
    --------
    Without any forces a Go2 falls:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest = np.zeros(model.nv)
    >>> forward_dynamics(model, model.neutral(), rest, rest)[:6].round(9) + 0.0
    array([ 0.  ,  0.  ,  0.  ,  0.  ,  0.  , -9.81])
    """
    state = take(model, q=q, v=v, tau=tau, f_ext=f_ext)
    bodies = bodies_in_world(state)
    return _solve(state, _mass_matrix(state, bodies), state.tau - virtual_power(state, bodies))


def _mass_matrix(state: State, bodies: list[Body]) -> Array:
    M = state.number.array(np.diag(state.model.armature))
    for body in bodies[1:]:
        k = body.hinges.index
        Jw, Jv = body.hinges.jacobian(body.com)
        M[np.ix_(k, k)] += body.mass * (Jv.mT @ Jv) + Jw.mT @ body.inertia @ Jw
    return M


def _solve(state: State, M: Array, b: Array) -> Array:
    """Solve M x = b, M symmetric, eliminating from the tips to the base.

    The pivot of entry k is its apparent inertia with all outboard joints free. Without roots, so that
    complex numbers pass.
    """
    n, x, free = len(b), b.copy(), []
    M, ratio = M.copy(), state.number.zeros(n, n)
    least = [n * state.number.eps * abs(M[k, k]) for k in range(n)]
    for k in reversed(range(n)):
        if state.number.nothing(M[k, k], least[k]):
            free.append(_joint_of(state.model, k))
            continue
        ratio[k, :k] = M[k, :k] / M[k, k]
        M[:k, :k] -= M[:k, k, None] * ratio[k, :k]
        x[:k] -= ratio[k, :k] * x[k]
    if free:
        names = ", ".join(dict.fromkeys(reversed(free)))
        raise SingularError(f"no inertia resists the joints {names}: their acceleration is not determined")
    for k in range(n):
        x[k] = x[k] / M[k, k] - (ratio[k, :k] * x[:k]).sum()
    return x


def _joint_of(model: Any, k: int) -> str:
    """Return the name of the joint that entry k of v belongs to."""
    return next(repr(model.joint_names[i]) for i in range(1, model.nbodies) if k < model.v_slice[i].stop)
