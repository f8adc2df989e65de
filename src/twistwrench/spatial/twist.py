"""Twists: 6-D velocities (ω, v), their 4 × 4 matrices, their screws, and a thin type (section 49.2)."""

from __future__ import annotations

from typing import Literal, NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, as_number, as_number_array, check_batches, check_overflow, tolerance
from ..errors import ShapeError, SingularError
from ._elementary import at_first_index, largest, length
from ._vector import FramedVector, as_spatial
from .rotation import cross_matrix, unskew

__all__ = ["Screw", "Twist", "hat", "screw", "vee"]


class Placed(Protocol):
    """What a change of frame must offer: `twistwrench.SE3` does."""

    translation: Array

    def motion_transform(self) -> Array: ...

    def force_transform(self) -> Array: ...


def check_placement(T: object) -> None:
    """Raise TypeError for what is not a placement; the message shows how to make one of a matrix."""
    if not hasattr(T, "motion_transform"):
        raise TypeError(f"T: expected an SE3, got {type(T).__name__}; SE3.from_matrix makes one of a 4 × 4 matrix")


class Screw(NamedTuple):
    """The screw of a twist or of a wrench (sections 49.2 and 49.4): what `screw` returns.

    Attributes
    ----------
    axis : ndarray, shape (..., 3)
        Unit vector along ω, or along f.
    point : ndarray, shape (..., 3)
        The point of the axis that is nearest to the origin, m.
    pitch : ndarray, shape (...)
        Advance along the axis per radian, m; of a wrench, moment per force, m. Infinite for a translation or a couple.
    magnitude : ndarray, shape (...)
        rad/s, or N; of a translation m/s, of a couple N m.
    """

    axis: Array
    point: Array
    pitch: Array
    magnitude: Array


def hat(V: ArrayLike) -> Array:
    """Matrix [[ω]×, v; 0, 0] in se(3) of a twist (section 49.2).

    Parameters
    ----------
    V : Twist or array_like of shape (..., 6)
        (ω, v), rad/s and m/s.

    Returns
    -------
    ndarray, shape (..., 4, 4)

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    TypeError
        If `V` is a Wrench.

    Examples
    --------
    >>> hat([0, 0, 2, 1, 0, 0])
    array([[ 0., -2.,  0.,  1.],
           [ 2.,  0.,  0.,  0.],
           [ 0.,  0.,  0.,  0.],
           [ 0.,  0.,  0.,  0.]])
    """
    V = as_spatial(V, "V")
    M = np.zeros((*V.shape[:-1], 4, 4), V.dtype)
    M[..., :3, :3], M[..., :3, 3] = cross_matrix(V[..., :3]), V[..., 3:]
    return M


def vee(M: ArrayLike) -> Array:
    """Twist of a matrix in se(3): the inverse of `hat` (section 49.2).

    Parameters
    ----------
    M : array_like, shape (..., 4, 4)
        [[ω]×, v; 0, 0], rad/s and m/s.

    Returns
    -------
    ndarray, shape (..., 6)
        (ω, v).

    Raises
    ------
    ShapeError
        If the shape is wrong or the matrix is not in se(3).

    Examples
    --------
    >>> vee(hat([1, 2, 3, 4, 5, 6]))
    array([1., 2., 3., 4., 5., 6.])
    """
    M = as_number_array(M, "M", 4, 4)
    if M.dtype == object:
        if (M[..., 3, :] != 0).any():
            raise ShapeError("M: expected a last row of zeros")
        return np.concatenate([unskew(M[..., :3, :3]), M[..., :3, 3]], axis=-1)
    off = largest(M[..., 3, :].real, 1)
    wrong = off > tolerance(M.dtype) * largest(M.real, 2)
    if wrong.any():
        raise ShapeError(f"M: expected a last row of zeros, got up to {off[wrong][0]:.3g}" + at_first_index(wrong))
    return np.concatenate([unskew(M[..., :3, :3]), M[..., :3, 3]], axis=-1)


