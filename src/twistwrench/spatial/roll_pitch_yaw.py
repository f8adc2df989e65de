"""Roll, pitch and yaw, the three angles of URDF: to a rotation and back, and their rates (section 49.2)."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, as_number_array, check_choice
from ..errors import SingularError
from ._elementary import at_first_index, atan2, cos, sin
from .orthonormal import check_rotation

__all__ = ["rotation_to_rpy", "rpy_jacobian", "rpy_to_rotation"]

Axes = Literal["local", "world"]


def rpy_to_rotation(rpy: ArrayLike) -> Array:
    """Rotation matrix of URDF's roll, pitch, yaw: Rz(yaw) Ry(pitch) Rx(roll).

    Parameters
    ----------
    rpy : array_like, shape (..., 3)
        Roll, pitch and yaw, rad: turns about the fixed x, y and z axes, in this order.

    Returns
    -------
    ndarray, shape (..., 3, 3)

    Raises
    ------
    ShapeError
        If the last axis is not 3 long.

    Examples
    --------
    >>> rpy_to_rotation([np.pi / 2, 0, 0]).round(15) + 0.0
    array([[ 1.,  0.,  0.],
           [ 0.,  0., -1.],
           [ 0.,  1.,  0.]])
    """
    (cr, cp, cy), (sr, sp, sy) = _cosines_and_sines(rpy)
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return _matrix(rows)


def rotation_to_rpy(R: ArrayLike) -> Array:
    """Roll, pitch and yaw of a rotation matrix, with the pitch from −π/2 to π/2.

    Yaw and pitch are read from R Rx(roll)ᵀ, with the roll just found. So the three angles give back all digits of R
    even where the pitch is near ±π/2, and roll and yaw are no longer determined one by one.

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)
        Rotation matrix.

    Returns
    -------
    ndarray, shape (..., 3)
        Roll, pitch, yaw, rad. At a pitch of ±π/2 exactly, where many pairs of roll and yaw are right, the roll is 0.

    Raises
    ------
    ShapeError
        If the last two axes of `R` are not 3 by 3, or `R` is not a rotation.
    SingularError
        If complex numbers ask for a derivative at a pitch of ±π/2.

    Examples
    --------
    >>> rotation_to_rpy(rpy_to_rotation([0.3, 0.4, 0.5])).round(15)
    array([0.3, 0.4, 0.5])
    """
    R = as_array(R, "R", 3, 3)
    check_rotation(R, "R")
    locked = np.hypot(R[..., 2, 1].real, R[..., 2, 2].real) == 0
    if R.dtype.kind == "c" and locked.any():
        raise SingularError("R: roll and yaw have no derivative at a pitch of ±π/2" + at_first_index(locked))
    roll = atan2(R[..., 2, 1], R[..., 2, 2])
    c, s = cos(roll), sin(roll)
    pitch = atan2(-R[..., 2, 0], s * R[..., 2, 1] + c * R[..., 2, 2])
    yaw = atan2(s * R[..., 0, 2] - c * R[..., 0, 1], c * R[..., 1, 1] - s * R[..., 1, 2])
    return np.stack([roll, pitch, yaw], axis=-1)


def rpy_jacobian(rpy: ArrayLike, reference: Axes = "local") -> Array:
    """Matrix that takes the rates of roll, pitch and yaw to the angular velocity: ω = J d(rpy)/dt.

    Parameters
    ----------
    rpy : array_like, shape (..., 3)
        Roll, pitch and yaw, rad.
    reference : {"local", "world"}
        Whether ω is in the axes of the turned frame, as in a body twist, or in those that it was turned from.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Its determinant is the cosine of the pitch: at ±π/2 no rates give an ω about the axis that is lost.

    Raises
    ------
    ShapeError
        If the last axis is not 3 long.
    ValueError
        If there is no such reference.

    Examples
    --------
    >>> rpy_jacobian([0.0, np.pi / 6, 1.0]).round(3)  # yaw turns about z, which is tilted against the body's axes
    array([[ 1.   ,  0.   , -0.5  ],
           [ 0.   ,  1.   ,  0.   ],
           [ 0.   , -0.   ,  0.866]])
    """
    check_choice(reference, "reference", get_args(Axes))
    (cr, cp, cy), (sr, sp, sy) = _cosines_and_sines(rpy)
    zero = 0 * cp
    one = 0 * cp + 1
    if reference == "local":
        return _matrix([[one, zero, -sp], [zero, cr, sr * cp], [zero, -sr, cr * cp]])
    return _matrix([[cp * cy, -sy, zero], [cp * sy, cy, zero], [-sp, zero, one]])


def _cosines_and_sines(rpy: ArrayLike) -> tuple[Array, Array]:
    """Return the cosines of roll, pitch and yaw, and their sines, each with the angle as its first axis."""
    angles = np.moveaxis(as_number_array(rpy, "rpy", 3), -1, 0)
    return cos(angles), sin(angles)


def _matrix(rows: list[list[Array]]) -> Array:
    """Return a matrix of its entries, which are arrays of one shape."""
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
