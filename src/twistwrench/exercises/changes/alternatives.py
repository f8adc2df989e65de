"""What could stand in place of a piece of a program by a small mistake."""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator, Sequence
from typing import Any

from .calling import CONSTANT, called, calls, names_used
from .containers import Change, containers, exchanges, parsed
from .excerpts import text_of
from .twins import has_no_sign, is_copy, is_whole, numbers

__all__ = [
    "FACTORS",
    "KINDS",
    "alternatives",
    "crossed",
]

KINDS = (
    *("exchanged", "halves", "sign", "transposed", "left out", "last", "name", "index", "instead"),
    *("after loop", "in loop", "carried", "summed", "number", "inserted", "diagonal"),
)
"""The kinds of edits, the likeliest first."""

FACTORS = ("2", "9.81")
OPPOSITE = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.FloorDiv: ast.Div}
COMPARED: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.LtE: (ast.Lt, ast.GtE),
    ast.Lt: (ast.LtE, ast.Gt),
    ast.GtE: (ast.Gt, ast.LtE),
    ast.Gt: (ast.GtE, ast.Lt),
    ast.Eq: (ast.NotEq, ast.LtE, ast.GtE),
    ast.NotEq: (ast.Eq, ast.Lt, ast.Gt),
}

LARGE = 1e3
"""What is compared with a number of this size may be meant to be infinite."""


def alternatives(
    node: Any, parent: Any, names: Sequence[str], matrices: Sequence[ast.expr], scalars: Sequence[ast.expr]
) -> Iterator[Change]:
    """Yield what could stand in place of a node.

    Parameters
    ----------
    node, parent : ast.AST
    names : sequence of str
        Those that the node, where it is a name, may be taken for.
    matrices, scalars : sequence of ast.expr
        Square matrices and numbers that are at hand as a further factor.
    """
    for changes in (_statements, _operations, containers, calls, names_used):
        if not isinstance(parent, ast.Slice):  # the step of a slice has no sign
            yield from changes(node)
    if not (isinstance(parent, ast.UnaryOp) and is_whole(node)):
        kind = "index" if isinstance(parent, ast.Subscript) else "number"
        bound = isinstance(parent, ast.Slice)
        under = isinstance(parent, ast.BinOp) and isinstance(parent.op, ast.Div) and node is parent.right
        for other in numbers(node):
            if (not bound or _plausible(node, other)) and not (under and ast.literal_eval(other) <= 0):
                yield kind, other
    if isinstance(node, ast.For | ast.While):
        yield from _loops(node, parent)
    written = isinstance(getattr(parent, "ctx", None), ast.Store)
    if isinstance(node, ast.Name) and (not written or _is_of_a_block(node, parent)):
        yield from (("name", parsed(name)) for name in names if not _beside(name, parent))
    if written:
        return  # a term is read, and this is written to
    if _is_term(node, parent):
        if not is_copy(node) and not has_no_sign(node) and not has_no_sign(parent):
            yield "sign", ast.UnaryOp(ast.USub(), node)
        if not is_copy(node):
            yield "transposed", _transposed(node)
        yield "instead", parsed("np.linalg.inv(_)", node)
        if isinstance(node, ast.Call) and called(node) in CONSTANT:
            return
        yield "inserted", parsed("abs(_)", node)
        yield "diagonal", parsed("np.diag(_)", parsed("np.diag(_)", node))
        for R in matrices:
            yield "inserted", ast.BinOp(R, ast.MatMult(), node)
            yield "inserted", ast.BinOp(_transposed(R), ast.MatMult(), node)
        for scalar in (x for x in scalars if ast.unparse(x) != ast.unparse(node)):
            yield from (("inserted", ast.BinOp(node, op, scalar)) for op in (ast.Mult(), ast.Div()))


