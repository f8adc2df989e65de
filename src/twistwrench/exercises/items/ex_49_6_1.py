"""Exercise 49.6.1: RNEA against M a + h."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Quantity
from ..layouts import JOINT_SPACE, MASS_MATRIX
from ..robots import robot, small_robot
from ..wrong import after, swap, swapped

__all__ = ["EXERCISE", "mass_matrix_by_rnea", "torques_two_ways"]


def torques_two_ways(model: Any, q: Any, v: Any, a: Any) -> Any:
    """Joint forces by RNEA, and as M a + h."""
    M = tw.crba(model, q)
    h = tw.rnea(model, q, v, np.zeros(model.nv))
    return tw.rnea(model, q, v, a), M @ a + h


def mass_matrix_by_rnea(model: Any, q: Any) -> Any:
    """Mass matrix, column by column."""
    rest = np.zeros(model.nv)
    gravity = tw.rnea(model, q, rest, rest)
    columns = [tw.rnea(model, q, rest, e) - gravity for e in np.eye(model.nv)]
    return np.array(columns).mT


def _second(model: Any, q: Any, v: Any, a: Any, tau: Any) -> Any:
    """Put something else in the place of M a + h."""
    return tw.rnea(model, q, v, a), tau


def _sum(M: Any, model: Any, q: Any, v: Any, a: Any) -> Any:
    """Use another matrix for M."""
    return _second(model, q, v, a, M @ a + tw.nonlinear_effects(model, q, v))


def _with(model: Any, q: Any, v: Any, a: Any, bias: Any) -> Any:
    """Use something else for h."""
    return _second(model, q, v, a, tw.crba(model, q) @ a + bias)


def _motions(rng: Any) -> Any:
    def motion(model: Any) -> Any:
        return model, model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv))

    return [motion(robot("go2")), motion(small_robot(rng)), motion(small_robot(rng))]


def _postures(rng: Any) -> Any:
    return [(model, model.random_configuration(rng=rng)) for model in (small_robot(rng), small_robot(rng))]


TWO_WAYS = Part(
    solution=torques_two_ways,
    returns=(Quantity("τ by RNEA", JOINT_SPACE), Quantity("M a + h", JOINT_SPACE)),
    cases=_motions,
    slips={
        "bias-for-zero": lambda model, q, v, a: _with(model, q, v, a, 0),
        "bias-sign": lambda model, q, v, a: _with(model, q, v, a, -tw.nonlinear_effects(model, q, v)),
        "velocity-terms-missing": lambda model, q, v, a: _with(model, q, v, a, tw.gravity(model, q)),
        "gravity-missing": lambda model, q, v, a: _with(
            model, q, v, a, tw.nonlinear_effects(model, q, v) - tw.gravity(model, q)
        ),
        "gravity-twice": lambda model, q, v, a: _with(
            model, q, v, a, tw.nonlinear_effects(model, q, v) + tw.gravity(model, q)
        ),
        "acceleration-twice": lambda model, q, v, a: _with(model, q, v, a, tw.rnea(model, q, v, a)),
        "velocity-for-acceleration": lambda model, q, v, a: _second(
            model, q, v, a, tw.crba(model, q) @ v + tw.nonlinear_effects(model, q, v)
        ),
        "one-triangle": lambda model, q, v, a: _sum(np.triu(tw.crba(model, q)), model, q, v, a),
        "doubled-off-diagonal": lambda model, q, v, a: _sum(
            2 * tw.crba(model, q) - np.diag(tw.crba(model, q).diagonal()), model, q, v, a
        ),
        "orders-mixed": lambda model, q, v, a: _sum(swap(tw.crba(model, q)), model, q, v, a),
        "swapped-halves": swapped(torques_two_ways),
        "base-missing": after(torques_two_ways, lambda tau: tau[6:]),
    },
    residuals=(
        lambda answer, model, q, v, a: answer[0] - answer[1],
        lambda answer, model, q, v, a: tw.aba(model, q, v, answer[1]) - a,
    ),
)

COLUMNS = Part(
    solution=mass_matrix_by_rnea,
    returns=(Quantity("M", MASS_MATRIX),),
    cases=_postures,
    slips={
        "gravity-left-in": lambda model, q: mass_matrix_by_rnea(model, q) + tw.gravity(model, q)[:, None],
        "swapped-halves": swapped(mass_matrix_by_rnea),
        "base-missing": lambda model, q: mass_matrix_by_rnea(model, q)[6:, 6:],
        "one-triangle": after(mass_matrix_by_rnea, np.triu),
        "doubled-off-diagonal": lambda model, q: (
            2 * mass_matrix_by_rnea(model, q) - np.diag(mass_matrix_by_rnea(model, q).diagonal())
        ),
    },
    residuals=(
        lambda answer, model, q: answer - answer.mT,
        lambda answer, model, q: [
            v @ answer @ v / 2 - tw.kinetic_energy(model, q, v) for v in np.tri(model.nv) / model.nv
        ],
        lambda answer, model, q: answer - tw.crba(model, q),
    ),
)

EXERCISE = Exercise(
    id="49.6.1",
    kind="code",
    parts=(TWO_WAYS, COLUMNS),
)
