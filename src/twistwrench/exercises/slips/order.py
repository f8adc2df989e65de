"""Slips of order, frame, unit and shape."""

from ..text import Text
from .slip import Slip

__all__ = ["ORDER"]

ORDER = {
    "swapped-halves": Slip(
        Text("(ω, v) and (v, ω) are swapped", "(ω, v) 与 (v, ω) 顺序颠倒"),
        Text(
            "Here the angular half comes first: twists are (ω, v), wrenches (τ, f). Pinocchio stores the linear half "
            "first.",
            "这里角分量在前：twist 为 (ω, v)，wrench 为 (τ, f)。Pinocchio 的存储是线分量在前。",
        ),
        "49.2",
    ),
    "qwxyz": Slip(
        Text("the quaternion is read as (qw, qx, qy, qz)", "四元数按 (qw, qx, qy, qz) 读取"),
        Text(
            "Pinocchio's q, and ours, stores (qx, qy, qz, qw): the scalar part is last.",
            "Pinocchio（和这里）的 q 存储顺序是 (qx, qy, qz, qw)：标量部分在最后。",
        ),
        "49.1",
    ),
    "degrees": Slip(
        Text("degrees in place of radians", "用了角度制而不是弧度制"),
        Text(
            "All angles are in rad, all rates in rad/s: 180° are π rad.",
            "角度一律用 rad，角速度用 rad/s:180° 等于 π rad。",
        ),
        "49.2",
    ),
    "thousand": Slip(
        Text("a factor of 1000: milli or kilo", "差了 1000 倍：毫或千"),
        Text("SI units without prefixes: m, kg, N, s.", "使用不带词头的国际单位：m、kg、N、s。"),
        "49.1",
    ),
    "transposed-answer": Slip(
        Text("the matrix is transposed: its rows and columns are exchanged", "矩阵被转置：行列互换"),
        Text(
            "Check on one entry: row i, column j tells how component j of what goes in reaches component i of what "
            "comes out.",
            "用一个元素检验：第 i 行第 j 列表示输入的第 j 个分量如何影响输出的第 i 个分量。",
        ),
        "49.3",
    ),
    "column-vector": Slip(
        Text("a column (n, 1) in place of a plain vector (n,)", "返回了列向量 (n, 1)，而不是一维数组 (n,)"),
        Text(
            "Vectors are one-dimensional arrays here; `.ravel()` makes one.",
            "这里的向量是一维数组；可用 `.ravel()` 得到。",
        ),
        "49.2",
    ),
    "nq-for-nv": Slip(
        Text("nq in place of nv", "把 nq 当成了 nv"),
        Text(
            "Velocities, accelerations and torques have nv entries. q has one more for each quaternion (and each "
            "angle kept as cos and sin).",
            "速度、加速度、力矩都是 nv 维；q 中每个四元数（以及每个以 cos、sin 存储的角）多占一个分量。",
        ),
        "49.1",
    ),
    "euler-order": Slip(
        Text("the Euler angles are applied in the wrong order", "欧拉角的旋转顺序错了"),
        Text(
            "Roll, pitch, yaw of a URDF means R = Rz(yaw) Ry(pitch) Rx(roll).",
            "URDF 的 rpy 表示 R = Rz(yaw) Ry(pitch) Rx(roll)。",
        ),
        "49.1",
    ),
    "world-for-local": Slip(
        Text("expressed in the world frame, not in the body's own", "在世界坐标系中表达，而不是在自身坐标系中"),
        Text(
            "A body twist is seen from the body: its axes, and the velocity of its own origin.",
            "body twist 是从刚体自身看的：用它自己的坐标轴，线速度是它自己原点的速度。",
        ),
        "49.2",
    ),
    "local-for-world": Slip(
        Text("expressed in the body's own frame, not in the world frame", "在自身坐标系中表达，而不是在世界坐标系中"),
        Text(
            "A spatial twist has the axes and the origin of the world.", "spatial twist 使用世界坐标系的坐标轴和原点。"
        ),
        "49.2",
    ),
    "local-for-aligned": Slip(
        Text("the body's own axes in place of the world's", "用了自身坐标轴，而不是世界坐标轴"),
        Text(
            "World-aligned means: at the frame's origin, but along the axes of the world. Turn both halves by R.",
            "世界对齐（LOCAL_WORLD_ALIGNED）表示：参考点在该坐标系原点，坐标轴与世界平行。两半都要乘以 R。",
        ),
        "49.9",
    ),
    "world-for-aligned": Slip(
        Text(
            "the velocity of the point at the world's origin, not of the frame's own",
            "取了世界原点处的速度，而不是该坐标系原点的速度",
        ),
        Text(
            "A foot's velocity is that of its own point. The world twist is about the world's origin: they differ by "
            "ω × p.",
            "脚的速度是脚这一点的速度；世界 twist 的参考点是世界原点：两者相差 ω × p。",
        ),
        "49.9",
    ),
    "angular-for-linear": Slip(
        Text("the angular rows in place of the linear ones", "取了角速度行，而不是线速度行"),
        Text(
            "In the order (ω, v) the linear rows are 3:6; in Pinocchio's order they are 0:3.",
            "按 (ω, v) 的顺序，线速度是 3:6 行；按 Pinocchio 的顺序是 0:3 行。",
        ),
        "49.11",
    ),
    "one-triangle": Slip(
        Text("only one triangle of a symmetric matrix is filled", "对称矩阵只填了一个三角"),
        Text(
            "The other triangle is its mirror image; a solver reads both.", "另一个三角是它的镜像；求解器两边都会读取。"
        ),
        "49.8",
    ),
    "doubled-off-diagonal": Slip(
        Text("the entries off the diagonal are doubled", "非对角元素被加倍"),
        Text(
            "M + Mᵀ − diag(M) mends a matrix of one triangle. What pin.crba returns in Python is symmetric already.",
            "M + Mᵀ − diag(M) 只适用于仅有一个三角的矩阵；Python 中 pin.crba 的返回值已经对称。",
        ),
        "49.8",
    ),
    "universe-for-base": Slip(
        Text("body 0, the universe, in place of the base", "取了第 0 个物体（universe），而不是基座"),
        Text(
            "Index 0 is the world, which has no inertia. The floating base is body 1.",
            "索引 0 是世界，没有惯量；浮动基座是第 1 个物体。",
        ),
        "49.5",
    ),
    "welded-left-out": Slip(
        Text("the links welded to a body are left out", "漏掉了焊接在该物体上的连杆"),
        Text(
            "A fixed joint does not move: what hangs on it counts with the link that carries it.",
            "固定关节不动：挂在上面的连杆要并入承载它的连杆。",
        ),
        "49.5",
    ),
    "nq-nv-exchanged": Slip(
        Text("nq and nv are exchanged", "nq 与 nv 弄反"),
        Text(
            "q counts the four numbers of the quaternion, v the three of the angular velocity: nq = nv + 1.",
            "q 含四元数的 4 个数，v 含角速度的 3 个数：nq = nv + 1。",
        ),
        "49.1",
    ),
    "quaternion-of-three": Slip(
        Text("the quaternion is counted as three numbers", "把四元数算成了 3 个数"),
        Text(
            "It has four, tied by one condition: its length is 1. That is why nq = nv + 1.",
            "四元数有 4 个数，受单位长度约束：所以 nq = nv + 1。",
        ),
        "49.1",
    ),
    "euler-of-four": Slip(
        Text("the Euler angles are counted as four numbers", "把欧拉角算成了 4 个数"),
        Text(
            "There are three angles, so q of the base has 3 + 3 entries.",
            "欧拉角只有 3 个，所以基座的 q 有 3 + 3 个分量。",
        ),
        "49.1",
    ),
    "base-assumed": Slip(
        Text("a free-flyer is counted once, whether it is there or not", "不管有没有 FreeFlyer，都只算了一个"),
        Text(
            "An arm on a table has none, two robots in one model have two: count what is in the list.",
            "固定在桌上的机械臂没有，一个模型中的两台机器人有两个：列表里有几个就算几个。",
        ),
        "49.1",
    ),
    "robot-hard-coded": Slip(
        Text("the sizes of one robot are written into the function", "把某一台机器人的维数写死在函数里"),
        Text(
            "Another robot has other sizes: take them from the arguments, as `[6:]` does.",
            "换一台机器人维数就不同：应由参数得到，如 `[6:]`。",
        ),
        "49.8",
    ),
    "angle-of-one": Slip(
        Text("a continuous joint is counted as one number in q", "连续旋转关节在 q 中只算了 1 个数"),
        Text(
            "Pinocchio keeps its angle as (cos, sin): two numbers in q, one in v.",
            "Pinocchio 用 (cos, sin) 存储其角度：q 中 2 个数，v 中 1 个数。",
        ),
        "49.1",
    ),
    "aligned-for-local": Slip(
        Text("the world's axes in place of the body's own", "用了世界坐标轴，而不是自身坐标轴"),
        Text(
            "The reference point is right. Turn both halves into the body's axes by Rᵀ.",
            "参考点是对的；两半都还要用 Rᵀ 变到自身坐标轴。",
        ),
        "49.2",
    ),
    "pinocchio-velocity": Slip(
        Text(
            "v is in the other order: the base moves where it should turn",
            "v 的顺序反了：基座在平移而不是转动",
        ),
        Text(
            "Here v[:3] is the base's ω and v[3:6] its v. Pinocchio has them the other way round.",
            "这里 v[:3] 是基座的 ω，v[3:6] 是线速度；Pinocchio 恰好相反。",
        ),
        "49.2",
    ),
    "joint-for-frame": Slip(
        Text("the frame of the last joint in place of the foot's", "取了最后一个关节的坐标系，而不是脚的坐标系"),
        Text(
            "The foot is welded to the calf: same body, another reference point. Use the frame, not the joint.",
            "脚焊接在小腿上：同一刚体，参考点不同。应取 frame，而不是 joint。",
        ),
        "49.2",
    ),
}
