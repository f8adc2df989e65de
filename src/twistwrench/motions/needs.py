"""What a motion needs: the torques of the motors, and where the ground must push (49.9, 49.10)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..algorithms.floating_base import base_placement
from ..algorithms.kinematics import frame_jacobian, frame_placement
from ..algorithms.rnea import rnea
from ..arrays import Array
from ..model import Model
from .motion import Motion

__all__ = ["Need", "needs"]

NEGLIGIBLE = 1e-6
"""Singular values below this share of the largest count as zero: two points cannot hold a moment about their line."""


class Need(NamedTuple):
    """What a motion needs: the torques of the motors, and where the ground must push.

    Attributes
    ----------
    tau : ndarray, shape (n, nv - 6)
        Joint forces beside the least forces at the standing feet, N m or N.
    pressure : ndarray, shape (n, 2)
        Centre of pressure on the level of the feet, m; NaN in flight.
    forces : ndarray, shape (n, k, 3) or (n, k, 6)
        Of the ground on each of the k feet, zero to rounding where it does not stand, in the axes of the world: f, or
        of two feet, which are soles, (τ, f), N m and N.
    """

    tau: Array
    pressure: Array
    forces: Array


def needs(model: Model, motion: Motion, *, wrench: Array | None = None, **other: Array) -> Need:
    """Return the torques and the centre of pressure of a motion.

    The base's rows of RNEA are what the feet must do; of all forces that do it the least are taken. Where two points
    stand, what they cannot do, a moment about their line, is left out, as it is by the motion itself: the robot tips.

    Parameters
    ----------
    model : Model
    motion : Motion
    wrench : ndarray, shape (n, 6), optional
        Of a template whose legs are massless: what the ground does, on the base in its frame. RNEA's unless given.
    **other : ndarray
        Instead of the motion's q, v or a.

    Returns
    -------
    Need
    """
    q, v, a = (other.get(name, getattr(motion, name)) for name in ("q", "v", "a"))
    tau = rnea(model, q, v, a)
    base, joints = (tau[:, :6], tau[:, 6:]) if wrench is None else (wrench, 0)
    rows = slice(0, 6) if len(motion.feet) < 3 else slice(3, 6)  # two feet are soles, three and more are points
    feet = [frame_jacobian(model, q, foot, "local_world_aligned")[:, rows].astype(float) for foot in motion.feet]
    J = np.concatenate([J_k * motion.contacts[:, k, None, None] for k, J_k in enumerate(feet)], axis=1)
    least = np.matvec(np.linalg.pinv(J[..., :6].mT, rcond=NEGLIGIBLE), base)
    forces = least.reshape(len(q), len(feet), -1)
    return Need(joints - np.matvec(J[..., 6:].mT, least), _pressure(model, motion, q, base), forces)


def _pressure(model: Model, motion: Motion, q: Array, base: Array) -> Array:
    """Return where on the ground a wrench on the base has no horizontal moment, from the middle of the feet there."""
    T = base_placement(model, q)
    f = np.matvec(T.rotation, base[:, 3:])
    feet = np.stack([frame_placement(model, q, foot).translation for foot in motion.feet], axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):  # in flight nothing stands and nothing pushes
        middle = (feet * motion.contacts[..., None]).sum(axis=1) / motion.contacts.sum(axis=1)[:, None]
        n = np.matvec(T.rotation, base[:, :3]) + np.cross(T.translation - middle, f)
        return np.stack([-n[:, 1] / f[:, 2], n[:, 0] / f[:, 2]], axis=1)
