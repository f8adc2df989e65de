"""Forward dynamics under contact: M q̈ + h = Sᵀ τ + Jᵀ λ with J q̈ + J̇ v = 0, and what follows from it (49.9).

Among all accelerations that the contacts allow the robot takes the one nearest to that of its free motion, in the
metric of M (Gauss's principle of least constraint). The pseudo-inverse finds it in one step also where rows of J
depend on each other; a damped (proximal) solve would have to be iterated.

An impact is the same for velocities, the jump in the instant in which contacts close, M (v⁺ − v⁻) = Jᵀ Λ; and the
projection onto the contacts the same for a configuration and a velocity, whose drift is removed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.mimic import MimicModel
from ..arrays import Array, as_count, as_number
from ..errors import SingularError
from ..fast.program import Results
from ..fast.quantity import Quantity
from ..fast.steps import integrate
from ..model import Model
from ..spatial import SE3
from ..spatial._elementary import at_first_index
from .calls import ContactProgram, contact_program, is_programmed, known_program
from .decomposition import decompose
from .programs import Solution, held_equations, held_quantities, hit_equations
from .rows import as_contacts, contact_errors, contact_terms, given_motion, per_contact, real_state
from .types import Contact

__all__ = [
    "Baumgarte",
    "ContactDynamics",
    "Impact",
    "contact_forward_dynamics",
    "contact_quantities",
    "impact",
    "jump",
    "project_state",
]

NONE = np.int_(0)
"""Redundant rows of one state that a program has answered."""

CONTRADICTION_RTOL = 1e-8
"""Tolerance of J q̈ + J̇ v, relative to its terms; rounding stays far below."""


@dataclass(frozen=True)
class Baumgarte:
    """A spring and a damper that bring contacts back to their anchors: J q̈ + J̇ v = −2 ζ ω J v − ω² δ.

    Of contacts that move, J v and J q̈ + J̇ v are without their given velocity and acceleration.

    Parameters
    ----------
    frequency : float
        ω, above 0, rad/s.
    anchors : mapping of str to SE3
        Where the contacts' frames belong, as from `contact_placements`; δ is how far they are from there.
    damping : float, optional
        ζ, at least 0; at 1 they come back fastest without overshoot.

    Raises
    ------
    ValueError
        If `frequency` or `damping` is out of bounds.
    TypeError
        If one of them is not a number, or `anchors` not a mapping.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> feet = [tw.PointContact(foot, 0.6) for foot in model.feet]
    >>> tw.Baumgarte(20.0, tw.contact_placements(model, model.standing(), feet)).damping
    1.0
    """

    frequency: float
    anchors: Mapping[str, SE3]
    damping: float = 1.0

    def __post_init__(self) -> None:
        if not 0 < as_number(self.frequency, "frequency") < np.inf:
            raise ValueError(f"frequency: expected a number above 0, got {self.frequency!r}")
        if not 0 <= as_number(self.damping, "damping") < np.inf:
            raise ValueError(f"damping: expected a number of at least 0, got {self.damping!r}")
        if not isinstance(self.anchors, Mapping):
            raise TypeError(f"anchors: expected placements by frame, as from contact_placements, got {self.anchors!r}")
        object.__setattr__(self, "anchors", dict(self.anchors))


@dataclass(frozen=True)
class ContactDynamics:
    """Acceleration and contact forces of a robot whose contacts hold, from `contact_forward_dynamics`.

    Attributes
    ----------
    qdd : ndarray, shape (..., nv)
        q̈, rad/s² or m/s².
    forces : dict of str to ndarray, shape (..., dim)
        λ on the frame, by its name: f, or (τ, f), at the frame's origin, in the axes of the rows of
        `constraint_jacobian`, N m and N. Of all that give this q̈ the ones of least norm, for a sole that of the forces
        at its corners.
    rank : ndarray of int, shape (...)
        How many rows of J are independent of each other.
    redundant : ndarray of int, shape (...)
        How many rows are not independent. Where there are any, `forces` are one choice of many.
    slip : ndarray, shape (..., m)
        J v without the given velocity, zero for a contact that holds, in the order of the rows of
        `constraint_jacobian`.
    residual : ndarray, shape (..., m)
        J q̈ + J̇ v minus the acceleration required of the contacts, rad/s² and m/s².
    """

    qdd: Array
    forces: dict[str, Array]
    rank: Array
    redundant: Array
    slip: Array
    residual: Array


def contact_forward_dynamics(
    model: Model | MimicModel,
    q: ArrayLike,
    v: ArrayLike,
    tau: ArrayLike,
    contacts: Iterable[Contact],
    f_ext: ArrayLike | None = None,
    *,
    stabilise: Baumgarte | None = None,
) -> ContactDynamics:
    """Return the acceleration of a robot whose contacts hold, and the forces that hold them.

    The contacts neither slip nor open: they may pull, and friction is ignored. They may be redundant or singular. If
    different forces have the same effect, the smallest ones are returned.

    Parameters
    ----------
    model : Model or MimicModel
    q : array_like, shape (..., nq)
    v, tau : array_like, shape (..., nv)
        As `aba`: velocity and joint forces, of which the first six of a floating base are a wrench from outside.
    contacts : iterable of Contact
        An empty one gives the free motion.
    f_ext : array_like, shape (..., nbodies, 6), optional
        As `aba`.
    stabilise : Baumgarte, optional
        Brings the contacts back to their anchors; without it their accelerations are zero.

    Returns
    -------
    ContactDynamics
        In double precision.

    Raises
    ------
    SingularError
        If the contacts contradict each other, so that no acceleration suits all; or as `aba`.
    NameNotFound, ShapeError, ValueError
        As `constraint_jacobian`; complex numbers; an anchor that is missing.
    TypeError
        If `stabilise` is neither a Baumgarte nor None.

    Notes
    -----
    Section 49.9. A velocity with J v ≠ 0 is not an error: `slip` reports it. If redundant contacts then require
    different accelerations, q̈ is the least-squares solution, and `residual` is the difference.

    Examples
    --------
    A Go2 without torques sinks to its knees, on feet that stay where they are:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest, feet = np.zeros(model.nv), [tw.PointContact(foot, 0.6) for foot in model.feet]
    >>> held = tw.contact_forward_dynamics(model, model.standing(), rest, rest, feet)
    >>> held.qdd[5].round(3), int(held.rank), int(held.redundant)
    (np.float64(-9.92), 12, 0)
    """
    if f_ext is None and stabilise is None:
        known = known_program(model, "held", contacts)
        found = known and known.one(q, v, tau)
        if known and found:
            return held_by_program(known, found, np.array(known.dim), NONE)
    contacts = as_contacts(model, contacts)
    q, v, others = real_state(model, q, f_ext, v=v, tau=tau)
    if stabilise is None and isinstance(model, Model) and is_programmed(contacts):
        program = held_program(model, contacts)
        found = program(q, v, **others)
        if found:
            rank = found[1].astype(int)
            return held_by_program(program, found, rank, program.dim - rank)
    return held_by_decomposition(model, contacts, q, v, others, stabilise)


def held_program(model: Model, contacts: tuple[Contact, ...]) -> ContactProgram:
    """Return the program of contacts that hold: q̈, the rank, slip, residual and λ."""

    def more(found: Solution, v: Array) -> list[Array]:
        J, bias = found.rows.J, found.rows.bias
        return [np.array(len(J), object), np.matvec(J, v), np.matvec(J, found.motion) + bias]

    def textbook(q: Array, v: Array, tau: Array, *f_ext: Array) -> list[Array]:
        others = {"tau": tau} | ({"f_ext": f_ext[0]} if f_ext else {})
        d = held_by_decomposition(model, contacts, q, v, others)
        return [d.qdd, d.rank, d.slip, d.residual, *d.forces.values()]

    return contact_program(model, "held", contacts, held_equations, 4 + len(contacts), more, textbook)


def contact_quantities(
    model: Model, contacts: Sequence[Contact], dtype: np.dtype[Any], push: Callable[[Array], Array] | None = None
) -> list[Quantity]:
    """Return what can be compiled: q̈ and λ of contacts that hold, v⁺ and Λ where they close; see `held_quantities`."""

    def held(q: Array, v: Array, tau: Array, *f_ext: Array) -> tuple[Array, Array]:
        d = contact_forward_dynamics(model, q, v, tau if push is None else tau + push(q), contacts, *f_ext)
        return d.qdd, np.concatenate([np.zeros((*q.shape[:-1], 0)), *d.forces.values()], axis=-1)

    def hit(q: Array, v: Array) -> tuple[Array, Array]:
        d = impact(model, q, v, contacts)
        return d.v, np.concatenate([np.zeros((*q.shape[:-1], 0)), *d.impulses.values()], axis=-1)

    return [*held_quantities(model, contacts, dtype, held, hit, push)]


def held_by_program(
    program: ContactProgram, found: tuple[Array, ...], rank: Array, redundant: Array | np.int_
) -> ContactDynamics:
    """Return what a program has found as the function does."""
    qdd, _, slip, residual, *forces = found
    made = object.__new__(ContactDynamics)  # whose own way, entry by entry, takes as long as the program
    vars(made).update(
        qdd=qdd,
        forces=dict(zip(program.frames, forces)),
        rank=rank,
        redundant=redundant,
        slip=slip,
        residual=residual,
    )
    return made


def held_by_decomposition(
    model: Model | MimicModel,
    contacts: Sequence[Contact],
    q: Array,
    v: Array,
    others: Mapping[str, Array],
    stabilise: Baumgarte | None = None,
) -> ContactDynamics:
    """Return what `contact_forward_dynamics` does, whether rows of J depend on each other or not."""
    terms = contact_terms(model, q, v, contacts, **others)
    at, J, free = terms.placement, terms.J, terms.qdd
    W = terms.W
    slip = np.matvec(J, v) - given_motion(contacts, "velocity")
    asked = given_motion(contacts, "acceleration")
    target = asked - terms.bias
    if stabilise is not None:
        if not isinstance(stabilise, Baumgarte):
            raise TypeError(f"stabilise: expected a Baumgarte or None, got {stabilise!r}")
        error = contact_errors(contacts, at, stabilise.anchors)
        target = target - 2 * stabilise.damping * stabilise.frequency * slip - stabilise.frequency**2 * error
    parts = decompose(model, terms.M, W @ J)
    qdd = free
    mu = np.zeros(slip.shape)
    for _ in range(2):  # the second time removes the rounding of the first
        x, change = parts.respond(np.matvec(W, target - np.matvec(J, qdd)))
        qdd = qdd + parts.unwhiten(x)
        mu = mu + change
    residual = np.matvec(J, qdd) - target
    size = np.matvec(np.abs(W @ J), np.abs(free)).max(axis=-1, initial=0)
    if (largest(np.matvec(W, residual)) > CONTRADICTION_RTOL * (size + largest(np.matvec(W, target)))).any():
        held = v - parts.unwhiten(parts.respond(np.matvec(W, slip))[0])  # and no drift to bring back
        wanted = np.matvec(W, asked - contact_terms(model, q, held, contacts).bias)
        check_contradiction(contacts, wanted - parts.within(wanted), CONTRADICTION_RTOL * (size + largest(wanted)))
    forces = per_contact(contacts, np.matvec(W.mT, mu))
    return ContactDynamics(qdd, forces, parts.rank, J.shape[-2] - parts.rank, slip, residual)


def largest(x: Array) -> Array:
    """Return the largest magnitude over the last axis."""
    return np.asarray(np.abs(x).max(axis=-1, initial=0))


def check_contradiction(contacts: Sequence[Contact], left: Array, rounding: Array) -> None:
    """Raise SingularError where the contacts' unattainable acceleration, in m/s², is more than rounding."""
    wrong = np.asarray(largest(left) > rounding)
    if wrong.any():
        pieces = per_contact(contacts, left[wrong][0])
        worst = {frame: float(np.abs(piece).max()) for frame, piece in pieces.items()}
        least = 0.01 * max(worst.values())
        missing = ", ".join(f"{frame!r} {miss:.3g} m/s²" for frame, miss in worst.items() if miss > least)
        raise SingularError(
            f"the contacts contradict each other{at_first_index(wrong)}: no acceleration keeps all at rest; "
            f"{missing} is left"
        )


