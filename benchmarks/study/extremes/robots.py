"""The robot of the grid: one recipe with every dimension, so that any two can be at their ends at once."""

from dataclasses import dataclass, fields
from functools import cached_property
from typing import NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench.arrays import Array

EARTH = np.array([0.0, 0.0, -9.81])
QUATERNION = slice(3, 7)  # of the base, in q
LINEAR = slice(3, 6)  # velocity of the base, in v


class State(NamedTuple):
    """The arguments of the algorithms: configuration, velocity, acceleration."""

    q: Array
    v: Array
    a: Array


@dataclass(frozen=True)
class Recipe:
    """A floating base with a chain of rods, or with all rods at the base; one number for each dimension."""

    bodies: int = 7  # with the base
    leaves: bool = False  # whether every rod hangs at the base, and not at the rod before it
    mass_ratio: float = 1.0  # of the last body to the first; between them it grows by a constant factor
    distance: float = 1.0  # of the base from the origin, m
    speed: float = 1.0  # of the joints and of the base, rad/s and m/s
    base_speed: float = 1.0  # by how much faster than that the base flies along, m/s; it does not turn faster
    length: float = 1.0  # metres that stand for one: the same robot in other units
    mass: float = 1.0  # kilograms that stand for one
    time: float = 1.0  # seconds that stand for one
    light: float = 1.0  # mass of the body in the middle, of the usual one; at zero it has no inertia either
    tip: float = 1.0  # the same of the last body
    rotor: float = 0.0  # inertia of every rotor over that of one rod
    angle: float | None = None  # of all joints, rad; random where None
    parallel: float = 1.0  # angle between the axes of neighbouring joints, rad, which meet where it is not 1
    norm: float = 1.0  # of the base's quaternion before `Model.normalize`
    off: float = 0.0  # by how much it is off norm 1 after that
    edge: float = 0.1  # by how much the largest moment of a rod falls short of the sum of the others, as a part of it

    def __str__(self) -> str:
        """Return in words which values are not the usual ones."""
        values = {name: x if isinstance(x, bool) else f"{x:g}" for name, x in self.changed.items()}
        return ", ".join(f"{name} {x}" for name, x in values.items()) or "usual"

    @property
    def changed(self) -> dict[str, float | bool | None]:
        """The values that are not the usual ones, by name."""
        return {f.name: getattr(self, f.name) for f in fields(self) if getattr(self, f.name) != f.default}

    @cached_property
    def model(self) -> tw.Model:
        """The robot."""
        rods = [self._body(k) for k in range(self.bodies)]
        gravity = EARTH * self.length / self.time**2
        builder = tw.Builder("extreme", base="floating", root="body_0000", root_inertia=rods[0], gravity=gravity)
        armature = self.rotor * self.mass * self.length**2 / 3
        for k in range(1, self.bodies):
            builder.link(
                f"body_{k:04}",
                parent="body_0000" if self.leaves else f"body_{k - 1:04}",
                joint=tw.Revolute([0.0, np.cos(k % 2 * self.parallel), np.sin(k % 2 * self.parallel)]),
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

    def _body(self, k: int) -> tw.SpatialInertia:
        """Return the inertia of a rod along −z that is round but for `edge`, its centre a little off the line."""
        factor = (self.light if k == self.bodies // 2 else 1.0) * (self.tip if k == self.bodies - 1 else 1.0)
        mass = self.mass * self.mass_ratio ** (k / max(self.bodies - 1, 1)) * factor
        if mass == 0:
            return tw.SpatialInertia.zero()
        x, y = 1.0, 0.1
        moments = mass * self.length**2 / 12 * np.array([x, (x + y) * (1 - self.edge), y])
        return tw.SpatialInertia(mass, np.array([0.02, 0.01, -0.5]) * self.length, np.diag(moments))

    def _placement(self, k: int) -> tw.SE3:
        """Return where joint k sits on its parent: at the end of the rod, at the base all around it."""
        if self.leaves:
            turn = 2 * np.pi * k / self.bodies
            return tw.SE3(np.eye(3), np.array([np.cos(turn), np.sin(turn), 0.0]) * self.length / 2)
        meets = self.parallel != 1.0 and k % 2 == 0
        return tw.SE3(np.eye(3), np.array([0.0, 0.0, 0.0 if meets else -1.0]) * self.length)
