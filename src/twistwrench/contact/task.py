"""What contacts have to do for a motion: the wrench that no motor gives, and the least forces that exert it (49.9).

Contact forces f have limits, rows of A f ≤ b: those of the contacts, and of the motors that balance them. Whether
forces within the limits can exert a given wrench has a proof either way. The forces that contacts bear are sums of
rays, the edges of their friction pyramids, and so the wrenches that they exert together are a cone. Either the given
wrench is in it: then forces prove it. Or some twist leads away from the cone: the wrench does work along it, and no
force within the limits does any (the lemma of Farkas). The residual of nonnegative least squares is such a twist, and
one product with the rays shows that it is.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.mimic import MimicModel
from ..arrays import Array, as_names
from ..errors import SingularError, check_known
from ..model import Model
from ..spatial._elementary import at_first_index
from .decomposition import Decomposition, block_diagonal, decompose, point_map
from .qp import nonnegative_least_squares
from .rows import as_contacts, contact_terms, given_motion, per_contact, real_state
from .types import Contact, Pyramid

__all__ = [
    "MAX_FORCE_WEIGHTS",
    "WRENCH_RTOL",
    "ContactForces",
    "ContactProblem",
    "Limits",
    "Reach",
    "Unbalanced",
    "contact_limits",
    "motor_limits",
    "passive_entries",
    "proves",
    "reach",
]

TEXTBOOK_CALLS = 20
"""So many times the textbook is asked: whether a robot stands is often asked once, and not of these contacts again."""

BALANCE_RTOL = 1e-8
"""Tolerance of the base's wrench, relative to it; rounding stays far below."""

WRENCH_RTOL = 1e-8
"""Tolerance of the wrench, relative to it and to the weight."""

MAX_FORCE_WEIGHTS = 1e6
"""Upper bound of the sum of all forces, in multiples of the weight."""


@dataclass(frozen=True)
class ContactForces:
    """Joint forces and contact forces of a motion, from `contact_inverse_dynamics` and `friction_inverse_dynamics`.

    Attributes
    ----------
    tau : ndarray, shape (..., nv)
        Joint forces as `aba` takes them, N m or N; the six of a floating base are zero.
    forces : dict of str to ndarray, shape (..., dim)
        λ on the frame, by its name, as `ContactDynamics.forces`.
    binding : tuple of str
        The active limits, by names; empty where no limits were requested.
    residual : ndarray, shape (..., m)
        J a + J̇ v less what was required of the contacts, zero if they stay at rest or move as given, rad/s² and m/s².
    """

    tau: Array
    forces: dict[str, Array]
    binding: tuple[str, ...]
    residual: Array


def passive_entries(model: Model | MimicModel, motors: Iterable[str] | None) -> Array:
    """Return the entries of v that have no motor."""
    free = np.arange(model.nv) < (6 if model.base == "floating" else 0)
    if motors is not None:
        free[:] = True
        for name in as_names(motors, "motors", "joint names"):
            check_known("joint", name, model.joint_names, f" of model {model.name!r}")
            free[model.v_slice[model.joint_names.index(name)]] = False
    return np.flatnonzero(free)


class Unbalanced(SingularError):
    """No forces at the contacts, even pulling ones, balance the base's wrench; ``left`` is the unbalanced part."""

    def __init__(self, message: str, left: Array, L: Array) -> None:
        super().__init__(message)
        self.away = np.linalg.solve(L.mT, np.linalg.solve(L, left[..., None]))[..., 0]