def screw(x: FramedVector | ArrayLike, *, of: Literal["twist", "wrench"] | None = None, noise: float = 0.0) -> Screw:
    """Axis, point, pitch and magnitude of a twist or a wrench (sections 49.2 and 49.4).

    A twist has the axis ω/|ω|, point ω×v/|ω|², pitch ω·v/|ω|² and magnitude |ω|. Without rotation the axis is v/|v|,
    the point the origin, the pitch infinite and the magnitude |v|. For a wrench, read f for ω and τ for v.

    Parameters
    ----------
    x : Twist, Wrench or array_like of shape (..., 6)
        (ω, v), rad/s and m/s, or (τ, f), N m and N.
    of : {"twist", "wrench"}, optional
        What a plain array is; a twist by default. A Twist or a Wrench needs no `of`.
    noise : float
        By how much ω, rad/s, or f, N, may be wrong: if it is no larger than that, it is taken as zero.

    Returns
    -------
    Screw
        In the frame of `x`.

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    SingularError
        If the twist or wrench is zero, or its axis is too far away for a floating-point number.
    TypeError
        If `of` contradicts the type of `x`.
    ValueError
        If `of` is neither, `noise` below zero, or the magnitude overflows.

    Examples
    --------
    >>> screw([0, 0, 2, 0, -2, 1])
    Screw(axis=array([0., 0., 1.]), point=array([ 1.,  0., -0.]), pitch=array(0.5), magnitude=array(2.))
    >>> V = np.array([0, 0, 0.1 + 0.2 - 0.3, 0, 1, 0])  # the rotation is all rounding
    >>> screw(V).pitch, screw(V, noise=1e-15).pitch
    (array(0.), array(inf))
    """
    if not as_number(noise, "noise") >= 0:
        raise ValueError(f"noise: expected a number that is not below zero, got {noise}")
    if isinstance(x, FramedVector):
        kind = type(x).__name__.lower()
        line, free = (as_array(half, "x", 3) for half in x._line_and_free())
        if of not in (None, kind):
            raise TypeError(f"screw: of={of!r}, but x is a {type(x).__name__}")
        return _screw(line, free, kind, noise)
    if of not in (None, "twist", "wrench"):
        raise ValueError(f"of: expected 'twist' or 'wrench', got {of!r}")
    V = as_array(x, "x", 6)
    if of == "wrench":
        return _screw(V[..., 3:], V[..., :3], "wrench", noise)
    return _screw(V[..., :3], V[..., 3:], "twist", noise)


def _screw(line: Array, free: Array, kind: str, noise: float) -> Screw:
    """Screw of (ω, v) or of (f, τ): first the part that acts along a line, then the part that depends on the point."""
    without = np.asarray(length(line).real <= noise)[..., None]
    along = np.where(without, free, line)
    magnitude = length(along)[..., None]
    check_overflow(magnitude, "x")
    nothing = np.asarray(magnitude.real == 0)[..., 0]
    if nothing.any():
        raise SingularError(f"screw: a zero {kind} has no axis" + at_first_index(nothing))
    axis = along / magnitude
    with np.errstate(over="ignore", invalid="ignore"):
        lever = np.where(without, 0, free / magnitude)
        point, pitch = np.cross(axis, lever), (axis * lever).sum(-1)
    lost = np.asarray(~np.isfinite(lever).all(-1))
    if lost.any():
        raise SingularError(
            f"screw: the axis of the {kind} is too far away for floating-point numbers" + at_first_index(lost)
        )
    return Screw(axis, point, np.where(without[..., 0], np.inf, pitch), magnitude[..., 0])


class Twist(FramedVector):
    """Velocity of a rigid body, (ω, v): its angular velocity, and the velocity of its point at the origin (49.2).

    Parameters
    ----------
    vector : array_like, shape (..., 6)
        (ω, v), rad/s and m/s.
    frame : str, optional
        The frame in which the numbers are expressed. If both terms of a sum name one, the two names must be the same.

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    TypeError
        If the angular and linear parts were passed as two arguments.

    Examples
    --------
    >>> Twist([0, 0, 1, 0, 0, 0], frame="base") + Twist([0, 0, 0, 1, 0, 0], frame="base")
    Twist([0.0, 0.0, 1.0, 1.0, 0.0, 0.0], frame='base')
    """

    __slots__ = ()
    _symbol = "V"
    _line_first = True

    def transform(self, T: Placed, *, frame: str | None = None) -> Twist:
        """Return the twist in another frame, V_A = X V_B (section 49.3).

        Parameters
        ----------
        T : SE3
            T_AB: the present frame B, placed in A.
        frame : str, optional
            The name of A.

        Returns
        -------
        Twist

        Raises
        ------
        TypeError
            If `T` is not an SE3.

        Examples
        --------
        >>> from twistwrench.spatial.plucker import SE3
        >>> Twist([0, 0, 1, 0, 0, 0]).transform(SE3(np.eye(3), [1, 0, 0]), frame="world")
        Twist([0.0, 0.0, 1.0, 0.0, -1.0, 0.0], frame='world')
        """
        check_placement(T)
        check_batches("SE3 and Twist", T.translation.shape[:-1], self._vector.shape[:-1])
        return Twist(np.matvec(T.motion_transform(), self._vector), frame=frame)

    def screw(self) -> Screw:
        """Return axis, point, pitch and magnitude: see `twistwrench.screw`."""
        return screw(self)

    def _line_and_free(self) -> tuple[Array, Array]:
        return self.angular, self.linear
