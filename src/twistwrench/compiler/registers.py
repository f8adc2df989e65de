"""A straight line in NumPy, for many states: each operation is one call, and its result goes into one of a few arrays.

Which works for every number type that NumPy has. The arrays stay in the cache of the processor: there are no more of
them than results that are still needed, and a chunk of states is as long as fits.
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

CHUNK = 2**20
"""Bytes that the arrays of a chunk take together."""


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
        self.dtype, functions = dtype, functions_of(dtype)
        entry: dict[Any, tuple[int, int]] = {}
        for a, (name, shape) in enumerate(line.inputs.items()):
            entry |= {(name, *k): (a, j) for j, k in enumerate(np.ndindex(shape))}
        last = {j: k for k, node in enumerate(line.nodes) for j in operands(node)}
        last |= {k: len(line.nodes) for _, entries in line.outputs.values() for k in entries}
        place: dict[int, int] = {}  # the register of each node; constants are counted backwards from -1
        free: list[int] = []
        self.count, self.constants = 0, list[Any]()
        self.steps: list[tuple[np.ufunc | None, Sequence[int], int]] = []  # without a function: array and column
        for k, (operation, *rest) in enumerate(line.nodes):
            if operation == "const":
                self.constants.insert(0, as_number_of(dtype, rest[0]))
                place[k] = -len(self.constants)
                continue
            needed = operands(line.nodes[k])
            free += {place[j] for j in needed if last[j] == k and place[j] >= 0}
            if not free:
                free.append(self.count)
                self.count += 1
            place[k] = free.pop()
            if operation == "input":
                self.steps.append((None, entry[rest[0]], place[k]))
            else:
                self.steps.append((functions[operation], [place[j] for j in needed], place[k]))
        self.results = [[place[k] for k in entries] for _, entries in line.outputs.values()]

    def run(self, arrays: Sequence[Array]) -> None:
        """Fill the results: each array has shape (states, entries)."""
        size = max(64, CHUNK // (max(1, self.count) * self.dtype.itemsize))
        with np.errstate(all="ignore"):  # what is not finite is seen in the result `alarm`
            for start in range(0, len(arrays[0]), size):
                self._run([x[start : start + size] for x in arrays])

    def _run(self, arrays: Sequence[Array]) -> None:
        """Fill the results of a chunk."""
        values: list[Any] = [*np.empty((self.count, len(arrays[0])), self.dtype), *self.constants]
        for function, needed, place in self.steps:
            if function is None:
                values[place][...] = arrays[needed[0]][:, needed[1]]
            elif len(needed) == 2:
                function(values[needed[0]], values[needed[1]], values[place])
            else:
                function(values[needed[0]], values[place])
        for x, places in zip(arrays[-len(self.results) :], self.results):
            for k, place in enumerate(places):
                x[:, k] = values[place]


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
