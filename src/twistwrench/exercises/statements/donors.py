"""What may stand in a wrong statement: what the student has at hand, and terms that a right solution has there."""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ...arrays import Array
from ..changes.edits import Source
from ..changes.excerpts import text_of
from ..changes.whole import Edit
from .outputs import Output
from .records import Event, Known, arrays, tells

__all__ = ["given"]

LONGEST = 60
"""Characters of a term that is given away."""

BACK = 300
"""Values before that of a term in which those that it is computed from are looked for."""

MOST = 30
"""Values of right solutions that are tried in place of another."""

LARGEST = 12
"""Whole number by which something is multiplied or divided."""

PARTS = ("rotation", "translation", "mass", "com")
"""What a placement and a body have, whether or not the student has asked for it."""

HALVES = {":3": "3:", "3:": ":3", "3:6": ":3", "0:3": "3:"}
"""The halves of a vector of six numbers, each with the other."""

Atoms = list[tuple[str, Array]]


def given(
    source: Source,
    output: Output,
    events: Sequence[Event],
    found: Sequence[Output],
    record: Sequence[Event],
    arguments: Mapping[str, Any],
    known: Known,
    right: Any,
) -> Iterator[Edit]:
    """Yield a wrong statement with another thing in place of a part of it, or with a further term.

    Parameters
    ----------
    source : Source
        Of the student's function.
    output : Output
        What is wrong.
    events : sequence of Event
        What the student's function computes.
    found : sequence of Output
        The same, by its statements.
    record : sequence of Event
        What right solutions compute.
    arguments : mapping
        What the function is given.
    known : Known
        The values of right solutions.
    right : object
        What is expected: it is not given away.
    """
    bad = next((x for x in output.values if not x.known), None)
    if bad is None:
        return
    start = max((x.when for x in output.values if x.when < bad.when), default=-1)
    inner = {id(x) for x in ast.walk(output.node)}
    latest = {id(e.node): e for e in events[start + 1 : bad.when + 1] if id(e.node) in inner}
    unknown = {number for number, event in latest.items() if not known.has(event.value)}
    if isinstance(output.statement, ast.Return):
        unknown -= {id(output.node)}  # all that is asked for
    here = {id(x) for x in ast.walk(output.statement)}
    end = next((k for k, e in enumerate(events[bad.when :], bad.when) if id(e.node) not in here), len(events))
    own, terms = _atoms(arguments, events[:end], found, bad.when), _Terms(record, right)
    yield from _typed(source, here, own)
    for place in source.places:
        node = place[2]
        value = _array(latest[id(node)].value) if id(node) in latest and isinstance(node, ast.expr) else None
        if value is None:
            continue
        for text, x in own if not isinstance(node, ast.Name) else ():
            if x.shape == value.shape and text != ast.unparse(node) and not _same(x, value):
                yield from _put(source, place, "instead", text)
        whole = (isinstance(node, ast.Call) or node is output.node) and id(node) in unknown
        for text in terms.others(value, own) if whole or value.ndim == 0 else ():
            yield from _put(source, place, "instead", text)
        for factor in terms.factors(value) if id(node) in unknown or node is output.node else ():
            yield from _put(source, place, "inserted", f"({ast.unparse(node)}) {factor}")
        for op, text in terms.missing(value, own):
            yield from _put(source, place, op, text)
            for setting in source.places if isinstance(node, ast.Name) else ():
                if isinstance(setting[0][-1], ast.Assign) and _sets(setting, node.id):
                    yield from _put(source, setting, op, text)
        for text in terms.turning(value, own):
            written = f"({text}) @ ({ast.unparse(node)})" + (f" @ ({text}).T" if value.ndim == 2 else "")
            yield from _put(source, place, "inserted", written)


def _typed(source: Source, here: set[int], own: Atoms) -> Iterator[Edit]:
    """Yield a number at hand in place of one that is written into a statement."""
    for place in source.places:
        value = getattr(place[2], "value", None)
        if id(place[2]) in here and isinstance(place[2], ast.Constant) and isinstance(value, float):
            for text, x in own:
                if x.ndim == 0:
                    yield from _put(source, place, "instead", text)


