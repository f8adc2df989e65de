"""Exercise 49.8.2: the size of the mass matrix."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..robots import robot
from ..text import Text
from ..wrong import after

__all__ = ["EXERCISE", "held_mass_matrix", "mass_matrix_sizes"]


def mass_matrix_sizes() -> Any:
    """Rows of M with a floating and with a fixed base."""
    joints = 12
    return 6 + joints, joints


def held_mass_matrix(M: Any) -> Any:
    """Mass matrix of the same robot with its base held."""
    return M[6:, 6:]


def _let_go(M: Any) -> Any:
    return M[6:, 6:] - M[6:, :6] @ np.linalg.solve(M[:6, :6], M[:6, 6:])


def _cases(rng: Any) -> Any:
    small = tw.random_tree(6, rng=rng, base="floating", kinds=["revolute", "spherical"])
    large = tw.random_tree(20, rng=rng, base="floating", kinds=["revolute"])
    models = [robot("go2"), robot("go2"), small, large]
    return [(tw.crba(model, model.random_configuration(rng=rng)),) for model in models]


EXERCISE = Exercise(
    id="49.8.2",
    kind="number",
    title=Text("The size of M", "M 的维数"),
    text=Text(
        """How many rows has M(q) of Go2 with its floating base, and how many if the same URDF is loaded with a fixed
        base? And where in the larger matrix is the smaller one?""",
        """Go2 带浮动基座时 M(q) 有多少行？用同一个 URDF 但固定基座时又有多少行？小矩阵在大矩阵的什么位置？""",
    ),
    parts=(
        Part(
            solution=mass_matrix_sizes,
            doc=Text(
                "Return the number of rows of M with a floating base, then with a fixed base: two whole numbers.",
                "依次返回浮动基座和固定基座时 M 的行数：两个整数。",
            ),
            returns=(Quantity("rows (floating)"), Quantity("rows (fixed)")),
            cases=lambda rng: [()],
            slips={
                "nq-for-nv": lambda: (19, 12),
                "base-missing": lambda: (12, 12),
                "njoints-for-nv": lambda: (14, 13),
            },
        ),
        Part(
            solution=held_mass_matrix,
            doc=Text(
                """Return the mass matrix of the same robot in the same posture with its base held.

                M: array (nv, nv), symmetric, of a robot with a floating base; base first.
                Returns: array (nv − 6, nv − 6).""",
                """返回同一机器人、同一位形但基座被固定时的质量矩阵。

                M：数组 (nv, nv)，对称，浮动基座机器人的质量矩阵，基座在前。
                返回：数组 (nv − 6, nv − 6)。""",
            ),
            returns=(Quantity("M (base held)"),),
            cases=_cases,
            slips={
                "base-let-go": _let_go,
                "base-block-for-joints": lambda M: M[:6, :6],
                "base-last": lambda M: M[:-6, :-6],
                "nq-for-nv": lambda M: M[7:, 7:],
                "robot-hard-coded": lambda M: M[6:18, 6:18],
                "one-triangle": after(held_mass_matrix, np.triu),
                "doubled-off-diagonal": after(held_mass_matrix, lambda M: M + M.mT - np.diag(np.diag(M))),
            },
            properties=(
                Property(
                    Text(
                        "½ q̇ᵀM q̇ is the energy of the joints' motion, with the base still",
                        "½ q̇ᵀM q̇ 是基座不动时关节运动的动能",
                    ),
                    lambda answer, M: [
                        v @ answer @ v - np.concatenate([np.zeros(6), v]) @ M @ np.concatenate([np.zeros(6), v])
                        for v in np.random.default_rng(0).standard_normal((3, len(M) - 6))
                    ],
                ),
            ),
        ),
    ),
    hints=(
        Text("M has one row for each entry of v, not of q.", "M 的行对应 v 的分量，而不是 q 的分量。"),
        Text(
            "½ vᵀM v is the kinetic energy. What is left of it where the first six entries of v are zero?",
            "½ vᵀM v 是动能。v 的前六个分量为零时还剩下什么？",
        ),
    ),
)
