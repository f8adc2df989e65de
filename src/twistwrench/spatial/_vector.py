"""What the thin types Twist and Wrench have in common, so that each defines only where it differs."""

from __future__ import annotations

from typing import Any, ClassVar, Literal, NoReturn, Self

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from ..arrays import Array, as_arrays, as_number_array, as_number_arrays, check_batches, check_overflow
from ..errors import FrameError, SingularError, unknown_name
from ._elementary import at_first_index, length

__all__ = ["FramedVector", "align_digits", "as_spatial", "common_frame", "latex_matrix"]

LATEX = str.maketrans(
    {c: f"\\{c}" for c in "_#%&${} "} | {"\\": r"\backslash ", "^": r"\wedge ", "~": r"\sim ", "\n": r"\ "}
)
"""Escapes of the characters that LaTeX would take for commands: a name is printed as it is."""


class FramedVector:
    """What twists and wrenches share: six numbers, a frame, and a sum that checks both."""

    __slots__ = ("_frame", "_vector")
    # NumPy arrays leave the operators to this class.
    __array_ufunc__ = None
    _symbol: ClassVar[str]
    _line_first: ClassVar[bool]

    def __init__(self, vector: ArrayLike, *others: ArrayLike, frame: str | None = None) -> None:
        if others:
            got = f"{type(self).__name__}: expected one array of shape (..., 6), got {1 + len(others)}"
            raise TypeError(f"{got}; np.concatenate([angular, linear], axis=-1) makes one of two halves")
        if isinstance(vector, FramedVector):
            mine, theirs = type(self).__name__, type(vector).__name__
            raise TypeError(f"{mine}({theirs}): expected six numbers; those of the {theirs} are its .vector")
        if not isinstance(frame, str | None):
            raise unknown_name("frame", frame, ())
        self._vector = as_number_array(vector, "vector", 6).copy()
        self._vector.flags.writeable = False
        self._frame = frame

    @classmethod
    def from_screw(
        cls,
        axis: ArrayLike,
        point: ArrayLike = (0, 0, 0),
        pitch: ArrayLike = 0.0,
        magnitude: ArrayLike = 1.0,
        *,
        frame: str | None = None,
    ) -> Self:
        """Make a twist or a wrench from its screw: the inverse of `twistwrench.screw` (sections 49.2 and 49.4).

        ω = magnitude axis, v = point × ω + pitch ω; with an infinite pitch v = magnitude axis. Of a wrench the same,
        with f for ω and τ for v.

        Parameters
        ----------
        axis : array_like, shape (..., 3)
            Its direction; the length is divided out.
        point : array_like, shape (..., 3)
            Any point of the axis, m.
        pitch : array_like, shape (...)
            m/rad; of a wrench, moment per force, m.
        magnitude : array_like, shape (...)
            rad/s, or N; of a translation m/s, of a couple N m.
        frame : str, optional
            The frame that the numbers are expressed in.

        Returns
        -------
        Twist or Wrench

        Raises
        ------
        ShapeError
            If a shape is wrong.
        SingularError
            If an axis is zero.
        ValueError
            If a number other than the pitch is not finite, or products overflow.

        Examples
        --------
        >>> from twistwrench import Twist, screw
        >>> Twist.from_screw(axis=[0, 0, 2], point=[1, 0, 0], pitch=0.5)
        Twist([0.0, 0.0, 1.0, 0.0, -1.0, 0.5])
        >>> V = Twist([0, 0, 2, 0, -2, 1])
        >>> Twist.from_screw(*screw(V)) == V
        True
        """
        try:
            h = np.asarray(pitch)
        except ValueError:  # rows of different lengths: as_arrays raises for them
            h = np.zeros(())
        free = np.isinf(h) if h.dtype.kind in "fc" else np.zeros(h.shape, bool)
        turning = np.where(free, 0, h) if free.any() else pitch
        a, p, h, m = as_arrays(axis=(axis, (3,)), point=(point, (3,)), pitch=(turning, ()), magnitude=(magnitude, ()))
        size = length(a)[..., None]
        none = np.asarray(size.real == 0)[..., 0]
        if none.any():
            raise SingularError(f"axis: the zero vector has no direction{at_first_index(none)}")
        along = m[..., None] * (a / size)
        line = np.where(free[..., None], 0, along)
        with np.errstate(over="ignore", invalid="ignore"):
            moment = np.where(free[..., None], along, np.cross(p, line) + h[..., None] * line)
        check_overflow(moment, "point, pitch, magnitude")
        halves = np.broadcast_arrays(line, moment)
        return cls(np.concatenate(halves if cls._line_first else halves[::-1], axis=-1), frame=frame)

    @property
    def vector(self) -> Array:
        """The six numbers, angular part first, shape (..., 6), read-only."""
        return self._vector

    @property
    def angular(self) -> Array:
        """The first three numbers, ω or τ, shape (..., 3)."""
        return self._vector[..., :3]

    @property
    def linear(self) -> Array:
        """The last three numbers, v or f, shape (..., 3)."""
        return self._vector[..., 3:]

    @property
    def frame(self) -> str | None:
        """The frame that the numbers are expressed in, or None where it was not given."""
        return self._frame

    def _line_and_free(self) -> tuple[Array, Array]:
        """Return first the part that acts along a line, then the part that depends on the point."""
        raise NotImplementedError

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> Array:
        return np.array(self._vector, dtype=dtype, copy=copy)

    def __eq__(self, other: object) -> bool:  # by value; like an array, without a hash
        if type(other) is not type(self):
            return NotImplemented
        return self._frame == other._frame and np.array_equal(self._vector, other._vector)

    def __add__(self, other: object) -> Self:
        mine, theirs, frame = self._beside("+", other)
        return type(self)(mine + theirs, frame=frame)

    def __sub__(self, other: object) -> Self:
        mine, theirs, frame = self._beside("-", other)
        return type(self)(mine - theirs, frame=frame)

    def _beside(self, sign: str, other: object) -> tuple[Array, Array, str | None]:
        """Return the numbers of both sides, of one kind of numbers, and their frame; or raise."""
        if not isinstance(other, FramedVector):
            self._refuse(self, sign, other)
        frame = common_frame(self, sign, other)
        both = f"{type(self).__name__} {sign} {type(other).__name__}"
        check_batches(both, self._vector.shape[:-1], other._vector.shape[:-1])
        mine, theirs = as_number_arrays(left=(self._vector, (6,)), right=(other._vector, (6,)))
        return mine, theirs, frame

    def __radd__(self, other: object) -> Self:
        if type(other) is int and other == 0:  # where Python's sum starts
            return self
        self._refuse(other, "+", self)

    def __rsub__(self, other: object) -> NoReturn:
        self._refuse(other, "-", self)

    def __neg__(self) -> Self:
        return type(self)(-self._vector, frame=self._frame)

    def __mul__(self, scalar: ArrayLike) -> Self:
        if isinstance(scalar, FramedVector):
            return NotImplemented
        s, x = self._with_scalar(scalar)
        return type(self)(s * x, frame=self._frame)

    __rmul__ = __mul__

    def __truediv__(self, scalar: ArrayLike) -> Self:
        if isinstance(scalar, FramedVector):
            return NotImplemented
        s, x = self._with_scalar(scalar)
        if not s.all():
            raise ZeroDivisionError(f"{type(self).__name__} / 0")
        return type(self)(x / s, frame=self._frame)

    def _with_scalar(self, scalar: ArrayLike) -> tuple[Array, Array]:
        """Return a scalar, or one per item of a batch, and the six numbers, ready to be multiplied."""
        # A Python number takes the type of the vector: twice a float32 twist is a float32 twist.
        if type(scalar) in (int, float, complex):
            scalar = np.asarray(scalar, np.result_type(self._vector, scalar))
        s, x = as_number_arrays(scalar=(scalar, ()), vector=(self._vector, (6,)))
        check_batches(f"number and {type(self).__name__}", s.shape, x.shape[:-1])
        return s[..., None], x

    def __matmul__(self, other: object) -> Any:
        if isinstance(other, FramedVector) and type(other) is not type(self):
            return NotImplemented  # a wrench knows its power on a twist
        self._refuse_product(self, other)

    def __rmatmul__(self, other: object) -> Any:
        self._refuse_product(other, self)

    def _refuse_product(self, left: object, right: object) -> NoReturn:
        expression = f"{type(left).__name__} @ {type(right).__name__}"
        x = self._symbol
        raise TypeError(f"{expression}: use {x}.transform(T) for another frame, {x}.vector for products of arrays")

    def _refuse(self, left: object, sign: str, right: object) -> NoReturn:
        mine = type(self).__name__
        expression = f"{type(left).__name__} {sign} {type(right).__name__}"
        raise TypeError(f"{expression}: both sides must be of type {mine}; make one of an array with {mine}(array)")

    def __repr__(self) -> str:
        frame = "" if self._frame is None else f", frame={self._frame!r}"
        return f"{type(self).__name__}({self._vector.tolist()}{frame})"

    def _repr_latex_(self) -> str | None:
        if self._vector.ndim > 1:
            return None
        name = "" if self._frame is None else self._frame.translate(LATEX)
        frame = rf"{{}}^{{\mathrm{{{name}}}}}" if name else ""
        return rf"${frame}\mathbf{{{self._symbol}}} = {latex_matrix(self._vector[:, None])}$"


