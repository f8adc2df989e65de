"""A robot that stays level: its floating base exchanged for a planar one, which slides and turns on the floor."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..algorithms.floating_base import base_placement
from ..arrays import Array
from ..model import PER_DOF, FreeFlyer, Model, Planar, cast
from ..spatial import SE3

__all__ = ["PlanarBase"]

FLOOR_IN_FLYER = [3, 4, 2]
"""The entries of a base's twist (ω, v) that a planar joint leaves free: vx, vy, ωz."""


@dataclass(frozen=True, eq=False)
class PlanarBase:
    """A model with a floating base, and the same robot at a constant height and tilt.

    Body 1 of the planar model is placed by (x, y, heading) in the world's x-y plane; the base link sits on it, as
    high and as tilted as it was in the configuration that this was made from.

    Attributes
    ----------
    full, model : Model
    base : SE3
        Of the base link's frame in body 1's.
    near : ndarray, shape (7,)
        The floating base's entries of q then, for the sign of quaternions.
    """

    full: Model
    model: Model
    base: SE3
    near: Array

    @classmethod
    def of(cls, full: Model, q: Array) -> PlanarBase:
        """Exchange the floating base of a model."""
        q = q.astype(np.float64)
        near = q[full.q_slice[1]]
        T = base_placement(full, q)
        base = Planar().transform(_shadow(T)).inverse() @ T
        q1, v1 = full.q_slice[1], full.v_slice[1]
        per_dof: dict[str, Any] = {
            name: np.concatenate([(x := getattr(full, name))[v1][FLOOR_IN_FLYER], x[v1.stop :]]) for name in PER_DOF
        }
        small = replace(
            full,
            base="fixed",
            joints=(None, Planar(), *full.joints[2:]),
            placement=(full.placement[0], SE3.identity(), *(_on(base, p, T) for p, T in _rest(full))),
            inertia=(full.inertia[0], full.inertia[1].transform(base), *full.inertia[2:]),
            frames={name: replace(f, placement=_on(base, f.body, f.placement)) for name, f in full.frames.items()},
            lower=np.concatenate([full.lower[q1][:2], [-np.inf, -np.inf], full.lower[q1.stop :]]),
            upper=np.concatenate([full.upper[q1][:2], [np.inf, np.inf], full.upper[q1.stop :]]),
            postures={},
            **per_dof,
        )
        floor = cls(full, small, base, near)
        at_rest = np.zeros(full.nv)
        postures = {name: floor.reduce(posture, at_rest)[0] for name, posture in full.postures.items()}
        return replace(floor, model=replace(small, postures=postures))

    def reduce(self, q: Array, v: Array) -> tuple[Array, Array]:
        """Return the planar state below a floating one; its height, tilt and their rates are dropped."""
        base = cast(self.base, q.dtype)
        T = base_placement(self.full, q) @ base.inverse()
        twist = np.matvec(base.motion_transform(), v[..., :6])
        return (
            np.concatenate([_shadow(T), q[..., 7:]], axis=-1),
            np.concatenate([twist[..., FLOOR_IN_FLYER], v[..., 6:]], axis=-1),
        )

    def expand(self, q: Array, v: Array) -> tuple[Array, Array]:
        """Return the floating state of a planar one, at the constant height and tilt."""
        base = cast(self.base, q.dtype)
        T = cast(self.full.placement[1], q.dtype).inverse() @ Planar().transform(q[..., :4]) @ base
        flying = FreeFlyer().from_placement(T, np.broadcast_to(self.near.astype(q.dtype), (*q.shape[:-1], 7)))
        twist = np.matvec(base.inverse().motion_transform() @ Planar().subspace(q.dtype), v[..., :3])
        return np.concatenate([flying, q[..., 4:]], axis=-1), np.concatenate([twist, v[..., 3:]], axis=-1)


def _shadow(T: SE3) -> Array:
    """Return (x, y, cos, sin) of a placement seen from above; the heading is that of its x axis."""
    heading = T.rotation[..., :2, 0]
    size = np.sqrt((heading * heading).sum(axis=-1, keepdims=True))
    upright = np.abs(size) < 1e-6  # x points up or down: there is no heading
    north = np.stack([np.ones_like(size), np.zeros_like(size)], axis=-1)[..., 0, :]
    return np.concatenate([T.translation[..., :2], np.where(upright, north, heading / np.where(upright, 1, size))], -1)


def _rest(model: Model) -> list[tuple[int, SE3]]:
    """Return parent and placement of the joints outboard of the base."""
    return list(zip(model.parent[2:], model.placement[2:]))


def _on(base: SE3, body: int, T: SE3) -> SE3:
    return base @ T if body == 1 else T
