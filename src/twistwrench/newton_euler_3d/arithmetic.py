"""Which numbers a call works in, and the little that depends on it (49.1).

The formulas of this package are sums and products, and those read the same for every kind of number.
Four things do not: a constant of the model must first *become* such a number, and sine, cosine and
square root belong to it. `Arithmetic` holds those four; nothing else here knows whether it computes
in double precision or in fifty digits.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..checks import Array, as_arrays, resolution
from ..errors import ModelError, ShapeError, no_model

__all__ = ["Arithmetic", "State", "as_mpmath", "take"]


def as_mpmath(x: ArrayLike) -> Array:
    """Turn doubles into mpmath numbers of the same value, exactly.

    Parameters
    ----------
    x : array_like
        Of any shape.

    Returns
    -------
    ndarray of mpmath.mpf or mpmath.mpc
        Of the same shape. The number of digits of what is computed from it is ``mpmath.mp.dps``.

    Examples
    --------
    The double nearest to 0.1, for what it is:

    >>> import mpmath
    >>> with mpmath.workdps(25):
    ...     print(as_mpmath([0.1])[0])
    0.1000000000000000055511151
    """
    from mpmath import mp

    return Arithmetic(np.dtype(object), mp).array(x)


@dataclass(frozen=True)
class Arithmetic:
    """One kind of number: NumPy's (`context` is None), or mpmath's with its `context`.

    An mpmath number carries its context with it, and the context carries the functions and the
    number of digits: so mpmath need not be imported to compute with it.
    """

    dtype: np.dtype[Any]
    context: Any = None

    @property
    def eps(self) -> Any:
        """Spacing of the numbers next to 1."""
        return resolution(self.dtype) if self.context is None else self.context.eps

    def array(self, values: ArrayLike) -> Array:
        """Turn constants into these numbers. Done before any arithmetic, so that none is done in doubles."""
        if self.context is None:
            return np.array(values, self.dtype)
        return np.asarray(np.frompyfunc(self.context.convert, 1, 1)(values), object)

    def zeros(self, *shape: int) -> Array:
        """Return zeros."""
        return self.array(np.zeros(shape))

    def identity(self) -> Array:
        """Return the 3×3 unit matrix."""
        return self.array(np.eye(3))

    def cos(self, x: Any) -> Any:
        """Return the cosine of one number."""
        return np.cos(x) if self.context is None else self.context.cos(x)

    def sin(self, x: Any) -> Any:
        """Return the sine of one number."""
        return np.sin(x) if self.context is None else self.context.sin(x)

    def sqrt(self, x: Any) -> Any:
        """Return the square root of one number."""
        return np.sqrt(x) if self.context is None else self.context.sqrt(x)

    def unit(self, x: ArrayLike) -> Array:
        """Divide a vector by its length, so that it has length 1 to the last digit.

        Examples
        --------
        >>> Arithmetic(np.dtype(np.float64)).unit([3, 0, 4])
        array([0.6, 0. , 0.8])
        """
        given = self.array(x)
        scaled = given / abs(given).max()  # its square below neither overflows nor vanishes
        unit: Array = scaled / self.sqrt((scaled * scaled).sum())
        return unit

    def rotation(self, R: ArrayLike, whose: str) -> Array:
        """Make a matrix that is a rotation to double precision one to the last digit.

        Newton's step R ← R (3·1 − RᵀR) / 2 doubles the number of digits to which RᵀR is 1. It is
        repeated until rounding leaves nothing to gain.

        Raises
        ------
        ModelError
            If `R` is no rotation to start with.
        """
        rotation, one = self.array(R), self.identity()
        defect = abs(rotation.mT @ rotation - one).max()
        if not defect < 1e-3:
            raise ModelError(f"{whose}: its placement is no rotation, RᵀR is off 1 by {float(defect):.3g}")
        while True:
            nearer = rotation @ (3 * one - rotation.mT @ rotation) / 2
            left = abs(nearer.mT @ nearer - one).max()
            if not left < defect:
                return rotation
            rotation, defect = nearer, left


@dataclass(frozen=True)
class State:
    """What a function of this package was called with, checked, in one kind of number; zeros where nothing came."""

    model: Any
    number: Arithmetic
    q: Array
    v: Array
    a: Array
    tau: Array
    f_ext: Array


def take(model: Any, **given: ArrayLike | None) -> State:
    """Check the arguments of a call, and make them arrays of one kind of number.

    Parameters
    ----------
    model : Model
    **given : array_like or None
        `q`, and as needed `v`, `a`, `tau`, `f_ext`; None stands for zeros.

    Returns
    -------
    State
        mpmath's numbers win over NumPy's.

    Raises
    ------
    TypeError
        If `model` is none.
    ShapeError
        If an argument is not that of one state of this model.
    ValueError
        If an argument is not numeric, not finite, or a wrench on the world.
    """
    if not hasattr(model, "joint_names") or hasattr(model, "laws"):  # joints that follow others are not known here
        raise no_model(model)
    shapes = {"q": (model.nq,), "v": (model.nv,), "a": (model.nv,), "tau": (model.nv,), "f_ext": (model.nbodies, 6)}
    came = {name: _as_array(value, name) for name, value in given.items() if value is not None}
    for name, x in came.items():
        if x.shape != shapes[name]:
            raise ShapeError(f"{name}: expected shape {shapes[name]}, got {x.shape}{_hint(model, name, x)}")
    if "f_ext" in came and (came["f_ext"][0] != 0).any():
        raise ValueError("f_ext: row 0 is the world's, which no wrench moves; expected zeros")
    number, arrays = _common(came)
    zeros = {name: number.zeros(*shape) for name, shape in shapes.items() if name not in arrays}
    return State(model, number, **arrays, **zeros)


def _common(came: dict[str, Array]) -> tuple[Arithmetic, dict[str, Array]]:
    """Convert all arguments to the one kind of number that holds them all."""
    entries = (entry for x in came.values() if x.dtype == object for entry in x.flat)
    context = next((entry.context for entry in entries if hasattr(entry, "context")), None)
    if context is None:
        converted = as_arrays(**{name: (x, x.shape) for name, x in came.items()})
        return Arithmetic(converted[0].dtype), dict(zip(came, converted, strict=True))
    number = Arithmetic(np.dtype(object), context)
    arrays = {}
    for name, x in came.items():
        try:
            arrays[name] = number.array(x)
        except (TypeError, ValueError):
            raise ValueError(f"{name}: expected numbers of mpmath or NumPy, got others as well") from None
        if not all(context.isfinite(entry) for entry in arrays[name].flat):
            raise ValueError(f"{name}: expected finite numbers")
    return number, arrays


def _as_array(value: ArrayLike, name: str) -> Array:
    try:
        return np.asanyarray(value)  # a mask stays, for `as_arrays` to refuse
    except ValueError:
        raise ShapeError(f"{name}: expected a rectangular array, got rows of different lengths") from None


def _hint(model: Any, name: str, x: Array) -> str:
    """Say what was probably meant."""
    if x.ndim > (2 if name == "f_ext" else 1):
        return "; this package takes one state per call: loop over a batch"
    if name == "q" and x.shape == (model.nv,):
        return f"; this looks like nv; q has nq = {model.nq}"
    if name in ("v", "a", "tau") and x.shape == (model.nq,):
        return f"; this looks like nq; {name} has nv = {model.nv}"
    return ""
