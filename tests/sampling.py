"""Of a long list of cases, those that every run has, and how many of the others a run of the slow tests draws."""

import os
import random
from collections.abc import Iterable
from typing import Any

import pytest

__all__ = ["DRAWN_BY", "sampled"]

DRAWN_BY = "TWISTWRENCH_DRAW"
"""The variable that draws what is not tried in each run; `all` leaves nothing out. tests/conftest.py sets it."""


def sampled(values: Iterable[Any], keep: int, *, several: bool = False, draw: int | None = None) -> list[Any]:
    """Return the values as parameters of which `keep`, evenly spread from the first to the last, are not slow.

    `several`: each value is a tuple with an entry for each of several arguments.
    `draw`: so many of the slow ones, others in each run; None for all.
    """
    values = list(values)
    kept = {round(k * (len(values) - 1) / max(keep - 1, 1)) for k in range(keep)}
    slow = [k for k in range(len(values)) if k not in kept]
    seed = os.environ.get(DRAWN_BY, "0")
    if draw is not None and draw < len(slow) and seed != "all":
        slow = random.Random(seed).sample(slow, draw)
    every = sorted({*kept, *slow})
    return [values[k] if k in kept else _slow(values[k], several) for k in every]


def _slow(value: Any, several: bool) -> Any:
    """Return a value, which may be a parameter with marks of its own, as a slow one."""
    old = value if isinstance(value, type(pytest.param())) else pytest.param(*(value if several else (value,)))
    return pytest.param(*old.values, id=old.id, marks=[*old.marks, pytest.mark.slow])
