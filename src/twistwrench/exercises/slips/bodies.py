"""Slips in the inertia of a body, and in reading it from a model (section 49.5)."""

from ..text import Text
from .slip import Slip

__all__ = ["BODIES"]

BODIES = {
    "parallel-axis-all": Slip(
        Text(
            "m |c|² on all three axes, in place of m (|c|² 1 − c cᵀ)", "三个轴上都用了 m |c|²，应为 m (|c|² 1 − c cᵀ)"
        ),
        Text(
            "The mass does not move when the body turns about the line through both points: m (|c|² 1 − c cᵀ).",
            "绕两点连线转动时质心不动，该方向不增加：应为 m (|c|² 1 − c cᵀ)。",
        ),
        "49.5",
    ),
    "parallel-axis-outer": Slip(
        Text("m c cᵀ in place of m (|c|² 1 − c cᵀ)", "写成了 m c cᵀ，应为 m (|c|² 1 − c cᵀ)"),
        Text(
            "c cᵀ is the part along c; what counts is the distance from the axis, so it is taken off |c|² 1.",
            "c cᵀ 是沿 c 的部分；起作用的是到转轴的距离，所以要从 |c|² 1 中减去它。",
        ),
        "49.5",
    ),
    "inertia-asymmetric": Slip(
        Text("the blocks off the diagonal are equal: the matrix is not symmetric", "两个非对角块相同：矩阵不对称"),
        Text(
            "[c]× is antisymmetric, so its mirror image has the other sign: m [c]× top right, −m [c]× bottom left.",
            "[c]× 反对称，其转置变号：右上是 m [c]×，左下是 −m [c]×。",
        ),
        "49.5",
    ),
    "determinant-for-eigenvalue": Slip(
        Text("the determinant in place of the smallest eigenvalue", "给出的是行列式，而不是最小特征值"),
        Text(
            "A determinant is positive also where two eigenvalues are negative.",
            "有两个负特征值时行列式同样为正，不能说明正定。",
        ),
        "49.5",
    ),
    "largest-eigenvalue": Slip(
        Text("the largest eigenvalue in place of the smallest", "给出的是最大特征值，而不是最小的"),
        Text("Positive definite means that the smallest one is positive, too.", "正定要求最小的特征值也为正。"),
        "49.5",
    ),
    "products-sign": Slip(
        Text("the products of inertia have the wrong sign", "惯性积（非对角元素）符号错了"),
        Text(
            "The entry xy of an inertia is −∫xy dm, and a URDF has it with that sign.",
            "惯量矩阵的 xy 元素是 −∫xy dm；URDF 中的 ixy 已带这个负号。",
        ),
        "49.5",
    ),
    "products-dropped": Slip(
        Text("only the diagonal of I_c is used", "只用了 I_c 的对角线"),
        Text(
            "The axes of a body's frame are hardly ever its principal axes: six numbers, not three.",
            "本体坐标轴通常不是主轴：I_c 有六个数，不是三个。",
        ),
        "49.5",
    ),
    "rows-only": Slip(
        Text("only the rows are exchanged, the columns are not", "只交换了行，没有交换列"),
        Text(
            "What goes in is reordered as well as what comes out: rows and columns.",
            "输入和输出的顺序都变了：行和列都要交换。",
        ),
        "49.5",
    ),
    "columns-only": Slip(
        Text("only the columns are exchanged, the rows are not", "只交换了列，没有交换行"),
        Text(
            "What comes out is reordered as well as what goes in: rows and columns.",
            "输出和输入的顺序都变了：行和列都要交换。",
        ),
        "49.5",
    ),
    "reversed": Slip(
        Text("all six are reversed: (z, y, x) as well", "六个分量整体倒序：连 x、y、z 也反了"),
        Text(
            "Exchange the halves and keep x, y, z in each: `[3, 4, 5, 0, 1, 2]`, not `[::-1]`.",
            "只交换两半，每半内 x、y、z 的次序不变：用 `[3, 4, 5, 0, 1, 2]`，而不是 `[::-1]`。",
        ),
        "49.5",
    ),
    "whole-for-base": Slip(
        Text("the whole robot in place of the base", "用了整机，而不是基座"),
        Text(
            "Body 1 is the base with what is welded to it; the legs are bodies of their own.",
            "第 1 个物体是基座及焊接在其上的部分；腿是另外的物体。",
        ),
        "49.5",
    ),
    "steiner-from-any-point": Slip(
        Text(
            "m (|p|² 1 − p pᵀ) is added though the old origin is not the centre of mass",
            "旧原点不是质心，却直接加了 m (|p|² 1 − p pᵀ)",
        ),
        Text(
            "The parallel-axis theorem starts at the centre of mass. From another point go by way of it, or use "
            "X* I X⁻¹.",
            "平行轴定理必须从质心出发。从别的点出发要先回到质心，或用 X* I X⁻¹。",
        ),
        "49.5",
    ),
}
