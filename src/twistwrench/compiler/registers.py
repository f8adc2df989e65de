"""A straight line in NumPy, for many states: each operation is one call, and its result goes into one of a few arrays.

Which works for every number type that NumPy has. There are no more arrays than results that are still needed.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from ..arrays import Array
from .line import Line, operands
from .pairs import split

__all__ = ["Registers"]

FUNCTIONS = {
    "add": np.add,
    "sub": np.subtract,
    "mul": np.multiply,
    "div": np.divide,
    "neg": np.negative,
    "sin": np.sin,
    "cos": np.cos,
    "sqrt": np.sqrt,
    "abs": np.abs,
    "round": np.rint,
}

CHUNK = 2048
"""States that are computed together: for fewer, a call takes longer than what it computes."""

MEMORY = 2**26
"""Bytes that the arrays of a chunk take together, at most."""


class Registers:
    """A line as a list of NumPy's calls.

    Parameters
    ----------
    line : Line
    dtype : dtype
        Any floating-point type of NumPy, complex ones too; of objects, numbers of mpmath, whose constants have as many
        digits as are set now.
    """

    def __init__(self, line: Line, dtype: np.dtype[Any]) -> None:
        self.dtype, self.inputs, functions = dtype, len(line.inputs), functions_of(dtype)
        entry: dict[Any, tuple[int, int]] = {}
        for a, (name, shape) in enumerate(line.inputs.items()):
            entry |= {(name, *k): (a, j) for j, k in enumerate(np.ndindex(shape))}
        last = {j: k for k, node in enumerate(line.nodes) for j in operands(node)}
        results = [k for _, entries in line.outputs.values() for k in entries]
        last |= dict.fromkeys(results, len(line.nodes))
        row = {k: place for place, k in reversed([*enumerate(results)])}  # each result has a row of its own
        place: dict[int, int] = {}  # the row of each node, after the results' the registers; constants from -1 back
        free: list[int] = []
        self.count, self.constants = len(results), list[Any]()
        self.steps: list[tuple[np.ufunc | None, Sequence[int], int]] = []  # without a function: array and column
        for k, (operation, *rest) in enumerate(line.nodes):
            if operation == "const":
                self.constants.insert(0, as_number_of(dtype, rest[0]))
                place[k] = -len(self.constants)
                continue
            needed = operands(line.nodes[k])
            free += {place[j] for j in needed if last[j] == k and place[j] >= len(results)}
            if k in row:
                place[k] = row[k]
            elif free:
                place[k] = free.pop()
            else:
                place[k], self.count = self.count, self.count + 1
            if operation == "input":
                self.steps.append((None, entry[rest[0]], place[k]))
            else:
                self.steps.append((functions[operation], [place[j] for j in needed], place[k]))
        # What is left are constants, and results that occur twice.
        self.copies = [(k, place[node]) for k, node in enumerate(results) if place[node] != k]

    def run(self, arrays: Sequence[Array]) -> None:
        """Fill the results: each array has shape (states, entries)."""
        states, most = len(arrays[0]), MEMORY // max(1, self.count * self.dtype.itemsize)
        chunks = -(-states // max(64, min(CHUNK, most)))
        with np.errstate(all="ignore"):  # what is not finite is seen in the result `alarm`
            for k in range(chunks):
                self._run([x[states * k // chunks : states * (k + 1) // chunks] for x in arrays])

    def _run(self, arrays: Sequence[Array]) -> None:
        """Fill the results of a chunk."""
        rows = np.empty((self.count, len(arrays[0])), self.dtype)
        values: list[Any] = [*rows, *self.constants]
        for function, needed, place in self.steps:
            if function is None:
                values[place][...] = arrays[needed[0]][:, needed[1]]
            elif len(needed) == 2:
                function(values[needed[0]], values[needed[1]], values[place])
            else:
                function(values[needed[0]], values[place])
        for row, place in self.copies:
            rows[row] = values[place]
        start = 0
        for x in arrays[self.inputs :]:
            x[...] = rows[start : start + x.shape[1]].mT
            start += x.shape[1]


def functions_of(dtype: np.dtype[Any]) -> dict[str, np.ufunc]:
    """Return what computes each operation; where numbers of mpmath raise an error, the result is NaN as in NumPy."""
    if not dtype.hasobject:
        return FUNCTIONS
    from mpmath import mp

    def quotient(a: Any, b: Any) -> Any:
        return a / b if b else mp.nan

    def root(a: Any) -> Any:
        return mp.sqrt(a) if a >= 0 else mp.nan

    own = {"div": np.frompyfunc(quotient, 2, 1), "sqrt": np.frompyfunc(root, 1, 1)}
    return FUNCTIONS | own | {name: np.frompyfunc(getattr(mp, name), 1, 1) for name in ("sin", "cos")}


def as_number_of(dtype: np.dtype[Any], x: Fraction) -> Any:
    """Return a constant in a number type, to all of its digits: three doubles have more than quadruple precision."""
    if dtype.hasobject:
        from mpmath import mp

        return mp.convert(x)
    first, second, third = (dtype.type(float(part)) for part in split(x, 3))
    return first + (second + third)
