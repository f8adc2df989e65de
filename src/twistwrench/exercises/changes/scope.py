"""What the names in a function stand for, and so what each of them may be taken for."""

from __future__ import annotations

import ast
import builtins
import difflib
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from .alternatives import FACTORS, alternatives
from .calling import in_modules
from .containers import Change, parsed
from .excerpts import text_of
from .places import all_places, may_be_argument, unused
from .twins import habits

__all__ = ["Scope"]


class Scope:
    """The names in a function, and what they are when it runs.

    Parameters
    ----------
    tree : ast.AST
        Of the function.
    values : mapping
        Of the names in it.
    names : mapping
        Of its module.
    """

    def __init__(self, tree: ast.AST, values: Mapping[str, Any], names: Mapping[str, Any]) -> None:
        nodes = [*ast.walk(tree)]
        self.kinds = {name: _kind(x) for name, x in values.items()}
        square = [name for name in self.kinds if self._is_square(name)]
        square += [f"{name}.rotation" for name, x in values.items() if hasattr(x, "rotation")]
        square += sorted({ast.unparse(x) for x in nodes if getattr(x, "attr", "") == "rotation"} - {*square})
        slices = [x.slice for x in nodes if isinstance(x, ast.Subscript)]
        indices = {x.id for each in slices for x in ast.walk(each) if isinstance(x, ast.Name)}  # no factors
        scalars = {name for name, x in values.items() if isinstance(x, int | float) and type(x) is not bool}
        numbers = [name for name in values if name in scalars - indices]
        self.scalars, self.matrices = [*map(parsed, (*numbers, *FACTORS))], [*map(parsed, square)]
        self.sums = {getattr(x.target, "id", "") for x in nodes if isinstance(x, ast.AugAssign)} - {""}
        self.unused = unused(tree)
        places = all_places(tree)
        self.around = [*dict.fromkeys(text for _, _, node in places for text in habits(node, self.kinds))]
        self.texts = {y for x in values.values() if isinstance(x, list | tuple) for y in x if isinstance(y, str)}
        own = {x.id for x in nodes if isinstance(x, ast.Name) and isinstance(x.ctx, ast.Store)}
        own |= {x.arg for x in nodes if isinstance(x, ast.arg)} | {x.name for x in nodes if hasattr(x, "name")}
        self.known = {*names, *own, *dir(builtins)}

    def _is_square(self, name: str) -> bool:
        """Whether a name is a square matrix."""
        kind = self.kinds.get(name)
        return isinstance(kind, tuple) and kind[0] == "array" and len(kind[1]) == 2 and len({*kind[1]}) == 1

    def alternatives(self, node: Any, parents: list[Any]) -> Iterator[Change]:
        """Yield what could stand in place of a node."""
        name = getattr(node, "id", "")
        yield from self._of_matrices(node, name, parents[-1])
        yield from alternatives(node, parents[-1], self._alike(name, parents[-1]), self.matrices, self.scalars)
        yield from (("name", parsed(text)) for text in self._other_names(node, parents))
        yield from (("instead", ast.Constant(text)) for text in self._other_texts(node))
        yield from _outer(node)
        begins = isinstance(parents[-1], ast.Assign) and getattr(parents[-1].targets[0], "id", "") in self.sums
        if begins and not isinstance(node, ast.Constant):
            yield "instead", parsed("np.zeros_like(_)", node)  # from which a sum begins

    def _alike(self, name: str, parent: Any) -> list[str]:
        """Return the names of the same kind of thing, and the halves of a vector."""
        kind = self.kinds.get(name)
        names = [other for other, found in self.kinds.items() if kind and found == kind and other not in (name, "_")]
        if kind is int and "parent" in self.kinds and isinstance(parent, ast.Subscript):
            names.append(f"parent[{name}]")
        if kind == ("array", (6,)) and not isinstance(parent, ast.Subscript):
            names += [f"{name}[:3]", f"{name}[3:]"]
        if (
            isinstance(kind, tuple)
            and kind[0] == "array"
            and len(kind[1]) == 2
            and not isinstance(parent, ast.Attribute)
        ):
            names.append(f"{name}.ravel()")
        return names

    def _of_matrices(self, node: Any, name: str, parent: Any) -> Iterator[Change]:
        """Yield a column of a square matrix in place of a row, and the unit matrix in place of an argument."""
        row = isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Load)
        if row and isinstance(node.slice, ast.Name | ast.Constant) and self._is_square(getattr(node.value, "id", "")):
            column = ast.Tuple([ast.Slice(), node.slice], ast.Load())
            yield "transposed", ast.Subscript(node.value, column, node.ctx)
        if isinstance(parent, ast.Call) and self._is_square(name):
            yield "instead", parsed(f"np.eye(len({name}))")

    def _other_texts(self, node: Any) -> list[str]:
        """Return texts among the arguments that are nearly a text in the function."""
        if not isinstance(node, ast.Constant) or not isinstance(node.value, str) or node.value in self.texts:
            return []
        return difflib.get_close_matches(node.value, sorted(self.texts), n=1)

    def _other_names(self, node: Any, parents: list[Any]) -> Iterator[str]:
        """Yield what else a name may stand for: an index for a number, the parent for the body before, x·x for y·y."""
        if isinstance(node, ast.Constant) and type(node.value) is int and isinstance(parents[-1], ast.Subscript):
            yield from (name for name, kind in self.kinds.items() if kind is int)
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            yield from in_modules(node.id) if node.id not in self.known else ()
            bare = isinstance(self.kinds.get(node.id), tuple) and not isinstance(
                parents[-1], ast.Subscript | ast.Attribute
            )
            yield from (text.format(node.id) for text in self.around if bare and node.id not in text)
        if isinstance(node, ast.Subscript) and isinstance(parents[-1], ast.Subscript):
            of = getattr(node.value, "id", "") or getattr(node.value, "attr", "")
            yield from [text_of(node.slice)] * (of == "parent")
        if may_be_argument(node):
            yield from self.unused
        if not isinstance(node, ast.BinOp):
            return
        left, right = node.left, node.right
        if "parent" in self.kinds and isinstance(node.op, ast.Sub) and getattr(right, "value", 0) == 1:
            yield f"parent[{text_of(left)}]"
        if isinstance(node.op, ast.Mult) and getattr(left, "id", 0) == getattr(right, "id", 1):
            alike = [name for name, kind in self.kinds.items() if kind == self.kinds.get(text_of(left))]
            yield from (f"{name} * {name}" for name in alike)


def _outer(node: Any) -> Iterator[Change]:
    """Yield the outer product of a vector with itself in place of c * c or c @ c.T, where these are not."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult | ast.MatMult):
        left, right = (ast.unparse(x).removesuffix(".T") for x in (node.left, node.right))
        if left == right and isinstance(node.left, ast.Name | ast.Subscript | ast.Attribute):
            yield "instead", parsed(f"np.outer({left}, {left})")


def _kind(value: Any) -> Any:
    """Return what two values must have in common to be taken for each other."""
    if isinstance(value, np.ndarray):
        return "array", value.shape
    if isinstance(value, list | tuple) and value:
        return type(value), len(value), type(value[-1])
    return type(value)
