"""The cases that an answer is tried on: those that are drawn first, and further ones."""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np

from ..errors import ModelError
from . import catalogue
from .exercise import Part

__all__ = ["case", "cases", "further_cases"]

HALF_TURN = np.array([1.0, 2.0, 2.0, 0.0]) / 3
"""A quaternion whose w is zero; that of no turn has a zero vector."""


def cases(part: Part, seed: int) -> list[tuple[Any, ...]]:
    """Return the cases of a function for a seed: the arguments of each."""
    return list(part.cases(_generator(part, seed)))


def further_cases(part: Part, seed: int) -> list[tuple[Any, ...]]:
    """Return the cases after those that are drawn first: without a turn, with half a turn, and a second draw.

    Where an angle is zero or π, a formula may divide by zero; and what a function keeps from one call to the next shows
    when the same sizes come again.
    """
    drawn = cases(part, seed)
    if not drawn[0]:
        return []
    names = part.arguments.split(", ")
    turns = [tuple(_turned(*x, turn) for x in zip(names, drawn[0])) for turn in (np.array([0.0, 0, 0, 1]), HALF_TURN)]
    return [
        *(turn for turn in turns if any(a is not b for a, b in zip(turn, drawn[0]))),
        *part.cases(_generator(part, seed, 1)),
    ]


def _generator(part: Part, *seeds: int) -> np.random.Generator:
    return np.random.default_rng([*seeds, zlib.crc32(part.name.encode())])


def _turned(name: str, value: Any, turn: Any) -> Any:
    """Return an argument with another orientation: a configuration q, a rotation R..., a placement T; others as is."""
    if not isinstance(value, np.ndarray):
        return value
    R = 2 * np.outer(turn, turn)[:3, :3] + (2 * turn[3] ** 2 - 1) * np.eye(3)  # right for these two
    new = value.copy()
    if name == "q" and value.size >= 7 and np.isclose(np.linalg.norm(value[3:7]), 1):
        new[3:7] = turn
    elif name.startswith("R") and value.shape == (3, 3):
        new[:] = R
    elif name == "T" and value.shape[-2:] == (4, 4):
        new[(...,) if value.ndim == 2 else slice(1, None)][..., :3, :3] = R  # entry 0 of several is the world's
    else:
        return value
    return new


def case(name: str, number: int = 0, *, seed: int = 0) -> tuple[Any, ...]:
    """Return the arguments of one of the cases that an answer is tried on.

    Parameters
    ----------
    name : str
        Of the function, as in the skeletons.
    number : int
        Which case, counted from 0.
    seed : int
        Of the random numbers; the message about a wrong answer names it.

    Returns
    -------
    tuple
        The arguments.

    Raises
    ------
    NameNotFound
        If no exercise has a function of that name.
    ModelError
        If there are fewer cases.

    Examples
    --------
    >>> R, p, x = case("act", 3)
    >>> (R @ x + p).shape
    (3,)
    """
    part = catalogue.find_part(name)[1]
    found = [*cases(part, seed), *further_cases(part, seed)]
    if not 0 <= number < len(found):
        raise ModelError(f"number: {name} has the cases 0 to {len(found) - 1}, got {number}")
    return found[number]
