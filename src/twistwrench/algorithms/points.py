"""Points given at run time: velocity, acceleration and Jacobian of any point of a body (49.1, 49.9)."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_number_array, check_size, convert
from ..model import Model, check_state
from ..spatial.rotation import cross_matrix
from ._mimic import also_of_mimics
from .kinematics import frame_bias_acceleration, frame_jacobian, frame_placement

__all__ = ["point_acceleration", "point_jacobian", "point_velocity"]

ALIGNED: Final = "local_world_aligned"


@also_of_mimics
def point_jacobian(model: Model, q: ArrayLike, frame: str, point: ArrayLike) -> Array:
    """Return the Jacobian of a point that moves with a frame: its velocity is J(q) v.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    frame : str
    point : array_like, shape (..., 3)
        In that frame, m.

    Returns
    -------
    ndarray, shape (..., 3, nv)
        In the axes of the world. Its transpose takes a force at the point to the joints.

    Raises
    ------
    NameNotFound, ShapeError, ValueError
        As `frame_jacobian`, or if `point` is not three numbers.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.point_jacobian(tw.load("pendulum"), [0.0], "bob", [0, 0, -1])[:, 0]  # a metre below the bob, two in all
    array([-2.,  0.,  0.])
    """
    (q,) = check_state(model, q)
    J, r = frame_jacobian(model, q, frame, ALIGNED), _lever(model, q, frame, point)
    return np.asarray(J[..., 3:, :] - cross_matrix(r) @ J[..., :3, :])  # 49.1 v_P: v + ω × r


@also_of_mimics
def point_velocity(model: Model, q: ArrayLike, v: ArrayLike, frame: str, point: ArrayLike) -> Array:
    """Return the velocity of a point that moves with a frame, in the axes of the world.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)
    frame : str
    point : array_like, shape (..., 3)
        In that frame, m.

    Returns
    -------
    ndarray, shape (..., 3)
        m/s.

    Raises
    ------
    NameNotFound, ShapeError, ValueError
        As `point_jacobian`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.point_velocity(tw.load("pendulum"), [0.0], [3.0], "bob", [0, 0, -1])
    array([-6.,  0.,  0.])
    """
    q, v = check_state(model, q, v=v)
    return np.asarray(np.matvec(point_jacobian(model, q, frame, point), v))


@also_of_mimics
def point_acceleration(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike, frame: str, point: ArrayLike) -> Array:
    """Return the acceleration of a point that moves with a frame, in the axes of the world, without gravity.

    That of the point, d²x/dt², which an observer at rest sees: not spatial.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v, a : array_like, shape (..., nv)
    frame : str
    point : array_like, shape (..., 3)
        In that frame, m.

    Returns
    -------
    ndarray, shape (..., 3)
        m/s².

    Raises
    ------
    NameNotFound, ShapeError, ValueError
        As `point_jacobian`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.point_acceleration(tw.load("pendulum"), [0.0], [3.0], [0.0], "bob", [0, 0, -1])  # ω² r to the pivot
    array([ 0.,  0., 18.])
    """
    q, v, a = check_state(model, q, v=v, a=a)
    J, r = frame_jacobian(model, q, frame, ALIGNED), _lever(model, q, frame, point)
    w = np.matvec(J[..., :3, :], v)
    frame_acceleration = np.matvec(J, a) + frame_bias_acceleration(model, q, v, frame, ALIGNED)
    turning = np.cross(frame_acceleration[..., :3], r) + np.cross(w, np.cross(w, r))  # 49.1 a_P: ω̇ × r + ω × (ω × r)
    return np.asarray(frame_acceleration[..., 3:] + turning)


def _lever(model: Model, q: Array, frame: str, point: ArrayLike) -> Array:
    """Return the way from the origin of the frame to the point, in the axes of the world."""
    there, R = as_number_array(point, "point", 3), frame_placement(model, q, frame).rotation
    if there.dtype != object:
        check_size(there, "point")
    return np.asarray(np.matvec(R, convert(there, q.dtype) if R.dtype == object else there))