@dataclass(frozen=True)
class ContactProblem:
    """The total wrench that the contacts must exert, and the least forces f at their points that do.

    ``passive`` are the entries of v without a motor: those of the base, unless joints have none either. f has three
    entries for each point, in the axes of its contact; ``free`` spans what may be added to it. ``size`` is
    the size of such forces, N, and ``asked`` that of their total wrench, in the metric of M: the larger of this
    motion's and of the weight's.
    """

    contacts: tuple[Contact, ...]
    passive: Array
    b: Array
    J: Array
    P: Array
    parts: Decomposition
    least: Array
    size: float
    asked: float
    residual: Array

    @classmethod
    def of(
        cls,
        model: Model | MimicModel,
        q: ArrayLike,
        v: ArrayLike,
        a: ArrayLike,
        contacts: Iterable[Contact],
        f_ext: ArrayLike | None,
        passive: Array | None = None,
        after: int = TEXTBOOK_CALLS,
    ) -> ContactProblem:
        """Set up and solve the rows without a motor; raise SingularError if no forces at these contacts do.

        `after` so many calls there is a program of the terms.
        """
        contacts = as_contacts(model, contacts)
        q, v, others = real_state(model, q, f_ext, v=v, a=a)
        terms = contact_terms(model, q, v, contacts, after, **others)
        J = terms.J
        b = terms.tau
        P = point_map(contacts, terms.placement)
        base = passive_entries(model, None) if passive is None else passive
        parts = decompose(model, terms.M[..., base[:, None], base], P.mT @ J[..., base])
        least = parts.balance(b[..., base])
        weight = terms.weight[..., base]
        left = b[..., base] - np.matvec(J[..., base].mT @ P, least)
        off, *sizes = (parts.size(x) for x in (left, b[..., base], weight))
        missed = np.asarray(off > BALANCE_RTOL * np.maximum(*sizes))
        if missed.any():
            names = [c.frame for c in contacts]
            over = ", ".join(f"{x:.3g}" for x in left[missed][0])
            what = "(τ, f)" if passive is None else "τ without motors"
            raise Unbalanced(
                f"no forces at {names} do this{at_first_index(missed)}: {what} = ({over}) is left over", left, parts.L
            )
        size = max(float(np.abs(f).max(initial=0)) for f in (least, parts.balance(weight)))
        asked = float(np.maximum(*sizes).max(initial=0))  # where neither is anything, any unit will do
        residual = np.matvec(J, others["a"]) + terms.bias - given_motion(contacts, "acceleration")
        return cls(contacts, base, b, J, P, parts, least, size or 1.0, asked or 1.0, residual)

    def reach(
        self,
        sides: int,
        pyramid: Pyramid,
        also: Limits | None = None,
        contacts: Sequence[Contact] = (),
        start: Array | None = None,
    ) -> Reach:
        """Return whether forces within the limits do this, and the proof, whose twist is the base's in b's order.

        Of the task's contacts, or of others at the same points; `also` are more limits; `start` as `reach` takes it.
        """
        G, w = (np.linalg.solve(self.parts.L, x) for x in ((self.J.mT @ self.P)[self.passive], self.b[self.passive]))
        more = None if also is None else (also.A, also.b / self.size)
        found = reach(
            G * self.size / self.asked, w / self.asked, contacts or self.contacts, sides, pyramid, more, start
        )
        return found._replace(f=self.size * found.f, away=np.linalg.solve(self.parts.L.mT, found.away))

    def motors(self, model: Model) -> Limits:
        """Return the limits of the motors, as limits of the forces."""
        return motor_limits(model, self.b, self.J.mT @ self.P)

    @property
    def free(self) -> Array:
        """Return the internal forces, which exert no wrench, as orthonormal columns, shape (3 k, ...)."""
        V = self.parts.V[:, self.parts.s_inv > 0]
        return np.linalg.qr(V, mode="complete")[0][:, V.shape[1] :]

    def result(self, f: Array, binding: tuple[str, ...]) -> ContactForces:
        """Return joint forces and contact forces of the forces f at the points."""
        force = np.matvec(self.P, f)
        tau = self.b - np.matvec(self.J.mT, force)
        tau[..., self.passive] = 0
        return ContactForces(tau, per_contact(self.contacts, force), binding, self.residual)


class Limits(NamedTuple):
    """A f ≤ b, in N, with a name, a size and a unit for each row: broken by 1 N, a row is broken by `size` units."""

    A: Array
    b: Array
    names: list[str]
    size: Array
    unit: list[str]

    def join(self, other: Limits) -> Limits:
        """Return the rows of both."""
        A, b, size = (
            np.concatenate([x, y]) for x, y in zip((self.A, self.b, self.size), (other.A, other.b, other.size))
        )
        return Limits(A, b, self.names + other.names, size, self.unit + other.unit)

    def breached(self, by: Array) -> str:
        """Return which limits would have to be broken, and by how much, the worst four first."""
        worst = {self.names[k]: k for k in np.argsort(by) if by[k] > 0.01 * by.max()}  # of equal names the larger
        ranked = sorted(worst.values(), key=lambda k: (-round(by[k] / by.max(), 6), k))  # alike: in their own order
        more = f" and {len(ranked) - 4} more" if len(ranked) > 4 else ""
        said = (f"{self.names[k]} by {by[k] * self.size[k]:.3g} {self.unit[k]}" for k in ranked[:4])
        return ", ".join(said) + more


def contact_limits(contacts: Sequence[Contact], sides: int, pyramid: Pyramid) -> Limits:
    """Return the limits of the forces at all points, each in its contact's axes."""
    A = block_diagonal([c.limits(sides, pyramid) for c in contacts])
    names = [name for c in contacts for name in c.limit_names(sides)]
    return Limits(A, np.zeros(len(A)), names, np.ones(len(A)), ["N"] * len(A))


