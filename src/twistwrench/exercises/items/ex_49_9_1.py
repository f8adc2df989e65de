"""Exercise 49.9.1: what is left of the equation when a robot stands still."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import JOINT_SPACE, WRENCH
from ..robots import robot
from ..text import Text
from ..wrong import after, swapped

__all__ = ["EXERCISE", "net_wrench", "out_of_balance"]


def out_of_balance(model: Any, q: Any, tau: Any, forces: Any) -> Any:
    """Leftover of g = Sᵀτ + J_cᵀλ."""
    S = tw.selection_matrix(model)
    J_c = tw.contact_jacobian(model, q, model.feet)
    return tw.gravity(model, q) - S.mT @ tau - J_c.mT @ forces.ravel()


def net_wrench(model: Any, q: Any, forces: Any) -> Any:
    """Wrench of weight and feet about the centre of mass."""
    p_G = tw.center_of_mass(model, q)
    feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])
    moment = np.cross(feet - p_G, forces).sum(0)
    return np.concatenate([moment, forces.sum(0) + model.mass * model.gravity])


def _terms(model: Any, q: Any, tau: Any, forces: Any) -> Any:
    """Return g, Sᵀτ and J_cᵀλ."""
    on_joints = np.concatenate([np.zeros(6), tau])
    return tw.gravity(model, q), on_joints, _carried(model, q, forces)


def _carried(model: Any, q: Any, forces: Any, rows: Any = slice(3, 6), **where: Any) -> Any:
    """Return J_cᵀλ, with the rows and the reference of the Jacobians of somebody's choice."""
    frames = where.pop("frames", model.feet)
    where = where or {"reference": "local_world_aligned"}
    return sum(tw.frame_jacobian(model, q, name, **where)[rows].mT @ f for name, f in zip(frames, forces))


def _left(combine: Any) -> Any:
    """Combine g, Sᵀτ and J_cᵀλ wrongly."""
    return lambda model, q, tau, forces: combine(*_terms(model, q, tau, forces))


def _jacobian(rows: Any = slice(3, 6), **where: Any) -> Any:
    """Take other Jacobians."""

    def wrong(model: Any, q: Any, tau: Any, forces: Any) -> Any:
        g, on_joints, _ = _terms(model, q, tau, 0 * forces)
        return g - on_joints - _carried(model, q, forces, rows, **where)

    return wrong


CALVES = tuple(f"{leg}_calf_joint" for leg in ("FL", "FR", "RL", "RR"))


def _about(point: Any) -> Any:
    """Take the moments about another point; the weight has one then, which is left out."""

    def wrong(model: Any, q: Any, forces: Any) -> Any:
        feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])
        answer = net_wrench(model, q, forces)
        answer[:3] = np.cross(feet - point(model, q), forces).sum(0)
        return answer

    return wrong


def _weight(weight: Any) -> Any:
    """Take another weight."""

    def wrong(model: Any, q: Any, forces: Any) -> Any:
        answer = net_wrench(model, q, forces)
        answer[3:] = forces.sum(0) + weight(model)
        return answer

    return wrong


def _cases(rng: Any) -> Any:
    model = robot("go2")
    return [
        (model, model.random_configuration(rng=rng), rng.normal(scale=5, size=12), rng.normal(scale=40, size=(4, 3)))
        for _ in range(2)
    ]


def _of_base(model: Any, q: Any, forces: Any) -> Any:
    """Return the wrench on the base that weight and feet amount to, from its six rows, taken to the centre of mass."""
    at_base = (_carried(model, q, forces) - tw.gravity(model, q))[:6]
    T = tw.frame_placement(model, q, "base")
    return tw.force_transform(T.rotation, T.translation - tw.center_of_mass(model, q)) @ at_base


