"""What a step lets touch, and in which metric: the velocity after it, and the impulses at the points and rows.

The law itself is in `coulomb`. Here it is asked of the points that the motion brings to the ground, and of no others.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..contact.decomposition import cholesky_factors
from ..contact.qp import LIMIT_RTOL, least_with_multipliers
from ..model import Model
from .coulomb import TARGET_RTOL, CoulombLaw, solve

__all__ = ["Metric", "Points", "StepSolution", "solve_contacts"]

JOIN_FACTOR = 10.0
"""Times the worst violation: rows that are so near take part in a programme from the start."""

HILDRETH_SWEEPS = 200


class Metric:
    """The metric in which velocities are near each other: kinetic energy, M = L Lᵀ.

    `held`, orthonormal columns in units of Lᵀ v, is what no impulse changes.
    """

    def __init__(self, model: Model, M: Array, held: Array | None = None) -> None:
        _, self.inverse = cholesky_factors(model, M)
        if held is not None:
            self.inverse = self.inverse - held @ (held.mT @ self.inverse)

    def respond(self, impulse: Array) -> Array:
        """Return M⁻¹ times an impulse."""
        change: Array = self.inverse.mT @ (self.inverse @ impulse)
        return change

    def nearest(self, v: Array, G: Array, c: Array) -> tuple[Array, Array]:
        """Return the velocity nearest to v with G v ≥ c, and the impulses u ≥ 0 along the rows that make it so.

        Rows that are far from being violated join only where the answer violates them.
        """
        u, b = np.zeros(len(c)), G @ v - c
        if (b >= 0).all():
            return v, u
        A = -(G @ self.inverse.mT)
        length = np.sqrt((A * A).sum(axis=-1))
        moves = length > 1e-12 * length.max()
        length[~moves] = 1.0
        A, b = A / length[:, None], b / length
        size = -float(b[moves].min(initial=0))
        joins = moves & (b < JOIN_FACTOR * size)
        while joins.any():
            multipliers = _multipliers(A[joins], b[joins], size)
            z = -(multipliers @ A[joins])
            late = moves & ~joins & (A @ z - b > LIMIT_RTOL * size)
            if not late.any():
                u[joins] = multipliers
                break
            joins |= late
        u /= length
        return v + self.respond(u @ G), u


def _multipliers(A: Array, b: Array, size: float) -> Array:
    """Return the multipliers of the least z with A z ≤ b.

    Where both solvers give up, Hildreth's method of 1957 has the last word: it always ends, with impulses that push and
    take energy out.
    """
    found = least_with_multipliers(A, b, size)
    return hildreth(A, b) if found is None else found[1]


def hildreth(A: Array, b: Array) -> Array:
    """Return multipliers u ≥ 0 of the least z = −Aᵀ u with A z ≤ b, after some sweeps over the rows, of length 1."""
    u, z = np.zeros(len(b)), np.zeros(A.shape[1])
    for _ in range(HILDRETH_SWEEPS):
        for k, row in enumerate(A):
            new = max(0.0, u[k] + row @ z - b[k])
            z, u[k] = z - (new - u[k]) * row, new
    return u


@dataclass
class Points:
    """The points that may touch, in a step: J (k, 3, nv) of their velocities, the normal last, and what bounds them."""

    J: Array
    mu: Array
    bound: Array
    """c, shape (k, 3): the velocity of the ground along it, and the least normal velocity after the step, m/s.

    It is −inf of what cannot touch.
    """


@dataclass
class StepSolution:
    """Solution of a step: v, the impulses at the points (k, 3), those of the other rows, the sliding."""

    v: Array
    way: Array
    """The velocity along which q goes: v, unless something bounces, which ends where it hits."""
    impulse: Array
    others: Array
    slide: Array
    """(k, 2), how the points that touch move along the ground, m/s; 0 of the others."""
    missed: Array
    """(k,), how far Coulomb's law was missed, m/s."""
    sinks: Array
    """(k,), how much faster than allowed a point goes down, m/s."""
    fastest: float
    """The speed of the fastest point or row without impulses, m/s."""
    total: Array
    """The generalized impulse of all of them, shape (nv,)."""


def solve_contacts(
    metric: Metric, v: Array, points: Points, others: tuple[Array, Array], before: Array
) -> StepSolution:
    """Return the velocity after the step, v being that of the free motion.

    `others` are rows G and bounds c of what else holds, G v ≥ c; `before` (k, 3) are the impulses of the step before.
    Only points that sink without an impulse take part, and those that would sink by the impulses of the others. So
    nothing is pushed that no motion brings to the ground, even where a large μ knows an answer with a force from afar.
    """
    J, k, (G, c) = points.J, len(points.mu), others
    every = J.reshape(3 * k, len(v))
    moves, more = every @ v, G @ v
    u = moves.reshape(k, 3) - points.bound
    rows = more - c
    fastest = float(max(np.abs(moves).max(initial=0), np.abs(more).max(initial=0)))
    impulse = np.zeros((k, 3))
    pushes = np.zeros(len(c))
    missed = np.zeros(k)
    least = -TARGET_RTOL * fastest
    after = v
    ends = u
    total = np.zeros_like(v)
    joins = u[:, 2] < 0
    joins_too = rows < 0
    if joins.any() or joins_too.any():
        joins |= (before[:, 2] > 0) & np.isfinite(points.bound[:, 2])
    while joins.any() or joins_too.any():
        at, too = np.flatnonzero(joins), np.flatnonzero(joins_too)
        A = np.concatenate([J[at].reshape(-1, len(v)), G[too]])
        Y = metric.inverse @ A.mT
        law = CoulombLaw(Y.mT @ Y, np.concatenate([u[at].ravel(), rows[too]]), points.mu[at])
        found, off = solve(law, np.concatenate([before[at].ravel(), pushes[too]]), fastest)
        impulse[at], pushes[too], missed[at] = found[: 3 * len(at)].reshape(-1, 3), found[3 * len(at) :], off[: len(at)]
        total = found @ A
        after = v + metric.inverse.mT @ (Y @ found)
        ends = (every @ after).reshape(k, 3) - points.bound
        late = (ends[:, 2] < least) & ~joins
        late_too = (G @ after - c < least) & ~joins_too
        if not late.any() and not late_too.any():
            break
        joins, joins_too = joins | late, joins_too | late_too
    slides = (impulse[:, 2] > 0) & (np.sqrt((ends[:, :2] ** 2).sum(axis=-1)) > -least)
    slide = np.where(slides[:, None], ends[:, :2], 0)
    sinks = np.maximum(0, -ends[:, 2])
    return StepSolution(after, after, impulse, pushes, slide, missed, sinks, fastest, total)
