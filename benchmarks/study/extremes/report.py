"""The records counted: for every algorithm and every way to it, and for the estimate of `accuracy`."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from twistwrench.arrays import resolution

from ..record import Record, table
from .cells import ALGORITHMS, WAYS, Cell

ALIKE = 4 * resolution(np.float64)
"""An error counts as larger if it exceeds twice another by more than this."""


def _by_way(cells: Sequence[Cell]) -> dict[tuple[str, str], list[tuple[Cell, Record]]]:
    found: dict[tuple[str, str], list[tuple[Cell, Record]]] = {(a, w): [] for a in ALGORITHMS for w in WAYS}
    for cell in cells:
        for record in cell.records:
            found[record.quantity, record.way].append((cell, record))
    return {way: pairs for way, pairs in found.items() if pairs}


def rows(cells: Sequence[Cell]) -> list[dict[str, Any]]:
    """Count the records of every way to every quantity.

    `above` and `below` are cells where the error is more than twice Pinocchio's and four roundings, and where
    Pinocchio's is as much more than this one; `tenth` are those where it is less than a tenth of Pinocchio's.
    """
    theirs = {(c.recipe, r.quantity): r.error for c in cells for r in c.records if r.way == "pinocchio"}
    found = []
    for (quantity, way), pairs in _by_way(cells).items():
        numbers = [(r.error, cell.recipe) for cell, r in pairs if r.error is not None]
        worst, where = max(((error, str(recipe)) for error, recipe in numbers), default=(0.0, ""))
        both = [(x, y) for x, recipe in numbers if (y := theirs.get((recipe, quantity))) is not None]
        row = {
            "quantity": quantity,
            "way": way,
            "cells": len(pairs),
            "raised": sum(bool(r.raised) for _, r in pairs),
            "faults": sum(bool(r.fault) for _, r in pairs),
            "median": float(np.median([error for error, _ in numbers])) if numbers else 0.0,
            "worst": worst,
            "above": sum(x > 2 * y + ALIKE for x, y in both),
            "below": sum(y > 2 * x + ALIKE for x, y in both),
            "tenth": sum(x < y / 10 for x, y in both),
            "where": where,
        }
        found.append(row)
    return found


def estimates(cells: Sequence[Cell]) -> list[dict[str, Any]]:
    """Count the cells with an error and an estimate of `accuracy`, those where it held; the median of the ratio."""
    found = []
    for (quantity, way), pairs in _by_way(cells).items():
        known = [(r.estimate, r.error) for _, r in pairs if r.estimate is not None and r.error is not None]
        if known and way != "pinocchio":
            estimate, error = np.array(known).transpose()
            ratio = estimate / np.maximum(error, np.finfo(np.float64).tiny)
            counted = {"cells": len(known), "held": int((ratio >= 1).sum()), "median": float(np.median(ratio))}
            found.append({"quantity": quantity, "way": way, **counted})
    return found


def faults(cells: Sequence[Cell]) -> list[tuple[Cell, Record]]:
    """Return the faults of all but Pinocchio."""
    return [(c, r) for c in cells for r in c.records if r.fault and r.way != "pinocchio"]


def ways_table(found: Sequence[dict[str, Any]]) -> str:
    """Return the table of `rows`."""
    above = {"above": "> Pin.", "below": "< Pin.", "tenth": "< 1/10", "where": "worst at"}
    names = "quantity", "way", "cells", "raised", "faults", "median", "worst"
    return table(found, dict.fromkeys(names) | above, median=".1e", worst=".1e")


def estimates_table(found: Sequence[dict[str, Any]]) -> str:
    """Return the table of `estimates`."""
    names = "quantity", "way", "cells", "held"
    return table(found, dict.fromkeys(names) | {"median": "tw.accuracy / error, median"}, median=".0f")


def turns_table(turns: Sequence[Record]) -> str:
    """Return the table of exponentials and logarithms, with their worst errors near 0 and near π."""
    names = "quantity", "way", "where", "error"
    return table([vars(r) for r in turns], dict.fromkeys(names), error=".1e")
