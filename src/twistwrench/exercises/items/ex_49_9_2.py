"""Exercise 49.9.2: the selection matrix."""

from typing import Any

import numpy as np

from ..exercise import Exercise, Part, Property, Quantity
from ..text import Text
from ..wrong import transposed

__all__ = ["EXERCISE", "on_all_rows", "selection"]


def selection(nv: Any) -> Any:
    """S of a robot with a floating base."""
    n = nv - 6
    return np.hstack([np.zeros((n, 6)), np.eye(n)])


def on_all_rows(tau: Any) -> Any:
    """Torques of the motors as generalised forces."""
    return np.concatenate([np.zeros(6), tau])


EXERCISE = Exercise(
    id="49.9.2",
    kind="code",
    title=Text("The selection matrix", "选择矩阵"),
    text=Text(
        """Build the selection matrix S of a robot with a floating base by hand, as the 12 × 18 matrix of Go2, and see
        that the first six entries of Sᵀτ are zero. Do the second once more without a matrix: a controller that runs
        a thousand times a second has no time for 216 products, most of them with zero.""",
        """手动构造浮动基座机器人的选择矩阵 S（Go2 为 12 × 18），并验证 Sᵀτ 的前六个元素为零。
        再不用矩阵写一遍 Sᵀτ：每秒运行上千次的控制器没有时间做 216 次乘法，何况大多是乘以零。""",
    ),
    parts=(
        Part(
            solution=selection,
            doc=Text(
                """Return the selection matrix of a robot with a floating base.

                nv: whole number, the entries of v: six of the base, then one for each motor.
                Returns: array (nv − 6, nv).""",
                """返回浮动基座机器人的选择矩阵。

                nv：整数，v 的维数：前六个属于基座，其后每个电机一个。
                返回：数组 (nv − 6, nv)。""",
            ),
            returns=(Quantity("S"),),
            cases=lambda rng: [(18,), (6 + int(rng.integers(3, 30)),), (7,)],
            slips={
                "selection-first": lambda nv: np.eye(nv - 6, nv),
                "selection-transposed": transposed(selection),
                "selection-of-base": lambda nv: np.eye(6, nv),
                "selection-of-all": lambda nv: np.eye(nv),
                "nq-for-nv": lambda nv: np.hstack([np.zeros((nv - 6, 7)), np.eye(nv - 6)]),
                "base-missing": lambda nv: np.eye(nv - 6),
            },
            properties=(
                Property(Text("Sᵀτ does nothing to the base", "Sᵀτ 对基座没有作用"), lambda answer, nv: answer[:, :6]),
                Property(
                    Text("S Sᵀ = 1: each motor has its own entry", "S Sᵀ = 1：每个电机对应一个分量"),
                    lambda answer, nv: answer @ answer.mT - np.eye(nv - 6),
                ),
            ),
        ),
        Part(
            solution=on_all_rows,
            doc=Text(
                """Return Sᵀτ without building S.

                tau: array (n,), N m, of the motors.
                Returns: array (6 + n,), N m and N, generalised forces.""",
                """不构造 S，返回 Sᵀτ。

                tau：数组 (n,)，N m，电机力矩。
                返回：数组 (6 + n,)，N m 与 N，广义力。""",
            ),
            returns=(Quantity("Sᵀτ"),),
            cases=lambda rng: [(rng.standard_normal(n),) for n in (12, 1, 23)],
            slips={
                "selection-first": lambda tau: np.concatenate([tau, np.zeros(6)]),
                "nq-for-nv": lambda tau: np.concatenate([np.zeros(7), tau]),
                "base-missing": lambda tau: tau,
                "column-vector": lambda tau: on_all_rows(tau)[:, None],
            },
            properties=(
                Property(
                    Text("the power is that of the motors: (Sᵀτ)·v = τ·q̇", "功率等于电机的功率：(Sᵀτ)·v = τ·q̇"),
                    lambda answer, tau: answer @ np.arange(len(tau) + 6.0) - tau @ np.arange(6.0, len(tau) + 6),
                ),
            ),
        ),
    ),
    hints=(
        Text(
            "S takes v to the rates of the joints: S v = q̇_j. Where do these stand in v?",
            "S 从 v 取出关节速度：S v = q̇_j。它们在 v 的什么位置？",
        ),
        Text(
            "Six columns of zeros for the base, then the unit matrix: `np.hstack`.",
            "前六列对应基座，为零；其后是单位矩阵：`np.hstack`。",
        ),
    ),
)
