"""Exercise 49.0.1: the matrix of the cross product."""

from typing import Any

import numpy as np

from misstep.exercise import Exercise, Output, Part
from misstep.faults import transposed

from ..wrong import faulty

__all__ = ["EXERCISE", "skew"]


def skew(w: Any) -> Any:
    """[w]×."""
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


EXERCISE = Exercise(
    id="49.0.1",
    taught="49.2",
    kind="code",
    parts=(
        Part(
            solution=skew,
            returns=(Output("[w]×"),),
            cases=lambda rng: [(rng.standard_normal(3),) for _ in range(5)],
            slips={
                "skew-sign": transposed(skew),
                "skew-symmetric": faulty(skew, ("-w[2]", "w[2]"), ("-w[0]", "w[0]"), ("-w[1]", "w[1]")),
            },
            residuals=(lambda W, w: W @ w,),
        ),
    ),
)