def motor_limits(model: Model, tau: Array, B: Array) -> Limits:
    """Return |τ − B f| ≤ `Model.effort_limit`, of all joints that have a limit and are no floating base.

    Parameters
    ----------
    model : Model
    tau : ndarray, shape (nv,)
        The joint forces that the motion needs without f, N m or N.
    B : ndarray, shape (nv, 3 k)
        What f does for them.
    """
    owner = np.repeat(np.arange(model.nbodies), [s.stop - s.start for s in model.v_slice])
    motors = np.flatnonzero(np.isfinite(model.effort_limit) & (owner >= (2 if model.base == "floating" else 1)))
    B = B[motors]
    tau = tau[motors]
    limit = model.effort_limit[motors]
    most = np.abs(B).max(axis=1, initial=0)
    size = np.where(most > 0, most, 1)  # m: the longest lever of a force
    lever = B / size[:, None]
    need = tau / size
    limit = limit / size
    turns = [bool(model.joints[owner[k]].subspace()[:3, k - model.v_slice[owner[k]].start].any()) for k in motors]
    names = [f"the motor of {model.joint_names[owner[k]]!r}" for k in motors]
    A, b = np.concatenate([-lever, lever]), np.concatenate([limit - need, limit + need])
    return Limits(A, b, 2 * names, np.tile(size, 2), 2 * ["N m" if turn else "N" for turn in turns])


class Reach(NamedTuple):
    """An answer, and its proof."""

    reached: bool
    f: Array
    """The forces within the limits that are nearest, at all points, each in its contact's axes, shape (3 k,)."""
    away: Array
    """The direction in which they miss, shape (m,): no force within the limits does work along it, but w does."""
    proved: bool
    """Whether f, or `away`, proves the answer."""
    used: Array
    """Which rays and slacks f is a sum of: where a problem nearly alike begins."""


def reach(
    G: Array,
    w: Array,
    contacts: Sequence[Contact],
    sides: int,
    pyramid: Pyramid,
    also: tuple[Array, Array] | None = None,
    start: Array | None = None,
) -> Reach:
    """Return whether forces f within the limits have G f = w, and C f ≤ d where `also` is (C, d).

    Parameters
    ----------
    G : ndarray, shape (m, 3 k)
    w : ndarray, shape (m,)
        In units in which 1 is large, as are C and d.
    contacts, sides, pyramid
        As `friction_inverse_dynamics`.
    also : (ndarray, ndarray), shapes (n, 3 k) and (n,), optional
    start : ndarray, optional
        `used` of a problem nearly alike.
    """
    T, C, d = _generators(contacts, sides, pyramid, float(np.abs(G).max(initial=0)))
    if also is not None:
        C, d = np.concatenate([C, also[0]]), np.concatenate([d, also[1]])
    E = np.block([[G @ T, np.zeros((len(w), len(d)))], [C @ T, np.eye(len(d))]])  # C f + slack = d
    asked = np.concatenate([w, d])
    length = np.sqrt((E * E).sum(axis=0))
    x, r = nonnegative_least_squares(E, asked, start)
    used = x > 0
    if (
        r @ r <= WRENCH_RTOL**2 and length @ x > MAX_FORCE_WEIGHTS
    ):  # internal forces: Σ forces + slack = the largest, in units of that
        E = np.block([[E, np.zeros((len(E), 1))], [length / MAX_FORCE_WEIGHTS, np.ones(1)]])
        asked = np.append(asked, 1.0)
        x, r = nonnegative_least_squares(E, asked)
    left = np.sqrt(r @ r)
    f = T @ x[: T.shape[1]]
    if left <= WRENCH_RTOL:
        missed = asked - E @ x
        return Reach(True, f, r[: len(w)], bool((x >= 0).all() and np.sqrt(missed @ missed) <= 2 * WRENCH_RTOL), used)
    return Reach(False, f, r[: len(w)] / left, proves(r / left, E, asked), used)


def proves(away: Array, E: Array, asked: Array) -> bool:
    """Return whether no x ≥ 0 up to `MAX_FORCE_WEIGHTS` has E x = asked: along `away` it exceeds every E x."""
    length = np.sqrt((E * E).sum(axis=0))
    most = (E.mT @ away / np.where(length > 0, length, 1)).max(initial=0)
    return bool(away @ asked > MAX_FORCE_WEIGHTS * most)


def _generators(contacts: Sequence[Contact], sides: int, pyramid: Pyramid, size: float) -> tuple[Array, Array, Array]:
    """Return T, C, d: the contacts bear the forces f = T x with x ≥ 0 and C f ≤ d.

    The rays of the contacts; for one with limits of its own, its axes both ways and these limits, in the units of G.
    """
    spans, bounds = [], []
    for c in contacts:
        own = type(c).limits is not Contact.limits or not c.pushes
        n = 3 * len(c.points)
        spans.append(np.concatenate([np.eye(n), -np.eye(n)], axis=1) if own else c.rays(sides, pyramid).mT)
        bounds.append(size * c.limits(sides, pyramid) if own else np.zeros((0, n)))
    C = block_diagonal(bounds)
    return block_diagonal(spans), C, np.zeros(len(C))
