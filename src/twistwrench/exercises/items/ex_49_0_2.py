"""Exercise 49.0.2: how a placement acts on a point."""

from typing import Any

from ...rotation import exp3
from ..exercise import Exercise, Part, Property, Quantity
from ..text import Text
from ..wrong import as_column

__all__ = ["EXERCISE", "act"]


def act(R: Any, p: Any, x: Any) -> Any:
    """Coordinates in A of a point of B."""
    return R @ x + p


EXERCISE = Exercise(
    id="49.0.2",
    kind="code",
    title=Text("A placement acts on a point", "位姿作用于点"),
    text=Text(
        "How does an element T = (R, p) of SE(3) act on a point x? Write the formula as a function.",
        "SE(3) 的元素 T = (R, p) 如何作用于点 x？把变换公式写成函数。",
    ),
    parts=(
        Part(
            solution=act,
            doc=Text(
                """Return the coordinates in A of a point that is x in B.

                R: array (3, 3), takes coordinates in B to A. p: array (3,), m, the origin of B in A.
                x: array (3,), m, the point in B.
                Returns: array (3,), m, the point in A.""",
                """返回点的 A 坐标，该点在 B 中的坐标为 x。

                R：数组 (3, 3)，把 B 中坐标变到 A。p：数组 (3,)，单位 m，B 的原点在 A 中的位置。
                x：数组 (3,)，单位 m，点在 B 中的坐标。
                返回：数组 (3,)，单位 m，点在 A 中的坐标。""",
            ),
            returns=(Quantity("x_A", unit="m"),),
            cases=lambda rng: [
                (exp3(rng.standard_normal(3)), rng.standard_normal(3), rng.standard_normal(3)) for _ in range(5)
            ],
            slips={
                "translation-dropped": lambda R, p, x: R @ x,
                "translation-first": lambda R, p, x: R @ (x + p),
                "translation-sign": lambda R, p, x: R @ x - p,
                "rotation-transposed": lambda R, p, x: R.mT @ x + p,
                "inverse-transform": lambda R, p, x: R.mT @ (x - p),
                "inverse-unrotated": lambda R, p, x: R.mT @ x - p,
                "column-vector": as_column(act),
            },
            properties=(
                Property(
                    Text("R keeps lengths: |x_A − p| = |x|", "R 保持长度：|x_A − p| = |x|"),
                    lambda answer, R, p, x: ((answer - p) ** 2).sum() - (x**2).sum(),
                ),
            ),
        ),
    ),
    hints=(
        Text(
            "Where does the origin of B, x = 0, end up? And what happens to the axes of B?",
            "B 的原点 x = 0 变到哪里？B 的坐标轴又变成什么？",
        ),
        Text("Rotate, then add: x_A = R x + p.", "先旋转再相加：x_A = R x + p。"),
    ),
)
