"""The project, stage 1, continued: transforms and cross operators, and how they go wrong."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Part, Property, Quantity
from ..layouts import FORCE_TRANSFORM, MOTION_TRANSFORM
from ..text import Text
from ..wrong import swapped

__all__ = ["CROSS", "TRANSFORMS", "cross_operators", "transforms_of"]


def transforms_of(T: Any) -> Any:
    """X and X* of a placement."""
    R, zero = T[:3, :3], np.zeros((3, 3))
    coupling = tw.skew(T[:3, 3]) @ R
    return np.block([[R, zero], [coupling, R]]), np.block([[R, coupling], [zero, R]])


def cross_operators(V: Any) -> Any:
    """V× and V×*."""
    w, v, zero = tw.skew(V[:3]), tw.skew(V[3:]), np.zeros((3, 3))
    return np.block([[w, zero], [v, w]]), np.block([[w, v], [zero, w]])


ZERO = np.zeros((3, 3))


def _coupled(coupling: Any) -> Any:
    """Put another coupling in its place, of R and [p]×."""

    def wrong(T: Any) -> Any:
        R = T[:3, :3]
        B = coupling(R, tw.skew(T[:3, 3]))
        return np.block([[R, ZERO], [B, R]]), np.block([[R, B], [ZERO, R]])

    return wrong


def _pair(change: Any) -> Any:
    """Change X and X* as a pair, given the rotation and the coupling as well."""

    def wrong(T: Any) -> Any:
        X, X_star = transforms_of(T)
        return change(X, X_star)

    return wrong


def _crossed(change: Any) -> Any:
    """Put other things in the blocks of V× and V×*, of [ω]× and [v]×."""
    return lambda V: tuple(np.block(blocks) for blocks in change(tw.skew(V[:3]), tw.skew(V[3:])))


def _pose(rng: Any) -> Any:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = tw.exp3(rng.standard_normal(3)), rng.standard_normal(3)
    return T


TRANSFORMS = Part(
    solution=transforms_of,
    rtol=1e-12,
    doc=Text(
        """Return X and X*, which take twists and wrenches from B to A.

        T: array (4, 4), the placement of B in A.
        Returns: arrays (6, 6) and (6, 6), in the orders (ω, v) and (τ, f).""",
        """返回把 twist 和 wrench 从 B 变到 A 的 X 与 X*。

        T：数组 (4, 4)，B 在 A 中的位姿。
        返回：两个 (6, 6) 数组，顺序为 (ω, v) 与 (τ, f)。""",
    ),
    returns=(Quantity("X", MOTION_TRANSFORM), Quantity("X*", FORCE_TRANSFORM)),
    cases=lambda rng: [(_pose(rng),) for _ in range(4)],
    slips={
        "coupling-dropped": _coupled(lambda R, p: ZERO),
        "coupling-sign": _coupled(lambda R, p: -p @ R),
        "coupling-order": _coupled(lambda R, p: R @ p),
        "coupling-unrotated": _coupled(lambda R, p: p),
        "coupling-corner": _pair(lambda X, X_star: (X_star, X)),
        "transpose-for-dual": _pair(lambda X, X_star: (X, X.mT)),
        "motion-for-force": _pair(lambda X, X_star: (X, X)),
        "inverse-transform": _pair(lambda X, X_star: (X_star.mT, X.mT)),
        "rotation-transposed": lambda T: transforms_of(np.block([[T[:3, :3].mT, T[:3, 3:]], [0, 0, 0, 1]])),
        "swapped-halves": swapped(transforms_of, only=(0,)),
        "half-rotated": _pair(lambda X, X_star: (_half(X), _half(X_star))),
    },
    properties=(
        Property(
            Text("X*ᵀ X = 1: the power FᵀV is the same in both frames", "X*ᵀ X = 1：功率 FᵀV 在两个坐标系中相同"),
            lambda answer, T: answer[1].mT @ answer[0] - np.eye(6),
        ),
    ),
)


def _half(X: Any) -> Any:
    X = X.copy()
    X[3:, 3:] = np.eye(3)
    return X


CROSS = Part(
    solution=cross_operators,
    rtol=1e-12,
    doc=Text(
        """Return V× and V×*, the derivatives of a twist and of a wrench that are carried along by V.

        V: array (6,), (ω, v), rad/s and m/s.
        Returns: arrays (6, 6) and (6, 6), which act on twists (ω, v) and on wrenches (τ, f).""",
        """返回 V× 与 V×*：随 V 一起运动的 twist 和 wrench 的导数。

        V：数组 (6,)，(ω, v)，rad/s 与 m/s。
        返回：两个 (6, 6) 数组，分别作用于 twist (ω, v) 和 wrench (τ, f)。""",
    ),
    returns=(Quantity("V×", MOTION_TRANSFORM), Quantity("V×*", FORCE_TRANSFORM)),
    cases=lambda rng: [(rng.standard_normal(6),) for _ in range(4)],
    slips={
        "motion-cross-for-force": _crossed(lambda w, v: ([[w, ZERO], [v, w]], [[w, ZERO], [v, w]])),
        "cross-transposed": _crossed(lambda w, v: ([[w, ZERO], [v, w]], [[-w, -v], [ZERO, -w]])),
        "coupling-corner": _crossed(lambda w, v: ([[w, v], [ZERO, w]], [[w, ZERO], [v, w]])),
        "coupling-dropped": _crossed(lambda w, v: ([[w, ZERO], [ZERO, w]], [[w, ZERO], [ZERO, w]])),
        "skew-sign": _crossed(lambda w, v: ([[-w, ZERO], [-v, -w]], [[-w, -v], [ZERO, -w]])),
        "swapped-halves": _crossed(lambda w, v: ([[v, ZERO], [w, v]], [[v, w], [ZERO, v]])),
    },
    reasons={
        "coupling-corner": Text(
            "In V× the block [v]× stands bottom left, in V×* top right.", "V× 中 [v]× 在左下，V×* 中在右上。"
        ),
        "coupling-dropped": Text(
            "v acts as well: [v]× stands beside the two [ω]×.", "v 也起作用：除两个 [ω]× 外还有 [v]×。"
        ),
    },
    properties=(
        Property(Text("V× V = 0", "V× V = 0"), lambda answer, V: answer[0] @ V),
        Property(
            Text("V×* = −(V×)ᵀ: the power does not notice a moving frame", "V×* = −(V×)ᵀ：功率不受坐标系运动的影响"),
            lambda answer, V: answer[1] + answer[0].mT,
        ),
    ),
)
