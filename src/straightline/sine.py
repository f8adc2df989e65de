"""sin and cos of as many angles at once as a register holds, within a rounding or two of the true values.

The libraries that know sin and cos take one number at a time, which would be half of the time of many a line.
So x is brought near 0 by a multiple k of π/2, in three parts so that no digit is lost; sin and cos of the rest are
series; and the quadrant, k modulo 4, tells which of the two is which, and its sign.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from .line import Line, rewritten
from .number import Number

__all__ = ["KIND", "PI", "SINE_ROUNDINGS", "known_sines", "quarter_turns", "split", "with_series"]

PI = Fraction("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803482534211706798")
"""π to 100 digits."""

TERMS = {"double": 9, "float": 6}  # so many terms of the series reach the last digit for |x| ≤ π/4
KIND: dict[str, type[np.floating[Any]]] = {"double": np.float64, "float": np.float32}

SINE_ROUNDINGS = Fraction(4)
"""No sine or cosine of `with_series` is off by more than 4 u of itself, for angles up to 2¹⁷ rad.

The first difference x − k π/2 rounds nothing, since what is left has no digit below those of x and of π/2. The other
two round once each, and what they leave out is less than u/100 of the rest, since no number of the type is closer to a
multiple of π/2 (the tests try all). With |x| ≤ 0.81 afterwards, that makes 2.3 u of a sine and 1.7 u of a cosine; the
series, whose last operation rounds once, and the others a tenth of the result, makes 1.5 u and 2 u.
"""


def with_series(line: Line, scalar: str) -> Line:
    """Return a line for "double" or "float" in which sin and cos are arithmetic, with a b + c in one rounding."""

    def sine(x: Number) -> Any:
        (c, s), (sine, cosine) = near_zero(x, scalar)
        return c * sine + s * cosine

    def cosine(x: Number) -> Any:
        (c, s), (sine, cosine) = near_zero(x, scalar)
        return c * cosine - s * sine

    return rewritten(line, {"sin": sine, "cos": cosine})


def near_zero(x: Number, scalar: str) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
    """Write cos and sin of k π/2, and sin and cos of x − k π/2, with k such that this is at most π/4."""
    k = x.tape.apply("round", x * (2 / PI))
    for part in split(PI / 2, 3, KIND[scalar]):
        x = x.tape.apply("fma", -k, part, x)
    return quarter_turns(k), series(x, TERMS[scalar])


def series(x: Number, terms: int) -> tuple[Any, Any]:
    """Write sin x = x + x³ s(x²) and cos x = 1 − x²/2 + x⁴ c(x²)."""
    fma, square = partial(x.tape.apply, "fma"), x * x
    s: Any = _coefficient(2 * terms + 1)
    c: Any = _coefficient(2 * terms)
    for n in range(terms - 1, 0, -1):
        s = fma(s, square, _coefficient(2 * n + 1))
    for n in range(terms - 1, 1, -1):
        c = fma(c, square, _coefficient(2 * n))
    most = 1 - square / 2
    lost = (1 - most) - square / 2  # what 1 − x²/2 was rounded by
    return fma(s * square, x, x), most + fma(c * square, square, lost)


def known_sines(x: Number, dtype: np.dtype[Any]) -> tuple[Any, Any, Fraction, Fraction]:
    """Write sin x and cos x without a b + c in one rounding, for angles up to 2¹⁷ rad, and return r and e.

    They are off by at most r u of themselves and e. The parts of π/2 are so short that k times one of them rounds
    nothing, and neither does a difference, as long as what is left has digits for it. At most five round, which makes
    1.1 u of the sine each; the series makes less than 2 u of a sine, 4 u of a cosine.
    """
    digits, double = np.finfo(dtype).nmant + 1, dtype == np.float64
    k, left = x.tape.apply("round", x * (2 / PI)), PI / 2
    for _ in range(3 if double else 9):
        step = Fraction(2) ** (math.frexp(float(left))[1] - (digits - 18))  # k has 17 digits
        part = round(left / step) * step
        left, x = left - part, x - k * part
    square, terms = x * x, TERMS["double" if double else "float"]
    sine: Any = _coefficient(2 * terms + 1)
    cosine: Any = _coefficient(2 * terms)
    for n in range(terms - 1, 0, -1):
        sine, cosine = sine * square + _coefficient(2 * n + 1), cosine * square + _coefficient(2 * n)
    sine, cosine = x + x * (square * sine), 1 + square * cosine
    c, s = quarter_turns(k)
    return c * sine + s * cosine, c * cosine - s * sine, Fraction(8), Fraction(1, 2 ** (86 if double else 35))


def quarter_turns(k: Number) -> tuple[Any, Any]:
    """Write cos and sin of k π/2: one of them is 0, the other ±1, so that products with them round nothing."""
    k = k - 4 * k.tape.apply("round", k / 4)  # from −2 to 2
    size = k.tape.apply("abs", k)
    return 1 - size, k * (2 - size)


def _coefficient(n: int) -> Fraction:
    """Return the coefficient of xⁿ in the series of sin (n odd) or cos (n even)."""
    return Fraction((-1) ** (n // 2), math.factorial(n))


def split(x: Fraction, parts: int = 2, kind: type[np.floating[Any]] = np.float64) -> tuple[Fraction, ...]:
    """Return the number of a type that is nearest to x, the one nearest to what is left, and so on."""
    found: list[Fraction] = []
    for _ in range(parts):
        found.append(Fraction(float(kind(float(x - sum(found))))))
    return tuple(found)
