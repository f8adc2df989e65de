"""One cell of the grid: every way to every quantity, and how many digits it keeps, or that it raises an error."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np

from twistwrench.error_bounds import accuracy
from twistwrench.errors import ModelError

from .candidates import ALGORITHMS, Candidate, candidates
from .robots import Recipe
from .truth import Truth, truth

__all__ = ["Outcome", "measure"]


@dataclass(frozen=True)
class Outcome:
    """The outcome of one way in one cell.

    Attributes
    ----------
    algorithm, who : str
        As `candidates.ALGORITHMS` and `candidates.CANDIDATES` name them.
    error : float or None
        Relative, free of units; None without a number.
    raised : str
        The class and the message of the error instead of a number.
    bad : str
        A fault: a NaN, an infinity, a warning, an error that is not of our classes, a number where none is right.
    estimate : float or None
        What `twistwrench.accuracy` predicted, where it applies: infinite where it guarantees nothing.
    """

    algorithm: str
    who: str
    error: float | None = None
    raised: str = ""
    bad: str = ""
    estimate: float | None = None


def measure(recipe: Recipe, *, pinocchio: bool, digits: int = 50) -> list[Outcome]:
    """Measure all ways to all quantities, against a truth of `digits` digits.

    A robot that is not physical is rejected before any of them is called.
    """
    import mpmath

    try:
        model, s = recipe.model, recipe.state
    except ModelError as error:
        return [Outcome(name, "textbook", raised=f"ModelError: {error}") for name in ALGORITHMS]
    with mpmath.workdps(digits):
        right = truth(model, s)
        expected = {"float32": _estimates(recipe, np.float32), "double": _estimates(recipe, np.float64)}
        return [
            _judge(way, right, expected["float32" if way.who == "float32" else "double"])
            for way in candidates(model, s, right.torques, pinocchio=pinocchio)
        ]


def _estimates(recipe: Recipe, dtype: type) -> dict[str, float]:
    """Return the prediction of `accuracy`, by algorithm; empty where it rejects the configuration."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            known = accuracy(recipe.model, recipe.state.q.astype(dtype))
    except ValueError:
        return {}
    return {"rnea": float(known.rnea), "aba": float(known.aba), "crba + solve": float(known.crba_solve)}


def _judge(way: Candidate, right: Truth, expected: dict[str, float]) -> Outcome:
    """Call one way, and return its outcome."""
    estimate = expected.get(way.algorithm.partition(",")[0])
    outcome: dict[str, Any] = {"algorithm": way.algorithm, "who": way.who, "estimate": estimate}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            answer = way.answer()
    except Warning as warning:
        return Outcome(**outcome, bad=f"warns: {warning}")
    except ValueError as error:
        return Outcome(**outcome, raised=f"{type(error).__name__}: {error}")
    except Exception as error:
        return Outcome(**outcome, bad=f"{type(error).__name__}: {error}")
    if not np.isfinite(answer).all():
        return Outcome(**outcome, bad="NaN" if np.isnan(answer).any() else "infinite")
    off = right.error(ALGORITHMS[way.algorithm], answer)
    return Outcome(**outcome, error=off) if np.isfinite(off) else Outcome(**outcome, bad="a number where none is right")
