"""Exercise 49.3.2: X of a pure rotation, and X and X* of any placement."""

from typing import Any

import numpy as np

from ...rotation import exp3
from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import FORCE_TRANSFORM, MOTION_TRANSFORM
from ..text import Text
from ..wrong import before, swapped
from .ex_49_0_1 import skew

__all__ = ["EXERCISE", "plucker", "rotation_transform"]


def rotation_transform(R: Any) -> Any:
    """X of the placement (R, 0)."""
    zero = np.zeros((3, 3))
    return np.block([[R, zero], [zero, R]])


def plucker(R: Any, p: Any) -> Any:
    """X and X* of the placement (R, p)."""
    zero, coupling = np.zeros((3, 3)), skew(p) @ R
    X = np.block([[R, zero], [coupling, R]])
    X_star = np.block([[R, coupling], [zero, R]])
    return X, X_star


def _with(coupling: Any, R: Any) -> Any:
    """Put something else in the place of [p]× R."""
    zero = np.zeros((3, 3))
    return np.block([[R, zero], [coupling, R]]), np.block([[R, coupling], [zero, R]])


def _inverse(R: Any, p: Any) -> Any:
    return plucker(R.mT, -R.mT @ p)


ROTATION = Part(
    solution=rotation_transform,
    doc=Text(
        """Return X of the placement (R, 0).

        R: array (3, 3), takes coordinates in B to A.
        Returns: array (6, 6), in the order (ω, v).""",
        """返回位姿 (R, 0) 的 X。

        R：数组 (3, 3)，把 B 中坐标变到 A。
        返回：数组 (6, 6)，顺序为 (ω, v)。""",
    ),
    returns=(Quantity("X", MOTION_TRANSFORM),),
    cases=lambda rng: [(exp3(rng.standard_normal(3)),) for _ in range(4)],
    slips={
        "rotation-transposed": before(rotation_transform, lambda R: R.mT, which=0),
        "half-rotated": lambda R: np.block([[R, 0 * R], [0 * R, np.eye(3)]]),
    },
)

BOTH = Part(
    solution=plucker,
    doc=Text(
        """Return X and X* of any placement (R, p).

        R: array (3, 3), takes coordinates in B to A.
        p: array (3,), m, the origin of B in A.
        Returns: two arrays (6, 6): X for twists (ω, v), X* for wrenches (τ, f), from B to A.""",
        """返回任意位姿 (R, p) 的 X 与 X*。

        R：数组 (3, 3)，把 B 中坐标变到 A。
        p：数组 (3,)，单位 m，B 的原点在 A 中的位置。
        返回：两个 (6, 6) 数组：X 用于 twist (ω, v)，X* 用于 wrench (τ, f)，都是从 B 到 A。""",
    ),
    returns=(Quantity("X", MOTION_TRANSFORM), Quantity("X*", FORCE_TRANSFORM)),
    cases=lambda rng: [(exp3(rng.standard_normal(3)), rng.standard_normal(3)) for _ in range(5)],
    slips={
        "coupling-dropped": lambda R, p: _with(np.zeros((3, 3)), R),
        "coupling-sign": lambda R, p: _with(-skew(p) @ R, R),
        "coupling-order": lambda R, p: _with(R @ skew(p), R),
        "coupling-unrotated": lambda R, p: _with(skew(p), R),
        "skew-symmetric": lambda R, p: _with(np.abs(skew(p)) @ R, R),
        "rotation-transposed": lambda R, p: plucker(R.mT, p),
        "inverse-transform": _inverse,
        "inverse-unrotated": lambda R, p: plucker(R.mT, -p),
        "swapped-halves": swapped(plucker),
        "transpose-for-dual": lambda R, p: (plucker(R, p)[0], plucker(R, p)[0].mT),
        "motion-for-force": lambda R, p: (plucker(R, p)[0], plucker(R, p)[0]),
        "force-for-motion": lambda R, p: (plucker(R, p)[1], plucker(R, p)[1]),
    },
    properties=(
        Property(
            Text("X*ᵀ X = 1: the power FᵀV is the same in both frames", "X*ᵀ X = 1：功率 FᵀV 在两个坐标系中相同"),
            lambda answer, R, p: answer[1].mT @ answer[0] - np.eye(6),
        ),
        Property(
            Text("det X = 1: X moves a twist and does not stretch it", "det X = 1：X 只搬移 twist，不拉伸"),
            lambda answer, R, p: np.linalg.det(answer[0]) - 1,
        ),
    ),
)

EXERCISE = Exercise(
    id="49.3.2",
    kind="code",
    title=Text("A pure rotation", "纯旋转"),
    text=Text(
        """Frames A and B share their origin: T_AB = (R, 0). Write down X and compare it with blkdiag(R, R).
        Then give X and X* of any placement (R, p): turn first, and shift afterwards.
        When does a change of frame only turn ω and v, each by itself?""",
        """坐标系 A 与 B 原点重合：T_AB = (R, 0)。写出 X，并与 blkdiag(R, R) 比较。
        再写出任意位姿 (R, p) 的 X 与 X*：先旋转，再平移。
        什么时候变换退化为分别旋转 ω 和 v？""",
    ),
    parts=(ROTATION, BOTH),
    hints=(
        Text(
            "Without a translation both vectors keep their reference point. What is left is a change of axes.",
            "没有平移时两个向量的参考点都不变，只是换坐标轴。",
        ),
        Text(
            "X(R, p) = X(1, p) X(R, 0), and the same with stars. Multiply the blocks.",
            "X(R, p) = X(1, p) X(R, 0)，X* 同理。按块相乘即可。",
        ),
    ),
    answer=Text(
        """X equals blkdiag(R, R) exactly when p = 0: the frames share their origin. The coupling [p]× R is what a
        shift of the reference point adds to v, and R is invertible, so it vanishes only with p. Then X* = X as well.
        For a single ω parallel to p the coupling adds nothing either, but that is a property of this ω, not of X.""",
        """当且仅当 p = 0（两坐标系原点重合）时 X = blkdiag(R, R)。耦合项 [p]× R 是移动参考点时 v 的增量；R 可逆，
        所以只有 p = 0 时它才为零，此时 X* = X。
        若某个 ω 与 p 平行，耦合项也没有贡献，但那是这个 ω 的特点，不是 X 的性质。""",
    ),
    uses=("skew",),
)
