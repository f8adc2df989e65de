"""sin and cos of a pair of doubles, to all digits, for angles up to 2⁴⁵ rad.

The angle is brought near 0 by a multiple k of π/2, of which 159 bits are subtracted. An eighth of what is left has a
short series for sin and for 1 − cos, and is doubled three times by sin 2y = 2 sin y (1 − (1 − cos y)) and
1 − cos 2y = 2 sin² y: there 1 − cos keeps the digits that cos itself would lose. The quadrant, k modulo 4, is
arithmetic too: one of cos (k π/2) and sin (k π/2) is 0, the other ±1.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from .pairs import NOTHING, Pair, Pairs, split, two_sum
from .sine import PI

__all__ = ["LARGEST_ANGLE", "SINE_ERROR", "sine_and_cosine_of_pair"]

LARGEST_ANGLE = 2**45
"""rad. Of larger ones sin and cos are not numbers."""

SINE_ERROR = Fraction(1, 2**99)
"""No sine or cosine of a pair is further off: 128 roundings of 2⁻¹⁰⁶, where all steps together make less than 60."""

HALVINGS = 3
SERIES = 9, 5
"""Terms of the series, and how many of them need a pair; what is left out is below 2⁻¹¹⁷."""


def sine_and_cosine_of_pair(pairs: Pairs, x: Pair) -> tuple[Pair, Pair]:
    """Write sin x and cos x."""
    k, y = _reduced(pairs, x)
    y = Pair(y.hi / 2**HALVINGS, y.lo / 2**HALVINGS)
    square = pairs.multiply(y, y)
    third = pairs.multiply(pairs.multiply(square, _series(pairs, square, 3)), y)
    sine = pairs.add_smaller(y, pairs.negative(third))
    less = pairs.multiply(square, _series(pairs, square, 2))  # 1 − cos y
    for _ in range(HALVINGS):
        sine, less = _doubled(pairs, sine, less), pairs.multiply(Pair(2 * sine.hi, 2 * sine.lo), sine)
    cosine = pairs.add_smaller(pairs.constant(Fraction(1)), pairs.negative(less))
    return _turned(pairs, k, sine, cosine)


def _doubled(pairs: Pairs, sine: Pair, less: Pair) -> Pair:
    """Write sin 2y = 2 sin y − 2 sin y (1 − cos y)."""
    twice = Pair(2 * sine.hi, 2 * sine.lo)
    return pairs.add_smaller(twice, pairs.negative(pairs.multiply(twice, less)))


def _reduced(pairs: Pairs, x: Pair) -> tuple[Any, Pair]:
    """Write k, the whole number next to 2 x / π, and x − k π/2. The first difference rounds nothing."""
    inside = (LARGEST_ANGLE - pairs.tape.apply("abs", x.hi)).sqrt()
    nothing = pairs.tape.apply("sub", inside, inside)  # or not a number
    k = pairs.tape.apply("round", x.hi * split(2 / PI)[0]) + nothing
    first, second, third = split(PI / 2, 3)
    p, e = pairs.two_product(k, first)
    rest, last = pairs.two_product(k, second)
    left = pairs.add(Pair(*two_sum(x.hi - p, -e)), Pair(-rest, -last))
    return k, pairs.add(left, Pair(*two_sum(x.lo, -(k * third))))


def _series(pairs: Pairs, square: Pair, start: int) -> Pair:
    """Write 1/start! − y²/(start + 2)! + …: the last terms in doubles, then in pairs."""
    terms, exact = SERIES
    coefficients = [Fraction((-1) ** n, math.factorial(start + 2 * n)) for n in range(terms)]
    tail: Any = split(coefficients[-1])[0]
    for c in reversed(coefficients[exact:-1]):
        tail = tail * square.hi + split(c)[0]
    value = Pair(tail, NOTHING)
    for c in reversed(coefficients[:exact]):
        value = pairs.add_smaller(pairs.constant(c), pairs.multiply(square, value))
    return value


def _turned(pairs: Pairs, k: Any, sine: Pair, cosine: Pair) -> tuple[Pair, Pair]:
    """Write sin and cos of k π/2 + y from those of y. Nothing is rounded: one product of each two is 0."""
    k = k - 4 * pairs.tape.apply("round", k / 4)  # from −2 to 2
    size = pairs.tape.apply("abs", k)
    c, s = 1 - size, k * (2 - size)
    return (
        Pair(c * sine.hi + s * cosine.hi, c * sine.lo + s * cosine.lo),
        Pair(c * cosine.hi - s * sine.hi, c * cosine.lo - s * sine.lo),
    )
