"""Exercise 49.0.4: what nq and nv count."""

from typing import Any

from ..exercise import Exercise, Part, Property, Quantity
from ..text import Text

__all__ = ["EXERCISE", "count"]


def count(kinds: Any) -> Any:
    """Nq and nv of a list of joints."""
    in_q = {"revolute": 1, "prismatic": 1, "continuous": 2, "spherical": 4, "free_flyer": 7}
    in_v = {"revolute": 1, "prismatic": 1, "continuous": 1, "spherical": 3, "free_flyer": 6}
    return sum(in_q[kind] for kind in kinds), sum(in_v[kind] for kind in kinds)


def _less(kinds: Any, *, fewer: dict[str, int]) -> Any:
    """Count some kinds of joint as fewer numbers in q."""
    nq, nv = count(kinds)
    return nq - sum(fewer.get(kind, 0) for kind in kinds), nv


def _cases(rng: Any) -> Any:
    others = ["revolute", "prismatic", "continuous", "spherical"]
    every = ["free_flyer", *others]

    def some(n: int) -> list[str]:
        return [str(kind) for kind in rng.choice(others, size=n)]

    return [(every + some(4),), (some(5),), (every + some(3) + ["free_flyer"],), (some(2) + every,)]


EXERCISE = Exercise(
    id="49.0.4",
    kind="explain",
    title=Text("nq and nv", "nq 与 nv"),
    text=Text(
        """What do nq and nv mean in Pinocchio, and why do they differ when the model has a free-flyer?
        Count both for any list of joints; a revolute or prismatic joint has one number in q and one in v.""",
        """Pinocchio 中 nq 和 nv 分别表示什么？为什么含 FreeFlyer 关节的模型中两者不同？
        对任意一串关节数出 nq 和 nv；转动关节和移动关节在 q、v 中各占 1 个数。""",
    ),
    parts=(
        Part(
            solution=count,
            doc=Text(
                """Return nq and nv, counted as Pinocchio counts.

                kinds: list of "revolute", "prismatic", "continuous" (turns without end), "spherical",
                "free_flyer".
                Returns: two whole numbers.""",
                """按 Pinocchio 的方式返回 nq 和 nv。

                kinds：列表，元素为 "revolute"、"prismatic"、"continuous"（可无限旋转）、"spherical"、
                "free_flyer"。
                返回：两个整数。""",
            ),
            returns=(Quantity("nq"), Quantity("nv")),
            cases=_cases,
            slips={
                "nq-for-nv": lambda kinds: (count(kinds)[0],) * 2,
                "nq-nv-exchanged": lambda kinds: count(kinds)[::-1],
                "quaternion-of-three": lambda kinds: _less(kinds, fewer={"free_flyer": 1, "spherical": 1}),
                "angle-of-one": lambda kinds: _less(kinds, fewer={"continuous": 1}),
                "base-missing": lambda kinds: count([kind for kind in kinds if kind != "free_flyer"]),
                "base-assumed": lambda kinds: count(["free_flyer", *(kind for kind in kinds if kind != "free_flyer")]),
            },
            reasons={
                "base-missing": Text(
                    "A free-flyer is a joint as well: 7 numbers in q, 6 in v.",
                    "FreeFlyer 也是关节：q 中 7 个数，v 中 6 个。",
                ),
            },
            properties=(
                Property(
                    Text(
                        "nq − nv counts the quaternions and the (cos, sin) pairs",
                        "nq − nv 等于四元数与 (cos, sin) 对的个数",
                    ),
                    lambda answer, kinds: (
                        answer[0] - answer[1] - sum(k in ("free_flyer", "spherical", "continuous") for k in kinds)
                    ),
                ),
            ),
        ),
    ),
    hints=(
        Text(
            "v counts the directions in which a joint can move; q the numbers that say where it is.",
            "v 数的是关节可以运动的方向；q 数的是描述其位置所用的数。",
        ),
        Text(
            """A quaternion is four numbers, for three directions. A joint that turns without end is stored as
            (cos, sin), so that q does not jump at 360°.""",
            """四元数用 4 个数描述 3 个方向。可无限旋转的关节以 (cos, sin) 存储，这样 q 在 360° 处不会跳变。""",
        ),
    ),
    answer=Text(
        """nq is the number of entries of q, which says where the robot is; nv that of v, the velocities, and so the
        number of degrees of freedom. A free-flyer has 7 in q (three for the position, four of a unit quaternion) and
        6 in v (ω and v): nq = nv + 1. Positions live on a curved set, velocities in its flat tangent space, so q̇ and v
        are not the same thing, and q is stepped by `integrate`, not by q + v dt.""",
        """nq 是 q 的分量个数，描述机器人在哪里；nv 是速度 v 的分量个数，也就是自由度数。FreeFlyer 在 q 中占 7 个
        （位置 3 个，单位四元数 4 个），在 v 中占 6 个（ω 与 v）：nq = nv + 1。位形在弯曲的流形上，
        速度在平直的切空间中，所以 q̇ 与 v 不是一回事；更新 q 要用 `integrate`，而不是 q + v dt。""",
    ),
)
