"""Exercise 49.3.1: X and X* of a pure translation."""

from typing import Any

import numpy as np

from misstep.exercise import Exercise, Output, Part
from misstep.faults import before

from ..layouts import FORCE_TRANSFORM, MOTION_TRANSFORM
from ..wrong import faulty, swapped
from .ex_49_0_1 import skew

__all__ = ["EXERCISE", "translation_transforms"]


def translation_transforms(p: Any) -> Any:
    """X, its inverse and X* of the placement (1, p)."""
    one, zero = np.eye(3), np.zeros((3, 3))
    X = np.block([[one, zero], [skew(p), one]])
    X_inverse = np.block([[one, zero], [-skew(p), one]])
    X_star = np.block([[one, skew(p)], [zero, one]])
    return X, X_inverse, X_star


EXERCISE = Exercise(
    id="49.3.1",
    kind="code",
    uses=("skew",),
    parts=(
        Part(
            solution=translation_transforms,
            returns=(
                Output("X", MOTION_TRANSFORM),
                Output("X⁻¹", MOTION_TRANSFORM),
                Output("X*", FORCE_TRANSFORM),
            ),
            cases=lambda rng: [(rng.standard_normal(3),) for _ in range(5)],
            slips={
                "coupling-dropped": before(translation_transforms, np.zeros_like, which=0),
                "coupling-sign": before(translation_transforms, np.negative, which=0),
                "skew-sign": before(translation_transforms, np.negative, which=0),
                "skew-symmetric": faulty(
                    translation_transforms,
                    ("[skew(p)", "[skew(p) * skew([1, 1, 1])"),
                    ("[-skew(p)", "[-skew(p) * skew([1, 1, 1])"),
                    ("one, skew(p)", "one, skew(p) * skew([1, 1, 1])"),
                ),
                "inverse-transform": before(translation_transforms, np.negative, which=0),
                "swapped-halves": swapped(translation_transforms),
                "transpose-for-inverse": faulty(translation_transforms, ("return X, X_inverse", "return X, X.mT")),
                "transpose-for-dual": faulty(
                    translation_transforms, ("return X, X_inverse, X_star", "return X, X_inverse, X.mT")
                ),
                "inverse-for-dual": faulty(
                    translation_transforms, ("return X, X_inverse, X_star", "return X, X_inverse, X_inverse")
                ),
                "dual-of-transpose": faulty(
                    translation_transforms, ("return X, X_inverse, X_star", "return X, X.mT, X")
                ),
                "motion-for-force": faulty(
                    translation_transforms, ("return X, X_inverse, X_star", "return X, X_inverse, X")
                ),
            },
            alike=(frozenset({"coupling-sign", "skew-sign", "inverse-transform"}),),
            residuals=(
                lambda answer, p: answer[0] @ answer[1] - np.eye(6),
                lambda answer, p: answer[2].mT @ answer[0] - np.eye(6),
            ),
        ),
    ),
)
