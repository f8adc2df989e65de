"""Exercise 49.11.3: the forces under a standing robot."""

from functools import cache
from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import JOINT_SPACE
from ..robots import robot, small_robot
from ..text import Text
from ..wrong import negated, times

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
    """Return g and J_c of the postures, on four feet and on three."""
    (model, first), (_, second) = _postures(rng)
    standing = ((first, model.feet), (second, model.feet), (first, model.feet[1:]))
    return [(tw.gravity(model, q), tw.contact_jacobian(model, q, feet)) for q, feet in standing]


def _maps(rng: Any) -> Any:
    """Return A_G of the postures, and of another robot."""
    small = small_robot(rng)
    postures = [*_postures(rng), (small, small.random_configuration(rng=rng))]
    return [(tw.centroidal_map(model, q),) for model, q in postures]


def _with_torques(forces: Any, g: Any, J_c: Any) -> Any:
    return forces.reshape(-1, 3), (g - J_c.mT @ forces)[6:]


def _all_rows(g: Any, J_c: Any) -> Any:
    """Ask the feet for all 18 rows."""
    return _with_torques(np.linalg.lstsq(J_c.mT, g)[0], g, J_c)


def _joint_rows(g: Any, J_c: Any) -> Any:
    return _with_torques(np.linalg.lstsq(J_c[:, 6:].mT, g[6:])[0], g, J_c)


def _equal(g: Any, J_c: Any) -> Any:
    """Give each foot the same part of the weight, upward: g[3:6] is the weight in the base's axes."""
    feet = len(J_c) // 3
    return _with_torques(np.tile([0, 0, np.linalg.norm(g[3:6]) / feet], feet), g, J_c)


def _torques(change: Any) -> Any:
    """Leave the forces right, and take other torques, of g and J_cᵀλ in the joint rows."""

    def wrong(g: Any, J_c: Any) -> Any:
        forces, _ = standing_forces(g, J_c)
        return forces, change(g[6:], J_c[:, 6:].mT @ forces.ravel())

    return wrong


def _go2_on_all_rows() -> Any:
    model = robot("go2")
    q = model.standing()
    forces, _ = _all_rows(tw.gravity(model, q), tw.contact_jacobian(model, q, model.feet))
    return forces[0, 2], forces[2, 2]


MAP = Part(
    solution=gravity_from_map,
    doc=Text(
        """Return g(q), given A_G alone.

        A_G: array (6, nv), rows (k, l): `tw.centroidal_map(model, q)`. Gravity is 9.81 m/s² along −z
        of the world.
        Returns: array (nv,), N m and N.""",
        """只由 A_G 返回 g(q)。

        A_G：数组 (6, nv)，行 (k, l)，即 `tw.centroidal_map(model, q)`。重力沿世界 −z 方向，9.81
        m/s²。
        返回：数组 (nv,)，N m 与 N。""",
    ),
    returns=(Quantity("g", JOINT_SPACE),),
    cases=_maps,
    slips={
        "gravity-sign": negated(gravity_from_map),
        "angular-for-linear": lambda A_G: 9.81 * A_G[2],
        "mass-for-weight": lambda A_G: A_G[5],
        "g-ten": times(gravity_from_map, 10 / 9.81),
        "g-rounded": times(gravity_from_map, 9.8 / 9.81),
    },
    reasons={
        "gravity-sign": Text(
            "g(q) is what holds the robot: upward at the base, against the weight.",
            "g(q) 是托住机器人所需的力：在基座处向上，与重力相反。",
        ),
    },
    properties=(
        Property(
            Text("the base's part of g has the size of the weight", "g 的基座平动部分等于重力的大小"),
            lambda answer, A_G: np.linalg.norm(answer[3:6]) - 9.81 * np.linalg.norm(A_G[3:, 5]),
        ),
    ),
)

