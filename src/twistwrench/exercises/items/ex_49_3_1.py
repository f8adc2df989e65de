"""Exercise 49.3.1: X and X* of a pure translation."""

from typing import Any

import numpy as np

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import FORCE_TRANSFORM, MOTION_TRANSFORM
from ..text import Text
from ..wrong import swapped
from .ex_49_0_1 import skew

__all__ = ["EXERCISE", "translation_transforms"]


def translation_transforms(p: Any) -> Any:
    """X, its inverse and X* of the placement (1, p)."""
    one, zero = np.eye(3), np.zeros((3, 3))
    X = np.block([[one, zero], [skew(p), one]])
    X_inverse = np.block([[one, zero], [-skew(p), one]])
    X_star = np.block([[one, skew(p)], [zero, one]])
    return X, X_inverse, X_star


def _with(corner: Any, p: Any) -> Any:
    """Put something else in the place of [p]×."""
    X, X_inverse, X_star = translation_transforms(p)
    X[3:, :3], X_inverse[3:, :3], X_star[:3, 3:] = corner, -corner, corner
    return X, X_inverse, X_star


def _replaced(p: Any, *, k: int, by: Any) -> Any:
    """Make one of the three out of all three."""
    answer = list(translation_transforms(p))
    answer[k] = by(*answer)
    return tuple(answer)


EXERCISE = Exercise(
    id="49.3.1",
    kind="code",
    uses=("skew",),
    title=Text("A pure translation", "纯平移"),
    text=Text(
        "Frame B has the axes of A, and its origin is at p: T_AB = (1, p). Write down X and X*, which take twists and "
        "wrenches from B to A, and the inverse of X. Check by hand that X X⁻¹ = 1.",
        "坐标系 B 与 A 的坐标轴平行，原点位于 p：T_AB = (1, p)。写出把 twist 和 wrench 从 B 变到 A 的 X 与 X*，"
        "以及 X 的逆。手算验证 X X⁻¹ = 1。",
    ),
    parts=(
        Part(
            solution=translation_transforms,
            doc=Text(
                """Return X, X⁻¹ and X* of the placement (1, p).

                p: array (3,), m, the origin of B in A.
                Returns: three arrays (6, 6), in the order (ω, v) and (τ, f).""",
                """返回位姿 (1, p) 的 X、X⁻¹ 和 X*。

                p：数组 (3,)，单位 m，B 的原点在 A 中的位置。
                返回：三个 (6, 6) 数组，顺序为 (ω, v) 与 (τ, f)。""",
            ),
            returns=(
                Quantity("X", MOTION_TRANSFORM),
                Quantity("X⁻¹", MOTION_TRANSFORM),
                Quantity("X*", FORCE_TRANSFORM),
            ),
            cases=lambda rng: [(rng.standard_normal(3),) for _ in range(5)],
            slips={
                "coupling-dropped": lambda p: _with(np.zeros((3, 3)), p),
                "coupling-sign": lambda p: _with(-skew(p), p),
                "skew-sign": lambda p: _with(skew(p).mT, p),
                "skew-symmetric": lambda p: _with(np.abs(skew(p)), p),
                "swapped-halves": swapped(translation_transforms),
                "transpose-for-inverse": lambda p: _replaced(p, k=1, by=lambda X, X_inverse, X_star: X.mT),
                "transpose-for-dual": lambda p: _replaced(p, k=2, by=lambda X, X_inverse, X_star: X.mT),
                "motion-for-force": lambda p: _replaced(p, k=2, by=lambda X, X_inverse, X_star: X),
            },
            alike=(frozenset({"coupling-sign", "skew-sign"}),),
            properties=(
                Property(
                    Text("X X⁻¹ = 1", "X X⁻¹ = 1"),
                    lambda answer, p: answer[0] @ answer[1] - np.eye(6),
                ),
                Property(
                    Text(
                        "X*ᵀ X = 1: the power FᵀV is the same in both frames", "X*ᵀ X = 1：功率 FᵀV 在两个坐标系中相同"
                    ),
                    lambda answer, p: answer[2].mT @ answer[0] - np.eye(6),
                ),
            ),
        ),
    ),
    hints=(
        Text(
            "Think of a body that turns about the origin of B. Which velocity has the point of it that passes the "
            "origin of A?",
            "设想一个绕 B 原点转动的刚体：它经过 A 原点的那一点速度是多少？",
        ),
        Text(
            "ω is the same in both; v_A = v_B + p × ω. For forces: f is the same, τ_A = τ_B + p × f.",
            "ω 相同；v_A = v_B + p × ω。对于力：f 相同，τ_A = τ_B + p × f。",
        ),
    ),
)
