"""Exercise 49.11.3: the forces under a standing robot."""

from functools import cache
from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import before, negated, times

from ..layouts import JOINT_SPACE
from ..robots import larger, robot, small_robot
from ..wrong import faulty

__all__ = ["EXERCISE", "gravity_from_map", "standing_forces", "standing_loads"]


def gravity_from_map(A_G: Any) -> Any:
    """Generalised gravity out of the centroidal momentum matrix."""
    return 9.81 * A_G[5]


def standing_forces(g: Any, J_c: Any) -> Any:
    """Contact forces out of the base's rows, then torques out of the others."""
    forces = np.linalg.lstsq(J_c[:, :6].mT, g[:6])[0]
    tau = (g - J_c.mT @ forces)[6:]
    return forces.reshape(-1, 3), tau


def standing_loads() -> Any:
    """Vertical force on a front and on a rear foot of Go2."""
    model = tw.load("go2")
    q = model.standing()
    g, J_c = tw.gravity(model, q), tw.contact_jacobian(model, q, model.feet)
    forces, _ = standing_forces(g, J_c)
    return forces[0, 2], forces[2, 2]


_loads = cache(standing_loads)


def _postures(rng: Any) -> Any:
    """Return postures: the standing one tilted a little, and any other."""
    model = robot("go2")
    tilted = model.integrate(
        model.standing(), np.concatenate([rng.uniform(-0.3, 0.3, 3), rng.normal(scale=0.2, size=15)])
    )
    return [(model, q) for q in (tilted, model.random_configuration(rng=rng))]


def _arrays(rng: Any) -> Any:
    """Return g and J_c of the postures, on four feet and on three, and of a robot that stands beside its feet."""
    (model, first), (_, second) = _postures(rng)
    standing = ((first, model.feet), (second, model.feet), (first, model.feet[1:]))
    other, posture = larger(rng)[0]
    arrays = [(tw.gravity(model, q), tw.contact_jacobian(model, q, feet)) for q, feet in standing]
    return [*arrays, (tw.gravity(other, posture), tw.contact_jacobian(other, posture, other.joint_names[-3:]))]


def _in_line(rng: Any) -> Any:
    """Return g and J_c of feet in a line and of a single one, on which a robot can stand.

    Their places have few digits: three of the equations are two, exactly.
    """
    cases = []
    for places in ([[0.25, 0.5, -0.5], [-0.25, 0.25, -0.5]], [[0.25, 0.5, -0.5]]):
        columns = [np.hstack([-tw.skew(np.array(p)), np.eye(3)]) for p in places]
        base = np.vstack(columns)
        g = np.concatenate([base.mT @ rng.standard_normal(len(base)), rng.standard_normal(5)])
        cases.append((g, np.hstack([base, rng.standard_normal((len(base), 5))])))
    return cases


def _maps(rng: Any) -> Any:
    """Return A_G of the postures, and of another robot."""
    small = small_robot(rng)
    postures = [*_postures(rng), (small, small.random_configuration(rng=rng))]
    return [(tw.centroidal_map(model, q),) for model, q in postures]


ALL_ROWS = faulty(standing_forces, ("J_c[:, :6].mT, g[:6]", "J_c.mT, g"))
"""Asks the feet for all 18 rows."""

MAP = Part(
    solution=gravity_from_map,
    returns=(Output("g", JOINT_SPACE),),
    cases=_maps,
    edges=lambda rng: [(tw.centroidal_map(*larger(rng)[0]),)],
    slips={
        "gravity-sign": negated(gravity_from_map),
        "angular-for-linear": lambda A_G: 9.81 * A_G[2],
        "mass-for-weight": lambda A_G: A_G[5],
        "mass-twice": lambda A_G: np.linalg.norm(A_G[3:, 3]) * gravity_from_map(A_G),
        "g-ten": times(gravity_from_map, 10 / 9.81),
        "g-rounded": times(gravity_from_map, 9.8 / 9.81),
    },
    residuals=(lambda answer, A_G: np.linalg.norm(answer[3:6]) - 9.81 * np.linalg.norm(A_G[3:, 5]),),
)

FORCES = Part(
    solution=standing_forces,
    returns=(Output("λ", unit="N"), Output("τ", unit="N m")),
    cases=_arrays,
    edges=_in_line,
    slips={
        "torques-left-out": ALL_ROWS,
        "joint-rows-for-forces": faulty(standing_forces, ("J_c[:, :6].mT, g[:6]", "J_c[:, 6:].mT, g[6:]")),
        "equal-shares": faulty(
            standing_forces,
            (
                "np.linalg.lstsq(J_c[:, :6].mT, g[:6])[0]",
                "np.tile([0, 0, 3 * np.linalg.norm(g[3:6]) / len(J_c)], len(J_c) // 3)",
            ),
        ),
        "least-norm-of-both": faulty(
            standing_forces,
            ("J_c[:, :6].mT, g[:6])[0]", "np.hstack([J_c.mT, np.eye(len(g))[:, 6:]]), g)[0][:len(J_c)]"),
        ),
        "vertical-only": before(standing_forces, lambda J_c: J_c * np.resize([[0], [0], [1]], (len(J_c), 1)), which=1),
        "transpose-for-solution": faulty(
            standing_forces, ("np.linalg.lstsq(J_c[:, :6].mT, g[:6])[0]", "J_c[:, :6] @ g[:6]")
        ),
        "axis-by-axis": faulty(standing_forces, ("forces.reshape(-1, 3)", "forces.reshape(3, -1).mT")),
        "contact-missing": faulty(standing_forces, (" - J_c.mT @ forces", "")),
        "external-sign": faulty(standing_forces, ("g - J_c", "g + J_c")),
        "gravity-missing": faulty(standing_forces, ("(g - J_c", "(-J_c")),
        "force-sign": faulty(standing_forces, ("return forces", "return -forces")),
        "base-rows-kept": faulty(standing_forces, (")[6:]", ")")),
    },
    residuals=(
        lambda answer, g, J_c: g - np.concatenate([np.zeros(6), answer[1]]) - J_c.mT @ np.ravel(answer[0]),
        lambda answer, g, J_c: np.ravel(answer[0]) - J_c[:, :6] @ np.linalg.pinv(J_c[:, :6]) @ np.ravel(answer[0]),
    ),
)

LOADS = Part(
    solution=standing_loads,
    returns=(Output("front", unit="N", zh="前脚"), Output("rear", unit="N", zh="后脚")),
    cases=lambda rng: [()],
    rtol=5e-4,
    slips={
        "equal-shares": lambda: (16.085 * 9.81 / 4, 16.085 * 9.81 / 4),
        "torques-left-out": faulty(standing_loads, ("standing_forces(", "ALL_ROWS(")),
        "lever-reversed": lambda: _loads()[::-1],
        "two-front-feet": lambda: _loads()[:1] * 2,
        "nominal-mass": lambda: tuple(12 / 16.085 * f for f in _loads()),
        "mass-for-weight": lambda: tuple(f / 9.81 for f in _loads()),
        "pair-for-foot": lambda: tuple(2 * f for f in _loads()),
        "force-sign": lambda: tuple(-f for f in _loads()),
        "g-ten": lambda: tuple(10 / 9.81 * f for f in _loads()),
        "g-rounded": lambda: tuple(9.8 / 9.81 * f for f in _loads()),
    },
)

EXERCISE = Exercise(id="49.11.3", kind="explain", parts=(MAP, FORCES, LOADS))
