"""Exercise 49.4.2: a point contact, seen from the world."""

from typing import Any

import numpy as np

import twistwrench as tw

from ...spatial import exp3
from ..exercise import Exercise, Part, Quantity
from ..layouts import WRENCH
from ..wrong import swapped
from .ex_49_3_2 import plucker

__all__ = ["EXERCISE", "contact_wrench"]


def contact_wrench(R: Any, p: Any, f_c: Any) -> Any:
    """Wrench of a point contact in the world, by vectors and by X*."""
    f = R @ f_c
    by_vectors = np.concatenate([np.cross(p, f), f])
    _, X_star = plucker(R, p)
    by_matrix = X_star @ np.concatenate([np.zeros(3), f_c])
    return by_vectors, by_matrix


def _vectors(moment: Any, force: Any, R: Any, p: Any, f_c: Any) -> Any:
    """Put other vectors into the first answer."""
    return np.concatenate([moment, force]), contact_wrench(R, p, f_c)[1]


def _matrix(X: Any, R: Any, p: Any, f_c: Any) -> Any:
    """Use another matrix for the second answer."""
    return contact_wrench(R, p, f_c)[0], X @ np.concatenate([np.zeros(3), f_c])


def _cases(rng: Any) -> Any:
    return [(exp3(rng.standard_normal(3)), *rng.standard_normal((2, 3))) for _ in range(5)]


def _power(answer: Any, R: Any, p: Any, f_c: Any) -> Any:
    """Return by how much the power on some twists differs between the frames."""
    V_contact = np.arange(36.0).reshape(6, 6) % 7 - 3
    V_world = V_contact @ tw.motion_transform(R, p).mT
    return answer[0] @ V_world.mT - f_c @ V_contact[:, 3:].mT


WRENCH_OF_CONTACT = Part(
    solution=contact_wrench,
    returns=(Quantity("F by vectors", WRENCH), Quantity("F by X*", WRENCH)),
    cases=_cases,
    slips={
        "coupling-dropped": lambda R, p, f_c: _vectors(np.zeros(3), R @ f_c, R, p, f_c),
        "cross-order": lambda R, p, f_c: _vectors(np.cross(R @ f_c, p), R @ f_c, R, p, f_c),
        "coupling-order": lambda R, p, f_c: _vectors(R @ np.cross(p, f_c), R @ f_c, R, p, f_c),
        "coupling-unrotated": lambda R, p, f_c: _vectors(np.cross(p, f_c), R @ f_c, R, p, f_c),
        "rotation-transposed": lambda R, p, f_c: contact_wrench(R.mT, p, f_c),
        "untransformed": lambda R, p, f_c: (np.concatenate([np.zeros(3), f_c]),) * 2,
        "swapped-halves": swapped(contact_wrench),
        "motion-for-force": lambda R, p, f_c: _matrix(plucker(R, p)[0], R, p, f_c),
        "transpose-for-dual": lambda R, p, f_c: _matrix(plucker(R, p)[0].mT, R, p, f_c),
        "inverse-transform": lambda R, p, f_c: contact_wrench(R.mT, -R.mT @ p, f_c),
        "inverse-unrotated": lambda R, p, f_c: contact_wrench(R.mT, -p, f_c),
    },
    residuals=(
        lambda answer, R, p, f_c: answer[0] - answer[1],
        lambda answer, R, p, f_c: answer[0][:3] @ answer[0][3:],
        lambda answer, R, p, f_c: answer[1][:3] - np.cross(p, answer[1][3:]),
        _power,
    ),
)

EXERCISE = Exercise(
    id="49.4.2",
    kind="prove",
    uses=("plucker",),
    parts=(WRENCH_OF_CONTACT,),
)
