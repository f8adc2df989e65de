"""The textbook's functions for some states of a batch: those that a program does not trust itself with."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..arrays import Array
from ..model import Model, floats_of
from .quantity import Quantity

__all__ = ["by_the_textbook", "computed"]

CHUNK = 2**17
"""States times degrees of freedom that the textbook takes at a time."""


def by_the_textbook(
    model: Model, quantities: Sequence[Quantity], states: Mapping[str, Any], filled: Mapping[str, Array], where: Array
) -> None:
    """Fill the results, by symbol, in the states of a batch where `where` is true, or raise for the first wrong one.

    An argument has the batch axes, or none where it is the same in every state.
    """
    places, size = np.argwhere(where), max(1, CHUNK // max(1, model.nv))
    alike = {name: np.ndim(x) == (2 if name == "f_ext" else 1) for name, x in states.items()}
    try:
        for k in range(0, len(places), size):
            at = tuple(places[k : k + size].mT)
            chosen = {name: x if alike[name] else x[at] for name, x in states.items()}
            for symbol, result in _results(model, quantities, chosen).items():
                filled[symbol][at] = result
        return
    except ValueError as error:
        raised = error
    _results(model, quantities, states)  # raises with the place in the batch
    raise raised


def _results(model: Model, quantities: Sequence[Quantity], states: Mapping[str, Any]) -> dict[str, Array]:
    """Return the quantities, by symbol."""
    checked = dict(zip(("q", *(name for name in states if name != "q")), floats_of(model, **states)))
    return computed(quantities, checked)


def computed(quantities: Sequence[Quantity], states: Mapping[str, Array]) -> dict[str, Array]:
    """Return the quantities in checked states, by symbol."""
    return {
        quantity.symbol: quantity.compute(*(states[name] for name in quantity.arguments if name in states))[0]
        for quantity in quantities
    }
