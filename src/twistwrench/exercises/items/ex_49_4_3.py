"""Exercise 49.4.3: the centre of pressure."""

from typing import Any

import numpy as np

from misstep.exercise import Exercise, Output, Part
from misstep.faults import after, before, negated, times

from ..layouts import WRENCH
from ..public import mine
from ..wrong import faulty, swap, swapped

__all__ = ["EXERCISE", "center_of_pressure", "sole_holds", "sole_wrench"]


def sole_wrench(points: Any, forces: Any) -> Any:
    """Sum of the wrenches of several forces."""
    return np.concatenate([np.cross(points, forces).sum(0), forces.sum(0)])


def center_of_pressure(F: Any) -> Any:
    """Point of the sole about which the moment has no x and no y."""
    tau_x, tau_y, _, _, _, f_z = F
    return np.array([-tau_y / f_z, tau_x / f_z])


def sole_holds(F: Any, d_x: Any, d_y: Any) -> Any:
    """Whether the ground can exert a wrench, by pushing on the sole."""
    if F[5] <= 0:
        return False
    p = mine("center_of_pressure")
    p_x, p_y = p(F)
    return bool(abs(p_x) <= d_x and abs(p_y) <= d_y)


def _forces_of(rng: Any, n: int = 4) -> Any:
    """Return points of a sole, and a force on each: the ground pushes."""
    points = np.column_stack([rng.uniform(-1, 1, (n, 2)) * [0.1, 0.05], np.zeros(n)])
    return points, np.column_stack([rng.normal(scale=20, size=(n, 2)), rng.uniform(50, 150, n)])


def _sums(rng: Any) -> Any:
    """Return forces on four points, on more and on fewer; at the end some pull."""
    points, forces = _forces_of(rng, 5)
    return [*(_forces_of(rng, n) for n in (4, 4, 3, 7, 1)), (points, forces * [1, 1, -1])]


def _in_few_points(rng: Any) -> Any:
    """Return forces at opposite points, at two, at three of which two are one, and at one that is the centre."""
    points, forces = _forces_of(rng, 3)
    opposite = np.array([points[0], -points[0]])
    return [
        (opposite, forces[:2]),
        (points[:2], forces[:2]),
        (points[[0, 0, 1]], forces),
        (points * [[1], [1], [0]], forces),
    ]


def _draw_wrenches(rng: Any) -> Any:
    """Return wrenches that push, one that pulls, and some with little force for their moment."""
    wrenches = [sign * sole_wrench(*_forces_of(rng)) for sign in (1, 1, 1, -1)]
    return [(F,) for F in (*wrenches, *(wrenches[0] * [1, 1, 1, 1, 1, part] for part in (1e-2, 1e-4, 1e-6)))]


def _at(p_x: float, p_y: float, f_z: float, rng: Any) -> Any:
    """Return a wrench with a given centre of pressure, and the half lengths of a sole."""
    f_x, f_y, tau_z = rng.normal(scale=[20, 20, 2])
    return np.array([p_y * f_z, -p_x * f_z, tau_z, f_x, f_y, f_z]), 0.1, 0.04


def _wrenches(rng: Any) -> Any:
    """Return wrenches in the middle, outside each edge and near it, and one with a twist; then the limits."""
    near, far = rng.uniform(0.6, 0.9), rng.uniform(1.2, 2.0)
    places = [(0.3, 0.3), (near, 0.2), (0.2, -near), (far, 0.3), (-far, 0.2), (0.3, far), (0.2, -far), (-0.2, 0.3)]
    places += [(0.75, 0.1), (0.1, 0.75), (0.9, 1.9), (1.9, 0.9), (0.9, 0.9), (0.05, 0.1), (-0.1, -0.05)]
    twist = np.array([0, -0.2 * 100, 3.0, 0.01, 0.01, 100]), 0.1, 0.04
    pushes = [_at(0.1 * x, 0.04 * y, rng.uniform(100, 400), rng) for x, y in places]
    return [
        *pushes,
        _at(0.07, 0.03, 300.0, rng),
        twist,
        *((F, 0.04, 0.1) for F, _, _ in pushes[:4]),  # wider than long
        *_edges(rng),
        *_pressures(rng),
    ]


def _edges(rng: Any) -> Any:
    """Return wrenches on each edge, and a little within and outside it. Powers of two: the division is exact."""
    places = [(0.125, 0.01), (-0.125, 0.01), (0.05, 0.0625), (0.05, -0.0625)]
    near = [1 + sign * part for part in (2.0**-20, 2.0**-44) for sign in (-1, 1)]
    factors = [(1.0, 1.0), *((x, 1.0) for x in near), *((1.0, x) for x in near)]
    wrenches = [_at(x, y, 256.0, rng)[0] for x, y in places]
    return [(F * [b, a, 1, 1, 1, 1], 0.125, 0.0625) for F in wrenches for a, b in factors]


