"""Which slip can occur in which exercise."""

from __future__ import annotations

from typing import NamedTuple

from . import catalogue
from .exercise import Exercise, Part

__all__ = ["Cell", "slip_table"]


class Cell(NamedTuple):
    """A slip that can occur in a function of an exercise."""

    exercise: Exercise
    part: Part
    slip: str


def slip_table() -> list[Cell]:
    """Return every slip in every function where it can occur.

    Examples
    --------
    >>> cells = slip_table()
    >>> len({cell.slip for cell in cells if cell.exercise.id == "49.3.2"})
    13
    """
    every = map(catalogue.exercise, catalogue.available())
    return [Cell(exercise, part, slip) for exercise in every for part in exercise.parts for slip in part.slips]
