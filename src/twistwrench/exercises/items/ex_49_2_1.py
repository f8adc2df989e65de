"""Exercise 49.2.1: the twist of a foot."""

from functools import cache
from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import TWIST
from ..robots import robot
from ..text import Text
from ..wrong import swapped

__all__ = ["EXERCISE", "foot_speed", "foot_twist"]


def foot_twist(model: Any, q: Any, omega_z: Any) -> Any:
    """Body twist of FR_foot while the base turns."""
    world_base = tw.frame_placement(model, q, "base")
    world_foot = tw.frame_placement(model, q, "FR_foot")
    foot_base = world_foot.inverse() @ world_base
    return foot_base.motion_transform() @ np.array([0, 0, omega_z, 0, 0, 0])


def foot_speed() -> Any:
    """Speed of FR_foot at the neutral posture."""
    model = tw.load("go2")
    x, y, _ = tw.frame_placement(model, model.neutral(), "FR_foot").translation
    return 0.5 * np.hypot(x, y)


_speed = cache(foot_speed)


def _base_twist(omega_z: Any) -> Any:
    return np.array([0, 0, omega_z, 0, 0, 0])


def _seen_from(model: Any, q: Any, frame: str) -> Any:
    """Return the placement of the base in a frame."""
    return tw.frame_placement(model, q, frame).inverse() @ tw.frame_placement(model, q, "base")


def _coupled(model: Any, q: Any, omega_z: Any, *, factor: float) -> Any:
    """Multiply the coupling term by a factor: the base's own velocity is zero, so that is all of v."""
    return foot_twist(model, q, omega_z) * np.repeat([1, factor], 3)


def _carried(model: Any, q: Any, omega_z: Any, *, about_world: bool) -> Any:
    """Return the foot's twist with the axes of the world, about the world's origin or the foot's."""
    world_foot = tw.frame_placement(model, q, "FR_foot")
    p = world_foot.translation if about_world else np.zeros(3)
    return tw.motion_transform(world_foot.rotation, p) @ foot_twist(model, q, omega_z)


def _cases(rng: Any) -> Any:
    model = robot("go2")
    return [(model, model.random_configuration(rng=rng), 0.5), (model, model.random_configuration(rng=rng), -1.3)]


TWIST_OF_FOOT = Part(
    solution=foot_twist,
    doc=Text(
        """Return the body twist of FR_foot while only the base turns, about its own z axis.

        model: Go2, as `tw.load("go2")` gives it. q: array (19,). omega_z: number, rad/s.
        `tw.frame_placement(model, q, "base")` places the base in the world; "FR_foot" is another
        frame.
        Returns: array (6,), (ω, v), rad/s and m/s, along the axes and at the origin of FR_foot.""",
        """返回基座只绕自身 z 轴转动时 FR_foot 的 body twist。

        model：`tw.load("go2")` 得到的 Go2。q：数组 (19,)。omega_z：数，rad/s。
        `tw.frame_placement(model, q, "base")` 给出基座在世界中的位姿；"FR_foot" 是另一个坐标系。
        返回：数组 (6,)，(ω, v)，rad/s 与 m/s，用 FR_foot 的坐标轴和原点表达。""",
    ),
    returns=(Quantity("V", TWIST),),
    cases=_cases,
    slips={
        "swapped-halves": swapped(foot_twist),
        "world-for-local": lambda model, q, omega_z: _carried(model, q, omega_z, about_world=True),
        "aligned-for-local": lambda model, q, omega_z: _carried(model, q, omega_z, about_world=False),
        "untransformed": lambda model, q, omega_z: _base_twist(omega_z),
        "coupling-dropped": lambda model, q, omega_z: _coupled(model, q, omega_z, factor=0),
        "coupling-sign": lambda model, q, omega_z: _coupled(model, q, omega_z, factor=-1),
        "inverse-transform": lambda model, q, omega_z: (
            _seen_from(model, q, "FR_foot").inverse().motion_transform() @ _base_twist(omega_z)
        ),
        "force-for-motion": lambda model, q, omega_z: (
            _seen_from(model, q, "FR_foot").force_transform() @ _base_twist(omega_z)
        ),
        "joint-for-frame": lambda model, q, omega_z: (
            _seen_from(model, q, "FR_calf_joint").motion_transform() @ _base_twist(omega_z)
        ),
        "pinocchio-velocity": lambda model, q, omega_z: (
            _seen_from(model, q, "FR_foot").motion_transform() @ np.array([0, 0, 0, 0, 0, omega_z])
        ),
        "degrees": lambda model, q, omega_z: foot_twist(model, q, np.degrees(omega_z)),
    },
    alike=(frozenset({"coupling-dropped", "force-for-motion"}),),  # X* leaves a twist without v without v
    properties=(
        Property(
            Text("ω has the same length everywhere on a rigid body", "刚体上各处 ω 的大小相同"),
            lambda answer, model, q, omega_z: (answer[:3] ** 2).sum() - omega_z**2,
        ),
        Property(
            Text(
                "the Jacobian gives the same: V = J v with v[2] = omega_z",
                "与雅可比的结果一致：V = J v，其中 v[2] = omega_z",
            ),
            lambda answer, model, q, omega_z: (
                tw.frame_jacobian(model, q, "FR_foot", reference="local")[:, 2] * omega_z - answer
            ),
        ),
    ),
)

