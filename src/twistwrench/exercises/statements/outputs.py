"""What each statement of a student's function computes, and which of them is the first to go wrong."""

from __future__ import annotations

import ast
from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..calls import tried
from ..changes.edits import Source
from ..changes.places import innermost
from ..compare import values
from ..exercise import Part
from .records import Event, Known, arrays, numbers_of, tells

__all__ = ["Output", "feeds", "outputs", "suspects"]

BUILT = ("block", "array", "concatenate", "vstack", "hstack", "stack", "column_stack", "asarray")
"""What is given to these is looked at by itself."""


@dataclass(frozen=True)
class Value:
    """What a statement computes at one time.

    Attributes
    ----------
    when : int
    key : bytes
        By which it is recognised where it is read.
    known, telling : bool
        Whether a right solution has it as well, and whether it is not met by chance.
    read : tuple of (str, bytes)
        What is unknown of what it is computed from: names and keys.
    """

    when: int
    key: bytes
    known: bool
    telling: bool
    read: tuple[tuple[str, bytes], ...]


@dataclass(frozen=True)
class Output:
    """What a statement computes, or one of several things: the expression, and its values.

    It stands `within` a function, which is `given` things by its caller where it is a helper.
    """

    within: str
    given: frozenset[str]
    statement: Any
    node: Any
    writes: frozenset[str]
    values: tuple[Value, ...]

    @property
    def place(self) -> tuple[int, int]:
        """Line and column."""
        return self.node.lineno, self.node.col_offset

    @property
    def known(self) -> bool:
        """Whether right solutions have all of its values; of a sum, the last."""
        return all(x.known for x in self.values)


def outputs(source: Source, events: Sequence[Event], known: Known) -> list[Output]:
    """Return what each statement computes, in the order of the program."""
    right = [known.has(event.value) for event in events]
    when: dict[int, list[int]] = {}
    for k, event in enumerate(events):
        when.setdefault(id(event.node), []).append(k)
    sure = {id(event.node) for event in events if any(map(tells, arrays(event.value)))}
    fine = {number for number, times in when.items() if number in sure and all(right[k] for k in times)}
    found, main, helpers = (
        [],
        source.function.__name__,
        {x.name for x in ast.walk(source.tree) if isinstance(x, ast.FunctionDef)},
    )
    for parents, _, node in source.places:
        statement = innermost([*parents, node])
        if id(node) not in when or not any(node is x for x in _results(statement)):
            continue
        whole = any(id(x) in fine for x in parents if isinstance(x, ast.expr))
        operands = {id(x) for x in ast.walk(node) if isinstance(x, ast.Name | ast.Subscript) or _base(x) in helpers}
        values, before = [], -1
        for k in when[id(node)]:
            times = (j for j in range(before + 1, k + 1) if id(events[j].node) in operands and not right[j])
            read = tuple((_base(events[j].node), numbers_of(events[j].value)) for j in times)
            telling = any(tells(x) for x in arrays(events[k].value))
            values.append(Value(k, numbers_of(events[k].value), whole or right[k], telling, read))
            before = k
        if isinstance(node, ast.AugAssign) and values[-1].known:
            values = values[-1:]  # the sum, not what it is on the way
        within = getattr(parents[0], "name", "")
        given = frozenset(name for x in parents for name in _arguments(x) if x.name != main)
        found.append(Output(within, given, statement, node, frozenset(_written(statement, parents)), (*values,)))
    return found


def _arguments(function: Any) -> list[str]:
    """Return the names of the arguments of a function, none of anything else."""
    return [x.arg for x in function.args.args] if isinstance(function, ast.FunctionDef) else []


def _base(node: Any) -> str:
    while isinstance(node, ast.Subscript | ast.Attribute | ast.Call):
        node = node.func if isinstance(node, ast.Call) else node.value
    return str(getattr(node, "id", ""))


