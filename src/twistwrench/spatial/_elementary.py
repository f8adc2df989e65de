"""Functions of one number that the rotations need, each good to the last few bits everywhere.

All are analytic: a complex argument gives the complex value, so that a complex step differentiates
what is built on them. The real part alone decides which formula is used. Numbers that are objects, as a program's
recorder passes them, cannot be asked how large they are, but they write down a choice: both formulas are computed.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

from ..arrays import Array, elementary, resolution

__all__ = [
    "at_first_index",
    "atan2",
    "chosen",
    "cos",
    "cosine_defect",
    "largest",
    "length",
    "nonzero",
    "sin",
    "sinc",
    "sine_defect_root",
    "sqrt",
]


TINY = Fraction(1, 2**120)
"""What is added to the square of a recorded length, which nobody can ask whether it is 0. A function of an angle that
is even does not change by it in its last digit, up to long doubles of 113 bits; and a float32 can hold it."""


def cos(x: Array) -> Array:
    """Return the cosine of each entry, of any number type: see `exact.elementary`."""
    return np.cos(x) if x.dtype != object else _map(x, "cos")


def sin(x: Array) -> Array:
    """Return the sine of each entry, of any number type: see `exact.elementary`."""
    return np.sin(x) if x.dtype != object else _map(x, "sin")


def sqrt(x: Array) -> Array:
    """Return the square root of each entry, of any number type: see `exact.elementary`."""
    return np.sqrt(x) if x.dtype != object else _map(x, "sqrt")


def _map(x: Array, name: str) -> Array:
    """Apply an elementary function to each object of an array, which stays an array where it has no axis."""
    values = np.empty(x.shape, object)
    for k in np.ndindex(x.shape):
        values[k] = elementary(name, x[k], x.dtype)
    return values


def length(x: Array) -> Array:
    """Return the Euclidean length over the last axis, no conjugate: infinite only where it is beyond all numbers.

    Of numbers that are objects it is never 0, but at least the root of `TINY`.
    """
    if x.dtype == object:
        return sqrt(np.asarray((x * x).sum(-1) + TINY, object))
    size = np.maximum(largest(x.real, 1), largest(x.imag, 1))
    exponent = np.frexp(np.maximum(size, np.finfo(x.dtype).tiny))[1] - 1
    unit = np.ldexp(np.ones((), size.dtype), exponent)  # a power of two: dividing by it is exact
    scaled = x / unit[..., None]
    with np.errstate(over="ignore"):
        return np.asarray(unit * np.sqrt((scaled * scaled).sum(-1)))


def nonzero(x: Array) -> Array:
    """Return lengths, 1 where they are 0: what they divide is 0 there. Of objects they never are, see `length`."""
    return x if x.dtype == object else np.where(x == 0, 1, x)


def chosen(x: Array, a: Array, b: Array) -> Array:
    """Return a where x, or its real part, is above 0, and b elsewhere; numbers that are objects write that down."""
    if x.dtype != object:
        return np.where(x.real > 0, a, b)
    return np.asarray(np.frompyfunc(_chosen, 3, 1)(x, a, b), object)


def _chosen(x: Any, a: Any, b: Any) -> Any:
    if hasattr(x, "select"):
        return x.select(a, b)
    return a if x > 0 else b


def sinc(x: Array) -> Array:
    """Return sin x / x, and 1 at 0; of objects x is a `length`."""
    if x.dtype == object:
        return np.asarray(sin(x) / x, object)
    safe = np.where(x == 0, 1, x)
    return np.where(x == 0, 1, np.sin(safe) / safe)


def sine_defect_root(x: Array) -> Array:
    """Return √((x − sin x)/x³), which is √⅙ at 0: its series below 1, where the difference would cancel.

    The root, about 1/x, since the quotient itself is lost where x³ overflows.
    """
    small, near, far = _parted(x)
    return chosen(small, sqrt(series(near, 4, 5, resolution(x.dtype)) / 6), sqrt((far - sin(far)) / far) / far)


def cosine_defect(x: Array) -> Array:
    """Return (sin x − x cos x)/x³, which is 1/3 at 0: its series below 1, where the difference would cancel."""
    small, near, far = _parted(x)
    return chosen(small, series(near, 2, 5, resolution(x.dtype)) / 3, (sin(far) - far * cos(far)) / (far * far * far))


def _parted(x: Array) -> tuple[Array, Array, Array]:
    """Return what is above 0 where |x| < 1, and x for the two formulas, a harmless number where it is the other's."""
    small = 1 - (x if x.dtype == object else np.abs(x.real))
    return small, chosen(small, x, np.zeros_like(x)), chosen(small, np.ones_like(x), x)


def series(x: Array, a: int, b: int, eps: float) -> Array:
    """Return 1 − x²/(a b) (1 − x²/((a+2)(b+2)) (1 − ...)) for |x| ≤ 1, with all terms that reach a quarter of eps."""
    terms, left = 0, 1.0
    while left > eps / 4 or terms < 15:
        left = left / ((a + 2 * terms) * (b + 2 * terms))
        terms = terms + 1
    total = np.ones_like(x)
    for k in range(2 * terms - 2, -1, -2):
        total = 1 - x * x / ((a + k) * (b + k)) * total
    return total


def atan2(s: Array, c: Array) -> Array:
    """Return the angle of the point (c, s).

    NumPy has no complex arctan2. Here the value comes from the real parts, and the imaginary part is the
    first-order change (c ds − s dc)/(c² + s²), which is all that a complex step needs.
    """
    if s.dtype.kind != "c":
        return np.asarray(np.arctan2(s, c), s.dtype)
    change = (c.real * s.imag - s.real * c.imag) / (c.real**2 + s.real**2)
    return np.asarray(np.arctan2(s.real, c.real) + 1j * change)


def largest(x: Array, axes: int) -> Array:
    """Return the largest magnitude over that many last axes of a real array."""
    return np.asarray(np.abs(x).max(axis=tuple(range(-axes, 0))))


def at_first_index(wrong: Array) -> str:
    """Return which item of a batch is wrong, or an empty string where there is only one."""
    return f" at index {tuple(int(k) for k in np.argwhere(wrong)[0])}" if wrong.ndim else ""
