"""The project, stage 1, continued: transforms and cross operators, and how they go wrong."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Output, Part

from ..layouts import FORCE_TRANSFORM, MOTION_TRANSFORM
from ..wrong import faulty, swap, swapped

__all__ = ["CROSS", "TRANSFORMS", "cross_operators", "transforms_of"]


def transforms_of(T: Any) -> Any:
    """X and X* of a placement."""
    R, zero = T[:3, :3], np.zeros((3, 3))
    coupling = tw.skew(T[:3, 3]) @ R
    return np.block([[R, zero], [coupling, R]]), np.block([[R, coupling], [zero, R]])


def cross_operators(V: Any) -> Any:
    """V× and V×*."""
    w, v, zero = tw.skew(V[:3]), tw.skew(V[3:]), np.zeros((3, 3))
    return np.block([[w, zero], [v, w]]), np.block([[w, v], [zero, w]])


def _pose(rng: Any) -> Any:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = tw.exp3(rng.standard_normal(3)), rng.standard_normal(3)
    return T


TRANSFORMS = Part(
    solution=transforms_of,
    rtol=1e-12,
    returns=(Output("X", MOTION_TRANSFORM), Output("X*", FORCE_TRANSFORM)),
    cases=lambda rng: [(_pose(rng),) for _ in range(4)],
    slips={
        "coupling-dropped": faulty(transforms_of, ("coupling = tw", "coupling = 0 * tw")),
        "coupling-sign": faulty(transforms_of, ("coupling = tw", "coupling = -tw")),
        "coupling-order": faulty(transforms_of, ("tw.skew(T[:3, 3]) @ R", "R @ tw.skew(T[:3, 3])")),
        "coupling-unrotated": faulty(transforms_of, ("tw.skew(T[:3, 3]) @ R", "tw.skew(T[:3, 3])")),
        "coupling-corner": lambda T: transforms_of(T)[::-1],
        "transpose-for-dual": lambda T: (transforms_of(T)[0], transforms_of(T)[0].mT),
        "inverse-for-dual": lambda T: (transforms_of(T)[0], np.linalg.inv(transforms_of(T)[0])),
        "motion-for-force": lambda T: (transforms_of(T)[0],) * 2,
        "inverse-transform": lambda T: transforms_of(np.linalg.inv(T)),
        "rotation-transposed": faulty(transforms_of, ("R, zero = T[:3, :3]", "R, zero = T[:3, :3].mT")),
        "swapped-halves": swapped(transforms_of, only=(0,)),
        "half-rotated": faulty(
            transforms_of, ("[coupling, R]", "[coupling, np.eye(3)]"), ("[zero, R]", "[zero, np.eye(3)]")
        ),
    },
    residuals=(lambda answer, T: answer[1].mT @ answer[0] - np.eye(6),),
)


CROSS = Part(
    solution=cross_operators,
    rtol=1e-12,
    returns=(Output("V×", MOTION_TRANSFORM), Output("V×*", FORCE_TRANSFORM)),
    cases=lambda rng: [(rng.standard_normal(6),) for _ in range(4)],
    slips={
        "motion-cross-for-force": lambda V: (cross_operators(V)[0],) * 2,
        "cross-transposed": lambda V: (cross_operators(V)[0], cross_operators(V)[0].mT),
        "cross-negated": lambda V: (cross_operators(V)[0], -cross_operators(V)[0]),
        "cross-like-dual": lambda V: (cross_operators(V)[0], np.linalg.pinv(cross_operators(V)[0]).mT),
        "coupling-corner": lambda V: cross_operators(V)[::-1],
        "coupling-dropped": lambda V: cross_operators(V * np.repeat([1, 0], 3)),
        "skew-sign": faulty(cross_operators, ("tw.skew(V[:3]), tw.skew(V[3:])", "-tw.skew(V[:3]), -tw.skew(V[3:])")),
        "swapped-halves": lambda V: cross_operators(swap(V)),
    },
    residuals=(
        lambda answer, V: answer[0] @ V,
        lambda answer, V: answer[1] + answer[0].mT,
    ),
)
