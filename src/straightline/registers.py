"""A straight line in NumPy, for many states: a call for each operation, or for the same one in several limbs (`packs`).

The numbers of all states are rows of one array, those of a pack one after the other; there are not many more rows than
numbers that are still needed.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from .line import Line, ordered, rewritten
from .number import Array, Number
from .packs import Packs, View
from .sine import split

__all__ = ["Registers"]

NAMES = {
    "sub": "subtract",
    "mul": "multiply",
    "div": "divide",
    "neg": "negative",
    "round": "rint",
    "atan2": "arctan2",
}
"""Operations that have another name in NumPy."""

CHUNK = 2048  # states that are computed together: for fewer, a call takes longer than what it computes
MEMORY = 2**24  # bytes that the rows of a chunk take together, at most
TOGETHER = 64  # entries of a result that are brought together before they are written: more would not stay in the cache

BUFFER = 16
"""NumPy's smallest buffer: with a larger one, rows that do not lie next to each other take up to twice as long."""


class Registers:
    """A line as a list of NumPy's calls, in any of its floating-point types, or in numbers of mpmath, as objects."""

    def __init__(self, line: Line, dtype: np.dtype[Any]) -> None:
        line = with_half_angles(line) if dtype == np.float64 else line
        self.dtype, self.nodes = dtype, line.nodes
        self.packs = Packs(line)
        self.order = [*ordered(self._found((k,) for k in line.results), lambda k: self._found(self.packs.operands[k]))]
        self.first, self.count = self._placed(line.results)
        column = {(name, *k): j for name, shape in line.inputs.items() for j, k in enumerate(np.ndindex(shape))}
        number = {name: k for k, name in enumerate(line.inputs)}
        self.inputs: list[tuple[int, slice | list[int], slice]] = []  # arrays, their columns, and rows
        self.copies: list[tuple[list[int], slice]] = []  # rows, and where they are needed again, in another order
        for pack in (pack for pack in self.order if self._operation(pack) == "input"):
            lanes = self.packs.packs[pack]
            place = slice(self.first[pack], self.first[pack] + len(lanes))
            if self._found([lanes[:1]]) == [pack]:
                keys = [self.nodes[k][1] for k in lanes]
                self.inputs.append((number[keys[0][0]], _slice_of([column[key] for key in keys]), place))
            else:
                self.copies.append(([self._row(k) for k in lanes], place))
        self.constants: dict[int, int] = {}  # the rows of results that are constants
        self.results = [
            (array, slice(k, k + TOGETHER), np.array([self._row(j) for j in entries[k : k + TOGETHER]], np.intp))
            for array, (_, entries) in enumerate(line.outputs.values(), len(line.inputs))
            for k in range(0, len(entries), TOGETHER)
        ]
        self.unused: list[tuple[Array, Array, list[partial[Any]]]] = []  # rows that no thread fills, and calls

    def _operation(self, pack: int) -> str:
        operation: str = self.nodes[self.packs.packs[pack][0]][0]
        return operation

    def _found(self, lanes: Iterable[tuple[int, ...]]) -> list[int]:
        """Return the packs in which some nodes lie; constants lie in none."""
        return [view[0] for one in lanes if (view := self.packs.view(one))]

    def _placed(self, results: Sequence[int]) -> tuple[dict[int, int], int]:
        """Return the first row of each pack, and how many rows there are: what is not needed any more makes room."""
        needed = {pack: {*self._found(self.packs.operands[pack])} for pack in self.order}
        last = {other: pack for pack in self.order for other in needed[pack]}
        last |= dict.fromkeys(self._found((k,) for k in results), -1)
        free: dict[int, list[int]] = defaultdict(list)  # by the number of lanes
        first: dict[int, int] = {}
        count = 0
        for pack in sorted(self.order, key=lambda pack: self._operation(pack) != "input"):  # arguments come first
            for other in needed[pack]:
                if last[other] == pack:
                    free[len(self.packs.packs[other])].append(first[other])
            lanes = len(self.packs.packs[pack])
            first[pack] = free[lanes].pop() if free[lanes] else count
            count = max(count, first[pack] + lanes)
        return first, count

    def _row(self, k: int) -> int:
        """Return the row of a result; constants have theirs after all others."""
        if view := self.packs.view((k,)):
            return self.first[view[0]] + view[1]
        return self.count + self.constants.setdefault(k, len(self.constants))

    def run(self, arrays: Sequence[Array]) -> None:
        """Fill the results: each array has shape (states, entries)."""
        states, count = len(arrays[0]), self.count + len(self.constants)
        chunks = -(-states // max(64, min(CHUNK, MEMORY // max(1, count * self.dtype.itemsize))))
        width = -(-states // chunks)
        rows, taken, calls = self.unused.pop() if self.unused else (np.empty((0, 0)), np.empty((0, 0)), [])
        with np.errstate(all="ignore"):  # what is not finite is seen in the result `alarm`
            np.setbufsize(BUFFER)
            if rows.shape[1] != width:
                rows = np.empty((count, width), self.dtype)
                taken = np.empty((TOGETHER, width), self.dtype)
                calls = [*self._calls(rows)]
            for start in range(0, states, width):
                start = min(start, states - width)
                self._run(rows, taken, calls, [x[start : start + width] for x in arrays])
        self.unused.append((rows, taken, calls))

    def _calls(self, rows: Array) -> Iterator[partial[Any]]:
        """Yield NumPy's calls between these rows: functions with their operands and results."""
        for k, row in self.constants.items():
            rows[self.count + row] = as_number_of(self.dtype, self.nodes[k][1])
        for pack in self.order:
            if (operation := self._operation(pack)) != "input":
                x = [self._values(rows, lanes) for lanes in self.packs.operands[pack]]
                filled = self._values(rows, self.packs.packs[pack], (pack, 0, 1))
                yield partial(function_of(operation, self.dtype), *x, filled)

    def _values(self, rows: Array, lanes: tuple[int, ...], view: View | None = None) -> Any:
        """Return the rows of some nodes, lane by lane, or the constants."""
        if view := view or self.packs.view(lanes):
            pack, start, step = view
            start += self.first[pack]
            return rows[start] if len(lanes) == 1 else rows[start : start + step * len(lanes) : step]
        constants = [as_number_of(self.dtype, self.nodes[k][1]) for k in lanes]
        return np.array(constants, self.dtype)[:, None] if len(lanes) > 1 else constants[0]

    def _run(self, rows: Array, taken: Array, calls: Sequence[partial[Any]], arrays: Sequence[Array]) -> None:
        """Fill the results of a chunk."""
        for array, columns, place in self.inputs:
            rows[place] = arrays[array][:, columns].mT
        for again, place in self.copies:
            rows[place] = rows[again]
        for call in calls:
            call()
        for array, columns, index in self.results:
            arrays[array][:, columns] = rows.take(index, 0, taken[: len(index)], "clip").mT


def _slice_of(columns: list[int]) -> slice | list[int]:
    """Return columns as a slice if they lie next to each other: that is a view, and nothing is copied."""
    first = columns[0]
    return slice(first, first + len(columns)) if columns == [*range(first, first + len(columns))] else columns


def with_half_angles(line: Line) -> Line:
    """Return a line in which t = tan x/2 gives both sin x = 2 t / (1 + t²) and cos x = (1 − t²) / (1 + t²).

    Of doubles NumPy has tan for eight at once where the processor allows it, and sin and cos one by one. The pair is a
    rotation to the last digit, and the angle's as much as t is the tangent.
    """

    def tangent(x: Number) -> Number:
        return x.tape.apply("tan", x / 2)

    def sine(x: Number) -> Any:
        return 2 * tangent(x) / (1 + tangent(x) * tangent(x))

    def cosine(x: Number) -> Any:
        return (1 - tangent(x) * tangent(x)) / (1 + tangent(x) * tangent(x))

    return rewritten(line, {"sin": sine, "cos": cosine})


def function_of(operation: str, dtype: np.dtype[Any]) -> Any:
    """Return what computes an operation; where numbers of mpmath raise an error, the result is NaN as in NumPy."""
    if operation == "select":
        return select
    if not dtype.hasobject or operation not in ("div", "sqrt", "sin", "cos"):
        return getattr(np, NAMES.get(operation, operation))
    from mpmath import mp

    if operation == "div":
        return np.frompyfunc(lambda a, b: a / b if b else mp.nan, 2, 1)
    function = getattr(mp, operation)
    return np.frompyfunc(lambda a: function(a) if operation != "sqrt" or a >= 0 else mp.nan, 1, 1)


def select(x: Array, a: Any, b: Any, filled: Array) -> None:
    """Fill in a where x, or the real part of it, is above 0, and b elsewhere."""
    filled[...] = np.where(np.real(x) > 0, a, b)


def as_number_of(dtype: np.dtype[Any], x: Fraction) -> Any:
    """Return a constant in a number type, to all of its digits: three doubles have more than quadruple precision."""
    if dtype.hasobject:
        from mpmath import mp

        return mp.convert(x)
    first, second, third = (dtype.type(float(part)) for part in split(x, 3))
    return first + (second + third)
