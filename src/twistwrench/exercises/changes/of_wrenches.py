"""Whether a change would transform a wrench as a twist is transformed, or a twist as a wrench."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from typing import Any

from ..exercise import Part
from .places import innermost, put
from .whole import Edit

__all__ = ["turns_into_the_other_kind"]


def turns_into_the_other_kind(edit: Edit, part: Part) -> bool:
    """Whether a wrench that is asked for would be transformed like a twist, or a twist like a wrench."""
    rows = [x.layout.axes[0][0][0].en for x in part.returns if x.layout.axes]
    motion, force = (all(row in names for row in rows) for names in (("ω", "v"), ("τ", "k (angular)")))
    if not rows or motion == force or not edit.places:
        return False
    lines = [innermost(parents) or node for parents, _, node, _ in edit.places]
    names = _named(edit.places[0][0][0])
    were = [kind for line in lines for kind in _of_forces(line, names)]
    for parents, field, _, other in edit.places:
        put(parents[-1], field, other)
    are = [kind for line in lines for kind in _of_forces(line, names)]
    for parents, field, node, _ in edit.places:
        put(parents[-1], field, node)
    return were.count(not force) < are.count(not force)


def _named(function: Any) -> dict[str, bool]:
    """Return the names of X and X* where both are set at once, and whether each acts on wrenches."""
    both = [x.targets[0] for x in ast.walk(function) if isinstance(x, ast.Assign) and _gives_both(x.value)]
    pairs = [x.elts for x in both if isinstance(x, ast.Tuple) and len(x.elts) == 2]
    return {x.id: force for pair in pairs for x, force in zip(pair, (False, True)) if isinstance(x, ast.Name)}


def _gives_both(node: Any) -> bool:
    called = ast.unparse(node.func) if isinstance(node, ast.Call) else ""
    return "plucker" in called or "transforms" in called


def _of_forces(node: Any, names: Mapping[str, bool], force: bool = True) -> Iterator[bool]:
    """Yield of each transform in a text whether it acts on wrenches: the transpose of one for twists does."""
    if isinstance(node, ast.Attribute) and node.attr in ("T", "mT"):
        yield from _of_forces(node.value, names, not force)
    elif isinstance(node, ast.Call) and getattr(node.func, "attr", "") in ("force_transform", "motion_transform"):
        yield (getattr(node.func, "attr", "") == "force_transform") == force
    elif isinstance(node, ast.Subscript) and _gives_both(node.value) and isinstance(node.slice, ast.Constant):
        yield (node.slice.value == 1) == force
    elif isinstance(node, ast.Name) and node.id in names and isinstance(node.ctx, ast.Load):
        yield names[node.id] == force
    elif node is not None:
        for x in ast.iter_child_nodes(node):
            yield from _of_forces(x, names, force)
