"""The robot of the grid: one recipe with every dimension, so that any two can be at their ends at once."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from typing import NamedTuple

import numpy as np

from twistwrench.arrays import Array
from twistwrench.model import Builder, Model, Revolute
from twistwrench.spatial import SE3, SpatialInertia

__all__ = ["QUATERNION", "Recipe", "State"]

EARTH = np.array([0.0, 0.0, -9.81])
QUATERNION = slice(3, 7)
"""Where the base's quaternion stands in q."""

LINEAR = slice(3, 6)
"""Where the base's linear velocity stands in v."""


class State(NamedTuple):
    """The arguments of the algorithms: configuration, velocity, acceleration."""

    q: Array
    v: Array
    a: Array


@dataclass(frozen=True)
class Recipe:
    """A floating base with a chain of rods, or with all rods at the base; one number for each dimension.

    Attributes
    ----------
    bodies : int
        With the base.
    leaves : bool
        Whether every rod hangs at the base, and not at the rod before it.
    mass_ratio : float
        Mass of the last body over that of the first; between them it grows by a constant factor.
    distance : float
        Of the base from the origin, m.
    speed : float
        Of the joints and of the base, rad/s and m/s.
    base_speed : float
        By how much faster than that the base flies along, m/s; it does not turn faster.
    length, mass, time : float
        How many metres, kilograms and seconds stand for one: the same robot in other units.
    light : float
        Mass of the body in the middle, as a multiple of the usual one; at zero it has no inertia either.
    tip : float
        The same of the last body.
    rotor : float
        Inertia of every rotor over that of one rod.
    angle : float or None
        Of all joints, rad; random where None.
    parallel : float
        Angle between the axes of neighbouring joints, rad, which meet in one point where it is not 1.
    norm : float
        Of the base's quaternion before `Model.normalize`.
    off : float
        By how much it is off norm 1 after that.
    edge : float
        By how much the largest moment of a rod falls short of the sum of the others, as a part of it.
    """

    bodies: int = 7
    leaves: bool = False
    mass_ratio: float = 1.0
    distance: float = 1.0
    speed: float = 1.0
    base_speed: float = 1.0
    length: float = 1.0
    mass: float = 1.0
    time: float = 1.0
    light: float = 1.0
    tip: float = 1.0
    rotor: float = 0.0
    angle: float | None = None
    parallel: float = 1.0
    norm: float = 1.0
    off: float = 0.0
    edge: float = 0.1

    @property
    def changed(self) -> dict[str, float | bool | None]:
        """The values that are not the usual ones, by name."""
        return {f.name: getattr(self, f.name) for f in fields(self) if getattr(self, f.name) != f.default}

    @cached_property
    def model(self) -> Model:
        """The robot."""
        rods = [self._body(k) for k in range(self.bodies)]
        gravity = EARTH * self.length / self.time**2
        builder = Builder("extreme", base="floating", root="body_0000", root_inertia=rods[0], gravity=gravity)
        armature = self.rotor * self.mass * self.length**2 / 3
        for k in range(1, self.bodies):
            builder.link(
                f"body_{k:04}",
                parent="body_0000" if self.leaves else f"body_{k - 1:04}",
                joint=Revolute([0.0, np.cos(k % 2 * self.parallel), np.sin(k % 2 * self.parallel)]),
                placement=self._placement(k),
                inertia=rods[k],
                armature=armature,
            )
        return builder.build()

    @cached_property
    def state(self) -> State:
        """The state of the maps."""
        return self.drawn(0)

    def drawn(self, seed: int) -> State:
        """Draw a state, the same numbers for all recipes of as many bodies; v and a are exact in single precision."""
        rng, n = np.random.default_rng(seed), self.bodies - 1
        direction, quaternion = (x / np.sqrt((x * x).sum()) for x in (rng.standard_normal(3), rng.standard_normal(4)))
        angles = rng.uniform(-np.pi, np.pi, n).astype(np.float32).astype(np.float64)
        v, a = rng.standard_normal((2, n + 6)).astype(np.float32).astype(np.float64)
        if self.angle is not None:
            angles[:] = self.angle
        place = direction * self.distance * self.length
        q = self.model.normalize(np.concatenate([place, quaternion * self.norm, angles]))
        q[QUATERNION] *= 1 + self.off
        unit, flying = np.ones(n + 6), np.ones(n + 6)
        unit[LINEAR], flying[LINEAR] = self.length, self.base_speed
        return State(q, v * unit * self.speed * flying / self.time, a * unit / self.time**2)

    def _body(self, k: int) -> SpatialInertia:
        """Return the inertia of a rod along −z that is round but for `edge`, its centre a little off the line."""
        factor = (self.light if k == self.bodies // 2 else 1.0) * (self.tip if k == self.bodies - 1 else 1.0)
        mass = self.mass * self.mass_ratio ** (k / max(self.bodies - 1, 1)) * factor
        if mass == 0:
            return SpatialInertia.zero()
        x, y = 1.0, 0.1
        moments = mass * self.length**2 / 12 * np.array([x, (x + y) * (1 - self.edge), y])
        return SpatialInertia(mass, np.array([0.02, 0.01, -0.5]) * self.length, np.diag(moments))

    def _placement(self, k: int) -> SE3:
        """Return where joint k sits on its parent: at the end of the rod, at the base all around it."""
        if self.leaves:
            turn = 2 * np.pi * k / self.bodies
            return SE3(np.eye(3), np.array([np.cos(turn), np.sin(turn), 0.0]) * self.length / 2)
        meets = self.parallel != 1.0 and k % 2 == 0
        return SE3(np.eye(3), np.array([0.0, 0.0, 0.0 if meets else -1.0]) * self.length)
