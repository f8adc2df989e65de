"""Exercise 49.3.3: the chain rule of X."""

from typing import Any

import numpy as np

from misstep.exercise import Exercise, Output, Part

from ...spatial import exp3
from ..layouts import MOTION_TRANSFORM
from ..public import mine
from ..wrong import faulty

__all__ = ["EXERCISE", "chain_two_ways"]


def chain_two_ways(R_AB: Any, p_AB: Any, R_BC: Any, p_BC: Any) -> Any:
    """X_AC from the placement of C in A, and as a product."""
    X = mine("plucker")
    R_AC, p_AC = R_AB @ R_BC, p_AB + R_AB @ p_BC
    by_placement, _ = X(R_AC, p_AC)
    by_product = X(R_AB, p_AB)[0] @ X(R_BC, p_BC)[0]
    return by_placement, by_product


def _cases(rng: Any) -> Any:
    def placement() -> tuple[Any, Any]:
        return exp3(rng.standard_normal(3)), rng.standard_normal(3)

    return [(*placement(), *placement()) for _ in range(5)]


def _upright(rng: Any) -> Any:
    """Return a pitch of 90°, at which roll and yaw are one."""
    R = np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]])
    return [(R, *rng.standard_normal((1, 3)), exp3([0.7, 0, 0]), *rng.standard_normal((1, 3)))]


EXERCISE = Exercise(
    id="49.3.3",
    kind="prove",
    parts=(
        Part(
            solution=chain_two_ways,
            given='X = mine("plucker")  # X(R, p) gives X and X*',
            returns=(
                Output("X of T_AB T_BC", MOTION_TRANSFORM, zh="T_AB T_BC 的 X"),
                Output("X_AB X_BC", MOTION_TRANSFORM),
            ),
            cases=_cases,
            edges=_upright,
            slips={
                "composition-order": faulty(
                    chain_two_ways, ("X(R_AB, p_AB)[0] @ X(R_BC, p_BC)[0]", "X(R_BC, p_BC)[0] @ X(R_AB, p_AB)[0]")
                ),
                "translation-unrotated": faulty(chain_two_ways, ("p_AB + R_AB @ p_BC", "p_AB + p_BC")),
                "rotation-transposed": faulty(chain_two_ways, ("R_AB @ p_BC", "R_AB.mT @ p_BC")),
                "translation-turned-twice": faulty(chain_two_ways, ("R_AB @ p_BC", "R_AB @ R_BC @ p_BC")),
                "translation-wrong-turn": faulty(chain_two_ways, ("R_AB @ p_BC", "R_BC @ p_BC")),
                "translation-of-reverse": faulty(chain_two_ways, ("p_AB + R_AB @ p_BC", "R_BC @ p_AB + p_BC")),
                "placements-reversed": faulty(
                    chain_two_ways, ("R_AB @ R_BC, p_AB + R_AB @ p_BC", "R_BC @ R_AB, R_BC @ p_AB + p_BC")
                ),
            },
            residuals=(lambda answer, R_AB, p_AB, R_BC, p_BC: answer[0] - answer[1],),
        ),
    ),
)
