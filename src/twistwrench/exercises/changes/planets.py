"""Whether a function takes the gravity of the earth, whatever the gravity of its robot is."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from ...model import Model
from ...model.builder import GRAVITY
from ..calls import tried
from ..cases import cases, special_cases
from ..compare import close, values
from ..exercise import Part

__all__ = ["earthbound", "earthly_results", "on_earth"]

EARTH = np.array(GRAVITY)
"""Gravity that a student writes down, in m/s²."""


def on_earth(arguments: tuple[Any, ...]) -> tuple[Any, ...] | None:
    """Return the same arguments with robots on the earth; None where they are there."""
    found = tuple(replace(x, gravity=EARTH) if _is_elsewhere(x) else x for x in arguments)
    return found if any(map(_is_elsewhere, arguments)) else None


def earthbound(part: Part, function: Callable[..., Any], made: Callable[..., Any]) -> bool:
    """Whether on other planets a function gives what `made`, a solution or a slip, gives on the earth alone.

    Of several things that are returned, one at least.
    """
    found = False
    for each in _elsewhere(part, function, made):
        found = len(each) == len(part.returns) and all(map(any, each)) and not all(there for there, _ in each)
        if not found:
            break
    return found


def earthly_results(part: Part, function: Callable[..., Any]) -> list[int]:
    """Return which of several things that a function returns are right on the earth and the same elsewhere."""
    every = [*_elsewhere(part, function, part.solution)] if len(part.returns) > 1 else []
    found = [{k for k, (there, here) in enumerate(each) if here and not there} for each in every]
    return sorted(set[int].intersection(*found)) if found else []


def _elsewhere(part: Part, function: Callable[..., Any], made: Callable[..., Any]) -> Iterator[list[tuple[bool, bool]]]:
    """Yield for each case on another planet, of each thing returned, whether `made` gives it there and on the earth."""
    for away in (*cases(part, 0), *special_cases(part, 0)):
        if (here := on_earth(away)) is not None:
            answers = tried(part, function, away), tried(part, made, away), tried(part, made, here)
            split = zip(*(values(x, part.returns) or [] for x in answers))
            yield [(close(x, y, part.rtol), close(x, z, part.rtol)) for x, y, z in split]


def _is_elsewhere(x: Any) -> bool:
    """Whether an argument is a robot on another planet, and not without gravity."""
    return isinstance(x, Model) and bool(x.gravity.any()) and not np.array_equal(x.gravity, EARTH)
