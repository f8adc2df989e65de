"""Exercise 49.1.2: an arm that touches something."""

from typing import Any

import numpy as np

from misstep.exercise import Exercise, Output, Part

from ..wrong import faulty

__all__ = ["EXERCISE", "polishing_torques"]


def polishing_torques(M: Any, h: Any, J: Any, a: Any, force: Any) -> Any:
    """Joint torques of an arm whose tip is pushed."""
    return M @ a + h - J.mT @ force


def _cases(rng: Any) -> Any:
    def one() -> Any:
        half = rng.standard_normal((3, 3))
        return half @ half.mT + np.eye(3), *rng.standard_normal((1, 3)), rng.standard_normal((3, 3))

    return [(*one(), *rng.standard_normal((2, 3))) for _ in range(5)]


def _singular(rng: Any) -> Any:
    """Return an arm that cannot push upward, with a joint that does not accelerate."""
    return [(M, h, J * [[1], [1], [0]], a * [1, 0, 1], force) for M, h, J, a, force in _cases(rng)[:1]]


EXERCISE = Exercise(
    id="49.1.2",
    kind="explain",
    parts=(
        Part(
            solution=polishing_torques,
            returns=(Output("τ", unit="N m"),),
            cases=_cases,
            edges=_singular,
            slips={
                "contact-missing": faulty(polishing_torques, (" - J.mT @ force", "")),
                "external-sign": faulty(polishing_torques, ("- J.mT", "+ J.mT")),
                "jacobian-untransposed": faulty(polishing_torques, ("J.mT", "J")),
                "bias-for-zero": faulty(polishing_torques, (" + h", "")),
                "bias-sign": faulty(polishing_torques, (" + h", " - h")),
                "products-dropped": faulty(polishing_torques, ("M @ a", "np.diag(M) * a")),
                "elementwise-product": lambda M, h, J, a, force: M * a + h - J.mT * force,
            },
            residuals=(lambda answer, M, h, J, a, force: np.linalg.solve(M, answer - h + J.mT @ force) - a,),
        ),
    ),
)
