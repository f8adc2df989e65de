"""The states of a robot whose centre of mass, base, feet and other joints follow given curves.

The square matrix J is the same at all three levels: its rows are the tasks (centre of mass, feet), its columns what
is free (the base's position, the joints of the legs). Orientation and the other joints are given.

    position      J δ = error, until it is zero (Newton)
    velocity      J v = ẋ
    acceleration  J a = ẍ − J̇ v
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..algorithms.centroidal import center_of_mass, centroidal_map, centroidal_momentum_rate
from ..algorithms.kinematics import Reference, frame_bias_acceleration, frame_jacobian, frame_placement
from ..arrays import Array
from ..errors import SingularError
from ..spatial import log3, skew
from .legs import Stand

__all__ = [
    "Goal",
    "body_rates",
    "follow",
    "free_columns",
    "nearer",
    "place",
    "solve",
    "targets",
    "tasks",
    "turn_base",
    "turning_jacobian",
]

REFERENCE: Reference = "local_world_aligned"

NEWTON_STEPS = 40
"""Of Newton's method, which needs about six."""
MAX_STEP_RAD = 0.4
"""Of them, rad: a longer one may bend a knee that is nearly straight the wrong way."""


class Goal(NamedTuple):
    """The tasks of a motion at n times. Each is a jet: value, rate and rate of the rate along the first axis.

    Attributes
    ----------
    com : ndarray, shape (3, n, 3)
        Of the centre of mass, in the world.
    turn : ndarray, shape (3, n, 3)
        φ: the base stands at R exp3(φ), R being its orientation in the standing posture.
    steps : ndarray, shape (3, n, legs, 3)
        How far each foot is from where it stands in the standing posture.
    joints : ndarray, shape (3, n, nv)
        How far the joints that belong to no leg are from there. Other entries are not looked at.
    """

    com: Array
    turn: Array
    steps: Array
    joints: Array


def follow(stand: Stand, goal: Goal) -> tuple[Array, Array, Array]:
    """Return q, v and a of the robot that follows `goal`.

    Raises
    ------
    SingularError
        If the legs are too short, or straight.
    """
    model = stand.model
    q = place(stand, goal)
    free = free_columns(stand)
    J = tasks(stand, q)
    rates = body_rates(goal.turn)

    def given(rate: Array, joints: Array) -> Array:
        out = joints.copy()
        out[..., :3], out[..., free] = rate, 0
        return out

    v, a = given(rates[0], goal.joints[1]), given(rates[1], goal.joints[2])
    v[..., free] = solve(stand, J[..., free], targets(stand, goal, 1) - np.matvec(J, v))
    bias = [
        centroidal_momentum_rate(model, q, v, np.zeros_like(v))[..., 3:] / model.mass,
        *(frame_bias_acceleration(model, q, v, leg.frame, REFERENCE)[..., leg.rows] for leg in stand.legs),
    ]
    missing = targets(stand, goal, 2) - np.concatenate(bias, axis=-1) - np.matvec(J, a)
    a[..., free] = solve(stand, J[..., free], missing)
    return q, v, a


def place(stand: Stand, goal: Goal) -> Array:
    """Return the q in which centre of mass and feet are where they should be: Newton's method, from standing.

    Raises
    ------
    SingularError
        If there is no such q near standing.
    """
    q = turn_base(stand, goal, np.broadcast_to(stand.q, (*goal.turn[0].shape[:-1], stand.model.nq)))
    left = 2
    for _ in range(NEWTON_STEPS):
        q, error = nearer(stand, goal, q)
        left -= int(error.max() < 1e-12 * max(1.0, stand.height))  # twice more: the imaginary part
        if not left:
            return q
    raise SingularError(
        f"{stand.model.name!r}: no posture near the standing one has its feet and its centre of mass where they should "
        f"be, at sample {int(error.argmax())}: off by {error.max():.2g} m; are the legs long enough?"
    )


def turn_base(stand: Stand, goal: Goal, q: Array) -> Array:
    """Return q with the base turned as it should be, and the joints that belong to no leg where they should be."""
    model = stand.model
    free = free_columns(stand)
    shift = goal.joints[0].copy()
    shift[..., :3], shift[..., free] = goal.turn[0], 0
    out = model.integrate(np.broadcast_to(stand.q, (*shift.shape[:-1], model.nq)).astype(shift.dtype), shift)
    kept = [0, 1, 2, *(entry for leg in stand.legs for entry in leg.entries)]
    out[..., kept] = q[..., kept]
    return out


