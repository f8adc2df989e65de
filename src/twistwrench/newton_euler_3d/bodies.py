"""Every body in the world, by 3-D vectors: the one walk over the tree that all else here needs (49.1).

Everything a `Body` holds is in world axes and SI units. The walk goes from each body to those it
carries. A joint frame is fixed in the carrying body; the joint moves the carried body's frame in it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..checks import Array
from ..errors import ModelError
from .arithmetic import Arithmetic

__all__ = ["Body", "cross", "walk"]


def cross(a: Array, b: Array) -> Array:
    """Return a × b for vectors of shape (3,) or columns of vectors, (3, n).

    Examples
    --------
    >>> cross(np.array([1.0, 0, 0]), np.array([0, 1.0, 0]))
    array([0., 0., 1.])
    """
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


@dataclass(frozen=True)
class Body:
    """One body in the world: where it is, how it moves, and which entries of v move it.

    The second half has one column for each entry of v that moves the body, all those of the joints
    between it and the world. A unit rate of column k turns everything beyond its joint with the
    angular velocity ``turn[:, k]`` about the joint's origin, and shifts it with ``slide[:, k]``.
    """

    rotation: Array
    """(3, 3), body axes to world axes."""
    origin: Array
    """Position of the body frame's origin, m; below its velocity and its classical acceleration."""
    velocity: Array
    acceleration: Array
    omega: Array
    """Angular velocity ω, rad/s; below its time derivative α."""
    alpha: Array
    mass: Any
    inertia: Array
    """(3, 3) about the centre of mass, in world axes, kg m²."""
    com: Array
    """Position of the centre of mass, m; below its velocity and its classical acceleration."""
    com_velocity: Array
    com_acceleration: Array

    index: Array
    """(n,), the entries of v that move this body."""
    turn: Array
    """(3, n), angular velocity per unit rate."""
    slide: Array
    """(3, n), velocity per unit rate, at the joint's origin."""
    hinge: Array
    """(3, n), the joint's origin: that of the body frame which it moves. Below its velocity."""
    hinge_velocity: Array
    hinge_omega: Array
    """(3, n), the angular velocity of the body which the joint moves: `turn` and `slide` are fixed in it."""

    def jacobian(self, point: Array) -> tuple[Array, Array]:
        """Return ∂ω/∂v and ∂ṗ/∂v, each (3, n), for a point p of this body."""
        return self.turn, self.slide + cross(self.turn, point[:, None] - self.hinge)  # lever arm

    def jacobian_rate(self, point: Array, point_velocity: Array) -> tuple[Array, Array]:
        """Return the time derivatives of both, the point moving with the body."""
        turn_rate = cross(self.hinge_omega, self.turn)
        slide_rate = cross(self.hinge_omega, self.slide)
        arm, arm_rate = point[:, None] - self.hinge, point_velocity[:, None] - self.hinge_velocity
        return turn_rate, slide_rate + cross(turn_rate, arm) + cross(self.turn, arm_rate)


def walk(number: Arithmetic, model: Any, q: Array, v: Array, a: Array) -> list[Body]:
    """Place and move every body, from the world outwards.

    Parameters
    ----------
    number : Arithmetic
    model : Model
    q, v, a : ndarray, shape (nq,), (nv,), (nv,)

    Returns
    -------
    list of Body
        Body 0 is the world, at rest and without mass.
    """
    bodies = [_world(number)]
    for i in range(1, model.nbodies):
        carrier, rates = bodies[model.parent[i]], model.v_slice[i]
        place, joint, name = model.placement[i], model.joints[i], model.joint_names[i]

        R_place = carrier.rotation @ number.rotation(place.rotation, name)
        R_joint, p_joint = joint_pose(number, joint, q[model.q_slice[i]], name)
        R = R_place @ R_joint
        r = carrier.rotation @ number.array(place.translation) + R_place @ p_joint
        p = carrier.origin + r

        turn, slide = (R @ columns for columns in joint_axes(number, joint, name))
        omega_joint, u = turn @ v[rates], slide @ v[rates]  # relative to the carrier
        omega = carrier.omega + omega_joint
        velocity = carrier.velocity + cross(carrier.omega, r) + u  # lever arm

        # The columns turn with this body: their rates add ω × to what the accelerations give.
        alpha = carrier.alpha + turn @ a[rates] + cross(carrier.omega, omega_joint)
        acceleration = (
            carrier.acceleration
            + cross(carrier.alpha, r)
            + cross(carrier.omega, cross(carrier.omega, r))  # centripetal
            + 2 * cross(carrier.omega, u)  # Coriolis
            + slide @ a[rates]
            + cross(omega_joint, u)  # u is fixed in a body that turns in the carrier
        )

        given = model.inertia[i]
        c = R @ number.array(given.com)
        here = np.arange(rates.start, rates.stop)
        bodies.append(
            Body(
                rotation=R,
                origin=p,
                velocity=velocity,
                acceleration=acceleration,
                omega=omega,
                alpha=alpha,
                mass=number.array(given.mass)[()],
                inertia=R @ number.array(given.inertia_at_com) @ R.T,
                com=p + c,
                com_velocity=velocity + cross(omega, c),
                com_acceleration=acceleration + cross(alpha, c) + cross(omega, cross(omega, c)),
                index=np.concatenate([carrier.index, here]),
                turn=np.hstack([carrier.turn, turn]),
                slide=np.hstack([carrier.slide, slide]),
                hinge=_repeat(carrier.hinge, p, len(here)),
                hinge_velocity=_repeat(carrier.hinge_velocity, velocity, len(here)),
                hinge_omega=_repeat(carrier.hinge_omega, omega, len(here)),
            )
        )
    return bodies


