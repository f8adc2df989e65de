"""The project, stage 1, continued: transforms and cross operators, and how they go wrong."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Part, Quantity
from ..layouts import FORCE_TRANSFORM, MOTION_TRANSFORM
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
    residuals=(lambda answer, T: answer[1].mT @ answer[0] - np.eye(6),),
)


def _half(X: Any) -> Any:
    X = X.copy()
    X[3:, 3:] = np.eye(3)
    return X


CROSS = Part(
    solution=cross_operators,
    rtol=1e-12,
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
    residuals=(
        lambda answer, V: answer[0] @ V,
        lambda answer, V: answer[1] + answer[0].mT,
    ),
)
