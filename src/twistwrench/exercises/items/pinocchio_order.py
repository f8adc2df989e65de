"""Exercise 49.11.1, continued: inertia and transform in Pinocchio's order (tests 3 and 4)."""

from functools import partial
from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Output, Part
from misstep.faults import before

from ..layouts import PINOCCHIO_INERTIA, PINOCCHIO_TRANSFORM
from ..robots import robot
from ..wrong import faulty, swap, swapped

__all__ = ["ACTION", "INERTIA_MATRIX", "pinocchio_action", "pinocchio_inertia"]


def pinocchio_inertia(m: Any, c: Any, I_c: Any) -> Any:
    """Spatial inertia in the order (v, ω) (test 3)."""
    cx = tw.skew(c)
    return np.block([[m * np.eye(3), -m * cx], [m * cx, I_c - m * cx @ cx]])


def pinocchio_action(R: Any, p: Any) -> Any:
    """X in the order (v, ω) (test 4)."""
    return np.block([[R, tw.skew(p) @ R], [np.zeros((3, 3)), R]])


_inertia = partial(faulty, pinocchio_inertia)


def _inertias(rng: Any) -> Any:
    bodies = [robot("go2").inertia[i] for i in rng.choice(np.arange(1, 14), 3, replace=False)]
    return [(float(body.mass), np.array(body.com), np.array(body.inertia_at_com)) for body in bodies]


INERTIA_MATRIX = Part(
    solution=pinocchio_inertia,
    returns=(Output("I", PINOCCHIO_INERTIA),),
    cases=_inertias,
    slips={
        "swapped-halves": swapped(pinocchio_inertia),
        "rows-only": lambda m, c, I_c: np.array([*map(swap, pinocchio_inertia(m, c, I_c))]),
        "com-sign": _inertia(("-m * cx], [m", "m * cx], [-m")),
        "inertia-asymmetric": _inertia(("-m * cx]", "m * cx]")),
        "both-blocks-negative": _inertia(("[m * cx", "[-m * cx")),
        "com-dropped": _inertia(("tw.skew(c)", "0 * tw.skew(c)")),
        "parallel-axis-dropped": _inertia((" - m * cx @ cx", "")),
        "parallel-axis-sign": _inertia(("I_c - m", "I_c + m")),
        "parallel-axis-all": _inertia(("- m * cx @ cx", "+ m * (c @ c) * np.eye(3)")),
        "parallel-axis-outer": _inertia(("- m * cx @ cx", "+ m * np.outer(c, c)")),
        "products-sign": before(pinocchio_inertia, lambda I_c: 2 * np.diag(np.diag(I_c)) - I_c, which=2),
        "mass-dropped": _inertia(("-m * cx], [m * cx, I_c - m * cx", "-cx], [cx, I_c - cx")),
    },
    residuals=(lambda answer, m, c, I_c: answer - answer.mT,),
)

ACTION = Part(
    solution=pinocchio_action,
    returns=(Output("X", PINOCCHIO_TRANSFORM),),
    cases=lambda rng: [(tw.exp3(rng.standard_normal(3)), rng.standard_normal(3)) for _ in range(3)],
    slips={
        "swapped-halves": swapped(pinocchio_action),
        "rows-only": lambda R, p: np.array([*map(swap, pinocchio_action(R, p))]),
        "transposed-for-reordered": lambda R, p: swap(pinocchio_action(R, p)).mT,
        "force-for-motion": lambda R, p: swap(pinocchio_action(R, p)),
        "coupling-dropped": lambda R, p: pinocchio_action(R, 0 * p),
        "coupling-sign": lambda R, p: pinocchio_action(R, -p),
        "coupling-order": lambda R, p: pinocchio_action(R, R @ p),
        "coupling-unrotated": lambda R, p: np.block([[R, tw.skew(p)], [np.zeros((3, 3)), R]]),
        "rotation-transposed": lambda R, p: pinocchio_action(R.mT, p),
    },
    alike=(frozenset({"swapped-halves", "force-for-motion"}),),  # X* has [p]× R where X in the other order has it
    residuals=(lambda answer, R, p: answer[:3, :3] - R, lambda answer, R, p: answer[3:, :3]),
)
