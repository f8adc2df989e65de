"""Twists: 6-D velocities (ω, v), their 4 × 4 matrices, their screws, and a thin type (section 49.2)."""

from __future__ import annotations

from typing import ClassVar, NamedTuple, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from .checks import Array, as_array, resolution
from .errors import FrameError, ShapeError, SingularError
from .rotation import largest, length, skew, unskew

__all__ = ["Screw", "Twist", "hat", "screw", "vee"]


class Placement(Protocol):
    """What a change of frame must offer: `twistwrench.SE3` does."""

    def motion_transform(self) -> Array: ...

    def force_transform(self) -> Array: ...


class Screw(NamedTuple):
    """The screw of a twist or of a wrench: axis direction, a point on it, pitch, magnitude (49.2, 49.4)."""

    axis: Array
    point: Array
    pitch: Array
    magnitude: Array


def hat(V: ArrayLike) -> Array:
    """Matrix [[ω]×, v; 0, 0] in se(3) of a twist (section 49.2).

    Parameters
    ----------
    V : array_like, shape (..., 6)
        Twist (ω, v), rad/s and m/s.

    Returns
    -------
    ndarray, shape (..., 4, 4)

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.

    Examples
    --------
    >>> hat([0, 0, 2, 1, 0, 0])
    array([[ 0., -2.,  0.,  1.],
           [ 2.,  0.,  0.,  0.],
           [ 0.,  0.,  0.,  0.],
           [ 0.,  0.,  0.,  0.]])
    """
    V = as_array(V, "V", 6)
    M = np.zeros((*V.shape[:-1], 4, 4), V.dtype)
    M[..., :3, :3], M[..., :3, 3] = skew(V[..., :3]), V[..., 3:]
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
    M = as_array(M, "M", 4, 4)
    off = largest(M[..., 3, :].real, 1)
    wrong = off > resolution(M.dtype) ** 0.5 * largest(M.real, 2)
    if wrong.any():
        raise ShapeError(f"M: expected zeros in the last row of a matrix in se(3), got up to {off[wrong].max():.3g}")
    return np.concatenate([unskew(M[..., :3, :3]), M[..., :3, 3]], axis=-1)


def screw(x: _SpatialVector | ArrayLike, *, of: str = "twist") -> Screw:
    """Axis, point, pitch and magnitude of a twist or a wrench (sections 49.2 and 49.4).

    Parameters
    ----------
    x : Twist, Wrench or array_like of shape (..., 6)
    of : {"twist", "wrench"}
        What a plain array is. A Twist or a Wrench knows.

    Returns
    -------
    Screw

    Raises
    ------
    SingularError
        If a twist or a wrench is zero.

    Examples
    --------
    >>> screw([0, 0, 2, 0, -2, 1])
    Screw(axis=array([0., 0., 1.]), point=array([ 1.,  0., -0.]), pitch=array(0.5), magnitude=array(2.))
    """
    if isinstance(x, _SpatialVector):
        return x.screw()
    V = as_array(x, "x", 6)
    if of not in ("twist", "wrench"):
        raise ValueError(f"of: expected 'twist' or 'wrench', got {of!r}")
    return screw_of(V[..., :3], V[..., 3:], of) if of == "twist" else screw_of(V[..., 3:], V[..., :3], of)


def screw_of(main: Array, other: Array, kind: str) -> Screw:
    """Screw of (ω, v), or of (f, τ): the line vector first, then what depends on the point."""
    free = (main.real == 0).all(-1)[..., None]
    along = np.where(free, other, main)
    magnitude = length(along)[..., None]
    if (magnitude.real == 0).any():
        raise SingularError(f"screw: a zero {kind} has no axis")
    axis = along / magnitude
    with np.errstate(over="ignore", invalid="ignore"):
        lever = np.where(free, 0, other / magnitude)
        point = np.cross(axis, lever)
        pitch = np.where(free, np.inf, (axis * lever).sum(-1, keepdims=True))
    if not np.isfinite(point).all():
        raise SingularError(f"screw: the axis of the {kind} is further away than floating-point numbers reach")
    return Screw(axis, point, pitch[..., 0], magnitude[..., 0])


