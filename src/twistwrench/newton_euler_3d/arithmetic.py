"""Which numbers a call works in, and the little that depends on it (49.1).

The formulas of this package are sums and products, and those mean the same for every kind of
number. Four things do not: a constant of the model must first *become* such a number, and sine,
cosine and square root belong to it. `Arithmetic` holds those four, and nothing else here knows
whether it computes in double precision or in fifty digits.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..checks import Array, as_arrays, resolution
from ..errors import ModelError, ShapeError

__all__ = ["Arithmetic", "take"]


@dataclass(frozen=True)
class Arithmetic:
    """One kind of number: NumPy's (`context` is None), or mpmath's with its `context`.

    An mpmath number carries its context with it, and the context carries the functions and the
    number of digits: so mpmath is never imported here.
    """

    dtype: np.dtype[Any]
    context: Any = None

    @property
    def eps(self) -> Any:
        """Spacing of the numbers next to 1."""
        return resolution(self.dtype) if self.context is None else self.context.eps

    def array(self, values: ArrayLike) -> Array:
        """Turn constants into these numbers, each exactly: a double has an exact 50-digit twin."""
        if self.context is None:
            return np.array(values, self.dtype)
        given = np.asarray(values)
        out = np.empty(given.shape, object)
        out.flat = [self.context.convert(x) for x in given.flat]
        return out

    def zeros(self, *shape: int) -> Array:
        """Return zeros of these numbers."""
        return self.array(np.zeros(shape))

    def cos(self, x: Any) -> Any:
        """Return the cosine of one number."""
        return np.cos(x) if self.context is None else self.context.cos(x)

    def sin(self, x: Any) -> Any:
        """Return the sine of one number."""
        return np.sin(x) if self.context is None else self.context.sin(x)

    def unit(self, x: ArrayLike) -> Array:
        """Divide a vector by its length, so that it has length 1 to the last digit of these numbers."""
        x = self.array(x)
        square = (x * x).sum()
        return x / (np.sqrt(square) if self.context is None else self.context.sqrt(square))

    def rotation(self, R: ArrayLike, whose: str) -> Array:
        """Make a rotation that holds to double precision hold to the last digit of these numbers.

        Newton's step R ← R (3·1 − RᵀR) / 2 doubles the number of right digits of RᵀR = 1; it stops
        when rounding leaves nothing to gain.

        Raises
        ------
        ModelError
            If `R` is not a rotation to start with.
        """
        R = self.array(R)
        one = self.array(np.eye(3))
        defect = abs(R.T @ R - one).max()
        if not defect < 1e-3:
            raise ModelError(f"{whose}: its placement is no rotation, RᵀR differs from 1 by {float(defect):.3g}")
        while True:
            better = R @ (3 * one - R.T @ R) / 2
            left = abs(better.T @ better - one).max()
            if not left < defect:
                return R
            R, defect = better, left


LETTERS = {"q": "nq", "v": "nv", "a": "nv", "tau": "nv"}


def take(model: Any, **given: ArrayLike | None) -> tuple[Any, ...]:
    """Check the arguments of a call, and make them arrays of one kind of number.

    Parameters
    ----------
    model : Model
    **given : array_like or None
        `q`, `v`, `a`, `tau` and `f_ext`, by name; None stands for zeros.

    Returns
    -------
    tuple
        The `Arithmetic`, then the arguments in their order.

    Raises
    ------
    ShapeError
        If an argument is not one state of this model.
    ValueError
        If an argument is not numeric, or not finite.
    """
    shapes = {name: (getattr(model, n),) for name, n in LETTERS.items()} | {"f_ext": (model.nbodies, 6)}
    came = {name: _as_array(value, name) for name, value in given.items() if value is not None}
    for name, x in came.items():
        if x.shape != shapes[name]:
            raise ShapeError(f"{name}: expected shape {shapes[name]}, got {x.shape}{_hint(model, name, x)}")
    number, arrays = _common(came)
    return number, *(arrays[name] if name in arrays else number.zeros(*shapes[name]) for name in given)


def _common(came: dict[str, Array]) -> tuple[Arithmetic, dict[str, Array]]:
    """Find the kind of number that holds all arguments: mpmath's as soon as one of them is."""
    contexts = [getattr(x, "context", None) for array in came.values() if array.dtype == object for x in array.flat]
    if not any(contexts):
        converted = as_arrays(**{name: (x, x.shape) for name, x in came.items()})
        return Arithmetic(converted[0].dtype), dict(zip(came, converted, strict=True))
    context = next(c for c in contexts if c is not None)
    number = Arithmetic(np.dtype(object), context)
    arrays = {}
    for name, x in came.items():
        try:
            arrays[name] = number.array(x)
        except (TypeError, ValueError):
            raise ValueError(f"{name}: expected mpmath numbers throughout") from None
        if not all(context.isfinite(entry) for entry in arrays[name].flat):
            raise ValueError(f"{name}: expected finite numbers")
    return number, arrays


def _as_array(value: ArrayLike, name: str) -> Array:
    try:
        return np.asarray(value)
    except ValueError:
        raise ShapeError(f"{name}: expected a rectangular array, got rows of different lengths") from None


def _hint(model: Any, name: str, x: Array) -> str:
    """Say what was probably meant."""
    if x.ndim > (2 if name == "f_ext" else 1):
        return ": one state per call here, loop over a batch"
    if name == "q" and x.shape == (model.nv,):
        return f": this looks like nv; q has nq = {model.nq}"
    if name in LETTERS and name != "q" and x.shape == (model.nq,):
        return f": this looks like nq; {name} has nv = {model.nv}"
    return ""
