"""A second name for one array, or a view into it, that is written into: copies in their place make it right."""

from __future__ import annotations

import ast
import textwrap
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..calls import tried
from ..changes.edits import Source
from ..changes.written import written
from ..compare import agree
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text

__all__ = ["missing_copies"]

Function = Callable[..., Any]


def missing_copies(part: Part, function: Function, right: Sequence[Any], cases: Sequence[Any]) -> list[Text]:
    """Report the fewest assignments that must copy, if copies make the function right in all cases; else nothing."""
    text = written(function)
    if text is None:
        return []
    tree = ast.parse(textwrap.dedent(text))
    places = [k for k, node in enumerate(ast.walk(tree)) if _is_one_array(node)]

    def mended(chosen: Sequence[int]) -> bool:
        source = Source(function, function, {}, {"_copied": _copied}, text)
        source.names["_copied"] = _copied
        for k, node in enumerate(ast.walk(source.tree)):
            if k in chosen and isinstance(node, ast.Call):
                node.args = [ast.Call(ast.Name("_copied", ast.Load()), node.args, [])]
            elif k in chosen and isinstance(node, ast.Assign):
                node.value = ast.Call(ast.Name("_copied", ast.Load()), [node.value], [])
                if len(node.targets) > 1:
                    node.value = ast.Tuple([node.value] * len(node.targets), ast.Load())
                    node.targets = [ast.Tuple(node.targets, ast.Store())]
        other = source.compiled()
        return all(agree(part, tried(part, other, c), b, c) for b, c in zip(right, cases))

    if not places or not mended(places):
        return []
    for k in [*places]:
        fewer = [other for other in places if other != k]
        if fewer and mended(fewer):
            places = fewer
    arrays = {name for name, x in zip(part.arguments.split(", "), cases[0]) if isinstance(x, np.ndarray)}
    return [_said(node, arrays) for k, node in enumerate(ast.walk(tree)) if k in places]


def _is_one_array(node: Any) -> bool:
    """Whether one array gets several names, or stands several times in a list, or gets a second name, or is appended.

    It does where nothing is computed: what stands on the right is a name, a part of an array, or its transpose.
    """
    if isinstance(node, ast.Call):
        return getattr(node.func, "attr", "") == "append" and all(isinstance(x, ast.Name) for x in node.args)
    if not isinstance(node, ast.Assign):
        return False
    value: Any = node.value
    if _exchanges_views(node):
        return True
    if _repeats(value) or (len(node.targets) > 1 and all(isinstance(x, ast.Name) for x in node.targets)):
        return True
    if isinstance(value, ast.Attribute):
        value = value.value if value.attr in ("T", "mT") else None
    return isinstance(node.targets[0], ast.Name) and isinstance(value, ast.Name | ast.Subscript)


def _exchanges_views(node: ast.Assign) -> bool:
    """Whether two parts of an array are exchanged at once: what stands on the right are no copies."""
    sides: Any = (node.targets[0], node.value)
    if not all(isinstance(side, ast.Tuple) for side in sides):
        return False
    left, right = ([ast.unparse(x) for x in side.elts] for side in sides)
    return left == right[::-1] and len(left) == 2 and all(":" in text for text in left)


def _repeats(node: Any) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult) and isinstance(node.left, ast.List | ast.Tuple)


def _copied(x: Any) -> Any:
    return [*map(_copied, x)] if isinstance(x, list | tuple) else x.copy() if hasattr(x, "copy") else x


def _said(node: Any, arrays: set[str]) -> Text:
    """Report an assignment that copies nothing; an argument may be of whole numbers, and is copied as floats."""
    if isinstance(node, ast.Call):
        return say("same appended", line=node.lineno, text=ast.unparse(node), name=ast.unparse(node.args[0]))
    if len(node.targets) > 1 or _repeats(node.value):
        return say("many names", line=node.lineno, text=ast.unparse(node))
    if _exchanges_views(node):
        first, second = (ast.unparse(x) for x in node.targets[0].elts)
        return say("views exchanged", line=node.lineno, text=f"{first}, {second} = {second}, {first}", second=second)
    line, name, value = node.lineno, ast.unparse(node.targets[0]), ast.unparse(node.value)
    cure = f"np.array({value}, float)" if value in arrays else f"{value}.copy()"
    return say("second name", line=line, text=ast.unparse(node), name=name, value=value, cure=cure)
