"""Coulomb's law for one step: the impulses at the points that touch, of which some stick, some slide and some open.

A point with the normal velocity u_n and the velocity u_t along the ground bears impulses λ with |λ_t| ≤ μ λ_n. Coulomb:

    u_n ≥ c,    λ_n ≥ 0,    (u_n − c) λ_n = 0,    and where it slides, λ_t = −μ λ_n u_t / |u_t|.

Over a step velocities and impulses are linear in each other, u = u₀ + W λ with W = J M⁻¹ Jᵀ. P. Alart and A. Curnier
(1991) write the law as one equation, λ = P(λ − u / w) with any w > 0: P leaves 0 of what pulls, and of what pushes it
shortens the part along the ground to μ λ_n. Newton's method solves it: it knows which point sticks, slides or opens as
soon as it is near, and then the equation is linear, or nearly. Where all stick, as of a robot that stands, it is.

Where its steps lead nowhere, every point is first made soft by itself, which leaves one answer where a stiff body knows
many or none that is plain, and harder step by step. If that does not help either, the points are asked one after the
other, each with the law exact while the others push as they do (M. Jean, The non-smooth contact dynamics method, 1999).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Array

__all__ = ["TARGET_RTOL", "CoulombLaw", "solve"]

NEWTON_STEPS = 30
"""Of Newton's method, at most."""

STEP_SHARES = (1.0, 0.5, 0.25, 0.1, 0.03)
"""Of a step of Newton's that are tried."""

SOFTENING = (*10 ** np.linspace(1, -8, 28), 0.0)
"""What is added to W at each point, relative to its own."""

ROUNDS, SWEEPS = 10, 8
"""So many times at most Newton's method is tried again, each time after so many sweeps over all points."""

TARGET_RTOL = 1e-9
ACCEPTED_RTOL = 1e-7
"""How far the law may be missed, relative to the fastest point: what is looked for, and what is taken in the end."""

RANK_RTOL = 1e-12
"""What is smaller, relative to the largest singular value of W, is zero: four corners bear what three could."""

SAFE_SHARE = 1e-6
"""Of its own entry in W that a row must keep beside the others, so that W is inverted."""

EIGHTH_TURNS_RAD = 2 * np.pi * np.arange(8) / 8
"""rad, of a turn."""


@dataclass
class CoulombLaw:
    """The points and rows of a step: u₀ and W, of the k points (t, t, n) one after the other, then of the rows.

    u₀ is relative to what bounds it: the velocity of the ground along it, and c. A row is a point with a normal only.
    """

    W: Array
    u0: Array
    mu: Array
    inverse: Array | None = None
    """W⁻¹ where it is known: see `safe_inverse`."""

    @property
    def k(self) -> int:
        """The number of points."""
        return len(self.mu)

    @cached_property
    def own(self) -> Array:
        """Return w of each point: what its own impulse does to it, m/s over N s, shape (k,)."""
        own = np.diagonal(self.W)[: 3 * self.k].reshape(-1, 3).mean(axis=-1)
        return np.asarray(np.maximum(own, self._least))

    @cached_property
    def own_rows(self) -> Array:
        """Return w of each row, shape (m,)."""
        return np.asarray(np.maximum(np.diagonal(self.W)[3 * self.k :], self._least))

    @cached_property
    def _least(self) -> float:
        return float(1e-14 * np.diagonal(self.W).max(initial=0) + np.finfo(float).tiny)

    def moves(self, impulse: Array) -> Array:
        """Return u."""
        u: Array = self.u0 + self.W @ impulse
        return u

    def least(self, u: Array) -> Array:
        """Return the least x with W x nearest to u."""
        if self.inverse is not None:
            return self.inverse @ u
        found: Array = np.linalg.lstsq(self.W, u, rcond=RANK_RTOL)[0]
        return found

    def bears(self, impulse: Array) -> bool:
        """Return whether nothing of the impulses pulls, or is outside its cone."""
        n = 3 * self.k
        L = impulse[:n].reshape(-1, 3)
        along = L[:, :2]
        return bool(
            (impulse[n:] >= 0).all()
            and (L[:, 2] >= 0).all()
            and (np.sqrt((along * along).sum(axis=-1)) <= self.mu * L[:, 2]).all()
        )

    def missed(self, impulse: Array, u: Array) -> Array:
        """Return how far the law is missed by each point, then each row, m/s: 0 where it is fulfilled.

        It is the difference of λ to what the law makes of λ − u / w, where w is W of the point alone, times w.
        """
        k, n = self.k, 3 * self.k
        L = impulse[:n].reshape(k, 3)
        U = u[:n].reshape(k, 3)
        w = self.own
        normal = np.maximum(0, L[:, 2] - U[:, 2] / w)
        along = L[:, :2] - U[:, :2] / w[:, None]
        size = np.sqrt((along * along).sum(axis=-1))
        most = self.mu * normal
        along = along * np.where(size > most, most / np.where(size > 0, size, 1), 1)[:, None]
        off = np.sqrt(((L[:, :2] - along) ** 2).sum(axis=-1) + (L[:, 2] - normal) ** 2)
        rows = np.maximum(0, impulse[n:] - u[n:] / self.own_rows)
        return np.concatenate([w * off, self.own_rows * np.abs(impulse[n:] - rows)])


