"""Exercise 49.7.1: a robot that falls."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import JOINT_SPACE
from ..robots import robot, small_robot
from ..text import Text
from ..wrong import after, swapped

__all__ = ["EXERCISE", "fall_from_rest", "fall_in_motion"]


def fall_from_rest(model: Any, q: Any) -> Any:
    """Acceleration without torques at rest, by ABA and by thought."""
    rest = np.zeros(model.nv)
    base = tw.forward_kinematics(model, q).placement[1]
    expected = np.zeros(model.nv)
    expected[3:6] = base.rotation.mT @ model.gravity
    return tw.aba(model, q, rest, rest), expected


def fall_in_motion(model: Any, q: Any, v: Any) -> Any:
    """Acceleration of the base's origin and of the centre of mass, in the axes of the world."""
    a = tw.aba(model, q, v, np.zeros(model.nv))
    base = tw.forward_kinematics(model, q).placement[1]
    of_base = base.rotation @ (a[3:6] + np.cross(v[:3], v[3:6]))
    mass = sum(body.mass for body in model.inertia)
    of_com = tw.centroidal_momentum_rate(model, q, v, a)[3:] / mass
    return of_base, of_com


def _instead(by_aba: Any = None, expected: Any = None) -> Any:
    """Put something else in the place of either answer; each of model, q, and R of the base."""

    def wrong(model: Any, q: Any) -> Any:
        R = tw.forward_kinematics(model, q).placement[1].rotation
        first, second = fall_from_rest(model, q)
        if expected is not None:
            second = np.zeros(model.nv)
            second[3:6] = expected(model.gravity, R)
        return first if by_aba is None else by_aba(model, q), second

    return wrong


def _held(model: Any, q: Any) -> Any:
    """Return what the joints do when the base is held."""
    M, g = tw.crba(model, q), tw.gravity(model, q)
    return np.concatenate([np.zeros(6), -np.linalg.solve(M[6:, 6:], g[6:])])


def _moving(of_base: Any) -> Any:
    """Make the base's acceleration in another way, of R, the spatial one and ω, v."""

    def wrong(model: Any, q: Any, v: Any) -> Any:
        a = tw.aba(model, q, v, np.zeros(model.nv))
        R = tw.forward_kinematics(model, q).placement[1].rotation
        return of_base(R, a, v[:3], v[3:6]), fall_in_motion(model, q, v)[1]

    return wrong


def _of_momentum(of_com: Any) -> Any:
    """Make the centre of mass's acceleration in another way."""

    def wrong(model: Any, q: Any, v: Any) -> Any:
        a = tw.aba(model, q, v, np.zeros(model.nv))
        return fall_in_motion(model, q, v)[0], of_com(model, q, v, a, sum(body.mass for body in model.inertia))

    return wrong


def _turned(model: Any, q: Any, v: Any) -> Any:
    R = tw.forward_kinematics(model, q).placement[1].rotation
    return tuple(R.mT @ x for x in fall_in_motion(model, q, v))


def _aligned(model: Any, q: Any, v: Any) -> Any:
    """Return the acceleration of the base's origin by its Jacobian, aligned with the world."""
    base, a = model.joint_names[1], tw.aba(model, q, v, np.zeros(model.nv))
    bias = tw.frame_bias_acceleration(model, q, v, base, "local_world_aligned")
    return (tw.frame_jacobian(model, q, base, "local_world_aligned") @ a + bias)[3:]


def _postures(rng: Any) -> Any:
    return [(model, model.random_configuration(rng=rng)) for model in (robot("go2"), small_robot(rng))]


def _states(rng: Any) -> Any:
    models = [robot("go2"), small_robot(rng), small_robot(rng)]
    return [(model, model.random_configuration(rng=rng), rng.standard_normal(model.nv)) for model in models]


