"""What is said of a wrong answer by itself: the property of right ones that it lacks, and whether little is wrong."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..compare import agree, values
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text
from .matching import MISHAPS

__all__ = ["FEW", "broken_property", "few_entries"]

NOTICEABLE = 1e-6
"""The least residual of a property that counts, for answers of the size of 1."""

PLAIN = 1e-2
"""The same in a case that is not shown, where it must not be a matter of digits: of numbers below `LARGE`."""

LARGE = 1e3

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
    """Report the first property of right answers that a wrong one lacks: in the case that is shown, or in another."""
    pairs = [(x, part.value(part.solution, c), c) for x, c in zip(answers, cases)]
    wrong = [(x, right, c) for x, right, c in pairs if not agree(part, x, right, c)]
    for k, (answer, right, arguments) in enumerate(wrong):
        if _shapes(part, answer) != _shapes(part, right):
            return None  # rows and columns would be others
        least = NOTICEABLE if k == 0 else PLAIN if _largest(part, right) < LARGE else np.inf
        for item in part.properties:
            try:
                both = [item.residual(x, *arguments) for x in (answer, right)]
                residual, of_right = (np.abs(np.asarray(x, complex)) for x in both)
            except MISHAPS:
                return None
            if np.isfinite(residual).all() and (residual > least).any() and (of_right <= NOTICEABLE).all():
                return say("broken elsewhere" if k else "broken", text=item.text)
    return None


def _shapes(part: Part, answer: Any) -> list[Any]:
    """Return the shape of each thing that is returned."""
    return [None if x.array is None else x.array.shape for x in values(answer, part.returns) or []]


def _largest(part: Part, answer: Any) -> float:
    return max(float(np.abs(x.array).max(initial=0)) for x in values(answer, part.returns) or [] if x.array is not None)
