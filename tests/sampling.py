"""Of a long list of cases, those that every run has; the others are slow tests."""

from collections.abc import Iterable
from typing import Any

import pytest

__all__ = ["sampled"]


def sampled(values: Iterable[Any], keep: int, *, several: bool = False) -> list[Any]:
    """Return the values as parameters of which `keep`, evenly spread from the first to the last, are not slow.

    `several`: each value is a tuple with an entry for each of several arguments.
    """
    values = list(values)
    kept = {round(k * (len(values) - 1) / max(keep - 1, 1)) for k in range(keep)}
    return [value if k in kept else _slow(value, several) for k, value in enumerate(values)]


def _slow(value: Any, several: bool) -> Any:
    """Return a value, which may be a parameter with marks of its own, as a slow one."""
    old = value if isinstance(value, type(pytest.param())) else pytest.param(*(value if several else (value,)))
    return pytest.param(*old.values, id=old.id, marks=[*old.marks, pytest.mark.slow])
