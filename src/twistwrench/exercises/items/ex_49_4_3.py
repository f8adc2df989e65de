"""Exercise 49.4.3: the centre of pressure."""

from typing import Any

import numpy as np

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import WRENCH
from ..text import Text
from ..workbook import mine
from ..wrong import before, negated, swap, swapped

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


def _forces_of(rng: Any) -> Any:
    """Return four points of a sole, and a force on each: the ground pushes."""
    points = np.column_stack([rng.uniform(-1, 1, (4, 2)) * [0.1, 0.05], np.zeros(4)])
    return points, np.column_stack([rng.normal(scale=20, size=(4, 2)), rng.uniform(50, 150, 4)])


def _edges(F: Any, d_x: Any, d_y: Any) -> Any:
    """Return for each axis whether the pressure is within: below the upper edge, and above the lower."""
    (p_x, p_y), d = center_of_pressure(F), np.array([d_x, d_y])
    return np.array([p_x, p_y]) <= d, np.array([p_x, p_y]) >= -d


def _unchecked(F: Any, d_x: Any, d_y: Any, *, half: float = 1.0) -> Any:
    """Compare the ratios alone, without a look at the sign of f_z."""
    p_x, p_y = np.abs(center_of_pressure(F))
    return bool(p_x <= half * d_x and p_y <= half * d_y)


def _at(p_x: float, p_y: float, f_z: float, rng: Any) -> Any:
    """Return a wrench with a given centre of pressure, and the half lengths of a sole."""
    f_x, f_y, tau_z = rng.normal(scale=[20, 20, 2])
    return np.array([p_y * f_z, -p_x * f_z, tau_z, f_x, f_y, f_z]), 0.1, 0.04


def _wrenches(rng: Any) -> Any:
    """Return wrenches in the middle, beyond each edge, near it and on it, one that pulls, one that hardly pushes."""
    near, far = rng.uniform(0.6, 0.9), rng.uniform(1.2, 2.0)
    places = [(0.3, 0.3), (near, 0.2), (0.2, -near), (far, 0.3), (-far, 0.2), (0.3, far), (0.2, -far), (-0.2, 0.3)]
    places += [(0.75, 0.1), (0.1, 0.75)]
    edges = [_at(*place, 256.0, rng)[0] for place in ((0.125, 0.01), (-0.125, 0.01), (0.05, 0.0625), (0.05, -0.0625))]
    twist = np.array([0, -0.2 * 100, 3.0, 0.01, 0.01, 100]), 0.1, 0.04
    pushes = [_at(0.1 * x, 0.04 * y, rng.uniform(100, 400), rng) for x, y in places]
    return [
        *pushes,
        *((F, 0.125, 0.0625) for F in edges),  # powers of two: the division is exact
        _at(0.01, 0.01, -rng.uniform(100, 400), rng),
        _at(0.07, 0.03, 300.0, rng),
        _at(0.15, 0.06, 0.3, rng),
        twist,
    ]


SUM = Part(
    solution=sole_wrench,
    doc=Text(
        """Return the wrench of several forces on a sole, about its centre.

        points: array (n, 3), m, where the forces act, seen from the centre of the sole; z = 0.
        forces: array (n, 3), N. Both in the axes of the sole, z upward.
        Returns: array (6,), (τ, f), N m and N.""",
        """返回作用在脚底的若干个力对脚底中心的合 wrench。

        points：数组 (n, 3)，单位 m，各力的作用点，从脚底中心量起，z = 0。
        forces：数组 (n, 3)，N。都用脚底坐标轴，z 向上。
        返回：数组 (6,)，(τ, f)，N m 与 N。""",
    ),
    returns=(Quantity("F", WRENCH),),
    cases=lambda rng: [_forces_of(rng) for _ in range(4)],
    slips={
        "cross-order": lambda points, forces: sole_wrench(points, forces) * np.repeat([-1, 1], 3),
        "coupling-dropped": lambda points, forces: sole_wrench(0 * points, forces),
        "swapped-halves": swapped(sole_wrench),
        "averaged": lambda points, forces: sole_wrench(points, forces) / len(forces),
        "single-force": lambda points, forces: sole_wrench(points.mean(0)[None], forces.sum(0)[None]),
        "force-sign": negated(sole_wrench),
    },
)

PRESSURE = Part(
    solution=center_of_pressure,
    doc=Text(
        """Return the centre of pressure of a sole.

        F: array (6,), (τ, f), N m and N, of the ground on the sole, about the sole's centre, z
        upward; f_z is not zero.
        Returns: array (2,), m, x and y of the point of the sole about which τ_x and τ_y vanish.""",
        """返回脚底的压力中心（COP）。

        F：数组 (6,)，(τ, f)，N m 与 N，地面对脚底的 wrench，对脚底中心取矩；z 向上，f_z 不为零。
        返回：数组 (2,)，单位 m，脚底上使 τ_x、τ_y 为零的点的 x、y 坐标。""",
    ),
    returns=(Quantity("p", unit="m"),),
    cases=lambda rng: [(sole_wrench(*_forces_of(rng)),) for _ in range(4)],
    slips={
        "cop-sign": lambda F: center_of_pressure(F) * [-1, 1],
        "cop-axes": lambda F: F[:2] / F[5],
        "lever-reversed": negated(center_of_pressure),
        "cop-inverted": lambda F: 1 / center_of_pressure(F),
        "cop-not-divided": lambda F: F[5] * center_of_pressure(F),
        "cop-whole-force": lambda F: center_of_pressure(F) * F[5] / np.linalg.norm(F[3:]),
        "swapped-halves": before(center_of_pressure, swap, which=0),
        "thousand": lambda F: 1000 * center_of_pressure(F),
    },
    properties=(
        Property(
            Text("about this point the moment has no x and no y component", "对该点的力矩没有 x、y 分量"),
            lambda answer, F: (F[:3] - np.cross([*answer, 0], F[3:]))[:2],
        ),
    ),
)