@dataclass(frozen=True)
class Impact:
    """Velocity and impulses after an impact, from `impact`.

    Attributes
    ----------
    v : ndarray, shape (..., nv)
        v⁺, the velocity just after.
    impulses : dict of str to ndarray, shape (..., dim)
        Λ on the frame, by its name, as `ContactDynamics.forces`, N m s and N s.
    energy_lost : ndarray, shape (...)
        Kinetic energy before, less that after, J. Never below zero where what is touched is at rest.
    rank, redundant : ndarray of int, shape (...)
        As `ContactDynamics`.
    """

    v: Array
    impulses: dict[str, Array]
    energy_lost: Array
    rank: Array
    redundant: Array


def impact(
    model: Model | MimicModel, q: ArrayLike, v: ArrayLike, contacts: Iterable[Contact], *, restitution: float = 0.0
) -> Impact:
    """Return the velocity after an impact in which all contacts close at once, J v⁺ = −e J v⁻.

    With e = 0, v⁺ is the velocity nearest to v⁻, in the metric of M, of all that the contacts allow. If the contacts
    move with a velocity v*, J v⁺ − v* = −e (J v⁻ − v*).

    Parameters
    ----------
    model : Model or MimicModel
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)
        v⁻, the velocity just before the impact.
    contacts : iterable of Contact
        All contacts that hold during the impact. They stick, and they pull if this is necessary.
    restitution : float, optional
        e, from 0 to 1. It reverses the whole velocity of a contact, also the part along the ground.

    Returns
    -------
    Impact
        In double precision.

    Raises
    ------
    ValueError
        If `restitution` is not from 0 to 1, or numbers are complex.
    SingularError
        If a joint moves no inertia.
    NameNotFound, ShapeError
        As `constraint_jacobian`.

    Notes
    -----
    Section 49.9. If the contacts do not move by themselves, the energy lost is (1 − e²) times what is lost with e = 0.

    Examples
    --------
    A pendulum of 1 m whose bob hits a wall at 2 m/s:

    >>> import twistwrench as tw
    >>> hit = tw.impact(tw.load("pendulum"), [0.0], [2.0], [tw.PointContact("bob", 0.6)])
    >>> hit.v, hit.energy_lost.round(9), int(hit.redundant)
    (array([0.]), np.float64(2.002), 2)
    """
    if not 0 <= as_number(restitution, "restitution") <= 1:
        raise ValueError(f"restitution: expected a number from 0 to 1, got {restitution!r}")
    known = known_program(model, "hit", contacts)
    found = known and known.one(q, v)
    if known and found:
        return hit_by_program(known, found, np.asarray(v), restitution)
    contacts = as_contacts(model, contacts)
    q, v, _ = real_state(model, q, v=v)
    if isinstance(model, Model) and is_programmed(contacts):
        program = hit_program(model, contacts)
        found = program(q, v)
        if found:
            return hit_by_program(program, found, v, restitution)
    return jump(model, v, contacts, contact_terms(model, q, v, contacts), restitution)


