"""sin and cos of as many angles at once as a register holds, within a rounding or two of the true values.

The libraries that know sin and cos take one number at a time, and for a Go2 that would be half of the time of `rnea`.
So x is brought near 0 by a multiple k of π/2, in three parts so that no digit is lost; sin and cos of the rest are
series; and the quadrant, k modulo 4, tells which of the two is which, and its sign.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import cache

import numpy as np

from .instructions import Text

__all__ = ["PI", "sine_and_cosine"]

PI = Fraction("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803482534211706798")
"""π to 100 digits."""

TERMS = {"double": 9, "float": 6}
"""So many terms of the series reach the last digit for |x| ≤ π/4."""


def sine_and_cosine(text: Text, x: str) -> tuple[str, str]:
    """Write the instructions for sin x and cos x, and return the names of the two."""
    k = text.operate("round", text.operate("mul", x, text.constant(2 / PI)))
    minus = text.operate("neg", k)
    for part in half_pi(text.scalar):
        x = text.operate("fma", minus, text.constant(part), x)
    near = series(text, x)
    return quadrant(text, k, *near)


def series(text: Text, x: str) -> tuple[str, str]:
    """Write sin x = x + x³ s(x²) and cos x = 1 − x²/2 + x⁴ c(x²) for |x| ≤ π/4."""
    terms, square = TERMS[text.scalar], text.operate("mul", x, x)
    s, c = (text.constant(_coefficient(2 * terms + k)) for k in (1, 0))
    for n in range(terms - 1, 0, -1):
        s = text.operate("fma", s, square, text.constant(_coefficient(2 * n + 1)))
    for n in range(terms - 1, 1, -1):
        c = text.operate("fma", c, square, text.constant(_coefficient(2 * n)))
    sine = text.operate("fma", text.operate("mul", s, square), x, x)
    half = text.operate("mul", square, text.constant(0.5))
    most = text.operate("sub", text.constant(1), half)
    lost = text.operate("sub", text.operate("sub", text.constant(1), most), half)  # what 1 − x²/2 was rounded by
    cosine = text.operate("add", most, text.operate("fma", text.operate("mul", c, square), square, lost))
    return sine, cosine


def quadrant(text: Text, k: str, sine: str, cosine: str) -> tuple[str, str]:
    """Write sin and cos of k π/2 + x from those of x. Nothing is rounded: one product of each two is 0."""
    turns = text.operate("round", text.operate("mul", k, text.constant(0.25)))
    k = text.operate("sub", k, text.operate("mul", turns, text.constant(4)))  # from −2 to 2
    size = text.operate("abs", k)
    c = text.operate("sub", text.constant(1), size)
    s = text.operate("mul", k, text.operate("sub", text.constant(2), size))
    cc, ss, cs, sc = (text.operate("mul", a, b) for a, b in ((c, cosine), (s, sine), (c, sine), (s, cosine)))
    return text.operate("add", cs, sc), text.operate("sub", cc, ss)


def _coefficient(n: int) -> Fraction:
    """Return the coefficient of xⁿ in the series of sin (n odd) or cos (n even)."""
    return Fraction((-1) ** (n // 2), math.factorial(n))


@cache
def half_pi(scalar: str) -> tuple[Fraction, ...]:
    """Return π/2 as the sum of three numbers of a type."""
    parts: list[Fraction] = []
    for _ in range(3):
        left = float(PI / 2 - sum(parts))
        parts.append(Fraction(left if scalar == "double" else float(np.float32(left))))
    return tuple(parts)
