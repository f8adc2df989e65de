"""Exercise 49.0.5: Newton and Euler."""

from typing import Any

import numpy as np

from ..exercise import Exercise, Part, Property, Quantity
from ..text import Text

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
    title=Text("Newton and Euler", "牛顿-欧拉方程"),
    text=Text(
        """What are the equations of Newton and Euler for a rigid body: which is about translation, which about
        rotation?
        Compute the moment about the centre of mass and the force that a given motion takes.""",
        """刚体的牛顿-欧拉方程是什么形式？平动部分和转动部分分别是什么？
        由给定的运动计算关于质心的力矩和所需的力。""",
    ),
    parts=(
        Part(
            solution=newton_euler,
            doc=Text(
                """Return the moment about the centre of mass and the force on the body.

                m: number, kg. I_c: array (3, 3), kg m², about the centre of mass.
                omega, alpha: arrays (3,), rad/s and rad/s². a_c: array (3,), m/s², acceleration of the
                centre of mass.
                All at one instant, along the same axes, in an inertial frame.
                Returns: two arrays (3,), N m and N.""",
                """返回作用在刚体上、关于质心的力矩和力。

                m：数，kg。I_c：数组 (3, 3)，kg m²，关于质心。
                omega、alpha：数组 (3,)，rad/s 与 rad/s²。a_c：数组 (3,)，m/s²，质心加速度。
                均取同一时刻、同一组坐标轴、惯性系。
                返回：两个数组 (3,)，N m 与 N。""",
            ),
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
            properties=(
                Property(
                    Text(
                        "the power of the moment is the rate of the rotational energy: τ·ω = α·Iω",
                        "力矩的功率等于转动动能的变化率：τ·ω = α·Iω",
                    ),
                    lambda answer, m, I_c, omega, alpha, a_c: answer[0] @ omega - alpha @ I_c @ omega,
                ),
            ),
        ),
    ),
    hints=(
        Text(
            "Force is the rate of change of the momentum m v_c, moment that of the angular momentum I_c ω.",
            "力是动量 m v_c 的变化率，力矩是角动量 I_c ω 的变化率。",
        ),
        Text(
            "I_c turns with the body, so d(I_c ω)/dt has a second term: ω × I_c ω.",
            "I_c 随刚体转动，所以 d(I_c ω)/dt 还有第二项：ω × I_c ω。",
        ),
    ),
)
