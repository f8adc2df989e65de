"""The project, stage 1: a toolbox of spatial vectors."""

from ..exercise import Exercise
from ..text import Text
from .project_operators import CROSS, TRANSFORMS
from .project_toolbox import POSE_OF_BASE, POSE_OF_URDF, VECTOR
from .project_tree import PLACEMENTS, TWISTS, WRENCHES

__all__ = ["EXERCISE"]

EXERCISE = Exercise(
    id="project.1",
    kind="code",
    title=Text("Stage 1: a toolbox of spatial vectors", "阶段 1：空间向量工具库"),
    text=Text(
        """Write a toolbox of your own: spatial vectors that know whether they are twists or wrenches; placements out
        of a configuration and out of a URDF; X and X*; V× and V×*. Then use it along a tree: placements, twists and
        wrenches of all bodies, to 1e-12 what Pinocchio has in `data.oMi`, `data.v` and `data.f` (in its order (v, ω)).

        Write it with NumPy alone; `tw.skew` and `tw.exp3` may help. Nothing here is longer than ten lines.""",
        """写一个自己的工具库：知道自己是 twist 还是 wrench 的空间向量；由位形和由 URDF 得到的位姿；X 与 X*；V× 与 V×*。
        然后把它用到一棵树上：求所有物体的位姿、twist 和 wrench，与 Pinocchio 的 `data.oMi`、`data.v`、`data.f`
        （按其 (v, ω) 顺序）相差不超过 1e-12。

        只用 NumPy；可借助 `tw.skew` 和 `tw.exp3`。每个函数都不超过十行。""",
    ),
    parts=(VECTOR, POSE_OF_BASE, POSE_OF_URDF, TRANSFORMS, CROSS, PLACEMENTS, TWISTS, WRENCHES),
    hints=(
        Text(
            "Two things of different kinds cannot be added: look at `other.kind`, and raise a TypeError.",
            "不同种类的量不能相加：检查 `other.kind`，抛出 TypeError。",
        ),
        Text(
            "Pinocchio's quaternion is (qx, qy, qz, qw). A URDF's rpy means Rz(yaw) Ry(pitch) Rx(roll).",
            "Pinocchio 的四元数是 (qx, qy, qz, qw)；URDF 的 rpy 表示 Rz(yaw) Ry(pitch) Rx(roll)。",
        ),
        Text(
            "T[i] leads from frame i to its parent. A twist goes the other way, by X of the inverse of T[i]; a wrench "
            "goes inward by X* of T[i], from the tips on.",
            "T[i] 从坐标系 i 通向父坐标系。twist 反向传递，用 T[i] 之逆的 X；wrench 用 T[i] 的 X* 向内传，从末端开始。",
        ),
    ),
)
