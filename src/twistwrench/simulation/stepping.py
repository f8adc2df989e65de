"""Time stepping: the laws of contact on the velocities, step by step, for ground, friction and joint limits.

D. E. Stewart and J. C. Trinkle (1996) and M. Anitescu and F. A. Potra (1997): over a step, forces are impulses, and
what may not be is said of the velocity at its end, along which q goes:

    M v⁺ = M v* + Σ Jᵀ λ,    q⁺ = q ⊕ dt v⁺,    gap + dt u_n⁺ ≥ 0 at each point,

with Coulomb's law between λ and u⁺ (`coulomb`). So it does not matter when in the step a foot lands: a force that is
infinite is a finite impulse. v* is the velocity without contacts, by the midpoint rule. All of this stands in the axes
of the middle of the step, q ⊕ ½ dt v: M, J, the weight and the other forces; v is turned into them, and v⁺ out of them
(`straight`). There is no spring, and nothing to tune. What it costs: order 1 in dt; what falls freely loses ½ m g² dt
of energy in a second, because q goes along the velocity at the end; what hits the ground is stopped where it hits
within one step more.

The gap is linear in v⁺ only to second order, so that a point may end below the ground, by O(dt³), and by O(dt²) where
something hits. Then q, and not v, is moved by the least step in the metric of M that brings all points up to it: no
speed comes of it. Loops, couplings and rails are equations beside the law (`held`), and are brought back to their
anchors in the same step.

What a URDF says of its joints holds as well. A damping d is implicit: it acts at the velocity at the end of the step,
(M + dt D) v⁺ = M v* + …, and is stable however large it is. Dry friction is a force of at most f: what moves is braked
by f, what rests needs more than f to start. The end of a range is a row like that of a contact point: it pushes back,
and never pulls.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..contact import Contact
from ..contact.rows import per_contact
from ..fast import aba
from ..fast.program import Results
from ..model import Model
from .cones import Metric, Points, StepRows, StepSolution, solve_contacts
from .coulomb import TARGET_RTOL
from .divergence import DivergenceError, check_divergence
from .ground import Ground, GroundPoints, point_forces
from .held import Held, Rows
from .programs import arrive, middle_of_step
from .sticking import StepProgram, StickingStep, prepared_sticking
from .straight import turning

__all__ = ["Joints", "TimeStepping"]

MAX_PROJECTIONS = 5
GAP_ATOL = 1e-10
"""m or rad: nearer than this, what is below the ground is on it."""

FREE_VELOCITY_RTOL = 1e-12
"""So much, relative to the fastest, may the free velocity change by that in the middle without being asked again."""

ANCHOR_ATOL_M = 1e-12
"""m: nearer than this, what holds is at its anchor."""

MAX_START_DEPTH_M = 1e-3
"""m: a point that begins deeper below the ground is a mistake."""

MAX_SINK_SHARE = 0.05
"""So much, relative to the fastest, a point may be too fast on its way down; beyond, nothing can keep it up."""

MAX_STEADY_SPEED = 1e3
"""m/s or rad/s: what is faster does not stand, and is looked at more closely."""

RANGE_ATOL = 1e-9
"""rad or m: a joint that begins farther beyond its range is a mistake."""

MAX_FRICTION_ROUNDS = 20
"""So often at most the joints with friction are asked again in a step which of them slide, and which way."""


class StepTerms(NamedTuple):
    """Terms of a step: of its middle q, v, M, that with damping, all rows; J and places of points; the first gaps."""

    q: Array
    v: Array
    M: Array
    damped: Array
    every: StepRows
    J: Array
    place: Array
    gap: Array
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
    steps : int, optional
        How many steps are to be made, which decides whether a program is worth its making.

    Attributes
    ----------
    forces : list of ndarray, shape (..., k, 3)
        Of each step, at the k points in the axes of the ground, the normal last, N.
    places : list of ndarray, shape (..., k, 3)
        Where they act: the points in the middle of each step, in these axes, m.
    slides : list of ndarray, shape (..., k)
        Of each step, how fast the points that touch slide at its end, m/s.
    pulls : list of ndarray, shape (..., m)
        Of each step λ of what holds, by its rows, N and N m.
    missed : list of ndarray, shape (..., k)
        Of each step, how far each point missed Coulomb's law, m/s.
    fastest : list of ndarray, shape (...)
        Of each step, how fast the fastest point would be without a ground, m/s.

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
        steps: int = 0,
    ) -> None:
        self.model = model
        self.contacts = tuple(contacts)
        self.ground = ground
        self.dt = dt
        self.points = GroundPoints(model, self.contacts, ground)
        self.mu = self.points.mu
        self.joints = Joints(model, q)
        self.held = Held.beginning(model, held, q)
        self.forces: list[Array] = []
        self.places: list[Array] = []
        self.slides: list[Array] = []
        self.pulls: list[Array] = []
        self.missed: list[Array] = []
        self.fastest: list[Array] = []
        self._impulse = np.zeros((*q.shape[:-1], len(self.mu), 3))
        self._damping = self.dt * model.damping
        self._damped = bool(model.damping.any())
        self._check_start(q)
        self._standing = None if self._is_special() else prepared_sticking(model, self.points.contacts, steps)

    def _is_special(self) -> bool:
        """Return whether a robot that stands is moved by more than its joint forces and its contacts."""
        moves = self.points.restitution.any() or self.points.velocity.any() or self._damped
        return bool(moves or self.held.contacts or self.joints.friction.size or not self.contacts)

    def is_driven(self) -> bool:
        """Return whether what it touches or what holds it moves, and so puts energy in."""
        return bool(self.points.velocity.any()) or any(c.velocity or c.acceleration for c in self.held.contacts)

    def step(self, tau: Array, q: Array, v: Array, since: float) -> tuple[Array, Array]:
        """Make one step of each item of a batch, under the joint forces τ, and return q and v at its end.

        `since` is the time since the start of the motion at which the step begins.
        """
        check_divergence(self.model, "v", v, dt=self.dt)
        q1 = np.empty_like(q)
        v1 = np.empty_like(v)
        batch = q.shape[:-1]
        k = len(self.mu)
        force, place, slide, missed = (np.zeros((*batch, k, *size)) for size in ((3,), (3,), (), ()))
        pull = np.zeros((*batch, sum(c.dim for c in self.held.contacts)))
        fastest = np.zeros(batch)
        for item in np.ndindex(batch):
            q0 = q[item].copy()
            v0 = v[item].copy()
            program = self.model._programs.get(self._standing)
            stuck = program and self.stand(program, tau[item], q0, v0, self._impulse[item])
            if stuck:
                x, q1[item], v1[item], missed[item], fastest[item] = stuck
                self._impulse[item] = x.points[5]
                force[item] = x.points[5] / self.dt
                place[item] = x.place - [0.0, 0.0, self.ground.height]
                continue
            held = self.held.at(item)
            end = since + self.dt
            found, pull[item], place[item] = self.one(tau[item].copy(), q0, v0, self._impulse[item], held, end)
            self._impulse[item], missed[item], fastest[item] = found.impulse, found.missed, found.fastest
            force[item] = found.impulse / self.dt
            slide[item] = np.sqrt((found.slide**2).sum(axis=-1))
            there = arrive(self.model, self.points.frames, q0, found.v, -self.dt / 2 * v0, self.dt * found.way)
            q1[item], v1[item] = self.settle(there, held, end)
        self.forces.append(force)
        self.places.append(place)
        self.slides.append(slide)
        self.pulls.append(pull)
        self.missed.append(missed)
        self.fastest.append(fastest)
        return q1, v1

    def stand(
        self, program: StepProgram, tau: Array, q: Array, v: Array, before: Array
    ) -> tuple[StickingStep, Array, Array, Array, float] | None:
        """Return a step in which all that may touch sticks, q and v at its end, how each point misses, the fastest.

        None where it is another one.
        """
        if not (before[:, 2] > 0).all():
            return None
        bound = np.zeros_like(before)
        bound[:, 2] = -np.maximum(self.points.height(q), 0) / self.dt
        results = program(q, v, tau, bound.ravel(), before.ravel(), self.ground.axes, np.array([self.dt]))
        if results is None:
            return None
        found = StickingStep(*results)
        loose, ends, pushes = found.points.reshape(3, 2, len(before), 3)
        speeds = found.speeds[:, self.joints.at_v] * self.joints.sign
        fastest = max(float(np.abs(loose[1] + bound).max()), float(np.abs(speeds[2]).max(initial=0)))
        missed = np.abs(ends[1]).max(axis=-1)
        sideways = np.sqrt((pushes[..., :2] ** 2).sum(axis=-1))
        if not (
            (loose[..., 2] < 0).any(axis=-1).all()
            and (sideways <= self.mu * pushes[..., 2]).all()
            and (pushes[0, :, 2] > 0).all()
            and (speeds >= -np.maximum(self.joints.gap(q), 0) / self.dt).all()
            and np.abs(ends).max() <= TARGET_RTOL * fastest
            and np.abs(found.speeds).max() * max(1.0, self.dt) <= MAX_STEADY_SPEED
        ):
            return None
        if min(found.height.min() - self.ground.height, self.joints.gap(found.q).min(initial=0)) >= -GAP_ATOL:
            return found, found.q, found.v, missed, fastest
        there = arrive(self.model, self.points.frames, found.q, found.v, np.zeros_like(v), np.zeros_like(v))
        return found, *self.settle(there, self.held, 0.0), missed, fastest

    def one(
        self, tau: Array, q: Array, v: Array, before: Array, held: Held, end: float
    ) -> tuple[StepSolution, Array, Array]:
        """Return the velocity at the end of a step in the axes of its middle, λ of what holds, and where points are.

        Once more, where the mean of the velocities makes a difference.
        """
        at = self.terms(q, v)
        mean = v = at.v
        other = np.full_like(v, np.inf)
        for _ in range(2):
            free = v + self.dt * (aba(self.model, at.q, mean, tau) + turning(self.model, mean))
            if np.abs(free - other).max(initial=0) <= FREE_VELOCITY_RTOL * np.abs(free).max(initial=0):
                break
            other = free
            rows = held.velocity_rows(at.q, mean, at.damped, self.dt, end) if held.contacts else None
            found, pull = self.solve(at, v, free, before, rows)
            mean = (v + found.v) / 2
            before = found.impulse
            check_divergence(self.model, "v", mean, dt=self.dt)
        check_divergence(self.model, "v dt", self.dt * found.v)
        self._check_sinking(found)
        return found, pull / self.dt, at.place

    def terms(self, q: Array, v: Array) -> StepTerms:
        """Return what a step from q with v needs."""
        found = middle_of_step(self.model, self.points.frames, q, v, self.dt / 2 * v, self._damping)
        points = self.points.terms_of(found)
        damped = points.M + np.diag(self._damping) if self._damped else points.M
        gap = self.points.height_of(found.start)
        ends = self.joints.gap(q)
        every = StepRows(Metric(points.white), points.rows, self.joints.rows)
        return StepTerms(found.q, found.v, points.M, damped, every, points.rows, points.place, gap, ends)

    def solve(
        self, at: StepTerms, v: Array, free: Array, before: Array, held: Rows | None
    ) -> tuple[StepSolution, Array]:
        """Return the velocity at the end of the step, from v and that of the free motion, and the impulses."""
        gap, J, every = at.gap, at.J, at.every
        loose = free = every.metric.respond(at.M @ free) if self._damped else free
        if held is not None:
            every = StepRows(Metric.beside(self.model, at.damped, held.span), J, self.joints.rows)
            free = held.corrected(free)
        ends = -np.maximum(at.ends, 0) / self.dt
        n = J[:, 2]
        bound = self.points.velocity.copy()
        lowest = -np.maximum(gap, 0) / self.dt

        def answer(least: Array) -> StepSolution:
            """Return what is found where points leave the step with this normal velocity at least."""
            bound[:, 2] = least
            points = Points(self.mu, bound)

            def solved(free: Array, rows: Array) -> tuple[StepSolution, Array]:
                if not len(rows):
                    return solve_contacts(every, free, points, ends, before), rows
                more = StepRows(every.metric, J, np.concatenate([self.joints.rows, rows]))
                found = solve_contacts(more, free, points, np.concatenate([ends, np.zeros(len(rows))]), before)
                return found, found.others[len(ends) :]

            return self.joints.with_dry_friction(every.metric, free, self.dt, solved)

        found = answer(lowest)
        share = self.points.restitution
        touches = found.impulse[:, 2] > 0
        hits = (n @ v < 0) & touches & (share > 0)
        if hits.any():
            q_goes = found.v
            faster = 2 * np.maximum(gap, 0) / self.dt * (n @ (v - free))
            speed = np.sqrt(np.maximum((n @ v) ** 2 + faster, 0))  # where it hits, by what accelerates it until then
            while share.any():
                leaves = np.where(hits, share * speed, np.where(touches, lowest, -np.inf))
                bounced = replace(answer(leaves), way=q_goes)
                if (bounced.impulse * (J @ (bounced.v + free) / 2 - self.points.velocity)).sum() <= 0:
                    found = bounced
                    break
                share = np.where(share > 0.01, share / 2, 0.0)  # Newton's law with friction would add energy here
        pull = np.zeros(0) if held is None else held.balance(at.damped @ (found.v - loose) - found.total)
        return found, pull

    def settle(self, there: Results, held: Held, end: float) -> tuple[Array, Array]:
        """Return the nearest configuration with no point below the ground and no joint beyond its range, and v there.

        What flies keeps its velocity in the world, where it is turned a little.
        """
        rows, span = None, None
        nowhere = np.zeros(self.model.nv)
        for _ in range(MAX_PROJECTIONS):
            q, v, way = there.q, there.v, nowhere
            gap = np.concatenate([self.points.height_of(there.frames), self.joints.gap(q)])
            if held.contacts:
                rows = held.position_rows(q, end)
                way = rows.corrected(way)
                span = rows.span
            if gap.min(initial=0) >= -GAP_ATOL and (rows is None or np.abs(rows.u).max() <= ANCHOR_ATOL_M):
                break
            terms = self.points.terms(q)
            G = np.concatenate([terms.rows[:, 2], self.joints.rows])
            metric = Metric(terms.white) if span is None else Metric.beside(self.model, terms.M, span)
            way, _ = metric.nearest(way, G, -gap)
            there = arrive(self.model, self.points.frames, q, v, nowhere, way)
        q, v = there.q, there.v
        if rows is not None:
            held.check_drift(rows)
            v = held.settle(q, v, end)
        return q, v

    def contact_forces(self, q: Array) -> dict[str, Array]:
        """Return λ of all steps, by the contact's frame; q are the states in which they begin, (n, ..., nq)."""
        n = len(q)
        batch = q.shape[:-1]
        k = len(self.mu)
        place, force = (np.array(x[:n]).reshape(*batch, k, 3) for x in (self.places, self.forces))
        pull = np.array(self.pulls[:n]).reshape(*batch, sum(c.dim for c in self.held.contacts))
        return point_forces(self.contacts, place, force, self.ground) | per_contact(self.held.contacts, pull)

    def _check_sinking(self, found: StepSolution) -> None:
        if found.sinks.max(initial=0) > MAX_SINK_SHARE * found.fastest:
            worst = int(found.sinks.argmax())
            raise DivergenceError(
                f"nothing keeps {self._names()[worst]} above the ground: it goes down {found.sinks[worst]:.3g} m/s "
                "too fast, by Coulomb's law and by what holds; a smaller dt?"
            )

    def _names(self) -> list[str]:
        return [name for c in self.contacts for name in c.point_names]

    def _check_start(self, q: Array) -> None:
        height = self.points.height(q)
        gap = height.min(axis=tuple(range(q.ndim - 1)), initial=np.inf)
        if gap.min(initial=0) < -MAX_START_DEPTH_M:
            raise ValueError(
                f"q: {self._names()[int(gap.argmin())]} begins {-gap.min():.3g} m below the ground; "
                "raise the base, or lower the ground"
            )


