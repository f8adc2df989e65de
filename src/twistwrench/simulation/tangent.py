"""Momenta over a step: what the exponential of the joints that turn does to them (49.2, 49.3).

Over a step that turns by φ, R = exp [φ]×. A momentum p that is seen from its beginning is Rᵀ p seen from its end, and
dexp_φ = 1 + ½ [φ]× + 1/6 [φ]×² + … says how exp φ moves with φ. For joints about one axis, and for what slides in axes
that stand still (`straight`), both are 1.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array
from ..fast.programs import remembered
from ..fast.quantities import Quantity
from ..model import GroupJoint, Model
from ..spatial import cross_motion
from ..spatial._quaternions import exp_quaternion
from ..spatial.exponential import shift
from ..spatial.rotation import quaternion_matrix
from .straight import watched

__all__ = ["bracket", "momenta"]


def bracket(model: Model, u: Array) -> Array:
    """Return the matrix ad_u with ad_u w = [u, w] on the whole tree, shape (..., nv, nv); 0 where joints commute.

    Of each joint the twists are S u and S w, and [u, w] is what S makes into S u × S w (49.5).
    """
    ad = np.zeros((*u.shape, model.nv), u.dtype)
    for joint, S, s in zip(model.joints, model.constants(u.dtype).S, model.v_slice):
        if joint is not None and joint.nv > 1:
            ad[..., s, s] = S.mT @ cross_motion(np.matvec(S, u[..., s])) @ S
    return ad


def momenta(model: Model, u: Array, p0: Array, impulse: Array) -> tuple[Array, Array]:
    """Return what μ must be in the middle of a step 2 u, and the momentum at its end, both (..., nv).

    P₀ = Rᵀ p₀ and P₁ = P₀ + impulse are seen from the middle; μ = ½ (dexp(−u)ᵀ P₀ + dexp(u)ᵀ P₁) and p₁ = Rᵀ P₁.
    What slides has its p₀ and its impulse in the axes of the beginning, and its p₁ in those of the end.
    """

    def both(u: Array, p0: Array, impulse: Array) -> tuple[Array, list[object]]:
        mu, end = p0 + impulse / 2, p0 + impulse
        for joint, s in zip(model.joints, model.v_slice):
            if isinstance(joint, GroupJoint) and joint.nv > 1:
                S = joint.subspace(u.dtype)
                turn, slide = S[:3], S[3:]
                phi = np.matvec(turn, u[..., s])
                back = quaternion_matrix(exp_quaternion(phi)).mT
                P0 = np.matvec(back, np.matvec(turn, p0[..., s]))
                P1 = P0 + np.matvec(turn, impulse[..., s])
                mean = (dexp_transposed(-phi, P0) + dexp_transposed(phi, P1)) / 2
                along = np.matvec(slide, mu[..., s]), np.matvec(back @ back, np.matvec(slide, end[..., s]))
                mu[..., s] = np.matvec(turn.mT, mean) + np.matvec(slide.mT, along[0])
                end[..., s] = np.matvec(turn.mT, np.matvec(back, P1)) + np.matvec(slide.mT, along[1])
        return np.concatenate([mu, end], axis=-1), watched(model, u)

    asked = Quantity("momenta", ("v", "a", "tau"), both)
    found = remembered(model, ("momenta", u.dtype), u.dtype, lambda: [asked], single=True)(u, p0, impulse)
    return found[..., : model.nv], found[..., model.nv :]


def dexp_transposed(phi: Array, p: Array) -> Array:
    """Return dexp_φᵀ p = Σ (−[φ]×)ᵏ p / (k + 1)!, shape (..., 3): the way of a velocity p that turns by −φ."""
    return shift(np.concatenate([-phi, p], axis=-1))