def common_frame(a: FramedVector, sign: str, b: FramedVector) -> str | None:
    """Return the frame of both sides of an expression, or raise where they cannot be combined."""
    if type(a) is not type(b) and sign in "+-":
        raise TypeError(
            f"{type(a).__name__} {sign} {type(b).__name__}: twists and wrenches live in dual spaces and do not add; "
            "did you mean the power, wrench @ twist, or the momentum, inertia @ twist?"
        )
    if None not in (a.frame, b.frame) and a.frame != b.frame:
        raise FrameError(
            f"{a._symbol}[{a.frame}] {sign} {b._symbol}[{b.frame}]: the frames differ; "
            "bring one into the frame of the other first, with .transform(T, frame=...)"
        )
    return b.frame if a.frame is None else a.frame


def as_spatial(value: ArrayLike, name: Literal["V", "F"]) -> Array:
    """Return the six numbers of an argument V, a Twist, or F, a Wrench; plain arrays pass, the other type does not."""
    for one in value if isinstance(value, list | tuple) else [value]:
        if isinstance(one, FramedVector) and one._symbol != name:
            expected = "Twist" if name == "V" else "Wrench"
            raise TypeError(f"{name}: expected a {expected} or an array, got a {type(one).__name__}")
    return as_number_array(value, name, 6)


def align_digits(before: str, x: Array) -> str:
    """Return an array with all its digits after a label, row below row."""
    return before + np.array2string(x, separator=", ", floatmode="unique", prefix=before, max_line_width=100)


def latex_matrix(rows: Array) -> str:
    """Return a matrix in LaTeX, six digits to a number."""
    body = r" \\ ".join(" & ".join(_latex_number(x) for x in row) for row in rows)
    return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"


def _latex_number(x: Any) -> str:
    if not isinstance(x, int | float | complex | np.number):
        return str(x)
    digits, e, power = f"{x:.6g}".partition("e")
    return rf"{digits} \cdot 10^{{{int(power)}}}" if e and power.lstrip("+-").isdigit() else digits + e + power