def hit_program(model: Model, contacts: tuple[Contact, ...]) -> ContactProgram:
    """Return the program of an impact with e = 0: v⁺, the rank, the energy lost, and Λ."""

    def more(found: Solution, v: Array) -> list[Array]:
        lost = -(found.force * np.matvec(found.rows.J, v)).sum() / 2
        return [np.array(len(found.rows.J), object), np.array(lost, object)]

    def textbook(q: Array, v: Array) -> list[Array]:
        hit = jump(model, v, contacts, contact_terms(model, q, v, contacts))
        return [hit.v, hit.rank, hit.energy_lost, *hit.impulses.values()]

    return contact_program(model, "hit", contacts, hit_equations, 3 + len(contacts), more, textbook)


def hit_by_program(program: ContactProgram, found: tuple[Array, ...], v: Array, e: float) -> Impact:
    """Return what a program has found as the function does: what bounces goes on by e times the change."""
    after, rank, lost, *impulses = found
    rank = rank.astype(int)
    if e:
        after = after + e * (after - v)
        impulses = [(1 + e) * impulse for impulse in impulses]
    made = object.__new__(Impact)
    vars(made).update(
        v=after,
        impulses=dict(zip(program.frames, impulses)),
        energy_lost=np.asarray((1 - e * e) * lost),
        rank=rank,
        redundant=program.dim - rank,
    )
    return made


