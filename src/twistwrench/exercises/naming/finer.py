"""Whether an answer is an approximation: a difference quotient, or a sum over steps, that is better with finer ones."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from ..calls import tried
from ..changes.repairs import source_of
from ..compare import values
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text

__all__ = ["better_with_finer_steps"]

FINER = 10
"""By so much a step becomes finer, twice."""

SMALL, MANY = 0.1, 50
"""A step is smaller than this; of steps there are more."""

BETTER = 3
"""By so much the error must become smaller, each time."""


def better_with_finer_steps(part: Part, function: Callable[..., Any], arguments: tuple[Any, ...]) -> list[Text]:
    """Report which number in a function is a step, or how many there are: each finer one makes the error smaller."""
    source, right = source_of(part, function, arguments), part.value(part.solution, arguments)
    start = _error(part, tried(part, function, arguments), right)
    if source is None or not start:
        return []
    for parents, field, node in source.places:
        if isinstance(node, ast.Constant) and _is_step(node.value):
            places = [(parents, field, node, ast.Constant(other)) for other in _finer(node.value)]
            finer = (edit.function for place in places for edit in source.made("number", ("", ""), [place]))
            errors = [start, *(_error(part, tried(part, f, arguments), right) for f in finer)]
            if len(errors) == 3 and all(0 < BETTER * b < a for a, b in pairwise(errors)):
                used = next(_finer(node.value))
                return [say("finer", line=node.lineno, given=node.value, finer=used, factor=start / errors[1])]
    return []


def _is_step(value: Any) -> bool:
    return (type(value) is float and 0 < value < SMALL) or (type(value) is int and value > MANY)


def _finer(value: Any) -> Iterator[Any]:
    for power in (1, 2):
        yield value * FINER**power if type(value) is int else float(f"{value / FINER**power:.3g}")


def _error(part: Part, answer: Any, right: Any) -> float:
    """Return the largest error of an answer, 0 where it cannot be compared."""
    pairs = zip(values(answer, part.returns) or [], values(right, part.returns) or [])
    largest = 0.0
    for a, b in pairs:
        if a.array is None or b.array is None or a.array.shape != b.array.shape or b.array.dtype.kind != "f":
            return 0
        with np.errstate(invalid="ignore"):
            largest = max(largest, float(np.abs(a.array - b.array).max(initial=0)))
    return largest if np.isfinite(largest) else 0
