"""A quantity that can be compiled: what it depends on, and how it is computed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..arrays import Array
from ..model import Model

__all__ = ["ARGUMENTS", "Quantity", "of_each", "shapes"]

ARGUMENTS = ("q", "v", "a", "tau", "f_ext")
"""The arguments of a program, in this order."""


class Quantity(NamedTuple):
    """Something that a program can compute.

    Attributes
    ----------
    symbol : str
        The chapter's, and the name of the result where several are asked for.
    arguments : tuple of str
        What it depends on, of `ARGUMENTS`; f_ext may be left out.
    compute : callable
        From these arguments to an array, by the textbook's function; and to what is to be watched besides: see `watch`.
    """

    symbol: str
    arguments: tuple[str, ...]
    compute: Callable[..., tuple[Array, list[Any]]]


def shapes(model: Model) -> dict[str, tuple[int, ...]]:
    """Return the shape of each argument of one state."""
    nv = (model.nv,)
    return {"q": (model.nq,), "v": nv, "a": nv, "tau": nv, "f_ext": (model.nbodies, 6)}


def of_each(frames: Sequence[str], one: Callable[..., Array], tail: tuple[int, ...], model: Model, *x: Array) -> Array:
    """Return a quantity of each frame, along an axis before its own, which have the shape `tail`."""
    each = [one(model, *x, name) for name in frames]
    return np.stack(each, axis=-1 - len(tail)) if each else np.zeros((0, *tail))
