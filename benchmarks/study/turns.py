"""Exponentials and logarithms (49.2, 49.3): every way of computing them, and their errors near 0 and near π."""

from collections.abc import Callable
from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench import bridge
from twistwrench import newton_euler_3d as ne
from twistwrench.arrays import Array
from twistwrench.newton_euler_3d.arithmetic import Arithmetic

from .numbers import DIGITS, FLOATS, HARDWARE
from .quantities import in_each
from .record import Record, Way

SERIES = 1e-10  # below this angle two terms of a series have more than 40 digits
PART = 250  # angles in a batch: the bar moves after each
LIBRARIES = {"tw": "twistwrench", "pin": "Pinocchio", "scipy": "SciPy"}  # by how the names of their ways begin


def ways() -> list[Way]:
    """Return every function of every library: exp3, log3 of rotations, exp6, log6 of placements, all of twists."""
    exact = "mpmath, axis and angle"
    found = [
        Way("exp3", "tw.exp3", tw.exp3, before=lambda V: (V[..., :3],)),
        Way("log3", "tw.log3", tw.log3, before=lambda T: (T[..., :3, :3],)),
        *in_each(FLOATS, "exp6", "tw.exp6", tw.exp6, after=lambda T: T.matrix()),
        *in_each(FLOATS, "log6", "tw.log6", tw.log6, before=lambda T: (tw.SE3.from_matrix(T),)),
        *in_each(DIGITS, "exp6", exact, lambda V: exact_exp(V[None])[0], batches=False),
        *in_each(DIGITS, "log6", exact, lambda T: exact_log(T[None])[0], batches=False),
    ]
    try:
        pin = bridge.import_pinocchio()
        motion, back, single = bridge.to_pinocchio_motion, bridge.from_pinocchio_motion, {"batches": False}
        found += [
            Way("exp3", "pin.exp3", pin.exp3, before=lambda V: (V[:3],), **single),
            Way("log3", "pin.log3", pin.log3, before=lambda T: (T[:3, :3],), **single),
            Way("exp6", "pin.exp6", pin.exp6, before=lambda V: (motion(V),), after=lambda T: T.homogeneous, **single),
            Way("log6", "pin.log6", pin.log6, before=lambda T: (pin.SE3(T),), after=back, **single),
        ]
    except ImportError:
        pass
    try:
        from scipy.linalg import expm
        from scipy.spatial.transform import RigidTransform, Rotation  # placements since 1.16
    except ImportError:
        return found
    rigid, from_turn, from_twist = "scipy RigidTransform", Rotation.from_rotvec, RigidTransform.from_exp_coords
    return [
        *found,
        Way("exp3", "scipy Rotation", from_turn, before=lambda V: (V[..., :3],), after=lambda R: R.as_matrix()),
        Way("log3", "scipy Rotation", Rotation.as_rotvec, before=lambda T: (Rotation.from_matrix(T[..., :3, :3]),)),
        Way("exp6", rigid, from_twist, after=lambda T: T.as_matrix()),
        Way("log6", rigid, RigidTransform.as_exp_coords, before=lambda T: (RigidTransform(T),)),
        *in_each(HARDWARE, "exp6", "scipy expm", expm, before=lambda V: (tw.hat(V),)),
    ]


