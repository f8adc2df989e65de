"""Exercise 49.6.3: what holds a robot at rest."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import WRENCH
from ..robots import robot, small_robot
from ..text import Text
from ..wrong import as_column, negated, swapped, times

__all__ = ["EXERCISE", "base_wrench_at_rest", "go2_base_wrench"]


def base_wrench_at_rest(model: Any, q: Any) -> Any:
    """Wrench on the base that holds the robot, without RNEA."""
    base = tw.forward_kinematics(model, q).placement[1]
    mass = sum(body.mass for body in model.inertia)
    lever = base.rotation.mT @ (tw.center_of_mass(model, q) - base.translation)
    force = -mass * base.rotation.mT @ model.gravity
    return np.concatenate([np.cross(lever, force), force])


def go2_base_wrench() -> Any:
    """Wrench on the base of Go2 in its neutral posture, by RNEA."""
    model = tw.load("go2")
    rest = np.zeros(model.nv)
    return tw.rnea(model, model.neutral(), rest, rest)[:6]


def _parts(model: Any, q: Any) -> Any:
    """Return R and p of the base, the centre of mass and the force that holds the robot, in the world."""
    base, mass = tw.forward_kinematics(model, q).placement[1], sum(body.mass for body in model.inertia)
    return base.rotation, base.translation, tw.center_of_mass(model, q), -mass * model.gravity


def _wrench(moment_and_force: Any) -> Any:
    """Make the wrench in another way, of R, p, c and the force."""
    return lambda model, q: np.concatenate(moment_and_force(*_parts(model, q)))


def _of_base(model: Any, q: Any) -> Any:
    """Return what holds the base alone, without the legs."""
    R, _, _, _ = _parts(model, q)
    force = -model.inertia[1].mass * R.mT @ model.gravity
    return np.concatenate([np.cross(model.inertia[1].com, force), force])


def _cases(rng: Any) -> Any:
    models = [robot("go2"), small_robot(rng), small_robot(rng)]
    return [(model, model.random_configuration(rng=rng)) for model in models]


BY_HAND = Part(
    solution=base_wrench_at_rest,
    doc=Text(
        """Return the wrench on the base that holds a robot at rest, from mass and centre of mass.

        model: a robot with a floating base. q: array (nq,), any: the base may be tilted.
        `tw.center_of_mass(model, q)` is in the world; `model.inertia` has a `.mass` for each body;
        `tw.forward_kinematics(model, q).placement[1]` places the base: `.rotation`, `.translation`.
        Returns: array (6,), (τ, f), N m and N, in the base's frame. Do not call RNEA.""",
        """由总质量和质心返回使机器人静止所需的基座 wrench。

        model：浮动基座机器人。q：数组 (nq,)，任意位形，基座可以倾斜。
        `tw.center_of_mass(model, q)` 在世界中表达；`model.inertia` 中每个刚体有 `.mass`；
        `tw.forward_kinematics(model, q).placement[1]` 是基座位姿：`.rotation`、`.translation`。
        返回：数组 (6,)，(τ, f)，N m 与 N，在基座坐标系中表达。不要调用 RNEA。""",
    ),
    returns=(Quantity("F", WRENCH),),
    cases=_cases,
    slips={
        "as-printed": _wrench(lambda R, p, c, f: (0 * f, -R.mT @ f)),
        "base-wrench-sign": negated(base_wrench_at_rest),
        "moment-dropped": _wrench(lambda R, p, c, f: (0 * f, R.mT @ f)),
        "lever-from-world": _wrench(lambda R, p, c, f: (R.mT @ np.cross(c, f), R.mT @ f)),
        "lever-unrotated": _wrench(lambda R, p, c, f: (np.cross(c - p, R.mT @ f), R.mT @ f)),
        "aligned-for-local": _wrench(lambda R, p, c, f: (np.cross(c - p, f), f)),
        "wrench-about-world": _wrench(lambda R, p, c, f: (np.cross(c, f), f)),
        "rotation-forward": _wrench(lambda R, p, c, f: (R @ np.cross(c - p, f), R @ f)),
        "cross-order": _wrench(lambda R, p, c, f: (-R.mT @ np.cross(c - p, f), R.mT @ f)),
        "one-link": _of_base,
        "base-weightless": lambda model, q: base_wrench_at_rest(model, q) - _of_base(model, q),
        "mass-for-weight": times(base_wrench_at_rest, 1 / 9.81),
        "swapped-halves": swapped(base_wrench_at_rest),
        "column-vector": as_column(base_wrench_at_rest),
    },
    properties=(
        Property(
            Text("it is what RNEA gives at rest, the first six entries", "与静止时 RNEA 的前六个分量相同"),
            lambda answer, model, q: answer - tw.gravity(model, q)[:6],
        ),
    ),
)


