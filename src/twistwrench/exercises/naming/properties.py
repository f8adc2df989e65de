"""What is said of a wrong answer by itself: the property of right ones that it lacks, and whether little is wrong."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..compare import values
from ..exercise import Part
from ..words.text import Text
from .matching import MISHAPS

__all__ = ["FEW", "broken_property", "few_entries"]

NOTICEABLE = 1e-6
"""The least residual of a property that counts, for answers of the size of 1."""

FEW = 3
"""Lines, or wrong entries, that are taken in at a glance."""

Answers = Sequence[Any]
Cases = Sequence[tuple[Any, ...]]


def few_entries(part: Part, answers: Answers, cases: Cases) -> bool:
    """Whether only a few entries are wrong: then two slips of the whole are not the likeliest explanation."""
    for answer, arguments in zip(answers, cases):
        expected = values(part.value(part.solution, arguments), part.returns)
        pairs, wrong = [*zip(values(answer, part.returns) or (), expected or ())], 0
        for a, b in pairs:
            if a.array is None or b.array is None or a.array.shape != b.array.shape:
                return False
            wrong += int((~np.isclose(a.array, b.array)).sum())
        if wrong > FEW or wrong == sum(int(np.size(a.raw)) for a, _ in pairs):
            return False
    return True


def broken_property(part: Part, answers: Answers, cases: Cases) -> Text | None:
    """Return the first property of right answers that one of these lacks, in the first case in which any is lacking."""
    for answer, arguments in zip(answers, cases):
        right = part.value(part.solution, arguments)
        if _shapes(part, answer) != _shapes(part, right):
            return None  # rows and columns would be others
        for item in part.properties:
            try:
                both = [item.residual(x, *arguments) for x in (answer, right)]
                residual, of_right = (np.abs(np.asarray(x, complex)) for x in both)
            except MISHAPS:
                return None
            if np.isfinite(residual).all() and (residual > NOTICEABLE).any() and (of_right <= NOTICEABLE).all():
                return item.text
    return None


def _shapes(part: Part, answer: Any) -> list[Any]:
    """Return the shape of each thing that is returned."""
    return [None if x.array is None else x.array.shape for x in values(answer, part.returns) or []]