class Joints:
    """The joints of one axis that have a range, and the degrees of freedom with dry friction.

    Raises
    ------
    ValueError
        If a joint is beyond its range in q, shape (..., nq).
    """

    def __init__(self, model: Model, q: Array) -> None:
        self.model = model
        ends = []
        for joint, sq, sv in zip(model.joints, model.q_slice, model.v_slice):
            if joint is None or not joint.nq == joint.nv == 1:
                continue
            for side, limit in ((1.0, model.lower[sq.start]), (-1.0, model.upper[sq.start])):
                if np.isfinite(limit):
                    ends.append((sq.start, sv.start, side, limit))
        at_q, at_v, self.sign, self.end = np.array(ends).reshape(len(ends), 4).mT
        self.at_q, self.at_v = at_q.astype(int), at_v.astype(int)
        self.rows = np.zeros((len(ends), model.nv))
        self.rows[np.arange(len(ends)), self.at_v] = self.sign
        self.friction = np.flatnonzero(model.friction > 0)
        self._check_ranges(q)

    def gap(self, q: Array) -> Array:
        """Return how far the joints are from the ends of their ranges, below 0 outside."""
        return np.asarray(self.sign * (q[..., self.at_q] - self.end))

    def _check_ranges(self, q: Array) -> None:
        gap = self.gap(q).min(axis=tuple(range(q.ndim - 1)), initial=np.inf)
        if (gap < -RANGE_ATOL).any():
            k = int(gap.argmin())
            i = next(i for i, s in enumerate(self.model.q_slice) if s.start <= self.at_q[k] < s.stop)
            s = self.model.q_slice[i]
            lower, upper = (float(x[s.start]) for x in (self.model.lower, self.model.upper))
            raise ValueError(
                f"q: joint {self.model.joint_names[i]!r} begins {-gap[k]:.3g} beyond its range, "
                f"{lower:.6g} to {upper:.6g}, which time stepping keeps"
            )

    def with_dry_friction(
        self, metric: Metric, free: Array, dt: float, solve: Callable[[Array, Array], tuple[StepSolution, Array]]
    ) -> StepSolution:
        """Return what `solve` finds with dry friction.

        `solve` takes the free velocity, and rows G with G v ≥ 0; it also returns the impulses along these. A joint that
        slides is braked by f, and may come to rest but not turn back; one that sticks is held both ways. Where the sum
        of its impulses is more than f, it slides the way it is pushed.
        """
        n, at = len(self.friction), self.friction
        if not n:
            return solve(free, np.zeros((0, len(free))))[0]
        most = dt * self.model.friction[at]
        slides = np.sign(free[at])
        for _ in range(MAX_FRICTION_ROUNDS):
            rows = np.zeros((2 * n, len(free)))
            rows[np.arange(n), at] = np.where(slides >= 0, 1.0, 0.0)
            rows[n + np.arange(n), at] = np.where(slides <= 0, -1.0, 0.0)
            braking = np.zeros(len(free))
            braking[at] = -slides * most
            found, held = solve(free + metric.respond(braking), rows)
            total = -slides * most + held[:n] - held[n:]
            before = slides
            loose = 1e-9 * most
            slides = np.where(total > most + loose, -1.0, np.where(total < -most - loose, 1.0, slides))
            if (slides == before).all():
                break
        return replace(found, total=found.total + braking)
