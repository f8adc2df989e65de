"""How a piece of a program, and a change of it, is written in a message."""

from __future__ import annotations

import ast
from typing import Any

__all__ = ["assignment", "enclosing", "taken_out", "term", "text_of", "with_operator"]


def term(node: Any, other: Any) -> str:
    """Return what a node has more than the other, or the term whose sign differs, or the statement that is moved."""
    if isinstance(node, ast.For | ast.While):
        if isinstance(other, ast.If) and isinstance(other.body[-1], ast.For | ast.While):  # one line is summed up
            return text_of(next(x for x, y in zip(node.body, other.body[-1].body) if x is not y))
        return text_of(other.body[-1] if isinstance(other, ast.If) else other.body[0])
    if isinstance(other, ast.Pass):
        return text_of(node)
    if isinstance(node, ast.AugAssign):
        return text_of(node.value)
    if any(x is node for x in ast.walk(other)):
        return text_of(node)
    if isinstance(node, ast.BinOp):
        kept = other if other is node.right else getattr(other, "operand", getattr(other, "right", other))
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


def assignment(parents: list[Any]) -> str:
    """Return the statement around a node that gives something a name; nothing for a result."""
    return next((text_of(x) for x in reversed(parents) if isinstance(x, ast.Assign | ast.AugAssign)), "")


def enclosing(parents: list[Any], node: Any) -> Any:
    """Return what to show of a program around a node: more than it where it is only a name, a number or a slice."""
    for parent in reversed(parents):
        small = isinstance(node, ast.Constant | ast.Slice | ast.Name | ast.UnaryOp)
        small |= isinstance(parent, ast.Subscript) and node is parent.slice
        if not small or not isinstance(parent, ast.expr | ast.keyword):
            break
        node = parent
    return node


def taken_out(node: Any, other: Any, text: str) -> str:
    """Return what is taken out of a sum or product with the operator beside it, which must not be left over."""
    if not isinstance(node, ast.BinOp) or (other is not node.left and other is not node.right):
        return with_operator(node, text)
    rest = ast.Name("_")
    kept = ast.BinOp(rest, node.op, node.right) if other is node.left else ast.BinOp(node.left, node.op, rest)
    return text_of(kept).removeprefix("_ ").removesuffix(" _")


def with_operator(node: Any, text: str) -> str:
    """Return a number that is taken out of a sum or product with the operator beside it: 2 alone may be anywhere."""
    if not isinstance(node, ast.BinOp) or not text.replace(".", "").isdigit():
        return text
    sign = text_of(ast.BinOp(ast.Name("x"), node.op, ast.Name("y")))[1:-1].strip()
    return f"{text} {sign}" if text_of(node.left) == text else f"{sign} {text}"


def text_of(node: ast.AST) -> str:
    """Return a piece of a program as text, on one line, with `.T` where it has `.mT`."""
    return ast.unparse(node).split("\n")[0].replace(".mT", ".T")
