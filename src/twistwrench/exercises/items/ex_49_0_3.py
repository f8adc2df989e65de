"""Exercise 49.0.3: the adjoint, from its definition."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import after, before, transposed

from ..layouts import MOTION_TRANSFORM
from ..wrong import faulty, swap, swapped

__all__ = ["EXERCISE", "adjoint"]


def adjoint(T: Any) -> Any:
    """Ad_T, column by column."""
    T_inverse = np.linalg.inv(T)
    columns = []
    for V in np.eye(6):
        moved = T @ tw.hat(V) @ T_inverse
        columns.append([moved[2, 1], moved[0, 2], moved[1, 0], *moved[:3, 3]])
    return np.array(columns).mT


def _by_blocks(T: Any) -> Any:
    R, p = T[:3, :3], T[:3, 3]
    return np.block([[R, np.zeros((3, 3))], [tw.skew(p) @ R, R]])


def _cases(rng: Any) -> Any:
    return [(tw.SE3(tw.exp3(rng.standard_normal(3)), rng.standard_normal(3)).matrix(),) for _ in range(5)]


EXERCISE = Exercise(
    id="49.0.3",
    taught="49.3",
    kind="explain",
    parts=(
        Part(
            solution=adjoint,
            ways=(_by_blocks,),
            returns=(Output("Ad_T", MOTION_TRANSFORM),),
            cases=_cases,
            slips={
                "inverse-transform": before(adjoint, np.linalg.inv, which=0),
                "swapped-halves": swapped(adjoint),
                "transposed-answer": transposed(adjoint),
                "coupling-dropped": after(adjoint, lambda X: X * np.kron([[1, 1], [0, 1]], np.ones((3, 3)))),
                "coupling-sign": after(adjoint, lambda X: X * np.kron([[1, 1], [-1, 1]], np.ones((3, 3)))),
                "force-for-motion": lambda T: np.linalg.inv(adjoint(T)).mT,
                "transpose-for-inverse": faulty(adjoint, ("np.linalg.inv(T)", "T.mT")),
                "inverse-unrotated": faulty(
                    adjoint, ("np.linalg.inv(T)", "np.block([[T[:3, :3].mT, -T[:3, 3:]], [T[3:]]])")
                ),
                "rows-exchanged": after(adjoint, lambda X: np.array([*map(swap, X.mT)]).mT),
            },
            alike=(frozenset({"swapped-halves", "force-for-motion"}),),
            residuals=(lambda answer, T: answer @ tw.log6(T) - tw.log6(T),),
        ),
    ),
)
