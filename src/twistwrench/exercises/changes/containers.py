"""What may be changed in a list, a tuple, an index or a slice."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import combinations
from typing import Any

__all__ = ["Change", "containers", "exchanges", "parsed"]

Change = tuple[str, Any]
"""Kind of an edit, and what is put in place of a node."""

SLICES = (":", ":3", "3:6", "3:", ":6", "6:", "-6:")


def parsed(text: str, *nodes: ast.expr) -> ast.expr:
    """Parse an expression; where it is a call, the underscores among its arguments stand for nodes."""
    tree, given = ast.parse(text, mode="eval").body, iter(nodes)
    if nodes and isinstance(tree, ast.Call):
        tree.args = [next(given) if isinstance(x, ast.Name) and x.id == "_" else x for x in tree.args]
    return tree


def exchanges(entries: list[Any]) -> Iterator[list[Any]]:
    """Yield the entries with two of them exchanged."""
    for i, j in combinations(range(len(entries)), 2):
        yield [entries[j if k == i else i if k == j else k] for k in range(len(entries))]


def containers(node: Any) -> Iterator[Change]:
    """Yield a list or tuple with two entries exchanged, with an entry that is zero, or another slice."""
    if isinstance(node, ast.List | ast.Tuple) and isinstance(node.ctx, ast.Load):
        for entries in exchanges(node.elts):
            yield "exchanged", type(node)(entries, node.ctx)
        rows = [list(x.elts) for x in node.elts if isinstance(x, ast.List)]
        if len(rows) == len(node.elts) and [len(row) for row in rows] == [2, 2]:
            (a, b), (c, d) = rows
            for four in ((a, c, b, d), (d, b, c, a)):
                entries = [ast.List([*four[:2]], node.ctx), ast.List([*four[2:]], node.ctx)]
                yield "exchanged", type(node)(entries, node.ctx)
        for k, entry in enumerate(node.elts):
            if isinstance(entry, ast.Starred):
                yield "left out", type(node)([*node.elts[:k], *node.elts[k + 1 :]], node.ctx)
            elif not isinstance(entry, ast.Constant | ast.Slice | ast.List):
                zero = ast.BinOp(ast.Constant(0), ast.Mult(), entry)
                yield "left out", type(node)([*node.elts[:k], zero, *node.elts[k + 1 :]], node.ctx)
    if isinstance(node, ast.Slice) and ast.unparse(node) in SLICES:
        for other in SLICES:
            if other != ast.unparse(node):
                yield "instead", parsed(f"x[{other}]").slice  # type: ignore[attr-defined]
    if isinstance(node, ast.Slice):
        ends = [x.value for x in (node.lower, node.upper) if isinstance(x, ast.Constant) and isinstance(x.value, int)]
        if len(ends) == 2 and ast.unparse(node) not in SLICES:
            yield "instead", ast.Slice(node.lower)
        for k in (-1, 1) if len(ends) == 2 else ():
            yield "instead", ast.Slice(*(ast.Constant(end + k) for end in ends))
    if isinstance(node, ast.Slice):
        yield from _by_blocks(node)
    if isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Load):
        pair = [getattr(x, "value", None) for x in getattr(node.slice, "elts", ())]
        if len(pair) == 2 and pair[0] == pair[1] and isinstance(pair[0], int):
            for k in range(6):
                yield "index", ast.Subscript(node.value, ast.Tuple([ast.Constant(k)] * 2, ast.Load()), node.ctx)
    if isinstance(node, ast.Subscript):
        if isinstance(node.slice, ast.Slice):
            yield "left out", node.value
            every = ast.Tuple([ast.Slice(), node.slice], ast.Load())
            yield "instead", ast.Subscript(node.value, every, node.ctx)
        elif isinstance(node.slice, ast.Tuple) and len(node.slice.elts) == 2 and _is_all(node.slice.elts[0]):
            yield "instead", ast.Subscript(node.value, node.slice.elts[1], node.ctx)


def _by_blocks(node: ast.Slice) -> Iterator[Change]:
    """Yield n k : n k + n in place of k : k + n."""
    low, high = node.lower, node.upper
    if not isinstance(low, ast.Name) or not isinstance(high, ast.BinOp) or not isinstance(high.op, ast.Add):
        return
    if isinstance(high.right, ast.Constant) and getattr(high.left, "id", "") == low.id:
        begin = ast.BinOp(high.right, ast.Mult(), low)
        yield "instead", ast.Slice(begin, ast.BinOp(begin, ast.Add(), high.right))


def _is_all(node: Any) -> bool:
    return isinstance(node, ast.Slice) and node.lower is node.upper is None
