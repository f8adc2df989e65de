"""Where the bodies and frames are, and how they move (49.1, 49.2, 49.6)."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..checks import Array
from ..errors import unknown_name
from .arithmetic import Arithmetic, take
from .bodies import Body, cross, walk

__all__ = [
    "Motion",
    "body_accelerations",
    "body_twists",
    "frame_bias_acceleration",
    "frame_jacobian",
    "frame_placement",
    "motion",
    "placements",
]

REFERENCES = ("local", "world", "local_world_aligned")


class Motion(NamedTuple):
    """How each body moves, in world axes, SI units. Each array is (nbodies, 3); row 0 is the world."""

    angular_velocity: Array
    velocity: Array
    angular_acceleration: Array
    acceleration: Array


def placements(model: Any, q: ArrayLike) -> tuple[Array, Array]:
    """Return every body's rotation and position in the world."""
    number, q, rest = take(model, q=q, v=None)
    bodies = walk(number, model, q, rest, rest)
    return np.stack([b.rotation for b in bodies]), np.stack([b.origin for b in bodies])


def motion(model: Any, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Motion:
    """Return how every body moves in the world."""
    number, q, v, a = take(model, q=q, v=v, a=a)
    rows = [(b.omega, b.velocity, b.alpha, b.acceleration) for b in walk(number, model, q, v, a)]
    return Motion(*(np.stack(column) for column in zip(*rows, strict=True)))


def body_twists(model: Any, q: ArrayLike, v: ArrayLike) -> Array:
    """Return every body's twist (ω, v) at its own frame's origin, in its own frame."""
    number, q, v, rest = take(model, q=q, v=v, a=None)
    bodies = walk(number, model, q, v, rest)
    return np.stack([_pair(b.rotation.T @ b.omega, b.rotation.T @ b.velocity) for b in bodies])


def body_accelerations(model: Any, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Array:
    """Return every body's spatial acceleration in its own frame, without gravity."""
    number, q, v, a = take(model, q=q, v=v, a=a)
    return np.stack([_pair(*_spatial(b, b.origin, b.rotation)) for b in walk(number, model, q, v, a)])


def frame_placement(model: Any, q: ArrayLike, frame: str) -> tuple[Array, Array]:
    """Return a frame's rotation and position in the world."""
    number, q, rest = take(model, q=q, v=None)
    _, R, p = _frame(number, model, walk(number, model, q, rest, rest), frame)
    return R, p


def frame_jacobian(model: Any, q: ArrayLike, frame: str, reference: str = "local") -> Array:
    """Return the matrix that takes v to a frame's twist, rows (ω, v)."""
    number, q, rest = take(model, q=q, v=None)
    body, R, p = _frame(number, model, walk(number, model, q, rest, rest), frame)
    point, axes = _seen_from(number, reference, R, p)
    turn, shift = body.jacobian(point)
    J = number.zeros(6, model.nv)
    J[:, body.index] = np.vstack([axes.T @ turn, axes.T @ shift])
    return J


def frame_bias_acceleration(
    model: Any, q: ArrayLike, v: ArrayLike, frame: str, reference: str = "local"
) -> Array:
    """Return J̇ v: a frame's acceleration where a = 0, without gravity."""
    number, q, v, rest = take(model, q=q, v=v, a=None)
    body, R, p = _frame(number, model, walk(number, model, q, v, rest), frame)
    point, axes = _seen_from(number, reference, R, p)
    if reference == "local_world_aligned":
        return _pair(body.alpha, _of_point(body, point)[1])
    return _pair(*_spatial(body, point, axes))


def _frame(number: Arithmetic, model: Any, bodies: list[Body], frame: str) -> tuple[Body, Array, Array]:
    """Return the body that carries a frame, and the frame's rotation and position in the world."""
    if frame not in model.frames:
        raise unknown_name("frame", frame, model.frames)
    carried = model.frames[frame]
    body, place = bodies[carried.body], carried.placement
    R = body.rotation @ number.rotation(place.rotation, frame)
    return body, R, body.origin + body.rotation @ number.array(place.translation)


def _seen_from(number: Arithmetic, reference: str, R: Array, p: Array) -> tuple[Array, Array]:
    """Return the point whose velocity is meant, and the axes in which it is written."""
    match reference:
        case "local":
            return p, R
        case "world":
            return number.zeros(3), number.array(np.eye(3))
        case "local_world_aligned":
            return p, number.array(np.eye(3))
    raise unknown_name("reference", reference, REFERENCES)


def _of_point(body: Body, point: Array) -> tuple[Array, Array]:
    """Return the velocity and the classical acceleration of the point of a body that is now at `point`."""
    r = point - body.origin
    velocity = body.velocity + cross(body.omega, r)
    return velocity, body.acceleration + cross(body.alpha, r) + cross(body.omega, cross(body.omega, r))


def _spatial(body: Body, point: Array, axes: Array) -> tuple[Array, Array]:
    """Return the spatial acceleration: the rate of the velocity found at a place that does not move along."""
    velocity, acceleration = _of_point(body, point)
    return axes.T @ body.alpha, axes.T @ (acceleration - cross(body.omega, velocity))


def _pair(first: Array, second: Array) -> Array:
    return np.concatenate([first, second])
