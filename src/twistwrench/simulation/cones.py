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
from .coulomb import TARGET_RTOL, CoulombLaw, safe_inverse, solve

__all__ = ["Metric", "Points", "StepRows", "StepSolution", "solve_contacts"]

JOIN_FACTOR = 10.0
"""Times the worst violation: rows that are so near take part in a programme from the start."""

HILDRETH_SWEEPS = 200

AXES = np.arange(3)


class Metric:
    """The metric in which velocities are near each other: kinetic energy, M⁻¹ = Fᵀ F with the inverse F."""

    def __init__(self, inverse: Array) -> None:
        self.inverse = inverse

    @classmethod
    def beside(cls, model: Model, M: Array, held: Array) -> Metric:
        """Return the metric of what is free: `held`, orthonormal columns in units of Lᵀ v, no impulse changes."""
        _, inverse = cholesky_factors(model, M)
        return cls(inverse - held @ (held.mT @ inverse))

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

    Mostly all rows that are violated are met, and nothing pulls: that is a linear system, and proves itself. Where both
    solvers give up, Hildreth's method of 1957 has the last word: it always ends, with impulses that push and
    take energy out.
    """
    tight = b < 0
    inverse = safe_inverse(A[tight] @ A[tight].mT)
    if inverse is not None:
        u = np.zeros(len(b))
        u[tight] = -inverse @ b[tight]
        if (u >= 0).all() and (A @ (u @ A) + b >= -LIMIT_RTOL * size).all():
            return u
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
    """The points that may touch, in a step, with their axes (t, t, n): μ, and what bounds their velocities."""

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


class StepRows:
    """The rows of all points and of what else holds in a step, in a metric."""

    def __init__(self, metric: Metric, J: Array, G: Array) -> None:
        self.metric = metric
        self.k = len(J)
        self.A = np.concatenate([J.reshape(3 * self.k, J.shape[-1]), G])
        self._known: dict[bytes, tuple[Array, Array, Array, Array | None]] = {}

    def of(self, at: Array) -> tuple[Array, Array, Array, Array | None]:
        """Return A of some rows, Y = F Aᵀ, W and W⁻¹: what impulses along them do to the velocities along them."""
        key = at.tobytes()
        if key not in self._known:
            A = self.A[at]
            Y = self.metric.inverse @ A.mT
            W = Y.mT @ Y
            self._known[key] = A, Y, W, safe_inverse(W)
        return self._known[key]


def solve_contacts(rows: StepRows, v: Array, points: Points, least: Array, before: Array) -> StepSolution:
    """Return the velocity after the step, v being that of the free motion.

    `least` are bounds c of what else holds, G v ≥ c; `before` (k, 3) are the impulses of the step before.
    Only points that sink without an impulse take part, and those that would sink by the impulses of the others. So
    nothing is pushed that no motion brings to the ground, even where a large μ knows an answer with a force from afar.
    """
    k, A = rows.k, rows.A
    bound = np.concatenate([points.bound.ravel(), least])
    moves = A @ v
    u = moves - bound
    fastest = float(np.abs(moves).max(initial=0))
    impulse = np.zeros(len(bound))
    missed = np.zeros(k)
    sinks_by = -TARGET_RTOL * fastest
    after = v
    ends = u
    total = np.zeros_like(v)
    stops = np.concatenate([np.arange(2, 3 * k, 3), np.arange(3 * k, len(bound))])  # normals, and what else holds
    joins = u[stops] < 0
    if joins.any():
        joins[:k] |= (before[:, 2] > 0) & np.isfinite(points.bound[:, 2])
    while joins.any():
        near = np.flatnonzero(joins[:k])
        at = np.concatenate([(3 * near[:, None] + AXES).ravel(), 2 * k + np.flatnonzero(joins)[len(near) :]])
        A_at, Y, W, inverse = rows.of(at)
        law = CoulombLaw(W, u[at], points.mu[near], inverse)
        first = impulse[at]
        first[: 3 * len(near)] = before[near].ravel()
        found, off = solve(law, first, fastest)
        impulse[at], missed[near] = found, off[: len(near)]
        total = found @ A_at
        after = v + rows.metric.inverse.mT @ (Y @ found)
        ends = A @ after - bound
        late = (ends[stops] < sinks_by) & ~joins
        if not late.any():
            break
        joins = joins | late
    push = impulse[: 3 * k].reshape(k, 3)
    ends = ends[: 3 * k].reshape(k, 3)
    slides = (push[:, 2] > 0) & (np.sqrt((ends[:, :2] ** 2).sum(axis=-1)) > -sinks_by)
    slide = np.where(slides[:, None], ends[:, :2], 0)
    sinks = np.maximum(0, -ends[:, 2])
    return StepSolution(after, after, push, impulse[3 * k :], slide, missed, sinks, fastest, total)
