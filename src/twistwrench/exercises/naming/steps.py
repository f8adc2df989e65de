"""The first quantity of a recursion that is wrong, and at which body: from the record of what an edit computes."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..calls import copied, local_values
from ..changes.crosses import nodes_of
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text

__all__ = ["first_wrong"]

INWARD = ("inward", "reversed", "-1")


def first_wrong(part: Part, function: Any, within: Any, arguments: tuple[Any, ...], source: str = "") -> Text | None:
    """Report which quantity of which body a change within a listing makes wrong first, and which stay right.

    A quantity with the name of an argument is not spoken of: to the student that is the argument. Nor are names that
    the student's source does not have, where it is given; nor the body of an inward pass, which he may begin elsewhere.
    """
    given = {name.partition("=")[0] for name in part.arguments.split(", ")}
    bodies = {name: inward for name, inward in _computed(within).items() if name not in given}
    right, wrong = (
        local_values(lambda *taken, f=f: part.value(f, taken), [within], copied(arguments)).get(within.__name__, {})
        for f in (part.solution, function)
    )
    fine: list[str] = []
    for name in (name for name in bodies if name in right and name in wrong):
        inward = bodies[name]  # then what arrives at the world is of no use to anyone
        entries = {key: x for key, x in _entries(right[name]).items() if key != 0 or not inward}
        bad = [key for key, x in entries.items() if not _same(x, _entries(wrong[name]).get(key))]
        if bad and source and not {name, *fine} <= {*re.findall(r"\w+", source)}:
            return None
        if bad:
            first = min(bad)
            place = name if inward else f"{name}[{', '.join(map(str, first)) if isinstance(first, tuple) else first}]"
            return say("first wrong", right=", ".join(fine), wrong=place) if fine else say("wrong first", wrong=place)
        if _entries(right[name]):
            fine.append(name)
    return None


def _computed(function: Any) -> dict[str, bool]:
    """Return the names of which a loop sets one entry after the other, in order, and whether it goes inward."""
    found: dict[str, bool] = {}
    for loop in nodes_of(inspect.getsource(function)):
        if isinstance(loop, ast.For):
            inward = any(word in ast.unparse(loop.iter) for word in INWARD)
            for node in ast.walk(loop):
                if (
                    isinstance(node, ast.Subscript)
                    and isinstance(node.ctx, ast.Store)
                    and isinstance(node.value, ast.Name)
                ):
                    found[node.value.id] = inward
    return {name: found[name] for name in found if name != "B"}  # the wrench that F begins with


def _entries(value: Any) -> Mapping[Any, Any]:
    """Return the entry of each body."""
    if isinstance(value, dict):
        return value
    if isinstance(value, list) or (isinstance(value, np.ndarray) and value.ndim > 1):
        return {k: x for k, x in enumerate(value) if isinstance(x, np.ndarray)}
    return {}


def _same(first: Any, second: Any) -> bool:
    """Whether two entries are the same, to the digits that a rounding leaves."""
    if second is None or np.shape(first) != np.shape(second):
        return False
    return bool(np.allclose(first, second, rtol=1e-9, atol=1e-9))
