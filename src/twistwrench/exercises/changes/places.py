"""Places in a syntax tree: where something may be changed, what stands around it, and how it is put there."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from typing import Any

from .excerpts import text_of, with_operator

__all__ = [
    "Place",
    "all_places",
    "changed_around",
    "innermost",
    "is_empty",
    "mark",
    "may_be_argument",
    "put",
    "put_in",
    "stands_elsewhere",
    "surroundings",
    "unused",
]

Place = tuple[list[Any], Any, Any, Any]
"""The nodes around a node, its place in the innermost, itself, and what is put there."""


def mark(texts: tuple[str, str], node: Any, other: Any) -> tuple[str, str]:
    """Return by what an edit is recognised in another place."""
    if (
        isinstance(node, ast.BinOp)
        and isinstance(other, ast.BinOp)
        and (node.left, node.right) == (other.left, other.right)
    ):
        if isinstance(node.op, ast.Mult) and isinstance(other.op, ast.MatMult):
            return "*", "@"
        signs = (text_of(ast.BinOp(ast.Name("x"), op, node.right)) for op in (node.op, other.op))
        right, wrong = signs
        return right, wrong
    if isinstance(node, ast.Compare) and isinstance(other, ast.Compare) and node.left is other.left:
        right, wrong = (text_of(ast.Compare(ast.Name("x"), x.ops, [ast.Name("y")]))[2:-2] for x in (node, other))
        return right, wrong
    return (with_operator(node, texts[0]), "") if not texts[1] else (text_of(node), text_of(other))


def is_empty(node: Any) -> bool:
    """Whether a slice ends where it begins, or before."""
    match node:
        case ast.Slice(lower=ast.Constant(value=int(begin)), upper=ast.Constant(value=int(end))):
            return begin >= end
    return False


def stands_elsewhere(name: str, places: Sequence[Any]) -> bool:
    """Whether a name is read in other places, too, of the function or method in which these places are."""
    around = next((x for x in reversed(places[0][0]) if isinstance(x, ast.FunctionDef)), places[0][0][0])
    read = [x for x in ast.walk(around) if isinstance(x, ast.Name) and x.id == name and isinstance(x.ctx, ast.Load)]
    return len(read) > len(places)


def innermost(nodes: Sequence[Any]) -> Any:
    """Return the last statement among the nodes around a place; None where there is none."""
    return next((x for x in reversed(nodes) if isinstance(x, ast.stmt)), None)


def all_places(node: ast.AST, parents: tuple[Any, ...] = ()) -> Iterator[tuple[list[Any], Any, Any]]:
    """Yield every expression and assignment with the nodes around it and its place in the innermost of them."""
    for name, value in ast.iter_fields(node) if not isinstance(node, ast.Raise) else ():
        if name in ("args", "returns", "annotation", "decorator_list") and not isinstance(node, ast.Call):
            continue
        for field, child in (
            [((name, k), x) for k, x in enumerate(value)] if isinstance(value, list) else [(name, value)]
        ):
            if isinstance(child, ast.AST) and not isinstance(child, ast.expr_context | ast.operator | ast.cmpop):
                if isinstance(child, ast.expr | ast.Assign | ast.AugAssign | ast.For | ast.While):
                    yield [*parents, node], field, child
                yield from all_places(child, (*parents, node))


def unused(function: ast.AST) -> list[str]:
    """Return the arguments of a function that it does not use."""
    if not isinstance(function, ast.FunctionDef):
        return []
    used = {x.id for x in ast.walk(function) if isinstance(x, ast.Name)}
    return [x.arg for x in function.args.args if x.arg not in used]


def may_be_argument(node: Any) -> bool:
    """Whether a node is something by itself, in place of which an argument may have been forgotten."""
    if isinstance(node, ast.Constant):
        return isinstance(node.value, str)
    return isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Load)


def surroundings(parents: list[Any]) -> Any:
    """Return the expression around a node, but for a slice, a list or a tuple of them."""
    found = parents[-1]
    for parent in reversed(parents):
        if not isinstance(found, ast.Slice | ast.Tuple | ast.List):
            break
        found = parent
    return found


def _alone(parents: list[Any], node: Any, text: str) -> Any:
    """Return the expression around a piece of a statement that stands there once; None where the piece does."""
    inside = [x for x in parents if isinstance(x, ast.stmt)][-1:]
    if not inside or not isinstance(inside[0], ast.Assign | ast.AugAssign | ast.Return | ast.Expr):
        return None
    whole = text_of(inside[0])
    around = [x for x in (node, *reversed(parents[parents.index(inside[0]) + 1 :])) if isinstance(x, ast.expr)]
    longer = (x for x in around if text in text_of(x) != text and whole.count(text_of(x)) == 1)
    return next(longer, None) if whole.count(text) > 1 else None


def changed_around(place: Any, text: str) -> tuple[str, str]:
    """Return the text of what is around a change where the piece alone could be another one, before and after it."""
    parents, field, node, other = place
    around = _alone(parents, node, text)
    if around is None:
        return "", ""
    before = text_of(around)
    if around is node:
        return before, text_of(other)
    put(parents[-1], field, other)
    after = text_of(around)
    put(parents[-1], field, node)
    return before, after


def put_in(place: Place) -> None:
    """Put what a place has for it in place of a node, and on its line where it has none."""
    parents, field, node, other = place
    if getattr(other, "end_lineno", None) is None:
        ast.copy_location(other, node)
    ast.fix_missing_locations(other)
    put(parents[-1], field, other)


def put(parent: Any, field: Any, node: Any) -> None:
    """Put a node in its place."""
    if isinstance(field, tuple):
        getattr(parent, field[0])[field[1]] = node
    else:
        setattr(parent, field, node)