def _plausible(node: Any, other: Any) -> bool:
    """Whether the bound of a slice is taken for another: the one beside it, nothing, or that of a block."""
    x, y = getattr(node, "value", 0), getattr(other, "value", 0)
    return y in (0, 3, 6, 12) or abs(x - y) <= 1


def _transposed(node: ast.expr) -> ast.expr:
    return ast.Attribute(node, "mT", ast.Load())


def _is_term(node: Any, parent: Any) -> bool:
    """Whether a node is a term, a factor, an argument, an entry or a result, and not a number or a text."""
    if isinstance(node, ast.Constant | ast.Slice | ast.Starred | ast.Tuple | ast.List | ast.ListComp | ast.keyword):
        return False
    if isinstance(getattr(node, "ctx", ast.Load()), ast.Store):
        return False
    if isinstance(parent, ast.Call) and getattr(parent.func, "id", "") == "range":
        return False
    return isinstance(
        parent, ast.BinOp | ast.UnaryOp | ast.Call | ast.List | ast.Tuple | ast.Return | ast.Assign
    ) and not (isinstance(parent, ast.Call) and node is parent.func)


def _is_of_a_block(node: Any, parent: Any) -> bool:
    """Whether a node is the array of which a block is written to."""
    return (
        isinstance(parent, ast.Subscript) and node is parent.value and isinstance(parent.slice, ast.Tuple | ast.Slice)
    )


def _beside(name: str, parent: Any) -> bool:
    """Whether a name is already among the things that are returned: none of them is the other."""
    return isinstance(parent, ast.Tuple) and any(getattr(x, "id", "") == name for x in parent.elts)


def _loops(node: Any, parent: Any) -> Iterator[Change]:
    """Yield a loop without its last statement, which comes after it, or with the one before it at its beginning."""
    if len(node.body) > 1:
        fewer = copy.copy(node)
        fewer.body = node.body[:-1]
        yield "after loop", ast.If(ast.Constant(True), [fewer, node.body[-1]], [])
    for k, line in enumerate(node.body):
        if (
            isinstance(line, ast.Assign)
            and isinstance(line.targets[0], ast.Name)
            and not isinstance(line.value, ast.Constant)  # nobody adds up a number that is written there
        ):
            summed = copy.copy(node)
            summed.body = [*node.body[:k], ast.AugAssign(line.targets[0], ast.Add(), line.value), *node.body[k + 1 :]]
            yield "summed", ast.If(ast.Constant(True), [ast.Assign(line.targets, ast.Constant(0)), summed], [])
    yield from _carried(node)
    around = getattr(parent, "body", [])
    k = next((k for k, other in enumerate(around) if other is node), 0)
    for j, line in enumerate(around[:k]):
        near = isinstance(line, ast.Assign) and _set_by(line) & (_used(node) if j == k - 1 else _filled(node))
        if near:
            more = copy.copy(node)
            more.body = [line, *node.body]
            yield "in loop", more


def _carried(node: Any) -> Iterator[Change]:
    """Yield a loop in which what a line computes from a name is kept under that name, for the next round."""
    stored = {x.id for x in ast.walk(node) if isinstance(x, ast.Name) and isinstance(x.ctx, ast.Store)}
    for line in node.body:
        if not isinstance(line, ast.Assign) or not isinstance(line.targets[0], ast.Name):
            continue
        read = {x.id for x in ast.walk(line.value) if isinstance(x, ast.Name)}
        called = {x.func.id for x in ast.walk(line.value) if isinstance(x, ast.Call) and isinstance(x.func, ast.Name)}
        whole = {x.value.id for x in ast.walk(line.value) if hasattr(x, "value") and isinstance(x.value, ast.Name)}
        for name in sorted(read - stored - called - whole):
            other = copy.deepcopy(node)
            for x in ast.walk(other):
                if isinstance(x, ast.Name) and x.id == line.targets[0].id:
                    x.id = name
            other.said = text_of(line), name
            yield "carried", other


