"""Exercise 49.1.1: nq and nv of Go2."""

from typing import Any

from ..exercise import Exercise, Part, Quantity
from ..text import Text

__all__ = ["EXERCISE", "sizes"]


def sizes() -> Any:
    """Nq and nv with a quaternion, and with Euler angles."""
    joints = 12
    return 3 + 4 + joints, 3 + 3 + joints, 3 + 3 + joints, 3 + 3 + joints


EXERCISE = Exercise(
    id="49.1.1",
    kind="number",
    title=Text("How many numbers describe a Go2", "描述 Go2 需要几个数"),
    text=Text(
        "Go2 has 12 joints and a free-flying base. Give nq and nv as Pinocchio counts them, with a quaternion for the "
        "base, and again for a base whose orientation is kept in Euler angles. Then say why Pinocchio uses the "
        "quaternion.",
        "Go2 有 12 个关节和一个自由浮动的基座。给出 Pinocchio（基座姿态用四元数）中的 nq 和 nv；"
        "再给出基座姿态改用欧拉角时的 nq 和 nv。然后说明 Pinocchio 为什么用四元数。",
    ),
    parts=(
        Part(
            solution=sizes,
            doc=Text(
                "Return nq and nv with a quaternion, then nq and nv with Euler angles: four whole numbers.",
                "依次返回用四元数时的 nq、nv，用欧拉角时的 nq、nv：四个整数。",
            ),
            returns=(
                Quantity("nq (quaternion)"),
                Quantity("nv (quaternion)"),
                Quantity("nq (Euler)"),
                Quantity("nv (Euler)"),
            ),
            cases=lambda rng: [()],
            slips={
                "nq-for-nv": lambda: (19, 19, 18, 18),
                "nq-nv-exchanged": lambda: (18, 19, 18, 18),
                "quaternion-of-three": lambda: (18, 18, 18, 18),
                "euler-of-four": lambda: (19, 18, 19, 18),
                "base-missing": lambda: (12, 12, 12, 12),
            },
        ),
    ),
    hints=(
        Text(
            "Count the base's position, its orientation and the joints one by one, first in q and then in v.",
            "分别数一数基座位置、基座姿态和关节：先数 q，再数 v。",
        ),
        Text(
            "A quaternion is 4 numbers, an angular velocity always 3. Euler angles are 3.",
            "四元数是 4 个数，角速度总是 3 个；欧拉角是 3 个。",
        ),
    ),
    answer=Text(
        "Three angles cannot cover all rotations smoothly: at a pitch of ±90° two of the axes coincide, the map from "
        "angle "
        "rates to ω loses rank, and its inverse blows up. A quaternion has no such place. It needs one number more "
        "than "
        "there are degrees of freedom, so nq = nv + 1, and its length must be kept at 1 by integrating on the group.",
        "三个角无法光滑地覆盖全部旋转：俯仰角为 ±90° 时两个转轴重合，角度变化率到 ω 的映射降秩，其逆发散。"
        "四元数没有这种奇异点。代价是比自由度多一个数（nq = nv + 1），并且必须在群上积分以保持单位长度。",
    ),
)