def _pressures(rng: Any) -> Any:
    """Return wrenches that hardly push or pull, in the middle and beside the sole, and those that do neither."""
    little, places = (0.3, 1e-3, 1e-6, 1e-12, 1e-300), ((0.05, 0.02), (0.15, 0.06))
    pushes = [_at(*place, f_z, rng) for f_z in little for place in places]
    pulls = [_at(0.01, 0.01, f_z, rng) for f_z in (-rng.uniform(100, 400), -1e-3, -1e-6)]
    moments = ((0, 0), (1, 2), (1, 0), (0, -1))
    nothing = np.zeros(6), *(np.array([*moment, 1, 2, 3, 0.0]) for moment in moments)
    return [*pushes, *pulls, *((F, 0.1, 0.04) for F in nothing)]


SUM = Part(
    solution=sole_wrench,
    returns=(Output("F", WRENCH),),
    cases=_sums,
    edges=_in_few_points,
    slips={
        "cross-order": faulty(sole_wrench, ("points, forces)", "forces, points)")),
        "lever-reversed": before(sole_wrench, np.negative, which=0),
        "coupling-dropped": before(sole_wrench, np.zeros_like, which=0),
        "swapped-halves": swapped(sole_wrench),
        "averaged": faulty(sole_wrench, (".sum(0), forces.sum(0)", ".mean(0), forces.mean(0)")),
        "single-force": lambda points, forces: sole_wrench(points.mean(0)[None], forces.sum(0)[None]),
        "product-of-sums": lambda points, forces: sole_wrench(points.sum(0)[None], forces.sum(0)[None]),
        "horizontal-moment-left-out": after(sole_wrench, lambda F: F * [1, 1, 0, 1, 1, 1]),
        "pressure-only": before(sole_wrench, lambda forces: forces * [0, 0, 1], which=1),
        "force-sign": negated(sole_wrench),
    },
    alike=(frozenset({"cross-order", "lever-reversed"}),),
    residuals=(
        lambda answer, points, forces: answer[3:] - forces.sum(0),
        lambda answer, points, forces: answer[2] - np.cross(points, forces)[:, 2].sum(),
    ),
)

PRESSURE = Part(
    solution=center_of_pressure,
    returns=(Output("p", unit="m"),),
    cases=_draw_wrenches,
    slips={
        "cop-sign": faulty(center_of_pressure, ("-tau_y", "tau_y")),
        "cop-axes": lambda F: F[:2] / F[5],
        "cop-coordinates": after(center_of_pressure, lambda p: p[::-1]),
        "lever-reversed": negated(center_of_pressure),
        "cop-inverted": after(center_of_pressure, lambda p: 1 / p),
        "cop-multiplied": lambda F: F[5] ** 2 * center_of_pressure(F),
        "central-axis": lambda F: np.cross(F[3:], F[:3])[:2] / (F[3:] @ F[3:]),
        "cop-not-divided": lambda F: F[5] * center_of_pressure(F),
        "cop-whole-force": lambda F: center_of_pressure(F) * F[5] / np.linalg.norm(F[3:]),
        "swapped-halves": before(center_of_pressure, swap, which=0),
        "thousand": times(center_of_pressure, 1000),
    },
    residuals=(lambda answer, F: (F[:3] - np.cross([*answer, 0], F[3:]))[:2],),
)

HOLDS = Part(
    solution=sole_holds,
    returns=(Output("holds", zh="能否支撑"),),
    cases=_wrenches,
    given='p = mine("center_of_pressure")',
    slips={
        "cop-axes": faulty(sole_holds, ("p_x, p_y =", "p_y, p_x =")),
        "pulling-allowed": faulty(sole_holds, ("F[5] <= 0", "F[5] == 0")),
        "no-pressure-allowed": faulty(sole_holds, ("return False", "return bool(not F[5] and not F[:2].any())")),
        "ellipse-for-rectangle": faulty(
            sole_holds, ("abs(p_x) <= d_x and abs(p_y) <= d_y", "(p_x / d_x) ** 2 + (p_y / d_y) ** 2 <= 1")
        ),
        "kern-for-sole": faulty(
            sole_holds, ("abs(p_x) <= d_x and abs(p_y) <= d_y", "3 * (abs(p_x / d_x) + abs(p_y / d_y)) <= 1")
        ),
        "full-for-half": lambda F, d_x, d_y: sole_holds(F, d_x / 2, d_y / 2),
        "one-sided": faulty(sole_holds, ("abs(p_x)", "p_x"), ("abs(p_y)", "p_y")),
        "either-for-both": faulty(sole_holds, (" and ", " or ")),
        "cop-not-divided": faulty(sole_holds, ("= p(F)", "= F[1], F[0]")),
        "edge-excluded": faulty(sole_holds, ("abs(p_x) <=", "abs(p_x) <"), ("abs(p_y) <=", "abs(p_y) <")),
        "edge-tolerance": faulty(sole_holds, ("<= d_x and", "<= d_x + 1e-9 and"), ("<= d_y)", "<= d_y + 1e-9)")),
        "pressure-threshold": faulty(sole_holds, ("F[5] <= 0", "F[5] <= 1e-9")),
        "swapped-halves": before(sole_holds, swap, which=0),
    },
)

EXERCISE = Exercise(id="49.4.3", kind="explain", parts=(SUM, PRESSURE, HOLDS))
