"""A straight line in plain Python, for a few states: NumPy takes as long for one number as for a thousand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..arrays import Array
from .line import Line
from .source import python_source

__all__ = ["Plain"]


class Plain:
    """A line as a Python function of floats.

    Parameters
    ----------
    line : Line
    """

    def __init__(self, line: Line) -> None:
        names: dict[str, Any] = {}
        exec(python_source(line, "program"), names)  # our own text
        self.function = names["program"]
        self.shapes = [*line.inputs.values()]
        self.results = [shape for shape, _ in line.outputs.values()]

    def run(self, arrays: Sequence[Array]) -> None:
        """Fill the results: each array has shape (states, entries)."""
        given, results = arrays[: len(self.shapes)], arrays[len(self.shapes) :]
        for k in range(len(arrays[0])):
            state = [x[k].reshape(shape).tolist() for x, shape in zip(given, self.shapes)]
            try:
                values = self.function(*state)
            except (OverflowError, ValueError, ZeroDivisionError):  # where NumPy goes on with NaN
                values = [np.nan] * len(results)
            for x, value, shape in zip(results, values, self.results):
                x[k] = np.reshape(value, -1) if len(shape) != 1 else value
