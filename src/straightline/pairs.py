"""Arithmetic with pairs of doubles, hi + lo: 32 digits, from the operations that a processor has.

The rounding error of a sum of two doubles is a double itself, and so is that of a product. So a number is kept as the
double nearest to it and what is left, and each operation on such pairs is a few on doubles. With u = 2⁻⁵³ the relative
error is at most 3u² for a sum, 5u² for a product (7u² without fma), 15u² for a quotient and 4u²
for a root: Joldes, Muller, Popescu, *Tight and rigorous error bounds for basic building blocks of double-word
arithmetic* (2017), and Lefèvre et al., *Accurate calculation of Euclidean norms using double-word arithmetic* (2023).

Nothing of it may be simplified as if it were exact: (a + b) − a is not b, but what is left of it.

For sin and cos the angle is brought near 0 by a multiple k of π/2, of which 159 bits are subtracted. An eighth of what
is left has a short series for sin and for 1 − cos, and is doubled three times by sin 2y = 2 sin y (1 − (1 − cos y)) and
1 − cos 2y = 2 sin² y: there 1 − cos keeps the digits that cos itself would lose. The quadrant is
that of `sine`.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any, NamedTuple

from .number import Number, Tape, is_power_of_two
from .sine import PI, quarter_turns, split

__all__ = ["EACH", "NOTHING", "OPERATIONS", "SINE_ERROR", "Pair", "Pairs", "two_sum"]

EACH = Fraction(16, 2**106)  # no operation on pairs has a larger relative error
SPLITTER = 2**27 + 1  # times a double, it parts the upper 26 bits from the lower ones
OPERATIONS = ("add", "sub", "mul", "div", "neg", "sqrt", "sin", "cos")  # what there is on pairs

NOTHING = Fraction(0)

LARGEST_ANGLE = 2**45  # rad. Of larger ones sin and cos are not numbers.

SINE_ERROR = Fraction(1, 2**99)
"""No sine or cosine of a pair is further off: 128 roundings of 2⁻¹⁰⁶, where all steps together make less than 60."""

HALVINGS = 3
SERIES = 9, 5  # terms of the series, and how many of them need a pair; what is left out is below 2⁻¹¹⁷


class Pair(NamedTuple):
    """Two numbers whose sum is meant; where they are constants, fractions that are doubles."""

    hi: Any
    lo: Any


class Pairs:
    """Writes operations on pairs to a tape, as operations on doubles.

    Without `fma`, an operation a b + c with one rounding, factors are split in halves.
    """

    def __init__(self, tape: Tape, *, fma: bool) -> None:
        self.tape, self.fma = tape, fma

    def constant(self, x: Fraction) -> Pair:
        """Return a constant to all digits of a pair."""
        return Pair(*split(x))

    def neg(self, a: Pair) -> Pair:
        """Return −a."""
        return Pair(-a.hi, -a.lo)

    def add(self, a: Pair, b: Pair) -> Pair:
        """Return a + b."""
        s, e = two_sum(a.hi, b.hi)
        t, f = two_sum(a.lo, b.lo)
        for rest in (t, f):
            if _is_zero(rest):
                break
            s, e = quick_two_sum(s, e + rest)
        return Pair(s, e)

    def sub(self, a: Pair, b: Pair) -> Pair:
        """Return a − b."""
        return self.add(a, self.neg(b))

    def add_smaller(self, a: Pair, b: Pair) -> Pair:
        """Return a + b where |a| ≥ 2 |b|: nothing cancels, and half the operations do."""
        s, e = quick_two_sum(a.hi, b.hi)
        return Pair(*quick_two_sum(s, e + (a.lo + b.lo)))

    def mul(self, a: Pair, b: Pair) -> Pair:
        """Return a b."""
        for x, y in ((a, b), (b, a)):
            if isinstance(x.hi, Fraction) and _is_zero(x.lo) and is_power_of_two(abs(x.hi)):
                return Pair(x.hi * y.hi, x.hi * y.lo)
        p, e = self.two_product(a.hi, b.hi)
        if _is_zero(a.lo) and _is_zero(b.lo):
            return Pair(p, e)
        return Pair(*quick_two_sum(p, e + self._sum_of_products(a.hi, b.lo, a.lo, b.hi)))

    def div(self, a: Pair, b: Pair) -> Pair:
        """Return a / b: a quotient of doubles, and that of what is left."""
        q = a.hi / b.hi
        p = self.mul(b, Pair(q, NOTHING))
        left = (a.hi - p.hi) + (a.lo - p.lo)
        return Pair(*quick_two_sum(q, left / b.hi))

    def sqrt(self, a: Pair) -> Pair:
        """Return √a."""
        root = a.hi.sqrt()
        p, e = self.two_product(root, root)
        left = ((a.hi - p) - e) + a.lo
        return Pair(*quick_two_sum(root, left / (2 * root)))

    def two_product(self, a: Any, b: Any) -> tuple[Any, Any]:
        """Return a b rounded, and the rounding error."""
        p = a * b
        if self.fma:
            return p, self.tape.apply("fma", a, b, -p)
        (a1, a2), (b1, b2) = self._halves(a), self._halves(b)
        return p, (((a1 * b1 - p) + a1 * b2) + a2 * b1) + a2 * b2

    def _halves(self, a: Any) -> tuple[Any, Any]:
        """Return the upper and the lower bits of a double: products of halves round nothing."""
        if isinstance(a, Fraction):
            c = Fraction(float(SPLITTER) * float(a))
            high = Fraction(float(c) - float(c - a))
            return high, a - high
        c = SPLITTER * a
        high = c - (c - a)
        return high, a - high

    def _sum_of_products(self, a: Any, b: Any, c: Any, d: Any) -> Any:
        """Return a b + c d."""
        ab = a * b
        if self.fma and not (_is_zero(ab) or _is_zero(c)):
            return self.tape.apply("fma", c, d, ab)
        return ab + c * d

    # ---------------------------------------------------------------- sin and cos

    def sin(self, x: Pair) -> Pair:
        """Return sin x."""
        (c, s), sine, cosine = self._near_zero(x)
        return Pair(c * sine.hi + s * cosine.hi, c * sine.lo + s * cosine.lo)

    def cos(self, x: Pair) -> Pair:
        """Return cos x."""
        (c, s), sine, cosine = self._near_zero(x)
        return Pair(c * cosine.hi - s * sine.hi, c * cosine.lo - s * sine.lo)

    def _near_zero(self, x: Pair) -> tuple[tuple[Any, Any], Pair, Pair]:
        """Write cos and sin of k π/2, and sin and cos of x − k π/2: the tape shares what sin x and cos x share."""
        k, y = self._reduced(x)
        y = Pair(y.hi / 2**HALVINGS, y.lo / 2**HALVINGS)
        square = self.mul(y, y)
        third = self.mul(self.mul(square, self._series(square, 3)), y)
        sine = self.add_smaller(y, self.neg(third))
        less = self.mul(square, self._series(square, 2))  # 1 − cos y
        for _ in range(HALVINGS):
            twice = Pair(2 * sine.hi, 2 * sine.lo)
            sine, less = self.add_smaller(twice, self.neg(self.mul(twice, less))), self.mul(twice, sine)
        return quarter_turns(k), sine, self.add_smaller(self.constant(Fraction(1)), self.neg(less))

    def _reduced(self, x: Pair) -> tuple[Any, Pair]:
        """Write k, the whole number next to 2 x / π, and x − k π/2. The first difference rounds nothing."""
        inside = (LARGEST_ANGLE - self.tape.apply("abs", x.hi)).sqrt()
        nothing = self.tape.apply("sub", inside, inside)  # or not a number
        k = self.tape.apply("round", x.hi * split(2 / PI)[0]) + nothing
        first, second, third = split(PI / 2, 3)
        p, e = self.two_product(k, first)
        rest, last = self.two_product(k, second)
        left = self.add(Pair(*two_sum(x.hi - p, -e)), Pair(-rest, -last))
        return k, self.add(left, Pair(*two_sum(x.lo, -(k * third))))

    def _series(self, square: Pair, start: int) -> Pair:
        """Write 1/start! − y²/(start + 2)! + …: the last terms in doubles, then in pairs."""
        terms, exact = SERIES
        coefficients = [Fraction((-1) ** n, math.factorial(start + 2 * n)) for n in range(terms)]
        tail: Any = split(coefficients[-1])[0]
        for c in reversed(coefficients[exact:-1]):
            tail = tail * square.hi + split(c)[0]
        value = Pair(tail, NOTHING)
        for c in reversed(coefficients[:exact]):
            value = self.add_smaller(self.constant(c), self.mul(square, value))
        return value


def two_sum(a: Any, b: Any) -> tuple[Any, Any]:
    """Return a + b rounded, and the rounding error."""
    s = a + b
    of_b = s - a
    return s, (a - (s - of_b)) + (b - of_b)


def quick_two_sum(a: Any, b: Any) -> tuple[Any, Any]:
    """Return the same where |a| ≥ |b|."""
    s = a + b
    return s, b - (s - a)


def _is_zero(x: Any) -> bool:
    return not isinstance(x, Number) and x == 0
