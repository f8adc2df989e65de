"""Exercise 49.11.1, continued: inertia and transform in Pinocchio's order (tests 3 and 4)."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Part, Quantity
from ..layouts import PINOCCHIO_INERTIA, PINOCCHIO_TRANSFORM
from ..robots import robot
from ..wrong import swap, swapped

__all__ = ["ACTION", "INERTIA_MATRIX", "pinocchio_action", "pinocchio_inertia"]


def pinocchio_inertia(m: Any, c: Any, I_c: Any) -> Any:
    """Spatial inertia in the order (v, ω) (test 3)."""
    cx = tw.skew(c)
    return np.block([[m * np.eye(3), -m * cx], [m * cx, I_c - m * cx @ cx]])


def pinocchio_action(R: Any, p: Any) -> Any:
    """X in the order (v, ω) (test 4)."""
    return np.block([[R, tw.skew(p) @ R], [np.zeros((3, 3)), R]])


def _quarters(change: Any) -> Any:
    """Put other things into the quarters of the inertia: m, [c]× and I_c."""
    return lambda m, c, I_c: np.block(change(m * np.eye(3), m * tw.skew(c), I_c, tw.skew(c)))


def _inertias(rng: Any) -> Any:
    bodies = [robot("go2").inertia[i] for i in rng.choice(np.arange(1, 14), 3, replace=False)]
    return [(float(body.mass), np.array(body.com), np.array(body.inertia_at_com)) for body in bodies]


INERTIA_MATRIX = Part(
    solution=pinocchio_inertia,
    returns=(Quantity("I", PINOCCHIO_INERTIA),),
    cases=_inertias,
    slips={
        "swapped-halves": swapped(pinocchio_inertia),
        "com-sign": _quarters(lambda m, mc, I, c: [[m, mc], [-mc, I - mc @ c]]),
        "inertia-asymmetric": _quarters(lambda m, mc, I, c: [[m, mc], [mc, I - mc @ c]]),
        "com-dropped": _quarters(lambda m, mc, I, c: [[m, 0 * mc], [0 * mc, I]]),
        "parallel-axis-dropped": _quarters(lambda m, mc, I, c: [[m, -mc], [mc, I]]),
        "parallel-axis-sign": _quarters(lambda m, mc, I, c: [[m, -mc], [mc, I + mc @ c]]),
        "mass-dropped": _quarters(lambda m, mc, I, c: [[m, -c], [c, I - c @ c]]),
    },
    residuals=(lambda answer, m, c, I_c: answer - answer.mT,),
)

ACTION = Part(
    solution=pinocchio_action,
    returns=(Quantity("X", PINOCCHIO_TRANSFORM),),
    cases=lambda rng: [(tw.exp3(rng.standard_normal(3)), rng.standard_normal(3)) for _ in range(3)],
    slips={
        "swapped-halves": swapped(pinocchio_action),
        "force-for-motion": lambda R, p: swap(pinocchio_action(R, p)),
        "coupling-dropped": lambda R, p: pinocchio_action(R, 0 * p),
        "coupling-sign": lambda R, p: pinocchio_action(R, -p),
        "coupling-order": lambda R, p: pinocchio_action(R, R @ p),
        "coupling-unrotated": lambda R, p: np.block([[R, tw.skew(p)], [np.zeros((3, 3)), R]]),
        "rotation-transposed": lambda R, p: pinocchio_action(R.mT, p),
    },
    alike=(frozenset({"swapped-halves", "force-for-motion"}),),  # X* has [p]× R where X in the other order has it
)
