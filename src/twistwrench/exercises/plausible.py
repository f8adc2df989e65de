"""Which changes of a student's function are slips that somebody makes, and which only switch off what is wrong."""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable, Iterator
from typing import Any

from .whole import Edit

__all__ = ["plausible", "shuts"]

POSTURES = ("neutral", "standing")
"""Either may be meant: which of them stands there is not why numbers are wrong."""


def plausible(edit: Edit, text: str, reference: Callable[..., Any]) -> bool:
    """Whether a change that makes a function right is the undoing of a slip.

    Parameters
    ----------
    edit : Edit
        Of the student's function: `right` is what stands there, `wrong` what is put in its place.
    text : str
        The source of the student's function.
    reference : callable
        The solution.
    """
    before, after = edit.right, edit.wrong
    if "0 * " in after and "0 * " not in before:
        return False  # it is switched off
    if edit.kind == "after loop":
        return not isinstance(_parsed(before), ast.Expr)  # a call after the loop is made only once
    if edit.kind == "in loop":
        return not _read_after(_parsed(before), text, edit.line)
    if isinstance(_parsed(after), ast.AugAssign) and isinstance(_parsed(before), ast.Assign):
        return ast.unparse(_parsed(before).targets[0]) not in ast.unparse(_parsed(before).value)  # it is in it already
    if edit.kind == "inserted" and any(before in ast.unparse(x) for x in _nodes(text) if isinstance(x, ast.Compare)):
        return False  # a branch that is wrong needs no further factor in its condition
    if shuts(edit):
        tests = [ast.unparse(x.test) for x in _nodes(text) if isinstance(x, ast.If | ast.IfExp)]
        return ">" not in before and any(before in test for test in tests)
    if any(name in before and name not in after for name in POSTURES):
        return False
    return edit.kind != "exchanged" or _turned(before, text, reference)


def shuts(edit: Edit) -> bool:
    """Whether a change puts a threshold below zero: then a branch is not taken any more."""
    compared = any(isinstance(x, ast.Compare) for x in _nodes(edit.wrong))
    return edit.kind == "number" and compared and edit.wrong.count("-") > edit.right.count("-")


def _read_after(assigned: Any, text: str, line: int) -> bool:
    """Whether what is assigned before a loop is read after it, where it would have only what the last round made."""
    loops = [x for x in _nodes(text) if isinstance(x, ast.For | ast.While) and x.lineno == line]
    end = max((x.end_lineno or 0 for x in loops), default=0)
    names = {ast.unparse(x) for x in getattr(assigned, "targets", ())}
    return any(isinstance(x, ast.Name) and x.id in names and x.lineno > end for x in _nodes(text))


def _turned(before: str, text: str, reference: Callable[..., Any]) -> bool:
    """Whether of a lever arm and its cross product, either of which gives the sign, this is the one that is turned."""
    node = _parsed(before)
    node = node.value if isinstance(node, ast.Expr) else node
    lever, product = isinstance(node, ast.BinOp) and isinstance(node.op, ast.Sub), _is_cross(node)
    if not lever and not product:
        return True
    try:
        expected = {*_arms(inspect.getsource(reference))}
    except (OSError, TypeError):  # no source
        return True
    own = {*_arms(text)}
    if len(own) != 1 or len(expected) != 1:
        return True
    return (own == expected) == lever


def _arms(text: str) -> Iterator[int]:
    """Yield of each cross product with a lever arm in it which of its factors that is."""
    nodes = [*_nodes(text)]
    named = [x for x in nodes if isinstance(x, ast.Assign) and _is_difference(x.value)]
    arms = {ast.unparse(target) for x in named for target in x.targets}
    for node in nodes:
        if _is_cross(node):
            found = [k for k, x in enumerate(node.args) if _is_difference(x) or ast.unparse(x) in arms]
            yield from found if len(found) == 1 else ()


def _is_cross(node: Any) -> bool:
    return isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "cross" and len(node.args) == 2


def _is_difference(node: Any) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.Sub)


def _parsed(text: str) -> Any:
    """Return the statement that a text is; None where it is only a piece of one."""
    try:
        return ast.parse(textwrap.dedent(text)).body[0]
    except (SyntaxError, IndexError):
        return None


def _nodes(text: str) -> Iterator[Any]:
    """Yield the nodes of a text; none where it is only a piece of a program."""
    node = _parsed(text)
    yield from () if node is None else ast.walk(node)
