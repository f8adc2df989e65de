"""What a motion asks for: of the ground, of the limits of the joints, and of the motors (49.9, 49.10)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..algorithms.centroidal import center_of_mass, centroidal_momentum_rate
from ..algorithms.floating_base import base_placement
from ..algorithms.kinematics import frame_jacobian, frame_placement
from ..algorithms.rnea import rnea
from ..arrays import Array
from ..contact.stance import inside
from ..errors import ModelError
from ..model import Model, check_model, floats_of
from .motion import Motion, check_motion

__all__ = ["GroundLoad", "Need", "ground", "limits_broken", "needs"]

MIN_LOAD_SHARE = 1e-6
"""Share of the weight above which the ground counts as loaded."""


@dataclass(frozen=True, eq=False)
class GroundLoad:
    """Forces and centre of pressure that a motion asks of the ground, from `ground`: n states, of which l load it.

    Attributes
    ----------
    wrench : ndarray, shape (n, 6)
        The total wrench of the ground, at the centre of mass, in the axes of the world, N m and N: ḣ_G less the weight.
    loaded : ndarray of bool, shape (n,)
        Whether the ground is pushed.
    friction : ndarray, shape (l,)
        Force along the ground over force across it: the coefficient of friction that the motion needs at least.
    center_of_pressure : ndarray, shape (l, 3)
        Where on the ground no moment along it is left, m.
    margin : ndarray, shape (l,)
        How deep the centre of pressure lies inside the polygon of the frames of the standing feet, m; negative
        outside. Of a robot on one foot, or two points, the polygon has no inside: compare with the size of its soles.
    """

    wrench: Array
    loaded: Array
    friction: Array
    center_of_pressure: Array
    margin: Array


def ground(model: Model, motion: Motion) -> GroundLoad:
    """Return what the ground must do for a motion.

    Necessary, not sufficient: neither the moment about the vertical is checked, nor whether the forces can be shared
    out among the feet, each inside its own friction cone.

    Parameters
    ----------
    model : Model
        Of the robot, with gravity along −z.
    motion : Motion

    Returns
    -------
    GroundLoad

    Raises
    ------
    ModelError
        If gravity does not pull along −z.
    ShapeError, ValueError, SingularError
        As `twistwrench.centroidal_momentum_rate`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> needed = ground(model, tw.motions.walk(model, samples=50))
    >>> bool(needed.loaded.all()), bool(needed.friction.max() < 0.25), bool(needed.margin.min() > 0.01)
    (True, True, True)
    """
    check_model(model)
    check_motion(motion)
    if not (model.gravity[2] < 0 and not model.gravity[:2].any()):
        raise ModelError(f"{model.name!r}: expected gravity along -z, got {model.gravity.tolist()}")
    wrench = centroidal_momentum_rate(model, motion.q, motion.v, motion.a)
    wrench[:, 3:] -= model.mass * model.gravity
    loaded = (wrench[:, 5] > MIN_LOAD_SHARE * model.mass * -model.gravity[2]) & motion.contacts.any(axis=1)
    n, f = wrench[loaded, :3], wrench[loaded, 3:]
    p_G = center_of_mass(model, motion.q[loaded])
    feet = np.stack([frame_placement(model, motion.q[loaded], foot).translation for foot in motion.feet], axis=1)
    stands = motion.contacts[loaded]
    level = np.where(stands, feet[..., 2], np.inf).min(axis=1)
    down = level - p_G[:, 2]
    c = p_G + np.stack([(down * f[:, 0] - n[:, 1]) / f[:, 2], (down * f[:, 1] + n[:, 0]) / f[:, 2], down], axis=1)
    friction = np.sqrt(f[:, 0] ** 2 + f[:, 1] ** 2) / f[:, 2]
    margin = [inside(corners[on, :2] - at[:2]) for corners, on, at in zip(feet, stands, c)]
    return GroundLoad(wrench, loaded, friction, c, np.array(margin))


def limits_broken(model: Model, motion: Motion) -> dict[str, tuple[float, float]]:
    """Return the joints that a motion takes outside their limits; empty where it keeps them all.

    A motion is made for the shape of a robot, without regard to its limits.

    Parameters
    ----------
    model : Model
    motion : Motion

    Returns
    -------
    dict of str to (float, float)
        By the joint's name: how far q goes outside its limits (rad or m; 0 where it does not), and the largest speed as
        a share of the velocity limit. A velocity limit of 0 means no limit.

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`, where the motion is another robot's.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> limits_broken(model, tw.motions.trot(model))
    {}
    """
    check_motion(motion)
    q, v = floats_of(model, motion.q, v=motion.v)
    outside = np.maximum(np.maximum(model.lower - q, q - model.upper), 0).max(axis=0)
    limit = np.where(model.velocity_limit > 0, model.velocity_limit, np.inf)
    share = (np.abs(v) / limit).max(axis=0)
    found = {}
    for name, joint, qs, vs in zip(model.joint_names, model.joints, model.q_slice, model.v_slice):
        if joint and (outside[qs].any() or share[vs].max() > 1):
            found[name] = (float(outside[qs].max()), float(share[vs].max()))
    return found


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
