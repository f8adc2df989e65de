"""The ground, and the points of a robot that may touch it: how high they are, and how fast they move (49.9)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..arrays import Array, as_exactly, as_number
from ..contact import Contact, PointContact, SlidingContact
from ..fast.program import Results
from ..model import Model, readonly
from ..spatial.rotation import cross_matrix
from .programs import middle_of_step, placements_of

__all__ = ["Ground", "GroundPoints", "PointTerms", "check_ground", "point_forces"]

WORLD_UP = (0.0, 0.0, 1.0)

NORMAL_SPEED_RTOL = 1e-12
"""Relative to its size, so much of a velocity along the ground may be across it."""


@dataclass(frozen=True)
class Ground:
    """A plane that a robot can stand on, fall on and slide on: points x of the world with n · x = height.

    Parameters
    ----------
    height : float
        Of the plane above the world's origin, along its normal, m.
    normal : array_like, shape (3,), optional
        n, out of the ground, in the axes of the world; any length but 0.
    restitution : float, optional
        e, from 0 to 1: a point that hits the ground at the speed u leaves it with e u along the normal.

    Raises
    ------
    ValueError
        If `height` is not a finite number, `normal` not a direction, or `restitution` not from 0 to 1.

    Examples
    --------
    >>> import twistwrench as tw
    >>> slope = tw.Ground(normal=[0.0, np.sin(0.2), np.cos(0.2)])
    >>> slope.axes[2].round(3)
    array([0.   , 0.199, 0.98 ])
    """

    height: float = 0.0
    normal: tuple[float, float, float] = WORLD_UP
    restitution: float = 0.0

    def __post_init__(self) -> None:
        if not np.isfinite(as_number(self.height, "height")):
            raise ValueError(f"height: expected a finite number, got {self.height!r}")
        if not 0 <= as_number(self.restitution, "restitution") <= 1:
            raise ValueError(f"restitution: expected a number from 0 to 1, got {self.restitution!r}")
        n = as_exactly(self.normal, "normal", 3)
        if not n.any():
            raise ValueError("normal: expected a direction, got zero")
        n = n / np.abs(n).max()
        object.__setattr__(self, "height", float(self.height))
        object.__setattr__(self, "restitution", float(self.restitution))
        object.__setattr__(self, "normal", tuple((n / np.sqrt(n @ n)).tolist()))

    @cached_property
    def axes(self) -> Array:
        """Two directions along the ground and the normal, as rows in the axes of the world, shape (3, 3)."""
        n = np.array(self.normal)
        along = np.eye(3)[int(np.abs(n[:2]).argmin())]
        along = along - (along @ n) * n
        along /= np.sqrt(along @ along)
        return readonly(np.stack([along, np.cross(n, along), n]))


def check_ground(contacts: Sequence[Contact], ground: Ground) -> None:
    """Raise for what may touch and is not a point, a sole, a ball or a wheel, or does not go with this ground."""
    for c in contacts:
        if not c.pushes:
            continue
        if isinstance(c, SlidingContact) or c.acceleration:
            raise ValueError(
                f"contact {c.frame!r}: with ground=, expected points, soles, balls and wheels on a ground that is at "
                f"rest or moves along itself, got {c!r}"
            )
        normal = getattr(c, "normal", WORLD_UP)
        if normal != WORLD_UP and not np.allclose(normal, ground.normal, 0, 1e-12):
            raise ValueError(
                f"contact {c.frame!r}: its normal {normal} is not that of the ground, {ground.normal}; "
                "with ground= the ground's counts: leave it out"
            )
        turns = np.array(c.velocity[:-3])
        moves = np.array(c.velocity[-3:])
        if turns.any() or (moves.size and abs(moves @ ground.normal) > NORMAL_SPEED_RTOL * np.abs(moves).max()):
            raise ValueError(
                f"contact {c.frame!r}: velocity: expected one along the ground, without a turn, got {c.velocity}"
            )


class PointTerms(NamedTuple):
    """Terms at a configuration: M, `white` of `middle_of_step`, and of all points the place and the rows of J."""

    M: Array
    white: Array
    place: Array
    rows: Array


class GroundPoints:
    """The points of a robot that may touch a ground, in the axes of the ground.

    Its programs know the frames of the contacts and nothing else: neither μ nor the ground makes another one.

    Attributes
    ----------
    mu, restitution : ndarray, shape (k,)
        Of each point; e is the ground's, unless its contact has its own.
    velocity : ndarray, shape (k, 3)
        Of the ground there.
    upright : bool
        Whether the axes of the ground are those of the world.
    """

    def __init__(self, model: Model, contacts: Sequence[Contact], ground: Ground) -> None:
        self.model, self.ground = model, ground
        self.contacts = tuple(replace(c, normal=ground.normal) if hasattr(c, "normal") else c for c in contacts)  # type: ignore[type-var]
        self.frames = tuple(c.frame for c in contacts)
        self.owner = np.array([i for i, c in enumerate(contacts) for _ in c.points], int)
        self.thick = any(not isinstance(c, PointContact) for c in contacts)
        every = [contacts[i] for i in self.owner]
        self.mu = np.array([c.mu for c in every])
        self._normal = np.array(ground.normal)
        self.upright = bool((ground.axes == np.eye(3)).all())
        own = [c.restitution for c in every]
        self.restitution = np.array([ground.restitution if e is None else e for e in own], float)
        self.velocity = np.array([c.velocity[-3:] or (0, 0, 0) for c in every], float).reshape(-1, 3) @ ground.axes.mT

    def terms(self, q: Array) -> PointTerms:
        """Return what a step needs of q."""
        rest = np.zeros(self.model.nv)
        return self.terms_of(middle_of_step(self.model, self.frames, q, rest, rest, rest))

    def terms_of(self, found: Results) -> PointTerms:
        """Return what a step needs of what is known in its middle."""
        moves = found.rows[self.owner]
        rows = moves[:, 3:]
        place = found.frames[self.owner, :, 3]
        if self.thick:
            arms = self._arms(found.frames)
            rows = rows - cross_matrix(arms) @ moves[:, :3]
            place = place + arms
        if not self.upright:
            rows, place = self.ground.axes @ rows, place @ self.ground.axes.mT
        return PointTerms(found.M, found.white, place - [0.0, 0.0, self.ground.height], rows)

    def height(self, q: Array) -> Array:
        """Return how high the points are, shape (..., k)."""
        return self.height_of(placements_of(self.model, self.frames, q))

    def height_of(self, frames: Array) -> Array:
        """Return how high the points are where the frames are placed so, shape (..., k)."""
        there = frames[..., 3][..., self.owner, :]
        if self.thick:
            there = there + self._arms(frames)
        return np.asarray(there @ self._normal - self.ground.height)

    def _arms(self, frames: Array) -> Array:
        """Return the points from the origins of their frames, in the axes of the world."""
        return np.concatenate([c.arms(frames[..., i, :, :3]) for i, c in enumerate(self.contacts)], axis=-2)


def point_forces(contacts: Sequence[Contact], place: Array, force: Array, ground: Ground) -> dict[str, Array]:
    """Return λ by the contact's frame, in the axes of the world, of forces (..., k, 3) in those of the ground."""
    end = 0
    forces = {}
    for c in contacts:
        points = slice(end, end := end + len(c.points))
        f = force[..., points, :] @ ground.axes
        arm = (place[..., points, :] - place[..., points, :].mean(axis=-2, keepdims=True)) @ ground.axes
        moment = np.cross(arm, f).sum(axis=-2)
        forces[c.frame] = np.concatenate([moment, f.sum(axis=-2)], axis=-1)[..., c.rows]
    return forces
