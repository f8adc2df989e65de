"""Exercise 49.10.3: when k̇_G may be left out."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..robots import robot, small_robot
from ..text import Text

__all__ = ["EXERCISE", "com_acceleration", "rate_at_pace"]


def com_acceleration(p_G: Any, p: Any, k_rate: Any, m: Any) -> Any:
    """Horizontal acceleration of the centre of mass at constant height."""
    (x, y, z), (p_x, p_y), (k_x, k_y) = p_G, p, k_rate
    g = 9.81
    return np.array([g / z * (x - p_x) - k_y / (m * z), g / z * (y - p_y) + k_x / (m * z)])


def rate_at_pace(model: Any, q: Any, v: Any, a: Any, s: Any) -> Any:
    """k̇_G of the same motion at another pace."""
    return tw.centroidal_momentum_rate(model, q, s * v, s**2 * a)[:3]


def _pendulum(change: Any) -> Any:
    """Combine the pendulum's term and that of k̇_G otherwise."""

    def wrong(p_G: Any, p: Any, k_rate: Any, m: Any) -> Any:
        return change(9.81 / p_G[2] * (p_G[:2] - p), np.array([-k_rate[1], k_rate[0]]) / (m * p_G[2]), m, p_G[2])

    return wrong


def _walks(rng: Any) -> Any:
    def state() -> Any:
        p_G = np.concatenate([rng.uniform(-1, 1, 2), [rng.uniform(0.2, 1.2)]])
        return p_G, p_G[:2] + rng.uniform(-0.2, 0.2, 2), rng.normal(scale=20, size=2), float(rng.uniform(10, 90))

    return [state() for _ in range(4)]


def _gaits(rng: Any) -> Any:
    return [
        (model, model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv)), float(rng.uniform(0.2, 0.8)))
        for model in (robot("go2"), small_robot(rng), small_robot(rng))
    ]


def _ground(answer: Any, p_G: Any, p: Any, k_rate: Any, m: Any) -> Any:
    """Return k̇ less the moment of the ground's force about the centre of mass, in x and y."""
    force = m * np.array([*answer, 9.81])
    return k_rate - np.cross(np.array([*p, 0.0]) - p_G, force)[:2]


def _rate(model: Any, q: Any, v: Any, a: Any) -> Any:
    return tw.centroidal_momentum_rate(model, q, v, a)


ACCELERATION = Part(
    solution=com_acceleration,
    doc=Text(
        """Return the horizontal acceleration of a centre of mass that stays at its height, with k̇_G
        not left out.

        p_G: array (3,), m, of the centre of mass; the ground is z = 0. p: array (2,), m, the centre
        of pressure.
        k_rate: array (2,), N m, x and y of k̇_G. m: number, kg. g is 9.81 m/s².
        Returns: array (2,), m/s². With k_rate = 0 it is the LIPM.""",
        """返回高度不变时质心的水平加速度，不忽略 k̇_G。

        p_G：数组 (3,)，单位 m，质心位置，地面为 z = 0。p：数组 (2,)，单位 m，压力中心。
        k_rate：数组 (2,)，N m，k̇_G 的 x、y 分量。m：数，kg。g 取 9.81 m/s²。
        返回：数组 (2,)，m/s²；k_rate = 0 时就是 LIPM。""",
    ),
    returns=(Quantity("p̈_G", unit="m/s²"),),
    cases=_walks,
    slips={
        "rate-left-out": _pendulum(lambda pendulum, rate, m, z: pendulum),
        "rate-sign": _pendulum(lambda pendulum, rate, m, z: pendulum - rate),
        "rate-axes": _pendulum(lambda pendulum, rate, m, z: pendulum + rate[::-1] * [-1, 1]),
        "pendulum-hangs": _pendulum(lambda pendulum, rate, m, z: rate - pendulum),
        "height-dropped": _pendulum(lambda pendulum, rate, m, z: z * (pendulum + rate)),
        "mass-dropped": _pendulum(lambda pendulum, rate, m, z: pendulum + m * rate),
        "g-ten": _pendulum(lambda pendulum, rate, m, z: 10 / 9.81 * pendulum + rate),
        "g-rounded": _pendulum(lambda pendulum, rate, m, z: 9.8 / 9.81 * pendulum + rate),
    },
    reasons={
        "mass-dropped": Text("k̇_y/(m z) is N m/(kg m), that is m/s².", "k̇_y/(m z) 的单位是 N m/(kg m)，即 m/s²。"),
    },
    properties=(
        Property(
            Text(
                "the ground's force, m (ẍ, ÿ, g) at the centre of pressure, has the moment k̇_G about p_G",
                "压力中心处的地面力 m (ẍ, ÿ, g) 对质心的力矩等于 k̇_G",
            ),
            _ground,
        ),
    ),
)