def solve(law: CoulombLaw, impulse: Array, size: float) -> tuple[Array, Array]:
    """Return the impulses and how far each point and row misses the law.

    `impulse` is what is tried first, as of the step before; `size` is the speed of the fastest.
    """
    nothing = np.zeros(len(impulse))
    if impulse.any():
        sticks, u = stuck(law, impulse)
        off = np.abs(u)
        if off.max() <= TARGET_RTOL * size and law.bears(sticks):
            n = 3 * law.k
            return sticks, np.concatenate([off[:n].reshape(-1, 3).max(axis=-1), off[n:]])
    best, missed = newton(law, impulse, TARGET_RTOL * size)
    if missed.max(initial=0) <= ACCEPTED_RTOL * size:
        return best, missed

    def holds(one: Array, off: Array) -> bool:
        """Return whether these impulses are good enough, and keep them if they are the best so far."""
        nonlocal best, missed
        if off.max(initial=0) < missed.max(initial=0):
            best, missed = one, off
        return bool(missed.max(initial=0) <= ACCEPTED_RTOL * size)

    if impulse.any() and holds(*newton(law, nothing, TARGET_RTOL * size)):
        return best, missed
    one = nothing
    own = np.concatenate([np.repeat(law.own, 3), law.own_rows])
    for share in SOFTENING:
        one, off = newton(CoulombLaw(law.W + share * np.diag(own), law.u0, law.mu), one, TARGET_RTOL * size)
    for _ in range(ROUNDS):
        if holds(one, off):
            break
        one, off = newton(law, sweep(law, one), TARGET_RTOL * size)
    return best, missed


def stuck(law: CoulombLaw, impulse: Array) -> tuple[Array, Array]:
    """Return the impulses with which every point sticks and every row is met, those nearest to others, and u."""
    impulse = impulse - law.least(law.moves(impulse))
    return impulse, law.moves(impulse)


def safe_inverse(W: Array) -> Array | None:
    """Return W⁻¹ where each row is safely independent of those before it; None elsewhere."""
    try:
        L = np.linalg.cholesky(W)
    except np.linalg.LinAlgError:
        return None
    own = np.diagonal(L)
    if not (own * own > SAFE_SHARE * np.diagonal(W)).all():
        return None
    Y = np.linalg.inv(L)
    return np.asarray(Y.mT @ Y)


def newton(law: CoulombLaw, impulse: Array, still: float) -> tuple[Array, Array]:
    """Return the impulses after steps of Newton's method for λ = P(λ − u / w), and how far they miss the law.

    P is what `missed` projects with. A step is shortened until it misses the law by less; where none does, it ends.
    """
    k = law.k
    n = 3 * law.k
    mu = law.mu
    w = law.own
    u = law.moves(impulse)
    every = np.concatenate([np.repeat(w, 3), law.own_rows])
    missed: Array | None = None  # which need not be known where the first step arrives
    for _ in range(NEWTON_STEPS):
        aim = impulse - u / every
        normal = aim[2:n:3]
        along = aim[:n].reshape(k, 3)[:, :2]
        size = np.sqrt((along * along).sum(axis=-1))
        at = np.flatnonzero(np.concatenate([np.repeat(normal > 0, 3), aim[n:] > 0]))
        A, b = law.W[np.ix_(at, at)], -law.u0[at]
        slides = np.flatnonzero((normal > 0) & (size > mu * normal))
        if len(slides):
            a = np.searchsorted(at, 3 * slides)
            plane = a[:, None] + np.arange(2)
            d = along[slides] / size[slides, None]
            turns = mu[slides] * normal[slides] / size[slides]
            own, push = w[slides, None, None], (w * mu)[slides, None]
            P = turns[:, None, None] * (np.eye(2) - d[:, :, None] * d[:, None, :])
            A[plane], b[plane] = P @ A[plane], np.matvec(P, b[plane])
            A[plane[:, :, None], plane[:, None, :]] += own * (np.eye(2) - P)
            A[plane, a[:, None] + 2] -= push * d
        goal = np.zeros(len(impulse))
        goal[at] = impulse[at] + np.linalg.lstsq(A, b - A @ impulse[at], rcond=RANK_RTOL)[0] if len(at) else b
        for share in STEP_SHARES:
            new = project(law, impulse + share * (goal - impulse))
            u_new = law.moves(new)
            off = law.missed(new, u_new)
            if off.max(initial=0) <= still:
                return new, off
            missed = law.missed(impulse, u) if missed is None else missed
            if off @ off < missed @ missed:
                break
        else:
            break
        impulse, u, missed = new, u_new, off
    return impulse, law.missed(impulse, u)


