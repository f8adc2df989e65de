"""The joints in 3-D: their placements and their free motions (49.1).

The layouts of q and v are the package's. A quaternion or (cos, sin) in q is divided by its length. A joint with one
coordinate q is a screw: it is given by the angular velocity w and the velocity v of a unit rate, the two halves of S.
"""

from __future__ import annotations

from copy import copy
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from ..arrays import Array
from ..errors import ModelError
from .arithmetic import Arithmetic

__all__ = ["joint_columns", "joint_pose"]


def joint_pose(number: Arithmetic, joint: Any, q: Array, name: str) -> tuple[Array, Array]:
    """Return rotation (3, 3) and position (3,) of the moved frame in the joint's frame.

    Parameters
    ----------
    number : Arithmetic
    joint : Joint
        Any with one coordinate, or another one of the package.
    q : ndarray, shape (nq of the joint,)
        rad and m.
    name : str
        The joint's, for the error.

    Raises
    ------
    ModelError
        If the kind is unknown.
    ValueError
        If a quaternion or a (cos, sin) is zero.

    Examples
    --------
    A quarter turn about z takes x to y:

    >>> from types import SimpleNamespace
    >>> joint = SimpleNamespace(kind="continuous", axis=(0, 0, 1))
    >>> R, p = joint_pose(Arithmetic(np.dtype(float)), joint, np.array([0.0, 1.0]), "elbow")
    >>> R @ [1.0, 0.0, 0.0]
    array([0., 1., 0.])
    """
    one, none = number.identity(), number.zeros(3)
    match joint.kind:
        case "continuous":
            return _about(number, number.unit(joint.axis), *_direction(number, q, name)), none
        case "planar":
            return _about(number, one[2], *_direction(number, q[2:], name)), one[0] * q[0] + one[1] * q[1]
        case "spherical":
            return _turn(number, q, name), none
        case "free_flyer":
            return _turn(number, q[3:], name), q[:3]
    if _has_one_coordinate(joint):
        return _along(number, *_screw(number, joint), q[0])
    raise ModelError(f"joint {name!r}: unknown kind {joint.kind!r}")


def joint_columns(number: Arithmetic, joint: Any, name: str) -> tuple[Array, Array]:
    """Return the angular velocity and the velocity at unit rates.

    Parameters
    ----------
    number, joint, name
        As `joint_pose`.

    Returns
    -------
    turn, slide : ndarray, shape (3, nv of the joint)
        In the axes of the moved frame, in which they are constant.

    Raises
    ------
    ModelError
        If the kind is unknown.

    Examples
    --------
    A planar joint's v is (vx, vy, ωz):

    >>> from types import SimpleNamespace
    >>> turn, slide = joint_columns(Arithmetic(np.dtype(float)), SimpleNamespace(kind="planar"), "skate")
    >>> turn @ [1, 2, 3], slide @ [1, 2, 3]
    (array([0., 0., 3.]), array([1., 2., 0.]))
    """
    one, none = number.identity(), number.zeros(3, 3)
    match joint.kind:
        case "continuous":
            return number.unit(joint.axis)[:, None], none[:, :1]
        case "planar":  # (vx, vy, ωz)
            return np.stack([none[0], none[0], one[2]], axis=1), np.stack([one[0], one[1], none[0]], axis=1)
        case "spherical":  # ω
            return one, none
        case "free_flyer":  # (ω, v)
            return np.hstack([one, none]), np.hstack([none, one])
    if _has_one_coordinate(joint):
        w, v = _screw(number, joint)
        return w[:, None], v[:, None]
    raise ModelError(f"joint {name!r}: unknown kind {joint.kind!r}")


def _has_one_coordinate(joint: Any) -> bool:
    return getattr(joint, "nq", 0) == 1 and joint.nv == 1 and joint.unit is None


def _screw(number: Arithmetic, joint: Any) -> tuple[Array, Array]:
    """Return w and v of a unit rate, the axis that is unit in double precision made unit to the last digit."""
    S = number.array(_constants_in(number, joint).subspace(number.dtype)[:, 0])
    size = number.sqrt((S[:3] * S[:3]).sum() if (S[:3] != 0).any() else (S[3:] * S[3:]).sum())
    if abs(size - 1) < 1e-12:
        S = S / size
    return S[:3], S[3:]


def _constants_in(number: Arithmetic, joint: Any) -> Any:
    """Return the joint with its constants turned into mpmath's numbers, before any arithmetic is done on them."""
    if number.context is None or not is_dataclass(joint):
        return joint
    joint = copy(joint)
    for field in fields(joint):
        value = getattr(joint, field.name)
        numbers = tuple(number.array(value)) if isinstance(value, tuple) else number.context.convert(value)
        object.__setattr__(joint, field.name, numbers)
    return joint


def _along(number: Arithmetic, w: Array, v: Array, q: Any) -> tuple[Array, Array]:
    """Go by q along a screw: R = exp(q [w]×), p = ((1 − R)(w × v) + w (w·v) q)/|w|²."""
    square = (w * w).sum()
    if not square:
        return number.identity(), v * q
    size = number.sqrt(square)
    R = _about(number, w / size, number.cos(size * q), number.sin(size * q))
    beside = _cross(w) @ v
    return R, (beside - R @ beside + w * ((w * v).sum() * q)) / square


def _cross(w: Array) -> Array:
    """Return the matrix of w ×."""
    x, y, z = w
    return np.array([[x * 0, -z, y], [z, x * 0, -x], [-y, x, x * 0]])


def _about(number: Arithmetic, axis: Array, c: Any, s: Any) -> Array:
    """Turn about a unit axis by the angle of cosine c and sine s: the component along it stays."""
    along = axis[:, None] * axis
    rotation: Array = along + (number.identity() - along) * c + _cross(axis) * s
    return rotation


def _turn(number: Arithmetic, q: Array, name: str) -> Array:
    """Turn by a quaternion, without a root for exact numbers."""
    _refuse_zero(q, name)
    return number.quaternion(q if number.exact else number.unit(q))


def _direction(number: Arithmetic, q: Array, name: str) -> Array:
    """Return a (cos, sin) normalised to length 1."""
    _refuse_zero(q, name)
    return number.unit(q)


def _refuse_zero(q: Array, name: str) -> None:
    if not (q != 0).any():
        what = "quaternion" if len(q) == 4 else "(cos, sin)"
        raise ValueError(f"q: joint {name!r}: the {what} is zero and has no direction")
