"""The outcomes counted: for every algorithm and every way to it, and for the estimate of `accuracy`."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from twistwrench.arrays import resolution

from .candidates import ALGORITHMS, CANDIDATES
from .cell import Outcome
from .rotations import Turns
from .run import Cell

__all__ = ["Estimate", "Row", "as_dict", "bad", "estimates", "messages", "rows", "table", "turns"]

OURS = ("textbook", "fast")
ALIKE = 4 * resolution(np.float64)
"""An error counts as larger if it exceeds twice another by more than this."""


@dataclass(frozen=True)
class Row:
    """One way to one quantity over all cells.

    Attributes
    ----------
    algorithm, who : str
    cells, numbers, raised, bad : int
        Numbers of cells: all; with numbers; with an error raised; with a fault.
    median, worst : float
        Relative error.
    where : str
        The cell of the worst.
    above, below : int
        Cells where the error is more than twice Pinocchio's and four roundings, and where Pinocchio's is as much
        more than this one.
    tenth : int
        Cells where it is less than a tenth of Pinocchio's.
    """

    algorithm: str
    who: str
    cells: int
    numbers: int
    raised: int
    bad: int
    median: float
    worst: float
    where: str
    above: int
    below: int
    tenth: int


@dataclass(frozen=True)
class Estimate:
    """The estimates of `accuracy`: cells where an error is known, those where it was below the estimate, and the ratio.

    Attributes
    ----------
    algorithm, who : str
    cells, held : int
    median : float
        Of estimate over error.
    """

    algorithm: str
    who: str
    cells: int
    held: int
    median: float


def _by_way(cells: Iterable[Cell]) -> dict[tuple[str, str], list[tuple[Cell, Outcome]]]:
    found: dict[tuple[str, str], list[tuple[Cell, Outcome]]] = {(a, w): [] for a in ALGORITHMS for w in CANDIDATES}
    for cell in cells:
        for outcome in cell.outcomes:
            found[outcome.algorithm, outcome.who].append((cell, outcome))
    return {way: pairs for way, pairs in found.items() if pairs}


def rows(cells: Sequence[Cell]) -> list[Row]:
    """Count the outcomes of every way to every quantity."""
    theirs = {(c.recipe, o.algorithm): o.error for c in cells for o in c.outcomes if o.who == "pinocchio"}
    return [_row(algorithm, who, pairs, theirs) for (algorithm, who), pairs in _by_way(cells).items()]


def _row(algorithm: str, who: str, pairs: list[tuple[Cell, Outcome]], theirs: dict[Any, float | None]) -> Row:
    numbers = [(cell, o.error) for cell, o in pairs if o.error is not None]
    worst, at = max(((error, str(cell)) for cell, error in numbers), default=(0.0, ""))
    both = [(x, y) for cell, x in numbers if (y := theirs.get((cell.recipe, algorithm))) is not None]
    return Row(
        algorithm=algorithm,
        who=who,
        cells=len(pairs),
        numbers=len(numbers),
        raised=sum(bool(o.raised) for _, o in pairs),
        bad=sum(bool(o.bad) for _, o in pairs),
        median=float(np.median([error for _, error in numbers])) if numbers else 0.0,
        worst=worst,
        where=at,
        above=sum(x > 2 * y + ALIKE for x, y in both),
        below=sum(y > 2 * x + ALIKE for x, y in both),
        tenth=sum(x < y / 10 for x, y in both),
    )


def estimates(cells: Sequence[Cell]) -> list[Estimate]:
    """Compare the estimates of `accuracy` with the errors."""
    found = []
    for (algorithm, who), pairs in _by_way(cells).items():
        known = [(o.estimate, o.error) for _, o in pairs if o.estimate is not None and o.error is not None]
        if known and who != "pinocchio":
            estimate, error = np.array(known).transpose()
            ratio = estimate / np.maximum(error, np.finfo(np.float64).tiny)
            found.append(Estimate(algorithm, who, len(known), int((ratio >= 1).sum()), float(np.median(ratio))))
    return found


def messages(cells: Sequence[Cell]) -> list[tuple[str, int]]:
    """Return the errors of ours, without their numbers, and how often each was raised; the most frequent first."""
    said = Counter(_general(o.raised) for c in cells for o in c.outcomes if o.who != "pinocchio" and o.raised)
    return said.most_common()


def _general(message: str) -> str:
    """Return the first line of a message, without what differs from cell to cell: names and numbers."""
    line = message.splitlines()[0].rstrip(":")
    return re.sub("'[^']*'", "…", re.split(", got| has norm", line)[0])


def bad(cells: Sequence[Cell]) -> list[tuple[Cell, Outcome]]:
    """Return the faults of all but Pinocchio."""
    return [(c, o) for c in cells for o in c.outcomes if o.bad and o.who != "pinocchio"]


# ---------------------------------------------------------------- as text


def table(cells: Sequence[Cell]) -> str:
    """Return the three tables as text."""
    return "\n".join([*_ways(rows(cells)), "", *_estimated(estimates(cells)), "", *_messages(messages(cells))])


def _ways(found: Iterable[Row]) -> Iterator[str]:
    yield (
        f"{'':22} {'':9} {'cells':>5} {'raised':>7} {'bad':>3} {'median':>8} {'worst':>8} "
        f"{'> Pin.':>6} {'< Pin.':>6} {'< 1/10':>6}  worst at"
    )
    for r in found:
        compared = [f"{x:6}" for x in (r.above, r.below, r.tenth)] if r.who in OURS else [" " * 6] * 3
        yield (
            f"{r.algorithm:22} {r.who:9} {r.cells:5} {r.raised:7} {r.bad:3} {r.median:8.1e} {r.worst:8.1e} "
            f"{' '.join(compared)}  {r.where}"
        )


def _estimated(found: Iterable[Estimate]) -> Iterator[str]:
    yield f"{'tw.accuracy':22} {'':9} {'cells':>5} {'held':>5} {'estimate / error, median':>25}"
    for e in found:
        yield f"{e.algorithm:22} {e.who:9} {e.cells:5} {e.held:5} {e.median:25.0f}"


def _messages(found: Iterable[tuple[str, int]]) -> Iterator[str]:
    yield "errors raised, ours"
    for message, count in found:
        yield f"{count:5} × {message}"


def turns(found: Iterable[Turns]) -> Iterator[str]:
    """Return the lines of the table of exponentials and logarithms."""
    yield f"{'exp and log, worst error':26} {'near 0':>9} {'near π':>9}"
    for turn in found:
        yield f"{turn.function} {turn.library:21} {turn.near_zero:9.1e} {turn.near_pi:9.1e}"


def as_dict(cells: Sequence[Cell]) -> dict[str, Any]:
    """Return the same as numbers, for JSON: an infinite estimate becomes None."""
    return {
        "cells": len(cells),
        "ways": [asdict(row) for row in rows(cells)],
        "estimates": [_finite(asdict(estimate)) for estimate in estimates(cells)],
        "raised": [{"error": message, "count": count} for message, count in messages(cells)],
        "bad": [{"cell": str(cell), **_finite(asdict(outcome))} for cell, outcome in bad(cells)],
    }


def _finite(found: dict[str, Any]) -> dict[str, Any]:
    return {name: None if x in (np.inf, -np.inf) else x for name, x in found.items()}
