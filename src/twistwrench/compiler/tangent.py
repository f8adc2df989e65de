"""Exact derivatives of a straight line: next to each number go its derivatives, those that are not always zero.

What depends on q does so through the placements T(q) of the joints. A step ε along entry k of v leads from T to
T exp(ε S e_k): see `Joint`. So dT = T [S e_k]∧, with the columns of R in the place of a derivative: one rule for every
kind of joint, nv columns, and neither a quaternion nor its norm is differentiated.

>>> from twistwrench.compiler.number import numbers
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

from ..arrays import Array
from ..model import Model
from ..spatial.rotation import cross_matrix
from .line import needed
from .number import Node, Number, Tape

__all__ = ["directions", "jacobian", "steps"]

Tangent = dict[int, Any]  # the derivatives of a number, by column; what is not in it is zero


def directions(x: Array) -> dict[int, Tangent]:
    """Return the tangents of independent numbers: entry k moves with column k."""
    return {number.index: {k: Fraction(1)} for k, number in enumerate(x.flat)}


def steps(model: Model, q: Array) -> dict[int, Tangent | None]:
    """Return the tangents of the entries of all T(q) for steps along v: Ṫ = T [V]∧ with V = S e_k (49.2).

    The entries of q themselves have none: what depends on them in another way is not to be differentiated.
    """
    tangents: dict[int, Any] = {}
    for joint, qs, vs in zip(model.joints, model.q_slice, model.v_slice):
        if joint is None:
            continue
        T, S = joint.transform(q[qs]), joint.subspace(object)
        for k in range(joint.nv):
            dR, dp = T.rotation @ cross_matrix(S[:3, k]), T.rotation @ S[3:, k]
            for x, dx in zip([*T.rotation.flat, *T.translation.flat], [*dR.flat, *dp.flat]):
                if isinstance(x, Number):
                    factor, index = x.tape.factors.get(x.index, (1, x.index))  # the tape puts it together with the next
                    column = {vs.start + k: dx / (-factor if x.minus else factor)}
                    tangents.setdefault(index, {}).update(_nonzero(column))
    return {number.index: None for number in q.flat} | tangents


def jacobian(tape: Tape, results: Array, tangents: Mapping[int, Tangent | None], columns: int) -> Array:
    """Return the derivatives of results, shape (*results.shape, columns), where those of some nodes are known."""
    indices = [*map(tape.node, results.flat)]
    known: dict[int, Tangent] = {}
    nodes = tape.nodes
    for k in needed(nodes, indices, tangents):
        tangent = tangents[k] if k in tangents else _tangent(tape, nodes, k, known)
        if tangent is None:
            raise NotImplementedError(f"{Number(tape, k)!r} is used, and not by the placement of a joint")
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
    y, dy = others[0] if others else (None, {})
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
    raise NotImplementedError(f"the derivative of {operation!r}")


def _times(factor: Any, tangent: Tangent) -> Tangent:
    return _nonzero({column: factor * d for column, d in tangent.items()}) if tangent else tangent


def _sum(a: Tangent, b: Tangent) -> Tangent:
    return _nonzero({column: a.get(column, 0) + b.get(column, 0) for column in a | b}) if a and b else a or b


def _nonzero(tangent: Tangent) -> Tangent:
    return {column: d for column, d in tangent.items() if isinstance(d, Number) or d != 0}