def _put(source: Source, place: Sequence[Any], kind: str, text: str) -> Iterator[Edit]:
    """Yield the source with a text in place of a node, or added to it or taken from it."""
    parents, field, node = place
    try:
        new = ast.parse(text, mode="eval").body
    except SyntaxError:  # a right solution has it in a statement, `+=`
        return
    if kind in "+-":
        other = ast.BinOp(node, ast.Add() if kind == "+" else ast.Sub(), new)
        yield from source.made("missing", (text_of(node), f"{kind} {text}"), [(parents, field, node, other)])
    else:
        put = parents, field, node, new
        yield from source.made(kind, source.texts(kind, put), [put])


def _sets(place: Sequence[Any], name: str) -> bool:
    """Whether a node is what a name is set to."""
    statement, field = place[0][-1], place[1]
    return field == "value" and getattr(statement.targets[0], "id", "") == name


class _Terms:
    """What right solutions compute, by its shape."""

    def __init__(self, record: Sequence[Event], right: Any) -> None:
        self.record = record
        results = [*arrays(right)]
        self.found: dict[tuple[int, ...], list[tuple[int, Array]]] = {}
        self.values: dict[tuple[int, ...], list[Array]] = {}
        for k, event in enumerate(record):
            value = _array(event.value)
            if value is not None and tells(value):
                self.values.setdefault(value.shape, []).append(value)
            asked = value is not None and any(x.shape == value.shape and _same(x, value) for x in results)
            if value is not None and tells(value) and (value.ndim == 0 or not asked):
                self.found.setdefault(value.shape, []).append((k, value))

    def others(self, value: Array, own: Atoms) -> Iterator[str]:
        """Yield what of the same shape right solutions call, or take from something."""
        kinds = (ast.Call, ast.Attribute) if value.ndim == 0 else (ast.Call,)
        here = [(k, x) for k, x in self.found.get(value.shape, []) if isinstance(self.record[k].node, kinds)]
        texts = dict.fromkeys(self._written(k, x, own) for k, x in here[:MOST] if not _same(x, value))
        yield from (text for text in texts if len(text) <= LONGEST)

    def factors(self, value: Array) -> Iterator[str]:
        """Yield the whole number by which a value must be multiplied, or divided, to be one of a right solution."""
        size = float(np.abs(value).max(initial=0))
        for x in self.values.get(value.shape, []) if tells(value) and size else ():
            ratio = float(np.abs(x).max()) / size
            for op, n in (("*", round(ratio)), ("/", round(1 / ratio))):
                if 2 <= n <= LARGEST and _same(x, value * n if op == "*" else value / n):
                    yield f"{op} {n}"
                    return

    def missing(self, value: Array, own: Atoms) -> Iterator[tuple[str, str]]:
        """Yield the operation and the term that make another of these values of a value."""
        here = self.found.get(value.shape, [])
        if not here or not value.ndim:
            return  # a single number is met by chance
        values, done = np.array([x for _, x in here]), set()
        within, axes = 1e-9 * max(float(np.abs(values).max()), 1e-3), tuple(range(1, values.ndim))
        for k, term in here:
            if np.abs(term).max() <= within:
                continue  # only rounding
            for op, total in (("+", value + term), ("-", value - term)):
                if np.abs(total).max() > within and tells(total) and (np.abs(values - total) <= within).all(axes).any():
                    text = self._written(k, term, own)
                    if (op, text) not in done and len(text) <= LONGEST:
                        done.add((op, text))
                        yield op, text

    def turning(self, value: Array, own: Atoms) -> Iterator[str]:
        """Yield the rotation that makes another of these values of a vector or a matrix."""
        here = self.found.get(value.shape, [])
        turns = [(k, x) for k, x in self.found.get((3, 3), []) if np.allclose(x @ x.mT, np.eye(3))]
        if value.shape not in ((3,), (3, 3)) or not here or not turns:
            return
        values, done = np.array([x for _, x in here]), set()
        within, axes = 1e-9 * max(float(np.abs(values).max()), 1e-3), tuple(range(1, values.ndim))
        for k, turn in turns:
            for R, end in ((turn, ""), (turn.mT, ".T")):
                total = R @ value if value.ndim == 1 else R @ value @ R.mT
                if not _same(total, value) and (np.abs(values - total) <= within).all(axes).any():
                    text = self._written(k, turn, own) + end
                    if text not in done and len(text) <= LONGEST:
                        done.add(text)
                        yield text

    def _written(self, k: int, term: Array, own: Atoms) -> str:
        """Return a term as the student has it, or with the student's names in it."""
        node: Any = self.record[k].node
        inner = {id(x) for x in ast.walk(node)}
        before = (event for event in self.record[max(0, k - BACK) : k] if id(event.node) in inner)
        latest = {ast.unparse(event.node): _array(event.value) for event in before}
        return _named(term, own) or ast.unparse(_Renamed(latest, own).visit(copy.deepcopy(node)))


