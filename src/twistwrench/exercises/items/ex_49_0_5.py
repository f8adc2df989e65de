"""Exercise 49.0.5: Newton and Euler."""

from typing import Any

import numpy as np

from misstep.exercise import Exercise, Output, Part
from misstep.faults import before

from ..wrong import faulty

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


def _along_its_axes(rng: Any) -> Any:
    return [(1.0, np.diag(rng.uniform(2, 3, 3)), *rng.standard_normal((3, 3)))]


EXERCISE = Exercise(
    id="49.0.5",
    taught="49.5",
    kind="code",
    parts=(
        Part(
            solution=newton_euler,
            returns=(Output("τ", unit="N m"), Output("f", unit="N")),
            cases=_cases,
            edges=_along_its_axes,
            slips={
                "gyroscopic-missing": faulty(newton_euler, (" + np.cross(omega, I_c @ omega)", "")),
                "gyroscopic-sign": faulty(newton_euler, ("+ np.cross", "- np.cross")),
                "cross-order": faulty(newton_euler, ("np.cross(omega, I_c @ omega)", "np.cross(I_c @ omega, omega)")),
                "left-handed-axes": faulty(
                    newton_euler, ("+ np.cross", "+ np.linalg.det(np.linalg.eigh(I_c)[1]) * np.cross")
                ),
                "products-dropped": before(newton_euler, lambda I: np.diag(np.diag(I)), which=1),
                "elementwise-product": faulty(
                    newton_euler, ("I_c @ alpha", "I_c * alpha"), ("I_c @ omega", "I_c * omega")
                ),
                "weight-added": faulty(newton_euler, ("m * a_c", "m * (a_c + np.array([0, 0, 9.81]))")),
                "mass-dropped": faulty(newton_euler, ("m * a_c", "a_c")),
                "swapped-halves": faulty(newton_euler, ("return moment, force", "return force, moment")),
            },
            alike=(frozenset({"gyroscopic-sign", "cross-order"}),),
            residuals=(lambda answer, m, I_c, omega, alpha, a_c: answer[0] @ omega - alpha @ I_c @ omega,),
        ),
    ),
)