def _set_by(line: ast.Assign) -> set[str]:
    return {x.id for target in line.targets for x in ast.walk(target) if isinstance(x, ast.Name)}


def _used(loop: Any) -> set[str]:
    return {x.id for line in loop.body for x in ast.walk(line) if isinstance(x, ast.Name)}


def _filled(loop: Any) -> set[str]:
    """Return the names of arrays of which a loop sets entries."""
    stored = (x for line in loop.body for x in ast.walk(line) if isinstance(x, ast.Subscript))
    return {x.value.id for x in stored if isinstance(x.ctx, ast.Store) and isinstance(x.value, ast.Name)}


def _statements(node: Any) -> Iterator[Any]:
    """Yield an assignment with another sign, with = in place of += or the other way, or with things exchanged."""
    if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Subscript):
        yield "left out", ast.Pass()
    if isinstance(node, ast.AugAssign):
        if type(node.op) in OPPOSITE:
            kind = "sign" if isinstance(node.op, ast.Add | ast.Sub) else "instead"
            yield kind, ast.AugAssign(node.target, OPPOSITE[type(node.op)](), node.value)
        yield "instead", ast.Assign([node.target], node.value, lineno=node.lineno)
        yield "left out", ast.Pass()
    if isinstance(node, ast.While):
        yield "instead", ast.If(node.test, node.body, [])
    if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Tuple):
        beside = isinstance(node.value, ast.Tuple)  # each name stands beside its own value
        for targets in () if beside else exchanges(node.targets[0].elts):
            yield "exchanged", ast.Assign([ast.Tuple(targets, ast.Store())], node.value, lineno=node.lineno)
        if isinstance(node.value, ast.Tuple) and isinstance(node.value.elts[0], ast.Subscript):
            copies = ast.Tuple([parsed("np.copy(_)", x) for x in node.value.elts], ast.Load())
            yield "instead", ast.Assign(node.targets, copies, lineno=node.lineno)
    elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name | ast.Subscript):
        yield "instead", ast.AugAssign(node.targets[0], ast.Add(), node.value, lineno=node.lineno)


def _operations(node: Any) -> Iterator[Change]:
    """Yield an operation without a term or factor, with another sign, or with its factors exchanged."""
    if isinstance(node, ast.BinOp):
        left, op, right = node.left, node.op, node.right
        if isinstance(op, ast.Add | ast.Sub | ast.Mult | ast.Div | ast.MatMult | ast.Pow):
            yield "left out", left
            if not isinstance(op, ast.Pow):
                minus, over = isinstance(op, ast.Sub), isinstance(op, ast.Div)
                one = ast.BinOp(ast.Constant(1), op, right)
                yield "left out", ast.UnaryOp(ast.USub(), right) if minus else one if over else right
        if type(op) in OPPOSITE:
            kind = "sign" if isinstance(op, ast.Add | ast.Sub) else "instead"
            yield kind, ast.BinOp(left, OPPOSITE[type(op)](), right)
        if isinstance(op, ast.MatMult | ast.Sub | ast.Div):
            yield "instead" if isinstance(op, ast.MatMult) else "exchanged", ast.BinOp(right, op, left)
        if isinstance(op, ast.MatMult) and isinstance(left, ast.BinOp) and isinstance(left.op, ast.MatMult):
            yield "exchanged", ast.BinOp(ast.BinOp(right, op, left.right), op, left.left)
        if isinstance(op, ast.MatMult):
            yield "instead", ast.BinOp(left, ast.Mult(), right)
        if isinstance(op, ast.Pow) and ast.unparse(right) == "-1":
            yield "instead", parsed("np.linalg.inv(_)", left)
        if isinstance(op, ast.Div) and getattr(left, "value", 0) == 1:
            yield "instead", parsed("np.linalg.inv(_)", right)
        if isinstance(op, ast.Mult):
            yield "instead", ast.BinOp(right, ast.Div(), left)
            yield "instead", ast.BinOp(left, ast.MatMult(), right)
            yield "instead", parsed("np.cross(_, _)", left, right)
        yield from _diagonals(left, op, right)
        yield from _brackets(left, op, right)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield "sign", node.operand
    if isinstance(node, ast.Compare) and type(node.ops[0]) in COMPARED:
        yield from (("instead", ast.Compare(node.left, [op()], node.comparators)) for op in COMPARED[type(node.ops[0])])
        yield from _infinite(node)
    if isinstance(node, ast.BoolOp):
        yield from _compared_with_each(node)
        yield "instead", ast.BoolOp(ast.Or() if isinstance(node.op, ast.And) else ast.And(), node.values)
        for k, _ in enumerate(node.values):
            others = node.values[:k] + node.values[k + 1 :]
            yield "left out", ast.BoolOp(node.op, others) if len(others) > 1 else others[0]


