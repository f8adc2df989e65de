"""Exponential and logarithm of SE(3), and every way of computing them (49.2, 49.3)."""

from __future__ import annotations

import numpy as np

import twistwrench as tw
from twistwrench import bridge
from twistwrench.arrays import Array

from .numbers import DIGITS, HARDWARE, TRUTH, as_long_double, convert, digits
from .quantity import Arrays, Quantity, Way, repeated

__all__ = ["pose_quantities"]


def pose_quantities(
    drawn: int, states: int, *, batch: int, rng: np.random.Generator, pinocchio: bool
) -> list[Quantity]:
    """Return exp and log: of random axes, angles uniform in 0 … π, and 1 m times a normal number.

    Parameters
    ----------
    drawn, states : int
        How many are drawn, and at how many the truth is known; the others only take time.
    batch : int
    rng : numpy Generator
    pinocchio : bool
        Whether it is there.
    """
    w, v = rng.standard_normal((2, drawn, 3))
    w *= rng.uniform(0, np.pi, (drawn, 1)) / np.sqrt((w * w).sum(axis=-1, keepdims=True))
    V = np.concatenate([w, v], axis=-1)
    exact = [_exponential(convert(x, TRUTH)) for x in V[:states]]
    nearly = tw.exp6(V.astype(np.longdouble)).matrix()
    nearly[:states] = [as_long_double(x) for x in exact]

    def twists(number: str, where: int | slice) -> Arrays:
        return (convert(repeated(V, where), number),)

    def placements(number: str, where: int | slice) -> Arrays:
        """Return the truth, rounded once."""
        if isinstance(where, int) and number in DIGITS:
            context = digits(int(number.split()[0]))
            return (np.asarray(np.frompyfunc(lambda x: +context.convert(x), 1, 1)(exact[where]), object),)
        return (repeated(nearly, where).astype(number),)

    ways = [[*_ours(), *(_pinocchio() if pinocchio else []), *_scipy()][k::2] for k in (0, 1)]
    return [
        Quantity("exp", "exponential exp6", twists, lambda i: exact[i], ways[0], batch),
        Quantity("log", "logarithm log6", placements, lambda i: convert(V[i], TRUTH), ways[1], batch),
    ]


def _ours() -> list[Way]:
    """Return ways of exp and log in turns, and so below."""
    return [
        Way("tw.exp6", tw.exp6, after=lambda T: T.matrix()),
        Way("tw.log6", tw.log6, before=lambda T: (tw.SE3.from_matrix(T),)),
        Way("mpmath expm", _exponential, DIGITS, batches=False),
        Way("mpmath, axis and angle", _logarithm, DIGITS, batches=False),
    ]


def _pinocchio() -> list[Way]:
    pin = bridge.import_pinocchio()

    def motion(V: Array) -> tuple[object]:
        return (bridge.to_pinocchio_motion(V),)

    def placement(T: Array) -> tuple[object]:
        return (pin.SE3(T),)

    number = ("float64",)
    return [
        Way("pin.exp6", pin.exp6, number, batches=False, before=motion, after=lambda T: np.array(T.homogeneous)),
        Way("pin.log6", pin.log6, number, batches=False, before=placement, after=bridge.from_pinocchio_motion),
    ]


def _scipy() -> list[Way]:
    """Return SciPy's ways, which has placements since 1.16; empty without it."""
    try:
        from scipy.linalg import expm
        from scipy.spatial.transform import RigidTransform
    except ImportError:
        return []
    number = ("float64",)
    return [
        Way("scipy RigidTransform", RigidTransform.from_exp_coords, number, after=lambda T: T.as_matrix()),
        Way("scipy RigidTransform", RigidTransform.as_exp_coords, number, before=lambda T: (RigidTransform(T),)),
        Way("scipy expm", expm, HARDWARE, before=lambda V: (tw.hat(V),)),
    ]


def _exponential(V: Array) -> Array:
    """Return the exponential of the 4×4 matrix of a twist of mpmath numbers, with no formula of ours."""
    x, y, z, *v = V
    zero, mp = x * 0, x.context
    hat = mp.matrix([[zero, -z, y, v[0]], [z, zero, -x, v[1]], [-y, x, zero, v[2]], [zero] * 4])
    return np.array(mp.expm(hat).tolist(), object)


def _logarithm(T: Array) -> Array:
    """Return the twist of a placement of mpmath numbers: axis and angle of R, and the v that leads to p.

    p is linear in v: its columns are the p of twists (ω, e_k). mpmath's own ``logm`` leaves the branch near π.
    """
    mp = T[0, 0].context
    sine = np.array([T[2, 1] - T[1, 2], T[0, 2] - T[2, 0], T[1, 0] - T[0, 1]]) / 2
    size = mp.sqrt((sine * sine).sum())
    w = sine * (mp.atan2(size, (T[0, 0] + T[1, 1] + T[2, 2] - 1) / 2) / size)
    columns = [_exponential(np.append(w, e * T[3, 3]))[:3, 3] for e in np.eye(3, dtype=int)]
    v = mp.lu_solve(mp.matrix(np.stack(columns, axis=1).tolist()), mp.matrix(T[:3, 3].tolist()))
    return np.append(w, list(v))
