"""The number types of the studies: NumPy's three, pairs of doubles, and decimal digits of mpmath."""

from functools import cache
from typing import Any

import numpy as np

from twistwrench.arrays import Array, resolution

HARDWARE = ("float32", "float64")  # those of LAPACK, and with it of numpy.linalg
FLOATS = (*HARDWARE, "longdouble") if resolution(np.longdouble) < resolution(np.float64) else HARDWARE  # as on Windows
PAIRS = "double-double"  # of compiled programs: 32 digits, the sum of two doubles
DIGITS = ("20 digits", "50 digits")
TRUTH = "60 digits"  # more than any way has, so that each has an error to show


@cache
def digits(number: int) -> Any:
    """Return an mpmath context of that many digits: of our own, so that nobody else's changes."""
    from mpmath import MPContext

    context = MPContext()
    context.dps = number
    return context


def convert(x: Array, number: str) -> Array:
    """Turn numbers into those of a type. One double is a pair already, whose second number is zero.

    >>> print(convert(np.array([0.1]), "20 digits")[0])
    0.10000000000000000555
    """
    if not number.endswith("digits"):
        return x.astype(np.float64 if number == PAIRS else number)
    context = digits(int(number.split()[0]))
    return np.asarray(np.frompyfunc(lambda y: +context.convert(y), 1, 1)(x), object)


def sum_of_pair(pair: tuple[Array, Array]) -> Array:
    """Turn pairs of doubles into mpmath numbers, which hold their sum.

    >>> print(sum_of_pair((np.array([1.0]), np.array([2.0**-70])))[0] - 1 == 2.0**-70)
    True
    """
    return np.asarray(convert(pair[0], TRUTH) + convert(pair[1], TRUTH))


def as_long_double(x: Array) -> Array:
    """Round mpmath numbers to long doubles."""
    high = x.astype(np.float64)
    return np.asarray(high.astype(np.longdouble) + (x - high).astype(np.float64))
