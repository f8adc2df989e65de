"""Whether a function takes the gravity of the earth, whatever the gravity of its robot is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from ...model import Model
from ..calls import tried
from ..cases import cases, special_cases
from ..compare import agree, close, values
from ..exercise import Part

__all__ = ["earthbound", "earthly_results", "on_earth"]

EARTH = np.array([0, 0, -9.81])
"""Gravity that a student writes down, in m/s²."""


def on_earth(arguments: tuple[Any, ...]) -> tuple[Any, ...] | None:
    """Return the same arguments with robots on the earth; None where they are there."""
    found = tuple(replace(x, gravity=EARTH) if _is_elsewhere(x) else x for x in arguments)
    return found if any(map(_is_elsewhere, arguments)) else None


def earthbound(part: Part, function: Callable[..., Any], made: Callable[..., Any]) -> bool:
    """Whether on other planets a function gives what `made`, a solution or a slip, gives on the earth alone.

    Of several things that are returned, one at least.
    """
    pairs = [(c, here) for c in (*cases(part, 0), *special_cases(part, 0)) if (here := on_earth(c)) is not None]
    for away, here in pairs:
        answer, there, expected = tried(part, function, away), tried(part, made, away), tried(part, made, here)
        if agree(part, answer, there, away):
            return False
        split = [values(x, part.returns) or [] for x in (answer, there, expected)]
        near = [close(x, y, part.rtol) or close(x, z, part.rtol) for x, y, z in zip(*split)]
        if len(near) < len(part.returns) or not all(near):
            return False
    return bool(pairs)


def earthly_results(part: Part, function: Callable[..., Any]) -> list[int]:
    """Return which of several things that a function returns are right on the earth and the same elsewhere."""
    found: list[set[int]] = []
    for away in special_cases(part, 0) if len(part.returns) > 1 else ():
        if (here := on_earth(away)) is not None:
            answers = tried(part, function, away), tried(part, part.solution, away), tried(part, part.solution, here)
            split = zip(*(values(x, part.returns) or [] for x in answers))
            same = [(close(x, y, part.rtol), close(x, z, part.rtol)) for x, y, z in split]
            found.append({k for k, (there, expected) in enumerate(same) if expected and not there})
    return sorted(set.intersection(*found)) if found else []


def _is_elsewhere(x: Any) -> bool:
    """Whether an argument is a robot on another planet, and not without gravity."""
    return isinstance(x, Model) and bool(x.gravity.any()) and not np.array_equal(x.gravity, EARTH)
