"""Steps on the configuration manifold: what the exponential does to rates and to momenta (49.2, 49.3).

The configurations of a tree are a Lie group, the product of its joints' groups, and v is the body velocity: q̇ = q v.
Around a configuration q₀ every other one is q₀ ⊕ u = q₀ exp(u), with u a vector of nv numbers that can be added. While
q₀ ⊕ u moves with the velocity v, u does not move with v but with u̇ = dexp⁻¹₋ᵤ v. The two differ for balls and
floating bases, and are equal for joints that turn about one axis only.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array, resolution
from ..compiler.quantities import Quantity
from ..fast.programs import remembered
from ..model import Model
from ..spatial import cross_motion
from .divergence import DivergenceError

__all__ = ["bracket", "dexp_inverse", "dexp_transposed", "exp_transposed", "rate"]

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


def dexp_inverse(ad: Array, v: Array) -> Array:
    """Return u̇ = dexp⁻¹₋ᵤ v = v + ½ [u, v] + 1/12 [u, [u, v]] + O(u⁴ v): what methods up to order 4 need."""
    first = np.matvec(ad, v)
    rate: Array = v + first / 2 + np.matvec(ad, first) / 12
    return rate


def rate(model: Model, u: Array, v: Array) -> Array:
    """Return u̇ of a q₀ ⊕ u that moves with v, by a program: `dexp_inverse` of `bracket`."""

    def asked() -> list[Quantity]:
        return [Quantity("rate", ("v", "a"), lambda u, v: (dexp_inverse(bracket(model, u), v), []))]

    found: Array = remembered(model, ("rate", v.dtype), v.dtype, asked, single=True)(u, v)
    return found


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