FROM_REST = Part(
    solution=fall_from_rest,
    doc=Text(
        """Return the acceleration of a robot at rest without torques, by ABA and as you expect it.

        model: a robot with a floating base. q: array (nq,), the base at any tilt. v = 0, τ = 0.
        `tw.aba(model, q, v, tau)`; `tw.forward_kinematics(model, q).placement[1]` places the base,
        `.rotation` takes its coordinates to the world; `model.gravity` is (0, 0, -9.81) m/s².
        Returns: two arrays (nv,), the base's rates of ω and v, in its own axes, then the joints'.
        The second without any algorithm: which entries are not zero?""",
        """返回静止机器人在无力矩时的加速度：由 ABA 计算，以及你预期的值。

        model：浮动基座机器人。q：数组 (nq,)，任意位形，基座可以倾斜。v = 0，τ = 0。
        `tw.aba(model, q, v, tau)`；`tw.forward_kinematics(model, q).placement[1]` 是基座位姿，
        `.rotation` 把基座坐标变到世界；`model.gravity` 为 (0, 0, -9.81) m/s²。
        返回：两个数组 (nv,)，先是基座 ω、v 的变化率（用基座坐标轴），然后是各关节的。
        第二个不用任何算法：哪些分量不为零？""",
    ),
    returns=(Quantity("q̈ by ABA", JOINT_SPACE), Quantity("q̈ as expected", JOINT_SPACE)),
    cases=_postures,
    slips={
        "gravity-compensated": lambda model, q: (np.zeros(model.nv), np.zeros(model.nv)),
        "base-held": _instead(_held),
        "bias-sign": _instead(lambda model, q: -fall_from_rest(model, q)[0]),
        "aligned-for-local": _instead(expected=lambda g, R: g),
        "rotation-forward": _instead(expected=lambda g, R: R @ g),
        "gravity-sign": _instead(expected=lambda g, R: -R.mT @ g),
        "swapped-halves": swapped(fall_from_rest),
        "base-missing": after(fall_from_rest, lambda a: a[6:]),
    },
    properties=(
        Property(
            Text("every body falls alike, so the joints do not move", "各刚体同样下落，所以关节不动"),
            lambda answer, model, q: (answer[0][6:], answer[1][6:]),
        ),
        Property(
            Text("RNEA of it gives no force anywhere", "把它代入 RNEA，处处不需要力"),
            lambda answer, model, q: [tw.rnea(model, q, np.zeros(model.nv), a) for a in answer],
        ),
    ),
)

IN_MOTION = Part(
    solution=fall_in_motion,
    doc=Text(
        """Return how the base's origin and the centre of mass accelerate without torques, in motion.

        model: a robot with a floating base. q: array (nq,). v: array (nv,), the base's ω and v first,
        in its own axes. τ = 0. ABA gives the rates of these numbers.
        `tw.centroidal_momentum_rate(model, q, v, a)` is (k̇, l̇). Or think of the outside forces.
        Returns: two arrays (3,), m/s², in the axes of the world: the accelerations of two points,
        as one would measure them from the ground.""",
        """返回机器人在运动中且无力矩时，基座原点与质心的加速度。

        model：浮动基座机器人。q：数组 (nq,)。v：数组 (nv,)，前六个是基座的 ω 与 v，用基座坐标轴。
        τ = 0。ABA 给出的是这些分量的变化率。
        `tw.centroidal_momentum_rate(model, q, v, a)` 是 (k̇, l̇)；也可以直接考虑外力。
        返回：两个数组 (3,)，m/s²，世界坐标轴：两个点的真实加速度，即从地面上测得的加速度。""",
    ),
    returns=(Quantity("a of the base", unit="m/s²"), Quantity("a of the centre of mass", unit="m/s²")),
    cases=_states,
    slips={
        "classical-acceleration": _moving(lambda R, a, w, u: R @ a[3:6]),
        "cross-order": _moving(lambda R, a, w, u: R @ (a[3:6] + np.cross(u, w))),
        "untransformed": _moving(lambda R, a, w, u: a[3:6]),
        "rotation-transposed": _moving(lambda R, a, w, u: R.mT @ (a[3:6] + np.cross(w, u))),
        "angular-for-linear": _moving(lambda R, a, w, u: R @ (a[:3] + np.cross(w, u))),
        "as-at-rest": lambda model, q, v: (model.gravity, model.gravity),
        "base-for-com": lambda model, q, v: (fall_in_motion(model, q, v)[0],) * 2,
        "rate-bias-missing": _of_momentum(lambda model, q, v, a, m: (tw.centroidal_map(model, q) @ a)[3:] / m),
        "mass-not-divided": _of_momentum(lambda model, q, v, a, m: m * model.gravity),
        "gravity-sign": _of_momentum(lambda model, q, v, a, m: -model.gravity),
        "local-for-aligned": _turned,
    },
    properties=(
        Property(
            Text(
                "J a + J̇ v of the base's frame, aligned with the world, says the same",
                "与基座坐标系（世界对齐）的 J a + J̇ v 一致",
            ),
            lambda answer, model, q, v: answer[0] - _aligned(model, q, v),
        ),
        Property(
            Text("from outside acts only the weight, and the centre of mass obeys it", "外力只有重力，质心服从重力"),
            lambda answer, model, q, v: answer[1] - model.gravity,
        ),
    ),
)

