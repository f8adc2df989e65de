"""Which line of an algorithm gives which term its value, in the order in which they run: read from its source.

Nothing is run here: a listing has loops over the bodies, loops to the base, and lines that set a term of a body. Only
the bodies' numbers are followed; the values are those of the record that the algorithm returned.
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from .anchors import anchor_of

__all__ = ["Assignment", "SourceLine", "places"]


@dataclass(frozen=True)
class Assignment:
    """A line that gave a term its value.

    Attributes
    ----------
    function : str
        In which function the line stands.
    line : int
        Its number in the file.
    source : str
        The line.
    body : int or None
        The body whose turn it was, ``i`` in the source.
    name : str
        The term.
    index : int or tuple of int
        Which entry of it: a body, or a pair of bodies.
    value : object
    """

    function: str
    line: int
    source: str
    body: int | None
    name: str
    index: int | tuple[int, ...]
    value: Any

    @property
    def anchor(self) -> str | None:
        """The chapter's step, by the comment at the end of the line: ``"49.7 D"``."""
        return anchor_of(self.source)


@dataclass(frozen=True)
class SourceLine:
    """Where a line sets an entry of a term; `own` is true if the entry is that of the body whose turn it is."""

    line: int
    source: str
    body: int | None
    name: str
    index: int | tuple[int, ...]
    own: bool


def places(function: Callable[..., Any], parent: Sequence[int]) -> Iterator[SourceLine]:
    """Yield the places at which a listing sets entries of its terms, in the order in which they come for this tree.

    Examples
    --------
    >>> def masses(tree, parent, m):
    ...     for i in tree.inward:
    ...         p = parent[i]
    ...         m[p] = m[p] + m[i]
    >>> [(place.body, place.name, place.index) for place in places(masses, [-1, 0, 1])]
    [(2, 'm', 1), (1, 'm', 0)]
    """
    lines, first = inspect.getsourcelines(function)
    (definition,) = ast.parse(inspect.cleandoc("\n" + "".join(lines))).body
    if isinstance(definition, ast.FunctionDef):
        yield from _Reader(parent, [line.strip() for line in lines], first).read(definition.body, {})


class _Reader:
    def __init__(self, parent: Sequence[int], lines: list[str], first: int) -> None:
        self.parent, self.lines, self.first = parent, lines, first

    def read(self, statements: list[ast.stmt], at: dict[str, int]) -> Iterator[SourceLine]:
        """Follow statements; `at` holds the numbers of bodies by their names in the source."""
        for s in statements:
            if isinstance(s, ast.For):
                outward = range(1, len(self.parent))
                for i in reversed(outward) if ast.unparse(s.iter) == "tree.inward" else outward:
                    yield from self.read(s.body, {"i": i})
            elif isinstance(s, ast.While):  # on the way to the base
                while self.parent[at["j"]] > 0:
                    yield from self.read(s.body, at)
            elif isinstance(s, ast.Assign):
                yield from self.assign(s, at)

    def assign(self, s: ast.Assign, at: dict[str, int]) -> Iterator[SourceLine]:
        for target in s.targets:
            if isinstance(target, ast.Subscript):
                index = self.number(target.slice, at)
                source = self.lines[s.lineno - 1]
                own = ast.unparse(target.slice) == "i"
                yield SourceLine(self.first + s.lineno - 1, source, at.get("i"), ast.unparse(target.value), index, own)
            elif isinstance(target, ast.Name) and isinstance(number := self.number(s.value, at), int):
                at[target.id] = number

    def number(self, expression: ast.expr, at: dict[str, int]) -> Any:
        """Return the body that an expression stands for, a pair of them, or None where it is something else."""
        if isinstance(expression, ast.Tuple):
            return tuple(self.number(one, at) for one in expression.elts)
        if isinstance(expression, ast.Subscript) and ast.unparse(expression.value) == "parent":
            return self.parent[self.number(expression.slice, at)]
        if isinstance(expression, ast.Constant):
            return expression.value
        return at.get(expression.id) if isinstance(expression, ast.Name) else None