class _Renamed(ast.NodeTransformer):
    """Puts the student's names in place of what has the same value."""

    def __init__(self, latest: dict[str, Array | None], own: Atoms) -> None:
        self.latest, self.own = latest, own

    def visit(self, node: ast.AST) -> Any:
        if isinstance(node, ast.Attribute) and node.attr in ("T", "mT"):  # a row and a column have the same numbers
            return ast.Attribute(self.visit(node.value), "T", ast.Load())
        value = self.latest.get(ast.unparse(node)) if isinstance(node, ast.expr) else None
        text = _named(value, self.own) if value is not None and tells(value) else ""
        return ast.parse(text, mode="eval").body if text else self.generic_visit(node)


def _array(value: Any) -> Array | None:
    found = [*arrays(value)] if not isinstance(value, list | tuple) else []
    return found[0] if len(found) == 1 else None


def _same(a: Array, b: Array) -> bool:
    return bool((np.abs(a - b) <= 1e-12 * max(float(np.abs(a).max(initial=0)), 1e-3)).all())


def _atoms(arguments: Mapping[str, Any], events: Sequence[Event], found: Sequence[Output], before: int) -> Atoms:
    """Return what the student's function has at hand at a time: texts and values, the latest first."""
    latest: dict[str, tuple[int, Any]] = {name: (-1, x) for name, x in arguments.items()}
    for k, event in enumerate(events):
        if isinstance(event.node, ast.Name | ast.Subscript | ast.Attribute):
            latest[ast.unparse(event.node)] = k, event.value
    for output in found:
        target = getattr(output.statement, "targets", [None])[0]
        times = [x.when for x in output.values if x.when < before]
        if times and isinstance(target, ast.Name | ast.Subscript) and output.node is output.statement.value:
            text = ast.unparse(target)
            if latest.get(text, (-1, None))[0] < times[-1]:
                latest[text] = times[-1], events[times[-1]].value
    for text, (when, value) in [*latest.items()]:
        latest |= {f"{text}.{x}": (when, getattr(value, x)) for x in PARTS if not callable(getattr(value, x, len))}
        latest |= {half: (when, x) for half, x in _other_half(text, latest) if half not in latest}
    kept = ((text, _array(value)) for text, (_, value) in sorted(latest.items(), key=lambda x: -x[1][0]))
    return [(text, x) for text, x in kept if x is not None and (tells(x) or text in arguments)]


def _other_half(text: str, latest: Mapping[str, tuple[int, Any]]) -> Iterator[tuple[str, Any]]:
    """Yield the other half of a vector of which one is at hand."""
    node: Any = ast.parse(text, mode="eval").body
    if not isinstance(node, ast.Subscript) or ast.unparse(node.value) not in latest:
        return
    *index, half = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
    if (other := HALVES.get(ast.unparse(half))) is None:
        return
    names = {name: value for name, (_, value) in latest.items() if name.isidentifier()}
    written = ", ".join([*map(ast.unparse, index), other])
    try:
        value = eval(f"_whole[{written}]", {**names, "_whole": latest[ast.unparse(node.value)][1]})
    except (IndexError, NameError, TypeError):
        return
    yield f"{ast.unparse(node.value)}[{written}]", value


def _named(value: Array, own: Atoms) -> str:
    """Return the shortest text of the student's with a value; empty where there is none."""
    return min((text for text, x in own if x.shape == value.shape and _same(x, value)), key=len, default="")
