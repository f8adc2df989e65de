"""Exercise 49.0.3: the adjoint, from its definition."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import MOTION_TRANSFORM
from ..text import Text
from ..wrong import swapped, transposed

__all__ = ["EXERCISE", "adjoint"]


def adjoint(T: Any) -> Any:
    """Ad_T, column by column."""
    T_inverse = np.linalg.inv(T)
    columns = []
    for V in np.eye(6):
        moved = T @ tw.hat(V) @ T_inverse
        columns.append([moved[2, 1], moved[0, 2], moved[1, 0], *moved[:3, 3]])
    return np.array(columns).mT


def _with(T: Any, *, coupling: float) -> Any:
    """Multiply the coupling block by a factor."""
    X = adjoint(T)
    X[3:, :3] *= coupling
    return X


def _cases(rng: Any) -> Any:
    return [(tw.SE3(tw.exp3(rng.standard_normal(3)), rng.standard_normal(3)).matrix(),) for _ in range(5)]


EXERCISE = Exercise(
    id="49.0.3",
    kind="explain",
    title=Text("The adjoint", "伴随表示"),
    text=Text(
        """What is the adjoint Ad_T of a placement T? How large is the matrix, and what does it take to what?
        Compute it from its definition, column by column: column k is T [e_k]∧ T⁻¹, read as six numbers again.""",
        """SE(3) 的伴随表示 Ad_T 是什么？它是多大的矩阵？把什么映射到什么？
        按定义逐列计算：第 k 列是 T [e_k]∧ T⁻¹ 再写回六个数。""",
    ),
    parts=(
        Part(
            solution=adjoint,
            doc=Text(
                """Return Ad_T, computed from [Ad_T V]∧ = T [V]∧ T⁻¹.

                T: array (4, 4), [[R, p], [0, 1]], p in m. `tw.hat(V)` is [V]∧, (4, 4).
                Returns: array (6, 6), in the order (ω, v).""",
                """返回 Ad_T，由 [Ad_T V]∧ = T [V]∧ T⁻¹ 计算。

                T：数组 (4, 4)，[[R, p], [0, 1]]，p 的单位为 m。`tw.hat(V)` 是 [V]∧，(4, 4)。
                返回：数组 (6, 6)，顺序为 (ω, v)。""",
            ),
            returns=(Quantity("Ad_T", MOTION_TRANSFORM),),
            cases=_cases,
            slips={
                "inverse-transform": lambda T: adjoint(np.linalg.inv(T)),
                "swapped-halves": swapped(adjoint),
                "transposed-answer": transposed(adjoint),
                "coupling-dropped": lambda T: _with(T, coupling=0),
                "coupling-sign": lambda T: _with(T, coupling=-1),
                "force-for-motion": lambda T: np.linalg.inv(adjoint(T)).mT,
            },
            alike=(frozenset({"swapped-halves", "force-for-motion"}),),
            properties=(
                Property(
                    Text(
                        "T takes its own screw axis to itself: Ad_T log T = log T",
                        "T 不改变自己的螺旋轴：Ad_T log T = log T",
                    ),
                    lambda answer, T: answer @ tw.log6(T) - tw.log6(T),
                ),
            ),
        ),
    ),
    hints=(
        Text(
            "Ad_T is linear, so six inputs tell everything: the six unit twists. Each gives one column.",
            "Ad_T 是线性的，所以六个单位 twist 就能确定它，每个给出一列。",
        ),
        Text(
            "In [V]∧ the entries (2, 1), (0, 2), (1, 0) are ω and the last column is v. `tw.vee` reads them.",
            "[V]∧ 中 (2, 1)、(0, 2)、(1, 0) 处是 ω，最后一列是 v。`tw.vee` 可以读出。",
        ),
    ),
    answer=Text(
        """Ad_T is a 6 × 6 matrix. It takes a twist expressed in B to the same motion expressed in A = T B: six numbers
        to six numbers, linearly. It is how the group acts on its own velocities, and Ad_(T₁T₂) = Ad_T₁ Ad_T₂. In the
        order (ω, v) it is [[R, 0], [[p]×R, R]], the X of section 49.3.""",
        """Ad_T 是 6 × 6 矩阵，把在 B 中表达的 twist 线性地变为同一运动在 A 中的表达（T = T_AB）：六个数到六个数。
        它是群对自身李代数的作用，满足 Ad_(T₁T₂) = Ad_T₁ Ad_T₂。按 (ω, v) 的顺序就是 [[R, 0], [[p]×R, R]]，即 49.3 节的
        X。""",
    ),
)
