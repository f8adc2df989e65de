"""What is the same number in every state is computed once, also where it does not look the same.

A tape takes two operations for one if they look the same. But m cos² q + m sin² q is m, and half of the entries of
Xᵀ I X are there twice, added up in other ways. To see it, the line is run with whole numbers modulo a large prime: each
argument is a random one, and cos and sin are those of a random point of the circle, (1 − t²) / (1 + t²) and
2 t / (1 + t²). What is equal in every state is equal there, too; anything else is so by chance, which no one will ever
see (J. T. Schwartz, 1980; R. Zippel, 1979). So a number with the fingerprint of an earlier one, or of its negative, is
that one; and what has the same fingerprint at two points is a constant.

Of all rules this is the only one that changes roundings: it takes some away.

>>> from twistwrench.compiler.number import numbers
>>> tape = Tape()
>>> (q,) = numbers(tape, "q", 1)
>>> c, s = q.cos(), q.sin()
>>> line = Line.of(tape, {"q": (1,)}, {"result": np.array([c * c - s * s, (s - c) * (s + c), 3 * c * c + 3 * s * s])})
>>> [each_once(line).nodes[k] for k in each_once(line).results]
[('sub', 3, 4), ('neg', 5), ('const', Fraction(3, 1))]
"""

from __future__ import annotations

import random
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np

from .line import Line
from .number import ARITHMETIC, Tape

__all__ = ["each_once"]

PRIME = 2**607 - 1

LARGEST = 2**240
"""Numerators and denominators of constants are smaller: hardly any number below the prime is such a quotient."""

Mark = tuple[int, ...]
"""A fingerprint: the value of a number at two points."""


def each_once(line: Line) -> Line:
    """Return a line with the same results, in which no numbers that depend on a sine are equal, or opposite.

    Of the others only constants are found: if limbs shared them, they would not be alike any longer (see `packs`).
    """
    marks: list[Mark] = []
    tape, fingerprint = Tape((lambda: line.notes[len(marks)]) if line.notes else None), Fingerprint()
    values: list[Any] = []
    known: dict[Mark, Any] = {}
    for operation, *rest in line.nodes:
        mark = fingerprint.of(operation, rest, marks)
        if operation == "const":
            value = rest[0]
        elif operation == "input":
            value = tape.input(rest[0])
        elif (value := known.get(mark, _constant(mark))) is None:
            if (opposite := known.get((-mark[0] % PRIME, -mark[1] % PRIME))) is not None:
                value = -opposite
            else:
                value = _again(tape, operation, [values[k] for k in rest])
            if operation in ("sin", "cos") or any(marks[k] in known for k in rest):
                known[mark] = value
        marks.append(mark)
        values.append(value)
    tape.note = None  # constants of the results belong to no step
    results = {name: np.empty(shape, object) for name, (shape, _) in line.outputs.items()}
    for name, (_, entries) in line.outputs.items():
        results[name].reshape(-1)[:] = [values[k] for k in entries]
    return Line.of(tape, line.inputs, results)


def _again(tape: Tape, operation: str, operands: list[Any]) -> Any:
    """Write an operation to another tape."""
    if operation in ARITHMETIC and not (operation == "div" and isinstance(operands[1], Fraction)):
        return ARITHMETIC[operation](*operands)
    return tape.apply(operation, *operands)  # functions of constants, too; and a quotient by 0 is the alarm's


class Fingerprint:
    """The values of numbers at two points, modulo a prime."""

    def __init__(self) -> None:
        self.numbers = random.Random(0)  # the same in each run, as programs are
        self.others: dict[Any, Mark] = {}  # of arguments and functions

    def of(self, operation: str, rest: list[Any], marks: list[Mark]) -> Mark:
        """Return that of an operation on numbers whose fingerprints are known."""
        if operation == "const":
            value = rest[0].numerator * _known_inverse(rest[0].denominator) % PRIME
            return value, value
        if operation == "input":
            return self.free(rest[0])
        (x0, x1), *others = [marks[k] for k in rest]
        y0, y1 = others[0] if others else (0, 0)
        match operation:
            case "add":
                return (x0 + y0) % PRIME, (x1 + y1) % PRIME
            case "sub":
                return (x0 - y0) % PRIME, (x1 - y1) % PRIME
            case "mul":
                return x0 * y0 % PRIME, x1 * y1 % PRIME
            case "neg":
                return -x0 % PRIME, -x1 % PRIME
            case "div" if y0 and y1:
                return x0 * _inverse(y0) % PRIME, x1 * _inverse(y1) % PRIME
            case "cos":
                return tuple((1 - t * t) * _inverse(1 + t * t) % PRIME for t in self.free((x0, x1)))
            case "sin":
                return tuple(2 * t * _inverse(1 + t * t) % PRIME for t in self.free((x0, x1)))
        return self.free((operation, x0, x1, y0, y1))

    def free(self, key: Any) -> Mark:
        """Return a random fingerprint, the same for the same key."""
        if key not in self.others:
            self.others[key] = self.numbers.getrandbits(606), self.numbers.getrandbits(606)
        return self.others[key]


def _inverse(x: int) -> int:
    return pow(x, -1, PRIME)


_known_inverse = lru_cache(_inverse)
"""For denominators of constants, which are a few powers of two."""


def _constant(mark: Mark) -> Fraction | None:
    """Return the constant with a fingerprint, if it is that of one: the quotient of two numbers that are not large."""
    if mark[0] != mark[1]:
        return None
    a, b, u, v = PRIME, mark[0], 0, 1
    while b >= LARGEST:  # Euclid: b is v times the fingerprint at any time
        a, b, u, v = b, a % b, v, u - a // b * v
    return Fraction(b, v) if abs(v) < LARGEST else None
