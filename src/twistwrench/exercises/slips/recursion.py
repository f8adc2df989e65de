"""Slips of weight and bias in inverse and forward dynamics (sections 49.6 and 49.7)."""

from ..text import Text
from .slip import Slip

__all__ = ["RECURSION"]

RECURSION = {
    "gravity-twice": Slip(
        Text("gravity is counted twice", "重力被算了两次"),
        Text(
            "rnea has gravity in it already, by a₀ = −g; h = C v + g as well.",
            "rnea 已通过 a₀ = −g 计入重力，h = C v + g 中也已包含。",
        ),
        "49.6",
    ),
    "velocity-terms-missing": Slip(
        Text("h is taken at v = 0: only gravity is left of it", "h 在 v = 0 处计算：只剩下重力项"),
        Text(
            "h = C(q, v) v + g(q): keep v, and set only the acceleration to zero.",
            "h = C(q, v) v + g(q)：保留 v，只把加速度置零。",
        ),
        "49.6",
    ),
    "acceleration-twice": Slip(
        Text("h is taken with the acceleration: M a is counted twice", "h 中带入了加速度：M a 被算了两次"),
        Text("h is what is left of rnea at a = 0.", "h 是 rnea 在 a = 0 时的值。"),
        "49.6",
    ),
    "velocity-for-acceleration": Slip(
        Text("M v in place of M a", "写成了 M v，应为 M a"),
        Text("M v is a momentum; forces go with M a.", "M v 是动量；力对应 M a。"),
        "49.6",
    ),
    "gravity-left-in": Slip(
        Text(
            "gravity is left in the columns: rnea(q, 0, e) is a column of M plus g",
            "各列中留有重力：rnea(q, 0, e) 等于 M 的一列加 g",
        ),
        Text(
            "Subtract what rnea gives without acceleration: M e = rnea(q, 0, e) − rnea(q, 0, 0).",
            "减去零加速度时的值：M e = rnea(q, 0, e) − rnea(q, 0, 0)。",
        ),
        "49.6",
    ),
    "orders-mixed": Slip(
        Text("M is in the order (v, ω), the vectors are in (ω, v)", "M 的顺序是 (v, ω)，而各向量的顺序是 (ω, v)"),
        Text(
            "Pinocchio's M has the base's linear part first. Reorder its rows and columns, or use Pinocchio for all.",
            "Pinocchio 的 M 中基座线分量在前。要重排其行和列，或全部都用 Pinocchio 计算。",
        ),
        "49.6",
    ),
    "as-printed": Slip(
        Text(
            "the wrench as the chapter prints it: the sign is wrong, and the moment is missing",
            "照抄了本章的结果：符号错了，而且漏了力矩",
        ),
        Text(
            "RNEA returns what holds the robot: +m g upward, and a moment where the centre of mass is not above or "
            "below the base's origin.",
            "RNEA 返回托住机器人的力：向上的 +m g；质心不在基座原点正上方或正下方时还有力矩。",
        ),
        "49.6",
    ),
    "base-weightless": Slip(
        Text("the base's own weight is left out: only the legs are there", "漏了基座自身的重力：只算了腿"),
        Text(
            "The base is a body, too: 7.277 kg of Go2's 16.085 kg. The chapter's loops start behind it.",
            "基座也是一个刚体：Go2 的 16.085 kg 中占 7.277 kg。本章伪代码的循环漏掉了它。",
        ),
        "49.6",
    ),
    "lever-from-world": Slip(
        Text(
            "the lever arm begins at the world's origin, not at the base's", "力臂从世界原点量起，而不是从基座原点量起"
        ),
        Text(
            "The moment is about the origin of the base: c − p_base is the lever arm.",
            "力矩的参考点是基座原点：力臂是 c − p_基座。",
        ),
        "49.6",
    ),
    "lever-unrotated": Slip(
        Text("the lever arm is left in the axes of the world", "力臂仍是世界坐标轴中的分量"),
        Text(
            "Both factors of p × f must have the same axes: turn the lever arm by Rᵀ as well.",
            "p × f 的两个因子要用同一组坐标轴：力臂也要乘 Rᵀ。",
        ),
        "49.6",
    ),
    "weight-upward": Slip(
        Text("the weight points upward", "重力方向朝上"),
        Text(
            "The weight is m g with g = (0, 0, −9.81). The minus of a₀ = −g belongs to the acceleration only.",
            "重力是 m g，g = (0, 0, −9.81)。a₀ = −g 的负号只属于加速度。",
        ),
        "49.6",
    ),
    "gravity-compensated": Slip(
        Text("the torques hold the robot: τ = g(q) in place of τ = 0", "力矩托住了机器人：用了 τ = g(q)，而不是 τ = 0"),
        Text("With τ = 0 nothing holds it, and it falls.", "τ = 0 时没有任何力托住它，它会下落。"),
        "49.7",
    ),
    "base-held": Slip(
        Text("the base is held: only the joints' block of M is solved", "基座被固定：只解了 M 的关节块"),
        Text(
            "A free base gives way: its equations and those of the joints are coupled. The chapter's ABA is for a "
            "fixed base.",
            "自由的基座会运动，它的方程与关节的方程是耦合的。本章的 ABA 伪代码只适用于固定基座。",
        ),
        "49.7",
    ),
    "base-for-com": Slip(
        Text("the base in place of the centre of mass", "用了基座，而不是质心"),
        Text(
            "The base is pulled by the legs that swing; the centre of mass is not, since those forces are internal.",
            "摆动的腿会拉动基座；质心不受影响，因为这些是内力。",
        ),
        "49.7",
    ),
    "as-at-rest": Slip(
        Text("the answer for a robot at rest: v is left out", "给出的是静止时的答案：漏了 v"),
        Text(
            "Legs that swing pull at the base. Keep v in aba, and add ω × v for the acceleration of a point.",
            "摆动的腿会拉动基座。aba 中要保留 v，求点的加速度还要加 ω × v。",
        ),
        "49.7",
    ),
    "mass-not-divided": Slip(
        Text("the rate of the momentum in place of an acceleration", "给出的是动量变化率，而不是加速度"),
        Text("l = m v_G, so the centre of mass accelerates by l̇/m.", "l = m v_G，所以质心加速度是 l̇/m。"),
        "49.7",
    ),
    "inverse-missing": Slip(
        Text("M (τ − h) in place of M⁻¹ (τ − h)", "写成了 M (τ − h)，应为 M⁻¹ (τ − h)"),
        Text("M a = τ − h: a is what solves it.", "M a = τ − h：a 是这个方程组的解。"),
        "49.7",
    ),
}
