"""The number types of the study: NumPy's three, pairs of doubles, and decimal digits of mpmath."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from twistwrench.arrays import Array, resolution

__all__ = ["DIGITS", "FLOATS", "HARDWARE", "PAIRS", "TRUTH"]
__all__ += ["as_long_double", "convert", "digits", "epsilon", "exactly", "sum_of_pair"]

HARDWARE = ("float32", "float64")
"""The number types of LAPACK, and with it of numpy.linalg."""

FLOATS = (*HARDWARE, "longdouble") if resolution(np.longdouble) < resolution(np.float64) else HARDWARE
"""Without long doubles where they are doubles by another name, as on Windows."""

PAIRS = "double-double"
"""Of compiled programs: 32 digits, the sum of two doubles."""

DIGITS = ("20 digits", "50 digits")
TRUTH = "60 digits"
"""More than any way has, so that each has an error to show."""


@cache
def digits(number: int) -> Any:
    """Return an mpmath context of that many digits: of our own, so that nobody else's changes."""
    from mpmath import MPContext

    context = MPContext()
    context.dps = number
    return context


def exactly(x: Array, context: Any) -> Array:
    """Turn doubles into the same numbers of an mpmath context."""
    return np.asarray(np.frompyfunc(lambda y: context.mpf(float(y)), 1, 1)(x), object)


def convert(x: Array, number: str) -> Array:
    """Turn doubles into a number type of this study. One double is a pair already, whose second number is zero.

    Examples
    --------
    >>> convert(np.array([0.1]), "float32").dtype
    dtype('float32')
    >>> print(convert(np.array([0.1]), "20 digits")[0])
    0.10000000000000000555
    """
    if number.endswith("digits"):
        return exactly(x, digits(int(number.split()[0])))
    return x.astype(np.float64 if number == PAIRS else number)


def sum_of_pair(pair: tuple[Array, Array]) -> Array:
    """Turn pairs of doubles into mpmath numbers, which hold their sum.

    Examples
    --------
    >>> print(sum_of_pair((np.array([1.0]), np.array([2.0**-70])))[0] - 1 == 2.0**-70)
    True
    """
    hi, lo = (convert(part, TRUTH) for part in pair)
    total: Array = hi + lo
    return total


def as_long_double(x: Array) -> Array:
    """Round mpmath numbers to long doubles."""
    high = x.astype(np.float64)
    return np.asarray(high.astype(np.longdouble) + (x - high).astype(np.float64))


def epsilon(number: str) -> float:
    """Return the spacing of a type's numbers next to 1.

    Examples
    --------
    >>> epsilon("float64"), epsilon("20 digits") < 1e-19, epsilon("double-double") < 1e-31
    (2.220446049250313e-16, True, True)
    """
    if number.endswith("digits"):
        return float(digits(int(number.split()[0])).eps)
    if number == PAIRS:
        return 2.0**-105  # the roundings of hi and of lo: 53 binary digits each, and a sign
    return resolution(np.dtype(number))
