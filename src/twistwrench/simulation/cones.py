"""Coulomb's law for one step: the impulses that let points neither sink, nor be pulled, nor slide without friction.

A point with the normal velocity u_n and the velocity u_t along the ground bears impulses λ with |λ_t| ≤ μ λ_n. Coulomb:

    u_n ≥ c,    λ_n ≥ 0,    (u_n − c) λ_n = 0,    and where it slides, λ_t = −μ λ_n u_t / |u_t|.

M. Anitescu (Optimization-based simulation of nonsmooth rigid multibody dynamics, 2006) relaxes this to a convex
programme: of all velocities with u_n − μ |u_t| ≥ c, the one nearest to the free motion in the metric of M. Its artefact
is known: a point that slides is lifted off at μ |u_t|. V. Acary and F. Cadoux (2011; the shift is De Saxcé's) take that
away again by a shift s, u_n − μ |u_t| ≥ c − s, and solve the programme again with s = μ |u_t| until s stays what it
was: that is Coulomb's law itself. In place of the cone is a pyramid inside it, with an edge against the sliding; where
the answer slides another way, it gets one more edge, against that (a cut, as in Kelley's method of 1960). So the
friction of a point that slides is that of the cone, and no force is outside it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..contact.decomposition import cholesky_factors
from ..contact.qp import FEASIBLE, least_with_multipliers
from ..model import Model

__all__ = ["Answer", "Metric", "Points", "coulomb"]

SIDES = 8
"""Edges of a pyramid."""

ROUNDS = 30
"""So many programmes at most in a step; one that sticks or flies takes one, one that slides on takes two or three."""

CALM = 8
"""From this programme on the shift goes only half the way: some would swing between two answers for ever."""

SETTLED = 1e-7
"""How much the shift may still change, relative to the fastest sliding."""

NEAR = 10.0
"""Times the worst violation: rows that are so near take part in a programme from the start."""

SWEEPS = 200


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
        joins = moves & (b < NEAR * size)
        while joins.any():
            multipliers = _multipliers(A[joins], b[joins], size)
            z = -(multipliers @ A[joins])
            late = moves & ~joins & (A @ z - b > FEASIBLE * size)
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
    for _ in range(SWEEPS):
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
    """c, shape (k,): the least normal velocity after the step, m/s."""


@dataclass
class Answer:
    """What a step's programme found: v, the impulses at the points (k, 3), those of the other rows, the sliding."""

    v: Array
    impulse: Array
    others: Array
    slide: Array
    """(k, 2), 0 where nothing touches, m/s."""
    missed: float
    """How far the normal velocity of a point that touches is from its bound: what is left of the artefact, m/s."""
    total: Array
    """The generalized impulse of all of them, shape (nv,)."""


def edges(mu: Array, slide: Array) -> Array:
    """Return the edges of the pyramids (k, sides, 3), the first of each against the direction in which it slides."""
    angle = np.arctan2(-slide[:, 1], -slide[:, 0])[:, None] + 2 * np.pi * np.arange(SIDES) / SIDES
    return np.stack([mu[:, None] * np.cos(angle), mu[:, None] * np.sin(angle), np.ones_like(angle)], axis=-1)


def coulomb(metric: Metric, v: Array, points: Points, others: tuple[Array, Array], slide: Array) -> Answer:
    """Return the velocity after the step, v being that of the free motion.

    `others` are rows G and bounds c of what else holds, G v ≥ c; `slide` (k, 2) is how the points slid before.
    """
    J, mu, bound, k = points.J, points.mu, points.bound, len(points.mu)
    free, size = J @ v, len(others[1])
    fastest = float(np.abs(free).max(initial=0))
    shift = mu * np.hypot(*slide.mT)
    rays = edges(mu, np.where(shift[:, None] > 0, slide, free[:, :2])).reshape(k * SIDES, 3)
    at = np.repeat(np.arange(k), SIDES)
    for made in range(ROUNDS):
        G = np.concatenate([others[0], np.matvec(J[at].mT, rays)])
        after, u = metric.nearest(v, G, np.concatenate([others[1], bound[at] - shift[at]]))
        impulse = np.zeros((k, 3))
        np.add.at(impulse, at, u[size:, None] * rays)
        moves = J @ after
        slide, touches = moves[:, :2], impulse[:, 2] > 0
        speed = np.hypot(*slide.mT)
        before, shift = shift, shift + (mu * speed - shift) * (1.0 if made < CALM else 0.5)
        missed = np.where(touches, np.abs(moves[:, 2] - bound), 0).max(initial=0)
        if not touches.any() or missed <= SETTLED * fastest:
            break
        slides = speed > SETTLED * fastest
        cut = np.flatnonzero(slides & (moves[:, 2] - mu * speed + before < bound - SETTLED * fastest))
        edge = np.ones((len(cut), 3))
        edge[:, :2] = -mu[cut, None] * slide[cut] / speed[cut, None]
        rays, at = np.concatenate([rays, edge]), np.concatenate([at, cut])
    slides = touches & (speed > SETTLED * fastest)
    return Answer(after, impulse, u[:size], np.where(slides[:, None], slide, 0), float(missed), u @ G)
