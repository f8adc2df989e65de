"""What a change means, where that is said shorter: a condition that always holds, or never; an argument of zeros."""

from __future__ import annotations

import ast
import time
from collections.abc import Sequence
from typing import Any

from ..calls import tried
from ..compare import agree
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text
from .edits import Source
from .excerpts import text_of
from .places import put
from .whole import Edit

__all__ = ["meaning"]

MOST = 0.3
"""Seconds for which a condition is watched, of the processor."""


def meaning(
    source: Source, edit: Edit, part: Part, right: Sequence[Any], cases: Sequence[tuple[Any, ...]]
) -> Text | None:
    """Report what an edit that makes a function right means; None where that is what it puts there.

    Parameters
    ----------
    source : Source
        Of the student's function, in which the edit is made.
    edit : Edit
    part : Part
    right : sequence
        What is expected, in each case.
    cases : sequence of tuple
        In which the function is watched.
    """
    return _zero(source, edit, part, right, cases) or _settled(source, edit, part, cases)


def _zero(
    source: Source, edit: Edit, part: Part, right: Sequence[Any], cases: Sequence[tuple[Any, ...]]
) -> Text | None:
    """Report that an array must be zero, where another name is put for it only because that has zeros."""
    if edit.kind != "name" or len(edit.places) != 1:
        return None
    parents, field, node, _ = edit.places[0]
    if not isinstance(parents[-1], ast.Call):
        return None
    place = parents, field, node, ast.BinOp(ast.Constant(0), ast.Mult(), node)
    for other in source.made("inserted", ("", ""), [place]):
        if all(agree(part, tried(part, other.function, c), x, c) for x, c in zip(right, cases)):
            return say("must be zero", name=text_of(node), around=text_of(parents[-1]))
    return None


def _settled(source: Source, edit: Edit, part: Part, cases: Sequence[tuple[Any, ...]]) -> Text | None:
    """Report of an edit in the condition of a branch that this must always, or never, be taken; None for others."""
    branch = next((found for place in edit.places if (found := _branch(place)) is not None), None)
    if branch is None or edit.kind == "left out":
        return None
    before, seen = branch.test, set[bool]()
    for parents, field, _, other in edit.places:
        put(parents[-1], field, other)

    def noted(holds: Any) -> Any:
        seen.add(bool(holds))
        return holds

    branch.test = ast.Call(ast.Name("_noted", ast.Load()), [branch.test], [])
    source.names["_noted"] = noted
    try:
        watched = source.compiled()
    finally:
        branch.test = before
        for parents, field, node, _ in edit.places:
            put(parents[-1], field, node)
    until = time.process_time() + MOST
    for arguments in cases:
        if time.process_time() < until:
            tried(part, watched, arguments)
    if len(seen) != 1:
        return None
    last = any(outer.orelse == [branch] for place in edit.places for outer in place[0] if isinstance(outer, ast.If))
    always = "branch otherwise" if last else "branch always"
    return say(always if True in seen else "branch", wrong=text_of(branch.test))


def _branch(place: Any) -> Any:
    """Return the innermost branch in whose condition a place is."""
    parents, _, node, _ = place
    inner = [*parents[1:], node]
    pairs = [(outer, x) for outer, x in zip(parents, inner) if isinstance(outer, ast.If | ast.IfExp)]
    return next((outer for outer, x in reversed(pairs) if outer.test is x), None)
