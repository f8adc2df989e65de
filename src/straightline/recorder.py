"""From a function to its straight line: it is called once, with numbers that remember."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .fingerprints import each_once
from .line import Line
from .number import Tape, numbers, without_garbage

__all__ = ["straight_line"]


@without_garbage()
def straight_line(function: Callable[..., Any], /, **shapes: tuple[int, ...]) -> Line:
    """Return the line of a function of arrays of these shapes.

    Constants in it are fractions or integers, which are exact; a float would be rounded before anybody could see it.

    Parameters
    ----------
    function : callable
        Called by name, with arrays of `Number`. It returns an array, or a tuple of arrays.
    **shapes : tuple of int
        Of each argument; () for a number.

    Returns
    -------
    Line
        Its results are called "y", or "y0", "y1" … where there are several.

    Raises
    ------
    TypeError
        If the function asks what a number is, as in ``if x > 0``.

    Examples
    --------
    >>> straight_line(lambda x: x[0] * x[1] + x[1] * x[0], x=(2,)).operations
    Counter({'mul': 2})
    """
    tape = Tape()
    found = function(**{name: numbers(tape, name, *shape) for name, shape in shapes.items()})
    several = isinstance(found, tuple)
    results = {f"y{k}": one for k, one in enumerate(found)} if several else {"y": found}
    arrays = {name: np.asarray(one, object) for name, one in results.items()}
    return each_once(Line.of(tape, shapes, arrays))
