"""Exact derivatives of what is on a tape: next to each number go its derivatives, those that are not always zero.

>>> from straightline.number import numbers
>>> tape = Tape()
>>> x, y = numbers(tape, "x", 2)
>>> jacobian(tape, np.array([x * y, 3 * x]), directions(np.array([x, y])), 2)[1]
array([Fraction(3, 1), Fraction(0, 1)], dtype=object)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from .line import needed
from .number import ZERO, Array, Node, Number, Tape, select

__all__ = ["Tangent", "directions", "jacobian", "nonzero"]

Tangent = dict[int, Any]  # the derivatives of a number, by column; what is not in it is zero


def directions(x: Array) -> dict[int, Tangent]:
    """Return the tangents of independent numbers: entry k moves with column k."""
    return {number.index: {k: Fraction(1)} for k, number in enumerate(x.flat)}


def jacobian(tape: Tape, results: Array, tangents: Mapping[int, Tangent | None], columns: int) -> Array:
    """Return the derivatives of results, shape (*results.shape, columns), where those of some nodes are known.

    A node whose tangent is None must not be needed, except by nodes whose tangents are known.
    """
    indices = [*map(tape.node, results.flat)]
    known: dict[int, Tangent] = {}
    nodes = tape.nodes
    for k in needed(nodes, indices, tangents):
        tangent = tangents[k] if k in tangents else _tangent(tape, nodes, k, known)
        if tangent is None:
            raise NotImplementedError(f"{Number(tape, k)!r} is used, and not by nodes whose derivatives are given")
        known[k] = tangent
    J = np.full((len(indices), columns), Fraction(0), object)
    for row, index in zip(J, indices):
        row[[*known[index]]] = [*known[index].values()]
    return J.reshape(*results.shape, columns)


def _tangent(tape: Tape, nodes: Sequence[Node], k: int, known: Mapping[int, Tangent]) -> Tangent:
    """Return the tangent of a node from those of its operands: the rules of differentiation."""
    operation, *places = nodes[k]
    if operation in ("input", "const") or not any(known[j] for j in places):
        return {}
    (x, dx), *others = [(nodes[j][1] if nodes[j][0] == "const" else Number(tape, j), known[j]) for j in places]
    none: tuple[Any, Tangent] = None, {}
    y, dy = others[0] if others else none
    match operation:
        case "add":
            return _sum(dx, dy)
        case "sub":
            return _sum(dx, _times(-1, dy))
        case "neg":
            return _times(-1, dx)
        case "mul":
            return _sum(_times(y, dx), _times(x, dy))
        case "div":  # z = x / y: dz = (dx − z dy) / y
            return {column: d / y for column, d in _sum(dx, _times(-Number(tape, k), dy)).items()}
        case "sin":
            return _times(x.cos(), dx)
        case "cos":
            return _times(-x.sin(), dx)
        case "sqrt":
            return _times(1 / (2 * Number(tape, k)), dx)
        case "atan2":  # z = atan2(x, y): dz = (y dx − x dy) / (x² + y²)
            return {c: d / (x * x + y * y) for c, d in _sum(_times(y, dx), _times(-x, dy)).items()}
        case "select":  # the derivative of what is chosen
            chosen = others[1][1]
            return nonzero({c: select(x, dy.get(c, ZERO), chosen.get(c, ZERO)) for c in dy | chosen})
    raise NotImplementedError(f"the derivative of {operation!r}")


def _times(factor: Any, tangent: Tangent) -> Tangent:
    return nonzero({column: factor * d for column, d in tangent.items()}) if tangent else tangent


def _sum(a: Tangent, b: Tangent) -> Tangent:
    return nonzero({column: a.get(column, 0) + b.get(column, 0) for column in a | b}) if a and b else a or b


def nonzero(tangent: Tangent) -> Tangent:
    """Return a tangent without the derivatives that are zero."""
    return {column: d for column, d in tangent.items() if isinstance(d, Number) or d != 0}