def _numbers(moment: float, force: float) -> Any:
    return lambda: np.array([0, moment, 0, 0, 0, force])


OF_GO2 = Part(
    solution=go2_base_wrench,
    doc=Text(
        """Return the first six of RNEA for Go2, at rest in its neutral posture.

        Base and world have the same axes there: `tw.load("go2").neutral()`. v = 0, a = 0.
        Returns: array (6,), (τ, f), N m and N.""",
        """返回 Go2 在零位形静止时 RNEA 输出的前六个分量。

        `tw.load("go2").neutral()` 中基座与世界坐标轴平行。v = 0，a = 0。
        返回：数组 (6,)，(τ, f)，N m 与 N。""",
    ),
    returns=(Quantity("F", WRENCH),),
    cases=lambda rng: [()],
    rtol=5e-4,
    slips={
        "as-printed": _numbers(0, -157.794),
        "moment-dropped": _numbers(0, 157.794),
        "base-wrench-sign": _numbers(1.29745, -157.794),
        "cross-order": _numbers(1.29745, 157.794),
        "nominal-mass": _numbers(-1.29745 * 12 / 16.085, 117.72),
        "one-link": _numbers(-1.43342, 71.3874),
        "base-weightless": _numbers(0.13597, 86.4065),
        "mass-for-weight": _numbers(-1.29745 / 9.81, 16.085),
        "swapped-halves": lambda: np.array([0, 0, 157.794, 0, -1.29745, 0]),
    },
)

EXERCISE = Exercise(
    id="49.6.3",
    kind="explain",
    title=Text("What holds the base", "什么托住了基座"),
    text=Text(
        """Run RNEA for Go2 at rest (v = 0, a = 0), and look at the first six entries, the wrench on the base.

        The chapter expects (0, 0, 0, 0, 0, −m g), the weight. That is not what comes out: neither the sign nor the
        zeros are right. Predict the wrench from the mass and the centre of mass alone, for any posture and any tilt
        of the base. Then say in words where the chapter goes wrong.""",
        """让 Go2 静止（v = 0，a = 0），运行 RNEA，检查输出的前六个分量，即基座 wrench。

        本章认为结果是 (0, 0, 0, 0, 0, −m g)，即总重力。实际并非如此：符号不对，那些零也不对。
        只用总质量和质心预测这个 wrench，位形任意，基座可任意倾斜。然后用文字说明本章错在哪里。""",
    ),
    parts=(OF_GO2, BY_HAND),
    hints=(
        Text(
            "RNEA answers: which forces must act so that this motion happens? At rest something must hold it up.",
            "RNEA 回答的是：要产生这个运动，需要施加什么力？静止时必须有力托住机器人。",
        ),
        Text(
            "The weight acts at the centre of mass, the wrench on the base is about the base's origin. What is the "
            "lever arm?",
            "重力作用在质心，而基座 wrench 是对基座原点的。力臂是什么？",
        ),
        Text(
            "In the world: f = −m g, τ = (c − p) × f. Then turn both into the base's axes by Rᵀ.",
            "在世界中：f = −m g，τ = (c − p) × f。再用 Rᵀ 把两者变到基座坐标轴。",
        ),
    ),
    answer=Text(
        """Not the weight but what balances it: RNEA returns what must act from outside on the base so that the robot
        stays at rest, and that is +m g upward, 16.085 kg × 9.81 m/s² = 157.794 N. In the pseudocode the sign comes
        from a₀ = −g: the base rises, and I a points upward.

        Nor is the moment zero. The weight acts at the centre of mass, which lies 8.2 mm in front of the base's origin
        (and 28.5 mm below it, which does not matter here). Held at the origin the nose would sink: the moment is
        c × m g = −1.297 N m about y. It vanishes only where the centre of mass is straight above or below the origin.
        In our order mg is entry 5, in Pinocchio's, which has the force first, entry 2.

        With a tilted base the same wrench is turned by Rᵀ into the base's axes: then (0, 0, m g) is not even right for
        the force.""",
        """它不是重力，而是与重力平衡的力：RNEA 返回的是使机器人静止时外界必须对基座施加的 wrench，即向上的 +m g，
        16.085 kg × 9.81 m/s² = 157.794 N。在伪代码中，符号来自 a₀ = −g：基座向上加速，I a 朝上。

        力矩也不为零。重力作用在质心，质心在基座原点前方 8.2 mm（还低 28.5 mm，但这里没有影响）。
        若只托住原点，机头会下沉，所以需要绕 y 轴的力矩 c × m g = −1.297 N m。
        只有质心在原点正上方或正下方时力矩才为零。按本章顺序 mg 是第 5 个分量；Pinocchio 力在前，是第 2 个。

        基座倾斜时，同一个 wrench 要用 Rᵀ 变到基座坐标轴中，这时连力也不再是 (0, 0, m g)。""",
    ),
)
