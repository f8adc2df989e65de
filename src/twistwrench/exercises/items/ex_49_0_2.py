"""Exercise 49.0.2: how a placement acts on a point."""

from typing import Any

from misstep.exercise import Exercise, Output, Part
from misstep.faults import as_column

from ...spatial import exp3
from ..wrong import faulty

__all__ = ["EXERCISE", "act"]


def act(R: Any, p: Any, x: Any) -> Any:
    """Coordinates in A of a point of B."""
    return R @ x + p


EXERCISE = Exercise(
    id="49.0.2",
    taught="49.3",
    kind="code",
    parts=(
        Part(
            solution=act,
            returns=(Output("x_A", unit="m"),),
            cases=lambda rng: [
                (exp3(rng.standard_normal(3)), rng.standard_normal(3), rng.standard_normal(3)) for _ in range(5)
            ],
            slips={
                "translation-dropped": faulty(act, (" + p", "")),
                "translation-first": lambda R, p, x: R @ (x + p),
                "translation-sign": faulty(act, (" + p", " - p")),
                "rotation-transposed": faulty(act, ("R @", "R.mT @")),
                "inverse-transform": lambda R, p, x: R.mT @ (x - p),
                "opposite-placement": lambda R, p, x: R.mT @ x - p,
                "elementwise-product": faulty(act, ("R @", "R *")),
                "column-vector": as_column(act),
            },
            residuals=(lambda answer, R, p, x: ((answer - p) ** 2).sum() - (x**2).sum(),),
        ),
    ),
)
