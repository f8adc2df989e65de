"""What could stand in place of a call, or of a name, by a small mistake."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import combinations
from typing import Any

import numpy as np

import twistwrench as tw

from .containers import Change, exchanges, parsed
from .twins import is_copy, is_whole, twins

__all__ = ["CONSTANT", "called", "calls", "in_modules", "names_used"]

CONSTANT = ("zeros", "ones", "eye")
"""What these make does not lack a factor."""

IN_ORDER = ("range", "slice", "clip", "max", "min", "maximum")
"""Functions whose arguments nobody exchanges."""

TURNING = ("transpose", "swapaxes", "moveaxis")
"""Functions that only turn an array round."""

ALONG = ("sum", "mean", "max", "min", "norm")
"""Functions along one axis of an array, or of all its numbers where none is given."""

LAST = ast.parse("-1", mode="eval").body


def called(node: ast.Call) -> str:
    """Return the name of what is called, without that of its module."""
    name: str = getattr(node.func, "attr", getattr(node.func, "id", ""))
    return name


def calls(node: Any) -> Iterator[Change]:
    """Yield a call with other arguments, or one of its arguments alone."""
    if not isinstance(node, ast.Call):
        return
    yield from _with_other_arguments(node)
    if len(node.args) <= 2 and not is_copy(node) and called(node) not in ("array", "asarray"):
        kind = "left out" if len(node.args) == 1 and not node.keywords else "instead"
        yield from ((kind, argument) for argument in node.args if not isinstance(argument, ast.Constant))
    yield from _of_method(node)
    if called(node) in ALONG and not node.keywords and len(node.args) == _of_module(node):
        for axis in (0, 1):
            yield "instead", ast.Call(node.func, node.args, [ast.keyword("axis", ast.Constant(axis))])
    if called(node) == "sum":
        every = node.func.value if isinstance(node.func, ast.Attribute) else _listed(node.args[0])
        yield "last", ast.Subscript(every, LAST)
    for keyword in node.keywords:
        kind = "exchanged" if keyword.arg == "order" else "instead"
        yield kind, ast.Call(node.func, node.args, [x for x in node.keywords if x is not keyword])
    if called(node) == "range":
        yield "instead", parsed("reversed(_)", node)
        bound = node.args[min(1, len(node.args) - 1)]
        for op in () if isinstance(bound, ast.Constant | ast.BinOp) else (ast.Add(), ast.Sub()):
            one = ast.BinOp(bound, op, ast.Constant(1))
            yield "instead", ast.Call(node.func, [one if x is bound else x for x in node.args], [])
        if len(node.args) == 1:
            yield "instead", ast.Call(node.func, [ast.Constant(1), *node.args], [])
        if len(node.args) == 2 and isinstance(start := getattr(node.args[0], "value", None), int):
            yield "instead", ast.Call(node.func, [node.args[0], ast.Constant(start + 1)], [])


def _of_module(node: ast.Call) -> int | None:
    """Return 1 for a function of NumPy, 0 for a method, None for what stands by itself."""
    owner = node.func.value if isinstance(node.func, ast.Attribute) else None
    return None if owner is None else int(ast.unparse(owner) in ("np", "np.linalg"))


def _listed(each: ast.expr) -> ast.expr:
    return ast.List([ast.Starred(each)], ast.Load())


def _with_other_arguments(node: ast.Call) -> Iterator[Change]:
    """Yield a call with its arguments in one pair of brackets, in another order, or with one of them zero."""

    def again(*arguments: ast.expr) -> ast.Call:
        return ast.Call(node.func, [*arguments], node.keywords)

    if len(node.args) > 1:
        yield "instead", again((ast.Tuple if called(node) in CONSTANT else ast.List)(node.args, ast.Load()))
    last = node.args[-1] if node.args else None
    if isinstance(last, ast.BinOp) and isinstance(last.op, ast.Add | ast.Sub):
        yield "instead", ast.BinOp(again(*node.args[:-1], last.left), last.op, last.right)
    for arguments in exchanges(node.args) if called(node) not in IN_ORDER else ():
        yield "exchanged", again(*arguments)
    for i, j in combinations(range(len(node.args)), 2):
        x, y = node.args[i], node.args[j]
        if isinstance(x, ast.BinOp) and isinstance(y, ast.BinOp) and type(x.op) is type(y.op) is ast.Mult:
            pair = {i: ast.BinOp(y.left, x.op, x.right), j: ast.BinOp(x.left, y.op, y.right)}
            yield "exchanged", again(*(pair.get(k, z) for k, z in enumerate(node.args)))
    for k, argument in enumerate(node.args):
        if isinstance(argument, ast.Name) or any(isinstance(x, ast.Call) for x in ast.walk(argument)):
            zero = ast.BinOp(ast.Constant(0), ast.Mult(), argument)
            yield "inserted", again(*node.args[:k], zero, *node.args[k + 1 :])
    if called(node) == "pad" and is_whole(last):
        for width in ((last, ast.Constant(0)), (ast.Constant(0), last)):  # at one end only
            yield "exchanged", again(*node.args[:-1], ast.Tuple([*width], ast.Load()))


def _of_method(node: ast.Call) -> Iterator[Change]:
    """Yield an array without what is called of it, and without brackets what is not a function."""
    if not isinstance(node.func, ast.Attribute) or is_copy(node):
        return
    if node.func.attr == "T" and not node.args:
        yield "instead", node.func
    elif called(node) in TURNING or not node.args:
        module = getattr(node.func.value, "id", "") == "np"
        yield from (("left out", x) for x in (node.args[:1] if module else [node.func.value]))


def names_used(node: Any) -> Iterator[Change]:
    """Yield what an attribute, a name or a text may be taken for: its twin, or the same in another module."""
    if isinstance(node, ast.Attribute):
        if node.attr in ("mT", "T"):
            yield "transposed", node.value
            yield "instead", parsed("np.linalg.inv(_)", node.value)
            if isinstance(node.value, ast.Call) and called(node.value) == "reshape":
                yield "instead", ast.Call(node.value.func, node.value.args[::-1], [])
        module = {"np": np, "tw": tw}.get(getattr(node.value, "id", ""))
        if module is not None and not hasattr(module, node.attr):
            yield from (("instead", parsed(text)) for text in in_modules(node.attr))
        for other in twins(node.attr):
            yield "instead", ast.Attribute(node.value, other, node.ctx)
    if isinstance(node, ast.Name):
        yield from (("instead", ast.Name(other, node.ctx)) for other in twins(node.id))
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        kind = "exchanged" if node.value in ("C", "F") else "instead"  # the order of rows and columns
        yield from ((kind, ast.Constant(other)) for other in twins(node.value))


def in_modules(name: str) -> Iterator[str]:
    """Yield the full names of functions that have this name."""
    modules = {"tw": tw, "np": np, "np.linalg": np.linalg}
    yield from (f"{module}.{name}" for module, x in modules.items() if name in dir(x))
