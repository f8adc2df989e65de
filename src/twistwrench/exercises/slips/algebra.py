"""Slips of the algebra: rotations, placements, twists, wrenches (sections 49.2 to 49.4)."""

from ..text import Text
from .slip import Slip

__all__ = ["ALGEBRA"]

ALGEBRA = {
    "coupling-dropped": Slip(
        Text("the coupling term is missing", "漏了耦合项"),
        Text(
            "Only ω and f do not care about the reference point. v gains p × Rω, τ gains p × Rf.",
            "只有 ω 和 f 与参考点无关；v 要加 p × Rω，τ 要加 p × Rf。",
        ),
        "49.3",
    ),
    "coupling-sign": Slip(
        Text("the coupling term has the wrong sign", "耦合项符号错了"),
        Text(
            "p points from the origin of A to that of B, and the term is +[p]×R. The minus belongs to the inverse.",
            "p 从 A 的原点指向 B 的原点，耦合项是 +[p]×R；负号属于逆变换。",
        ),
        "49.3",
    ),
    "coupling-order": Slip(
        Text("R [p]× in place of [p]× R", "写成了 R [p]×，应为 [p]× R"),
        Text(
            "p has coordinates in A, so R must act first: only then are both vectors in the same frame. R [p]× is "
            "[Rp]× R.",
            "p 是 A 中的坐标，所以要先乘 R，两个向量才在同一坐标系中。R [p]× 等于 [Rp]× R。",
        ),
        "49.3",
    ),
    "coupling-unrotated": Slip(
        Text("[p]× in place of [p]× R: the coupling is not rotated", "耦合项写成了 [p]×，漏乘 R"),
        Text(
            "What the lever arm meets must be expressed in A first, by R.", "与力臂相乘的向量必须先用 R 变到 A 中表达。"
        ),
        "49.3",
    ),
    "coupling-corner": Slip(
        Text("the coupling stands in the other corner", "耦合项放到了另一个角上"),
        Text(
            "In X it is bottom left: ω adds to v. In X* it is top right: f adds to τ. A wrong corner is X for X*, or "
            "(v, ω) for (ω, v).",
            "在 X 中位于左下：ω 影响 v；在 X* 中位于右上：f 影响 τ。放错角等于混淆 X 与 X*，或混淆 (v, ω) 与 (ω, v)。",
        ),
        "49.3",
    ),
    "transpose-for-dual": Slip(
        Text("Xᵀ taken for X*", "把 Xᵀ 当成了 X*"),
        Text(
            "X* is the inverse transpose, X⁻ᵀ. Xᵀ takes wrenches the other way, from A back to B.",
            "X* 是逆的转置 X⁻ᵀ。Xᵀ 把 wrench 反方向地从 A 变回 B。",
        ),
        "49.3",
    ),
    "motion-for-force": Slip(
        Text("X taken for X*: a wrench is transformed like a twist", "把 X 当成了 X*：用变换 twist 的方式变换 wrench"),
        Text(
            "Moments depend on the reference point and forces do not; for velocities it is the other way round. The "
            "power FᵀV must be the same in both frames.",
            "力矩依赖参考点，力不依赖；速度恰好相反。功率 FᵀV 在两个坐标系中必须相同。",
        ),
        "49.3",
    ),
    "force-for-motion": Slip(
        Text("X* taken for X: a twist is transformed like a wrench", "把 X* 当成了 X：用变换 wrench 的方式变换 twist"),
        Text(
            "ω is the same everywhere on a body; v is what changes with the point.",
            "刚体上处处 ω 相同；随参考点变化的是 v。",
        ),
        "49.3",
    ),
    "inverse-transform": Slip(
        Text(
            "the inverse in place of the transform: it leads the other way",
            "用了逆变换：方向反了",
        ),
        Text(
            "Read the letters, x_A = T_AB x_B and V_A = X_AB V_B: what is known in B meets the B of the transform.",
            "看下标：x_A = T_AB x_B，V_A = X_AB V_B；已知量的 B 与变换的 B 相邻。",
        ),
        "49.3",
    ),
    "rotation-transposed": Slip(
        Text("Rᵀ in place of R", "把 R 写成了 Rᵀ"),
        Text(
            "R_AB takes coordinates in B to coordinates in A; its columns are B's axes, seen from A.",
            "R_AB 把 B 中坐标变为 A 中坐标；它的各列是 B 的坐标轴在 A 中的表示。",
        ),
        "49.3",
    ),
    "composition-order": Slip(
        Text("the factors are in the wrong order", "乘积的顺序颠倒"),
        Text("Adjacent letters cancel: X_AC = X_AB X_BC.", "相邻下标相消：X_AC = X_AB X_BC。"),
        "49.3",
    ),
    "translation-unrotated": Slip(
        Text("p_BC is added without turning it into A", "直接相加了 p_BC，没有先变到 A 中"),
        Text("p_BC has coordinates in B: p_AC = p_AB + R_AB p_BC.", "p_BC 是 B 中的坐标：p_AC = p_AB + R_AB p_BC。"),
        "49.3",
    ),
    "inverse-unrotated": Slip(
        Text("−p in place of −Rᵀp in the inverse", "逆变换中写成了 −p，应为 −Rᵀp"),
        Text("The inverse is (Rᵀ, −Rᵀp): p must be turned into B as well.", "逆为 (Rᵀ, −Rᵀp)：p 也要变到 B 中表达。"),
        "49.3",
    ),
    "translation-dropped": Slip(
        Text("a point is only rotated: the translation is missing", "点只做了旋转，漏了平移"),
        Text(
            "A point moves with its frame, x_A = R x_B + p. Directions only rotate.",
            "点随坐标系平移：x_A = R x_B + p；只有方向向量才只旋转。",
        ),
        "49.3",
    ),
    "translation-first": Slip(
        Text("the translation comes before the rotation", "先平移后旋转，顺序错了"),
        Text(
            "p has coordinates in A: rotate first, then add it. R (x + p) adds it in B.",
            "p 是 A 中的坐标：先旋转再相加。R (x + p) 相当于在 B 中相加。",
        ),
        "49.3",
    ),
    "skew-sign": Slip(
        Text("the cross matrix is transposed: every sign is wrong", "反对称矩阵被转置：符号全反"),
        Text(
            "[ω]× has −ω₃ in row 0, column 1, so that [ω]× x = ω × x. Its transpose gives x × ω.",
            "[ω]× 第 0 行第 1 列是 −ω₃，这样 [ω]× x = ω × x；其转置给出 x × ω。",
        ),
        "49.2",
    ),
    "skew-symmetric": Slip(
        Text("the cross matrix is symmetric: the minus signs are missing", "反对称矩阵写成了对称矩阵：漏了负号"),
        Text(
            "A cross product changes sign with the order of its factors, so [ω]×ᵀ = −[ω]×.",
            "叉积交换次序变号，所以 [ω]×ᵀ = −[ω]×。",
        ),
        "49.2",
    ),
    "cross-order": Slip(
        Text("the factors of the cross product are exchanged", "叉积的两个因子次序颠倒"),
        Text("a × b = −b × a. A velocity is ω × r, a moment r × f.", "a × b = −b × a。速度是 ω × r，力矩是 r × f。"),
        "49.1",
    ),
    "lever-reversed": Slip(
        Text("the lever arm is taken from the wrong end", "力臂取反了方向"),
        Text(
            "r goes from the reference point to the point where the force acts, or whose velocity is asked.",
            "r 从参考点指向力的作用点（或所求速度的点）。",
        ),
        "49.1",
    ),
    "first-order-exp": Slip(
        Text("1 + [V] in place of the exponential", "只取了一阶近似 1 + [V]"),
        Text(
            "The first two terms of the series are no rotation any more: their columns are longer than 1.",
            "级数只取前两项已不再是旋转：各列长度大于 1。",
        ),
        "49.2",
    ),
    "exp-straight": Slip(
        Text(
            "the translation of the exponential is v t: the turning on the way is left out",
            "指数映射的平移写成了 v t：忽略了途中的转动",
        ),
        Text(
            "v is carried round while the body turns, so the path is an arc. For ω along z: x = v sin(ωt)/ω, y = v (1 "
            "− cos ωt)/ω.",
            "运动中 v 随刚体一起转动，轨迹是圆弧。ω 沿 z 时：x = v sin(ωt)/ω，y = v (1 − cos ωt)/ω。",
        ),
        "49.2",
    ),
    "exp-minus": Slip(
        Text("the 1 − cos term has the wrong sign", "1 − cos 项符号错了"),
        Text(
            "Turning to the left (ω > 0) bends the path to the left, towards +y.", "左转（ω > 0）使轨迹向左弯，朝 +y。"
        ),
        "49.2",
    ),
    "hat-one": Slip(
        Text("the last entry of the se(3) matrix is 1", "se(3) 矩阵右下角写成了 1"),
        Text(
            "That 1 belongs to SE(3). A velocity is a derivative, and the derivative of the constant 1 is 0.",
            "那个 1 属于 SE(3)；速度是导数，常数 1 的导数是 0。",
        ),
        "49.2",
    ),
    "half-missing": Slip(
        Text("a factor ½ is missing", "漏了系数 ½"),
        Text("Kinetic energy is ½ VᵀIV.", "动能是 ½ VᵀIV。"),
        "49.5",
    ),
    "motion-cross-for-force": Slip(
        Text("V× in place of V×*", "把 V× 当成了 V×*"),
        Text(
            "Forces need the dual, V×* = −(V×)ᵀ: the block of v moves from bottom left to top right.",
            "力要用对偶 V×* = −(V×)ᵀ：v 的块从左下移到右上。",
        ),
        "49.5",
    ),
    "cross-transposed": Slip(
        Text("(V×)ᵀ in place of V×* = −(V×)ᵀ", "写成了 (V×)ᵀ，应为 V×* = −(V×)ᵀ"),
        Text(
            "The minus keeps the power: d(FᵀV)/dt must not depend on the moving frame.",
            "负号保证功率不变：d(FᵀV)/dt 不应依赖运动坐标系。",
        ),
        "49.5",
    ),
    "transpose-for-inverse": Slip(
        Text("Xᵀ taken for X⁻¹", "把 Xᵀ 当成了 X⁻¹"),
        Text(
            "Only for a rotation is the transpose the inverse. X⁻¹ is the X of the inverse placement, (Rᵀ, −Rᵀp).",
            "只有旋转矩阵的转置才等于逆。X⁻¹ 是逆位姿 (Rᵀ, −Rᵀp) 的 X。",
        ),
        "49.3",
    ),
    "translation-sign": Slip(
        Text("the translation has the wrong sign", "平移符号错了"),
        Text(
            "p is the origin of B as A sees it, so it is added: x_A = R x_B + p.",
            "p 是 A 中看到的 B 的原点，应当相加：x_A = R x_B + p。",
        ),
        "49.3",
    ),
    "untransformed": Slip(
        Text("the change of frame is left out", "没有做坐标变换"),
        Text(
            "The numbers are still those of the other frame; X takes them over, even between frames of one rigid body.",
            "数值仍是另一坐标系中的；即使两个坐标系属于同一刚体，也要用 X 变换。",
        ),
        "49.2",
    ),
    "elementwise-exp": Slip(
        Text("np.exp takes the exponential of each entry, not of the matrix", "np.exp 是逐元素的指数，不是矩阵指数"),
        Text(
            "The matrix exponential is the series 1 + A + A²/2 + ...; with matrix products.",
            "矩阵指数是级数 1 + A + A²/2 + ……，其中是矩阵乘法。",
        ),
        "49.2",
    ),
    "exp-turned": Slip(
        Text(
            "the translation of the exponential is R v: as if all the turning came first",
            "指数映射的平移写成了 R v：好像先转完再走",
        ),
        Text(
            "Turning and moving happen together: v points along x at the start and along R x only at the end.",
            "转动与平动同时进行：v 开始时沿 x，到最后才沿 R x。",
        ),
        "49.2",
    ),
    "second-order-exp": Slip(
        Text("the series of the exponential is cut off after the second power", "指数级数只取到了二次项"),
        Text(
            "Sum it up: the powers of [ω]× repeat, and give sine and cosine.",
            "[ω]× 的幂次循环出现，求和得到正弦和余弦，应写成精确解。",
        ),
        "49.2",
    ),
    "lever-all": Slip(
        Text("the whole distance in place of the distance from the axis", "用了到原点的距离，而不是到转轴的距离"),
        Text(
            "Only the part of r at right angles to ω counts: |ω × r| = ω r sin(angle).",
            "只有 r 垂直于 ω 的部分起作用：|ω × r| = ω r sin（夹角）。",
        ),
        "49.2",
    ),
    "omega-dropped": Slip(
        Text("a length in place of a velocity: ω is missing", "给出的是长度而不是速度：漏乘 ω"),
        Text("v = ω r, in m/s.", "v = ω r，单位 m/s。"),
        "49.2",
    ),
    "half-rotated": Slip(
        Text("only one half is rotated", "只旋转了一半"),
        Text("Both ω and v change axes: R stands on the diagonal twice.", "ω 和 v 都要换坐标轴：对角线上有两个 R。"),
        "49.3",
    ),
}
