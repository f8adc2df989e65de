"""Names and numbers that are taken for each other."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator, Mapping
from typing import Any

__all__ = ["habits", "has_no_sign", "is_copy", "is_whole", "numbers", "twins"]

TWINS = (
    *(("motion_transform", "force_transform"), ("cross_motion", "cross_force"), ("inward", "outward")),
    *(("nonlinear_effects", "gravity"), ("cos", "sin"), ("rotation", "translation"), ("cross", "multiply", "outer")),
    *(("nanmax", "max"), ("nanmin", "min"), ("nanmean", "mean"), ("nansum", "sum")),
    *(("max", "median", "min", "mean", "sum"), ("solve", "matmul"), ("lower", "upper"), ("any", "all")),
    *(
        ("FR_foot", "FL_foot", "RR_foot"),
        ("hypot", "add"),
        ("log", "log10", "log2"),
        ("vstack", "hstack"),
        ("zeros", "eye"),
    ),
    *(("local", "world", "local_world_aligned"), ("com", "translation"), ("neutral", "standing"), ("triu", "tril")),
    ("C", "F"),
)
"""Names that are taken for each other."""


def twins(name: str) -> Iterator[str]:
    """Yield the names that are taken for this one."""
    yield from (other for twins in TWINS if name in twins for other in twins if other != name)


def is_copy(node: Any) -> bool:
    """Whether a node only copies an array: what is a term of nothing has no sign."""
    name = getattr(node.func, "attr", "") if isinstance(node, ast.Call) else ""
    return name == "copy" or (name in ("array", "asarray") and not isinstance(node.args[0], ast.List | ast.Tuple))


def has_no_sign(node: Any) -> bool:
    """Whether a node is a size or a bound, before which nobody forgets a sign, or no number at all."""
    if getattr(node, "id", "") == "NotImplemented":
        return True
    called = getattr(node, "func", None)
    name = getattr(called, "attr", getattr(called, "id", ""))
    return name in ("norm", "abs", "max", "min", "clip", "sqrt", "hypot", "len", "median", "arange", "linspace")


def is_whole(node: Any) -> bool:
    """Whether a node is a whole number without a sign."""
    return isinstance(node, ast.Constant) and type(node.value) is int


def numbers(node: Any) -> Iterator[ast.expr]:
    """Yield other numbers."""
    if isinstance(node, ast.UnaryOp) and is_whole(node.operand):  # -1 is one number
        x: Any = ast.literal_eval(node.operand)
        yield from (ast.Constant(other) for other in dict.fromkeys((0, 1 - x, -1 - x)))
    if isinstance(node, ast.Attribute) and ast.unparse(node) in ("np.pi", "np.inf", "np.e"):
        yield from (ast.Constant(other) for other in (1.0, 0.0, 2.0))
    if isinstance(node, ast.Constant) and isinstance(node.value, int | float) and not isinstance(node.value, bool):
        x = node.value
        others = (
            [x + 1, x - 1, 0, x + 2, x - 2, -1, -x, 2 * x, x / 2, 3, 6]
            if isinstance(x, int)
            else [10, 9.8, 9.81, 1.0, 0.0, -x, 2 * x, x / 2, 10 * x, x / 10]
        )
        yield from (ast.Constant(other) for other in dict.fromkeys(others) if other != x)


def habits(node: Any, kinds: Mapping[str, Any]) -> Iterator[str]:
    """Yield what is done to an array and may be forgotten with another: an index by a name, a helper of the student."""
    if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Name):
        kind = kinds.get(node.slice.id)
        if isinstance(kind, tuple) and not isinstance(node.ctx, ast.Store):
            yield f"{{}}[{node.slice.id}]"
    called = node.func if isinstance(node, ast.Call) and len(node.args) == 1 and not node.keywords else None
    if isinstance(called, ast.Name) and not hasattr(builtins, called.id):
        yield f"{called.id}({{}})"