def jump(
    model: Model | MimicModel, v: Array, contacts: Sequence[Contact], terms: Results, restitution: float = 0.0
) -> Impact:
    """Return the impact at a velocity, from the terms of the configuration."""
    J, W = terms.J, terms.W
    parts = decompose(model, terms.M, W @ J)
    u = np.matvec(W, given_motion(contacts, "velocity"))
    x, mu = parts.respond(np.matvec(W @ J, v) - u)  # the change at e = 0, with its sign turned
    spent = (1 - restitution**2) * (x * x).sum(axis=-1) / 2
    return Impact(
        v=v - (1 + restitution) * parts.unwhiten(x),
        impulses=per_contact(contacts, -(1 + restitution) * np.matvec(W.mT, mu)),
        energy_lost=np.asarray(spent + (1 + restitution) * (mu * u).sum(axis=-1)),
        rank=parts.rank,
        redundant=J.shape[-2] - parts.rank,
    )


def project_state(
    model: Model | MimicModel,
    q: ArrayLike,
    v: ArrayLike,
    contacts: Iterable[Contact],
    anchors: Mapping[str, SE3],
    *,
    tolerance: float = 1e-12,
    steps: int = 20,
) -> tuple[Array, Array]:
    """Return the nearby q at which the contacts are at their anchors, and the nearest v with which they stay there.

    Newton's method for q, each step the least in the metric of M; then `impact` projects v.

    Parameters
    ----------
    model : Model or MimicModel
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)
    contacts : iterable of Contact
    anchors : mapping of str to SE3
        Where the contacts' frames belong, as from `contact_placements`.
    tolerance : float, optional
        How far from its anchor a contact may stay, m; a sole's turn counts by the motion of its corners.
    steps : int, optional
        At most so many Newton steps.

    Returns
    -------
    q : ndarray, shape (..., nq)
    v : ndarray, shape (..., nv)
        In double precision.

    Raises
    ------
    SingularError
        If the contacts do not reach their anchors: out of reach, or too far away for Newton's method.
    NameNotFound, ShapeError, ValueError
        As `constraint_jacobian`; complex numbers; an anchor that is missing.

    Notes
    -----
    Section 49.9. Near a singular posture (straight knees) a target just out of reach has no solution near by, and one
    just within reach takes more steps.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> feet = [tw.PointContact(foot, 0.6) for foot in model.feet]
    >>> anchors = tw.contact_placements(model, model.standing(), feet)
    >>> drifted = model.integrate(model.standing(), np.full(model.nv, 1e-3))
    >>> q, v = tw.project_state(model, drifted, np.ones(model.nv), feet, anchors)
    >>> np.abs(tw.constraint_jacobian(model, q, feet) @ v).max() < 1e-12
    np.True_
    """
    steps = as_count(steps, "steps", 0)
    if not as_number(tolerance, "tolerance") >= 0:
        raise ValueError(f"tolerance: expected a number of at least 0, got {tolerance!r}")
    contacts = as_contacts(model, contacts)
    q, v, _ = real_state(model, q, v=v)
    for _ in range(steps + 1):
        terms = contact_terms(model, q, v, contacts)
        error = np.matvec(terms.W, contact_errors(contacts, terms.placement, anchors))
        far = np.asarray(np.abs(error).max(axis=-1, initial=0) > tolerance)
        if not far.any():
            return q, impact(model, q, v, contacts).v
        parts = decompose(model, terms.M, terms.W @ terms.J)
        way = -parts.unwhiten(parts.respond(error)[0])
        q = model.integrate(q, way) if isinstance(model, MimicModel) else integrate(model, q, way)
    left = {frame: float(np.abs(e).max()) for frame, e in per_contact(contacts, error[far][0]).items()}
    worst = max(left, key=lambda frame: left[frame])
    raise SingularError(
        f"the contacts do not come to their anchors in {steps} steps{at_first_index(far)}: "
        f"{worst!r} is {left[worst]:.3g} m away"
    )
