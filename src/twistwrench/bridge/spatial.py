"""Spatial vectors and 6 × 6 matrices between (ω, v) and Pinocchio's (v, ω): reordering, nothing else.

Nothing here needs Pinocchio or rounds. Every function takes any leading batch axes, keeps the number
type and returns a new array. The swap of two halves is its own inverse; each direction has a name of its
own so that a line of code shows its direction.
"""

from __future__ import annotations

from collections.abc import Mapping, Set
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array
from ..spatial._vector import FramedVector, as_spatial

__all__ = [
    "from_pinocchio_force",
    "from_pinocchio_motion",
    "from_pinocchio_transform",
    "to_pinocchio_force",
    "to_pinocchio_motion",
    "to_pinocchio_transform",
]

HALVES = np.array([3, 4, 5, 0, 1, 2])
"""The index of each of six entries before the halves change places."""


def to_pinocchio_motion(V: ArrayLike) -> Array:
    """Turn a twist or spatial acceleration (ω, v) into Pinocchio's (v, ω).

    Parameters
    ----------
    V : Twist or array_like of shape (..., 6)
        (ω, v), rad/s and m/s (or per s²), in any frame.

    Returns
    -------
    ndarray, shape (..., 6)
        (v, ω), in the same frame.

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    TypeError
        If `V` is a Wrench.

    Examples
    --------
    >>> to_pinocchio_motion([1, 2, 3, 4, 5, 6])
    array([4., 5., 6., 1., 2., 3.])
    """
    return as_spatial(V, "V")[..., HALVES]


def from_pinocchio_motion(V: Any) -> Array:
    """Turn Pinocchio's twist or spatial acceleration (v, ω) into (ω, v).

    Parameters
    ----------
    V : pin.Motion, sequence of them (``data.v``), or array_like of shape (..., 6)
        (v, ω), m/s and rad/s (or per s²), in any frame.

    Returns
    -------
    ndarray, shape (..., 6)
        (ω, v), in the same frame; (n, 6) from a sequence of n.

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    TypeError
        If `V` is a ``pin.Force``, or a Twist or Wrench, which is (ω, v) or (τ, f) already.

    Examples
    --------
    >>> from_pinocchio_motion([4, 5, 6, 1, 2, 3])
    array([1., 2., 3., 4., 5., 6.])
    """
    return as_array(vectors(V, "V", "Motion"), "V", 6)[..., HALVES]


def to_pinocchio_force(F: ArrayLike) -> Array:
    """Turn a wrench or momentum (τ, f) into Pinocchio's (f, τ).

    Parameters
    ----------
    F : Wrench or array_like of shape (..., 6)
        (τ, f), N m and N (or with a further s for a momentum), in any frame.

    Returns
    -------
    ndarray, shape (..., 6)
        (f, τ), in the same frame.

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    TypeError
        If `F` is a Twist.

    Examples
    --------
    >>> to_pinocchio_force([1, 2, 3, 4, 5, 6])
    array([4., 5., 6., 1., 2., 3.])
    """
    return as_spatial(F, "F")[..., HALVES]


def from_pinocchio_force(F: Any) -> Array:
    """Turn Pinocchio's wrench or momentum (f, τ) into (τ, f).

    Parameters
    ----------
    F : pin.Force, sequence of them (``data.f``), or array_like of shape (..., 6)
        (f, τ), N and N m (or with a further s for a momentum, ``data.hg``), in any frame.

    Returns
    -------
    ndarray, shape (..., 6)
        (τ, f), in the same frame; (n, 6) from a sequence of n.

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    TypeError
        If `F` is a ``pin.Motion``, or a Twist or Wrench, which is (ω, v) or (τ, f) already.

    Examples
    --------
    >>> from_pinocchio_force([0, 0, 9.81, 0.5, 0, 0])
    array([0.5 , 0.  , 0.  , 0.  , 0.  , 9.81])
    """
    return as_array(vectors(F, "F", "Force"), "F", 6)[..., HALVES]


def vectors(value: Any, name: str, kind: str) -> Any:
    """Take the six numbers out of Pinocchio's own type, or out of each of a sequence."""
    if isinstance(value, FramedVector):
        raise TypeError(f"{name}: expected a pin.{kind} or an array, got a {type(value).__name__}, angular part first")
    if hasattr(value, "vector"):
        if type(value).__name__ != kind:
            raise TypeError(f"{name}: expected a pin.{kind} or an array, got a pin.{type(value).__name__}")
        return np.array(value.vector)
    listed = not isinstance(value, np.ndarray | Set | Mapping) and hasattr(value, "__getitem__") and len(value)
    if listed and hasattr(value[0], "vector"):
        return np.stack([vectors(one, name, kind) for one in value])
    return value


def to_pinocchio_transform(X: ArrayLike) -> Array:
    """Turn a 6 × 6 matrix over (ω, v) or (τ, f) into Pinocchio's: X, X*, V×, V×* or a spatial inertia.

    All four blocks change places: the bottom left one moves to the top right.

    Parameters
    ----------
    X : array_like, shape (..., 6, 6)

    Returns
    -------
    ndarray, shape (..., 6, 6)

    Raises
    ------
    ShapeError
        If the last axes are not (6, 6).

    Examples
    --------
    >>> from twistwrench import motion_transform
    >>> X = motion_transform(np.eye(3), [1, 0, 0])
    >>> to_pinocchio_transform(X)[:3, 3:]
    array([[ 0.,  0.,  0.],
           [ 0.,  0., -1.],
           [ 0.,  1.,  0.]])
    """
    return as_array(X, "X", 6, 6)[..., HALVES, :][..., HALVES]


def from_pinocchio_transform(X: ArrayLike) -> Array:
    """Turn Pinocchio's 6 × 6 matrix over (v, ω) or (f, τ) into ours: the inverse of `to_pinocchio_transform`.

    ``T.action``, ``T.actionInverse``, ``T.dualAction``, ``V.action``, ``V.dualAction``, ``inertia.matrix()``.

    Parameters
    ----------
    X : array_like, shape (..., 6, 6)

    Returns
    -------
    ndarray, shape (..., 6, 6)

    Raises
    ------
    ShapeError
        If the last axes are not (6, 6).

    Examples
    --------
    >>> from_pinocchio_transform(np.diag([2, 2, 2, 0.1, 0.2, 0.3])).diagonal()  # a body of 2 kg
    array([0.1, 0.2, 0.3, 2. , 2. , 2. ])
    """
    return as_array(X, "X", 6, 6)[..., HALVES, :][..., HALVES]
