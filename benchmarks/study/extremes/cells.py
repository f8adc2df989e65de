"""A cell of the grid, measured: every way to every quantity."""

import warnings
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench.arrays import Array, resolution

from ..quantities import QUANTITIES, SOLVED, Robot, pinocchio
from ..record import Record, Way
from .robots import Recipe, State
from .truth import Truth, truth

WAYS = ("textbook", "fast", "float32", "pinocchio")

ALGORITHMS = {
    "rnea": ("ID", "tau"),
    "crba": ("M", "M"),
    "aba, steered": ("FD", "steered"),
    "aba, pushed": ("FD", "pushed"),
    "crba + solve, steered": (SOLVED, "steered"),
    "crba + solve, pushed": (SOLVED, "pushed"),
    "centroidal map": ("A_G", "A_G"),
    "J̇v": ("dJv", "bias"),
}
"""For each the key of its quantity, and the right value that it is compared with (`truth.Truth`)."""


class Cell(NamedTuple):
    """A cell and its records."""

    recipe: Recipe
    records: list[Record]


def ways(model: tw.Model, s: State, torques: dict[str, Array], *, with_pinocchio: bool) -> Iterator[Way]:
    """Yield every way to every quantity in a state: `WAYS`, of no arguments."""
    oracle = pinocchio(model) if with_pinocchio else None
    robot = Robot(model, oracle, model.frame_names[-1])
    for algorithm, (key, name) in ALGORITHMS.items():
        state = {**s._asdict(), "tau": torques.get(name, s.a)}
        quantity = QUANTITIES[key]
        args = quantity.arguments(**state)
        for who, by, number in (("textbook", tw, "float64"), ("fast", tw.fast, "float64"), ("float32", tw, "float32")):
            if hasattr(by, quantity.ours):
                compute = partial(_solved, by, model) if key == SOLVED else robot.ours(key, by)
                yield Way(algorithm, who, partial(compute, *(x.astype(number) for x in args)), number)
        for way in robot.pinocchio(key):
            yield Way(algorithm, "pinocchio", partial(way.value, *args))


def _solved(by: Any, model: tw.Model, q: Array, v: Array, tau: Array) -> Array:
    return solve(by.crba(model, q), tau - by.nonlinear_effects(model, q, v))


def solve(M: Array, b: Array) -> Array:
    """Return M⁻¹ b, the units of the rows divided out, by elimination from the tips to the base: M = Lᵀ D L."""
    own, n = np.diagonal(M), len(b)
    if (own <= 0).any():
        raise tw.SingularError("M: a joint moves nothing that has inertia")
    unit = np.sqrt(own)
    left, x, ratio = M / unit[:, None] / unit, b / unit, np.zeros_like(M)
    for k in reversed(range(n)):  # the pivot is the apparent inertia at joint k
        if left[k, k] <= n * resolution(M.dtype):
            raise tw.SingularError("M: not positive definite, to rounding")
        ratio[k, :k] = left[k, :k] / left[k, k]
        left[:k, :k] -= np.outer(left[k, :k], ratio[k, :k])
        x[:k] -= ratio[k, :k] * x[k]
    for k in range(n):
        x[k] = x[k] / left[k, k] - ratio[k, :k] @ x[:k]
    return np.asarray(x / unit)


def measure(recipe: Recipe, *, with_pinocchio: bool, digits: int = 50) -> list[Record]:
    """Measure all ways to all quantities, against a truth of `digits` digits."""
    import mpmath

    try:
        model, s = recipe.model, recipe.state
    except tw.ModelError as error:
        return [Record(name, "textbook", raised=f"ModelError: {error}") for name in ALGORITHMS]
    with mpmath.workdps(digits):
        right = truth(model, s)
        estimates = {number: _estimates(recipe, number) for number in ("float32", "float64")}
        return [
            _judge(way, right, estimates[way.number].get(way.quantity.partition(",")[0]))
            for way in ways(model, s, right.torques, with_pinocchio=with_pinocchio)
        ]


def _estimates(recipe: Recipe, number: str) -> dict[str, float]:
    """Return the prediction of `accuracy`, by algorithm; empty where it rejects the configuration."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            known = tw.accuracy(recipe.model, recipe.state.q.astype(number))
    except ValueError:
        return {}
    return {"rnea": float(known.rnea), "aba": float(known.aba), "crba + solve": float(known.crba_solve)}


def _judge(way: Way, right: Truth, estimate: float | None) -> Record:
    """Call one way, and return what it gave."""
    record = Record(way.quantity, way.name, way.number, estimate=estimate)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            answer = way.value()
    except Warning as warning:
        return replace(record, fault=f"warns: {warning}")
    except ValueError as error:
        return replace(record, raised=f"{type(error).__name__}: {error}")
    except Exception as error:
        return replace(record, fault=f"{type(error).__name__}: {error}")
    if not np.isfinite(answer).all():
        return replace(record, fault="NaN" if np.isnan(answer).any() else "infinite")
    error = right.error(ALGORITHMS[way.quantity][1], answer)
    return replace(record, error=error) if np.isfinite(error) else replace(record, fault="a number where none is right")