class _SpatialVector:
    """What twists and wrenches share: six numbers, a frame, and a sum that checks both."""

    __slots__ = ("_frame", "_vector")
    # NumPy arrays leave the operators to this class.
    __array_ufunc__ = None
    _symbol: ClassVar[str]
    _dual: ClassVar[str]

    def __init__(self, vector: ArrayLike, *, frame: str | None = None) -> None:
        if isinstance(vector, _SpatialVector):
            raise TypeError(f"{type(self).__name__}({type(vector).__name__}): give the six numbers, x.vector")
        self._vector = as_array(vector, "vector", 6).copy()
        self._vector.flags.writeable = False
        self._frame = frame

    @property
    def vector(self) -> Array:
        """The six numbers, angular part first, shape (..., 6); read-only."""
        return self._vector

    @property
    def angular(self) -> Array:
        """The first three numbers, shape (..., 3)."""
        return self._vector[..., :3]

    @property
    def linear(self) -> Array:
        """The last three numbers, shape (..., 3)."""
        return self._vector[..., 3:]

    @property
    def frame(self) -> str | None:
        """The frame the numbers are expressed in, or None where it was not given."""
        return self._frame

    def screw(self) -> Screw:
        """Return the screw: see `twistwrench.screw`."""
        raise NotImplementedError

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> Array:
        return np.array(self._vector, dtype=dtype, copy=copy)

    def __add__(self, other: object) -> Self:
        vector, frame = self._partner(other, "+")
        return type(self)(self._vector + vector, frame=frame)

    def __radd__(self, other: object) -> Self:
        return self.__add__(other)

    def __sub__(self, other: object) -> Self:
        vector, frame = self._partner(other, "-")
        return type(self)(self._vector - vector, frame=frame)

    def __rsub__(self, other: object) -> Self:
        return (-self).__add__(other)

    def __neg__(self) -> Self:
        return type(self)(-self._vector, frame=self._frame)

    def __mul__(self, scalar: ArrayLike) -> Self:
        if isinstance(scalar, _SpatialVector):
            return NotImplemented
        return type(self)(as_array(scalar, "scalar")[..., None] * self._vector, frame=self._frame)

    __rmul__ = __mul__

    def _partner(self, other: object, sign: str) -> tuple[Array, str | None]:
        """Return the other operand and the common frame of a sum, or say why there is none."""
        mine, theirs = type(self), type(other)
        if not isinstance(other, _SpatialVector):
            raise TypeError(f"{mine.__name__} {sign} {theirs.__name__}: wrap the array first: {mine.__name__}(array)")
        if mine is not theirs:
            raise TypeError(
                f"{mine.__name__} {sign} {theirs.__name__}: they live in dual spaces and do not add; "
                "did you mean their power, wrench @ twist, or the momentum of a body, inertia.momentum(twist)?"
            )
        return other._vector, common_frame(self, other, sign)

    def __repr__(self) -> str:
        frame = "" if self._frame is None else f", frame={self._frame!r}"
        return f"{type(self).__name__}({self._vector.tolist()}{frame})"

    def _repr_latex_(self) -> str | None:
        if self._vector.ndim > 1:
            return None
        frame = "" if self._frame is None else rf"{{}}^{{\mathrm{{{self._frame}}}}}".replace("_", r"\_")
        rows = r" \\ ".join(f"{x:.6g}" for x in self._vector)
        return rf"${frame}\mathbf{{{self._symbol}}} = \begin{{bmatrix}} {rows} \end{{bmatrix}}$"


def common_frame(a: _SpatialVector, b: _SpatialVector, sign: str) -> str | None:
    """Return the frame of both, or raise FrameError with the expression and both frames."""
    if a.frame is not None and b.frame is not None and a.frame != b.frame:
        raise FrameError(
            f"{a._symbol}[{a.frame}] {sign} {b._symbol}[{b.frame}]: the frames differ; "
            f"bring one into the other's frame first, with .transform(T)"
        )
    return a.frame if a.frame is not None else b.frame


class Twist(_SpatialVector):
    """Velocity of a rigid body, (ω, v): its angular velocity and the velocity of the point at the origin (49.2).

    Parameters
    ----------
    vector : array_like, shape (..., 6)
        (ω, v), rad/s and m/s.
    frame : str, optional
        The frame it is expressed in. Where two frames are given, they are checked.

    Examples
    --------
    >>> Twist([0, 0, 1, 0, 0, 0], frame="base") + Twist([0, 0, 0, 1, 0, 0], frame="base")
    Twist([0.0, 0.0, 1.0, 1.0, 0.0, 0.0], frame='base')
    """

    __slots__ = ()
    _symbol = "V"

    def transform(self, T: Placement, frame: str | None = None) -> Twist:
        """Return the twist in frame A, X V, where T = T_AB places the present frame B in A (section 49.3)."""
        return Twist(np.matvec(T.motion_transform(), self._vector), frame=frame)

    def screw(self) -> Screw:
        """Return axis, point, pitch and magnitude: see `twistwrench.screw`."""
        return screw_of(self.angular, self.linear, "twist")
