"""What every expression of a program is when it runs, and which of these values a right solution has as well."""

from __future__ import annotations

import ast
import copy
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ...arrays import Array
from ..calls import copied, tried
from ..changes.edits import Source
from ..compare import FLOOR
from ..exercise import Part

__all__ = ["Event", "Known", "arrays", "known_values", "numbers_of", "recorded", "tells"]

MOST = 20_000
"""Values that are kept of a run."""

ENTRIES = 4_000
"""Of an array that is kept."""


class Event(NamedTuple):
    """An expression, or what a statement adds to, and its value at one time."""

    node: ast.AST
    value: Any


class _Noting(ast.NodeTransformer):
    """Puts a call that notes its value around every numbered expression."""

    def visit(self, node: ast.AST) -> Any:
        number = getattr(node, "number", None)
        found = self.generic_visit(node)
        if number is None:
            return found
        if isinstance(found, ast.AugAssign):
            return [found, ast.Expr(_noted(number, ast.parse(ast.unparse(found.target), mode="eval").body))]
        return _noted(number, found) if isinstance(found, ast.expr) else found


def _noted(number: int, node: ast.expr) -> ast.Call:
    return ast.Call(ast.Name("_note", ast.Load()), [ast.Constant(number), node], [])


def recorded(part: Part, sources: Sequence[Source], arguments: tuple[Any, ...]) -> list[Event]:
    """Return the values of all expressions of a function, and of the listings that it calls, in the order of a run.

    There are none where it raises an error.

    Parameters
    ----------
    part : Part
    sources : sequence of Source
        Of the function, then of the listings.
    arguments : tuple
    """
    events: list[Event] = []
    nodes: list[ast.AST] = []
    functions: list[Callable[..., Any]] = []

    def note(number: int, value: Any) -> Any:
        if len(events) < MOST and not callable(value):
            events.append(Event(nodes[number], _kept(value)))
        return value

    for source in sources:
        for parents, field, node in source.places:
            if _has_value(node, parents[-1], field):
                node.number = len(nodes)
                nodes.append(node)
        other = copy.copy(source)
        other.tree = _Noting().visit(copy.deepcopy(source.tree))
        other.names = {**source.names, "_note": note}
        functions.append(other.compiled())
    named = {source.function.__name__: function for source, function in zip(sources, functions)}
    for function in functions:
        function.__globals__.update(named)
    return [] if tried(part, functions[0], copied(arguments)) is None else events


def _has_value(node: Any, parent: Any, field: Any) -> bool:
    """Whether a node is an expression whose value may be noted, or a statement that adds to something."""
    if isinstance(node, ast.AugAssign):
        return True
    if not isinstance(node, ast.expr) or isinstance(node, ast.Constant | ast.Slice | ast.Starred | ast.Lambda):
        return False
    if field == "func" or isinstance(parent, ast.JoinedStr | ast.FormattedValue):
        return False
    if isinstance(node, ast.Name) and isinstance(parent, ast.Subscript | ast.Attribute) and field == "value":
        return False  # the entry is noted
    inner = isinstance(parent, ast.Subscript) and field == "slice" and isinstance(node, ast.Tuple)
    return isinstance(getattr(node, "ctx", ast.Load()), ast.Load) and not inner


def _kept(value: Any) -> Any:
    """Return a copy of an array, or of what holds arrays: it may be changed later."""
    if isinstance(value, np.ndarray):
        return value.copy() if value.size <= ENTRIES else value
    if isinstance(value, list | tuple):
        return [_kept(x) for x in value]
    return {name: _kept(x) for name, x in value.items()} if isinstance(value, dict) else value


class Known:
    """Values that a right solution has, to the digits that a rounding leaves, whatever their signs."""

    def __init__(self) -> None:
        self._found: dict[tuple[int, ...], list[Array]] = {}
        self._stacked: dict[tuple[int, ...], Array] = {}

    def add(self, value: Any) -> None:
        """Take in the arrays of a value, with their halves and blocks."""
        for x in arrays(value):
            self._found.setdefault(x.shape, []).append(x)
            if x.shape == (6,):
                self._found.setdefault((3,), []).extend((x[:3], x[3:]))

    def has(self, value: Any) -> bool:
        """Whether all arrays of a value are known; whole numbers, which are met by chance, count as known."""
        return all(self._one(x) for x in arrays(value) if tells(x))

    def has_with_sign(self, x: Array) -> bool:
        """Whether an array is known with this sign."""
        return self._one(x, (1,))

    def _one(self, x: Array, signs: tuple[int, ...] = (1, -1)) -> bool:
        if x.shape not in self._stacked:
            self._stacked[x.shape] = np.array(self._found.get(x.shape, np.zeros((0, *x.shape))))
        known, within = self._stacked[x.shape], 1e-9 * max(float(np.abs(x).max()), FLOOR)
        axes = tuple(range(1, known.ndim))
        return any(bool((np.abs(known - sign * x) <= within).all(axes).any()) for sign in signs)


def tells(x: Array) -> bool:
    """Whether an array is not only of whole numbers."""
    return bool((x != np.trunc(x)).any())


def arrays(value: Any) -> Iterator[Array]:
    """Yield the arrays of numbers of a value, without axes of length one; a matrix as it and its transpose are."""
    if isinstance(value, bool | str | np.bool_) or value is None:
        return
    if isinstance(value, np.ndarray | int | float | np.number):
        x = np.squeeze(np.asarray(value))
        if x.dtype.kind in "iuf" and np.isfinite(x).all():
            yield x.astype(float)
    elif isinstance(value, list | tuple):
        for y in value:
            yield from arrays(y)
    elif isinstance(value, Mapping):
        yield from arrays([*value.values()])
    elif hasattr(value, "rotation") and hasattr(value, "translation"):
        yield from arrays([value.rotation, value.translation])


def numbers_of(value: Any) -> bytes:
    """Return by which the numbers of a value are recognised."""
    return b"".join(x.tobytes() for x in arrays(value))


def known_values(part: Part, arguments: tuple[Any, ...], names: Mapping[str, Any]) -> tuple[Known, list[Event]]:
    """Return the values that the right solutions have with some arguments, and their record."""
    known, every = Known(), list[Event]()
    known.add([*arguments])
    for way in (part.solution, *part.ways):
        listings = part.beside if way is part.solution else ()
        sources = [Source(f, way, {}, names) for f in (way, *listings)]
        for event in recorded(part, sources, arguments):
            known.add(event.value)
            every.append(event)
    return known, every
