"""Exercise 49.0.5: Newton and Euler."""

from typing import Any

import numpy as np

from ..exercise import Exercise, Part, Quantity

__all__ = ["EXERCISE", "newton_euler"]


def newton_euler(m: Any, I_c: Any, omega: Any, alpha: Any, a_c: Any) -> Any:
    """Moment about the centre of mass, and force."""
    moment = I_c @ alpha + np.cross(omega, I_c @ omega)
    force = m * a_c
    return moment, force


def _inertia(rng: Any) -> Any:
    """Return an inertia that a body can have: of five points of mass."""
    points = rng.standard_normal((5, 3))
    return sum((x @ x) * np.eye(3) - np.outer(x, x) for x in points)


def _cases(rng: Any) -> Any:
    return [(float(rng.uniform(1, 5)), _inertia(rng), *rng.standard_normal((3, 3))) for _ in range(5)]


EXERCISE = Exercise(
    id="49.0.5",
    kind="code",
    parts=(
        Part(
            solution=newton_euler,
            returns=(Quantity("τ", unit="N m"), Quantity("f", unit="N")),
            cases=_cases,
            slips={
                "gyroscopic-missing": lambda m, I_c, omega, alpha, a_c: (I_c @ alpha, m * a_c),
                "gyroscopic-sign": lambda m, I_c, omega, alpha, a_c: (
                    I_c @ alpha - np.cross(omega, I_c @ omega),
                    m * a_c,
                ),
                "cross-order": lambda m, I_c, omega, alpha, a_c: (
                    I_c @ alpha + np.cross(I_c @ omega, omega),
                    m * a_c,
                ),
                "mass-dropped": lambda m, I_c, omega, alpha, a_c: (
                    newton_euler(m, I_c, omega, alpha, a_c)[0],
                    a_c,
                ),
                "swapped-halves": lambda m, I_c, omega, alpha, a_c: newton_euler(m, I_c, omega, alpha, a_c)[::-1],
            },
            alike=(frozenset({"gyroscopic-sign", "cross-order"}),),
            residuals=(lambda answer, m, I_c, omega, alpha, a_c: answer[0] @ omega - alpha @ I_c @ omega,),
        ),
    ),
)
