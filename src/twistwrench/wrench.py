"""Wrenches: 6-D forces (τ, f), and the power they spend on a twist (section 49.4)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import Array, as_arrays
from .twist import Placement, Screw, Twist, _SpatialVector, common_frame, screw_of

__all__ = ["Wrench", "power"]


def power(F: Wrench | ArrayLike, V: Twist | ArrayLike) -> Array:
    """Power of a wrench on a twist, FᵀV = τ·ω + f·v (section 49.4).

    Parameters
    ----------
    F : Wrench or array_like of shape (..., 6)
        (τ, f), N m and N.
    V : Twist or array_like of shape (..., 6)
        (ω, v), rad/s and m/s, in the frame of `F`.

    Returns
    -------
    ndarray, shape (...)
        W.

    Raises
    ------
    ShapeError
        If a last axis is not 6 long.
    FrameError
        If both are given with a frame, and the frames differ.
    TypeError
        If `F` is a Twist or `V` a Wrench.

    Examples
    --------
    >>> power([0, 0, 2, 0, 0, 0], [0, 0, 3, 1, 0, 0])
    array(6.)
    """
    if isinstance(F, Twist) or isinstance(V, Wrench):
        raise TypeError(f"power({type(F).__name__}, {type(V).__name__}): expected a wrench, then a twist")
    if isinstance(F, _SpatialVector) and isinstance(V, _SpatialVector):
        common_frame(F, V, "·")
    f, v = as_arrays(F=(np.asarray(F), (6,)), V=(np.asarray(V), (6,)))
    return np.asarray((f * v).sum(-1))


class Wrench(_SpatialVector):
    """Force on a rigid body, (τ, f): its moment about the origin and the force (section 49.4).

    Parameters
    ----------
    vector : array_like, shape (..., 6)
        (τ, f), N m and N.
    frame : str, optional
        The frame it is expressed in. Where two frames are given, they are checked.

    Examples
    --------
    >>> Wrench([0, 0, 2, 0, 0, 0]) @ Twist([0, 0, 3, 1, 0, 0])
    array(6.)
    """

    __slots__ = ()
    _symbol = "F"

    def transform(self, T: Placement, frame: str | None = None) -> Wrench:
        """Return the wrench in frame A, X* F, where T = T_AB places the present frame B in A (section 49.4)."""
        return Wrench(np.matvec(T.force_transform(), self._vector), frame=frame)

    def screw(self) -> Screw:
        """Return axis, point, pitch and magnitude: see `twistwrench.screw`."""
        return screw_of(self.linear, self.angular, "wrench")

    def power(self, twist: Twist | ArrayLike) -> Array:
        """Return the power spent on a twist, W: see `power`."""
        return power(self, twist)

    def __matmul__(self, twist: Twist | ArrayLike) -> Array:
        return power(self, twist)

    def __rmatmul__(self, twist: Twist | ArrayLike) -> Array:
        return power(self, twist)
