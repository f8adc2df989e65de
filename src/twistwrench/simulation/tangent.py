"""Steps on the configuration manifold: what the exponential does to momenta (49.2, 49.3).

The configurations of a tree are a Lie group, the product of its joints' groups, and v is the body velocity: q̇ = q v.
Around a configuration q₀ every other one is q₀ ⊕ u = q₀ exp(u), with u a vector of nv numbers that can be added. Where
no joint is a ball or a floating base, two steps commute, and all that is here is 1.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array, resolution
from ..model import Model
from ..spatial import cross_motion
from .divergence import DivergenceError

__all__ = ["bracket", "dexp_transposed", "exp_transposed"]

TERMS = 64
"""Enough of the series for a turn of 2π in one step, in every number type: (2π)⁶³/63! is 4e-38."""


def bracket(model: Model, u: Array) -> Array:
    """Return the matrix ad_u with ad_u w = [u, w] on the whole tree, shape (..., nv, nv); 0 where joints commute.

    Of each joint the twists are S u and S w, and [u, w] is what S makes into S u × S w (49.5).
    """
    ad = np.zeros((*u.shape, model.nv), u.dtype)
    for joint, S, s in zip(model.joints, model.constants(u.dtype).S, model.v_slice):
        if joint is not None and joint.nv > 1:
            ad[..., s, s] = S.mT @ cross_motion(np.matvec(S, u[..., s])) @ S
    return ad


def exp_transposed(ad: Array, p: Array) -> Array:
    """Return Ad(exp u)ᵀ p = Σ (ad_uᵀ)ᵏ p / k!: a momentum p seen from q ⊕ u, where it was seen from q."""
    return _series(ad.mT, p, 0)


def dexp_transposed(ad: Array, p: Array) -> Array:
    """Return dexpᵤᵀ p = Σ (ad_uᵀ)ᵏ p / (k + 1)!."""
    return _series(ad.mT, p, 1)


def _series(A: Array, p: Array, shift: int) -> Array:
    """Return Σ Aᵏ p / (k + shift)!, to the last digit."""
    total: Array = p
    term = p
    for k in range(1, TERMS):
        term = np.matvec(A, term) / (k + shift)
        total = total + term
        added, size = (np.abs(x).max(axis=-1, initial=0) for x in (term, total))
        if (added <= resolution(p.dtype) * size / 4).all():
            return total
    raise DivergenceError("a ball or a floating base turns by more than a whole turn in one step")
