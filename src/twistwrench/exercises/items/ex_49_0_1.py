"""Exercise 49.0.1: the matrix of the cross product."""

from typing import Any

import numpy as np

from ..exercise import Exercise, Part, Property, Quantity
from ..text import Text
from ..wrong import after, transposed

__all__ = ["EXERCISE", "skew"]


def skew(w: Any) -> Any:
    """[w]×."""
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


EXERCISE = Exercise(
    id="49.0.1",
    kind="code",
    title=Text("The cross product as a matrix", "叉积写成矩阵"),
    text=Text(
        "Write down the skew-symmetric matrix [ω]× of a vector ω. How is it related to the cross product ω × v?",
        "写出向量 ω 的反对称矩阵 [ω]×。它与叉积 ω × v 是什么关系？",
    ),
    parts=(
        Part(
            solution=skew,
            doc=Text(
                "Return [w]×, the matrix with skew(w) @ x = w × x.\n\nw: array (3,), any unit.\nReturns: array (3, 3).",
                "返回 [w]×，满足 skew(w) @ x = w × x。\n\nw：数组 (3,)，任意单位。\n返回：数组 (3, 3)。",
            ),
            returns=(Quantity("[w]×"),),
            cases=lambda rng: [(rng.standard_normal(3),) for _ in range(5)],
            slips={"skew-sign": transposed(skew), "skew-symmetric": after(skew, np.abs)},
            properties=(
                Property(
                    Text("[w]× w = 0: a vector has no cross product with itself", "[w]× w = 0：向量与自身的叉积为零"),
                    lambda W, w: W @ w,
                ),
            ),
        ),
    ),
    hints=(
        Text(
            "Write ω × v out in components; the first is ω₂v₃ − ω₃v₂. Which numbers multiply v₁, v₂, v₃?",
            "把 ω × v 按分量展开，第一个分量是 ω₂v₃ − ω₃v₂。v₁、v₂、v₃ 的系数各是什么？",
        ),
        Text(
            "The first row is (0, −ω₃, ω₂). The diagonal is zero, and below it stand the negatives of what is above.",
            "第一行是 (0, −ω₃, ω₂)；对角线为零，下三角是上三角的相反数。",
        ),
    ),
)
