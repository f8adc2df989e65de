"""Slips of weight, mass and inertia (sections 49.4, 49.5 and 49.8)."""

from ..text import Text
from .slip import Slip

__all__ = ["INERTIA"]

INERTIA = {
    "parallel-axis-sign": Slip(
        Text("the parallel-axis term has the wrong sign", "平行轴项符号错了"),
        Text(
            "An inertia is least about the centre of mass. [c]×² is negative, so the term is −m [c]×².",
            "绕质心的转动惯量最小。[c]×² 是负半定的，所以这一项是 −m [c]×²。",
        ),
        "49.5",
    ),
    "parallel-axis-dropped": Slip(
        Text("the parallel-axis term is missing: inertia about the wrong point", "漏了平行轴项：惯量的参考点错了"),
        Text(
            "About the origin the body also carries its mass round: I_O = I_c − m [c]×².",
            "绕原点时质量也随之转动：I_O = I_c − m [c]×²。",
        ),
        "49.5",
    ),
    "inertia-at-origin": Slip(
        Text("I_c is taken as an inertia about the origin", "把 I_c 当成了关于原点的惯量"),
        Text(
            "I_c is about the centre of mass; the parallel-axis term must still be added.",
            "I_c 是关于质心的，还要加上平行轴项。",
        ),
        "49.5",
    ),
    "com-sign": Slip(
        Text("the centre of mass is on the wrong side: m [c]× has the wrong sign", "质心方向反了：m [c]× 符号错了"),
        Text(
            "l = m (v + ω × c) = m v − m [c]× ω: the minus stands bottom left.",
            "l = m (v + ω × c) = m v − m [c]× ω：负号在左下。",
        ),
        "49.5",
    ),
    "com-dropped": Slip(
        Text("the offset of the centre of mass is left out", "忽略了质心偏移"),
        Text("Unless c = 0, turning and moving are coupled by m [c]×.", "除非 c = 0，转动与平动由 m [c]× 耦合。"),
        "49.5",
    ),
    "mass-dropped": Slip(
        Text("the mass is missing", "漏乘了质量"),
        Text(
            "Check the units: inertia kg m², first moment kg m, then kg.",
            "检查单位：惯量 kg m²，一阶矩 kg m，再到 kg。",
        ),
        "49.5",
    ),
    "inertia-half-rotated": Slip(
        Text("the inertia is transformed from one side only", "惯量只从一侧做了变换"),
        Text(
            "Both what goes in and what comes out change frame: I_A = X* I_B X⁻¹, in three dimensions R I Rᵀ.",
            "输入和输出都要换坐标系：I_A = X* I_B X⁻¹，三维时为 R I Rᵀ。",
        ),
        "49.5",
    ),
    "inertia-like-motion": Slip(
        Text("X I X⁻¹ in place of X* I X⁻¹", "写成了 X I X⁻¹，应为 X* I X⁻¹"),
        Text(
            "An inertia takes a twist to a momentum, which transforms like a wrench.",
            "惯量把 twist 变为动量，动量按 wrench 的方式变换。",
        ),
        "49.5",
    ),
    "one-link": Slip(
        Text("the mass of one link in place of the whole robot's", "用了单个连杆的质量，而不是整机质量"),
        Text("Add up all bodies.", "要对所有刚体求和。"),
        "49.10",
    ),
    "nominal-mass": Slip(
        Text("the mass of the text in place of the model's (or the other way round)", "混用了题目给的质量与模型的质量"),
        Text(
            "Exercise 49.4.1 says 12 kg. The model of Go2 has 16.085 kg.",
            "练习 49.4.1 给的是 12 kg；Go2 模型的质量是 16.085 kg。",
        ),
        "49.4",
    ),
    "not-shared": Slip(
        Text("the whole weight in place of one foot's share", "给出了总重量，而不是一只脚的份额"),
        Text("Four feet share it.", "由四只脚分担。"),
        "49.4",
    ),
    "mass-for-weight": Slip(
        Text("a mass in place of a force: g is missing", "给出的是质量而不是力：漏乘 g"),
        Text("Weight is m g, in N.", "重力是 m g，单位 N。"),
        "49.4",
    ),
    "g-rounded": Slip(
        Text("g = 9.8 in place of 9.81 m/s²", "g 取了 9.8，应为 9.81 m/s²"),
        Text("The models use 9.81 m/s².", "模型中取 9.81 m/s²。"),
        "49.4",
    ),
    "cop-sign": Slip(
        Text("the centre of pressure is mirrored", "压力中心（COP）方向反了"),
        Text("τ = p × f gives τ_x = p_y f_z but τ_y = −p_x f_z.", "由 τ = p × f 得 τ_x = p_y f_z，而 τ_y = −p_x f_z。"),
        "49.4",
    ),
    "cop-axes": Slip(
        Text("the axes of the centre of pressure are exchanged", "压力中心的 x、y 轴弄混了"),
        Text(
            "A moment about x moves the pressure along y, and the other way round.",
            "绕 x 的力矩使压力中心沿 y 移动，反之亦然。",
        ),
        "49.4",
    ),
}