def nearer(stand: Stand, goal: Goal, q: Array) -> tuple[Array, Array]:
    """Take one step of Newton's method from q; return where it leads, and how far off q itself was."""
    error = _missing(stand, q, goal)
    move = np.zeros((*error.shape[:-1], stand.model.nv), error.dtype)
    free = free_columns(stand)
    move[..., free] = solve(stand, tasks(stand, q)[..., free], error)
    far = np.abs(move.real).max(axis=-1, keepdims=True) / MAX_STEP_RAD
    return stand.model.integrate(q, move / np.maximum(far, 1)), np.abs(error.real).max(axis=-1)


def solve(stand: Stand, J: Array, wanted: Array) -> Array:
    """Return the x with J x = wanted, shape (..., n).

    Raises
    ------
    SingularError
        If there is no such x, as with a straight leg.
    """
    try:
        x = np.asarray(np.linalg.solve(J, wanted[..., None])[..., 0])
    except np.linalg.LinAlgError:
        x = np.full_like(wanted, np.nan)  # which is what a browser's NumPy gives instead of raising
    if not np.isfinite(x).all():
        raise SingularError(f"{stand.model.name!r}: a leg is straight, or otherwise cannot do what it should")
    return x


def free_columns(stand: Stand) -> list[int]:
    """Return the indices in v of the unknowns: the base's position, and the joints of the legs."""
    return [3, 4, 5, *(column for leg in stand.legs for column in leg.columns)]


def tasks(stand: Stand, q: Array) -> Array:
    """Return J: the velocities of centre of mass and feet are J v."""
    com = centroidal_map(stand.model, q)[..., 3:, :] / stand.model.mass
    feet = [frame_jacobian(stand.model, q, leg.frame, REFERENCE)[..., leg.rows, :] for leg in stand.legs]
    return np.concatenate([com, *feet], axis=-2)


def _missing(stand: Stand, q: Array, goal: Goal) -> Array:
    """Return how far centre of mass and feet are from where they should be, in the axes of the world."""
    out = [goal.com[0] - center_of_mass(stand.model, q)]
    for k, leg in enumerate(stand.legs):
        T = frame_placement(stand.model, q, leg.frame)
        if leg.has_sole:
            out.append(np.matvec(T.rotation, log3(T.rotation.mT @ leg.rotation)))
        out.append(leg.position + goal.steps[0][..., k, :] - T.translation)
    return np.concatenate(out, axis=-1)


def targets(stand: Stand, goal: Goal, order: int) -> Array:
    """Return the first (1) or second (2) derivative of what the tasks should be."""
    out = [goal.com[order]]
    for k, leg in enumerate(stand.legs):
        step = goal.steps[order][..., k, :]
        out += [np.zeros_like(step), step] if leg.has_sole else [step]
    return np.concatenate(out, axis=-1)


SERIES_TERMS = 14
"""Of the series: enough for turns of up to 3 rad."""
B = np.polynomial.Polynomial([(-1) ** k / math.factorial(2 * k + 2) for k in range(SERIES_TERMS)])
C = np.polynomial.Polynomial([(-1) ** k / math.factorial(2 * k + 3) for k in range(SERIES_TERMS)])


def turning_jacobian(phi: Array) -> Array:
    """Return J, which takes φ̇ to the angular velocity in the body's axes, shape (..., 3, 3)."""
    square = (phi * phi).sum(-1)[..., None, None]
    K = skew(phi)
    return np.asarray(np.eye(3) - B(square) * K + C(square) * K @ K)


def body_rates(jet: Array) -> Array:
    """Return ω and ω̇ in the body's axes from the jet of φ, shape (2, ..., 3)."""
    phi, rate, second = jet
    square = (phi * phi).sum(-1)[..., None]
    growth = 2 * (phi * rate).sum(-1)[..., None]
    first = np.cross(phi, rate)
    w_dot = (
        np.matvec(turning_jacobian(phi), second)
        - B.deriv()(square) * growth * first
        + C.deriv()(square) * growth * np.cross(phi, first)
        + C(square) * np.cross(rate, first)
    )
    return np.stack([np.matvec(turning_jacobian(phi), rate), w_dot])
