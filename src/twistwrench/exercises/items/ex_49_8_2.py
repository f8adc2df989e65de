"""Exercise 49.8.2: the size of the mass matrix."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import after

from ..robots import robot

__all__ = ["EXERCISE", "held_mass_matrix", "mass_matrix_sizes"]


def mass_matrix_sizes() -> Any:
    """Rows of M with a floating and with a fixed base."""
    joints = 12
    return 6 + joints, joints


def held_mass_matrix(M: Any) -> Any:
    """Mass matrix of the same robot with its base held."""
    return M[6:, 6:]


def _let_go(M: Any) -> Any:
    return M[6:, 6:] - M[6:, :6] @ np.linalg.solve(M[:6, :6], M[:6, 6:])


def _cases(rng: Any) -> Any:
    small = tw.random_tree(6, rng=rng, base="floating", kinds=["revolute", "spherical"])
    large = tw.random_tree(20, rng=rng, base="floating", kinds=["revolute"])
    models = [robot("go2"), robot("go2"), small, large]
    return [(tw.crba(model, model.random_configuration(rng=rng)),) for model in models]


EXERCISE = Exercise(
    id="49.8.2",
    kind="number",
    parts=(
        Part(
            solution=mass_matrix_sizes,
            returns=(
                Output("rows (floating)", zh="行数（浮动基座）"),
                Output("rows (fixed)", zh="行数（固定基座）"),
            ),
            cases=lambda rng: [()],
            slips={
                "nq-for-nv": lambda: (19, 12),
                "base-twice": lambda: (19, 12),
                "base-missing": lambda: (12, 12),
                "njoints-for-nv": lambda: (14, 13),
                "base-as-one": lambda: (13, 12),
                "world-as-body": lambda: (18, 13),
                "joint-too-many": lambda: (19, 13),
                "base-rows-kept": lambda: (18, 18),
                "entries-for-rows": lambda: (18**2, 12**2),
            },
            alike=(frozenset({"nq-for-nv", "base-twice"}),),
        ),
        Part(
            solution=held_mass_matrix,
            returns=(Output("M (base held)", zh="M（基座固定）"),),
            cases=_cases,
            slips={
                "base-let-go": _let_go,
                "base-block-for-joints": lambda M: M[:6, :6],
                "base-last": lambda M: M[:-6, :-6],
                "nq-for-nv": lambda M: M[7:, 7:],
                "robot-hard-coded": lambda M: M[6:18, 6:18],
                "one-triangle": after(held_mass_matrix, np.triu),
                "doubled-off-diagonal": after(held_mass_matrix, lambda M: M + M.mT - np.diag(np.diag(M))),
            },
            residuals=(
                lambda answer, M: [
                    v @ answer @ v - np.concatenate([np.zeros(6), v]) @ M @ np.concatenate([np.zeros(6), v])
                    for v in np.random.default_rng(0).standard_normal((3, len(M) - 6))
                ],
            ),
        ),
    ),
)
