"""Exercise 49.4.2: a point contact, seen from the world."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part

from ...spatial import exp3
from ..layouts import WRENCH
from ..wrong import faulty, swapped
from .ex_49_3_2 import plucker

__all__ = ["EXERCISE", "contact_wrench"]


def contact_wrench(R: Any, p: Any, f_c: Any) -> Any:
    """Wrench of a point contact in the world, by vectors and by X*."""
    f = R @ f_c
    by_vectors = np.concatenate([np.cross(p, f), f])
    _, X_star = plucker(R, p)
    by_matrix = X_star @ np.concatenate([np.zeros(3), f_c])
    return by_vectors, by_matrix


def _cases(rng: Any) -> Any:
    return [(exp3(rng.standard_normal(3)), *rng.standard_normal((2, 3))) for _ in range(5)]


def _power(answer: Any, R: Any, p: Any, f_c: Any) -> Any:
    """Return by how much the power on some twists differs between the frames."""
    V_contact = np.arange(36.0).reshape(6, 6) % 7 - 3
    V_world = V_contact @ tw.motion_transform(R, p).mT
    return answer[0] @ V_world.mT - f_c @ V_contact[:, 3:].mT


WRENCH_OF_CONTACT = Part(
    solution=contact_wrench,
    returns=(Output("F by vectors", WRENCH, zh="用矢量求得的 F"), Output("F by X*", WRENCH, zh="用 X* 求得的 F")),
    cases=_cases,
    slips={
        "coupling-dropped": faulty(contact_wrench, ("np.cross(p, f)", "np.zeros(3)")),
        "cross-order": faulty(contact_wrench, ("np.cross(p, f)", "np.cross(f, p)")),
        "lever-reversed": faulty(contact_wrench, ("np.cross(p, f)", "np.cross(-p, f)")),
        "coupling-order": faulty(contact_wrench, ("np.cross(p, f)", "R @ np.cross(p, f_c)")),
        "coupling-unrotated": faulty(contact_wrench, ("np.cross(p, f)", "np.cross(p, f_c)")),
        "rotation-transposed": lambda R, p, f_c: contact_wrench(R.mT, p, f_c),
        "untransformed": lambda R, p, f_c: (np.concatenate([np.zeros(3), f_c]),) * 2,
        "swapped-halves": swapped(contact_wrench),
        "force-for-moment": faulty(
            contact_wrench, ("np.concatenate([np.zeros(3), f_c])", "np.concatenate([f_c, np.zeros(3)])")
        ),
        "motion-for-force": faulty(contact_wrench, ("_, X_star =", "X_star, _ =")),
        "transpose-for-dual": faulty(contact_wrench, ("X_star @", "plucker(R, p)[0].mT @")),
        "inverse-transform": lambda R, p, f_c: contact_wrench(R.mT, -R.mT @ p, f_c),
        "opposite-placement": lambda R, p, f_c: contact_wrench(R.mT, -p, f_c),
    },
    alike=(frozenset({"cross-order", "lever-reversed"}),),
    residuals=(
        lambda answer, R, p, f_c: answer[0] - answer[1],
        lambda answer, R, p, f_c: answer[0][:3] @ answer[0][3:],
        lambda answer, R, p, f_c: answer[1][:3] - np.cross(p, answer[1][3:]),
        _power,
    ),
)

EXERCISE = Exercise(id="49.4.2", kind="prove", uses=("plucker",), parts=(WRENCH_OF_CONTACT,))
