"""The first line of a program that computes a value which no right solution has, though all that it uses is there."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from .compare import FLOOR, Array
from .program import Program, text_of
from .text import Text

__all__ = ["first_wrong_line"]

RTOL = 1e-9

FIRST_LINE = Text(
    "Look at line {line}, `{text}`: what it uses occurs in a right solution, what it computes does not.",
    "请看第 {line} 行 `{text}`：它用到的值在正确解法中都有，它算出的值却没有。",
)


def first_wrong_line(program: Program, arguments: Sequence[Any], solutions: Sequence[Program]) -> Text | None:
    """Report the first statement of a traced program that goes wrong; None where none can be told.

    A value is known if an argument or an expression of a right solution has it, whatever its sign.
    """
    known = _Known()
    for x in (*arguments, *(value for solution in solutions for _, value in solution.events)):
        known.add(x)
    statements = [*_statements(program)]
    for k, (node, value, used) in enumerate(statements):
        if not [*_arrays(value)] or known.has(value) or not all(map(known.has, used)):
            continue
        later = statements[k + 1 :]
        if not any(known.has(x) and any(_equal(value, y) for y in uses) for _, x, uses in later):
            return FIRST_LINE.fill(line=node.lineno, text=text_of(node))  # else only another way to what is right
    return None


def _statements(program: Program) -> Iterator[tuple[Any, Any, list[Any]]]:
    """Yield each assignment and return that has run, with its value and the values that it uses."""
    used: list[Any] = []
    owner = {
        id(place.node): next((x for x in reversed(place.parents) if isinstance(x, ast.stmt)), None)
        for place in program.places
    }
    for node, value in program.events:
        statement = owner[id(node)]
        if isinstance(statement, ast.Assign | ast.Return) and node is statement.value:
            yield statement, value, used
            used = []
        elif isinstance(node, ast.Name | ast.Subscript | ast.Attribute) and [*_arrays(value)]:
            used.append(value)


def _arrays(value: Any) -> Iterator[Array]:
    """Yield the arrays of a value that tell something: of finite numbers, not all of them whole."""
    if isinstance(value, np.ndarray | float | np.number):
        x = np.squeeze(np.asarray(value))
        if x.dtype.kind == "f" and np.isfinite(x).all() and (x != np.trunc(x)).any():
            yield x
    elif isinstance(value, list | tuple | Mapping):
        for entry in value.values() if isinstance(value, Mapping) else value:
            yield from _arrays(entry)


def _equal(a: Any, b: Any) -> bool:
    try:
        return bool(np.array_equal(a, b))
    except Exception:  # what cannot be compared
        return a is b


class _Known:
    """The values that right solutions have."""

    def __init__(self) -> None:
        self._found: dict[tuple[int, ...], list[Array]] = {}
        self._stacked: dict[tuple[int, ...], Array] = {}

    def add(self, value: Any) -> None:
        """Add a value, and the halves of a vector of six."""
        for x in _arrays(value):
            self._found.setdefault(x.shape, []).append(x)
            if x.shape == (6,):
                self._found.setdefault((3,), []).extend((x[:3], x[3:]))

    def has(self, value: Any) -> bool:
        """Whether all arrays of a value are known, whatever their signs."""
        return all(self._has_array(x) or self._has_array(-x) for x in _arrays(value))

    def _has_array(self, x: Array) -> bool:
        if x.shape not in self._found:
            return False
        if x.shape not in self._stacked:
            self._stacked[x.shape] = np.array(self._found[x.shape])
        every = self._stacked[x.shape]
        within = RTOL * max(float(np.abs(x).max(initial=0)), FLOOR)
        return bool((np.abs(every - x) <= within).all(axis=tuple(range(1, every.ndim))).any())