HOLDS = Part(
    solution=sole_holds,
    doc=Text(
        """Return whether the ground can exert a wrench on a sole by its pressure; friction aside.

        F: array (6,), (τ, f), N m and N, about the centre of the sole, z upward.
        d_x, d_y: numbers, m, half the length and half the width of the sole.
        Returns: True or False. The edge itself is allowed. p(F) gives the centre of pressure.""",
        """返回仅就压力而言地面能否对脚底施加该 wrench（不考虑摩擦）。

        F：数组 (6,)，(τ, f)，N m 与 N，对脚底中心取矩，z 向上。
        d_x、d_y：数，单位 m，脚底的半长与半宽。
        返回：True 或 False，恰在边缘上算可以。p(F) 给出压力中心。""",
    ),
    returns=(Quantity("holds"),),
    cases=_wrenches,
    given='p = mine("center_of_pressure")',
    slips={
        "cop-axes": lambda F, d_x, d_y: sole_holds(F, d_y, d_x),
        "pulling-allowed": _unchecked,
        "full-for-half": lambda F, d_x, d_y: sole_holds(F, d_x / 2, d_y / 2),
        "one-sided": lambda F, d_x, d_y: bool(F[5] > 0 and _edges(F, d_x, d_y)[0].all()),
        "either-for-both": lambda F, d_x, d_y: bool(F[5] > 0 and (np.logical_and(*_edges(F, d_x, d_y))).any()),
        "cop-not-divided": lambda F, d_x, d_y: bool(F[5] > 0 and abs(F[1]) <= d_x and abs(F[0]) <= d_y),
        "edge-excluded": lambda F, d_x, d_y: bool(F[5] > 0 and (np.abs(center_of_pressure(F)) < [d_x, d_y]).all()),
        "swapped-halves": before(sole_holds, swap, which=0),
    },
)

EXERCISE = Exercise(
    id="49.4.3",
    kind="explain",
    title=Text("The centre of pressure", "压力中心（COP）"),
    text=Text(
        """A humanoid stands on flat soles of half length d_x and half width d_y. Its contact wrench must satisfy
        −d_y ≤ τ_x/f_z ≤ d_y and −d_x ≤ τ_y/f_z ≤ d_x. Add up the wrench of some forces on a sole, find its centre
        of pressure, and decide whether the ground can exert a given wrench. Then explain the two conditions, and
        why the centre of pressure must lie within the area of support.

        Mind a third condition, which the two ratios do not show: the ground can push, but it cannot pull.""",
        """人形机器人用平的脚底站立，半长 d_x，半宽 d_y。接触 wrench 必须满足
        −d_y ≤ τ_x/f_z ≤ d_y，−d_x ≤ τ_y/f_z ≤ d_x。先把作用在脚底的几个力合成 wrench，再求压力中心，
        并判断地面能否施加给定的 wrench。然后解释这两个条件，以及压力中心为什么必须在支撑多边形内。

        注意两个比值看不出的第三个条件：地面只能推，不能拉。""",
    ),
    parts=(SUM, PRESSURE, HOLDS),
    hints=(
        Text(
            "Look for the point p of the sole about which the same forces have a moment around z only.",
            "寻找脚底上这样一点 p：同一组力对它只有绕 z 的力矩。",
        ),
        Text(
            "τ = p × f with p = (p_x, p_y, 0): τ_x = p_y f_z and τ_y = −p_x f_z.",
            "由 τ = p × f，p = (p_x, p_y, 0)：τ_x = p_y f_z，τ_y = −p_x f_z。",
        ),
        Text(
            "For forces straight up, p is the mean of the points, weighted by f_z. Can a mean with positive weights "
            "lie outside?",
            "对竖直的力，p 是各点以 f_z 为权的加权平均。权为正的平均值会落在外面吗？",
        ),
    ),
    answer=Text(
        """The ground pushes on the sole at points (x, y, 0) with f_z ≥ 0. Then τ_x = Σ y f_z and τ_y = −Σ x f_z, and
        the centre of pressure p = (−τ_y, τ_x)/f_z is the mean of the points, weighted by what each carries. All weights
        are positive and add up to 1, so p lies among the points: in the smallest convex area that holds them all,
        the polygon of support. For a sole that is the rectangle |p_x| ≤ d_x, |p_y| ≤ d_y, which are the two
        conditions; the signs do not matter since the rectangle is symmetric. A wrench beyond it would need f_z < 0
        somewhere: the ground would have to pull. It does not, and the foot tips over its edge. Hence f_z > 0 as well.

        The horizontal forces do not enter, since they act in the plane of the sole. They have limits of their own:
        the friction cone, and a bound on τ_z, which the chapter's table leaves out.""",
        """地面在脚底各点 (x, y, 0) 处施加 f_z ≥ 0。于是 τ_x = Σ y f_z，τ_y = −Σ x f_z，压力中心
        p = (−τ_y, τ_x)/f_z 就是各点以承力为权的加权平均。权都非负且和为 1，所以 p 落在这些点的凸包即支撑多边形之内。
        对矩形脚底就是 |p_x| ≤ d_x、|p_y| ≤ d_y，即题中两个条件；矩形对称，所以符号无关紧要。
        超出它的 wrench 要求某处 f_z < 0，即地面拉住脚；地面做不到，脚会绕边缘翻转。因此还要求 f_z > 0。

        水平力在脚底平面内，不影响压力中心；它们另有限制：摩擦锥，以及本章表格漏掉的 τ_z 的限制。""",
    ),
)
