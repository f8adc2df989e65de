"""Exercise 49.2.2: an exact exponential."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import after, before, transposed

from ..layouts import POSE
from ..wrong import faulty

__all__ = ["EXERCISE", "arc", "twist_matrix"]


def twist_matrix(omega_z: Any, v_x: Any) -> Any:
    """[V]∧ of a twist in the plane."""
    return np.array([[0, -omega_z, 0, v_x], [omega_z, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]])


def arc(omega_z: Any, v_x: Any) -> Any:
    """Placement after one second."""
    c, s = np.cos(omega_z), np.sin(omega_z)
    x, y = v_x * s / omega_z, v_x * (1 - c) / omega_z
    return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]])


def _cases(rng: Any) -> Any:
    """Return turns to the left and to the right, forward and backward; then slower ones, each decade down to 1e-7."""
    signs = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
    turns = [(a * float(rng.uniform(0.5, 2.5)), b * float(rng.uniform(0.5, 2.0))) for a, b in signs]
    slow = [
        (float(rng.choice([-1, 1]) * rng.uniform(0.4, 0.9) * 10.0**-k), float(rng.uniform(0.5, 2))) for k in range(7)
    ]
    return [*turns, *slow]


MATRIX = Part(
    solution=twist_matrix,
    returns=(Output("[V]∧", POSE),),
    cases=_cases,
    slips={
        "hat-one": faulty(twist_matrix, ("[0, 0, 0, 0]]", "[0, 0, 0, 1]]")),
        "skew-sign": lambda omega_z, v_x: twist_matrix(-omega_z, v_x),
        "skew-symmetric": faulty(twist_matrix, ("-omega_z", "omega_z")),
        "transposed-answer": transposed(twist_matrix),
        "hat-row": faulty(twist_matrix, ("0, v_x]", "0, 0]"), ("[0, 0, 0, 0]]", "[v_x, 0, 0, 0]]")),
        "hat-filled": faulty(
            twist_matrix, ("[omega_z, 0, 0, 0], [0, 0, 0, 0], [", "[omega_z, 0, 0, v_x], [0, 0, 0, v_x], [")
        ),
        "hat-as-operator": lambda omega_z, v_x: tw.cross_motion([0, 0, omega_z, v_x, 0, 0]),
        "swapped-halves": lambda omega_z, v_x: tw.hat([v_x, 0, 0, 0, 0, omega_z]),
    },
    residuals=(lambda answer, omega_z, v_x: answer[3],),
)

ARC = Part(
    solution=arc,
    returns=(Output("T", POSE),),
    cases=_cases,
    slips={
        "first-order-exp": lambda *V: np.eye(4) + twist_matrix(*V),
        "second-order-exp": lambda *V: np.eye(4) + twist_matrix(*V) + twist_matrix(*V) @ twist_matrix(*V) / 2,
        "elementwise-exp": lambda *V: np.exp(twist_matrix(*V)),
        "exp-straight": faulty(arc, ("v_x * s / omega_z, v_x * (1 - c) / omega_z", "v_x, 0")),
        "exp-turned": faulty(arc, ("v_x * s / omega_z, v_x * (1 - c) / omega_z", "v_x * c, v_x * s")),
        "arc-for-chord": faulty(
            arc,
            ("v_x * s / omega_z, v_x * (1 - c) / omega_z", "v_x * np.cos(omega_z / 2), v_x * np.sin(omega_z / 2)"),
        ),
        "screw-unscaled": faulty(arc, ("v_x * s / omega_z, v_x * (1 - c) / omega_z", "v_x * s, v_x * (1 - c)")),
        "sinc-of-pi": faulty(arc, ("v_x * s / omega_z", "v_x * np.sinc(omega_z)")),
        "chord-sinc-of-pi": faulty(
            arc,
            ("v_x * s / omega_z", "v_x * np.sinc(omega_z / 2) * np.cos(omega_z / 2)"),
            ("v_x * (1 - c) / omega_z", "v_x * np.sinc(omega_z / 2) * np.sin(omega_z / 2)"),
        ),
        "translation-sign": faulty(arc, ("v_x * s /", "-v_x * s /"), ("v_x * (1", "-v_x * (1")),
        "transposed-answer": transposed(arc),
        "exp-minus": faulty(arc, ("(1 - c)", "(c - 1)")),
        "rotation-transposed": faulty(arc, ("[c, -s, 0, x], [s, c, 0, y]", "[c, s, 0, x], [-s, c, 0, y]")),
        "inverse-transform": after(arc, np.linalg.inv),
        "degrees": before(arc, np.radians, which=0),
    },
    residuals=(
        lambda answer, omega_z, v_x: answer[:3, :3].mT @ answer[:3, :3] - np.eye(3),
        lambda answer, omega_z, v_x: (tw.log6(answer) - [0, 0, omega_z, v_x, 0, 0]) * (abs(omega_z) < np.pi),
    ),
)

EXERCISE = Exercise(id="49.2.2", kind="code", parts=(MATRIX, ARC))
