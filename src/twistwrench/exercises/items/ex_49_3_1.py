"""Exercise 49.3.1: X and X* of a pure translation."""

from typing import Any

import numpy as np

from ..exercise import Exercise, Part, Quantity
from ..layouts import FORCE_TRANSFORM, MOTION_TRANSFORM
from ..wrong import swapped
from .ex_49_0_1 import skew

__all__ = ["EXERCISE", "translation_transforms"]


def translation_transforms(p: Any) -> Any:
    """X, its inverse and X* of the placement (1, p)."""
    one, zero = np.eye(3), np.zeros((3, 3))
    X = np.block([[one, zero], [skew(p), one]])
    X_inverse = np.block([[one, zero], [-skew(p), one]])
    X_star = np.block([[one, skew(p)], [zero, one]])
    return X, X_inverse, X_star


def _with(corner: Any, p: Any) -> Any:
    """Put something else in the place of [p]×."""
    X, X_inverse, X_star = translation_transforms(p)
    X[3:, :3], X_inverse[3:, :3], X_star[:3, 3:] = corner, -corner, corner
    return X, X_inverse, X_star


def _replaced(p: Any, *, k: int, by: Any) -> Any:
    """Make one of the three out of all three."""
    answer = list(translation_transforms(p))
    answer[k] = by(*answer)
    return tuple(answer)


EXERCISE = Exercise(
    id="49.3.1",
    kind="code",
    uses=("skew",),
    parts=(
        Part(
            solution=translation_transforms,
            returns=(
                Quantity("X", MOTION_TRANSFORM),
                Quantity("X⁻¹", MOTION_TRANSFORM),
                Quantity("X*", FORCE_TRANSFORM),
            ),
            cases=lambda rng: [(rng.standard_normal(3),) for _ in range(5)],
            slips={
                "coupling-dropped": lambda p: _with(np.zeros((3, 3)), p),
                "coupling-sign": lambda p: _with(-skew(p), p),
                "skew-sign": lambda p: _with(skew(p).mT, p),
                "skew-symmetric": lambda p: _with(np.abs(skew(p)), p),
                "swapped-halves": swapped(translation_transforms),
                "transpose-for-inverse": lambda p: _replaced(p, k=1, by=lambda X, X_inverse, X_star: X.mT),
                "transpose-for-dual": lambda p: _replaced(p, k=2, by=lambda X, X_inverse, X_star: X.mT),
                "motion-for-force": lambda p: _replaced(p, k=2, by=lambda X, X_inverse, X_star: X),
            },
            alike=(frozenset({"coupling-sign", "skew-sign"}),),
            residuals=(
                lambda answer, p: answer[0] @ answer[1] - np.eye(6),
                lambda answer, p: answer[2].mT @ answer[0] - np.eye(6),
            ),
        ),
    ),
)
