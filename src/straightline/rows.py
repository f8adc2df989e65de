"""A line as text for JAX: rows of like operations, in one loop.

XLA compiles a kernel for every few operations, which takes it tens of milliseconds each: thousands of numbers with a
name each take seconds to minutes. A loop is compiled once, however often it runs. So all numbers are entries of one
vector, operations of one kind that do not wait for each other form a row, and each pass of the loop computes a row.
The order is decided by list scheduling (R. L. Graham, 1966): the operations with the longest way to a result first.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Mapping, Sequence
from fractions import Fraction
from math import prod
from typing import NamedTuple

import numpy as np

from .line import LEAVES, Line, operands
from .number import Node

__all__ = ["jax_source"]

ONE, ZERO = -1, -2  # constants that an operation may need besides those of the line: keys beside the indices of nodes

FORMULAS = {"mul": "c + sign * a * b", "div": "a / b", "select": "where(a > 0, b, c)"}

LOOP = """
    def compute_row(x, row):
        kind, start, a, b, c, sign = row
        return dynamic_update_slice(x, switch(kind, KINDS, x[a], x[b], x[c], sign), (start,)), None

    x, _ = scan(compute_row, x, [asarray(column) for column in zip(*ROWS)])
"""


class Operation(NamedTuple):
    """An operation of three operands: sums, differences and signs are products to which something is added."""

    kind: str
    operands: tuple[int, int, int]
    sign: int = 1


PADDING = Operation("", (ONE, ONE, ONE))  # fills a row that is not full: no function and no quotient fails at 1


def jax_source(line: Line, name: str) -> str:
    """Return a line as the text of a function for JAX: arrays of one state in, arrays out.

    >>> from straightline import straight_line
    >>> print(jax_source(straight_line(lambda x: x[:2] * x[2] + 1, x=(3,)), "f"))
    from jax.lax import dynamic_update_slice, scan, switch
    from jax.numpy import asarray, concatenate, result_type, zeros
    <BLANKLINE>
    KINDS = [
        lambda a, b, c, sign: c + sign * a * b,
    ]
    ROWS = [  # the kind, where the results go, where the operands are, and signs
        (0, 5, [0, 1], [2, 2], [3, 3], [1, 1]),
    ]
    <BLANKLINE>
    <BLANKLINE>
    def f(x):
        number = result_type(x, float)
        x = concatenate([x.reshape(3), asarray([1.0, 0.0], number), zeros(2, number)])
    <BLANKLINE>
        def compute_row(x, row):
            kind, start, a, b, c, sign = row
            return dynamic_update_slice(x, switch(kind, KINDS, x[a], x[b], x[c], sign), (start,)), None
    <BLANKLINE>
        x, _ = scan(compute_row, x, [asarray(column) for column in zip(*ROWS)])
        return x[asarray([5, 6], int)].reshape(2)
    <BLANKLINE>
    """
    table = _Table(line)
    size = len(table.rows) * table.width
    given = [f"{array}.reshape({prod(shape)})" for array, shape in line.inputs.items()]
    parts = [*given, f"asarray({[*map(float, table.constants)]}, number)", f"zeros({size}, number)"]
    results = [
        f"x[asarray({[table.place[k] for k in entries]}, int)].reshape({', '.join(map(str, shape)) or '()'})"
        for shape, entries in line.outputs.values()
    ]
    body = [
        f"def {name}({', '.join(line.inputs)}):",
        f"    number = result_type({', '.join([*line.inputs, 'float'])})",
        f"    x = concatenate([{', '.join(parts)}])",
        *([LOOP.rstrip()] if table.rows else []),
        f"    return {', '.join(results)}",
        "",
    ]
    functions = {"asarray", "concatenate", "result_type", "zeros"}.union(*map(_functions, table.kinds))
    head = [f"from jax.numpy import {', '.join(sorted(functions))}"]
    if table.rows:
        head.insert(0, "from jax.lax import dynamic_update_slice, scan, switch")
        head += ["", "KINDS = [", *(f"    lambda a, b, c, sign: {_formula(kind)}," for kind in table.kinds), "]"]
        head += ["ROWS = [  # the kind, where the results go, where the operands are, and signs"]
        head += [*(f"    {row}," for row in table.text()), "]"]
    return "\n".join([*head, "", "", *body])


class _Table:
    """Where each number of a line stands in one vector, arguments and constants first, and which row computes it."""

    def __init__(self, line: Line) -> None:
        self.operations = _operations(line)
        self.rows = _rows(self.operations)
        self.width = max(map(len, self.rows), default=0)
        self.kinds = sorted({self.operations[row[0]].kind for row in self.rows})
        keys = [(array, *k) for array, shape in line.inputs.items() for k in np.ndindex(shape)]
        known = {k: node[1] for k, node in enumerate(line.nodes) if node[0] == "const"}
        self.constants = [*dict.fromkeys([Fraction(1), Fraction(0), *known.values()])]
        self.start = len(keys) + len(self.constants)
        argument = {key: k for k, key in enumerate(keys)}
        constant = {value: k for k, value in enumerate(self.constants, len(keys))}
        self.place = {k: argument[node[1]] for k, node in enumerate(line.nodes) if node[0] == "input"}
        self.place |= {k: constant[value] for k, value in known.items()}
        self.place |= {ONE: constant[Fraction(1)], ZERO: constant[Fraction(0)]}
        for number, row in enumerate(self.rows):
            self.place |= {k: self.start + number * self.width + lane for lane, k in enumerate(row)}

    def text(self) -> list[tuple[object, ...]]:
        """Return the rows as numbers."""
        found = list[tuple[object, ...]]()
        for number, row in enumerate(self.rows):
            lanes = [self.operations[k] for k in row] + [PADDING] * (self.width - len(row))
            columns = [[self.place[k] for k in column] for column in zip(*(lane.operands for lane in lanes))]
            kind = self.kinds.index(lanes[0].kind)
            found.append((kind, self.start + number * self.width, *columns, [lane.sign for lane in lanes]))
        return found


def _operations(line: Line) -> dict[int, Operation]:
    """Return the operations of a line; a product that is only added to something is one with the sum."""
    nodes, found = line.nodes, dict[int, Operation]()
    uses, results = Counter(j for node in nodes for j in operands(node)), {*line.results}
    for k, (kind, *needed) in enumerate(nodes):
        if kind in LEAVES:
            continue
        a, b, c = (*needed, ONE, ONE)[:3]
        sign = -1 if kind in ("sub", "neg") else 1
        if kind == "add" and _is_inner(a, nodes, uses, results):
            a, b = b, a
        if kind in ("add", "sub") and _is_inner(b, nodes, uses, results):
            factor, other, _ = found.pop(b).operands
            found[k] = Operation("mul", (factor, other, a), sign)
        elif kind in ("add", "sub"):
            found[k] = Operation("mul", (b, ONE, a), sign)
        elif kind in ("mul", "neg"):
            found[k] = Operation("mul", (a, b, ZERO), sign)
        else:
            found[k] = Operation(kind, (a, b, c))
    return found


def _is_inner(k: int, nodes: Sequence[Node], uses: Mapping[int, int], results: Container[int]) -> bool:
    """Return whether a node is a product that one operation needs, once, and no result."""
    return nodes[k][0] == "mul" and uses[k] == 1 and k not in results


def _rows(operations: Mapping[int, Operation]) -> list[list[int]]:
    """Return the operations of each row, so wide that there need not be many more rows than the longest way has."""
    needs = {k: {j for j in one.operands if j in operations} for k, one in operations.items()}
    users: dict[int, list[int]] = {k: [] for k in operations}
    for k, needed in needs.items():
        for j in needed:
            users[j].append(k)
    way = dict[int, int]()  # operations from this one to a result, at most
    for k in reversed(needs):
        way[k] = 1 + max((way[j] for j in users[k]), default=0)
    width = -(-len(operations) // max(way.values(), default=1))
    ready = [(-way[k], k) for k, needed in needs.items() if not needed]
    rows = list[list[int]]()
    while ready:
        kind = operations[min(ready)[1]].kind
        row = sorted(one for one in ready if operations[one[1]].kind == kind)[:width]
        rows.append([k for _, k in row])
        taken = {*row}
        ready = [one for one in ready if one not in taken]
        for _, k in row:
            for user in users[k]:
                needs[user].discard(k)
                if not needs[user]:
                    ready.append((-way[user], user))
    return rows


def _formula(kind: str) -> str:
    """Return what an operation does with its operands a, b and c."""
    return FORMULAS.get(kind, f"{kind}(a, b)" if kind == "atan2" else f"{kind}(a)")


def _functions(kind: str) -> set[str]:
    """Return the functions of JAX that an operation calls."""
    return {"where"} if kind == "select" else set() if kind in (*FORMULAS, "abs") else {kind}
