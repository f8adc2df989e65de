"""Of a long list of cases, those that every run has, and how many of the others a run of the slow tests draws."""

import os
import random
from collections.abc import Iterable, Sequence
from typing import Any

import pytest

__all__ = ["DRAWN_BY", "SLOW_CASES", "drawn", "sampled"]

DRAWN_BY = "TWISTWRENCH_DRAW"
"""The variable that draws what is not tried in each run; `all` leaves nothing out. tests/conftest.py draws."""

SLOW_CASES = 1
"""Of each test in the slow run, at most, where nothing else is asked for; those are drawn."""


def drawn(values: Sequence[Any], count: int) -> list[Any]:
    """Return so many of the values, others in each run; all of them where `DRAWN_BY` says so."""
    seed = os.environ[DRAWN_BY]
    return [*values] if seed == "all" else random.Random(seed).sample(values, count)


def sampled(values: Iterable[Any], keep: int, *, several: bool = False, draw: int = SLOW_CASES) -> list[Any]:
    """Return the values as parameters of which `keep`, evenly spread from the first to the last, are not slow.

    `several`: each value is a tuple with an entry for each of several arguments.
    `draw`: so many of the slow ones, others in each run.
    """
    values = list(values)
    kept = {round(k * (len(values) - 1) / max(keep - 1, 1)) for k in range(keep)}
    return [value if k in kept else _slow(value, several, draw) for k, value in enumerate(values)]


def _slow(value: Any, several: bool, draw: int) -> Any:
    """Return a value, which may be a parameter with marks of its own, as a slow one."""
    old = value if isinstance(value, type(pytest.param())) else pytest.param(*(value if several else (value,)))
    return pytest.param(*old.values, id=old.id, marks=[*old.marks, pytest.mark.slow(draw=draw)])
