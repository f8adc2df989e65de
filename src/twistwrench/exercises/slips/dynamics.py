"""Slips of the dynamics: recursions, floating base, momentum (sections 49.6 to 49.11)."""

from ..text import Text
from .slip import Slip

__all__ = ["DYNAMICS"]

DYNAMICS = {
    "gravity-missing": Slip(
        Text("gravity is missing", "漏了重力"),
        Text(
            "At rest the joints still hold the robot up. Start the recursion with a₀ = −g.",
            "静止时关节仍要托住机器人。递推从 a₀ = −g 开始。",
        ),
        "49.6",
    ),
    "gravity-sign": Slip(
        Text("gravity has the wrong sign", "重力符号错了"),
        Text(
            "Gravity points down, the fictitious acceleration of the base up: a₀ = −g = (0, 0, 0, 0, 0, +9.81).",
            "重力向下，基座的虚拟加速度向上：a₀ = −g = (0, 0, 0, 0, 0, +9.81)。",
        ),
        "49.6",
    ),
    "classical-acceleration": Slip(
        Text(
            "the classical acceleration in place of the spatial one (or the other way round)",
            "混用了经典加速度与空间加速度",
        ),
        Text(
            "They differ by ω × v in the linear half: a_classical = a_spatial + ω × v.",
            "两者线分量相差 ω × v：a_经典 = a_空间 + ω × v。",
        ),
        "49.6",
    ),
    "coriolis-missing": Slip(
        Text("the Coriolis term V × S q̇ is missing", "漏了科里奥利项 V × S q̇"),
        Text(
            "The joint axis S turns with its body, so its derivative is V × S.", "关节轴 S 随刚体转动，导数为 V × S。"
        ),
        "49.6",
    ),
    "coriolis-sign": Slip(
        Text("the Coriolis term has the wrong sign", "科里奥利项符号错了"),
        Text("+V × S q̇. The order of a cross product matters.", "是 +V × S q̇；叉积的次序很重要。"),
        "49.6",
    ),
    "gyroscopic-missing": Slip(
        Text("the gyroscopic term is missing", "漏了陀螺项"),
        Text(
            "The body carries its momentum round as it turns: the rate gains V ×* I V, in three dimensions ω × I ω.",
            "动量随刚体转动，变化率中多出 V ×* I V，三维时是 ω × I ω。",
        ),
        "49.6",
    ),
    "gyroscopic-sign": Slip(
        Text("the gyroscopic term has the wrong sign", "陀螺项符号错了"),
        Text(
            "F = I a + V ×* I V, with a plus, as in Euler's equation.", "F = I a + V ×* I V，取正号，与欧拉方程一致。"
        ),
        "49.5",
    ),
    "children-overwritten": Slip(
        Text("the forces of the children are overwritten", "子连杆传来的力被覆盖"),
        Text(
            "On the way in, the children have already added to F[i]: compute I a + V ×* I V before that pass, or use "
            "+=.",
            "反向传递时子连杆已经加到 F[i] 上：先在正向传递中算好 I a + V ×* I V，或用 +=。",
        ),
        "49.6",
    ),
    "children-dropped": Slip(
        Text("the forces of the children never reach the parent", "子连杆的力没有传给父连杆"),
        Text("A joint carries everything beyond it.", "关节要承担它之后的全部连杆。"),
        "49.6",
    ),
    "force-outward": Slip(
        Text("X* in place of Xᵀ on the way in", "向内传力时用了 X*，应为 Xᵀ"),
        Text(
            "With X from the parent to link i, forces come back by Xᵀ; X* = X⁻ᵀ would lead them outward once more.",
            "X 是从父连杆到连杆 i 的变换时，力用 Xᵀ 传回；X* = X⁻ᵀ 会再次向外传。",
        ),
        "49.6",
    ),
    "force-sign": Slip(
        Text("action in place of reaction: the force has the wrong sign", "作用力与反作用力弄反：力的符号错了"),
        Text(
            "Say whose force it is and on whom. Contact forces are those of the ground on the robot.",
            "明确谁对谁施力。接触力是地面对机器人的力。",
        ),
        "49.6",
    ),
    "external-sign": Slip(
        Text("the outside force is added in place of subtracted", "外力被加上，应当减去"),
        Text(
            "What the surroundings give, the joints need not: τ = M a + h − Jᵀf.",
            "环境提供的力无需关节提供：τ = M a + h − Jᵀf。",
        ),
        "49.1",
    ),
    "jacobian-untransposed": Slip(
        Text("J in place of Jᵀ", "把 Jᵀ 写成了 J"),
        Text(
            "J takes joint velocities to velocities, Jᵀ takes forces to joint torques.",
            "J 把关节速度变为速度，Jᵀ 把力变为关节力矩。",
        ),
        "49.9",
    ),
    "contact-missing": Slip(
        Text("the contact force is left out", "漏了接触力项"),
        Text(
            "With a contact the equation gains Jᵀλ, whether the base floats or not.",
            "只要有接触，方程就多出 Jᵀλ，与基座是否浮动无关。",
        ),
        "49.1",
    ),
    "composite-for-articulated": Slip(
        Text("the composite inertia in place of the articulated one", "用了复合惯量，而不是铰接体惯量"),
        Text(
            "A joint that is free gives way: subtract U Uᵀ/D before passing the inertia on.",
            "自由的关节会让步：向父连杆传递前要减去 U Uᵀ/D。",
        ),
        "49.7",
    ),
    "articulated-bias": Slip(
        Text("a part of the bias force is not passed on", "偏置力传递不完整"),
        Text("p_a = p_A + I_a c + U u / D has three terms.", "p_a = p_A + I_a c + U u / D 有三项。"),
        "49.7",
    ),
    "bias-for-zero": Slip(
        Text("h is left out: gravity and the velocity terms are missing", "漏了 h：没有重力项和速度项"),
        Text("The equation is M a + h = τ, or a = M⁻¹ (τ − h).", "方程是 M a + h = τ，即 a = M⁻¹ (τ − h)。"),
        "49.7",
    ),
    "bias-sign": Slip(
        Text("h has the wrong sign", "h 的符号错了"),
        Text(
            "h stands beside M a: M a + h = τ, and a = M⁻¹ (τ − h).",
            "h 与 M a 在同一边：M a + h = τ，所以 a = M⁻¹ (τ − h)。",
        ),
        "49.7",
    ),
    "joints-missing": Slip(
        Text("the coupling between base and joints is missing", "漏了基座与关节之间的耦合"),
        Text("M_bj is not zero: moving a leg pushes the base.", "M_bj 不为零：动腿会推动基座。"),
        "49.8",
    ),
    "base-missing": Slip(
        Text("the six rows of the base are left out", "漏了基座的六行"),
        Text(
            "A floating base has 6 + n rows, and no motor drives the first six.",
            "浮动基座共有 6 + n 行，前六行没有电机驱动。",
        ),
        "49.9",
    ),
    "selection-transposed": Slip(
        Text("S and Sᵀ are exchanged", "S 与 Sᵀ 弄反"),
        Text(
            "S (n × nv) picks the joints out of v; Sᵀ puts torques back, with six zeros above.",
            "S (n × nv) 从 v 中取出关节；Sᵀ 把力矩放回，上面补六个零。",
        ),
        "49.9",
    ),
    "selection-first": Slip(
        Text(
            "the first n columns in place of the last: torques act on the base",
            "选了前 n 列而不是后 n 列：力矩作用到了基座上",
        ),
        Text(
            "The base comes first in v, so S = (0, 1): six columns of zeros, then the unit matrix.",
            "v 中基座在前，所以 S = (0, 1)：先六列零，再单位矩阵。",
        ),
        "49.9",
    ),
    "torques-left-out": Slip(
        Text("the feet are asked to carry all 18 rows: Sᵀτ is left out", "让脚承担全部 18 行：漏了 Sᵀτ"),
        Text(
            "Static equilibrium is g = Sᵀτ + J_cᵀλ. Only the six base rows are free of τ: solve those for λ.",
            "静力平衡是 g = Sᵀτ + J_cᵀλ。只有基座的六行不含 τ：用这六行解 λ。",
        ),
        "49.11",
    ),
    "base-wrench-sign": Slip(
        Text("the base wrench is the weight, not what holds it", "给出的是重力本身，而不是托住它的力"),
        Text(
            "RNEA returns what must act on the robot: +m g upward at rest.",
            "RNEA 返回的是需要施加的力：静止时为向上的 +m g。",
        ),
        "49.6",
    ),
    "moment-dropped": Slip(
        Text("the moment of the weight is left out", "漏了重力的力矩"),
        Text(
            "The weight acts at the centre of mass: about the origin of the frame its moment is c × m g.",
            "重力作用在质心，对坐标系原点的力矩为 c × m g。",
        ),
        "49.6",
    ),
    "momentum-at-origin": Slip(
        Text("the angular momentum is about the world's origin", "角动量是关于世界原点的"),
        Text("About the centre of mass: subtract c × l.", "关于质心的角动量：要减去 c × l。"),
        "49.10",
    ),
    "momentum-at-base": Slip(
        Text("the angular momentum is about the base", "角动量是关于基座原点的"),
        Text(
            "Centroidal means about the centre of mass: subtract the lever arm times l.",
            "质心动量以质心为参考点：要减去力臂叉乘 l。",
        ),
        "49.10",
    ),
    "rate-bias-missing": Slip(
        Text("Ȧ_G v is left out of the rate of the momentum", "动量变化率漏了 Ȧ_G v"),
        Text("ḣ = A_G a + Ȧ_G v: the map moves with the robot.", "ḣ = A_G a + Ȧ_G v：映射随机器人运动而变。"),
        "49.10",
    ),
    "orbital-missing": Slip(
        Text("only the spins of the links are summed", "只累加了各连杆的自旋角动量"),
        Text("Each link also carries (c_i − c) × m_i v_i.", "每个连杆还贡献 (c_i − c) × m_i v_i。"),
        "49.10",
    ),
}
