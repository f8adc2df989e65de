"""How far a computed number can be off: a bound that is carried through the line, operation by operation.

The running error analysis of Higham, *Accuracy and Stability of Numerical Algorithms* (2nd ed.), section 3.3: beside
each number â there is e ≥ |â − a|, where a is what the operations would give without rounding. A sum takes over the
bounds of its terms, a product each factor times the bound of the other, and each adds its own rounding. The number
types and their errors come in as numbers; nothing is estimated.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

from .number import Tape

__all__ = ["Bounded", "Bounds"]

TINY = Fraction(1, 2**1000)
"""More than what underflow can take from an operation, here and in the numbers."""

OWN = 1 + Fraction(1, 2**20)
"""More than what all roundings of the bounds themselves can take from one, in lines of up to 2²⁸ operations."""


class Bounded(NamedTuple):
    """The size of a computed number, and how far it can be off."""

    size: Any
    bound: Any


class Bounds:
    """Writes bounds to a tape, as operations on doubles.

    Parameters
    ----------
    tape : Tape
    rounding : Fraction
        The largest relative error of + − × ÷ and √.
    sine : Fraction
        The largest error of sin and cos.
    """

    def __init__(self, tape: Tape, rounding: Fraction, sine: Fraction) -> None:
        self.tape, self.rounding, self.sine = tape, rounding, sine

    def constant(self, off: Fraction) -> Fraction:
        """Return the bound of a constant that is off by so much: a double not below it."""
        return Fraction(float(abs(off) * OWN))

    def of(self, operation: str, result: Any, *operands: Bounded) -> Any:
        """Write the bound of the result of an operation, of which the size is given."""
        if operation in ("neg", "abs"):
            return operands[0].bound
        if operation in ("sin", "cos"):
            return operands[0].bound + self.sine
        if operation in ("add", "sub"):
            return operands[0].bound + operands[1].bound + self.rounding * result
        own = self.rounding * result + TINY
        if operation == "mul":  # |âb̂ − ab| ≤ |â| e_b + e_a e_b + |b̂| e_a
            a, b = operands
            return own + ((a.size + a.bound) * b.bound + b.size * a.bound)
        if operation == "div":
            return own + self._div(result, *operands)
        return own + (operands[0].bound + TINY) / result  # |√â − √a| ≤ e_a / √â

    def _div(self, result: Any, a: Bounded, b: Bounded) -> Any:
        """|â/b̂ − a/b| ≤ (e_a + |â/b̂| e_b) / (|b̂| − e_b); not a number where b may be 0."""
        if isinstance(b.bound, Fraction) and b.bound == 0:
            return (a.bound + TINY) / b.size
        root = (b.size - 2 * b.bound).sqrt()
        return (a.bound + result * b.bound + TINY) / (root * root)

    def last(self, bound: Any) -> Any:
        """Write the bound of a result, with what the bounds themselves may have lost."""
        return bound * OWN
