"""Exercise 49.11.1, continued: inertia and transform in Pinocchio's order (tests 3 and 4)."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Part, Property, Quantity
from ..layouts import PINOCCHIO_INERTIA, PINOCCHIO_TRANSFORM
from ..robots import robot
from ..text import Text
from ..wrong import swap, swapped

__all__ = ["ACTION", "INERTIA_MATRIX", "pinocchio_action", "pinocchio_inertia"]


def pinocchio_inertia(m: Any, c: Any, I_c: Any) -> Any:
    """Spatial inertia in the order (v, ω) (test 3)."""
    cx = tw.skew(c)
    return np.block([[m * np.eye(3), -m * cx], [m * cx, I_c - m * cx @ cx]])


def pinocchio_action(R: Any, p: Any) -> Any:
    """X in the order (v, ω) (test 4)."""
    return np.block([[R, tw.skew(p) @ R], [np.zeros((3, 3)), R]])


def _quarters(change: Any) -> Any:
    """Put other things into the quarters of the inertia: m, [c]× and I_c."""
    return lambda m, c, I_c: np.block(change(m * np.eye(3), m * tw.skew(c), I_c, tw.skew(c)))


def _inertias(rng: Any) -> Any:
    bodies = [robot("go2").inertia[i] for i in rng.choice(np.arange(1, 14), 3, replace=False)]
    return [(float(body.mass), np.array(body.com), np.array(body.inertia_at_com)) for body in bodies]


INERTIA_MATRIX = Part(
    solution=pinocchio_inertia,
    doc=Text(
        """Return the spatial inertia as `pin.Inertia.matrix()` has it (test 3).

        m: number, kg. c: array (3,), m, the centre of mass (`.lever`). I_c: array (3, 3), kg m²,
        about it (`.inertia`).
        Returns: array (6, 6), rows (l, k), columns (v, ω): the linear half first.""",
        """按 `pin.Inertia.matrix()` 的排列返回空间惯量（测试 3）。

        m：数，kg。c：数组 (3,)，单位 m，质心（`.lever`）。I_c：数组 (3, 3)，kg m²，关于质心
        (`.inertia`)。
        返回：数组 (6, 6)，行 (l, k)，列 (v, ω)：线分量在前。""",
    ),
    returns=(Quantity("I", PINOCCHIO_INERTIA),),
    cases=_inertias,
    slips={
        "swapped-halves": swapped(pinocchio_inertia),
        "com-sign": _quarters(lambda m, mc, I, c: [[m, mc], [-mc, I - mc @ c]]),
        "inertia-asymmetric": _quarters(lambda m, mc, I, c: [[m, mc], [mc, I - mc @ c]]),
        "com-dropped": _quarters(lambda m, mc, I, c: [[m, 0 * mc], [0 * mc, I]]),
        "parallel-axis-dropped": _quarters(lambda m, mc, I, c: [[m, -mc], [mc, I]]),
        "parallel-axis-sign": _quarters(lambda m, mc, I, c: [[m, -mc], [mc, I + mc @ c]]),
        "mass-dropped": _quarters(lambda m, mc, I, c: [[m, -c], [c, I - c @ c]]),
    },
    reasons={
        "swapped-halves": Text(
            "That is the order of the chapter, (ω, v). Pinocchio has the linear half first.",
            "那是本章的顺序 (ω, v)；Pinocchio 的线分量在前。",
        ),
        "com-sign": Text(
            "The linear half comes first here: l = m v − m [c]× ω is the first row, and the minus stands top right.",
            "这里线分量在前：第一行是 l = m v − m [c]× ω，负号在右上。",
        ),
        "inertia-asymmetric": Text(
            "[c]× is antisymmetric, so its mirror image has the other sign: −m [c]× top right, m [c]× bottom left.",
            "[c]× 是反对称的，镜像位置符号相反：右上为 −m [c]×，左下为 m [c]×。",
        ),
    },
    properties=(Property(Text("it is symmetric", "对称"), lambda answer, m, c, I_c: answer - answer.mT),),
)

ACTION = Part(
    solution=pinocchio_action,
    doc=Text(
        """Return the transform of twists as `pin.SE3.action` has it (test 4).

        R: array (3, 3). p: array (3,), m. The placement of B in A.
        Returns: array (6, 6), from (v, ω) in B to (v, ω) in A: the linear half first.""",
        """按 `pin.SE3.action` 的排列返回 twist 的变换（测试 4）。

        R：数组 (3, 3)。p：数组 (3,)，单位 m。B 在 A 中的位姿。
        返回：数组 (6, 6)，把 B 中的 (v, ω) 变为 A 中的 (v, ω)：线分量在前。""",
    ),
    returns=(Quantity("X", PINOCCHIO_TRANSFORM),),
    cases=lambda rng: [(tw.exp3(rng.standard_normal(3)), rng.standard_normal(3)) for _ in range(3)],
    slips={
        "swapped-halves": swapped(pinocchio_action),
        "force-for-motion": lambda R, p: swap(pinocchio_action(R, p)),
        "coupling-dropped": lambda R, p: pinocchio_action(R, 0 * p),
        "coupling-sign": lambda R, p: pinocchio_action(R, -p),
        "coupling-order": lambda R, p: pinocchio_action(R, R @ p),
        "coupling-unrotated": lambda R, p: np.block([[R, tw.skew(p)], [np.zeros((3, 3)), R]]),
        "rotation-transposed": lambda R, p: pinocchio_action(R.mT, p),
    },
    reasons={
        "swapped-halves": Text(
            "That is the order of the chapter, (ω, v). Pinocchio has the linear half first.",
            "那是本章的顺序 (ω, v)；Pinocchio 的线分量在前。",
        ),
    },
    alike=(frozenset({"swapped-halves", "force-for-motion"}),),  # X* has [p]× R where X in the other order has it
)
