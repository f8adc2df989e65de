"""Named frames: where they are, their Jacobians, and J̇ v (49.1; 49.9 in six dimensions)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..errors import check_known
from .arithmetic import Arithmetic
from .bodies import Body, bodies_in_world
from .kinematics import spatial_acceleration
from .state import State, take

__all__ = ["frame_bias_acceleration", "frame_jacobian", "frame_placement"]

REFERENCES = ("local", "world", "local_world_aligned")


def frame_placement(model: Any, q: ArrayLike, frame: str) -> tuple[Array, Array]:
    """Return a frame's rotation and position in the world.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    frame : str

    Returns
    -------
    rotation : ndarray, shape (3, 3)
    position : ndarray, shape (3,)
        In the world, m.

    Raises
    ------
    ShapeError, ValueError, NameNotFound
        If `q` is not one configuration; if there is no such frame.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> frame_placement(model, model.neutral(), "FL_foot")[1]
    array([ 0.1934,  0.142 , -0.426 ])
    """
    _, R, p = _frame(take(model, q=q), frame)
    return R, p


def frame_jacobian(model: Any, q: ArrayLike, frame: str, reference: str = "local") -> Array:
    """Return the matrix J that takes v to a frame's twist.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    frame : str
    reference : {"local", "world", "local_world_aligned"}
        Which point's velocity, and in whose axes: the frame's origin in its own axes; the point of
        the body that is at the world's origin, in the world's axes; the frame's origin in the
        world's axes.

    Returns
    -------
    ndarray, shape (6, nv)
        Rows (ω, v).

    Raises
    ------
    ShapeError, ValueError, NameNotFound
        If `q` is not one configuration; if there is no such frame or reference.

    Examples
    --------
    The calf's motor moves the foot, 0.213 m below, straight back:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> J = frame_jacobian(model, model.neutral(), "FL_foot")
    >>> J[:, model.v_slice[model.joint_id("FL_calf_joint")]].ravel()
    array([ 0.   ,  1.   ,  0.   , -0.213,  0.   ,  0.   ])
    """
    state = take(model, q=q)
    body, R, p = _frame(state, frame)
    point, axes = _seen_from(state.number, reference, R, p)
    turn, shift = body.hinges.jacobian(point)
    J = state.number.zeros(6, model.nv)
    J[:, body.hinges.index] = np.concatenate([axes.mT @ turn, axes.mT @ shift])
    return J


def frame_bias_acceleration(model: Any, q: ArrayLike, v: ArrayLike, frame: str, reference: str = "local") -> Array:
    """Return J̇ v: the acceleration of a frame where a = 0.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
    v : array_like, shape (nv,)
    frame : str
    reference : {"local", "world", "local_world_aligned"}
        As `frame_jacobian`.

    Returns
    -------
    ndarray, shape (6,)
        rad/s² and m/s², without gravity. Spatial in "local" and "world"; in "local_world_aligned"
        the point moves along with the frame, so that J̇ v is its classical acceleration.

    Raises
    ------
    ShapeError, ValueError, NameNotFound
        If an argument is not that of one state; if there is no such frame or reference.

    Examples
    --------
    The foot swings about the calf's joint at 2 rad/s: 0.213 m · (2 rad/s)² upward:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> v = np.zeros(model.nv)
    >>> v[model.v_slice[model.joint_id("FL_calf_joint")]] = 2.0
    >>> frame_bias_acceleration(model, model.neutral(), v, "FL_foot", "local_world_aligned")
    array([0.   , 0.   , 0.   , 0.   , 0.   , 0.852])
    """
    state = take(model, q=q, v=v)
    body, R, p = _frame(state, frame)
    point, axes = _seen_from(state.number, reference, R, p)
    if reference == "local_world_aligned":
        return np.concatenate([body.alpha, body.at(point)[1]])
    return spatial_acceleration(body, point, axes)


def _frame(state: State, name: str) -> tuple[Body, Array, Array]:
    """Return the body that carries a frame, and the frame's rotation and position in the world."""
    frames, number = state.model.frames, state.number
    check_known("frame", name, frames)
    body, place = bodies_in_world(state)[frames[name].body], frames[name].placement
    R = body.rotation @ number.rotation(place.rotation, f"frame {name!r}")
    return body, R, body.origin + body.rotation @ number.array(place.translation)


def _seen_from(number: Arithmetic, reference: str, R: Array, p: Array) -> tuple[Array, Array]:
    """Return the reference point, and the axes of the result."""
    check_known("reference", reference, REFERENCES)
    match reference:
        case "local":
            return p, R
        case "world":
            return number.zeros(3), number.identity()
        case _:
            return p, number.identity()
