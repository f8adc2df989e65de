"""Whether proved bounds hold: programs with ``bound=True`` in the cells of the grid, against the truth in 80 digits."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench import newton_euler_3d as ne
from twistwrench.arrays import Array

from ..numbers import HARDWARE
from ..quantities import QUANTITIES
from ..record import table
from .robots import Recipe

DIGITS = 80
NOISE = 1e-37
"""Of the truth, relative to its largest entry: an oblique axis of a program is a unit vector to 38 digits."""

KEYS = {"tau": "ID", "M": "M", "A_G": "A_G", "qdd": "FD"}
"""Of the results of programs, in `QUANTITIES`."""


class Measured(NamedTuple):
    """The entries of a quantity in a cell: how far each is off, and its bound; None where an error was raised."""

    quantity: str
    number: str
    cell: str
    off: Array | None = None
    bound: Array | None = None
    noise: float = 0.0


def measured(recipe: Recipe) -> Iterator[Measured]:
    """Yield what the programs of a cell return, in both number types.

    The truth is that of the arguments as the program gets them, rounded to its numbers.
    """
    cell = str(recipe)
    try:
        model, s = recipe.model, recipe.state
    except tw.ModelError:
        yield from (Measured(quantity, number, cell) for quantity in KEYS for number in HARDWARE)
        return
    tau = ne.inverse_dynamics(model, *(ne.as_mpmath(x) for x in s)).astype(np.float64)
    for wanted in (("tau", "M", "A_G"), ("qdd",)):
        shared: dict[Any, Any] = {}
        for number in HARDWARE:
            program: Any = tw.compile(model, wanted, dtype=number, bound=True, backend="numpy")
            program._codes = shared  # the same line: rewritten once
            with np.errstate(over="ignore"):
                given = {name: x.astype(number) for name, x in {**s._asdict(), "tau": tau}.items()}
            try:
                found = program(**{name: x for name, x in given.items() if name in program.arguments})
            except ValueError:
                yield from (Measured(quantity, number, cell) for quantity in wanted)
                continue
            for quantity in wanted:
                value, bound = (getattr(x, quantity) for x in found)
                off, noise = _off(model, quantity, given, value)
                yield Measured(quantity, number, cell, off, bound.astype(np.float64), noise)


def _off(model: Any, quantity: str, given: dict[str, Array], value: Array) -> tuple[Array, float]:
    """Return how far the entries of a quantity are off, infinitely where there is no right value; and the noise."""
    import mpmath

    known = QUANTITIES[KEYS[quantity]]
    with mpmath.workdps(DIGITS):
        try:
            right = known.truth(model, *(ne.as_mpmath(x) for x in known.arguments(**given)))
        except tw.SingularError:
            return np.full(value.shape, np.inf), 0.0
        return abs(ne.as_mpmath(value) - right).astype(np.float64), NOISE * float(abs(right).max())


def counts(every: Iterable[Measured]) -> list[dict[str, Any]]:
    """Count over all cells, by quantity and number type.

    `raised` are cells where an error was raised; `held` the entries whose bound is not below the error, `infinite`
    those for which nothing is certain; `median` and `worst` of bound over error, where the error is not 0 and the bound
    is finite; `broken` the cells with an entry whose bound is below the error.
    """
    by: dict[tuple[str, str], list[Measured]] = {}
    for one in every:
        by.setdefault((one.quantity, one.number), []).append(one)
    return [{"quantity": quantity, "number": number, **_count(found)} for (quantity, number), found in by.items()]


def _count(found: Sequence[Measured]) -> dict[str, Any]:
    known = [one for one in found if one.off is not None]
    kept = [one.off <= one.bound + one.noise for one in known]
    finite = [one.bound < np.inf for one in known]
    ratios = [
        (one.bound / np.where(one.off > 0, one.off, 1))[sure & (one.off > one.noise)]
        for one, sure in zip(known, finite, strict=True)
    ]
    ratio = np.concatenate([np.zeros(0), *ratios])
    return {
        "cells": len(found),
        "raised": len(found) - len(known),
        "entries": sum(x.size for x in kept),
        "held": sum(int(x.sum()) for x in kept),
        "infinite": sum(int((~x).sum()) for x in finite),
        "median": float(np.median(ratio)) if ratio.size else 0.0,
        "worst": float(ratio.max(initial=0.0)),
        "broken": [one.cell for one, x in zip(known, kept, strict=True) if not x.all()],
    }


def shown(found: Sequence[dict[str, Any]]) -> str:
    """Return the table of `counts`."""
    names = "quantity", "number", "cells", "raised", "entries", "held", "infinite"
    head = dict.fromkeys(names) | {"median": "bound / error, median", "worst": "largest"}
    broken = [f"  {b['quantity']} does not hold: {cell}" for b in found for cell in b["broken"]]
    return "\n".join([table(found, head, median=".3f", worst=".1e"), *broken])
