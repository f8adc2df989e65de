"""Every body in the world, by 3-D vectors: the pass over the tree that everything else here uses (49.1).

All vectors are in world axes and SI units. The pass goes from the world outwards: body λ carries body
i through joint i. The joint's frame is fixed in λ; the joint moves body i's frame in it. The numbers
(1) to (6) mark the coupling terms that the package's docstring lists.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Array
from .arithmetic import Arithmetic
from .joints import joint_columns, joint_pose
from .state import State

__all__ = ["Body", "Hinges", "bodies_in_world", "cross"]


def cross(a: Array, b: Array) -> Array:
    """Return a × b for vectors of shape (3,), or for columns of vectors, (3, n).

    Examples
    --------
    >>> cross(np.array([1.0, 0, 0]), np.array([0, 1.0, 0]))
    array([0., 0., 1.])
    """
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


@dataclass(frozen=True)
class Hinges:
    """The Jacobian columns of a body: the entries of v of all joints between it and the world.

    One column for each. At unit rate, column k turns all that is outboard of its joint with angular
    velocity ``turn[:, k]`` about the joint's origin, and shifts it by ``slide[:, k]``.
    """

    index: Array
    """(n,), the indices of the columns in v."""
    turn: Array
    """(3, n)."""
    slide: Array
    """(3, n)."""
    origin: Array
    """(3, n), the joint's origin, which is that of the body it moves."""
    velocity: Array
    """(3, n), of that origin."""
    omega: Array
    """(3, n), angular velocity of that body. `turn` and `slide` are fixed in it."""

    def jacobian(self, point: Array) -> tuple[Array, Array]:
        """Return ∂ω/∂v and ∂ṗ/∂v, each (3, n), for a point p of the body."""
        return self.turn, self.slide + cross(self.turn, point[:, None] - self.origin)  # (1)

    def jacobian_rate(self, point: Array, velocity: Array) -> tuple[Array, Array]:
        """Return the time derivatives of both; `velocity` is that of the point."""
        turn_rate, slide_rate = cross(self.omega, self.turn), cross(self.omega, self.slide)  # (4)
        arm, arm_rate = point[:, None] - self.origin, velocity[:, None] - self.velocity
        return turn_rate, slide_rate + cross(turn_rate, arm) + cross(self.turn, arm_rate)

    def extend(self, more: Hinges) -> Hinges:
        """Return these columns, followed by `more`."""
        pairs = zip(vars(self).values(), vars(more).values(), strict=True)
        return Hinges(*(np.concatenate(pair, axis=-1) for pair in pairs))


@dataclass(frozen=True)
class Body:
    """One body in the world: its placement, its motion, and its Jacobian columns."""

    rotation: Array
    """(3, 3), from its axes to the world's."""
    origin: Array
    """Its frame's origin, m."""
    velocity: Array
    acceleration: Array
    """Of the origin: the classical acceleration, d/dt of the velocity, m/s²."""
    omega: Array
    """Angular velocity ω, rad/s."""
    alpha: Array
    """Angular acceleration α, rad/s²."""
    mass: Any
    com: Array
    """Its centre of mass, m."""
    inertia: Array
    """(3, 3), about the centre of mass, kg m²."""
    hinges: Hinges

    def at(self, point: Array) -> tuple[Array, Array]:
        """Return velocity and classical acceleration of the body's own point that is now at `point`."""
        r = point - self.origin
        velocity = self.velocity + cross(self.omega, r)  # (1)
        acceleration = self.acceleration + cross(self.alpha, r) + cross(self.omega, cross(self.omega, r))  # (2)
        return velocity, acceleration


def bodies_in_world(state: State) -> list[Body]:
    """Place and move every body, from the world outwards. Body 0 is the world, at rest and without mass."""
    bodies = [_world(state.number)]
    for i in range(1, state.model.nbodies):
        bodies.append(_carried(state, i, bodies[state.model.parent[i]]))
    return bodies


def _carried(state: State, i: int, carrier: Body) -> Body:
    """Place and move body i on the body that carries it."""
    number, model = state.number, state.model
    joint, name, place, given = model.joints[i], model.joint_names[i], model.placement[i], model.inertia[i]
    q, v, a = state.q[model.q_slice[i]], state.v[model.v_slice[i]], state.a[model.v_slice[i]]

    # Where: the joint's frame in the carrier, the body's frame in the joint's.
    R_joint, p_joint = joint_pose(number, joint, q, name)
    joint_frame = carrier.rotation @ number.rotation(place.rotation, name)
    R = joint_frame @ R_joint
    p = carrier.origin + carrier.rotation @ number.array(place.translation) + joint_frame @ p_joint

    # How fast: the carrier's point at p, and on top of it the joint's own ω and u.
    turn, slide = (R @ columns for columns in joint_columns(number, joint, name))
    omega_joint, u = turn @ v, slide @ v
    under, under_rate = carrier.at(p)
    omega = carrier.omega + omega_joint
    velocity = under + u

    # The rate of that. `turn` and `slide` are fixed in body i, which turns with ω = ω_λ + ω_joint: (4)
    # gives ω × ω_joint and ω × u. And p wanders over the carrier with u, so that the carrier's point
    # under it keeps changing: that gives ω_λ × u once more, and makes (3) twice that.
    alpha = carrier.alpha + turn @ a + cross(carrier.omega, omega_joint)  # (4)
    coriolis = 2 * cross(carrier.omega, u)  # (3)
    acceleration = under_rate + slide @ a + coriolis + cross(omega_joint, u)  # (4)

    index = np.arange(model.nv)[model.v_slice[i]]
    here = [np.stack([x] * len(index), axis=-1) for x in (p, velocity, omega)]
    return Body(
        rotation=R,
        origin=p,
        velocity=velocity,
        acceleration=acceleration,
        omega=omega,
        alpha=alpha,
        mass=number.array(given.mass)[()],
        com=p + R @ number.array(given.com),
        inertia=R @ number.array(given.inertia_at_com) @ R.mT,
        hinges=carrier.hinges.extend(Hinges(index, turn, slide, *here)),
    )


def _world(number: Arithmetic) -> Body:
    rest, none = number.zeros(3), number.zeros(3, 0)
    hinges = Hinges(np.zeros(0, int), none, none, none, none, none)
    return Body(number.identity(), rest, rest, rest, rest, rest, rest[0], rest, number.zeros(3, 3), hinges)
