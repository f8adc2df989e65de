"""Whether programs round worse than the textbook: many states of every cell, against 32 digits.

In one state it is chance which of two equally good algorithms is nearer to the truth. If rounding is magnified in one
direction only, as in q̈ by a weak joint, each error is one number from a bell curve; and of two such numbers one is more
than twice the other in 30 % of the cases, each way. So a cell is judged by the medians over its states.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench.arrays import Array
from twistwrench.errors import ModelError
from twistwrench.model import Model
from twistwrench.newton_euler_3d.bodies import bodies_in_world
from twistwrench.newton_euler_3d.state import take

from .robots import Recipe, State
from .truth import size_of_accelerations, sizes

__all__ = ["ALGORITHMS", "LONGEST", "Compared", "Count", "compared", "counts", "medians", "table"]

LONGEST = 30
"""Robots with more bodies are left out: 32 digits take a minute to compile for them."""

ALGORITHMS = ("rnea", "crba", "centroidal map", "aba, steered", "aba, pushed")


class Compared(NamedTuple):
    """The errors of the textbook and of the program in the states of a cell, and where both returned the same bits."""

    algorithm: str
    cell: str
    textbook: Array
    program: Array
    same: Array


@dataclass(frozen=True)
class Count:
    """One algorithm over all cells; states in which both ways returned the same bits are left out, but counted.

    Attributes
    ----------
    algorithm : str
    cells, states, same : int
        Cells; states in which the results differ; those in which they do not.
    above, below : float
        The share of states in which the program's error is more than twice the textbook's, and of the reverse.
    median, high : float
        Of the program's error over the textbook's in a state: the median, and what 99 % are below.
    cell_median, cell_worst : float
        Of the ratio of the medians of a cell.
    missed : list of str
        The cells in which the program's median is more than twice the textbook's.
    """

    algorithm: str
    cells: int
    states: int
    same: int
    above: float
    below: float
    median: float
    high: float
    cell_median: float
    cell_worst: float
    missed: list[str]


def compared(recipe: Recipe, count: int) -> Iterator[Compared]:
    """Yield the errors of every algorithm in this many states of a cell; nothing where a robot or a state is rejected.

    They are measured against the sizes of `truth`.
    """
    try:
        model, drawn = recipe.model, [recipe.drawn(seed) for seed in range(count)]
        s = State(*(np.stack(x) for x in zip(*drawn, strict=True)))
        yield from _compared(_words(recipe), model, drawn, s)
    except (ModelError, ValueError):
        return


def _compared(cell: str, model: Model, drawn: list[State], s: State) -> Iterator[Compared]:
    of_each = [sizes(model, bodies_in_world(take(model, q=x.q, v=x.v, a=x.a)), x) for x in drawn]
    terms, own, momentum = (np.stack(x) for x in zip(*of_each, strict=True))

    def errors(algorithm: str, name: str, args: tuple[Array, ...], right: Any, size: Array) -> Compared:
        found = [getattr(by, name)(model, *args) for by in (tw, tw.fast)]
        textbook, program = (_error(x, right, size) for x in found)
        return Compared(algorithm, cell, textbook, program, (found[0] == found[1]).reshape(len(drawn), -1).all(axis=1))

    tau = _exact(model, "rnea")(*s)
    yield errors("rnea", "rnea", s, tau, terms)
    root = np.sqrt(own)
    yield errors("crba", "crba", (s.q,), _exact(model, "crba")(s.q), root[..., None] * root[..., None, :])
    yield errors("centroidal map", "centroidal_map", (s.q,), _exact(model, "centroidal_map")(s.q), momentum)
    aba = _exact(model, "aba")
    falling = aba(s.q, s.v, 0 * s.v).hi
    drives = np.random.default_rng(1).standard_normal(s.v.shape)
    for name, torques in (("steered", tau.hi), ("pushed", drives * terms)):
        right = aba(s.q, s.v, torques)
        size = size_of_accelerations(right.hi, falling, root)
        yield errors(f"aba, {name}", "aba", (s.q, s.v, torques), right, size)


def _exact(model: Model, want: str) -> Any:
    """Return a program of 32 digits."""
    return tw.compile(model, want, dtype="double-double")


def _error(x: Array, right: Any, size: Array) -> Array:
    """Return the largest relative error in each state."""
    off: Array = abs((x - right.hi) - right.lo)
    nothing = size == 0
    relative = np.where(nothing, 0.0, off / np.where(nothing, 1, size))
    return np.asarray(relative.reshape(len(x), -1).max(axis=1))


def _words(recipe: Recipe) -> str:
    """Return which values are not the usual ones."""
    return ", ".join(f"{name} {x}" for name, x in recipe.changed.items()) or "usual"


def counts(every: Iterable[Compared]) -> list[Count]:
    """Count over all cells."""
    by: dict[str, list[Compared]] = {name: [] for name in ALGORITHMS}
    for one in every:
        by[one.algorithm].append(one)
    return [_count(name, found) for name, found in by.items() if found]


def _count(algorithm: str, found: list[Compared]) -> Count:
    different = [one for one in found if not one.same.all()]
    ratio = np.concatenate([_ratio(one.program, one.textbook)[~one.same] for one in different])
    medians = np.array([_ratio(*(np.median(x[~one.same]) for x in (one.program, one.textbook))) for one in different])
    return Count(
        algorithm,
        len(found),
        len(ratio),
        sum(int(one.same.sum()) for one in found),
        float((ratio > 2).mean()),
        float((ratio < 0.5).mean()),
        float(np.median(ratio)),
        float(np.quantile(ratio, 0.99)),
        float(np.median(medians)),
        float(medians.max()),
        [one.cell for one, x in zip(different, medians, strict=True) if x > 2],
    )


def _ratio(a: Any, b: Any) -> Any:
    """Return a / b, 1 where both are 0."""
    tiny = np.finfo(np.float64).tiny
    return (a + tiny) / (b + tiny)


def medians(every: Iterable[Compared]) -> dict[str, dict[str, list[float]]]:
    """Return by cell and algorithm the medians of the errors of the textbook and of the program, to three digits."""
    found: dict[str, dict[str, list[float]]] = {}
    for one in every:
        pair = [float(f"{np.median(x):.3g}") for x in (one.textbook, one.program)]
        found.setdefault(one.cell, {})[one.algorithm] = pair
    return found


def table(found: Iterable[Count]) -> str:
    """Return the table as text."""
    lines = [
        f"{'program / textbook':16} {'cells':>5} {'states':>6} {'same':>6} {'> 2':>6} {'< 1/2':>6} {'median':>6} "
        f"{'99 %':>6} {'of cells':>8} {'worst':>6}"
    ]
    for c in found:
        lines.append(
            f"{c.algorithm:18} {c.cells:5} {c.states:6} {c.same:6} {c.above:6.3f} {c.below:6.3f} {c.median:6.2f} "
            f"{c.high:6.1f} {c.cell_median:8.2f} {c.cell_worst:6.2f}"
        )
        lines += [f"  more than twice: {cell}" for cell in c.missed]
    return "\n".join(lines)
