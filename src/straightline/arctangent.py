"""The angle of a point as arithmetic, for many points at once, within two roundings of the true value.

By its signs and by which coordinate is larger, the point lies in one of eight sectors. It is mirrored into the first
one, and turned back by π/4 if it lies beyond π/8, for which a sum and a difference are enough. What is left is a
tangent t of at most tan π/8, whose angle is a series, t − t³/3 + t⁵/5 − …. The sector tells from which multiple of π/4
it counts, and to which side.
"""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from typing import Any

from .line import Line, rewritten
from .number import Number, select
from .sine import KIND, PI, split

__all__ = ["with_arctangents"]

TERMS = {"double": 21, "float": 10}  # so many terms of the series reach the last digit for |t| ≤ tan π/8

SILVER = Fraction(985, 2378)
"""About tan π/8 = √2 − 1: any number near it will do."""


def with_arctangents(line: Line, scalar: str) -> Line:
    """Return a line for "double" or "float" in which atan2 is arithmetic, with a b + c in one rounding.

    >>> import numpy as np
    >>> from .recorder import straight_line
    >>> line = straight_line(lambda p: np.arctan2(p[1], p[0]), p=(2,))
    >>> [one for one in with_arctangents(line, "double").operations if one not in ("neg", "sub", "add", "mul")]
    ['abs', 'select', 'div', 'fma']
    """
    if "atan2" not in line.operations:
        return line
    return rewritten(line, {"atan2": partial(angle, scalar=scalar)})


def angle(y: Number, x: Number, scalar: str) -> Any:
    """Write the angle of the point (x, y), from −π to π."""
    apply = x.tape.apply
    a, b = apply("abs", y), apply("abs", x)
    steep = a - b
    small, large = select(steep, b, a), select(steep, a, b)
    over = small - SILVER * large  # above π/8
    t = select(over, small - large, small) / select(over, small + large, large)
    eighths, side = select(over, 1, 0), 1  # the angle is so many times π/4, and the angle of t to this side
    eighths, side = select(steep, 2 - eighths, eighths), select(steep, -1, 1)
    eighths, side = select(x, eighths, 4 - eighths), select(x, side, -side)
    high, low = split(PI / 4, 2, KIND[scalar])
    size = apply("fma", eighths, high, apply("fma", eighths, low, side * series(t, TERMS[scalar])))
    return select(-y, -size, size)


def series(t: Number, terms: int) -> Any:
    """Write t − t³/3 + t⁵/5 − … with so many terms."""
    square = t * t
    s: Any = Fraction((-1) ** (terms - 1), 2 * terms - 1)
    for n in range(terms - 2, 0, -1):
        s = t.tape.apply("fma", s, square, Fraction((-1) ** n, 2 * n + 1))
    return t.tape.apply("fma", s * square, t, t)