BALANCE = Part(
    solution=out_of_balance,
    doc=Text(
        """Return what is left over of the equation of a robot at rest: g − Sᵀτ − J_cᵀλ.

        model: Go2. q: array (19,). tau: array (12,), N m, of the motors.
        forces: array (4, 3), N, of the ground on each of `model.feet`, in the axes of the world.
        `tw.selection_matrix(model)`, `tw.contact_jacobian(model, q, model.feet)` and
        `tw.gravity(model, q)` are there.
        Returns: array (18,), N m and N. It is zero where the robot stays at rest.""",
        """返回静止机器人方程的剩余量：g − Sᵀτ − J_cᵀλ。

        model：Go2。q：数组 (19,)。tau：数组 (12,)，N m，电机力矩。
        forces：数组 (4, 3)，N，地面对 `model.feet` 各脚的力，用世界坐标轴。
        可用 `tw.selection_matrix(model)`、`tw.contact_jacobian(model, q, model.feet)`、
        `tw.gravity(model, q)`。
        返回：数组 (18,)，N m 与 N；保持静止时为零。""",
    ),
    returns=(Quantity("g − Sᵀτ − J_cᵀλ", JOINT_SPACE),),
    cases=_cases,
    slips={
        "torques-left-out": _left(lambda g, joints, feet: g - feet),
        "contact-missing": _left(lambda g, joints, feet: g - joints),
        "gravity-missing": _left(lambda g, joints, feet: -joints - feet),
        "gravity-sign": _left(lambda g, joints, feet: -g - joints - feet),
        "external-sign": _left(lambda g, joints, feet: g - joints + feet),
        "selection-first": _left(lambda g, joints, feet: g - np.concatenate([joints[6:], np.zeros(6)]) - feet),
        "base-missing": after(out_of_balance, lambda x: x[6:]),
        "angular-for-linear": _jacobian(slice(0, 3), reference="local_world_aligned"),
        "local-for-aligned": _jacobian(reference="local"),
        "world-for-aligned": _jacobian(reference="world"),
        "joint-for-frame": _jacobian(frames=CALVES),
        "swapped-halves": swapped(out_of_balance),
    },
    reasons={
        "gravity-missing": Text(
            "At rest h is g(q): the weight is what has to be held.", "静止时 h 就是 g(q)：需要托住的正是重力。"
        ),
        "gravity-sign": Text(
            "g(q) is what would hold the robot, so it stands beside M q̈, and Sᵀτ and J_cᵀλ are taken off.",
            "g(q) 是托住机器人所需的力，与 M q̈ 在同一边；再减去 Sᵀτ 和 J_cᵀλ。",
        ),
        "external-sign": Text(
            "What the ground gives, nobody else need: it is taken off.", "地面提供的力，无需别处再提供：应当减去。"
        ),
    },
    properties=(
        Property(
            Text("the base's rows do not know the motors", "基座的六行与电机无关"),
            lambda answer, model, q, tau, forces: answer[:6] - out_of_balance(model, q, 0 * tau, forces)[:6],
        ),
    ),
)

NET = Part(
    solution=net_wrench,
    doc=Text(
        """Return the wrench of all that acts on the robot from outside: its weight and the ground's
        forces.

        model: Go2. q: array (19,). forces: array (4, 3), N, of the ground on each of `model.feet`,
        in the world's axes.
        `model.mass` is in kg, `model.gravity` is (0, 0, −9.81) m/s².
        Returns: array (6,), (τ, f), N m and N, about the centre of mass, in the axes of the world.""",
        """返回外界对机器人的全部作用力（重力与地面力）的合 wrench。

        model：Go2。q：数组 (19,)。forces：数组 (4, 3)，N，地面对 `model.feet` 各脚的力，用世界坐标
        轴。
        `model.mass` 单位 kg，`model.gravity` 为 (0, 0, −9.81) m/s²。
        返回：数组 (6,)，(τ, f)，N m 与 N，对质心取矩，用世界坐标轴。""",
    ),
    returns=(Quantity("F", WRENCH),),
    cases=lambda rng: [(model, q, forces) for model, q, _, forces in _cases(rng)],
    slips={
        "moment-about-origin": _about(lambda model, q: np.zeros(3)),
        "base-for-com": _about(lambda model, q: q[:3]),
        "lever-reversed": after(net_wrench, lambda F: F * np.repeat([-1, 1], 3)),
        "cross-order": after(net_wrench, lambda F: F * np.repeat([-1, 1], 3)),
        "coupling-dropped": after(net_wrench, lambda F: F * np.repeat([0, 1], 3)),
        "gravity-missing": _weight(lambda model: 0 * model.gravity),
        "weight-upward": _weight(lambda model: -model.mass * model.gravity),
        "mass-for-weight": _weight(lambda model: np.array([0, 0, -model.mass])),
        "one-link": _weight(lambda model: model.inertia[1].mass * model.gravity),
        "nominal-mass": _weight(lambda model: 12 * model.gravity),
        "averaged": lambda model, q, forces: net_wrench(model, q, forces / 4),
        "swapped-halves": swapped(net_wrench),
    },
    reasons={
        "gravity-missing": Text(
            "The weight acts from outside as well: m g, at the centre of mass.", "重力也是外力：m g，作用在质心。"
        ),
        "base-for-com": Text(
            "q[:3] is the base's origin. The moments are about the centre of mass, `tw.center_of_mass`.",
            "q[:3] 是基座原点；力矩是对质心取的，用 `tw.center_of_mass`。",
        ),
        "coupling-dropped": Text(
            "Each force has a moment about the centre of mass: (p_k − p_G) × f_k.",
            "每个力对质心都有力矩：(p_k − p_G) × f_k。",
        ),
    },
    alike=(frozenset({"lever-reversed", "cross-order"}),),
    properties=(
        Property(
            Text(
                "carried to the base's frame, it is what the base's rows of J_cᵀλ − g say",
                "变到基座坐标系后，应等于 J_cᵀλ − g 的基座六行",
            ),
            lambda answer, model, q, forces: answer - _of_base(model, q, forces),
        ),
    ),
)