FORCES = Part(
    solution=standing_forces,
    doc=Text(
        """Return the contact forces and torques that hold a robot at rest. Where many forces would do:
        those of least norm.

        g: array (nv,), N m and N, `tw.gravity(model, q)`. J_c: array (3 k, nv), of k feet,
        `tw.contact_jacobian(model, q, model.feet)`. The base comes first.
        Returns: array (k, 3), N, of the ground on each foot, in the axes of the world; array (nv −
        6,), N m, torques.""",
        """返回使机器人保持静止的接触力和力矩；解不唯一时取范数最小的接触力。

        g：数组 (nv,)，N m 与 N，即 `tw.gravity(model, q)`。J_c：数组 (3 k, nv)，k 只脚，
        即 `tw.contact_jacobian(model, q, model.feet)`。基座在前。
        返回：数组 (k, 3)，N，地面对各脚的力，用世界坐标轴；数组 (nv − 6,)，N m，力矩。""",
    ),
    returns=(Quantity("λ", unit="N"), Quantity("τ", unit="N m")),
    cases=_arrays,
    slips={
        "torques-left-out": _all_rows,
        "joint-rows-for-forces": _joint_rows,
        "equal-shares": _equal,
        "contact-missing": _torques(lambda g, feet: g),
        "external-sign": _torques(lambda g, feet: g + feet),
        "gravity-missing": _torques(lambda g, feet: -feet),
        "force-sign": lambda g, J_c: (-standing_forces(g, J_c)[0], standing_forces(g, J_c)[1]),
        "base-rows-kept": lambda g, J_c: (standing_forces(g, J_c)[0], g - J_c.mT @ standing_forces(g, J_c)[0].ravel()),
    },
    reasons={
        "gravity-missing": Text(
            "The joint rows hold g_j as well: τ = g_j − J_cjᵀλ.", "关节行中还有 g_j：τ = g_j − J_cjᵀλ。"
        ),
        "external-sign": Text(
            "The joints need not do what the ground does: τ = g_j − J_cjᵀλ.",
            "地面承担的部分无需关节承担：τ = g_j − J_cjᵀλ。",
        ),
        "contact-missing": Text(
            "That holds the legs of a robot whose base is held. Standing on them takes τ = g_j − J_cjᵀλ.",
            "那只够托住基座被固定时的腿；站立需要 τ = g_j − J_cjᵀλ。",
        ),
    },
    properties=(
        Property(
            Text("g = Sᵀτ + J_cᵀλ holds in all rows", "g = Sᵀτ + J_cᵀλ 的各行全部成立"),
            lambda answer, g, J_c: g - np.concatenate([np.zeros(6), answer[1]]) - J_c.mT @ answer[0].ravel(),
        ),
    ),
)

LOADS = Part(
    solution=standing_loads,
    doc=Text(
        "Return the vertical forces on a front foot and on a rear foot of Go2 in `model.standing()`: two numbers, N.",
        "返回 Go2 在 `model.standing()` 位形下一只前脚和一只后脚的竖直力：两个数，N。",
    ),
    returns=(Quantity("front", unit="N"), Quantity("rear", unit="N")),
    cases=lambda rng: [()],
    rtol=5e-4,
    slips={
        "equal-shares": lambda: (16.085 * 9.81 / 4, 16.085 * 9.81 / 4),
        "torques-left-out": _go2_on_all_rows,
        "lever-reversed": lambda: _loads()[::-1],
        "nominal-mass": lambda: tuple(12 / 16.085 * f for f in _loads()),
        "mass-for-weight": lambda: tuple(f / 9.81 for f in _loads()),
        "shared-by-two": lambda: tuple(2 * f for f in _loads()),
        "force-sign": lambda: tuple(-f for f in _loads()),
        "g-ten": lambda: tuple(10 / 9.81 * f for f in _loads()),
        "g-rounded": lambda: tuple(9.8 / 9.81 * f for f in _loads()),
    },
    reasons={
        "lever-reversed": Text(
            "The feet that are nearer to the centre of mass carry more: it lies behind the middle.",
            "离质心近的脚承重更多：质心在中心偏后。",
        ),
    },
)

