"""Exercise 49.6.1: RNEA against M a + h."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import after, times

from ..layouts import JOINT_SPACE, MASS_MATRIX
from ..robots import larger, robot, small_robot
from ..wrong import doubled, faulty, swapped

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


def _motions(rng: Any) -> Any:
    def motion(model: Any) -> Any:
        return model, model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv))

    return [motion(robot("go2")), motion(small_robot(rng)), motion(small_robot(rng))]


def _postures(rng: Any) -> Any:
    return [
        *((model, model.random_configuration(rng=rng)) for model in (small_robot(rng), small_robot(rng))),
        *larger(rng),
    ]


TWO_WAYS = Part(
    solution=torques_two_ways,
    returns=(Output("τ by RNEA", JOINT_SPACE, zh="用 RNEA 求得的 τ"), Output("M a + h", JOINT_SPACE)),
    cases=_motions,
    slips={
        "bias-for-zero": faulty(torques_two_ways, ("@ a + h", "@ a")),
        "bias-sign": faulty(torques_two_ways, ("@ a + h", "@ a - h")),
        "velocity-terms-missing": faulty(torques_two_ways, ("@ a + h", "@ a + tw.gravity(model, q)")),
        "gravity-missing": faulty(torques_two_ways, ("@ a + h", "@ a + h - tw.gravity(model, q)")),
        "gravity-twice": faulty(torques_two_ways, ("@ a + h", "@ a + h + tw.gravity(model, q)")),
        "acceleration-twice": faulty(torques_two_ways, ("@ a + h", "@ a + tw.rnea(model, q, v, a)")),
        "velocity-for-acceleration": faulty(torques_two_ways, ("M @ a", "M @ v")),
        "one-triangle": faulty(torques_two_ways, ("= tw.crba(model, q)", "= np.triu(tw.crba(model, q))")),
        "doubled-off-diagonal": faulty(torques_two_ways, ("= tw.crba(model, q)", "= doubled(tw.crba(model, q))")),
        "doubled-diagonal": faulty(torques_two_ways, ("M @ a", "M @ a + M.diagonal() * a")),
        "orders-mixed": faulty(torques_two_ways, ("= tw.crba(model, q)", "= swap(tw.crba(model, q))")),
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
    returns=(Output("M", MASS_MATRIX),),
    cases=_postures,
    slips={
        "columns-added-up": after(mass_matrix_by_rnea, lambda M: M.cumsum(axis=1)),
        "gravity-left-in": faulty(mass_matrix_by_rnea, (" - gravity", "")),
        "gravity-averaged": after(faulty(mass_matrix_by_rnea, (" - gravity", "")), lambda M: (M + M.mT) / 2),
        "gravity-from-columns": faulty(
            mass_matrix_by_rnea, ("columns).mT", "columns).mT + gravity[:, None] - gravity")
        ),
        "gravity-from-rows": faulty(mass_matrix_by_rnea, ("columns).mT", "columns).mT + gravity - gravity[:, None]")),
        "half-missing": times(mass_matrix_by_rnea, 2),
        "swapped-halves": swapped(mass_matrix_by_rnea),
        "base-missing": after(mass_matrix_by_rnea, lambda M: M[6:, 6:]),
        "one-triangle": after(mass_matrix_by_rnea, np.triu),
        "doubled-off-diagonal": after(mass_matrix_by_rnea, doubled),
        "doubled-diagonal": after(mass_matrix_by_rnea, lambda M: M + np.diag(M.diagonal())),
    },
    residuals=(
        lambda answer, model, q: answer - answer.mT,
        lambda answer, model, q: [
            v @ answer @ v / 2 - tw.kinetic_energy(model, q, v) for v in np.tri(model.nv) / model.nv
        ],
        lambda answer, model, q: answer - tw.crba(model, q),
    ),
)

EXERCISE = Exercise(id="49.6.1", kind="code", parts=(TWO_WAYS, COLUMNS))
