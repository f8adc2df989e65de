"""Slips of contact forces and of the centre of pressure (section 49.4)."""

from ..text import Text
from .slip import Slip

__all__ = ["CONTACT"]

CONTACT = {
    "g-ten": Slip(
        Text("g = 10 in place of 9.81 m/s²", "g 取了 10，应为 9.81 m/s²"),
        Text(
            "That is 2 % too much. The models use 9.81 m/s².",
            "偏大 2 %。模型中取 9.81 m/s²。",
        ),
        "49.4",
    ),
    "shared-by-two": Slip(
        Text("the weight is shared by two feet", "把重力分给了两只脚"),
        Text(
            "All four stand on the ground; two of them carry it in a trot.", "四只脚都着地；小跑步态中才是两只脚承重。"
        ),
        "49.4",
    ),
    "wrench-about-world": Slip(
        Text(
            "the wrench is expressed in the world frame, not in the body's own",
            "wrench 在世界坐标系中表达，而不是在本体坐标系中",
        ),
        Text(
            "In a body's frame the axes are the body's, and the moment is about its origin. (A point contact has none "
            "about itself.)",
            "在本体坐标系中要用它的坐标轴，并对它的原点取矩（点接触对接触点没有力矩）。",
        ),
        "49.4",
    ),
    "rotation-forward": Slip(
        Text("R in place of Rᵀ", "用了 R，应为 Rᵀ"),
        Text(
            "R takes coordinates in the body's frame to the world. What is known in the world comes into the body's "
            "frame by Rᵀ.",
            "R 把本体坐标变到世界；要把世界中的向量变到本体坐标系，应乘 Rᵀ。",
        ),
        "49.3",
    ),
    "cop-inverted": Slip(
        Text("f_z/τ in place of τ/f_z", "写成了 f_z/τ，应为 τ/f_z"),
        Text(
            "A lever arm is a moment over a force: N m / N = m.",
            "力臂等于力矩除以力：N m / N = m。",
        ),
        "49.4",
    ),
    "cop-not-divided": Slip(
        Text("the moments themselves in place of a point: f_z is missing", "给出的是力矩而不是点的位置：漏除 f_z"),
        Text("A point is in m. Divide N m by the N of f_z.", "点的位置单位是 m：用 N m 除以 f_z 的 N。"),
        "49.4",
    ),
    "cop-whole-force": Slip(
        Text("the moment is divided by |f| in place of f_z", "力矩除以了 |f|，应除以 f_z"),
        Text(
            "In the plane of the sole f_x and f_y point along the sole, and have no lever arm about its x and y axes.",
            "f_x、f_y 就在脚底平面内，对 x、y 轴没有力臂，只有 f_z 产生 τ_x 和 τ_y。",
        ),
        "49.4",
    ),
    "full-for-half": Slip(
        Text("half lengths taken for whole ones", "把半长半宽当成了全长全宽"),
        Text(
            "d_x and d_y reach from the centre of the sole to its edge: compare with d, not with d/2.",
            "d_x、d_y 是从脚底中心到边缘的距离：应与 d 比较，而不是 d/2。",
        ),
        "49.4",
    ),
    "one-sided": Slip(
        Text("only the upper limit is checked", "只检查了上限"),
        Text("The sole ends on both sides: −d ≤ p ≤ d, or |p| ≤ d.", "脚底两侧都有边缘：−d ≤ p ≤ d，即 |p| ≤ d。"),
        "49.4",
    ),
    "either-for-both": Slip(
        Text("`or` in place of `and`", "用了 `or`，应为 `and`"),
        Text("The point lies within the sole if both coordinates do.", "两个坐标都在范围内，点才在脚底之内。"),
        "49.4",
    ),
    "pulling-allowed": Slip(
        Text("the ground is allowed to pull: f_z < 0 is not refused", "允许了地面拉住脚：没有排除 f_z < 0"),
        Text(
            "τ/f_z can be small with f_z < 0 as well. A sole that is pulled down has no centre of pressure: f_z > 0.",
            "f_z < 0 时 τ/f_z 也可能很小。地面只能推，不能拉：先要求 f_z > 0。",
        ),
        "49.4",
    ),
    "edge-excluded": Slip(
        Text("the edge is refused: < in place of ≤", "排除了边缘：写成了 <，应为 ≤"),
        Text(
            "With the pressure on the edge the ground still pushes: only beyond it must it pull. The edge is allowed.",
            "压力中心恰在边缘时地面仍在推；超出边缘才需要拉。边缘算可以。",
        ),
        "49.4",
    ),
    "averaged": Slip(
        Text("the mean of the forces in place of their sum", "取了力的平均值，而不是合力"),
        Text("Wrenches in one frame add up.", "同一坐标系中的 wrench 直接相加。"),
        "49.4",
    ),
    "single-force": Slip(
        Text("all forces act at one point: their sum at the mean of the points", "把合力放到了各点的平均位置"),
        Text(
            "A corner that carries more counts more. Sum the moments pᵢ × fᵢ one by one.",
            "承力大的角点权重大。应逐个累加力矩 pᵢ × fᵢ。",
        ),
        "49.4",
    ),
}
