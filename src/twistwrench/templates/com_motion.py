"""The motion of the centre of mass and the inertia of the locked robot, which templates compute from a state."""

from __future__ import annotations

import numpy as np

from ..algorithms.kinematics import forward_kinematics
from ..arrays import Array, convert
from ..model import Model, composite_inertias, tree_terms
from ..spatial import skew

__all__ = ["com_acceleration", "force", "locked_inertia"]


def com_acceleration(model: Model, q: Array, v: Array, a: Array) -> Array:
    """Return p̈_G, the acceleration of the centre of mass, in the axes of the world, shape (..., 3).

    The mean over the bodies of c̈_i = R_i (a + ω × v + α × c + ω × (ω × c)): (α, a) is the spatial acceleration of
    body i, (ω, v) its twist and c its centre of mass, all in its own frame.
    """
    moving = forward_kinematics(model, q, v, a)
    if moving.twist is None or moving.acceleration is None:
        raise RuntimeError("v and a were given")
    mass = np.array([inertia.mass for inertia in model.inertia]).astype(q.dtype)
    c = np.stack([inertia.com for inertia in model.inertia]).astype(q.dtype)
    w, alpha = moving.twist[..., :3], moving.acceleration[..., :3]
    local = moving.acceleration[..., 3:] + np.cross(w, moving.twist[..., 3:] + np.cross(w, c)) + np.cross(alpha, c)
    R = np.stack([T.rotation for T in moving.placement], axis=-3)
    return np.asarray((mass[:, None] * np.matvec(R, local)).sum(axis=-2) / mass.sum())


def force(model: Model, p_ddot: Array) -> Array:
    """Return l̇_G = m p̈_G."""
    return np.asarray(convert(np.asarray(model.mass), p_ddot.dtype) * p_ddot)


def locked_inertia(model: Model, q: Array) -> Array:
    """Return the inertia about the centre of mass of the robot with its joints locked, in the base's axes, (..., 3, 3).

    Of the composite inertia at the base, I_O, m c and m: I_G = I_O + m [c]× [c]×.
    """
    composite = composite_inertias(tree_terms(model, q))[1]
    mass, mc = composite[..., 3, 3], composite[..., [2, 0, 1], [4, 5, 3]]  # m [c]× is the block at the top right
    C = skew(mc / mass[..., None])
    return np.asarray(composite[..., :3, :3] + mass[..., None, None] * C @ C)
