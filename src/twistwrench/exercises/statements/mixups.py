"""Mistakes with arrays that a change of one operation does not undo: a view for a copy, all six numbers for three."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import Any

from ..changes.containers import parsed
from ..changes.edits import Source
from ..changes.whole import Edit

__all__ = ["mixups"]


def mixups(source: Source) -> Iterator[Edit]:
    """Yield a student's function with a copy in place of a view, or with the length of a half of a vector."""
    for parents, field, node in source.places:
        for other in _others(node, parents[-1]):
            place = parents, field, node, other
            yield from source.made("instead", source.texts("instead", place), [place])


def _others(node: Any, parent: Any) -> Iterator[ast.expr]:
    named = isinstance(parent, ast.Assign) and isinstance(parent.targets[0], ast.Name)
    if named and isinstance(node, ast.Subscript) and any(isinstance(x, ast.Slice) for x in ast.walk(node.slice)):
        yield parsed("np.copy(_)", node)
    if isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "norm" and len(node.args) == 1:
        for half in ("x[3:]", "x[:3]"):
            other: Any = parsed(half)
            other.value = node.args[0]
            yield ast.Call(node.func, [other], node.keywords)