PACE = Part(
    solution=rate_at_pace,
    doc=Text(
        """Return k̇_G where the same motion is made at another pace.

        model: with a floating base. q: array (nq,). v, a: arrays (nv,), of the motion at pace 1.
        s: number: at pace s the robot goes through the same postures in 1/s of the time.
        `tw.centroidal_momentum_rate(model, q, v, a)` is ḣ_G = (k̇_G, l̇_G).
        Returns: array (3,), N m.""",
        """返回同一动作以另一节奏进行时的 k̇_G。

        model：浮动基座模型。q：数组 (nq,)。v、a：数组 (nv,)，节奏为 1 时的速度和加速度。
        s：数：节奏为 s 时，机器人以 1/s 的时间经历同样的位形。
        `tw.centroidal_momentum_rate(model, q, v, a)` 即 ḣ_G = (k̇_G, l̇_G)。
        返回：数组 (3,)，N m。""",
    ),
    returns=(Quantity("k̇_G", unit="N m"),),
    cases=_gaits,
    slips={
        "speed-once": lambda model, q, v, a, s: s * _rate(model, q, v, a)[:3],
        "acceleration-unscaled": lambda model, q, v, a, s: _rate(model, q, s * v, a)[:3],
        "acceleration-scaled-once": lambda model, q, v, a, s: _rate(model, q, s * v, s * a)[:3],
        "velocity-unscaled": lambda model, q, v, a, s: _rate(model, q, v, s**2 * a)[:3],
        "pace-inverted": lambda model, q, v, a, s: _rate(model, q, v, a)[:3] / s**2,
        "linear-for-angular": lambda model, q, v, a, s: s**2 * _rate(model, q, v, a)[3:],
        "rate-bias-missing": lambda model, q, v, a, s: s**2 * (tw.centroidal_map(model, q) @ a)[:3],
    },
)

EXERCISE = Exercise(
    id="49.10.3",
    kind="explain",
    title=Text("When k̇_G may be left out", "何时可以忽略 k̇_G"),
    text=Text(
        """The linear inverted pendulum (LIPM) assumes k̇_G = 0 and a constant height. Find the horizontal
        acceleration of the centre of mass with k̇_G kept, and see what it adds. Then find out how k̇_G changes if a
        robot makes the same motion at another pace. With both, explain why the assumption is good for slow walking
        and not for running or a somersault.

        The chapter asks about k̇_G only; that the height is constant is an assumption of its own, without which the
        pendulum is not linear.""",
        """线性倒立摆（LIPM）假设 k̇_G = 0 且高度不变。先求保留 k̇_G 时质心的水平加速度，看它多出什么项；
        再求机器人以另一节奏做同样的动作时 k̇_G 怎样变化。由这两点解释：为什么该假设适合慢速行走，却不适合跑步或翻跟头。

        本章只问了 k̇_G；高度不变是另一个独立的假设，没有它摆就不是线性的。""",
    ),
    parts=(ACCELERATION, PACE),
    hints=(
        Text(
            "k̇_G is the moment of the ground's force about the centre of mass. That force is m (ẍ, ÿ, g), as the "
            "height stays, and acts at (p_x, p_y, 0).",
            "k̇_G 是地面力对质心的力矩。高度不变，所以地面力是 m (ẍ, ÿ, g)，作用在 (p_x, p_y, 0)。",
        ),
        Text(
            "k̇_y = −z f_x − (p_x − x) f_z: solve for f_x. For y take k̇_x = (p_y − y) f_z + z f_y.",
            "k̇_y = −z f_x − (p_x − x) f_z，解出 f_x；y 方向用 k̇_x = (p_y − y) f_z + z f_y。",
        ),
        Text(
            "At pace s: q(s t). Differentiate once for the velocity, twice for the acceleration.",
            "节奏为 s 时位形是 q(s t)：求一次导得速度，求两次导得加速度。",
        ),
    ),
    answer=Text(
        """With k̇_G kept, ẍ = (g/z)(x − p_x) − k̇_y/(m z): a moment k̇_y has the same effect as moving the centre of
        pressure by k̇_y/(m g). For Go2, 16 kg, a k̇_y of 1.6 N m is worth 1 cm. Now k_G is linear in the velocities,
        and its rate is A_G a + Ȧ_G v: at pace s accelerations are s² times as large and Ȧ_G v is quadratic in v, so
        k̇_G goes with s². Gravity's term does not change with the pace. At half the pace a quarter is left, at a
        tenth a hundredth: in slow walking it is lost beside g/z (x − p). Also, the swings of opposite legs largely
        cancel over a step. In running, k̇_G grows with the square of the pace while the times of contact shrink. In
        flight it is exactly zero, since nothing has a moment, but a somersault lives on a large k_G: it must be
        built up by a large k̇_G while the feet push, and there the assumption fails entirely.""",
        """保留 k̇_G 时 ẍ = (g/z)(x − p_x) − k̇_y/(m z)：k̇_y 的作用相当于把压力中心移动 k̇_y/(m g)。
        Go2 重 16 kg，k̇_y = 1.6 N m 相当于 1 cm。k_G 对速度是线性的，k̇_G = A_G a + Ȧ_G v；节奏为 s 时加速度变为 s² 倍，
        Ȧ_G v 对速度是二次的，所以 k̇_G 与 s² 成正比，而重力项与节奏无关。节奏减半只剩四分之一，十分之一只剩百分之一：
        慢速行走时它与 g/z (x − p) 相比可以忽略；左右腿的摆动在一步内还大致抵消。跑步时 k̇_G 随节奏平方增长，
        触地时间却变短。腾空时没有力矩，k̇_G 恰为零，但翻跟头要靠很大的 k_G，它必须在蹬地时由很大的 k̇_G 积累，
        此时假设完全不成立。""",
    ),
)