def _written(statement: Any, parents: Sequence[Any]) -> Iterator[str]:
    """Yield the names that a statement sets, or an entry of; a helper's result has the helper's name."""
    if isinstance(statement, ast.Return):
        yield from [x.name for x in parents if isinstance(x, ast.FunctionDef)][-1:]
    found = getattr(statement, "targets", [getattr(statement, "target", None)])
    if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call):
        found = [statement.value.func]  # x.append(…)
    for node in found:
        yield from filter(None, map(_base, node.elts if isinstance(node, ast.Tuple) else [node]))


def _results(statement: Any) -> Iterator[Any]:
    """Yield the expressions that a statement computes; of a list or a block matrix, what stands in it."""
    if isinstance(statement, ast.AugAssign):
        yield statement
    elif isinstance(statement, ast.Assign | ast.Return):
        yield from _leaves(statement.value)
    elif isinstance(statement, ast.Expr) and isinstance(call := statement.value, ast.Call):
        for argument in call.args:
            yield from _leaves(argument)


def _leaves(node: Any) -> Iterator[Any]:
    called = getattr(getattr(node, "func", None), "attr", "")
    if isinstance(node, ast.Tuple | ast.List):
        for entry in node.elts:
            yield from _leaves(entry)
    elif called in BUILT and node.args:
        yield from _leaves(node.args[0])
    elif isinstance(node, ast.Subscript) and getattr(node.value, "attr", "") in ("r_", "c_"):
        yield from _leaves(node.slice)
    elif node is not None and called != "empty":
        yield node


def suspects(found: Sequence[Output], ways: Container[tuple[int, int]] = ()) -> list[Output]:
    """Return what is wrong though all that it is computed from is right, the first of it first.

    What no right solution has, but leads to what one has, is only another way; so is what stands at `ways`.
    """
    fine, size = {v.key for x in found if x.place in ways for v in x.values if not v.known}, -1
    readers: dict[bytes, list[Value]] = {}
    for value in (v for x in found for v in x.values if v.telling):
        for _, key in value.read:
            readers.setdefault(key, []).append(value)
    while size < len(fine):
        size = len(fine)
        fine |= {key for key, values in readers.items() if any(v.known or v.key in fine for v in values)}
    wrong = [(x, [v for v in x.values if not v.known and v.key not in fine]) for x in found]
    wrong = [(x, bad) for x, bad in wrong if bad]
    first = []
    for x, bad in wrong:
        others = [y for y, _ in wrong if y.statement is not x.statement]
        names = {name for y in others for name in y.writes if x.within == y.within or name == y.within}
        if not any((name in names and key not in fine) or name in x.given for name, key in bad[0].read):
            first.append((bad[0].when, x))
    return [x for _, x in sorted(first, key=lambda pair: pair[0])]


def feeds(part: Part, source: Source, statement: Any, arguments: tuple[Any, ...], answer: Any, right: Any) -> bool:
    """Whether numbers that are wrong are others where what a statement computes is half as large again."""
    node = getattr(statement, "value", None)
    places = [(*place, _half_more(node)) for place in source.places if place[2] is node][:1]
    edit = next(source.made("number", ("", ""), places), None) if places else None
    other = tried(part, edit.function, arguments) if edit else None
    split = [values(x, part.returns) for x in (answer, right, other)]
    if other is None or None in split:
        return True  # they cannot be compared
    return any(_moves(*(x.array for x in xs)) for xs in zip(*split))


def _half_more(node: Any) -> Any:
    times = ast.Attribute(ast.Name("np", ast.Load()), "multiply", ast.Load())
    return ast.Call(times, [ast.Constant(1.5), node], [])


def _moves(answer: Any, right: Any, other: Any) -> bool:
    """Whether an entry that is wrong is another one in the other answer, or they cannot be compared."""
    if any(x is None or x.shape != right.shape for x in (right, answer, other)):
        return True
    return bool((~np.isclose(answer, right, 1e-9, 0) & ~np.isclose(answer, other, 1e-9, 0)).any())