def _compared_with_each(node: ast.BoolOp) -> Iterator[Change]:
    """Yield x == a or x == b in place of x == a or b."""
    first, *others = node.values
    if isinstance(first, ast.Compare) and any(isinstance(x, ast.Constant) for x in others):
        each = [ast.Compare(first.left, first.ops, [x]) if isinstance(x, ast.Constant) else x for x in others]
        yield "instead", ast.BoolOp(node.op, [first, *each])


def _infinite(node: ast.Compare) -> Iterator[Change]:
    """Yield a comparison with infinity in place of one with a large number."""
    try:
        bound = ast.literal_eval(node.comparators[0])
    except ValueError:  # no number
        return
    if isinstance(bound, int | float) and abs(bound) >= LARGE:
        other = parsed("np.inf" if bound > 0 else "-np.inf")
        yield "instead", ast.Compare(node.left, [ast.Eq()], [other])


def crossed(node: ast.expr, one: str, other: str) -> ast.expr:
    """Return a copy of an expression in which two names are exchanged."""
    found = copy.deepcopy(node)
    for part in ast.walk(found):
        if isinstance(part, ast.Name) and part.id in (one, other):
            part.id = other if part.id == one else one
    return found


def _diagonals(left: Any, op: Any, right: Any) -> Iterator[Change]:
    """Yield a matrix in place of its diagonal, which multiplies or divides entry by entry."""
    for node, other in ((left, right), (right, left)):
        if isinstance(node, ast.Call) and getattr(node.func, "attr", "") in ("diag", "diagonal") and node.args:
            if isinstance(op, ast.Mult):
                yield "instead", ast.BinOp(node.args[0], ast.MatMult(), other)
            elif isinstance(op, ast.Div) and node is right:
                yield "instead", parsed("np.linalg.solve(_, _)", node.args[0], other)


def _brackets(left: Any, op: Any, right: Any) -> Iterator[Change]:
    """Yield A (b + c) in place of A b + c, and f(A, b + c) in place of f(A, b) + c, and the other way round."""
    if isinstance(op, ast.Add | ast.Sub) and isinstance(left, ast.Call) and left.args:
        yield "instead", ast.Call(left.func, [*left.args[:-1], ast.BinOp(left.args[-1], op, right)], left.keywords)
    if (
        isinstance(op, ast.Add | ast.Sub)
        and isinstance(left, ast.BinOp)
        and isinstance(left.op, ast.MatMult | ast.Mult)
    ):
        for sign in (ast.Add(), ast.Sub()):
            yield "instead", ast.BinOp(left.left, left.op, ast.BinOp(left.right, sign, right))
    if isinstance(op, ast.MatMult | ast.Mult) and isinstance(right, ast.BinOp) and type(right.op) in (ast.Add, ast.Sub):
        yield "instead", ast.BinOp(ast.BinOp(left, op, right.left), right.op, right.right)
        yield "instead", ast.BinOp(right.left, right.op, ast.BinOp(left, op, right.right))