SPEED_OF_FOOT = Part(
    solution=foot_speed,
    doc=Text(
        "Return the speed of FR_foot at the neutral posture, with the base turning at 0.5 rad/s: a number, m/s.",
        "返回零位形下、基座以 0.5 rad/s 转动时 FR_foot 的速度大小：一个数，m/s。",
    ),
    returns=(Quantity("|v|", unit="m/s"),),
    cases=lambda rng: [()],
    rtol=1e-3,
    slips={
        "thousand": lambda: 1000 * _speed(),
        "degrees": lambda: np.degrees(_speed()),
        "lever-all": lambda: 0.5 * np.linalg.norm([0.1934, -0.142, -0.426]),
        "omega-dropped": lambda: 2 * _speed(),
    },
)

EXERCISE = Exercise(
    id="49.2.1",
    kind="explain",
    title=Text("The base turns, the foot moves", "基座转动，脚在运动"),
    text=Text(
        """The base of a Go2 turns about its own z axis with ω_z = 0.5 rad/s; nothing else moves. Find the body twist
        of the
        right front foot, FR_foot, and its speed at the neutral posture. Why has the foot a linear velocity, when only
        the base turns? Use twistwrench or Pinocchio, as you like; mind the order (ω, v).""",
        """Go2 的基座绕自身 z 轴以 ω_z = 0.5 rad/s 转动，其余都不动。求右前脚 FR_foot 的 body twist，
        以及零位形下脚的速度大小。
        为什么只有基座在转动，脚却有线速度？可用 twistwrench 或 Pinocchio；注意 (ω, v) 的顺序。""",
    ),
    parts=(TWIST_OF_FOOT, SPEED_OF_FOOT),
    hints=(
        Text(
            "Base and foot are one rigid body here. Its twist is known in the base's frame: bring it to the foot's.",
            "此时基座和脚是同一个刚体。twist 在基座坐标系中已知，把它变到脚坐标系。",
        ),
        Text(
            """`foot_base = world_foot.inverse() @ world_base` places the base in the foot's frame;
            `foot_base.motion_transform()` is the X that takes the base's twist to the foot.""",
            """`foot_base = world_foot.inverse() @ world_base` 是基座在脚坐标系中的位姿；
            `foot_base.motion_transform()` 就是把基座 twist 变到脚的 X。""",
        ),
        Text(
            "A point at the distance r from the axis moves with ω r. How far is the foot from the base's z axis?",
            "离转轴距离为 r 的点速度为 ω r。脚离基座 z 轴多远？",
        ),
    ),
    answer=Text(
        """A body twist names the velocity of the body's point at its own origin. The foot is 0.240 m away from the axis
        about which everything turns, so that its origin moves on a circle, at 0.5 rad/s × 0.240 m = 0.120 m/s. In the
        formula this is the coupling term of X: v_foot = p × ω with p from the foot to the base. ω itself is the same
        for base and foot, only along other axes.""",
        """body twist 的线分量是该刚体自身原点处的速度。脚离转轴 0.240 m，它的原点沿圆周运动，速度为
        0.5 rad/s × 0.240 m = 0.120 m/s。公式中这就是 X 的耦合项：v_脚 = p × ω，p 从脚指向基座。
        ω 本身对基座和脚相同，只是坐标轴不同。""",
    ),
)
