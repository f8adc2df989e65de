"""Coulomb's law for one step: which points stick, slide or stay open, and the impulses that let them.

A point with the normal velocity u_n and the velocity u_t along the ground bears impulses λ with |λ_t| ≤ μ λ_n. Coulomb:

    u_n ≥ c,    λ_n ≥ 0,    (u_n − c) λ_n = 0,    and where it slides, λ_t = −μ λ_n u_t / |u_t|.

Over a step velocities and impulses are linear in each other, u = u₀ + W λ with W = J M⁻¹ Jᵀ, so that the law is a linear
system once it is known which point does what: what sticks has u = c, what is open has λ = 0, and what slides has the
equation above, which Newton's method makes linear (P. Alart and A. Curnier, 1991). Its answer shows what was wrong in
the guess. Where the guesses go round in circles, the points are asked one after the other, each with the law exact
while the others push as they do, as often as it takes (M. Jean, The non-smooth contact dynamics method, 1999), and from
there the cases are tried again.

Only points that sink without an impulse take part, and those that would sink by the impulses of the others: so nothing
is pushed that no motion brings to the ground, even where a large μ knows a second answer (P. Painlevé, 1895).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..arrays import Array

__all__ = ["CASES", "OPEN", "SLIDES", "STICKS", "Law", "solved"]

OPEN, STICKS, SLIDES = 0, 1, 2

CASES = 30
"""So many guesses at most which point does what; a robot that stands takes one."""

ROUNDS, SWEEPS = 25, 8
"""So many times at most the cases are tried again, each time after so many sweeps over all points."""

SETTLED, ENOUGH = 1e-9, 1e-7
"""How far the law may be missed, relative to the fastest point: what is looked for, and what is taken in the end."""

RANK = 1e-12
"""What is smaller, relative to the largest singular value of W, is zero: four corners bear what three could."""

EIGHTHS = 2 * np.pi * np.arange(8) / 8
"""rad, of a turn."""

ONE_BY_ONE = 10
"""From this guess on, only what contradicts its guess the most changes: all at once may go round in circles."""


@dataclass
class Law:
    """The points and rows of a step: u₀ and W, of the k points (t, t, n) one after the other, then of the rows.

    u₀ is relative to what bounds it: the velocity of the ground along it, and c. A row is a point with a normal only.
    """

    W: Array
    u0: Array
    mu: Array

    def __post_init__(self) -> None:
        self.k = len(self.mu)
        self.m = len(self.u0) - 3 * self.k
        d = np.diagonal(self.W)
        own = d[: 3 * self.k].reshape(-1, 3).mean(axis=-1)
        least = 1e-14 * d.max(initial=0) + np.finfo(float).tiny
        self.own, self.own_rows = np.maximum(own, least), np.maximum(d[3 * self.k :], least)

    def moves(self, impulse: Array) -> Array:
        """Return u."""
        u: Array = self.u0 + self.W @ impulse
        return u

    def missed(self, impulse: Array, u: Array) -> Array:
        """Return how far the law is missed by each point, then each row, m/s: 0 where it is fulfilled.

        It is the difference of λ to what the law makes of λ − u / w, where w is W of the point alone, times w.
        """
        k, n = self.k, 3 * self.k
        L, U, w = impulse[:n].reshape(k, 3), u[:n].reshape(k, 3), self.own
        normal = np.maximum(0, L[:, 2] - U[:, 2] / w)
        along = L[:, :2] - U[:, :2] / w[:, None]
        size = np.sqrt((along * along).sum(axis=-1))
        most = self.mu * normal
        along = along * np.where(size > most, most / np.where(size > 0, size, 1), 1)[:, None]
        off = np.sqrt(((L[:, :2] - along) ** 2).sum(axis=-1) + (L[:, 2] - normal) ** 2)
        rows = np.maximum(0, impulse[n:] - u[n:] / self.own_rows)
        return np.concatenate([w * off, self.own_rows * np.abs(impulse[n:] - rows)])


class Guess(NamedTuple):
    """Which point does what (k,), the unit directions in which they slide (k, 2), and which rows push (m,)."""

    kind: Array
    way: Array
    rows: Array


def solved(law: Law, guesses: Sequence[Guess], size: float) -> tuple[Array, Array]:
    """Return the impulses and how far each point and row misses the law; `size` is the speed of the fastest."""
    impulse, best, missed = np.zeros(len(law.u0)), np.zeros(len(law.u0)), np.full(1, np.inf)
    for guess in guesses:
        one = by_cases(law, guess, impulse, SETTLED * size)
        off = law.missed(one, law.moves(one))
        if off.max() < missed.max():
            best, missed = one, off
        if missed.max() <= SETTLED * size:
            break
    for _ in range(ROUNDS):
        if missed.max() <= ENOUGH * size:
            break
        impulse = swept(law, impulse)
        for one in (impulse, by_cases(law, guess_of(law, impulse, SETTLED * size), impulse, SETTLED * size)):
            off = law.missed(one, law.moves(one))
            if off.max() < missed.max():
                best, missed = one, off
    return best, missed


def guess_of(law: Law, impulse: Array, still: float) -> Guess:
    """Return what points and rows do under these impulses; `still` is a speed that counts as none."""
    k = law.k
    L, U = (x[: 3 * k].reshape(k, 3) for x in (impulse, law.moves(impulse)))
    speed = np.sqrt((U[:, :2] ** 2).sum(axis=-1))
    full = np.sqrt((L[:, :2] ** 2).sum(axis=-1)) >= law.mu * L[:, 2] * (1 - 1e-6)
    kind = np.where(L[:, 2] <= 0, OPEN, np.where(full, SLIDES, STICKS))
    way = np.where(speed[:, None] > still, U[:, :2], -L[:, :2])
    return Guess(kind, unit(way), impulse[3 * k :] > 0)


def unit(way: Array) -> Array:
    """Return directions of length 1, and (1, 0) for none."""
    size = np.sqrt((way * way).sum(axis=-1, keepdims=True))
    return np.where(size > 0, way / np.where(size > 0, size, 1), [1.0, 0.0])


def by_cases(law: Law, guess: Guess, impulse: Array, still: float) -> Array:
    """Return the impulses of the first guess that its own answer does not contradict, or of the last.

    Where there are many answers, as of four corners that stick, it is the one nearest to the impulses before.
    """
    k, n, mu = law.k, 3 * law.k, law.mu
    kind, way, on = guess.kind.copy(), guess.way.copy(), guess.rows.copy()
    kind[(kind == STICKS) & (mu == 0)] = SLIDES
    curl, jams = np.zeros(k), np.zeros(k, bool)
    for made in range(CASES):
        takes = np.concatenate([np.repeat(kind > OPEN, 3), on])
        at = np.flatnonzero(takes)
        A, b = law.W[np.ix_(at, at)], -law.u0[at]
        slides = np.flatnonzero(kind == SLIDES)
        for i, a in zip(slides, np.searchsorted(at, 3 * slides)):
            d, w = way[i], law.own[i]
            P = curl[i] * np.array([[d[1] * d[1], -d[0] * d[1]], [-d[0] * d[1], d[0] * d[0]]])
            A[a : a + 2], b[a : a + 2] = P @ A[a : a + 2], P @ b[a : a + 2]
            A[a, a] += w
            A[a + 1, a + 1] += w
            A[a : a + 2, a + 2] += w * mu[i] * d
        near, impulse = within(law, impulse)[at], np.zeros(len(law.u0))
        impulse[at] = near + np.linalg.lstsq(A, b - A @ near, rcond=RANK)[0] if len(at) else b
        u = law.moves(impulse)
        L, U = impulse[:n].reshape(k, 3), u[:n].reshape(k, 3)
        speed, friction = np.sqrt((U[:, :2] ** 2).sum(axis=-1)), np.sqrt((L[:, :2] ** 2).sum(axis=-1))
        pulls, slow = law.own * L[:, 2], (U[:, :2] * way).sum(axis=-1)
        wrong = np.zeros(k + law.m)  # by how much each contradicts its guess, m/s
        wrong[:k] = np.where(kind == OPEN, -U[:, 2], -pulls)
        wrong[:k] = np.maximum(wrong[:k], np.where(kind == STICKS, law.own * (friction - mu * L[:, 2]), 0))
        wrong[:k] = np.maximum(wrong[:k], np.where((kind == SLIDES) & (mu > 0), -slow, 0))
        wrong[k:] = np.where(on, -law.own_rows * impulse[n:], -u[n:])
        apart = np.where(kind > OPEN, U[:, 2], 0)  # above 0 where not all that are closed can be met: one of them opens
        creeps = np.where(kind == STICKS, speed, 0)  # and here not all can stick
        wrong[:k] = np.maximum(wrong[:k], np.maximum(apart, creeps))
        changes = wrong > still / 2
        if made >= ONE_BY_ONE or max(apart.max(initial=0), creeps.max(initial=0)) > still / 2:
            changes &= np.arange(k + law.m) == wrong.argmax()
        new, new_on = kind.copy(), on ^ changes[k:]
        closes = changes[:k] & (kind == OPEN)
        opens = changes[:k] & (kind > OPEN) & ((L[:, 2] < 0) | (apart > np.maximum(creeps, still / 2)))
        turns = changes[:k] & ~closes & ~opens
        new[turns] = np.where(kind[turns] == STICKS, SLIDES, STICKS)
        new[opens] = OPEN
        jams |= opens & (kind == SLIDES) & (L[:, 2] < 0)  # and where it closes again, it may stick
        new[closes] = np.where(((speed[closes] > still) & ~jams[closes]) | (mu[closes] == 0), SLIDES, STICKS)
        slides, begins = new == SLIDES, (new == SLIDES) & (kind == STICKS) & (creeps <= still / 2)
        way[slides & (speed > still)] = unit(U[slides & (speed > still), :2])
        way[begins] = unit(-L[begins, :2])
        curl = np.minimum(law.own * mu * np.maximum(L[:, 2], 0) / np.maximum(speed, still), 1e9)
        curl[~slides | begins | closes | (speed <= still)] = 0.0
        if not changes.any() and law.missed(impulse, u).max(initial=0) <= still:
            break
        kind, on = new, new_on
    return within(law, impulse)


def within(law: Law, impulse: Array) -> Array:
    """Return the impulses without what pulls, or is outside its cone."""
    n = 3 * law.k
    kept = np.maximum(impulse, 0)
    L, K = impulse[:n].reshape(-1, 3), kept[:n].reshape(-1, 3)
    friction, most = np.sqrt((L[:, :2] ** 2).sum(axis=-1)), law.mu * K[:, 2]
    share = np.where(friction > most, most / np.where(friction > 0, friction, 1), 1.0)
    K[:, :2] = L[:, :2] * share[:, None]
    return kept


def swept(law: Law, impulse: Array) -> Array:
    """Return the impulses after some sweeps over the points and rows."""
    impulse, k = impulse.copy(), law.k
    for _ in range(SWEEPS):
        for i in range(k):
            s = slice(3 * i, 3 * i + 3)
            W = law.W[s, s]
            impulse[s] = of_one_point(W, law.u0[s] + law.W[s] @ impulse - W @ impulse[s], float(law.mu[i]), law.own[i])
        for j in range(3 * k, 3 * k + law.m):
            u = law.u0[j] + law.W[j] @ impulse
            impulse[j] = max(0.0, impulse[j] - u / law.own_rows[j - 3 * k])
    return impulse


def of_one_point(W: Array, u: Array, mu: float, own: float) -> Array:
    """Return the impulse at one point alone, which moves with u without it: of two answers the smaller one."""
    if u[2] >= 0 or W[2, 2] <= 1e-12 * own:
        return np.zeros(3)
    if mu == 0:
        return np.array([0.0, 0.0, -u[2] / W[2, 2]])
    sticks: Array = np.linalg.lstsq(W, -u, rcond=RANK)[0]
    if np.hypot(sticks[0], sticks[1]) <= mu * sticks[2]:
        return sticks

    # In the direction d = (cos, sin) it slides with λ_n = −u_n / push, and u_t is along d where off is 0: a polynomial of
    # degree 4 in cos + i sin, which has all such directions among its roots.
    def slides(angle: Array) -> tuple[Array, Array, Array]:
        """Return push, off, and push times how fast it slides along d."""
        d = np.stack([np.cos(angle), np.sin(angle)])
        push = W[2, 2] - mu * (W[2, :2] @ d)
        ahead = push * u[:2, None] - u[2] * (W[:2, 2:] - mu * (W[:2, :2] @ d))
        return push, d[0] * ahead[1] - d[1] * ahead[0], (d * ahead).sum(axis=0)

    series = np.fft.fft(slides(EIGHTHS)[1]) / len(EIGHTHS)
    found = np.roots([series[2], series[1], series[0], series[-1], series[-2]])
    angle = np.angle(found)
    push, _, ahead = slides(angle)
    fits = (push > 0) & (ahead >= 0) & (np.abs(np.abs(found) - 1) < 1e-3)
    if not fits.any():
        return within_one(sticks, mu)
    k = int(np.where(fits, push, 0).argmax())
    return np.array([-mu * np.cos(angle[k]), -mu * np.sin(angle[k]), 1.0]) * (-u[2] / push[k])


def within_one(impulse: Array, mu: float) -> Array:
    """Return the impulse at a point, or what its cone takes of it."""
    friction, most = float(np.hypot(impulse[0], impulse[1])), mu * max(0.0, float(impulse[2]))
    share = most / friction if friction > most else 1.0
    return np.array([share * impulse[0], share * impulse[1], max(0.0, float(impulse[2]))])
