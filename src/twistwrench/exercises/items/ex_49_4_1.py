"""Exercise 49.4.1: what one foot carries."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import WRENCH
from ..robots import robot
from ..text import Text
from ..wrong import as_column, negated, swapped, times

__all__ = ["EXERCISE", "foot_loads", "foot_wrench"]


def foot_loads() -> Any:
    """Force on one foot, for 12 kg and for the model's mass."""
    mass = sum(body.mass for body in tw.load("go2").inertia)
    return 12 * 9.81 / 4, mass * 9.81 / 4


def foot_wrench(model: Any, q: Any, foot: Any) -> Any:
    """Wrench of the ground on one of four feet, in the foot's frame."""
    mass = sum(body.mass for body in model.inertia)
    R = tw.frame_placement(model, q, foot).rotation
    upward = -mass * model.gravity / 4
    return np.concatenate([np.zeros(3), R.mT @ upward])


def _loads(mass: float, *, model: float = 16.085, g: float = 9.81, feet: int = 4) -> Any:
    return mass * g / feet, model * g / feet


def _share(model: Any) -> Any:
    return -sum(body.mass for body in model.inertia) * model.gravity / 4


def _of_mass(model: Any, q: Any, foot: Any, mass: Any) -> Any:
    """Give the robot another mass."""
    return foot_wrench(model, q, foot) * mass / sum(body.mass for body in model.inertia)


def _turned(model: Any, q: Any, foot: Any, how: Any) -> Any:
    """Turn the force in another way."""
    return np.concatenate([np.zeros(3), how(tw.frame_placement(model, q, foot).rotation) @ _share(model)])


def _about(model: Any, q: Any, foot: Any, frame: str) -> Any:
    """Take the same wrench to another frame."""
    foot_in_world = tw.frame_placement(model, q, foot)
    there = tw.frame_placement(model, q, frame).inverse() if frame else tw.SE3.identity()
    return (there @ foot_in_world).force_transform() @ foot_wrench(model, q, foot)


def _cases(rng: Any) -> Any:
    model = robot("go2")
    feet = rng.permutation(["FL_foot", "FR_foot", "RL_foot", "RR_foot"])
    return [
        (model, model.integrate(model.standing(), rng.normal(scale=0.3, size=model.nv)), str(foot)) for foot in feet
    ]


LOADS = Part(
    solution=foot_loads,
    doc=Text(
        """Return the force of the ground on one foot: with 12 kg, and with the model's mass.

        `tw.load("go2")` is the model; its `.inertia` is a list of bodies, each with a `.mass` in kg.
        Returns: two numbers, N, positive.""",
        """返回地面对一只脚的力：质量为 12 kg 时，以及按模型的质量。

        `tw.load("go2")` 是模型；它的 `.inertia` 是刚体列表，每个刚体有 `.mass`(kg)。
        返回：两个数，N，取正。""",
    ),
    returns=(Quantity("f_z (12 kg)", unit="N"), Quantity("f_z (model)", unit="N")),
    cases=lambda rng: [()],
    rtol=5e-4,
    slips={
        "nominal-mass": lambda: _loads(12, model=12),
        "one-link": lambda: _loads(12, model=7.277),
        "welded-left-out": lambda: _loads(12, model=16.085 - 12 * 0.089),
        "not-shared": lambda: _loads(12, feet=1),
        "shared-by-two": lambda: _loads(12, feet=2),
        "mass-for-weight": lambda: _loads(12, g=1),
        "g-rounded": lambda: _loads(12, g=9.8),
        "g-ten": lambda: _loads(12, g=10),
        "force-sign": lambda: _loads(-12, model=-16.085),
        "thousand": lambda: _loads(12, g=9810),
    },
)

