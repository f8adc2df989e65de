"""A line with 32 digits: each of its operations rewritten into operations on pairs of doubles.

What comes out is a line again, of more and more elementary operations, so that whatever runs the one runs the other.
With it, if wanted, a bound on how far each result can be off.
"""

from __future__ import annotations

from collections.abc import Collection
from fractions import Fraction
from typing import Any

import numpy as np

from ..errors import check_known
from .bounds import Bounded, Bounds
from .line import Line, needed
from .memory import without_garbage
from .number import Number, Tape
from .pair_sine import SINE_ERROR, sine_and_cosine_of_pair
from .pairs import EACH, NOTHING, Pair, Pairs

__all__ = ["BOUND", "LO", "double_double"]

LO, BOUND = ".lo", ".bound"
"""After the name of an argument or of a result: what the double nearest to it leaves, and how far it can be off."""


@without_garbage()
def double_double(
    line: Line, *, low: Collection[str] = (), plain: Collection[str] = (), fma: bool, bound: bool = False
) -> Line:
    """Return a line that computes the same with pairs of doubles.

    Parameters
    ----------
    line : Line
    low : collection of str
        The arguments that are pairs; the others are doubles.
    plain : collection of str
        Results for which doubles are enough.
    fma : bool
        Whether what runs the line has a b + c with one rounding.
    bound : bool
        Whether each result is followed by a bound.
    """
    work = Rewriting(line, low, fma=fma, bound=bound)
    wanted = [k for name, (_, entries) in line.outputs.items() if name not in plain for k in entries]
    exact = {*needed(line.nodes, wanted)}
    for k in range(len(line.nodes)):
        work.rewrite(k) if k in exact else work.copy(k)
    results: dict[str, Any] = {}
    for name, (shape, entries) in line.outputs.items():
        results[name] = work.result([work.pair[k].hi for k in entries], shape)
        if name not in plain:
            results[name + LO] = work.result([work.pair[k].lo for k in entries], shape)
        if bound and name not in plain:
            results[name + BOUND] = work.result([work.bounds.last(work.bound[k]) for k in entries], shape)
    inputs = dict(line.inputs) | {name + LO: line.inputs[name] for name in low}
    return Line.of(work.tape, inputs, results)


class Rewriting:
    """The pairs of the nodes so far, and their bounds.

    Parameters
    ----------
    line, low, fma, bound
        As for `double_double`.
    """

    def __init__(self, line: Line, low: Collection[str], *, fma: bool, bound: bool) -> None:
        self.line, self.low, self.tape = line, low, Tape()
        self.pairs = Pairs(self.tape, fma=fma)
        self.bounds = Bounds(self.tape, EACH, SINE_ERROR)
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
            bound = self.bounds.constant(rest[0] - pair.hi - pair.lo)
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
                self.turns[places[0]] = sine_and_cosine_of_pair(self.pairs, values[0])
            return self.turns[places[0]][operation == "cos"]
        if operation == "sub":
            return self.pairs.add(values[0], self.pairs.negative(values[1]))
        known = {"add": "add", "mul": "multiply", "div": "divide", "neg": "negative", "sqrt": "sqrt"}
        check_known("operation on pairs", operation, known)
        result: Pair = getattr(self.pairs, known[operation])(*values)
        return result

    def _bound(self, operation: str, pair: Pair, *places: int) -> Any:
        """Write how far the result of an operation can be off."""
        given = [Bounded(self._size(self.pair[j]), self.bound[j]) for j in places]
        return self.bounds.of(operation, self._size(pair), *given)

    def _size(self, pair: Pair) -> Any:
        """Write the size of a number, to all digits of a double."""
        return self.tape.apply("abs", pair.hi) if isinstance(pair.hi, Number) else abs(pair.hi)

    def result(self, entries: list[Any], shape: tuple[int, ...]) -> Any:
        """Return an array of results."""
        array = np.empty(len(entries), object)
        array[:] = entries
        return array.reshape(shape)
