"""Slips of the mass matrix, the floating base and the centroidal momentum (sections 49.8 to 49.10)."""

from ..text import Text
from .slip import Slip

__all__ = ["FLOATING"]

FLOATING = {
    "legs-left-out": Slip(
        Text("the base alone: the legs are left out", "只算了基座：漏了腿"),
        Text(
            "What the base moves is the whole robot with its joints locked, all bodies together.",
            "锁住关节推动基座，动的是整机：要计入所有刚体。",
        ),
        "49.8",
    ),
    "njoints-for-nv": Slip(
        Text("joints are counted in place of degrees of freedom", "数的是关节个数，而不是自由度"),
        Text(
            "Pinocchio's njoints counts the universe and, as one, the free-flyer. M has a row for each entry of v.",
            "Pinocchio 的 njoints 把 universe 算一个，把自由飞行关节也只算一个；M 的行数等于 v 的维数。",
        ),
        "49.8",
    ),
    "base-let-go": Slip(
        Text(
            "the base is let go: M_jj − M_jb M_bb⁻¹ M_bj in place of M_jj",
            "放开了基座：用了 M_jj − M_jb M_bb⁻¹ M_bj，应为 M_jj",
        ),
        Text(
            "That is what the joints feel if the base is free to give way. Held, it has no acceleration.",
            "那是基座可以自由让步时关节感受到的惯量；基座被固定时，它的加速度为零。",
        ),
        "49.8",
    ),
    "base-block-for-joints": Slip(
        Text("the block of the base in place of that of the joints", "取了基座块，而不是关节块"),
        Text(
            "v has the base first: the joints are the rows and columns from 6 on.",
            "v 中基座在前：关节是第 6 行（列）以后。",
        ),
        "49.8",
    ),
    "selection-of-base": Slip(
        Text("the base is selected in place of the joints", "选出的是基座，而不是关节"),
        Text(
            "The motors drive the joints. The base has no motor, and its six columns of S are zero.",
            "电机驱动的是关节；基座没有电机，S 的前六列为零。",
        ),
        "49.9",
    ),
    "selection-of-all": Slip(
        Text("every entry of v gets a motor, the base as well", "给 v 的每个分量都配了电机，连基座也有"),
        Text("The base has none: S has nv − 6 rows.", "基座没有电机：S 只有 nv − 6 行。"),
        "49.9",
    ),
    "base-acceleration-missing": Slip(
        Text("the acceleration of the base is left out of the joint rows", "关节行漏了基座加速度的作用"),
        Text(
            "The joint rows are M_jb q̈_b + M_jj q̈_j + h_j: a base that speeds up pulls at the legs.",
            "关节行是 M_jb q̈_b + M_jj q̈_j + h_j：基座加速会牵动腿。",
        ),
        "49.9",
    ),
    "base-rows-kept": Slip(
        Text("the six rows of the base are kept among the torques", "力矩中保留了基座的六行"),
        Text("The base has no motor: τ has nv − 6 entries.", "基座没有电机：τ 有 nv − 6 个分量。"),
        "49.9",
    ),
    "joint-rows-for-forces": Slip(
        Text("λ is taken from the joint rows, as if the motors did nothing", "由关节行解 λ，好像电机不出力"),
        Text(
            "Each joint row has an unknown torque as well. The base's rows have none: they decide about λ.",
            "每个关节行都有一个未知力矩；基座行没有，λ 由基座行决定。",
        ),
        "49.11",
    ),
    "contact-rows-all": Slip(
        Text("all six rows of each foot are kept", "每只脚保留了全部六行"),
        Text(
            "A point contact exerts a force and no moment: the three linear rows.",
            "点接触只有力、没有力矩：只取三个线速度行。",
        ),
        "49.9",
    ),
    "moment-about-origin": Slip(
        Text("the moments are about the world's origin, not the centre of mass", "力矩是对世界原点取的，而不是对质心"),
        Text("The lever arm begins at the centre of mass: (p_k − p_G) × f_k.", "力臂从质心量起：(p_k − p_G) × f_k。"),
        "49.10",
    ),
    "base-last": Slip(
        Text("the base's columns are taken from the end", "把最后几列当成了基座"),
        Text("v has the base first: columns 0 to 5 are its own.", "v 中基座在前：第 0–5 列属于基座。"),
        "49.10",
    ),
    "turned-twice": Slip(
        Text("R I Rᵀ in place of R I: ω is turned twice", "写成了 R I Rᵀ，应为 R I：ω 被多转了一次"),
        Text(
            "R I Rᵀ wants an ω in the axes of the world. The base's ω is in its own, so R acts once, on the result.",
            "R I Rᵀ 要求 ω 用世界坐标轴；基座的 ω 用自身坐标轴，R 只作用一次，把结果变到世界。",
        ),
        "49.10",
    ),
    "joints-left-out": Slip(
        Text("the columns of the joints are left out", "漏了关节的列"),
        Text("A leg that swings carries momentum as well: all nv columns.", "摆动的腿也有动量：要用全部 nv 列。"),
        "49.10",
    ),
    "unweighted-mean": Slip(
        Text("the plain mean of the links, not weighted by their masses", "取了各连杆的简单平均，没有按质量加权"),
        Text("A heavy link counts more: Σ m_i c_i / Σ m_i.", "重的连杆占的分量更大：Σ m_i c_i / Σ m_i。"),
        "49.10",
    ),
    "frame-for-com": Slip(
        Text("the links' origins in place of their centres of mass", "用了连杆坐标系原点，而不是连杆质心"),
        Text(
            "A link's frame sits at its joint. Its mass is at c_i, and moves with v_i + ω_i × c_i.",
            "连杆坐标系在关节处；质量在 c_i，速度是 v_i + ω_i × c_i。",
        ),
        "49.10",
    ),
    "mixed-frames": Slip(
        Text(
            "the inertia is in the centroidal frame and the Jacobian still in the link's",
            "惯量已变到质心坐标系，雅可比却还在连杆坐标系",
        ),
        Text(
            "J_i v is the twist in frame i, so I_i must be, too. Move the momentum: X* I_i J_i.",
            "J_i v 是坐标系 i 中的 twist，I_i 也要用坐标系 i 的；再变换动量：X* I_i J_i。",
        ),
        "49.10",
    ),
    "gravity-in-rate": Slip(
        Text("gravity is counted in ḣ_G = A_G a + Ȧ_G v", "把重力算进了 ḣ_G = A_G a + Ȧ_G v"),
        Text(
            "That is kinematics, with the acceleration as it is. rnea's trick a₀ = −g does not belong here.",
            "这是运动学量，用的是真实加速度；rnea 中的技巧 a₀ = −g 不适用。",
        ),
        "49.10",
    ),
    "speed-once": Slip(
        Text("the factor s once, where it counts twice", "倍数 s 只乘了一次，应为两次"),
        Text(
            "At s times the pace velocities are s times as large, accelerations s² times.",
            "节奏变为 s 倍时，速度变为 s 倍，加速度变为 s² 倍。",
        ),
        "49.10",
    ),
    "acceleration-unscaled": Slip(
        Text("the velocity is scaled and the acceleration is not", "只改了速度，没有改加速度"),
        Text("With q(s t) the acceleration is s² a.", "位形是 q(s t) 时，加速度是 s² a。"),
        "49.10",
    ),
    "acceleration-scaled-once": Slip(
        Text("the acceleration is scaled by s in place of s²", "加速度乘了 s，应乘 s²"),
        Text("Differentiate q(s t) twice: each time a factor s comes out.", "对 q(s t) 求两次导，每次都出来一个 s。"),
        "49.10",
    ),
    "velocity-unscaled": Slip(
        Text("the acceleration is scaled and the velocity is not", "只改了加速度，没有改速度"),
        Text(
            "With q(s t) the velocity is s v, and Ȧ_G v is quadratic in it.",
            "位形是 q(s t) 时，速度是 s v，而 Ȧ_G v 对速度是二次的。",
        ),
        "49.10",
    ),
    "pace-inverted": Slip(
        Text("the pace is taken the wrong way round", "节奏的倍数弄反了"),
        Text("At pace s > 1 the robot is faster: velocities grow.", "s > 1 表示更快：速度变大。"),
        "49.10",
    ),
    "linear-for-angular": Slip(
        Text("the linear rows in place of the angular ones", "取了线动量行，而不是角动量行"),
        Text("In the order (k, l) the angular rows are 0:3.", "按 (k, l) 的顺序，角动量是 0:3 行。"),
        "49.10",
    ),
    "pendulum-hangs": Slip(
        Text("the pendulum hangs: the sign is that of a restoring force", "摆是倒挂的：符号成了恢复力"),
        Text(
            "The ground pushes the centre of mass away from the centre of pressure: ẍ = (g/z)(x − p).",
            "地面把质心推离压力中心：ẍ = (g/z)(x − p)。",
        ),
        "49.10",
    ),
    "height-dropped": Slip(
        Text("the height of the centre of mass is missing", "漏除了质心高度"),
        Text("g/z is in 1/s². Check the units.", "g/z 的单位是 1/s²；请检查单位。"),
        "49.10",
    ),
    "rate-left-out": Slip(
        Text("k̇_G is left out: that is the LIPM", "漏了 k̇_G：那就是 LIPM"),
        Text(
            "A changing angular momentum takes a share of the moment of the ground.",
            "角动量的变化要占用一部分地面力矩。",
        ),
        "49.10",
    ),
    "rate-sign": Slip(
        Text("k̇_G has the wrong sign", "k̇_G 的符号错了"),
        Text(
            "Write τ = (p − p_G) × f out: k̇_y = −z f_x − (p_x − x) f_z, and k̇_x = (p_y − y) f_z + z f_y.",
            "写出 τ = (p − p_G) × f：k̇_y = −z f_x − (p_x − x) f_z，k̇_x = (p_y − y) f_z + z f_y。",
        ),
        "49.10",
    ),
    "rate-axes": Slip(
        Text("the two components of k̇_G are exchanged", "k̇_G 的两个分量弄混了"),
        Text(
            "A moment about y pushes along x, and one about x along y.", "绕 y 的力矩影响 x 方向，绕 x 的影响 y 方向。"
        ),
        "49.10",
    ),
}
