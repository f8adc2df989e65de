"""Exercise 49.9.2: the selection matrix."""

from typing import Any

import numpy as np

from misstep.exercise import Exercise, Output, Part
from misstep.faults import transposed

__all__ = ["EXERCISE", "on_all_rows", "selection"]


def selection(nv: Any) -> Any:
    """S of a robot with a floating base."""
    n = nv - 6
    return np.hstack([np.zeros((n, 6)), np.eye(n)])


def on_all_rows(tau: Any) -> Any:
    """Torques of the motors as generalised forces."""
    return np.concatenate([np.zeros(6), tau])


EXERCISE = Exercise(
    id="49.9.2",
    kind="code",
    parts=(
        Part(
            solution=selection,
            returns=(Output("S"),),
            cases=lambda rng: [(18,), (6 + int(rng.integers(3, 30)),), (7,)],
            slips={
                "selection-first": lambda nv: np.eye(nv - 6, nv),
                "selection-transposed": transposed(selection),
                "selection-of-base": lambda nv: np.eye(6, nv),
                "selection-of-all": lambda nv: np.eye(nv),
                "nq-for-nv": lambda nv: np.hstack([np.zeros((nv - 6, 7)), np.eye(nv - 6)]),
                "base-missing": lambda nv: np.eye(nv - 6),
                "twelve-motors": lambda nv: np.eye(nv - 6, nv, nv - 12),
                "block-of-ones": lambda nv: np.hstack([np.zeros((nv - 6, 6)), np.ones((nv - 6, nv - 6))]),
                "selection-square": lambda nv: np.diag(1.0 * (np.arange(nv) > 5)),
            },
            edges=lambda rng: [(6,)],
            residuals=(
                lambda answer, nv: answer[:, :6],
                lambda answer, nv: answer @ answer.mT - np.eye(nv - 6),
            ),
        ),
        Part(
            solution=on_all_rows,
            returns=(Output("Sᵀτ"),),
            cases=lambda rng: [(rng.standard_normal(n),) for n in (12, 1, 23)],
            slips={
                "selection-first": lambda tau: np.concatenate([tau, np.zeros(6)]),
                "nq-for-nv": lambda tau: np.concatenate([np.zeros(7), tau]),
                "base-missing": lambda tau: tau,
                "column-vector": lambda tau: on_all_rows(tau)[:, None],
                "zeros-at-both-ends": lambda tau: np.pad(tau, 6),
                "whole-numbers": lambda tau: on_all_rows(tau).astype(int),
            },
            edges=lambda rng: [(np.zeros(0),)],
            residuals=(lambda answer, tau: answer @ np.arange(len(tau) + 6.0) - tau @ np.arange(6.0, len(tau) + 6),),
        ),
    ),
)