def joint_pose(number: Arithmetic, joint: Any, q: Array, name: str) -> tuple[Array, Array]:
    """Return the rotation and the position of the moved frame in the joint's frame."""
    one, none = number.array(np.eye(3)), number.zeros(3)
    match joint.kind:
        case "revolute":
            return _about(number.unit(joint.axis), number.cos(q[0]), number.sin(q[0])), none
        case "continuous":
            return _about(number.unit(joint.axis), *_direction(number, q, name)), none
        case "prismatic":
            return one, number.unit(joint.axis) * q[0]
        case "planar":
            p = np.append(q[:2], none[:1])
            return _about(one[2], *_direction(number, q[2:], name)), p
        case "spherical":
            return _quaternion(_direction(number, q, name)), none
        case "free_flyer":
            return _quaternion(_direction(number, q[3:], name)), q[:3]
    raise ModelError(f"joint {name!r}: unknown kind {joint.kind!r}")


def joint_axes(number: Arithmetic, joint: Any, name: str) -> tuple[Array, Array]:
    """Return the angular velocity and the velocity that unit rates give, each (3, nv), in the moved frame."""
    one, none = number.array(np.eye(3)), number.zeros(3, 3)
    match joint.kind:
        case "revolute" | "continuous":
            return number.unit(joint.axis)[:, None], none[:, :1]
        case "prismatic":
            return none[:, :1], number.unit(joint.axis)[:, None]
        case "planar":  # (vx, vy, ωz)
            return np.stack([none[0], none[0], one[2]], 1), np.stack([one[0], one[1], none[0]], 1)
        case "spherical":
            return one, none
        case "free_flyer":  # (ω, v)
            return np.hstack([one, none]), np.hstack([none, one])
    raise ModelError(f"joint {name!r}: unknown kind {joint.kind!r}")


def _about(axis: Array, c: Any, s: Any) -> Array:
    """Turn about a unit axis by the angle of cosine c and sine s (Rodrigues)."""
    x, y, z = axis
    tilted = axis[:, None] * axis
    across = np.array([[0 * x, -z, y], [z, 0 * x, -x], [-y, x, 0 * x]])
    return tilted + (np.eye(3, dtype=int) - tilted) * c + across * s


def _quaternion(xyzw: Array) -> Array:
    """Turn by a quaternion of norm 1."""
    x, y, z, w = xyzw
    return np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )


def _direction(number: Arithmetic, q: Array, name: str) -> Array:
    """Return a quaternion, or a (cos, sin), with the norm 1 that rounding took from it."""
    if not (q != 0).any():
        raise ValueError(f"q: the {'quaternion' if len(q) == 4 else '(cos, sin)'} of joint {name!r} is zero")
    return number.unit(q)


def _repeat(columns: Array, column: Array, times: int) -> Array:
    return np.hstack([columns, *[column[:, None]] * times])


def _world(number: Arithmetic) -> Body:
    rest, none = number.zeros(3), number.zeros(3, 0)
    one, empty = number.array(np.eye(3)), number.zeros(3, 3)
    index = np.zeros(0, int)
    return Body(one, rest, rest, rest, rest, rest, rest[0], empty, rest, rest, rest, index, *[none] * 5)
