"""Centre of mass, momentum about it, energies: sums over the bodies (49.1; 49.8 and 49.10 in six dimensions)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..errors import SingularError
from .bodies import Body, bodies_in_world, cross
from .state import State, take

__all__ = [
    "center_of_mass",
    "centroidal_map",
    "centroidal_momentum",
    "centroidal_momentum_rate",
    "kinetic_energy",
    "potential_energy",
]


def center_of_mass(model: Any, q: ArrayLike) -> Array:
    """Return the centre of mass of all moving bodies.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)

    Returns
    -------
    ndarray, shape (3,)
        In the world, m. What is welded to the world does not count.

    Raises
    ------
    ShapeError, ValueError
        If `q` is not one configuration of finite numbers.
    SingularError
        If nothing that moves has mass.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> center_of_mass(model, model.neutral()).round(4) + 0.0
    array([ 0.0082,  0.    , -0.0285])
    """
    state = take(model, q=q)
    return _center(state, bodies_in_world(state)[1:])


def centroidal_momentum(model: Any, q: ArrayLike, v: ArrayLike) -> Array:
    """Return the momentum h_G = (k, l) about the centre of mass.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v : array_like, shape (nv,)

    Returns
    -------
    ndarray, shape (6,)
        Angular momentum k about the centre of mass and linear momentum l, in world axes, kg m²/s
        and kg m/s. The rotors' armature is left out.

    Raises
    ------
    ShapeError, ValueError, SingularError
        As `center_of_mass`.

    Examples
    --------
    A Go2 at 2 m/s, all joints at rest:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> v = np.zeros(model.nv)
    >>> v[3] = 2.0
    >>> centroidal_momentum(model, model.neutral(), v).round(2) + 0.0
    array([ 0.  ,  0.  ,  0.  , 32.17,  0.  ,  0.  ])
    """
    state = take(model, q=q, v=v)
    bodies = bodies_in_world(state)[1:]
    center, k, l = _center(state, bodies), state.number.zeros(3), state.number.zeros(3)
    for body in bodies:
        momentum = body.mass * body.at(body.com)[0]
        l = l + momentum
        k = k + body.inertia @ body.omega + cross(body.com - center, momentum)  # (5)
    return np.concatenate([k, l])


def centroidal_momentum_rate(model: Any, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Array:
    """Return the rate ḣ_G = A_G a + Ȧ_G v of the centroidal momentum.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v, a : array_like, shape (nv,)

    Returns
    -------
    ndarray, shape (6,)
        In world axes, N m and N. Kinematic: of any motion, whatever the forces; at rest with
        a = 0 it is zero.

    Raises
    ------
    ShapeError, ValueError, SingularError
        As `center_of_mass`.

    Examples
    --------
    In free fall it is the weight:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> q, v = model.neutral(), np.zeros(model.nv)
    >>> a = np.zeros(model.nv)
    >>> a[5] = -9.81
    >>> centroidal_momentum_rate(model, q, v, a).round(2) + 0.0
    array([   0.  ,    0.  ,    0.  ,    0.  ,    0.  , -157.79])
    """
    state = take(model, q=q, v=v, a=a)
    bodies = bodies_in_world(state)[1:]
    center, k, l = _center(state, bodies), state.number.zeros(3), state.number.zeros(3)
    for body in bodies:
        I, w = body.inertia, body.omega
        momentum_rate = body.mass * body.at(body.com)[1]
        l = l + momentum_rate
        k = k + I @ body.alpha + cross(w, I @ w)  # (6)
        k = k + cross(body.com - center, momentum_rate)  # (5)
    return np.concatenate([k, l])


def centroidal_map(model: Any, q: ArrayLike) -> Array:
    """Return the matrix A_G that takes v to the centroidal momentum.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)

    Returns
    -------
    ndarray, shape (6, nv)
        Rows (k, l), in world axes.

    Raises
    ------
    ShapeError, ValueError, SingularError
        As `center_of_mass`.

    Examples
    --------
    Its linear rows for the base's linear columns are the mass:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> np.diag(centroidal_map(model, model.neutral())[3:, 3:6]).round(3)
    array([16.085, 16.085, 16.085])
    """
    state = take(model, q=q)
    bodies = bodies_in_world(state)[1:]
    center, A = _center(state, bodies), state.number.zeros(6, model.nv)
    for body in bodies:
        Jw, Jv = body.hinges.jacobian(body.com)
        momentum, arm = body.mass * Jv, (body.com - center)[:, None]
        A[:3, body.hinges.index] += body.inertia @ Jw + cross(arm, momentum)  # (5)
        A[3:, body.hinges.index] += momentum
    return A


def kinetic_energy(model: Any, q: ArrayLike, v: ArrayLike) -> Any:
    """Return the kinetic energy, that of the rotors included.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v : array_like, shape (nv,)

    Returns
    -------
    number
        J.

    Raises
    ------
    ShapeError, ValueError
        If an argument is not that of one state, or not finite.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> v = np.zeros(model.nv)
    >>> v[3] = 2.0
    >>> round(float(kinetic_energy(model, model.neutral(), v)), 2)
    32.17
    """
    state = take(model, q=q, v=v)
    twice = (state.number.array(model.armature) * state.v**2).sum()
    for body in bodies_in_world(state)[1:]:
        velocity = body.at(body.com)[0]
        twice = twice + body.mass * (velocity @ velocity) + body.omega @ body.inertia @ body.omega
    return twice / 2


def potential_energy(model: Any, q: ArrayLike) -> Any:
    """Return the potential energy −Σ m g·c, zero where every centre of mass is at the world's origin.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)

    Returns
    -------
    number
        J.

    Raises
    ------
    ShapeError, ValueError
        If `q` is not one configuration of finite numbers.

    Examples
    --------
    Lifted by one metre, a Go2 gains 157.79 J:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> q = model.neutral()
    >>> low = potential_energy(model, q)
    >>> q[2] += 1.0
    >>> round(float(potential_energy(model, q) - low), 2)
    157.79
    """
    state = take(model, q=q)
    energy = state.number.zeros(1)[0]
    for body in bodies_in_world(state)[1:]:
        energy = energy - body.mass * (state.number.array(model.gravity) @ body.com)
    return energy


def _center(state: State, bodies: list[Body]) -> Array:
    mass, moment = state.number.zeros(1)[0], state.number.zeros(3)
    for body in bodies:
        mass, moment = mass + body.mass, moment + body.mass * body.com
    if mass == 0:
        raise SingularError("there is no centre of mass: nothing that moves has mass")
    center: Array = moment / mass
    return center