EXERCISE = Exercise(
    id="49.11.3",
    kind="explain",
    title=Text("The forces under a standing robot", "站立机器人的足底力"),
    text=Text(
        """Compute M(q), g(q), J_c and A_G of Go2 in its standing posture, with twistwrench or Pinocchio. Two of them
        are closely related: get g out of A_G. Then solve the equation of static equilibrium for the forces under the
        feet, by least squares, and find the load of each foot.

        The chapter solves g = J_cᵀλ. That leaves out the motors: the equation is g = Sᵀτ + J_cᵀλ. Least squares over
        all 18 rows leaves something over and loses a newton of the weight; only the six rows of the base decide
        about λ. And "about m g/4 each" holds up to the place of the centre of mass: explain who carries more.""",
        """用 twistwrench 或 Pinocchio 计算 Go2 站立位形的 M(q)、g(q)、J_c 和 A_G。其中两个关系密切：由 A_G 求出 g。
        然后用最小二乘求解静力平衡方程，得到足底力和每只脚的负载。

        本章求解的是 g = J_cᵀλ，漏了电机：方程应为 g = Sᵀτ + J_cᵀλ。对全部 18 行做最小二乘会有残差，并丢失约 1 N
        的重力；λ 只由基座的六行决定。"每只脚约 m g/4"也只在不计质心偏移时成立：请解释哪些脚承重更多。""",
    ),
    parts=(MAP, FORCES, LOADS),
    hints=(
        Text(
            "Which rows of g = Sᵀτ + J_cᵀλ have no unknown but λ? Solve those, then read τ off the others.",
            "g = Sᵀτ + J_cᵀλ 中哪些行的未知量只有 λ？先解这些行，再由其余行得到 τ。",
        ),
        Text(
            "`np.linalg.lstsq(J_c[:, :6].mT, g[:6])[0]`: six equations, twelve unknowns, the solution of least norm.",
            "`np.linalg.lstsq(J_c[:, :6].mT, g[:6])[0]`：六个方程、十二个未知量，给出最小范数解。",
        ),
        Text(
            "The power of the weight is −m g v_Gz, and m v_Gz is the last row of A_G times v. g(q)·v is the opposite.",
            "重力的功率是 −m g v_Gz，而 m v_Gz 是 A_G 最后一行乘 v；g(q)·v 是这个功率的相反数。",
        ),
    ),
    answer=Text(
        """Holding the robot against its weight takes the power g(q)·v = m g v_Gz for each v, and m v_Gz is the last
        row of A_G times v: so g = 9.81 A_G[5]. In equilibrium g = Sᵀτ + J_cᵀλ, 18 equations for 12 forces and 12
        torques. The six rows of the base have λ only; of their solutions the one of least norm has 39.10 N on each
        front foot and 39.80 N on each rear one, 157.79 N in all, and nothing sideways. The other rows then give the
        torques, up to 6.4 N m at the knees. A quarter of the weight would be 39.45 N: the centre of mass is 1.7 mm
        behind the middle of the feet, and the rear legs carry 1.8 % more. On all 18 rows, without τ, the residual is
        12.7, and 156.74 N are left of the weight, since least squares trades newtons of the weight for torques that
        it cannot make. The solution is one of many: feet can also push against each other, with friction.""",
        """托住机器人所需功率对任意 v 为 g(q)·v = m g v_Gz，而 m v_Gz 是 A_G 最后一行乘 v，所以 g = 9.81 A_G[5]。
        平衡方程 g = Sᵀτ + J_cᵀλ 有 18 个方程、12 个力和 12 个力矩。基座的六行只含 λ，其最小范数解为前脚各 39.10 N、
        后脚各 39.80 N，合计 157.79 N，没有水平力；其余行给出力矩，膝关节最大，为 6.4 N m。重力的四分之一是 39.45 N：
        质心在四脚中心后方 1.7 mm，后腿多承担 1.8 %。若对 18 行都做最小二乘而漏掉 τ，残差为 12.7，重力只剩 156.74 N，
        因为最小二乘用少托一点重力去换它产生不了的力矩。解不唯一：有摩擦时各脚还可以互相对撑。""",
    ),
)
