"""A line that also computes how far each of its results can be off: the running error analysis of J. H. Wilkinson.

The line keeps its operations, so that its numbers are the same to the last bit. Beside a number x̂ there is E such that

    |x̂ − x| ≤ u E (1 + u)ⁿ,

where x is what the operations give without rounding, u the unit roundoff (2⁻⁵³ for doubles), and n, which is known when
the line is written, says how many roundings of the bound's own arithmetic stand behind E. The rules are those of Higham,
*Accuracy and Stability of Numerical Algorithms* (2nd ed.), section 3.3: a sum takes over the bounds of its terms, a
product each factor times the bound of the other, and each adds its own rounding, |x̂|.

E is not computed at each number. It is kept as a sum, own |x̂| + Σ c y + rest, of which `own` and `rest` are constants:

- What has only `own` is right to so many roundings: arguments (0), sines, and products of such numbers. It costs nothing.
- The sum of a rotation, c a + s b, is written at once: |c| G + |s| H + |x̂|, with G = E + κ |a| that c a and s a share.
- `rest` is what underflow can take, and is added where a product would enlarge it.

Nothing is estimated, and where nothing is certain, as in a quotient by what may be 0, the bound is not a number.
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from math import ceil, floor
from typing import Any, NamedTuple

import numpy as np

from .line import Line, operands, renumbered
from .number import Number, Tape, is_power_of_two, without_garbage
from .sine import SINE_ROUNDINGS, known_sines

__all__ = ["with_running_bound"]

SUMS = ("add", "sub", "neg", "sin", "cos")  # operations that take over the bounds of their operands
KNOWN = (*SUMS, "mul", "div", "sqrt")

MARGIN = Fraction(1, 16)  # of a constant: more than the products of roundings that are not written one by one
PER_CALL = 4  # no operation of a bound has more than two roundings, and 1/(1 − u) is less than (1 + u)²


LARGER = 1 + Fraction(1, 2**8)  # more than (1 + u)ⁿ for all n that occur


class Off(NamedTuple):
    """How far a number x̂ is off at most, in units of u: own |x̂| + Σ c y + rest, times (1 + u)ⁿ."""

    own: Fraction = Fraction(0)
    terms: tuple[tuple[Any, Any], ...] = ()
    rest: Fraction = Fraction(0)
    n: int = 0

    @property
    def relative(self) -> bool:
        """Whether it is a number of roundings of x̂ itself, and nothing else."""
        return not self.terms and not self.rest


@without_garbage()
def with_running_bound(
    line: Line, dtype: np.dtype[Any], *, bound: str, plain: tuple[str, ...] = (), fma: bool
) -> Line:
    """Return a line of a number type, float32 or float64, in which each result is followed by its bound.

    Those are called as the results, with `bound` at the end; the results in `plain` have none. Sines and cosines are
    for angles up to 2¹⁷ rad. `fma` is whether what runs the line has a b + c with one rounding, and the sines of `sine`;
    else a sine is compared with one that is known to be right.
    """
    return Running(line, dtype, fma).written(bound, plain)


class Running:
    """The rules, and the line that is being written."""

    def __init__(self, line: Line, dtype: np.dtype[Any], fma: bool) -> None:
        self.line, self.fma, self.dtype = line, fma, dtype
        info = np.finfo(dtype)
        self.u = Fraction(1, 2 ** (info.nmant + 1))
        self.tiny = 2 * Fraction(float(info.tiny))  # u times this is twice what underflow can take from an operation
        self.least = Fraction(float(info.smallest_subnormal))
        self.limit = floor(1 / (self.u * 2**10))  # of n: (1 + u)ⁿ is less than 1 + 2⁻⁹
        self.tape = Tape()
        self.value: list[Any] = []  # a constant as it is rounded
        self.off: list[Off] = []
        self.sums = Counter(j for node in line.nodes if node[0] in SUMS for j in operands(node)) + Counter(line.results)

    def written(self, bound: str, plain: tuple[str, ...]) -> Line:
        """Return the new line."""
        line, tape, index = self.line, self.tape, list[int]()
        for k, node in enumerate(line.nodes):
            index.append(tape.places[renumbered(node, index)])
            self.value.append(self.rounded(node[1]) if node[0] == "const" else Number(tape, index[k]))
            off = self.off_of(k, node)
            self.off.append(self.added_up(k, off) if self.sums[k] > 1 and len(off.terms) > 1 else off)
        results: dict[str, Any] = {}
        for name, (shape, entries) in line.outputs.items():
            columns = {name: [Number(tape, index[k]) for k in entries]}
            if name not in plain:
                columns[name + bound] = [self.certain(k) for k in entries]
            results |= {column: np.array(values, object).reshape(shape) for column, values in columns.items()}
        return Line.of(tape, line.inputs, results)

    def rounded(self, c: Fraction) -> Fraction:
        """Return a constant as the number type holds it."""
        return Fraction(float(self.dtype.type(float(c))))

    def above(self, c: Fraction) -> Fraction:
        """Return a constant that the number type holds and that is not smaller."""
        found = self.rounded(c)
        return found if found >= c else Fraction(float(np.nextafter(self.dtype.type(float(c)), self.dtype.type("inf"))))

    def size(self, k: int) -> Any:
        """Write |x̂|."""
        x = self.value[k]
        return abs(x) if isinstance(x, Fraction) else self.tape.apply("abs", x)

    # ---------------------------------------------------------------- the rules

    def off_of(self, k: int, node: tuple[Any, ...]) -> Off:
        """Return how far the result of an operation is off."""
        operation, *needed = node
        if operation == "input":
            return Off()
        if operation == "const":
            c, x = node[1], self.value[k]
            return Off(self.above(abs(c - x) / (self.u * abs(x)))) if x else Off(rest=self.above(abs(c) / self.u))
        if operation not in KNOWN:
            raise NotImplementedError(f"a bound of {operation!r}")
        if operation == "neg":
            return self.off[needed[0]]
        if operation in ("add", "sub"):
            return self.together(Fraction(1), *needed)
        off: Off = getattr(self, operation)(k, *needed)
        return off

    def together(self, own: Fraction, *needed: int) -> Off:
        """Return the sum of what some numbers are off, and own |x̂|."""
        terms, rest, n = list[tuple[Any, Any]](), Fraction(0), 0
        for j in needed:
            off, size = self.off[j], self.size(j)
            rest, n = rest + off.rest, max(n, off.n)
            if isinstance(size, Fraction):
                rest += off.own * size
            elif off.own:
                terms.append((off.own, size))
            terms += off.terms
        return Off(own, tuple(terms), self.above(rest), n)

    def mul(self, k: int, i: int, j: int) -> Off:
        """|âb̂ − ab| ≤ |â| e_b + (|b̂| + e_b) e_a."""
        if not self.off[i].relative or (self.off[j].relative and isinstance(self.value[j], Fraction)):
            i, j = j, i
        a, b = self.off[i], self.off[j]
        if a.relative:  # e_a = u own |â|
            c = self.value[i]
            exact = isinstance(c, Fraction) and (c == 0 or is_power_of_two(abs(c)))
            rest = Fraction(0) if exact and abs(c) >= 1 else self.tiny
            if b.relative:
                own = (a.own + b.own + self.u * a.own * b.own) * (1 + self.u) + (0 if exact else 1)
                return Off(self.above(own), (), rest, max(a.n, b.n))
            inner = Fraction(0) if exact else ceil(a.own) + 1 + MARGIN
            return Off(terms=((self.size(i), self.factor(j, inner)),), rest=rest, n=self.n(b) + ceil(a.own))
        reach = self.sum_of(self.size(j), (2 * self.u, self.factor(j)))  # |b̂| + e_b
        terms = (self.size(i), self.factor(j, 1 + MARGIN)), (reach, self.factor(i))
        return Off(terms=terms, rest=self.tiny, n=self.n(a) + self.n(b) + PER_CALL)

    def div(self, k: int, i: int, j: int) -> Off:
        """|â/b̂ − a/b| ≤ (e_a + |â/b̂| e_b) / (|b̂| − e_b)."""
        a, b = self.off[i], self.off[j]
        if a.relative and b.relative:
            return Off(self.above((a.own + b.own) * (1 + MARGIN) + 1 + MARGIN), (), self.tiny, max(a.n, b.n))
        if b.relative:
            share = self.factor(i) / self.size(j)
            return Off(self.above(b.own + 1 + MARGIN), ((Fraction(1), share),), self.tiny, self.n(a) + PER_CALL + ceil(b.own))
        bound_b = self.factor(j)
        gap = (self.size(j) - 4 * self.u * bound_b).sqrt()  # not a number where b may be 0
        share = self.sum_of(self.tiny, (Fraction(1), self.factor(i)), (self.size(k) + self.tiny, bound_b)) / (gap * gap)
        return Off(Fraction(1), ((Fraction(1), share),), self.tiny, max(self.n(a), self.n(b)) + 4 * PER_CALL)

    def sqrt(self, k: int, i: int) -> Off:
        """|√â − √a| ≤ e_a / √â."""
        a = self.off[i]
        if a.relative:
            return Off(self.above(a.own + 1 + MARGIN), (), Fraction(0), a.n)
        share = self.factor(i) / self.size(k)
        return Off(Fraction(1), ((Fraction(1), share),), self.tiny, self.n(a) + PER_CALL)

    def sin(self, k: int, i: int) -> Off:
        """|sin â − sin a| ≤ e_a."""
        return self.turning(0, k, i)

    def cos(self, k: int, i: int) -> Off:
        """|cos â − cos a| ≤ e_a."""
        return self.turning(1, k, i)

    def turning(self, which: int, k: int, i: int) -> Off:
        """Return how far a sine or a cosine is off: its own roundings, and the angle's."""
        if self.fma:
            return self.together(SINE_ROUNDINGS, i)
        *both, roundings, rest = known_sines(self.value[i], self.dtype)
        known, off = both[which], self.together(Fraction(0), i)
        gap = self.tape.apply("abs", self.value[k] - known)
        terms = (*off.terms, (1 / self.u, gap), (roundings + MARGIN, self.tape.apply("abs", known)))
        return Off(Fraction(0), terms, self.above(off.rest + rest / self.u), off.n + PER_CALL)

    # ---------------------------------------------------------------- bounds as numbers

    def n(self, off: Off) -> int:
        """Return n of such a bound as one number."""
        n = off.n + PER_CALL * (len(off.terms) + 2)
        return 0 if n > self.limit else n

    def added_up(self, k: int, off: Off) -> Off:
        """Write all but the rest as one number."""
        terms = [*off.terms, (off.own, self.size(k))] if off.own else [*off.terms]
        return Off(Fraction(0), ((Fraction(1), self.safe(off, self.sum_of(None, *terms))),), off.rest + self.tiny, self.n(off))

    def factor(self, k: int, more: Fraction = Fraction(0)) -> Any:
        """Write how far a number is off plus `more` times its size, as one number: one that may be a factor."""
        off, size = self.off[k], self.size(k)
        rest = off.rest + self.tiny
        terms = [*off.terms]
        if isinstance(size, Fraction):
            rest += (off.own + more) * size
        elif off.own + more:
            terms = [(self.above(off.own + more), size), *terms]
        return self.safe(off, self.sum_of(self.above(rest), *terms))

    def safe(self, off: Off, x: Any) -> Any:
        """Return a bound, made a little larger where too many roundings stand behind it: then n is 0 again."""
        return x if self.n(off) else x * LARGER

    def sum_of(self, start: Any, *terms: tuple[Any, Any]) -> Any:
        """Write start + Σ c y; the start may be None."""
        total = start
        for c, y in sorted(terms, key=lambda term: not is_one(term[0])):
            if total is None or is_one(c):
                total = c * y if total is None else total + y
            else:
                total = self.tape.apply("fma", c, y, total) if self.fma else total + c * y
        return total

    def certain(self, k: int) -> Any:
        """Write the bound of a result."""
        off = self.off[k]
        if off == Off():
            return Fraction(0)
        return self.sum_of(self.least, (self.u * LARGER, self.tape.number(self.factor(k))))


def is_one(c: Any) -> bool:
    """Return whether a factor is the constant 1."""
    return isinstance(c, Fraction) and c == 1
