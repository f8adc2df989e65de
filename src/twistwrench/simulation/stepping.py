"""Time stepping: convex programmes on the velocities, step by step, for ground, friction and joint limits.

D. E. Stewart and J. C. Trinkle (1996) and M. Anitescu and F. A. Potra (1997): over a step, forces are impulses, and
what may not be is said of the velocity at its end, along which q goes:

    M v⁺ = M v* + Σ Jᵀ λ,    q⁺ = q ⊕ dt v⁺,    gap + dt u_n⁺ ≥ 0 at each point,

with Coulomb's law between λ and u⁺ (`cones`). So it does not matter when in the step a foot lands: a force that is
infinite is a finite impulse. v* is the velocity without contacts, by the midpoint rule; M and J are those of the
beginning. There is no spring, and nothing to tune. What it costs: order 1 in dt; what falls freely loses ½ m g² dt of
energy in a second, because q goes along the velocity at the end; what hits the ground is stopped where it hits within
one step more.

The gap is linear in v⁺ only to first order, so that a point may end below the ground, by O(dt²). Then q, and not v, is
moved by the least step in the metric of M that brings all points up to it: no speed comes of it. Loops, couplings and
rails are equations in the same programme (`held`), and are brought back to their anchors in the same step.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..contact import Contact
from ..contact.rows import per_contact
from ..fast import aba
from ..fast.steps import integrate
from ..model import Model
from .cones import Answer, Metric, Points, coulomb
from .divergence import refuse_divergence
from .ground import Ground, ground_terms, point_forces
from .held import Held, Rows
from .passive import Joints

__all__ = ["TimeStepping"]

PROJECTIONS = 5
BELOW = 1e-10
"""m or rad: nearer than this, what is below the ground is on it."""

ALIKE = 1e-6
"""So much, relative to the fastest, may the free velocity change by that in the middle without being asked again."""

APART = 1e-12
"""m: nearer than this, what holds is at its anchor."""

DEEPEST = 1e-3
"""m: a point that begins deeper below the ground is a mistake."""


class State(NamedTuple):
    """What a step needs of its beginning: M, that with damping and its metric, J and gaps of points, gaps of ranges."""

    M: Array
    damped: Array
    metric: Metric
    gap: Array
    J: Array
    ends: Array


class TimeStepping:
    """The steps of one motion.

    Parameters
    ----------
    model : Model
    contacts : sequence of Contact
        The points and soles that may touch.
    ground : Ground
    dt : float
    q : ndarray, shape (..., nq)
        At the start.
    held : sequence of Contact
        What holds in every step, from where it is at the start.

    Attributes
    ----------
    forces : list of ndarray, shape (..., k, 3)
        Of each step, at the k points in the axes of the ground, the normal last, N.
    slides : list of ndarray, shape (..., k)
        Of each step, how fast the points that touch slide at its end, m/s.
    pulls : list of ndarray, shape (..., m)
        Of each step λ of what holds, by its rows, N and N m.
    missed : list of ndarray, shape (...)
        Of each step, how far Coulomb's law was missed: the normal speed that a point that touches has too much, m/s.

    Raises
    ------
    ValueError
        If a point begins below the ground, or a joint beyond its range.
    """

    def __init__(
        self,
        model: Model,
        contacts: Sequence[Contact],
        ground: Ground,
        dt: float,
        q: Array,
        held: Sequence[Contact] = (),
    ) -> None:
        self.model, self.contacts, self.ground, self.dt = model, tuple(contacts), ground, dt
        self.mu = np.array([c.mu for c in self.contacts for _ in c.points])
        self.joints, self.held = Joints(model, q), Held.beginning(model, held, q)
        self.forces: list[Array] = []
        self.slides: list[Array] = []
        self.pulls: list[Array] = []
        self.missed: list[Array] = []
        self._slide = np.zeros((*q.shape[:-1], len(self.mu), 2))
        self._refuse_below(q)

    def step(self, tau: Array, q: Array, v: Array, since: float) -> tuple[Array, Array]:
        """Make one step of each item of a batch, under the joint forces τ, and return q and v at its end.

        `since` is the time since the start of the motion at which the step begins.
        """
        refuse_divergence(self.model, "v", v, dt=self.dt)
        q1, v1, batch = np.empty_like(q), np.empty_like(v), q.shape[:-1]
        force, missed = np.zeros((*batch, len(self.mu), 3)), np.zeros(batch)
        pull = np.zeros((*batch, sum(c.dim for c in self.held.contacts)))
        for item in np.ndindex(batch):
            held, end = self.held.at(item), since + self.dt
            found, pull[item] = self.one(tau[item].copy(), q[item].copy(), v[item].copy(), self._slide[item], held, end)
            self._slide[item], missed[item] = found.slide, found.missed
            force[item] = found.impulse / self.dt
            q1[item] = self.settle(integrate(self.model, q[item].copy(), self.dt * found.v), held, end)
            v1[item] = held.settle(q1[item], found.v, end) if held.contacts else found.v
        self.forces.append(force)
        self.slides.append(np.hypot(self._slide[..., 0], self._slide[..., 1]))
        self.pulls.append(pull)
        self.missed.append(missed)
        return q1, v1

    def one(self, tau: Array, q: Array, v: Array, slide: Array, held: Held, end: float) -> tuple[Answer, Array]:
        """Return the velocity at the end of a step, and λ of what holds.

        Once more, where the velocity in its middle makes a difference.
        """
        middle, at, mean, before = integrate(self.model, q, self.dt / 2 * v), self.terms(q), v, np.full_like(v, np.inf)
        for _ in range(2):
            free = v + self.dt * aba(self.model, middle, mean, tau)
            if np.abs(free - before).max(initial=0) <= ALIKE * np.abs(free).max(initial=0):
                break
            before, rows = free, held.moving(middle, mean, at.damped, self.dt, end) if held.contacts else None
            found, pull = self.solve(at, v, free, slide, rows)
            mean, slide = (v + found.v) / 2, found.slide
            refuse_divergence(self.model, "v", mean, dt=self.dt)
        refuse_divergence(self.model, "v dt", self.dt * found.v)
        return found, pull / self.dt

    def terms(self, q: Array) -> State:
        """Return what a step needs of its beginning."""
        terms = ground_terms(self.model, q, self.contacts, self.ground)
        damped = terms.M + self.dt * np.diag(self.model.damping)
        return State(terms.M, damped, Metric(self.model, damped), terms.place[:, 2], terms.rows, self.joints.gap(q))

    def solve(self, at: State, v: Array, free: Array, slide: Array, held: Rows | None) -> tuple[Answer, Array]:
        """Return the velocity at the end of the step, from v and that of the free motion, and the impulses."""
        gap, J, metric = at.gap, at.J, at.metric
        loose = free = metric.respond(at.M @ free)
        if held is not None:
            metric, free = Metric(self.model, at.damped, held.span), held.corrected(free)
        ends = -np.maximum(at.ends, 0) / self.dt
        hits = gap + self.dt * (J[:, 2] @ free) < 0
        share, bound = self.ground.restitution, -np.maximum(gap, 0) / self.dt
        while True:
            back = J[:, 2] @ (free - (1 + share) * v)  # as if it were hit where the step begins
            bounces = hits & (share > 0)
            points = Points(J, self.mu, np.where(bounces, np.maximum(bound, back), bound))

            def solved(free: Array, rows: Array, points: Points = points) -> tuple[Answer, Array]:
                others = np.concatenate([self.joints.rows, rows]), np.concatenate([ends, np.zeros(len(rows))])
                found = coulomb(metric, free, points, others, slide)
                return found, found.others[len(ends) :]

            found = self.joints.rubbed(metric, free, self.dt, solved)
            gained = (found.impulse * (J @ (found.v + free))).sum() / 2
            if gained <= 0 or share == 0:
                break
            share = share / 2 if share > 0.01 else 0.0  # Newton's law with friction would add energy here
        pull = np.zeros(0) if held is None else held.balance(at.damped @ (found.v - loose) - found.total)
        return found, pull

    def settle(self, q: Array, held: Held, end: float) -> Array:
        """Return the nearest configuration with no point below the ground and no joint beyond its range."""
        rows, span = None, None
        for _ in range(PROJECTIONS):
            terms = ground_terms(self.model, q, self.contacts, self.ground)
            gap, way = np.concatenate([terms.place[:, 2], self.joints.gap(q)]), np.zeros(self.model.nv)
            if held.contacts:
                rows = held.returning(q, end)
                way, span = rows.corrected(way), rows.span
            if gap.min(initial=0) >= -BELOW and (rows is None or np.abs(rows.u).max() <= APART):
                break
            G = np.concatenate([terms.rows[:, 2], self.joints.rows])
            q = integrate(self.model, q, Metric(self.model, terms.M, span).nearest(way, G, -gap)[0])
        if rows is not None:
            held.refuse_apart(rows)
        return q

    def contact_forces(self, q: Array) -> dict[str, Array]:
        """Return λ of all steps, by the contact's frame; q are the states in which they begin, (n, ..., nq)."""
        place = ground_terms(self.model, q, self.contacts, self.ground).place
        force = np.array(self.forces[: len(q)]).reshape(place.shape)
        pull = np.array(self.pulls[: len(q)]).reshape(*q.shape[:-1], sum(c.dim for c in self.held.contacts))
        return point_forces(self.contacts, place, force, self.ground) | per_contact(self.held.contacts, pull)

    def _refuse_below(self, q: Array) -> None:
        height = ground_terms(self.model, q, self.contacts, self.ground).place[..., 2]
        gap = height.min(axis=tuple(range(q.ndim - 1)), initial=np.inf)
        if gap.min(initial=0) < -DEEPEST:
            names = [name for c in self.contacts for name in c.point_names]
            raise ValueError(
                f"q: {names[int(gap.argmin())]} begins {-gap.min():.3g} m below the ground; "
                "raise the base, or lower the ground"
            )