OF_FOOT = Part(
    solution=foot_wrench,
    doc=Text(
        """Return the wrench of the ground on one foot, in the foot's own frame.

        A point contact that carries a quarter of the weight; the ground pushes straight up.

        model: Go2, as `tw.load("go2")` gives it. `model.inertia` lists its bodies, `model.gravity`
        is (0, 0, -9.81) m/s². q: array (19,). foot: string, as "FR_foot".
        `tw.frame_placement(model, q, foot)` places the foot in the world; its `.rotation` is R.
        Returns: array (6,), (τ, f), N m and N, along the axes and about the origin of the foot.""",
        """返回地面对一只脚的 wrench，在脚自身坐标系中表达。

        点接触，承担四分之一体重，地面竖直向上推。

        model：`tw.load("go2")` 得到的 Go2。`model.inertia` 列出各刚体，
        `model.gravity` 为 (0, 0, -9.81) m/s²。q：数组 (19,)。foot：字符串，如 "FR_foot"。
        `tw.frame_placement(model, q, foot)` 是脚在世界中的位姿，`.rotation` 就是 R。
        返回：数组 (6,)，(τ, f)，N m 与 N，用脚坐标系的坐标轴，对脚的原点取矩。""",
    ),
    returns=(Quantity("F", WRENCH),),
    cases=_cases,
    slips={
        "swapped-halves": swapped(foot_wrench),
        "aligned-for-local": lambda model, q, foot: _turned(model, q, foot, lambda R: np.eye(3)),
        "rotation-forward": lambda model, q, foot: _turned(model, q, foot, lambda R: R),
        "wrench-about-world": lambda model, q, foot: _about(model, q, foot, ""),
        "joint-for-frame": lambda model, q, foot: _about(model, q, foot, foot[:2] + "_calf_joint"),
        "force-sign": negated(foot_wrench),
        "not-shared": times(foot_wrench, 4),
        "shared-by-two": times(foot_wrench, 2),
        "mass-for-weight": times(foot_wrench, 1 / 9.81),
        "nominal-mass": lambda model, q, foot: _of_mass(model, q, foot, 12.0),
        "one-link": lambda model, q, foot: _of_mass(model, q, foot, model.inertia[1].mass),
        "g-ten": times(foot_wrench, 10 / 9.81),
        "g-rounded": times(foot_wrench, 9.8 / 9.81),
        "column-vector": as_column(foot_wrench),
    },
    properties=(
        Property(
            Text("a point contact has no moment about itself", "点接触对接触点没有力矩"),
            lambda answer, model, q, foot: answer[:3],
        ),
        Property(
            Text("in the axes of the world the force points straight up", "在世界坐标轴中力竖直向上"),
            lambda answer, model, q, foot: (tw.frame_placement(model, q, foot).rotation @ answer[3:])[:2],
        ),
        Property(
            Text(
                "four such feet carry the weight that RNEA finds at the base",
                "四只这样的脚正好托住 RNEA 在基座处算出的重力",
            ),
            lambda answer, model, q, foot: (
                4 * np.sqrt((answer[3:] ** 2).sum()) - np.sqrt((tw.gravity(model, q)[3:6] ** 2).sum())
            ),
        ),
    ),
)

EXERCISE = Exercise(
    id="49.4.1",
    kind="number",
    title=Text("What one foot carries", "一只脚承受多少"),
    text=Text(
        """A Go2 of 12 kg stands on level ground, and its four feet share the weight evenly. Which force acts on each
        foot?

        The 12 kg are the chapter's. The model that it loads weighs more: give the force for that as well.
        Then write it as a wrench in the frame of one foot. That frame is fixed to the calf and leans with it,
        so the force is not simply (0, 0, f_z).""",
        """质量 12 kg 的 Go2 站在水平地面上，四只脚均匀承重。每只脚受到多大的力？

        12 kg 是本章给的数；本章加载的模型其实更重，请把按模型质量得到的力也写出来。
        然后写成脚坐标系中的 wrench。脚坐标系固定在小腿上，随小腿倾斜，
        所以力并不就是 (0, 0, f_z)。""",
    ),
    parts=(LOADS, OF_FOOT),
    hints=(
        Text(
            "At rest the ground carries the whole weight, m g, and here each foot a quarter of it.",
            "静止时地面承担全部重力 m g，这里每只脚承担四分之一。",
        ),
        Text(
            "The mass of the model is the sum over all its bodies: not one link, and not the number on the data sheet.",
            "模型的质量要对所有刚体求和：不是某个连杆的质量，也不是说明书上的数。",
        ),
        Text(
            "Upward is (0, 0, 1) in the world. The foot's R takes coordinates in the foot to the world, so Rᵀ takes "
            "them back.",
            "竖直向上在世界中是 (0, 0, 1)。脚的 R 把脚坐标变为世界坐标，所以变回去用 Rᵀ。",
        ),
    ),
)
