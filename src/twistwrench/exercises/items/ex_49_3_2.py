"""Exercise 49.3.2: X of a pure rotation, and X and X* of any placement."""

from typing import Any

import numpy as np

from misstep.exercise import Exercise, Output, Part
from misstep.faults import before

from ...spatial import exp3
from ..layouts import FORCE_TRANSFORM, MOTION_TRANSFORM
from ..wrong import faulty, swapped
from .ex_49_0_1 import skew

__all__ = ["EXERCISE", "plucker", "rotation_transform"]


def rotation_transform(R: Any) -> Any:
    """X of the placement (R, 0)."""
    zero = np.zeros((3, 3))
    return np.block([[R, zero], [zero, R]])


def plucker(R: Any, p: Any) -> Any:
    """X and X* of the placement (R, p)."""
    zero, coupling = np.zeros((3, 3)), skew(p) @ R
    X = np.block([[R, zero], [coupling, R]])
    X_star = np.block([[R, coupling], [zero, R]])
    return X, X_star


ROTATION = Part(
    solution=rotation_transform,
    returns=(Output("X", MOTION_TRANSFORM),),
    cases=lambda rng: [(exp3(rng.standard_normal(3)),) for _ in range(4)],
    slips={
        "rotation-transposed": before(rotation_transform, lambda R: R.mT, which=0),
        "half-rotated": lambda R: np.block([[R, 0 * R], [0 * R, np.eye(3)]]),
        "only-v-rotated": lambda R: np.block([[np.eye(3), 0 * R], [0 * R, R]]),
        "kron-order": lambda R: np.kron(R, np.eye(2)),
    },
    residuals=(lambda answer, R: answer @ answer.mT - np.eye(6), lambda answer, R: answer[:3, :3] - R),
)

BOTH = Part(
    solution=plucker,
    returns=(Output("X", MOTION_TRANSFORM), Output("X*", FORCE_TRANSFORM)),
    cases=lambda rng: [(exp3(rng.standard_normal(3)), rng.standard_normal(3)) for _ in range(5)],
    slips={
        "coupling-dropped": faulty(plucker, ("skew(p) @ R", "0 * R")),
        "coupling-sign": faulty(plucker, ("skew(p) @ R", "-skew(p) @ R")),
        "coupling-order": faulty(plucker, ("skew(p) @ R", "R @ skew(p)")),
        "coupling-unrotated": faulty(plucker, ("skew(p) @ R", "skew(p)")),
        "coupling-of-rows": faulty(plucker, ("skew(p) @ R", "-R @ skew(p)")),
        "skew-symmetric": faulty(plucker, ("skew(p) @ R", "skew(p) * skew([1, 1, 1]) @ R")),
        "rotation-transposed": lambda R, p: plucker(R.mT, p),
        "inverse-transform": lambda R, p: plucker(R.mT, -R.mT @ p),
        "opposite-placement": lambda R, p: plucker(R.mT, -p),
        "swapped-halves": swapped(plucker),
        "transpose-for-dual": lambda R, p: (plucker(R, p)[0], plucker(R, p)[0].mT),
        "motion-for-force": lambda R, p: (plucker(R, p)[0], plucker(R, p)[0]),
        "force-for-motion": lambda R, p: (plucker(R, p)[1], plucker(R, p)[1]),
    },
    residuals=(
        lambda answer, R, p: answer[1].mT @ answer[0] - np.eye(6),
        lambda answer, R, p: np.linalg.det(answer[0]) - 1,
    ),
)

EXERCISE = Exercise(id="49.3.2", kind="code", parts=(ROTATION, BOTH), uses=("skew",))
