"""By how much numbers are wrong: to how many digits they are right, whether they are too large, how many are near."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...arrays import Array
from ..compare import FLOOR, ROUNDING
from ..words.phrases import say
from ..words.text import Text

__all__ = ["by_how_much", "digits", "same", "too_large"]

NEARLY = 6e-3
"""Part of a number by which one is off that is right to two digits."""

NEAR = 0.1
"""Part of a number by which one is off that is near it."""

TINY = 1e-3
"""Part of the largest number below which one is compared with this part, not with its own size."""


def same(a: Array, b: Array, tolerance: float) -> bool:
    """Whether two arrays are the same but for a tolerance."""
    return bool((np.abs(a - b) <= tolerance).all())


def by_how_much(a: Array, b: Array, wrong: Array, tolerance: float) -> Text:
    """Return how many of the numbers are wrong, or how near they are; whether a single number is too large."""
    if b.size == 1:
        near = _within(a, b, NEAR) and (a * b > 0).all()
        return say("here, nearly" if near else "here", relation=too_large([(a, b)]) or say("different"))
    if _within(a, b, NEAR):
        return say("near the largest")
    shown = wrong | (np.abs(b) > tolerance)
    if (shown & ~wrong).any():
        return say("some", wrong=int(wrong.sum()), all=b.size)
    return say("different")


def _within(a: Array, b: Array, part: float) -> bool:
    """Whether all entries are off by less than a part of the largest."""
    return bool((np.abs(a - b) <= part * np.abs(b).max(initial=FLOOR)).all())


def digits(a: Array, b: Array) -> int:
    """Return to how many digits each entry is right, or all are rounded; 0 where it is less than two."""
    largest = float(np.abs(b).max(initial=FLOOR))
    if ((a == 0) & (np.abs(b) > ROUNDING * largest)).any():
        return 0  # what is left out has no digits
    rounded = any(same(a, np.round(b, digits), 1e-9 * largest) for digits in range(1, 8))
    size = largest if rounded else np.maximum(np.abs(b), TINY * largest)
    error = float((np.abs(a - b) / size).max(initial=0))
    return int(-np.log10(error)) if 0 < error < NEARLY else 0


def too_large(wrong: Sequence[tuple[Array, Array]]) -> Text | None:
    """Return in what all of some single numbers are wrong, beside the right ones: the sign, or the size."""
    holds = {
        "sign": all(a * b < 0 for a, b in wrong),
        "too large": all(a * b > 0 and np.abs(a) > np.abs(b) for a, b in wrong),
        "too small": all(a * b > 0 and np.abs(a) < np.abs(b) for a, b in wrong),
    }
    return next((say(phrase) for phrase in holds if holds[phrase]), None)