EXERCISE = Exercise(
    id="49.9.1",
    kind="explain",
    title=Text("The equation at rest", "静止时的方程"),
    text=Text(
        """Go2 stands still: q̇ = 0, q̈ = 0. Write down what is left of its equation of motion, and compute by how much
        given torques and contact forces miss it. Then add up the wrench of weight and ground about the centre of mass,
        and explain why the contact forces must balance gravity, whatever the motors do.""",
        """Go2 静止站立：q̇ = 0，q̈ = 0。写出此时的动力学方程，并计算给定力矩和接触力时方程的剩余量。
        然后求重力与地面力对质心的合 wrench，并解释为什么无论电机怎样出力，接触力都必须与重力平衡。""",
    ),
    parts=(BALANCE, NET),
    hints=(
        Text(
            "Go through M q̈ + h = Sᵀτ + J_cᵀλ term by term. Which of them vanish at rest, and what is left of h?",
            "逐项看 M q̈ + h = Sᵀτ + J_cᵀλ：静止时哪些项为零？h 还剩什么？",
        ),
        Text(
            "λ stacks the four forces, as `forces.ravel()` does. The first six rows have no τ in them.",
            "λ 由四个力依次排成，即 `forces.ravel()`。前六行中没有 τ。",
        ),
        Text(
            "Each force has the moment (p_k − p_G) × f_k about the centre of mass. The weight has none.",
            "每个力对质心的力矩是 (p_k − p_G) × f_k；重力对质心没有力矩。",
        ),
    ),
    answer=Text(
        """With q̇ = q̈ = 0 the inertial and velocity terms vanish and h is g(q). What is left is g(q) = Sᵀτ + J_cᵀλ.
        The first six rows, those of the base, have no τ in them: g_b = J_cbᵀ λ. They say that the wrench of the contact
        forces is the opposite of the weight's: Σ f_k = −m g = (0, 0, 157.8) N, and Σ (p_k − p_G) × f_k = 0. No motor
        can help, since motors act between two bodies of the robot, with equal and opposite wrenches: over the whole
        robot they cancel. What they do is found in the other twelve rows, τ = g_j − J_cjᵀ λ, once λ is known.""",
        """q̇ = q̈ = 0 时惯性项和速度项为零，h 只剩 g(q)，方程成为 g(q) = Sᵀτ + J_cᵀλ。
        前六行（基座）不含 τ：g_b = J_cbᵀ λ，即接触力的合 wrench 与重力相反：
        Σ f_k = −m g = (0, 0, 157.8) N，Σ (p_k − p_G) × f_k = 0。电机帮不上忙：它作用在机器人的两个刚体之间，
        大小相等、方向相反，对整机互相抵消。电机力矩由其余十二行给出：λ 已知后 τ = g_j − J_cjᵀ λ。""",
    ),
)
