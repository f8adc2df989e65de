"""What is the same number in every state is computed once, also where it does not look the same.

A tape takes two operations for one if they look the same. But m cos² q + m sin² q is m, and half of the entries of
Xᵀ I X are there twice, added up in other ways. To see it, the line is run with whole numbers modulo a large prime: each
argument is a random one, and cos and sin are those of a random point of the circle, (1 − t²) / (1 + t²) and
2 t / (1 + t²). What is equal there is equal in every state (anything else has no chance: J. T. Schwartz, 1980;
R. Zippel, 1979), what is the same at two such points is a constant. It is the only rule that changes roundings: it
takes some away.

>>> from straightline.number import numbers
>>> tape = Tape()
>>> (q,) = numbers(tape, "q", 1)
>>> c, s = q.cos(), q.sin()
>>> line = Line.of(tape, {"q": (1,)}, {"result": np.array([c * c - s * s, (s - c) * (s + c), 3 * c * c + 3 * s * s])})
>>> [each_once(line).nodes[k] for k in each_once(line).results]
[('sub', 3, 4), ('neg', 5), ('const', Fraction(3, 1))]
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np

from .line import Line, needed, operands, ordered
from .number import ARITHMETIC, Node, Number, Tape

__all__ = ["each_once"]

PRIME, LARGER = 2**127 - 1, 2**607 - 1  # for fingerprints, and to find what a constant is

MAX_CONSTANT = 2**240
"""Numerators and denominators of constants are smaller: hardly any number below the larger prime is such a quotient."""

Mark = tuple[int, ...]  # a fingerprint: the value of a number at two points


def each_once(line: Line) -> Line:
    """Return a line with the same results, in which no numbers that depend on a sine are equal, or opposite.

    Of the others only constants are found: if limbs shared them, they would not be alike any longer (see `packs`).
    """
    k, count = 0, len(line.nodes)
    tape = Tape((lambda: line.notes[k]) if line.notes else None)
    fingerprint, constants = Fingerprint(PRIME), ConstantTable(line)
    marks: list[Mark] = [()] * count
    values: list[Any] = [None] * count
    turns = [False] * count  # whether a number depends on a sine
    known: dict[int, Any] = {}
    for k in needed(line.nodes, line.results):
        node = line.nodes[k]
        operation = node[0]
        mark = marks[k] = fingerprint.of(node, marks)
        one = mark[0]
        if operation == "const":
            value = node[1]
        elif operation == "input":
            value = tape.input(node[1])
        elif one in known:
            value, turns[k] = known[one], True
        else:
            value = constants.of(k, one) if one == mark[1] else None
            if value is None and PRIME - one in known:
                value = -known[PRIME - one]
            if value is None:
                rule, x = ARITHMETIC.get(operation), [values[j] for j in node[1:]]
                if rule is None or (operation == "div" and type(x[1]) is Fraction):  # a quotient by 0 is the alarm's
                    value = tape.apply(operation, *x)
                else:
                    value = rule(*x)
            if type(value) is Number and (operation in ("sin", "cos") or any(turns[j] for j in node[1:])):
                known[one], turns[k] = value, True
        values[k] = value
    if line.notes:
        tape.note = lambda: None  # constants of the results belong to no step
    results = {name: np.empty(shape, object) for name, (shape, _) in line.outputs.items()}
    for name, (_, entries) in line.outputs.items():
        results[name].reshape(-1)[:] = [values[k] for k in entries]
    return Line.of(tape, line.inputs, results)


class Fingerprint:
    """The values of numbers at two points, modulo a prime."""

    def __init__(self, prime: int) -> None:
        self.prime = prime
        self.numbers = random.Random(0)  # the same in each run, as programs are
        self.others: dict[Any, Mark] = {}  # of arguments and functions

    def of(self, node: Node, marks: Mapping[int, Mark] | Sequence[Mark]) -> Mark:
        """Return that of an operation on numbers whose fingerprints are known."""
        operation, prime = node[0], self.prime
        if operation == "const":
            value = node[1].numerator * _known_inverse(node[1].denominator, prime) % prime
            return value, value
        if operation == "input":
            return self.free(node[1])
        x0, x1 = marks[node[1]]
        y0, y1 = marks[node[-1]]
        match operation:
            case "mul":
                return x0 * y0 % prime, x1 * y1 % prime
            case "add":
                return (x0 + y0) % prime, (x1 + y1) % prime
            case "sub":
                return (x0 - y0) % prime, (x1 - y1) % prime
            case "neg":
                return -x0 % prime, -x1 % prime
            case "div" if y0 and y1:
                return x0 * _inverse(y0, prime) % prime, x1 * _inverse(y1, prime) % prime
            case "cos":
                return tuple((1 - t * t) * _inverse(1 + t * t, prime) % prime for t in self.free((x0, x1)))
            case "sin":
                return tuple(2 * t * _inverse(1 + t * t, prime) % prime for t in self.free((x0, x1)))
        return self.free((operation, *[marks[k] for k in node[1:]]))

    def free(self, key: Any) -> Mark:
        """Return a random fingerprint, the same for the same key."""
        if key not in self.others:
            self.others[key] = self.numbers.randrange(self.prime), self.numbers.randrange(self.prime)
        return self.others[key]


def _inverse(x: int, prime: int) -> int:
    return pow(x, -1, prime)


_known_inverse = lru_cache(_inverse)  # of the denominators of constants, a few powers of two


class ConstantTable:
    """What the constants of a line are, by fingerprints modulo the larger prime, which few numbers need."""

    def __init__(self, line: Line) -> None:
        self.nodes, self.fingerprint = line.nodes, Fingerprint(LARGER)
        self.marks: dict[int, Mark] = {}
        self.known: dict[int, Fraction | None] = {0: Fraction(0)}

    def of(self, k: int, mark: int) -> Fraction | None:
        """Return the constant that a node is in every state, and that has this fingerprint; None if it is too large."""
        if mark not in self.known:
            self.known[mark] = self.value(k)
        return self.known[mark]

    def value(self, k: int) -> Fraction | None:
        """Return the constant that a node is, if it is a quotient of numbers that are not large."""
        for j in ordered([k], lambda j: [i for i in operands(self.nodes[j]) if i not in self.marks]):
            self.marks[j] = self.fingerprint.of(self.nodes[j], self.marks)
        a, b, u, v = LARGER, self.marks[k][0], 0, 1
        while b >= MAX_CONSTANT:  # Euclid: b is v times the fingerprint at any time
            a, b, u, v = b, a % b, v, u - a // b * v
        return Fraction(b, v) if abs(v) < MAX_CONSTANT else None
