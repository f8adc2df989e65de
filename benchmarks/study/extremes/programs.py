"""Whether programs round worse than the textbook: many states of every cell, against 32 digits.

In one state it is chance which of two equally good algorithms is nearer to the truth. If rounding is magnified in one
direction only, as in q̈ by a weak joint, each error is one number from a bell curve; and of two such numbers one is more
than twice the other in 30 % of the cases, each way. So a cell is judged by the medians over its states.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench.arrays import Array
from twistwrench.newton_euler_3d.bodies import bodies_in_world
from twistwrench.newton_euler_3d.state import take

from ..record import table
from .robots import Recipe
from .truth import size_of_accelerations, sizes


class Compared(NamedTuple):
    """The errors of the textbook and of the program in the states of a cell, and where both returned the same bits."""

    quantity: str
    cell: str
    textbook: Array
    program: Array
    same: Array


def compared(recipe: Recipe, count: int) -> Iterator[Compared]:
    """Yield the errors of every algorithm in this many states of a cell; nothing where a robot or a state is rejected.

    They are measured against the sizes of `truth`.
    """
    try:
        model, drawn = recipe.model, [recipe.drawn(seed) for seed in range(count)]
        q, v, a = (np.stack(x) for x in zip(*drawn, strict=True))
        of_each = [sizes(model, bodies_in_world(take(model, q=x.q, v=x.v, a=x.a)), x) for x in drawn]
        terms, own, momentum = (np.stack(x) for x in zip(*of_each, strict=True))
        names = "rnea", "crba", "centroidal_map", "aba"
        exact: Any = {name: tw.compile(model, name, dtype="double-double") for name in names}
        tau, root = exact["rnea"](q, v, a), np.sqrt(own)

        def errors(quantity: str, name: str, args: Sequence[Array], right: Any, size: Array) -> Compared:
            found = [getattr(by, name)(model, *args) for by in (tw, tw.fast)]
            same = (found[0] == found[1]).reshape(count, -1).all(axis=1)
            return Compared(quantity, str(recipe), *(_error(x, right, size) for x in found), same)

        yield errors("rnea", "rnea", (q, v, a), tau, terms)
        yield errors("crba", "crba", (q,), exact["crba"](q), root[..., None] * root[..., None, :])
        yield errors("centroidal map", "centroidal_map", (q,), exact["centroidal_map"](q), momentum)
        falling = exact["aba"](q, v, 0 * v).hi
        drives = np.random.default_rng(1).standard_normal(v.shape)
        for name, torques in (("steered", tau.hi), ("pushed", drives * terms)):
            right = exact["aba"](q, v, torques)
            yield errors(f"aba, {name}", "aba", (q, v, torques), right, size_of_accelerations(right.hi, falling, root))
    except ValueError:  # ModelError is one
        return


def _error(x: Array, right: Any, size: Array) -> Array:
    """Return the largest relative error in each state."""
    off: Array = abs((x - right.hi) - right.lo)
    relative = np.where(size == 0, 0.0, off / np.where(size == 0, 1, size))
    return np.asarray(relative.reshape(len(x), -1).max(axis=1))


def counts(every: Iterable[Compared]) -> list[dict[str, Any]]:
    """Count over all cells, by quantity; states in which both ways returned the same bits are left out.

    `above` and `below` are the shares of states in which the program's error is more than twice the textbook's, and of
    the reverse; `median` and `high` of the ratio of the two: the median, and what 99 % are below; `cell_median` and
    `cell_worst` of the ratio of the medians of a cell; `missed` the cells in which that is more than 2.
    """
    by: dict[str, list[Compared]] = {}
    for one in every:
        by.setdefault(one.quantity, []).append(one)
    return [{"quantity": quantity, **_count(found)} for quantity, found in by.items()]


def _count(found: list[Compared]) -> dict[str, Any]:
    different = [one for one in found if not one.same.all()]
    ratio = np.concatenate([_ratio(one.program, one.textbook)[~one.same] for one in different])
    of_cells = [_ratio(*(np.median(x[~one.same]) for x in (one.program, one.textbook))) for one in different]
    return {
        "cells": len(found),
        "states": len(ratio),
        "same": sum(int(one.same.sum()) for one in found),
        "above": float((ratio > 2).mean()),
        "below": float((ratio < 0.5).mean()),
        "median": float(np.median(ratio)),
        "high": float(np.quantile(ratio, 0.99)),
        "cell_median": float(np.median(of_cells)),
        "cell_worst": float(np.max(of_cells)),
        "missed": [one.cell for one, x in zip(different, of_cells, strict=True) if x > 2],
    }


def _ratio(a: Any, b: Any) -> Any:
    """Return a / b, 1 where both are 0."""
    tiny = np.finfo(np.float64).tiny
    return (a + tiny) / (b + tiny)


def medians(every: Iterable[Compared]) -> dict[str, dict[str, list[float]]]:
    """Return by cell and quantity the medians of the errors of the textbook and of the program, to three digits."""
    found: dict[str, dict[str, list[float]]] = {}
    for one in every:
        pair = [float(f"{np.median(x):.3g}") for x in (one.textbook, one.program)]
        found.setdefault(one.cell, {})[one.quantity] = pair
    return found


def shown(found: Sequence[dict[str, Any]]) -> str:
    """Return the table of `counts`."""
    head = dict.fromkeys(("quantity", "cells", "states", "same")) | {
        "above": "> 2",
        "below": "< 1/2",
        "median": "median",
    }
    head |= {"high": "99 %", "cell_median": "of cells", "cell_worst": "worst"}
    formats = {
        "above": ".3f",
        "below": ".3f",
        "median": ".2f",
        "high": ".1f",
        "cell_median": ".2f",
        "cell_worst": ".2f",
    }
    missed = [f"  {c['quantity']} more than twice: {cell}" for c in found for cell in c["missed"]]
    return "\n".join([table(found, head, **formats), *missed])
