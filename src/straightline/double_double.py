"""A line with 32 digits: each of its operations rewritten into operations on pairs of doubles. It is a line again.

With it, if wanted, goes a bound on how far each result can be off: the running error analysis of Higham, *Accuracy and
Stability of Numerical Algorithms* (2nd ed.), section 3.3. Beside each number â there is e ≥ |â − a|, where a is what
the operations would give without rounding. A sum takes over the bounds of its terms, a product each factor times the
bound of the other, and each adds its own rounding. Nothing is estimated.
"""

from __future__ import annotations

from collections.abc import Collection
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from .line import Line, needed
from .number import Array, Number, Tape, without_garbage
from .pairs import EACH, NOTHING, OPERATIONS, SINE_ERROR, Pair, Pairs

__all__ = ["BOUND", "LO", "OWN", "DoubleDouble", "double_double"]

LO, BOUND = ".lo", ".bound"
"""After the name of an argument or of a result: what the double nearest to it leaves, and how far it can be off."""

TINY = Fraction(1, 2**1000)  # more than what underflow can take from an operation, here and in the numbers

OWN = 1 + Fraction(1, 2**20)
"""More than what all roundings of the bounds themselves can take from one, in lines of up to 2²⁸ operations."""


class DoubleDouble(NamedTuple):
    """Numbers of 32 digits: hi + lo, arrays of the same shape, where hi is the double nearest to the sum.

    Examples
    --------
    >>> third = DoubleDouble(np.array(1 / 3), np.array(2.0**-54 / 3))  # 1/3 to 32 digits
    """

    hi: Array
    lo: Array


@without_garbage()
def double_double(
    line: Line, *, low: Collection[str] = (), plain: Collection[str] = (), fma: bool, bound: bool = False
) -> Line:
    """Return a line that computes the same with pairs of doubles, each result followed by its bound if wanted.

    The arguments in `low` are pairs, for the results in `plain` doubles are enough; `fma` is whether what runs the line
    has a b + c with one rounding.
    """
    tape = Tape()
    pairs = Pairs(tape, fma=fma)
    wanted = [k for name, (_, entries) in line.outputs.items() if name not in plain for k in entries]
    exact = {*needed(line.nodes, wanted)}
    value: list[Pair] = []
    error: list[Any] = []
    for k, (operation, *rest) in enumerate(line.nodes):
        off: Any = NOTHING
        if operation == "input":
            name, *index = rest[0]
            x = Pair(tape.input(rest[0]), tape.input((name + LO, *index)) if name in low else NOTHING)
        elif operation == "const":
            x = pairs.constant(rest[0])
            off = Fraction(float(abs(rest[0] - x.hi - x.lo) * OWN))  # a double not below it
        elif k not in exact:
            x = Pair(tape.apply(operation, *(value[j].hi for j in rest)), NOTHING)
        else:
            given = [value[j] for j in rest]
            if all(isinstance(one.hi, Fraction) for one in given):  # fractions add up to what no pair may hold
                given = [Pair(tape.number(one.hi), tape.number(one.lo)) for one in given]
            if operation not in OPERATIONS:
                raise NotImplementedError(f"{operation!r} of pairs of doubles")
            x = getattr(pairs, operation)(*given)
            if bound:
                off = error_of(operation, size(x), [size(value[j]) for j in rest], [error[j] for j in rest])
        value.append(x)
        error.append(off)
    results: dict[str, Any] = {}
    for name, (shape, entries) in line.outputs.items():
        columns = {name: [value[k].hi for k in entries]}
        if name not in plain:
            columns[name + LO] = [value[k].lo for k in entries]
            columns |= {name + BOUND: [error[k] * OWN for k in entries]} if bound else {}
        results |= {column: np.array(values, object).reshape(shape) for column, values in columns.items()}
    return Line.of(tape, dict(line.inputs) | {name + LO: line.inputs[name] for name in low}, results)


def error_of(operation: str, result: Any, sizes: list[Any], errors: list[Any]) -> Any:
    """Write how far the result of an operation can be off, from its size, and the operands' sizes and bounds."""
    (a, *others), (e, *others_e) = sizes, errors
    if operation == "neg":
        return e
    if operation in ("sin", "cos"):
        return e + SINE_ERROR
    own = EACH * result
    if operation in ("add", "sub"):
        return e + others_e[0] + own
    own = own + TINY
    if operation == "sqrt":  # |√â − √a| ≤ e / √â
        return own + (e + TINY) / result
    b, e_b = others[0], others_e[0]
    if operation == "mul":  # |âb̂ − ab| ≤ |â| e_b + e e_b + |b̂| e
        return own + ((a + e) * e_b + b * e)
    gap = b - 2 * e_b  # |â/b̂ − a/b| ≤ (e + |â/b̂| e_b) / (|b̂| − e_b)
    if isinstance(gap, Number) and not (isinstance(e_b, Fraction) and e_b == 0):
        root = gap.sqrt()  # not a number where b may be 0
        gap = root * root
    return own + (e + result * e_b + TINY) / gap


def size(x: Pair) -> Any:
    """Write the size of a number, to all digits of a double."""
    return x.hi.tape.apply("abs", x.hi) if isinstance(x.hi, Number) else abs(x.hi)
