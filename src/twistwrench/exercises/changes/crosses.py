"""Cross products, and differences as lever arms are: in the text of a program, and which of the two is turned."""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Any

from .whole import Edit

__all__ = ["cross_text", "difference_text", "is_cross", "is_difference", "nodes_of", "of_a_minus", "parsed", "turned"]


def turned(before: str, text: str, reference: Callable[..., Any]) -> bool:
    """Whether of a lever arm and its cross product, either of which gives the sign, this is the one that is turned."""
    lever, product = difference_text(before), cross_text(before)
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


def of_a_minus(edit: Edit, text: str) -> bool:
    """Whether a cross product is subtracted, or a factor has a minus, or the line that names it for this product only.

    Then the slip may be that sign as well as the order of the factors.
    """
    given = {ast.unparse(x.targets[0]): x.value for x in nodes_of(text) if isinstance(x, ast.Assign)}
    names = [x.id for x in nodes_of(text) if isinstance(x, ast.Name)]
    factors = [x for node in nodes_of(edit.right) if is_cross(node) for x in node.args]
    alone = [given.get(x.id, x) if isinstance(x, ast.Name) and names.count(x.id) == 2 else x for x in factors]
    minus = [x for x in alone if isinstance(x, ast.UnaryOp) and isinstance(x.op, ast.USub)]
    around = edit.places[0][0] if edit.places else []
    subtracted = any(isinstance(x, ast.AugAssign) and isinstance(x.op, ast.Sub) for x in around)
    subtracted |= any(is_difference(x) and x.right is node for x in around[-1:] for _, _, node, _ in edit.places[:1])
    products = [x.right for x in nodes_of(edit.right) if is_difference(x) and is_cross(x.right)]
    subtracted = (subtracted and cross_text(edit.right)) or any(_reversed(x) in edit.wrong for x in products)
    return subtracted or any(isinstance(x.operand, ast.Name) for x in minus)


def _reversed(product: ast.Call) -> str:
    """Return the text of a cross product with its factors exchanged."""
    return ast.unparse(ast.Call(product.func, product.args[::-1], product.keywords))


def _arms(text: str) -> Iterator[int]:
    """Yield of each cross product with a lever arm in it which of its factors that is."""
    nodes = [*nodes_of(text)]
    named = [x for x in nodes if isinstance(x, ast.Assign) and _is_arm(x.value)]
    arms = {ast.unparse(target) for x in named for target in x.targets}
    for node in nodes:
        if is_cross(node):
            found = [k for k, x in enumerate(node.args) if _is_arm(x) or ast.unparse(x) in arms]
            yield from found if len(found) == 1 else ()


def _is_arm(node: Any) -> bool:
    """Whether a node is a difference of two points, or one that is turned."""
    product = isinstance(node, ast.BinOp) and isinstance(node.op, ast.MatMult)
    return _is_arm(node.left) or _is_arm(node.right) if product else is_difference(node)


def is_difference(node: Any) -> bool:
    """Whether a node is a difference."""
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.Sub)


def cross_text(text: str) -> bool:
    """Whether a text is a cross product."""
    return isinstance(node := parsed(text), ast.Expr) and is_cross(node.value)


def difference_text(text: str) -> bool:
    """Whether a text is a difference, as a lever arm is."""
    return isinstance(node := parsed(text), ast.Expr) and is_difference(node.value)


def is_cross(node: Any) -> bool:
    """Whether a node is a cross product."""
    return isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "cross" and len(node.args) == 2


def parsed(text: str) -> Any:
    """Return the statement that a text is; None where it is only a piece of one."""
    try:
        return ast.parse(textwrap.dedent(text)).body[0]
    except (SyntaxError, IndexError):
        return None


@lru_cache(maxsize=64)
def nodes_of(text: str) -> tuple[Any, ...]:
    """Return the nodes of a text; none where it is only a piece of a program."""
    try:
        return (*ast.walk(ast.parse(textwrap.dedent(text))),)
    except SyntaxError:
        return ()
