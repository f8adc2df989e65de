"""The step in which all points stick, as one program: what a robot that stands asks for, step by step.

Where everything touched in the step before, Coulomb's law is first tried as a linear system, and where no force then
leaves its cone, that is the answer (`coulomb`). The program makes the whole step so, from q and v to q and v, with the
rows of a point or a sole in place of those of its corners. What it cannot ask is asked of its results: whether the
points would sink without impulses, whether a force leaves its cone, whether a joint comes to its end. Where one answer
is another than that of a robot that stands, the step is made as all steps are (`stepping`), which knows the same laws.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from typing import Any, NamedTuple

import numpy as np

from straightline.backend import BackEnd
from straightline.llvm import default_backend

from ..algorithms.aba import aba_terms
from ..arrays import Array, convert
from ..contact import Contact, PointContact, SurfaceContact
from ..contact.elimination import Elimination
from ..contact.rows import contact_rows
from ..errors import SingularError
from ..fast.programs import MAX_COMPILED_OPERATIONS, too_long
from ..fast.quantity import Quantity
from ..fast.recording import record
from ..model import Model, tree_terms
from ..spatial import SE3
from ..spatial.rotation import cross_matrix
from .straight import shifted_and_turned, turned, turning_rate

__all__ = ["StepProgram", "StickingStep", "prepared_sticking"]

DOUBLE = np.dtype(np.float64)

MIN_STEPS = 500
"""Steps of a motion for which the program is worth its making."""


class StickingStep(NamedTuple):
    """What a step is in which all k points stick, in the axes of the ground."""

    speeds: Array
    """(4, nv): the velocity without impulses and that with them; both by the mean that these give."""
    points: Array
    """(6, k, 3): what the points move without impulses beyond their bounds, with them, and impulses; each twice."""
    place: Array
    """(k, 3): the points in the middle of the step, from the origin of the world."""
    q: Array
    v: Array
    height: Array
    """(k,), of the points at the end, above the origin of the world."""


StepProgram = Callable[..., tuple[Array, ...] | None]
"""From q, v, τ, bounds and impulses before (3 k,), the ground's axes and dt, to a `StickingStep`; None if unsure."""


def prepared_sticking(model: Model, contacts: Sequence[Contact], steps: int) -> Hashable:
    """Return the key under which a model has the program of a step, for any ground: None, or nothing, if there is none.

    For a motion of few steps none is made, as it takes longer than they do.
    """
    made = Sticking(model, contacts)
    key = ("sticking step", *made.places)
    if key not in model._programs and steps >= MIN_STEPS:
        model._programs[key] = made.program()
    return key


