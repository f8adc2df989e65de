"""Exercise 49.3.3: the chain rule of X."""

from typing import Any

from ...rotation import exp3
from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import MOTION_TRANSFORM
from ..text import Text
from ..workbook import mine

__all__ = ["EXERCISE", "chain_two_ways"]


def chain_two_ways(R_AB: Any, p_AB: Any, R_BC: Any, p_BC: Any) -> Any:
    """X_AC from the placement of C in A, and as a product."""
    X = mine("plucker")
    R_AC, p_AC = R_AB @ R_BC, p_AB + R_AB @ p_BC
    by_placement, _ = X(R_AC, p_AC)
    by_product = X(R_AB, p_AB)[0] @ X(R_BC, p_BC)[0]
    return by_placement, by_product


def _cases(rng: Any) -> Any:
    def placement() -> tuple[Any, Any]:
        return exp3(rng.standard_normal(3)), rng.standard_normal(3)

    return [(*placement(), *placement()) for _ in range(5)]


def _by_placement(R: Any, p: Any, product: Any) -> Any:
    return mine("plucker")(R, p)[0], product


def _product_reversed(R_AB: Any, p_AB: Any, R_BC: Any, p_BC: Any) -> Any:
    X = mine("plucker")
    return chain_two_ways(R_AB, p_AB, R_BC, p_BC)[0], X(R_BC, p_BC)[0] @ X(R_AB, p_AB)[0]


EXERCISE = Exercise(
    id="49.3.3",
    kind="prove",
    title=Text("The chain rule", "链式法则"),
    text=Text(
        """Prove that X_AC = X_AB X_BC. First see it happen: compute X_AC from the placement
        T_AC = T_AB T_BC, and again as a product of two X. Then write the proof,
        in words and formulas, into the string.""",
        """证明 X_AC = X_AB X_BC。先做数值实验：由位姿 T_AC = T_AB T_BC 计算 X_AC，再由两个 X 的乘积计算一次。
        然后把证明（文字加公式）写进字符串。""",
    ),
    parts=(
        Part(
            solution=chain_two_ways,
            doc=Text(
                """Return X_AC in two ways: from the placement T_AB T_BC, and as X_AB X_BC.

                R_AB, R_BC: arrays (3, 3). p_AB, p_BC: arrays (3,), m.
                Returns: two arrays (6, 6). The first must not be computed from the second.""",
                """用两种方法返回 X_AC：由位姿 T_AB T_BC 计算；由 X_AB X_BC 相乘。

                R_AB、R_BC：数组 (3, 3)。p_AB、p_BC：数组 (3,)，单位 m。
                返回：两个 (6, 6) 数组。第一个不能由第二个得到。""",
            ),
            given='X = mine("plucker")  # X(R, p) gives X and X*',
            returns=(
                Quantity("X of T_AB T_BC", MOTION_TRANSFORM),
                Quantity("X_AB X_BC", MOTION_TRANSFORM),
            ),
            cases=_cases,
            slips={
                "composition-order": _product_reversed,
                "translation-unrotated": lambda R_AB, p_AB, R_BC, p_BC: _by_placement(
                    R_AB @ R_BC, p_AB + p_BC, chain_two_ways(R_AB, p_AB, R_BC, p_BC)[1]
                ),
                "rotation-transposed": lambda R_AB, p_AB, R_BC, p_BC: _by_placement(
                    R_AB @ R_BC, p_AB + R_AB.mT @ p_BC, chain_two_ways(R_AB, p_AB, R_BC, p_BC)[1]
                ),
            },
            properties=(
                Property(
                    Text("both ways give the same matrix", "两种方法结果相同"),
                    lambda answer, R_AB, p_AB, R_BC, p_BC: answer[0] - answer[1],
                ),
            ),
        ),
    ),
    hints=(
        Text(
            "A point of C goes to A through B: x_A = R_AB (R_BC x + p_BC) + p_AB. Read T_AC off.",
            "C 中的点经 B 变到 A：x_A = R_AB (R_BC x + p_BC) + p_AB。由此读出 T_AC。",
        ),
        Text(
            "X is defined by what it does: [X_AB V]∧ = T_AB [V]∧ T_AB⁻¹. Apply that twice to any V of frame C.",
            "X 由作用定义：[X_AB V]∧ = T_AB [V]∧ T_AB⁻¹。对 C 中任意 V 连用两次。",
        ),
    ),
    answer=Text(
        """X_AB is defined by [X_AB V]∧ = T_AB [V]∧ T_AB⁻¹ for every twist V. Take any V in C. Then
        [X_AB X_BC V]∧ = T_AB [X_BC V]∧ T_AB⁻¹ = T_AB T_BC [V]∧ T_BC⁻¹ T_AB⁻¹ = T_AC [V]∧ T_AC⁻¹ = [X_AC V]∧,
        because (T_AB T_BC)⁻¹ = T_BC⁻¹ T_AB⁻¹. The hat map is one-to-one, and V is any, so the matrices are equal.
        By blocks: bottom left stands [p_AB]× R_AB R_BC + R_AB [p_BC]× R_BC, and R_AB [p_BC]× = [R_AB p_BC]× R_AB
        makes it [p_AB + R_AB p_BC]× R_AC, which is the coupling of T_AC.""",
        """X_AB 由 [X_AB V]∧ = T_AB [V]∧ T_AB⁻¹ 对任意 V 定义。取 C 中任意 V，则
        [X_AB X_BC V]∧ = T_AB [X_BC V]∧ T_AB⁻¹ = T_AB T_BC [V]∧ T_BC⁻¹ T_AB⁻¹ = T_AC [V]∧ T_AC⁻¹ = [X_AC V]∧，
        因为 (T_AB T_BC)⁻¹ = T_BC⁻¹ T_AB⁻¹。∧ 映射是一一的，而 V 任意，所以两矩阵相等。
        也可按块验证：左下块为 [p_AB]× R_AB R_BC + R_AB [p_BC]× R_BC，由 R_AB [p_BC]× = [R_AB p_BC]× R_AB 得
        [p_AB + R_AB p_BC]× R_AC，正是 T_AC 的耦合项。""",
    ),
)
