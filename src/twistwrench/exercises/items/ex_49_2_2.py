"""Exercise 49.2.2: an exact exponential."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Quantity
from ..layouts import POSE
from ..wrong import before, transposed

__all__ = ["EXERCISE", "arc", "twist_matrix"]


def twist_matrix(omega_z: Any, v_x: Any) -> Any:
    """[V]∧ of a twist in the plane."""
    return np.array([[0, -omega_z, 0, v_x], [omega_z, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]])


def arc(omega_z: Any, v_x: Any) -> Any:
    """Placement after one second."""
    c, s = np.cos(omega_z), np.sin(omega_z)
    x, y = v_x * s / omega_z, v_x * (1 - c) / omega_z
    return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]])


def _moved(omega_z: Any, v_x: Any, x: Any, y: Any) -> Any:
    """Put other numbers in the place of the translation."""
    T = arc(omega_z, v_x)
    T[0, 3], T[1, 3] = x, y
    return T


def _exponential_of_blocks(omega_z: Any, v_x: Any) -> Any:
    return np.exp(twist_matrix(omega_z, v_x))


def _cases(rng: Any) -> Any:
    return [(float(rng.uniform(0.5, 2.5)), float(rng.uniform(0.5, 2.0))) for _ in range(4)]


MATRIX = Part(
    solution=twist_matrix,
    returns=(Quantity("[V]∧", POSE),),
    cases=_cases,
    slips={
        "hat-one": lambda omega_z, v_x: twist_matrix(omega_z, v_x) + np.diag([0, 0, 0, 1]),
        "skew-sign": lambda omega_z, v_x: twist_matrix(-omega_z, v_x),
        "skew-symmetric": lambda omega_z, v_x: np.abs(twist_matrix(omega_z, v_x)),
        "transposed-answer": transposed(twist_matrix),
        "swapped-halves": lambda omega_z, v_x: tw.hat([v_x, 0, 0, 0, 0, omega_z]),
    },
    residuals=(lambda answer, omega_z, v_x: answer[3],),
)

ARC = Part(
    solution=arc,
    returns=(Quantity("T", POSE),),
    cases=_cases,
    slips={
        "first-order-exp": lambda omega_z, v_x: np.eye(4) + twist_matrix(omega_z, v_x),
        "second-order-exp": lambda omega_z, v_x: (
            np.eye(4) + twist_matrix(omega_z, v_x) + twist_matrix(omega_z, v_x) @ twist_matrix(omega_z, v_x) / 2
        ),
        "elementwise-exp": _exponential_of_blocks,
        "exp-straight": lambda omega_z, v_x: _moved(omega_z, v_x, v_x, 0),
        "exp-turned": lambda omega_z, v_x: _moved(omega_z, v_x, v_x * np.cos(omega_z), v_x * np.sin(omega_z)),
        "exp-minus": lambda omega_z, v_x: _moved(omega_z, v_x, arc(omega_z, v_x)[0, 3], -arc(omega_z, v_x)[1, 3]),
        "rotation-transposed": lambda omega_z, v_x: np.block(
            [[arc(omega_z, v_x)[:3, :3].mT, arc(omega_z, v_x)[:3, 3:]], [np.eye(4)[3:]]]
        ),
        "inverse-transform": lambda omega_z, v_x: np.linalg.inv(arc(omega_z, v_x)),
        "degrees": before(arc, np.radians, which=0),
    },
    residuals=(
        lambda answer, omega_z, v_x: answer[:3, :3].mT @ answer[:3, :3] - np.eye(3),
        lambda answer, omega_z, v_x: tw.log6(answer) - [0, 0, omega_z, v_x, 0, 0],
    ),
)

EXERCISE = Exercise(
    id="49.2.2",
    kind="code",
    parts=(MATRIX, ARC),
)