def project(law: CoulombLaw, impulse: Array) -> Array:
    """Return the impulses without what pulls, or is outside its cone."""
    n = 3 * law.k
    kept = np.maximum(impulse, 0)
    L, K = impulse[:n].reshape(-1, 3), kept[:n].reshape(-1, 3)
    friction = np.sqrt((L[:, :2] ** 2).sum(axis=-1))
    most = law.mu * K[:, 2]
    share = np.where(friction > most, most / np.where(friction > 0, friction, 1), 1.0)
    K[:, :2] = L[:, :2] * share[:, None]
    return kept


def sweep(law: CoulombLaw, impulse: Array) -> Array:
    """Return the impulses after some sweeps over the points and rows."""
    impulse = impulse.copy()
    k = law.k
    for _ in range(SWEEPS):
        for i in range(k):
            s = slice(3 * i, 3 * i + 3)
            W = law.W[s, s]
            impulse[s] = solve_point(W, law.u0[s] + law.W[s] @ impulse - W @ impulse[s], float(law.mu[i]), law.own[i])
        for j in range(3 * k, len(impulse)):
            u = law.u0[j] + law.W[j] @ impulse
            impulse[j] = max(0.0, impulse[j] - u / law.own_rows[j - 3 * k])
    return impulse


def solve_point(W: Array, u: Array, mu: float, own: float) -> Array:
    """Return the impulse at one point alone, which moves with u without it: of two answers the smaller one."""
    if u[2] >= 0 or W[2, 2] <= 1e-12 * own:
        return np.zeros(3)
    if mu == 0:
        return np.array([0.0, 0.0, -u[2] / W[2, 2]])
    sticks: Array = np.linalg.lstsq(W, -u, rcond=RANK_RTOL)[0]
    if np.hypot(sticks[0], sticks[1]) <= mu * sticks[2]:
        return sticks

    # In the direction d = (cos, sin) it slides with λ_n = −u_n / push, and u_t is along d where off is 0: a polynomial
    # of degree 4 in cos + i sin, which has all such directions among its roots.
    def slides(angle: Array) -> tuple[Array, Array, Array]:
        """Return push, off, and push times how fast it slides along d."""
        d = np.stack([np.cos(angle), np.sin(angle)])
        push = W[2, 2] - mu * (W[2, :2] @ d)
        ahead = push * u[:2, None] - u[2] * (W[:2, 2:] - mu * (W[:2, :2] @ d))
        return push, d[0] * ahead[1] - d[1] * ahead[0], (d * ahead).sum(axis=0)

    series = np.fft.fft(slides(EIGHTH_TURNS_RAD)[1]) / len(EIGHTH_TURNS_RAD)
    found = np.roots([series[2], series[1], series[0], series[-1], series[-2]])
    angle = np.angle(found)
    push, _, ahead = slides(angle)
    fits = (push > 0) & (ahead >= 0) & (np.abs(np.abs(found) - 1) < 1e-3)
    if not fits.any():
        return project_point(sticks, mu)
    k = int(np.where(fits, push, 0).argmax())
    alone: Array = np.array([-mu * np.cos(angle[k]), -mu * np.sin(angle[k]), 1.0]) * (-u[2] / push[k])
    return alone


def project_point(impulse: Array, mu: float) -> Array:
    """Return the impulse at a point, or what its cone takes of it."""
    friction = float(np.hypot(impulse[0], impulse[1]))
    most = mu * max(0.0, float(impulse[2]))
    share = most / friction if friction > most else 1.0
    return np.array([share * impulse[0], share * impulse[1], max(0.0, float(impulse[2]))])
