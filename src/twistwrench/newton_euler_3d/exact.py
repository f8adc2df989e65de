"""Fractions and symbols as the numbers of a call (49.1): nothing is rounded, and symbols need no value."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, elementary, exact_numbers, exact_unit
from .arithmetic import Arithmetic

__all__ = ["Exact"]


@dataclass(frozen=True)
class Exact(Arithmetic):
    """Fractions, SymPy's expressions and the like; the model's doubles become exact fractions, beside symbols decimals.

    Examples
    --------
    >>> Exact(np.dtype(object)).array([0.5])
    array([Fraction(1, 2)], dtype=object)
    """

    exact = True

    @property
    def eps(self) -> int:
        """Zero: these numbers are not rounded."""
        return 0

    def array(self, values: ArrayLike) -> Array:
        """Turn constants into fractions."""
        return exact_numbers(np.asarray(values), "constant", self.dtype)

    def cos(self, x: Any) -> Any:
        """Return the cosine of one number: of fractions, only that of 0 is a fraction."""
        return elementary("cos", x, self.dtype)

    def sin(self, x: Any) -> Any:
        """Return the sine of one number."""
        return elementary("sin", x, self.dtype)

    def sqrt(self, x: Any) -> Any:
        """Return the square root of one number: of fractions, only that of a square is a fraction."""
        return elementary("sqrt", x, self.dtype)

    def nothing(self, x: Any, least: Any) -> bool:
        """Return whether a number is zero, as `least` is here; for an expression SymPy decides."""
        equals = getattr(x, "equals", None)
        return bool(equals(least) if equals else x == least)

    def unit(self, x: ArrayLike) -> Array:
        """Divide a vector by its length; doubles become the nearest fractions of length 1."""
        given = np.asarray(x)
        if given.dtype != object:
            return exact_unit(self.array(given / np.sqrt((given * given).sum())))
        unit: Array = given / self.sqrt((given * given).sum())
        return unit

    def rotation(self, R: ArrayLike, whose: str) -> Array:
        """Return the fractions of a rotation next to one of doubles: those that its quaternion gives."""
        double = Arithmetic(np.dtype(np.float64)).rotation(R, whose)
        whole = double.round()
        if abs(double - whole).max() < 1e-15:
            return self.array(whole)
        (a, b, c), (d, e, f), (g, h, i) = double
        squares = np.array(  # 4 q qᵀ: each row is a multiple of the quaternion
            [
                [1 + a - e - i, b + d, c + g, h - f],
                [b + d, 1 - a + e - i, f + h, c - g],
                [c + g, f + h, 1 - a - e + i, d - b],
                [h - f, c - g, d - b, 1 + a + e + i],
            ]
        )
        return self.quaternion(self.array(squares[squares.diagonal().argmax()]))

    def quaternion(self, xyzw: Array) -> Array:
        """Return the turn by a quaternion of any length."""
        R: Array = super().quaternion(xyzw) / (xyzw * xyzw).sum()
        return R