class Sticking:
    """A robot that stands on points and soles, and what it is recorded from."""

    def __init__(self, model: Model, contacts: Sequence[Contact]) -> None:
        self.model, self.contacts = model, contacts
        self.places = [(c.frame, *map(tuple, c.points.tolist())) for c in contacts]
        self.plain = all(isinstance(c, PointContact | SurfaceContact) for c in contacts)
        self.k = sum(len(c.points) for c in contacts)

    def program(self) -> StepProgram | None:
        """Record and compile it."""
        if not self.plain or default_backend(DOUBLE) != "llvm" or too_long(self.model, ("M",)):
            return None
        n, dim = self.model.nv, (3 * self.k,)
        shapes = {
            "q": (self.model.nq,),
            "v": (n,),
            "tau": (n,),
            "bound": dim,
            "before": dim,
            "axes": (3, 3),
            "dt": (1,),
        }
        found: list[tuple[list[Array], list[Any]]] = []

        def part(which: int) -> Callable[..., tuple[Array, list[Any]]]:
            def compute(*x: Array) -> tuple[Array, list[Any]]:
                if not which:
                    found[:] = [self.step(*x)]
                results, questions = found[0]
                return results[which], [] if which else questions

            return compute

        wants = [Quantity(name, tuple(shapes), part(which)) for which, name in enumerate(StickingStep._fields)]
        try:
            line = record(self.model, wants, shapes, {}, DOUBLE)
        except (TypeError, ArithmeticError, SingularError):  # a joint that asks what its q is; no inertia
            return None
        if line.operations.total() > MAX_COMPILED_OPERATIONS:
            return None
        return BackEnd(line, DOUBLE, "llvm").one_state(single=False)

    def step(
        self, q: Array, v: Array, tau: Array, bound: Array, before: Array, axes: Array, dt: Array
    ) -> tuple[list[Array], list[Any]]:
        """Return a step, and what is to be watched."""
        model, time = self.model, dt[0]
        half = v * (time / 2)
        middle, v = shifted_and_turned(model, q, half), turned(model, v, half)
        rows = contact_rows(model, middle, 0 * v, self.contacts)
        equations = Elimination.of(tree_terms(model, middle), rows.J)
        spread = [Spread(c, T, axes) for c, T in zip(self.contacts, rows.placement)]
        speeds: list[Array] = []
        loose: list[Array] = []
        ends: list[Array] = []
        pushes: list[Array] = []
        mean = v
        for _ in range(2):
            free = v + (aba_terms(model, middle, mean, tau).qdd + turning_rate(model, mean)) * time
            asked = np.concatenate([one.nearest(b) for one, b in zip(spread, self.each(bound))])
            change, force = equations.hold(asked - rows.J @ free)
            after = free + change
            loose.append(self.moves(spread, rows.J @ free) - bound)
            ends.append(self.moves(spread, asked) - bound)
            forces = np.split(force, np.cumsum([c.dim for c in self.contacts])[:-1])
            before = np.concatenate([s.share(f, b) for s, f, b in zip(spread, forces, self.each(before))])
            pushes.append(before)
            speeds += [free, after]
            mean = (v + after) / 2
        straight = turned(model, after, -half)
        way = straight * time
        there, new = shifted_and_turned(model, q, way), turned(model, straight, way)
        place = self.corners(rows.placement) @ axes.mT
        height = self.corners(contact_rows(model, there, 0 * v, self.contacts).placement) @ axes[2]
        questions = [*equations.watched(model, DOUBLE)]
        points = np.stack([*loose, *ends, *pushes]).reshape(6, self.k, 3)
        return [np.stack(speeds), points, place, there, new, height], questions

    def each(self, x: Array) -> list[Array]:
        """Return the entries of each contact's points."""
        return np.split(x, np.cumsum([3 * len(c.points) for c in self.contacts])[:-1])

    def moves(self, spread: Sequence[Spread], rates: Array) -> Array:
        """Return the velocities of all points, of those along the rows."""
        parts = np.split(rates, np.cumsum([c.dim for c in self.contacts])[:-1])
        return np.concatenate([one.moves(x) for one, x in zip(spread, parts)])

    def corners(self, at: Sequence[SE3]) -> Array:
        """Return the places of all points in the world, shape (k, 3)."""
        parts = [convert(c.points, object) @ T.rotation.mT + T.translation for c, T in zip(self.contacts, at)]
        return np.concatenate(parts)


class Spread:
    """The rows of a contact, and its points in the axes of a ground: G takes the rate of the rows to theirs."""

    def __init__(self, contact: Contact, at: SE3, axes: Array) -> None:
        self.axes = axes
        self.sole = contact.dim == 6
        if self.sole:
            arms = [cross_matrix(p) for p in contact.points]
            G = np.concatenate([np.concatenate([-p, np.eye(3)], axis=1) for p in arms])
            self.inverse = convert(np.linalg.inv(G.mT @ G), object)  # in the axes of the sole
            self.G = convert(G, object)
            self.R = at.rotation

    def moves(self, rate: Array) -> Array:
        """Return the velocities of the points, one after the other."""
        if not self.sole:
            return np.asarray(self.axes @ rate)
        points = (self.G @ self.turned(rate)).reshape(-1, 3)
        return np.asarray(points @ (self.axes @ self.R).mT).ravel()

    def nearest(self, points: Array) -> Array:
        """Return the rate of the rows whose points move most nearly so."""
        if not self.sole:
            return np.asarray(self.axes.mT @ points)
        return self.turned_back(self.inverse @ (self.G.mT @ self.own(points)))

    def share(self, force: Array, before: Array) -> Array:
        """Return the forces at the points, nearest to those before, that are a force along the rows."""
        if not self.sole:
            return np.asarray(self.axes @ force)
        own = self.own(before)
        own = own + self.G @ (self.inverse @ (self.turned(force) - self.G.mT @ own))
        return np.asarray(own.reshape(-1, 3) @ (self.axes @ self.R).mT).ravel()

    def own(self, points: Array) -> Array:
        """Return vectors at the points in the axes of the sole."""
        return np.asarray(points.reshape(-1, 3) @ (self.axes @ self.R)).ravel()

    def turned(self, rate: Array) -> Array:
        """Return (ω, v) in the axes of the sole."""
        return np.concatenate([self.R.mT @ rate[:3], self.R.mT @ rate[3:]])

    def turned_back(self, rate: Array) -> Array:
        """Return (ω, v) in the axes of the world."""
        return np.concatenate([self.R @ rate[:3], self.R @ rate[3:]])
