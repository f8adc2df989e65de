"""How a piece of a program, and a change of it, is written in a message."""

from __future__ import annotations

import ast
from typing import Any

__all__ = ["enclosing", "target", "term", "text_of"]


def term(node: Any, other: Any) -> str:
    """Return what a node has more than the other, or the term whose sign differs, or the statement that is moved."""
    if isinstance(node, ast.For | ast.While):
        if isinstance(other, ast.If) and isinstance(other.body[-1], ast.For | ast.While):  # one line is summed up
            return text_of(next(x for x, y in zip(node.body, other.body[-1].body) if x is not y))
        return text_of(other.body[-1] if isinstance(other, ast.If) else other.body[0])
    if isinstance(other, ast.Pass):
        return text_of(node)
    if isinstance(other, ast.UnaryOp) and other.operand is node:
        return text_of(node)
    if isinstance(node, ast.BinOp):
        kept = getattr(other, "operand", getattr(other, "right", other))
        gone = other is not node.left and (kept is node.right and getattr(other, "left", None) is not node.left)
        return text_of(node.left if gone else node.right)
    if isinstance(node, ast.List | ast.Tuple | ast.BoolOp):
        mine = node.values if isinstance(node, ast.BoolOp) else node.elts
        theirs = other.values if isinstance(other, ast.BoolOp) else getattr(other, "elts", [other])
        return text_of(next((x for x in mine if x not in theirs), node))
    if isinstance(node, ast.Call) and isinstance(other, ast.expr):
        return text_of(node.func) if node.args else f".{getattr(node.func, 'attr', '')}()"
    if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Slice):
        return f"[{text_of(node.slice)}]"
    if isinstance(node, ast.Attribute):
        return f".{node.attr}"
    return text_of(node.operand if isinstance(node, ast.UnaryOp) else node)


def target(parents: list[Any]) -> str:
    """Return what the statement around a node computes; nothing for a result."""
    for parent in reversed(parents):
        if isinstance(parent, ast.Assign | ast.AugAssign):
            return text_of(parent.targets[0] if isinstance(parent, ast.Assign) else parent.target)
    return ""


def enclosing(parents: list[Any], node: Any) -> Any:
    """Return what to show of a program around a node: more than it where it is only a name, a number or a slice."""
    for parent in reversed(parents):
        small = isinstance(node, ast.Constant | ast.Slice | ast.Name | ast.UnaryOp)
        small |= isinstance(parent, ast.Subscript) and node is parent.slice
        if not small or not isinstance(parent, ast.expr):
            break
        node = parent
    return node


def text_of(node: ast.AST) -> str:
    """Return a piece of a program as text, on one line, with `.T` where it has `.mT`."""
    return ast.unparse(node).split("\n")[0].replace(".mT", ".T")
