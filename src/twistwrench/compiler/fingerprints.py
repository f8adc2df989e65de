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
from collections.abc import Mapping
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np

from .line import Line, operands
from .number import ARITHMETIC, Node, Number, Tape

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
    known: dict[int, Any] = {}
    turns: list[bool] = []  # whether a number depends on a sine
    for node in line.nodes:
        operation, needed = node[0], operands(node)
        mark = fingerprint.of(node, marks)
        if operation == "const":
            value = node[1]
        elif operation == "input":
            value = tape.input(node[1])
        elif (value := _known(mark, known)) is None:
            value = _again(tape, operation, [values[k] for k in needed])
        if type(value) is Number and (operation in ("sin", "cos") or any(turns[k] for k in needed)):
            known.setdefault(mark[0], value)
        turns.append(mark[0] in known)
        marks.append(mark)
        values.append(value)
    if line.notes:
        tape.note = lambda: None  # constants of the results belong to no step
    results = {name: np.empty(shape, object) for name, (shape, _) in line.outputs.items()}
    for name, (_, entries) in line.outputs.items():
        results[name].reshape(-1)[:] = [values[k] for k in entries]
    return Line.of(tape, line.inputs, results)


def _known(mark: Mark, known: Mapping[int, Any]) -> Any:
    """Return the number, or the constant, that is the one with this fingerprint; None if there is none."""
    value = known.get(mark[0])
    if value is None and mark[0] == mark[1]:
        return _constant(mark[0])
    if value is None and (opposite := known.get(PRIME - mark[0])) is not None:
        return -opposite
    return value


def _again(tape: Tape, operation: str, values: list[Any]) -> Any:
    """Write an operation to another tape."""
    if operation in ARITHMETIC and not (operation == "div" and isinstance(values[1], Fraction)):
        return ARITHMETIC[operation](*values)
    return tape.apply(operation, *values)  # functions of constants, too; and a quotient by 0 is the alarm's


class Fingerprint:
    """The values of numbers at two points, modulo a prime."""

    def __init__(self) -> None:
        self.numbers = random.Random(0)  # the same in each run, as programs are
        self.others: dict[Any, Mark] = {}  # of arguments and functions

    def of(self, node: Node, marks: list[Mark]) -> Mark:
        """Return that of an operation on numbers whose fingerprints are known."""
        operation = node[0]
        if operation == "const":
            value = node[1].numerator * _known_inverse(node[1].denominator) % PRIME
            return value, value
        if operation == "input":
            return self.free(node[1])
        x0, x1 = marks[node[1]]
        y0, y1 = marks[node[-1]]
        match operation:
            case "mul":
                return x0 * y0 % PRIME, x1 * y1 % PRIME
            case "add":
                return (x0 + y0) % PRIME, (x1 + y1) % PRIME
            case "sub":
                return (x0 - y0) % PRIME, (x1 - y1) % PRIME
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


def _constant(value: int) -> Fraction | None:
    """Return the constant that has this value at every point, if it is a quotient of numbers that are not large."""
    a, b, u, v = PRIME, value, 0, 1
    while b >= LARGEST:  # Euclid: b is v times the fingerprint at any time
        a, b, u, v = b, a % b, v, u - a // b * v
    return Fraction(b, v) if abs(v) < LARGEST else None
