"""Exponentials and logarithms at angles near 0 and near π: ours, Pinocchio's and SciPy's, against fifty digits."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench import newton_euler_3d as ne
from twistwrench.arrays import Array
from twistwrench.bridge import from_pinocchio_motion, import_pinocchio, to_pinocchio_motion
from twistwrench.newton_euler_3d.arithmetic import Arithmetic

__all__ = ["Turns", "rotations"]

SERIES = 1e-10
"""Below this angle two terms of a series have more than 40 digits."""

PART = 250
"""The number of angles in a batch: the bar moves after each batch."""

Way = Callable[[Array], Array]


class Turns(NamedTuple):
    """The worst relative errors of one function of one library.

    Attributes
    ----------
    function, library : str
    near_zero, near_pi : float
        exp: of an entry of R, off the diagonal relative to |ω| where that is below 1; of p relative to |v|. log: of ω
        relative to |ω|, of v relative to |v|.
    """

    function: str
    library: str
    near_zero: float
    near_pi: float


def rotations(count: int = 10_000, *, rng: int = 0, progress: bool = False) -> list[Turns]:
    """Measure so many angles, half of them from 1e-300 to 1 and half from π − 1 to π − 1e-14, spread in log scale.

    Parameters
    ----------
    count : int
    rng : int
        Of the axes and of v.
    progress : bool
        Whether a bar is shown on stderr.
    """
    from tqdm import tqdm

    draw, half = np.random.default_rng(rng), count // 2
    small = 10.0 ** np.concatenate([np.linspace(-300, -20, half // 5), np.linspace(-20, 0, half - half // 5)])
    angles = np.concatenate([small, np.pi - 10.0 ** np.linspace(-14, 0, count - half)])
    axis, v = draw.standard_normal((2, count, 3))
    V = np.concatenate([angles[:, None] * axis / np.hypot.reduce(axis, axis=-1)[:, None], v], axis=-1)
    ways, parts = _ways(), np.split(V, range(PART, count, PART))
    bar = tqdm(parts, "exp and log", unit_scale=PART, unit="angle", disable=not progress)
    errors = np.concatenate([_errors(ways, part) for part in bar], axis=-1)
    worst = zip(errors[:, :half].max(axis=-1), errors[:, half:].max(axis=-1))
    return [Turns(function, library, float(a), float(b)) for (function, library, _), (a, b) in zip(ways, worst)]


def _errors(ways: list[tuple[str, str, Way]], V: Array) -> Array:
    """Return the error of every way at every twist, shape (ways, n)."""
    import mpmath

    with mpmath.workdps(50):
        placed = _exp(ne.as_mpmath(V))
        T = placed.astype(np.float64)
        turned = _log(ne.as_mpmath(T))
        return np.stack(
            [
                _exp_error(way(V), placed, V) if function.startswith("exp") else _log_error(way(T), turned)
                for function, _, way in ways
            ]
        )


def _ways() -> list[tuple[str, str, Way]]:
    """Return every function of every library that is installed, from (n, 6) to (n, 3 or 4, ·) or back."""
    ways: list[tuple[str, str, Way]] = [
        ("exp3", "twistwrench", lambda V: tw.exp3(V[:, :3])),
        ("log3", "twistwrench", lambda T: tw.log3(T[:, :3, :3])),
        ("exp6", "twistwrench", lambda V: tw.exp6(V).matrix()),
        ("log6", "twistwrench", tw.log6),
    ]
    try:
        pin = import_pinocchio()
        ways += [
            ("exp3", "Pinocchio", lambda V: np.stack([pin.exp3(x) for x in V[:, :3]])),
            ("log3", "Pinocchio", lambda T: np.stack([pin.log3(x) for x in T[:, :3, :3]])),
            ("exp6", "Pinocchio", lambda V: np.stack([pin.exp6(x).homogeneous for x in to_pinocchio_motion(V)])),
            ("log6", "Pinocchio", lambda T: from_pinocchio_motion(np.stack([pin.log6(x).vector for x in T]))),
        ]
    except ImportError:
        pass
    try:
        from scipy.spatial.transform import RigidTransform, Rotation
    except ImportError:
        return ways
    return [
        *ways,
        ("exp3", "SciPy", lambda V: Rotation.from_rotvec(V[:, :3]).as_matrix()),
        ("log3", "SciPy", lambda T: Rotation.from_matrix(T[:, :3, :3]).as_rotvec()),
        ("exp6", "SciPy", lambda V: RigidTransform.from_exp_coords(V).as_matrix()),
        ("log6", "SciPy", lambda T: RigidTransform.from_matrix(T).as_exp_coords()),
    ]


def _exp_error(got: Array, right: Array, V: Array) -> Array:
    """Return the worst relative error of each placement, or of each rotation."""
    off = abs(ne.as_mpmath(got[:, :3]) - right[:, :3, : got.shape[-1]]).astype(np.float64)
    angle, distance = np.hypot.reduce(V[:, :3], axis=-1), np.hypot.reduce(V[:, 3:], axis=-1)
    away = ~np.eye(3, dtype=bool)
    errors = [off[:, range(3), range(3)].max(axis=-1), off[:, :3, :3][:, away].max(axis=-1) / np.minimum(angle, 1)]
    if got.shape[-1] == 4:
        errors.append(off[:, :, 3].max(axis=-1) / distance)
    return np.asarray(np.max(errors, axis=0))


def _log_error(got: Array, right: Array) -> Array:
    """Return the worst relative error of each twist, or of each ω."""
    off = abs(ne.as_mpmath(got) - right[:, : got.shape[-1]]).astype(np.float64)
    size = np.abs(right.astype(np.float64))
    halves = [slice(0, 3), slice(3, 6)][: got.shape[-1] // 3]
    return np.asarray(np.max([off[:, h].max(axis=-1) / size[:, h].max(axis=-1) for h in halves], axis=0))


# ---------------------------------------------------------------- in fifty digits, by the textbook's formulas


def _exp(V: Array) -> Array:
    """Return placements (n, 4, 4) of twists (n, 6) that turn: R = 1 + A W + B W², p = (1 + B W + C W²) v."""
    from mpmath import mp

    W, theta = _cross(V[:, :3]), _length(V[:, :3])
    sin, cos = _each(mp.sin, theta), _each(mp.cos, theta)
    small = (theta < SERIES)[:, None, None]
    x = theta[:, None, None]
    A = np.where(small, 1 - x * x / 6, sin[:, None, None] / x)
    B = np.where(small, mp.mpf(1) / 2 - x * x / 24, (1 - cos)[:, None, None] / (x * x))
    C = np.where(small, mp.mpf(1) / 6 - x * x / 120, (theta - sin)[:, None, None] / (x * x * x))
    T, WW = np.tile(ne.as_mpmath(np.eye(4)), (len(V), 1, 1)), W @ W
    T[:, :3, :3] += A * W + B * WW
    T[:, :3, 3] = V[:, 3:] + ((B * W + C * WW) @ V[:, 3:, None])[:, :, 0]
    return T


def _log(T: Array) -> Array:
    """Return twists (n, 6) of placements, of which the nearest rotation is taken."""
    from mpmath import mp

    number = Arithmetic(np.dtype(object), mp)
    R = np.stack([number.rotation(x, "T") for x in T[:, :3, :3]])
    skew = np.stack([R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], axis=-1) / 2
    sin, cos = _length(skew), (R[:, 0, 0] + R[:, 1, 1] + R[:, 2, 2] - 1) / 2
    theta = np.frompyfunc(mp.atan2, 2, 1)(sin, cos)
    w = skew * (theta / sin)[:, None]
    W, x = _cross(w), theta[:, None, None]
    cot = _each(mp.cot, theta / 2)[:, None, None]
    D = np.where((theta < SERIES)[:, None, None], mp.mpf(1) / 12 + x * x / 720, (1 - x / 2 * cot) / (x * x))
    p = T[:, :3, 3, None]
    return np.concatenate([w, (p - W @ p / 2 + D * (W @ (W @ p)))[:, :, 0]], axis=-1)


def _each(function: Callable[[Any], Any], x: Array) -> Array:
    return np.asarray(np.frompyfunc(function, 1, 1)(x), object)


def _length(x: Array) -> Array:
    from mpmath import mp

    return _each(mp.sqrt, (x * x).sum(axis=-1))


def _cross(w: Array) -> Array:
    """Return [w]×."""
    x, y, z = np.moveaxis(w, -1, 0)
    none = 0 * x
    return np.stack([np.stack(r, -1) for r in ([none, -z, y], [z, none, -x], [-y, x, none])], axis=-2)
