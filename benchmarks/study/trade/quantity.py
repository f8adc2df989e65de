"""A quantity, and the ways of computing it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from twistwrench.arrays import Array

from .numbers import FLOATS

__all__ = ["Arrays", "Inputs", "Quantity", "Way", "repeated"]

Arrays = tuple[Array, ...]
Inputs = Callable[[str, int | slice], Arrays]
"""From a number type and the indices of states to the arguments of a way."""


def repeated(x: Array, where: int | slice) -> Array:
    """Return one entry, or the first ones, repeated where there are fewer than wanted.

    Examples
    --------
    >>> repeated(np.array([1, 2, 3]), slice(0, 5))
    array([1, 2, 3, 1, 2])
    """
    if isinstance(where, int):
        return np.asarray(x[where])
    return np.asarray(x[np.arange(where.stop) % len(x)])


@dataclass(frozen=True)
class Way:
    """One way of computing a quantity.

    Attributes
    ----------
    name : str
        As the user would write it.
    compute : callable
        Of the arrays that `before` returns. This is what is timed.
    numbers : tuple of str
        The number types that it can compute in.
    batches : bool
        Whether it takes many states in one call.
    before : callable
        Of the inputs: their preparation, such as reordering for Pinocchio, which is not timed.
    after : callable
        Of what `compute` returned: the value, in the order of this package.
    """

    name: str
    compute: Callable[..., Any]
    numbers: tuple[str, ...] = FLOATS
    batches: bool = True
    before: Callable[..., tuple[Any, ...]] = lambda *inputs: inputs
    after: Callable[[Any], Array] = lambda value: value


@dataclass(frozen=True)
class Quantity:
    """A quantity with all ways of computing it.

    Attributes
    ----------
    key : str
        Short, for the command line and the JSON.
    name : str
    inputs : callable
        See `Inputs`.
    truth : callable
        Of the index of a state: the value in 60 digits.
    ways : sequence of Way
    batch : int
        Number of states in a batch.
    """

    key: str
    name: str
    inputs: Inputs
    truth: Callable[[int], Array]
    ways: Sequence[Way]
    batch: int
