"""A quantity that can be compiled: what it depends on, and how it is computed; by the textbook, for some states."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from straightline.double_double import DoubleDouble

from ..arrays import Array
from ..errors import SingularError
from ..model import Model, check_entries, check_model, with_number

__all__ = [
    "ARGUMENTS",
    "STATE",
    "Compute",
    "Quantity",
    "by_the_textbook",
    "checked",
    "computed",
    "shapes",
    "shapes_by_the_textbook",
]

STATE = ("q", "v", "a", "tau", "f_ext")  # the arguments of what is computed of a state
ARGUMENTS = ("q0", "q1", "u", *STATE, "v_dt")  # those of a program, in this order: of steps, too
CHUNK = 2**17  # states times degrees of freedom that the textbook takes at a time


Compute = Callable[..., tuple[Array, list[Any]]]


class Quantity(NamedTuple):
    """Something that a program can compute: the chapter's symbol, what it depends on, of `ARGUMENTS`, and how.

    `compute` returns an array, by the textbook's function, and what is to be watched besides: see `watch`.
    `derivative` returns what does so for the derivative by an argument, where there is a better way than by the line.
    `unique` raises SingularError in states where the textbook chooses one of many values, as no line does.
    """

    symbol: str
    arguments: tuple[str, ...]
    compute: Compute
    derivative: Callable[[str], Compute] | None = None
    unique: Callable[..., None] | None = None


def shapes(model: Model) -> dict[str, tuple[int, ...]]:
    """Return the shape of each argument of one state."""
    others = {"f_ext": (model.nbodies, 6), "u": ()}
    return {name: others.get(name, (model.nq if name[0] == "q" else model.nv,)) for name in ARGUMENTS}


def by_the_textbook(
    model: Model, quantities: Sequence[Quantity], states: Mapping[str, Any], filled: Mapping[str, Array], where: Array
) -> None:
    """Fill the results, by symbol, in the states of a batch where `where` is true, or raise for the first wrong one.

    An argument has the batch axes, or none where it is the same in every state.
    """
    places, size = np.argwhere(where), max(1, CHUNK // max(1, model.nv))
    alike = {name: np.ndim(x) == len(shapes(model)[name]) for name, x in states.items()}
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
    return computed(quantities, checked(model, states))


def shapes_by_the_textbook(
    quantities: Sequence[Quantity], states: Mapping[str, Array], shapes: Mapping[str, tuple[int, ...]]
) -> dict[str, tuple[int, ...]]:
    """Return the shape of each result of one state, by symbol: what the textbook makes of no states."""
    none = {name: np.empty((0, *shapes[name]), x.dtype) for name, x in states.items()}
    try:
        return {symbol: x.shape[1:] for symbol, x in computed(quantities, none).items()}
    except SingularError:  # it is so wherever it stands: of no states, only the tips of massless limbs are named
        computed(quantities, states)
        raise


def checked(model: Model, states: Mapping[str, Any]) -> dict[str, Array]:
    """Return the arguments, of which q may be missing, as checked arrays of one number type and batch shape."""
    for name, x in states.items():
        if isinstance(x, DoubleDouble):  # which NumPy takes for two states
            hint = 'a program of dtype="double-double" takes it'
            raise TypeError(f"{name}: expected an array, got a DoubleDouble; {hint}")
    check_model(model)
    named = {name: x for name, x in states.items() if name != "u"}
    first = {} if any(name.startswith("q") for name in named) else {"q": model.neutral()}
    found = dict(zip([*first, *named], check_entries(model, **first, **named)))
    if "u" in states:
        found = dict(zip([*found, "u"], with_number(model, found, states["u"], "u")))
    return {name: found[name] for name in states}


def computed(quantities: Sequence[Quantity], states: Mapping[str, Array]) -> dict[str, Array]:
    """Return the quantities in checked states, by symbol."""
    return {
        quantity.symbol: quantity.compute(*(states[name] for name in quantity.arguments if name in states))[0]
        for quantity in quantities
    }
