"""Exercise 49.5.3: about the centre of mass, rotation and translation are decoupled."""

from typing import Any

import numpy as np

from misstep.exercise import Exercise, Output, Part

from ...spatial import exp3
from ..layouts import INERTIA
from ..public import mine
from ..wrong import faulty, swapped
from .ex_49_0_1 import skew
from .ex_49_3_2 import plucker
from .ex_49_5_1 import random_body, spatial_inertia

__all__ = ["EXERCISE", "about_center_of_mass", "moved_inertia"]


def moved_inertia(I: Any, R: Any, p: Any) -> Any:
    """Inertia in another frame."""
    _, X_star = plucker(R, p)
    X_inverse = X_star.mT
    return X_star @ I @ X_inverse


def about_center_of_mass(m: Any, c: Any, I_c: Any) -> Any:
    """Inertia in a frame at the centre of mass."""
    build, moved = mine("spatial_inertia"), mine("moved_inertia")
    return moved(build(m, c, I_c), np.eye(3), -c)


def _steiner(I: Any, R: Any, p: Any) -> Any:
    """Add m (|p|² 1 − p pᵀ) to an inertia that is not about the centre of mass."""
    moved = moved_inertia(I, R, p)
    moved[:3, :3] = R @ I[:3, :3] @ R.mT - I[5, 5] * skew(p) @ skew(p)
    return moved


def _cases(rng: Any) -> Any:
    return [
        (spatial_inertia(*random_body(rng)), exp3(rng.standard_normal(3)), rng.standard_normal(3)) for _ in range(4)
    ]


def _points(rng: Any) -> Any:
    """Return mass, centre of mass and inertia about it of a point, and of a rotor without mass."""
    return [(1.5, rng.standard_normal(3), np.zeros((3, 3))), (0.0, rng.standard_normal(3), np.diag([1.0, 2, 3]))]


def _moved_points(rng: Any) -> Any:
    return [(spatial_inertia(*body), exp3(rng.standard_normal(3)), rng.standard_normal(3)) for body in _points(rng)]


MOVED = Part(
    solution=moved_inertia,
    returns=(Output("I_A", INERTIA),),
    cases=_cases,
    edges=_moved_points,
    slips={
        "inertia-half-rotated": faulty(moved_inertia, ("X_star @ I @ X_inverse", "X_star @ I")),
        "inertia-like-motion": lambda I, R, p: plucker(R, p)[0] @ I @ np.linalg.inv(plucker(R, p)[0]),
        "inverse-transform": lambda I, R, p: plucker(R, p)[0].mT @ I @ plucker(R, p)[0],
        "transpose-for-inverse": lambda I, R, p: plucker(R, p)[1] @ I @ plucker(R, p)[0].mT,
        "motion-for-force": lambda I, R, p: plucker(R, p)[0] @ I @ plucker(R, p)[0].mT,
        "rotation-transposed": lambda I, R, p: moved_inertia(I, R.mT, p),
        "steiner-from-any-point": _steiner,
        "untransformed": lambda I, R, p: I,
        "axes-not-turned": lambda I, R, p: moved_inertia(I, np.eye(3), p),
        "origin-not-moved": lambda I, R, p: moved_inertia(I, R, 0 * p),
    },
    residuals=(
        lambda answer, I, R, p: answer - answer.mT,
        lambda answer, I, R, p: plucker(R, p)[0].mT @ answer @ plucker(R, p)[0] - I,
    ),
)

AT_COM = Part(
    solution=about_center_of_mass,
    given='build, moved = mine("spatial_inertia"), mine("moved_inertia")',
    returns=(Output("I", INERTIA),),
    cases=lambda rng: [random_body(rng) for _ in range(4)],
    edges=_points,
    slips={
        "translation-sign": lambda m, c, I_c: moved_inertia(spatial_inertia(m, c, I_c), np.eye(3), c),
        "untransformed": spatial_inertia,
        "parallel-axis-twice": lambda m, c, I_c: spatial_inertia(m, 0 * c, I_c - 2 * m * skew(c) @ skew(c)),
        "parallel-axis-kept": lambda m, c, I_c: spatial_inertia(m, 0 * c, I_c - m * skew(c) @ skew(c)),
        "mass-dropped": lambda m, c, I_c: spatial_inertia(1.0, 0 * c, I_c),
        "swapped-halves": lambda m, c, I_c: swapped(spatial_inertia)(m, 0 * c, I_c),
    },
    residuals=(lambda answer, m, c, I_c: (answer[:3, 3:], answer[3:, :3]),),
)

EXERCISE = Exercise(id="49.5.3", kind="prove", uses=("plucker",), parts=(MOVED, AT_COM))
