"""The forces of a motion, by D'Alembert's principle (49.1; 49.6 is faster).

Besides its weight a body needs Newton's m (c̈ − g) at the centre of mass and Euler's
I α + ω × I ω about it. The joints must supply them: their power on any motion that they allow equals
the power of these on the bodies. For entry k of v that motion is column k of the Jacobians:

    τ_k = Σ_bodies  (∂ċ/∂v_k) · [m (c̈ − g) − f_ext]  +  (∂ω/∂v_k) · [I α + ω × I ω − n_ext]
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from .bodies import Body, bodies_in_world, cross
from .state import State, take

__all__ = ["gravity", "inverse_dynamics", "joint_wrenches", "nonlinear_effects", "virtual_power"]


def inverse_dynamics(model: Any, q: ArrayLike, v: ArrayLike, a: ArrayLike, f_ext: ArrayLike | None = None) -> Array:
    """Return the joint forces τ that make a motion happen.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v, a : array_like, shape (nv,)
        Velocity and its rate, entry by entry.
    f_ext : array_like, shape (nbodies, 6), optional
        Wrench (τ, f) from outside on each body, at its frame's origin and in its axes, N m and N.
        Row 0, the world's, must be zero.

    Returns
    -------
    ndarray, shape (nv,)
        N m and N; for a free base the wrench (τ, f) in the base's frame.

    Raises
    ------
    ShapeError, ValueError
        If an argument is not that of one state, or not finite.

    Notes
    -----
    The faster way is 49.6. The rotors' armature adds armature · a.

    Examples
    --------
    With every entry of a zero, the base of a Go2 at rest bears its weight:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest = np.zeros(model.nv)
    >>> round(float(inverse_dynamics(model, model.neutral(), rest, rest)[5]), 2)
    157.79
    """
    state = take(model, q=q, v=v, a=a, f_ext=f_ext)
    return virtual_power(state, bodies_in_world(state))


def nonlinear_effects(model: Any, q: ArrayLike, v: ArrayLike) -> Array:
    """Return h(q, v) = C v + g: the joint forces where a = 0.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v : array_like, shape (nv,)

    Returns
    -------
    ndarray, shape (nv,)
        N m and N.

    Raises
    ------
    ShapeError, ValueError
        As `inverse_dynamics`.

    Examples
    --------
    A Go2 that spins about the vertical weighs no more for it:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> v = np.zeros(model.nv)
    >>> v[2] = 3.0
    >>> round(float(nonlinear_effects(model, model.neutral(), v)[5]), 2)
    157.79
    """
    state = take(model, q=q, v=v)
    return virtual_power(state, bodies_in_world(state))


def gravity(model: Any, q: ArrayLike) -> Array:
    """Return g(q): the joint forces that hold the robot at rest.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)

    Returns
    -------
    ndarray, shape (nv,)
        N m and N.

    Raises
    ------
    ShapeError, ValueError
        As `inverse_dynamics`.

    Examples
    --------
    A leg weighs 21.6 N, 5 cm outside of the axis of the hip's motor:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> hip = model.v_slice[model.joint_id("FL_hip_joint")]
    >>> gravity(model, model.neutral())[hip].round(3)
    array([1.075])
    """
    state = take(model, q=q)
    return virtual_power(state, bodies_in_world(state))


def joint_wrenches(model: Any, q: ArrayLike, v: ArrayLike, a: ArrayLike, f_ext: ArrayLike | None = None) -> Array:
    """Return the whole wrench that each joint transmits to the body it moves.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v, a : array_like, shape (nv,)
    f_ext : array_like, shape (nbodies, 6), optional
        As `inverse_dynamics`.

    Returns
    -------
    ndarray, shape (nbodies, 6)
        (τ, f) at body i's frame's origin and in its axes, N m and N. Row 0 is what the ground must
        bear, at the world's origin.

    Raises
    ------
    ShapeError, ValueError
        If an argument is not that of one state, or not finite.

    Notes
    -----
    The sum over all bodies outboard of joint i, less their weight and `f_ext`. The motor supplies the
    part along the joint's free motions, the bearing the rest.

    Examples
    --------
    The hip carries its leg, a good 2 kg:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest = np.zeros(model.nv)
    >>> hip = joint_wrenches(model, model.neutral(), rest, rest)[model.joint_id("FL_hip_joint")]
    >>> hip[3:].round(2) + 0.0
    array([ 0. ,  0. , 21.6])
    """
    state = take(model, q=q, v=v, a=a, f_ext=f_ext)
    bodies = bodies_in_world(state)
    wrenches = state.number.zeros(model.nbodies, 6)
    for i in range(1, model.nbodies):
        force, moment = _taken(state, bodies[i], state.f_ext[i])
        j = i
        while j >= 0:  # every joint between the body and the world transmits it, and the ground bears it
            at_joint = moment + cross(bodies[i].com - bodies[j].origin, force)  # (5)
            inward = bodies[j].rotation.mT
            wrenches[j] += np.concatenate([inward @ at_joint, inward @ force])
            j = model.parent[j]
    return wrenches


def virtual_power(state: State, bodies: list[Body]) -> Array:
    """Return the τ of the formula above: entry by entry, the power of all bodies at unit rate."""
    tau = state.number.array(state.model.armature) * state.a
    for i, body in enumerate(bodies[1:], start=1):
        force, moment = _taken(state, body, state.f_ext[i])
        Jw, Jv = body.hinges.jacobian(body.com)
        tau[body.hinges.index] += Jv.mT @ force + Jw.mT @ moment
    return tau


def _taken(state: State, body: Body, f_ext: Array) -> tuple[Array, Array]:
    """Return the force and the moment about its centre of mass that a body needs besides weight and `f_ext`."""
    I, w = body.inertia, body.omega
    moment_ext, force_ext = body.rotation @ f_ext[:3], body.rotation @ f_ext[3:]
    moment_ext = moment_ext + cross(body.origin - body.com, force_ext)  # (5)
    force = body.mass * (body.at(body.com)[1] - state.number.array(state.model.gravity))
    moment = I @ body.alpha + cross(w, I @ w)  # (6)
    return force - force_ext, moment - moment_ext
