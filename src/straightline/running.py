"""A line that also computes how far each of its results can be off: the running error analysis of J. H. Wilkinson.

The line keeps its operations, so that its numbers are the same to the last bit. Beside a number x̂ there is E such that

    |x̂ − x| ≤ u E (1 + u)ⁿ,

where x is what the operations give without rounding, u the unit roundoff (2⁻⁵³ for doubles), and n, which is known when
the line is written, is how many roundings of the bound's own arithmetic stand behind E. The rules are those of Higham,
*Accuracy and Stability of Numerical Algorithms* (2nd ed.), section 3.3: a sum takes over the bounds of its terms, a
product each factor times the bound of the other, and each adds its own rounding, |x̂|.

E is kept as own |x̂| + c y + rest, where `own` and `rest` are constants, and computed where it is needed:

- What has only `own` is right to so many roundings: arguments (0), sines (4), products of such numbers. That costs
  nothing.
- The sum of a rotation, c a + s b, takes one operation for each product, |c| G + |s| H, where G is the bound of a and
  what is to be added for each factor |c|: c a and s a share it.
- `rest` is what underflow can take, and is added where a product would enlarge it.

Nothing is estimated, and where nothing is certain, as in a quotient by what may be 0, the bound is not a number.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import chain
from math import ceil
from typing import Any, NamedTuple

import numpy as np

from .double_double import BOUND
from .line import Line, needed, renumbered
from .number import Number, Tape, is_power_of_two, without_garbage
from .sine import SINE_ROUNDINGS, known_sines

__all__ = ["with_running_bound"]

NOTHING, ONE = Fraction(0), Fraction(1)

MARGIN = Fraction(1, 16)  # of a number of roundings: more than the products of roundings, which are not written
PER_CALL = 4  # no operation of a bound rounds more than twice, and 1/(1 − u) is less than (1 + u)²
LARGER = 1 + Fraction(1, 2**8)  # more than (1 + u)ⁿ for all n that occur

RULES = ("input", "const", "neg", "add", "sub", "mul", "div", "sqrt", "sin", "cos")

Term = tuple[Any, Any]
"""Two factors that are not negative: constants or numbers."""


class Off(NamedTuple):
    """How far a number x̂ is off at most, in units of u: own |x̂| + c y + rest, times (1 + u)ⁿ."""

    own: Fraction = NOTHING
    term: Term | None = None
    rest: Fraction = NOTHING
    n: int = 0
    paid: bool = False  # whether c y is not less than what underflow can take from an operation


@without_garbage()
def with_running_bound(line: Line, dtype: np.dtype[Any], *, alarm: str | None = None, fma: bool) -> Line:
    """Return a line of a number type, float32 or float64, in which each result is followed by its bound.

    Sines and cosines are for angles up to 2¹⁷ rad.

    Parameters
    ----------
    line : Line
        Of + − × ÷, sin, cos and square roots.
    dtype : dtype
    alarm : str, optional
        A result that has no bound, and is no number where one of the bounds is none or is infinite.
    fma : bool
        Whether what runs the line has a b + c with one rounding, and the sines of `with_series`; else a sine is
        compared with one that is known to be right.
    """
    running = Running(dtype, fma)
    wanted = [entries for name, (_, entries) in line.outputs.items() if name != alarm]
    bounded = {*needed(line.nodes, chain(*wanted))}
    for k, node in enumerate(line.nodes):
        running.compute(node, k in bounded)
    results, bounds = dict[str, Any](), list[Any]()
    for name, (shape, entries) in line.outputs.items():
        columns = {name: [Number(running.tape, running.index[k]) for k in entries]}
        if name == alarm:
            columns = {name: [running.alarmed(x, bounds) for x in columns[name]]}
        else:
            columns[name + BOUND] = [running.certain(k) for k in entries]
            bounds += columns[name + BOUND]
        results |= {column: np.array(values, object).reshape(shape) for column, values in columns.items()}
    return Line.of(running.tape, line.inputs, results)


class Running:
    """Writes operations to a tape, and how far their results can be off."""

    def __init__(self, dtype: np.dtype[Any], fma: bool) -> None:
        info = np.finfo(dtype)
        self.dtype, self.fma, self.tape = dtype, fma, Tape()
        self.u = Fraction(1, 2 ** (info.nmant + 1))
        self.least = Fraction(float(info.smallest_subnormal))
        self.tiny = self.least / self.u**2 * 2**8  # more than underflow takes, and so much that no bound underflows
        self.most = int(1 / (2**10 * self.u))  # roundings behind a bound: (1 + u)ⁿ is then less than 1 + 2⁻⁹
        self.index: list[int] = []  # of each operation on the tape
        self.value: list[Any] = []  # its result; of a constant, what the number type holds
        self.off: list[Off] = []

    def compute(self, node: tuple[Any, ...], bounded: bool) -> None:
        """Write an operation as it stands, and how far its result can be off, if a result with a bound needs it."""
        operation, *rest = node
        self.index.append(self.tape.places[renumbered(node, self.index)])
        self.value.append(self.rounded(rest[0]) if operation == "const" else Number(self.tape, self.index[-1]))
        if bounded and operation not in RULES:
            raise NotImplementedError(f"a bound of {operation!r}")
        own = bounded and operation != "input"  # an argument is what it is
        self.off.append(getattr(self, operation)(*rest) if own else Off())

    # ---------------------------------------------------------------- the rules

    def const(self, c: Fraction) -> Off:
        """Return what a constant is rounded by."""
        x = self.value[-1]
        off = abs(c - x) / self.u
        return Off(own=self.above(off / abs(x))) if x else Off(rest=self.above(off))

    def neg(self, i: int) -> Off:
        """Return what the number is off."""
        return self.off[i]

    def add(self, i: int, j: int) -> Off:
        """|â + b̂ − (a + b)| ≤ e_a + e_b. There is no underflow."""
        return self.together(ONE, i, j)

    def sub(self, i: int, j: int) -> Off:
        """As a sum."""
        return self.together(ONE, i, j)

    def mul(self, i: int, j: int) -> Off:
        """|âb̂ − ab| ≤ |â| e_b + (|b̂| + e_b) e_a."""
        if not self.few(i) or (self.few(j) and isinstance(self.value[j], Fraction)):
            i, j = j, i
        a, b = self.off[i], self.off[j]
        if not self.few(i):
            reach = self.sum_of(self.size(j), (2 * self.u, self.factor(j)))  # |b̂| + e_b
            terms = (self.size(i), self.factor(j, 1 + MARGIN)), (reach, self.factor(i))
            return self.collected(NOTHING, terms, NOTHING, self.n(i) + self.n(j) + PER_CALL, False)
        c = self.value[i]
        exact = isinstance(c, Fraction) and is_power_of_two(abs(c))
        rest = NOTHING if exact and abs(c) >= 1 else self.tiny
        if self.few(j):
            own = (a.own + b.own + self.u * a.own * b.own) * (1 + self.u)
            return Off(self.above(own if exact else own + 1), rest=rest)
        again = NOTHING if exact else ceil(a.own) + 1 + MARGIN  # e_a and the product's own rounding, times |b̂|
        return Off(term=(self.size(i), self.factor(j, again)), rest=rest, n=self.n(j) + ceil(a.own))

    def div(self, i: int, j: int) -> Off:
        """|â/b̂ − a/b| ≤ (e_a + |â/b̂| e_b) / (|b̂| − e_b)."""
        a, b = self.off[i], self.off[j]
        if self.few(j):  # |b| ≥ |b̂| (1 − own u)
            own = self.above((b.own + (a.own if self.few(i) else 0) + 1) * (1 + MARGIN))
            if self.few(i):
                return Off(own, rest=self.tiny)
            return Off(own, (ONE, self.factor(i) / self.size(j)), self.tiny, self.n(i) + PER_CALL + 2 * ceil(b.own))
        off = self.factor(j)
        gap = (self.size(j) - 4 * self.u * off).sqrt()  # not a number where b may be 0
        size = self.tape.apply("abs", Number(self.tape, self.index[-1])) + self.tiny
        share = self.sum_of(self.tiny, (ONE, self.factor(i)), (size, off)) / (gap * gap)
        return Off(1 + MARGIN, (ONE, share), self.tiny, max(self.n(i), self.n(j)) + 5 * PER_CALL)

    def sqrt(self, i: int) -> Off:
        """|√â − √a| ≤ e_a / √â."""
        a = self.off[i]
        if self.few(i):
            return Off(self.above(a.own + 1 + MARGIN))
        root = self.tape.apply("abs", Number(self.tape, self.index[-1]))
        return Off(1 + MARGIN, (ONE, self.factor(i) / root), self.tiny, self.n(i) + 2 * PER_CALL)

    def sin(self, i: int) -> Off:
        """|sin â − sin a| ≤ e_a."""
        return self.turning(0, i)

    def cos(self, i: int) -> Off:
        """|cos â − cos a| ≤ e_a."""
        return self.turning(1, i)

    def turning(self, which: int, i: int) -> Off:
        """Return the roundings of a sine or a cosine, and what its angle is off."""
        if self.fma:
            return self.together(SINE_ROUNDINGS, i)
        *both, roundings, rest = known_sines(self.value[i], self.dtype)
        known = both[which]
        gap = self.tape.apply("abs", self.value[-1] - known)
        terms = ((1 / self.u, gap), (roundings + MARGIN, self.tape.apply("abs", known)))
        return self.together(NOTHING, i, more=terms, rest=rest / self.u)

    # ---------------------------------------------------------------- bounds

    def together(self, own: Fraction, *needed: int, more: tuple[Term, ...] = (), rest: Fraction = NOTHING) -> Off:
        """Return own |x̂|, what some numbers are off, and more."""
        terms, n, paid = [*more], PER_CALL * len(more), False
        for j in needed:
            off, size = self.off[j], self.size(j)
            if off.own and not isinstance(size, Fraction):
                both = [*([off.term] if off.term else []), (off.own, size)]
                off = self.collected(NOTHING, both, off.rest, off.n, off.paid)
            elif off.own:
                rest += off.own * size
            rest, n, paid = rest + off.rest, max(n, off.n), paid or off.paid
            terms += [off.term] if off.term else []
        return self.collected(own, terms, rest, n, paid)

    def collected(self, own: Fraction, terms: Sequence[Term], rest: Fraction, n: int, paid: bool) -> Off:
        """Return own |x̂| + Σ c y + rest, all but the first as one number if it is more than one term."""
        if len(terms) < 2:
            return Off(own, terms[0] if terms else None, self.above(rest), n, paid)
        start = None
        if not paid and not all(is_one(c) for c, _ in terms):
            start, rest, paid = self.above(rest + self.tiny), NOTHING, True
        total, n = self.sum_of(start, *terms), n + PER_CALL * len(terms)
        if n > self.most:
            total, n = total * LARGER, 0
        return Off(own, (ONE, total), self.above(rest), n, paid)

    def factor(self, k: int, more: Fraction = NOTHING) -> Any:
        """Write how far a number is off plus `more` times its size, as one number: one that may be a factor."""
        off, size = self.off[k], self.size(k)
        rest, terms = off.rest if off.paid else off.rest + self.tiny, [off.term] if off.term else []
        if isinstance(size, Fraction):
            rest += (off.own + more) * size
        elif off.own + more:
            terms.append((self.above(off.own + more), size))
        total = self.sum_of(self.above(rest) if rest else None, *terms)
        return total if self.n(k) else total * LARGER

    def few(self, k: int) -> bool:
        """Return whether a number is off by some roundings of itself, and nothing else."""
        off = self.off[k]
        return off.term is None and not off.rest and off.own <= self.most / 4

    def n(self, k: int) -> int:
        """Return how many roundings stand behind `factor`."""
        n = self.off[k].n + 3 * PER_CALL
        return n if n <= self.most else 0

    def certain(self, k: int) -> Any:
        """Write the bound of a result."""
        return NOTHING if self.off[k] == Off() else self.sum_of(self.least, (self.u * LARGER, self.factor(k)))

    def alarmed(self, alarm: Number, bounds: Sequence[Any]) -> Number:
        """Write an alarm that is not a number either where one of the bounds so far is infinite, or none."""
        total = sum((x for x in bounds if isinstance(x, Number)), NOTHING)
        return self.tape.number(alarm + self.tape.apply("mul", NOTHING, total))

    def size(self, k: int) -> Any:
        """Write |x̂|."""
        x = self.value[k]
        return abs(x) if isinstance(x, Fraction) else self.tape.apply("abs", x)

    def sum_of(self, start: Any, *terms: Term) -> Any:
        """Write start + Σ c y; the start may be None."""
        total = start
        for c, y in terms:
            if total is None or is_one(c):
                total = c * y if total is None else y + total
            else:
                total = self.tape.apply("fma", c, y, total) if self.fma else total + c * y
        return total

    def rounded(self, c: Fraction) -> Fraction:
        """Return a constant as the number type holds it."""
        return Fraction(float(self.dtype.type(float(c))))

    def above(self, c: Fraction) -> Fraction:
        """Return a constant that the number type holds and that is not smaller."""
        found = self.rounded(c)
        return found if found >= c else Fraction(float(np.nextafter(self.dtype.type(found), self.dtype.type("inf"))))


def is_one(c: Any) -> bool:
    """Return whether a factor is the constant 1."""
    return isinstance(c, Fraction) and c == 1
