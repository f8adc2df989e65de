"""A line with 32 digits: each of its operations rewritten into operations on pairs of doubles.

What comes out is a line again, of more and more elementary operations, so that whatever runs the one runs the other.

With it, if wanted, goes a bound on how far each result can be off: the running error analysis of Higham, *Accuracy and
Stability of Numerical Algorithms* (2nd ed.), section 3.3. Beside each number â there is e ≥ |â − a|, where a is what
the operations would give without rounding. A sum takes over the bounds of its terms, a product each factor times the
bound of the other, and each adds its own rounding. Nothing is estimated.
"""

from __future__ import annotations

from collections.abc import Collection
from fractions import Fraction
from typing import Any

import numpy as np

from ..errors import check_known
from .line import Line, needed
from .number import Number, Tape, without_garbage
from .pairs import EACH, NOTHING, SINE_ERROR, Pair, Pairs

__all__ = ["BOUND", "LO", "OWN", "double_double"]

LO, BOUND = ".lo", ".bound"
"""After the name of an argument or of a result: what the double nearest to it leaves, and how far it can be off."""

TINY = Fraction(1, 2**1000)
"""More than what underflow can take from an operation, here and in the numbers."""

OWN = 1 + Fraction(1, 2**20)
"""More than what all roundings of the bounds themselves can take from one, in lines of up to 2²⁸ operations."""


@without_garbage()
def double_double(
    line: Line, *, low: Collection[str] = (), plain: Collection[str] = (), fma: bool, bound: bool = False
) -> Line:
    """Return a line that computes the same with pairs of doubles, each result followed by its bound if wanted.

    The arguments in `low` are pairs, for the results in `plain` doubles are enough; `fma` is whether what runs the line
    has a b + c with one rounding.
    """
    work = Rewriting(line, low, fma=fma, bound=bound)
    wanted = [k for name, (_, entries) in line.outputs.items() if name not in plain for k in entries]
    exact = {*needed(line.nodes, wanted)}
    for k in range(len(line.nodes)):
        work.rewrite(k) if k in exact else work.copy(k)
    results: dict[str, Any] = {}
    for name, (shape, entries) in line.outputs.items():
        columns = {name: [work.pair[k].hi for k in entries]}
        if name not in plain:
            columns[name + LO] = [work.pair[k].lo for k in entries]
            columns |= {name + BOUND: [work.bound[k] * OWN for k in entries]} if bound else {}
        results |= {column: np.array(values, object).reshape(shape) for column, values in columns.items()}
    inputs = dict(line.inputs) | {name + LO: line.inputs[name] for name in low}
    return Line.of(work.tape, inputs, results)


class Rewriting:
    """The pairs of the nodes so far, and their bounds: see `double_double`."""

    def __init__(self, line: Line, low: Collection[str], *, fma: bool, bound: bool) -> None:
        self.line, self.low, self.tape = line, low, Tape()
        self.pairs = Pairs(self.tape, fma=fma)
        self.pair: list[Pair] = []
        self.bound: list[Any] = []
        self.bounded = bound
        self.turns: dict[int, tuple[Pair, Pair]] = {}  # sin and cos of an angle

    def copy(self, k: int) -> None:
        """Write an operation for which doubles are enough."""
        operation, *rest = self.line.nodes[k]
        if operation in ("input", "const"):
            self.rewrite(k)
            return
        self.pair.append(Pair(self.tape.apply(operation, *(self.pair[j].hi for j in rest)), NOTHING))
        self.bound.append(NOTHING)

    def rewrite(self, k: int) -> None:
        """Write an operation on pairs, and its bound."""
        operation, *rest = self.line.nodes[k]
        if operation == "input":
            pair, bound = self._input(*rest[0]), NOTHING
        elif operation == "const":
            pair = self.pairs.constant(rest[0])
            bound = Fraction(float(abs(rest[0] - pair.hi - pair.lo) * OWN))  # a double not below it
        else:
            pair = self._operate(operation, *rest)
            bound = self._bound(operation, pair, *rest) if self.bounded else NOTHING
        self.pair.append(pair)
        self.bound.append(bound)

    def _input(self, name: str, *index: int) -> Pair:
        lo = self.tape.input((name + LO, *index)) if name in self.low else NOTHING
        return Pair(self.tape.input((name, *index)), lo)

    def _operate(self, operation: str, *places: int) -> Pair:
        """Write an operation on pairs."""
        values = [self.pair[j] for j in places]
        if all(isinstance(x.hi, Fraction) for x in values):  # fractions add up to what no pair may hold
            values = [Pair(self.tape.number(x.hi), self.tape.number(x.lo)) for x in values]
        if operation in ("sin", "cos"):
            if places[0] not in self.turns:
                self.turns[places[0]] = self.pairs.sine_and_cosine(values[0])
            return self.turns[places[0]][operation == "cos"]
        if operation == "sub":
            return self.pairs.add(values[0], self.pairs.negative(values[1]))
        known = {"add": "add", "mul": "multiply", "div": "divide", "neg": "negative", "sqrt": "sqrt"}
        check_known("operation on pairs", operation, known)
        result: Pair = getattr(self.pairs, known[operation])(*values)
        return result

    def _bound(self, operation: str, pair: Pair, *places: int) -> Any:
        """Write how far the result of an operation can be off."""
        result, bounds = self._size(pair), [self.bound[j] for j in places]
        a, e = self._size(self.pair[places[0]]), bounds[0]
        if operation in ("neg", "abs"):
            return e
        if operation in ("sin", "cos"):
            return e + SINE_ERROR
        if operation in ("add", "sub"):
            return e + bounds[1] + EACH * result
        own = EACH * result + TINY
        if operation == "sqrt":  # |√â − √a| ≤ e / √â
            return own + (e + TINY) / result
        b, e_b = self._size(self.pair[places[1]]), bounds[1]
        if operation == "mul":  # |âb̂ − ab| ≤ |â| e_b + e e_b + |b̂| e
            return own + ((a + e) * e_b + b * e)
        gap = b - 2 * e_b  # |â/b̂ − a/b| ≤ (e + |â/b̂| e_b) / (|b̂| − e_b)
        if isinstance(gap, Number) and not (isinstance(e_b, Fraction) and e_b == 0):
            root = gap.sqrt()  # not a number where b may be 0
            gap = root * root
        return own + (e + result * e_b + TINY) / gap

    def _size(self, pair: Pair) -> Any:
        """Write the size of a number, to all digits of a double."""
        return self.tape.apply("abs", pair.hi) if isinstance(pair.hi, Number) else abs(pair.hi)