EXERCISE = Exercise(
    id="49.7.1",
    kind="explain",
    title=Text("Falling", "自由落体"),
    text=Text(
        """Without torques and without ground a Go2 falls. Compute q̈ for τ = 0 by ABA. The chapter asks you to see
        that the linear part of the base's acceleration is about (0, 0, −9.81).

        That needs v = 0 and a level base, and then it is not about but exactly so. So first let the robot be at rest,
        the base at any tilt, and say beforehand what ABA must give. Then let it move: now the base does not fall
        with g any more. How does it accelerate, and which point does fall with g? Why?""",
        """没有力矩也没有地面时，Go2 自由下落。用 ABA 计算 τ = 0 时的 q̈。
        本章要求验证基座加速度的线性部分约为 (0, 0, −9.81)。

        这需要 v = 0 且基座水平，而且此时不是约等于，而是精确成立。所以先让机器人静止、基座任意倾斜，
        并事先说出 ABA 应给出什么。然后让它运动：此时基座不再以 g 下落。基座的加速度是多少？哪个点以 g
        下落？为什么？""",
    ),
    parts=(FROM_REST, IN_MOTION),
    hints=(
        Text(
            "At rest everything falls alike: what have the joints to do? And in whose axes does ABA answer?",
            "静止时一切同样下落：关节需要动吗？ABA 的结果用的是谁的坐标轴？",
        ),
        Text(
            "g in the axes of the base is Rᵀ g. The rate of v, in turning axes, is not yet the acceleration of a "
            "point: v̇ + ω × v is.",
            "在基座坐标轴中 g 是 Rᵀ g。v 在转动坐标轴中的变化率还不是点的加速度，v̇ + ω × v 才是。",
        ),
        Text(
            "What pulls at the base when the legs swing comes from within. Sum up the forces from outside: m g, "
            "whatever moves.",
            "腿摆动时拉动基座的是内力。外力之和始终是 m g，与怎样运动无关。",
        ),
    ),
    answer=Text(
        """At rest every body falls with g, so that no joint has anything to do: q̈ is Rᵀ g for the base's linear part,
        zero elsewhere, exactly. (0, 0, −9.81) are its entries if the base is level; tilted, they are others, since
        ABA answers in the axes of the base.

        With v ≠ 0 two things come in. First, what ABA returns is the rate of the body twist: the spatial
        acceleration. The base's origin accelerates by v̇ + ω × v. Second, the base really moves otherwise: the legs
        swing, and to keep them on their circles the joints pull at the base.

        The centre of mass does fall with g, at any v, and even with any torques in the joints: all of these are
        forces within, in pairs that cancel. From outside comes m g only, and l̇ = m g.""",
        """静止时每个刚体都以 g 下落，关节无需运动：q̈ 中只有基座线性部分为 Rᵀ g，其余为零，而且是精确的。
        基座水平时其分量为 (0, 0, −9.81)；倾斜时则不同，因为 ABA 用的是基座坐标轴。

        v ≠ 0 时有两点不同。第一，ABA 返回的是 body twist 的变化率，即空间加速度；基座原点的加速度是 v̇ + ω × v。
        第二，基座的运动确实不同：腿在摆动，关节要使腿保持圆周运动，就会拉动基座。

        质心则始终以 g 下落，与 v 无关，甚至与关节力矩无关：这些都是成对抵消的内力。外力只有 m g，所以 l̇ = m g。""",
    ),
)
