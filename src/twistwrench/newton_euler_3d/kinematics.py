"""Where the bodies are and how they move (49.1; 49.2 and 49.6 in six dimensions)."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from .bodies import Body, bodies_in_world, cross
from .state import take

__all__ = ["BodyMotion", "body_accelerations", "body_twists", "motion", "placements", "spatial_acceleration"]


class BodyMotion(NamedTuple):
    """How each body moves, in world axes; each array is (nbodies, 3), row 0 the world's."""

    angular_velocity: Array
    """ω, rad/s."""
    velocity: Array
    """Of the body frame's origin, m/s."""
    angular_acceleration: Array
    """α, rad/s²."""
    acceleration: Array
    """Of the body frame's origin, classical: d/dt of `velocity`, m/s². Without gravity."""


def placements(model: Any, q: ArrayLike) -> tuple[Array, Array]:
    """Return every body's rotation and position in the world.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)

    Returns
    -------
    rotation : ndarray, shape (nbodies, 3, 3)
        From the body's axes to the world's.
    position : ndarray, shape (nbodies, 3)
        Of the body frame's origin, in the world, m.

    Raises
    ------
    ShapeError, ValueError
        If `q` is not one configuration of finite numbers, or a quaternion in it is zero.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rotation, position = placements(model, model.neutral())
    >>> position[model.joint_id("FL_calf_joint")]
    array([ 0.1934,  0.142 , -0.213 ])
    """
    bodies = bodies_in_world(take(model, q=q))
    return np.stack([b.rotation for b in bodies]), np.stack([b.origin for b in bodies])


def motion(model: Any, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> BodyMotion:
    """Return how every body moves in the world.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v, a : array_like, shape (nv,)
        Velocity and its rate, entry by entry.

    Returns
    -------
    BodyMotion
        In world axes.

    Raises
    ------
    ShapeError, ValueError
        If an argument is not that of one state, or not finite.

    Examples
    --------
    The base spins at 2 rad/s: a hip 0.19 m ahead and 0.05 m aside is pulled inward with ω² r:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> v = np.zeros(model.nv)
    >>> v[2] = 2.0
    >>> motion(model, model.neutral(), v, 0 * v).acceleration[model.joint_id("FL_hip_joint")]
    array([-0.7736, -0.186 ,  0.    ])
    """
    bodies = bodies_in_world(take(model, q=q, v=v, a=a))
    rows = [(b.omega, b.velocity, b.alpha, b.acceleration) for b in bodies]
    return BodyMotion(*(np.stack(column) for column in zip(*rows, strict=True)))


def body_twists(model: Any, q: ArrayLike, v: ArrayLike) -> Array:
    """Return every body's twist in its own frame.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v : array_like, shape (nv,)

    Returns
    -------
    ndarray, shape (nbodies, 6)
        (ω, v) at the body frame's origin, in its axes, rad/s and m/s.

    Raises
    ------
    ShapeError, ValueError
        If an argument is not that of one state, or not finite.

    Examples
    --------
    The first six entries of v are the base's own twist:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> q = model.random_configuration(rng=0)
    >>> body_twists(model, q, np.arange(18.0))[1].round(12)
    array([0., 1., 2., 3., 4., 5.])
    """
    bodies = bodies_in_world(take(model, q=q, v=v))
    return np.stack([np.concatenate([b.rotation.mT @ b.omega, b.rotation.mT @ b.velocity]) for b in bodies])


def body_accelerations(model: Any, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Array:
    """Return every body's spatial acceleration in its own frame.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v, a : array_like, shape (nv,)

    Returns
    -------
    ndarray, shape (nbodies, 6)
        (Rᵀα, Rᵀ(a_O − ω × v_O)) with the classical acceleration a_O of the frame's origin, rad/s²
        and m/s². Without gravity.

    Raises
    ------
    ShapeError, ValueError
        If an argument is not that of one state, or not finite.

    Notes
    -----
    Sections 49.2 and 49.6. It is the entry-by-entry rate of the body's twist.

    Examples
    --------
    The first six entries of a are the base's own:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> q = model.random_configuration(rng=0)
    >>> body_accelerations(model, q, np.ones(18), np.arange(18.0))[1].round(12)
    array([0., 1., 2., 3., 4., 5.])
    """
    bodies = bodies_in_world(take(model, q=q, v=v, a=a))
    return np.stack([spatial_acceleration(b, b.origin, b.rotation) for b in bodies])


def spatial_acceleration(body: Body, point: Array, axes: Array) -> Array:
    """Return a body's spatial acceleration (6,) at a point, in the axes that are the columns of `axes`.

    Its linear half is the rate of the velocity found at a place that does not move along with the body:
    a − ω × v, where a and v are those of the body's own point that is there now.
    """
    velocity, acceleration = body.at(point)
    return np.concatenate([axes.mT @ body.alpha, axes.mT @ (acceleration - cross(body.omega, velocity))])