def turns(count: int = 10_000, *, rng: int = 0, progress: bool = False) -> list[Record]:
    """Measure so many angles, half of them from 1e-300 to 1 and half from π − 1 to π − 1e-14, spread in log scale.

    Returned is the worst error of each function of each library. Of exp: of an entry of R, off the diagonal relative to
    |ω| where that is below 1; of p relative to |v|. Of log: of ω relative to |ω|, of v relative to |v|.
    """
    from tqdm import tqdm

    draw, half = np.random.default_rng(rng), count // 2
    small = 10.0 ** np.concatenate([np.linspace(-300, -20, half // 5), np.linspace(-20, 0, half - half // 5)])
    angles = np.concatenate([small, np.pi - 10.0 ** np.linspace(-14, 0, count - half)])
    axis, v = draw.standard_normal((2, count, 3))
    V = np.concatenate([angles[:, None] * axis / np.hypot.reduce(axis, axis=-1)[:, None], v], axis=-1)
    known = [way for way in ways() if way.number == "float64" and way.name != "scipy expm"]
    bar = tqdm(
        np.split(V, range(PART, count, PART)), "exp and log", unit_scale=PART, unit="angle", disable=not progress
    )
    errors = np.concatenate([_errors(known, part) for part in bar], axis=-1)
    return [
        Record(way.quantity, LIBRARIES[way.name.replace(".", " ").split()[0]], where=where, error=float(e.max()))
        for way, error in zip(known, errors, strict=True)
        for where, e in (("near 0", error[:half]), ("near π", error[half:]))
    ]


def _errors(known: list[Way], V: Array) -> Array:
    """Return the error of every way at every twist, shape (ways, n)."""
    import mpmath

    def error(way: Way) -> Array:
        given, of = (V, _exp_error) if way.quantity.startswith("exp") else (T, _log_error)
        value = way.value(given) if way.batches else np.stack([way.value(x) for x in given])
        return of(value, placed if given is V else turned, V)

    with mpmath.workdps(50):
        placed = exact_exp(ne.as_mpmath(V))
        T = placed.astype(np.float64)
        turned = exact_log(ne.as_mpmath(T))
        return np.stack([error(way) for way in known])


def _exp_error(got: Array, right: Array, V: Array) -> Array:
    """Return the worst relative error of each placement, or of each rotation."""
    off = abs(ne.as_mpmath(got[:, :3]) - right[:, :3, : got.shape[-1]]).astype(np.float64)
    angle, distance = np.hypot.reduce(V[:, :3], axis=-1), np.hypot.reduce(V[:, 3:], axis=-1)
    away = ~np.eye(3, dtype=bool)
    errors = [off[:, range(3), range(3)].max(axis=-1), off[:, :3, :3][:, away].max(axis=-1) / np.minimum(angle, 1)]
    if got.shape[-1] == 4:
        errors.append(off[:, :, 3].max(axis=-1) / distance)
    return np.asarray(np.max(errors, axis=0))


def _log_error(got: Array, right: Array, _: Array) -> Array:
    """Return the worst relative error of each twist, or of each ω."""
    off = abs(ne.as_mpmath(got) - right[:, : got.shape[-1]]).astype(np.float64)
    size = np.abs(right.astype(np.float64))
    halves = [slice(0, 3), slice(3, 6)][: got.shape[-1] // 3]
    return np.asarray(np.max([off[:, h].max(axis=-1) / size[:, h].max(axis=-1) for h in halves], axis=0))


# ---------------------------------------------------------------- in any number of digits, by the textbook's formulas


def exact_exp(V: Array) -> Array:
    """Return placements (n, 4, 4) of twists (n, 6) that turn: R = 1 + A W + B W², p = (1 + B W + C W²) v."""
    mp = V.flat[0].context
    W, theta = _cross(V[:, :3]), _length(V[:, :3])
    x, sin, half = (y[:, None, None] for y in (theta, _each(mp.sin, theta), _each(mp.sin, theta / 2)))
    A, B = sin / x, 2 * (half / x) ** 2  # the latter is (1 − cos θ) / θ²
    C = np.where(x < SERIES, mp.mpf(1) / 6 - x * x / 120, (x - sin) / (x * x * x))
    T, WW = np.tile(np.eye(4).astype(object), (len(V), 1, 1)), W @ W
    T[:, :3, :3] += A * W + B * WW
    T[:, :3, 3] = V[:, 3:] + ((B * W + C * WW) @ V[:, 3:, None])[:, :, 0]
    return T


def exact_log(T: Array) -> Array:
    """Return twists (n, 6) of placements, of which the nearest rotation is taken."""
    mp = T.flat[0].context
    number = Arithmetic(np.dtype(object), mp)
    R = np.stack([number.rotation(x, "T") for x in T[:, :3, :3]])
    skew = np.stack([R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], axis=-1) / 2
    sin, cos = _length(skew), (R[:, 0, 0] + R[:, 1, 1] + R[:, 2, 2] - 1) / 2
    theta = np.frompyfunc(mp.atan2, 2, 1)(sin, cos)
    w = skew * (theta / sin)[:, None]
    W, x = _cross(w), theta[:, None, None]
    series, exact = mp.mpf(1) / 12 + x * x / 720, (1 - x / 2 * _each(mp.cot, x / 2)) / (x * x)
    D = np.where(x < SERIES, series, exact)
    p = T[:, :3, 3, None]
    return np.concatenate([w, (p - W @ p / 2 + D * (W @ (W @ p)))[:, :, 0]], axis=-1)


def _each(function: Callable[[Any], Any], x: Array) -> Array:
    return np.asarray(np.frompyfunc(function, 1, 1)(x), object)


def _length(x: Array) -> Array:
    return _each(x.flat[0].context.sqrt, (x * x).sum(axis=-1))


def _cross(w: Array) -> Array:
    """Return [w]×."""
    x, y, z = np.moveaxis(w, -1, 0)
    none = 0 * x
    return np.stack([np.stack(r, -1) for r in ([none, -z, y], [z, none, -x], [-y, x, none])], axis=-2)
