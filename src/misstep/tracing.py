"""The first line of a program that computes a value which no right solution has, though all that it uses is there."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from .compare import FLOOR, Array
from .messages import message
from .program import Program, text_of
from .text import Text

__all__ = ["first_wrong_line"]

RTOL = 1e-9

MAX_CHARS = 50
"""Of a term that is named in a message."""


class _Statement(NamedTuple):
    """An assignment or a return, with its value and the values that it uses."""

    node: Any
    value: Any
    used: list[Any]


def first_wrong_line(program: Program, arguments: Sequence[Any], solutions: Sequence[Program]) -> Text | None:
    """Report the first statement of a traced program that goes wrong; None where none can be told.

    A value is known if an argument or an expression of a right solution has it, whatever its sign.
    """
    known = _Known()
    for x in arguments:
        known.add(x)
    for solution in solutions:
        for node, value in solution.events:
            known.add(value)
            known.terms.append((node, value))
    statements = _statements(program)
    for k, (node, value, used) in enumerate(statements):
        if not [*arrays(value)] or known.has(value) or not all(map(known.has, used)):
            continue
        later = statements[k + 1 :]
        if any(known.has(x.value) and any(_equal(value, y) for y in x.used) for x in later):
            continue  # only another way to what is right
        return known.missing_term(node, value) or message("first line", line=node.lineno, text=text_of(node))
    return None


def _statements(program: Program) -> list[_Statement]:
    owner = {
        id(place.node): next((x for x in reversed(place.parents) if isinstance(x, ast.stmt)), None)
        for place in program.places
    }
    found, used = list[_Statement](), list[Any]()
    for node, value in program.events:
        statement = owner[id(node)]
        if isinstance(statement, ast.Assign | ast.Return) and node is statement.value:
            found.append(_Statement(statement, value, used))
            used = []
        elif isinstance(node, ast.Name | ast.Subscript | ast.Attribute) and [*arrays(value)]:
            used.append(value)
    return found


def arrays(value: Any) -> Iterator[Array]:
    """Yield the arrays of a value that tell something: of finite numbers, not all of them whole."""
    if isinstance(value, np.ndarray | float | np.number):
        x = np.squeeze(np.asarray(value))
        if x.dtype.kind == "f" and np.isfinite(x).all() and (x != np.trunc(x)).any():
            yield x
    elif isinstance(value, list | tuple):
        for entry in value:
            yield from arrays(entry)
    elif isinstance(value, Mapping):
        yield from arrays([*value.values()])


def _equal(a: Any, b: Any) -> bool:
    try:
        return bool(np.array_equal(a, b))
    except Exception:  # what cannot be compared
        return a is b


class _Known:
    """The values that right solutions have."""

    def __init__(self) -> None:
        self.terms: list[tuple[Any, Any]] = []
        self._found: dict[tuple[int, ...], list[Array]] = {}
        self._stacked: dict[tuple[int, ...], Array] = {}

    def add(self, value: Any) -> None:
        """Add a value, and the halves of a vector of six."""
        for x in arrays(value):
            self._found.setdefault(x.shape, []).append(x)
            if x.shape == (6,):
                self._found.setdefault((3,), []).extend((x[:3], x[3:]))

    def has(self, value: Any) -> bool:
        """Whether all arrays of a value are known, whatever their signs."""
        return all(self._is_known(x) or self._is_known(-x) for x in arrays(value))

    def _is_known(self, x: Array) -> bool:
        if x.shape not in self._found:
            return False
        if x.shape not in self._stacked:
            self._stacked[x.shape] = np.array(self._found[x.shape])
        every = self._stacked[x.shape]
        within = RTOL * max(float(np.abs(x).max(initial=0)), FLOOR)
        return bool((np.abs(every - x) <= within).all(axis=tuple(range(1, every.ndim))).any())

    def missing_term(self, statement: Any, value: Any) -> Text | None:
        """Report the term of a right solution that makes a value right when it is added or subtracted."""
        own = [*arrays(value)]
        if len(own) != 1 or not own[0].ndim:
            return None
        for node, term in self.terms:
            other = [*arrays(term)]
            if len(other) != 1 or other[0].shape != own[0].shape or len(text_of(node)) > MAX_CHARS:
                continue
            for op, total in (("+", own[0] + other[0]), ("−", own[0] - other[0])):
                if np.abs(total).max() > RTOL and self._is_known(total):
                    given = {"op": op, "term": text_of(node), "text": text_of(statement.value)}
                    return message("missing term", line=statement.lineno, **given)
        return None
