"""The rows of a set of contacts, and what the dynamics under contact need of a state, from one program (49.9)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms._mimic import also_of_mimics
from ..algorithms.mimic import MimicModel
from ..algorithms.rnea import rnea
from ..arrays import Array, as_sequence, check_kind
from ..errors import unknown_name
from ..fast.program import Results
from ..fast.programs import cached_program
from ..fast.quantities import Quantity, quantities
from ..fast.watch import with_watch
from ..model import Model, cast, check_model, check_state, in_double, joint_placements
from ..spatial import SE3, exp3
from .decomposition import row_scaling
from .relative import Posture, StateMotion
from .types import Contact

__all__ = [
    "ContactRows",
    "as_contacts",
    "constraint_bias",
    "constraint_jacobian",
    "contact_errors",
    "contact_placements",
    "contact_rows",
    "contact_terms",
    "every_joint",
    "given_motion",
    "moved",
    "moved_anchors",
    "per_contact",
    "real_state",
]


class ContactRows(NamedTuple):
    """The contacts' places in what holds them, their J and their J̇ v, in the order of the contacts."""

    placement: list[SE3]
    J: Array
    bias: Array


def contact_rows(model: Model, q: Array, v: Array, contacts: Sequence[Contact]) -> ContactRows:
    """Return the kinematics of all contacts."""
    state = StateMotion.of(model, q, v)
    J = [np.zeros((*q.shape[:-1], 0, model.nv), q.dtype)]
    bias = [np.zeros((*q.shape[:-1], 0), q.dtype)]
    at: list[SE3] = []
    for c in contacts:
        place, J_c, bias_c = c.kinematics(state)
        at.append(place)
        J.append(J_c)
        bias.append(bias_c)
    return ContactRows(at, np.concatenate(J, axis=-2), np.concatenate(bias, axis=-1))


@also_of_mimics
def constraint_jacobian(model: Model, q: ArrayLike, contacts: Iterable[Contact]) -> Array:
    """Return J of contacts of any kind: they are at rest where J v = 0.

    Parameters
    ----------
    model : Model or MimicModel
    q : array_like, shape (..., nq)
    contacts : iterable of Contact
        Of any kind: `PointContact`, `SurfaceContact`, `SphereContact`, `SlidingContact`, `LoopClosure`,
        `DistanceConstraint`, `Coupling`.

    Returns
    -------
    ndarray, shape (..., m, nv)
        In the order of the contacts, for each its rows of (ω, v) of its frame, in the axes of the world, or of the
        frame `to`; of a `SlidingContact` along its normals.

    Raises
    ------
    NameNotFound
        If the model has no such frame.
    ShapeError, ValueError
        As `Model.state`; or if an item is not a contact, or a frame is given twice or carried by the world.

    See Also
    --------
    twistwrench.contact_jacobian : the same of point contacts, by the names of their frames.

    Notes
    -----
    Section 49.9.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("humanoid")
    >>> soles = [tw.SurfaceContact(f"{side}_sole", (0.076, 0.0275), 0.6) for side in ("left", "right")]
    >>> tw.constraint_jacobian(model, model.neutral(), soles).shape
    (12, 27)
    """
    contacts = as_contacts(model, contacts)
    (q,) = model.state(q)
    return contact_rows(model, q, np.zeros(model.nv, q.dtype), contacts).J


@also_of_mimics
def constraint_bias(model: Model, q: ArrayLike, v: ArrayLike, contacts: Iterable[Contact]) -> Array:
    """Return J̇ v of contacts of any kind: their accelerations are J q̈ + J̇ v.

    Parameters
    ----------
    model : Model or MimicModel
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)
    contacts : iterable of Contact

    Returns
    -------
    ndarray, shape (..., m)
        In the order of the rows of `constraint_jacobian`: rad/s² and m/s², the linear ones classical.

    Raises
    ------
    NameNotFound, ShapeError, ValueError
        As `constraint_jacobian`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> bob = [tw.PointContact("bob", 0.6)]  # at 1 m, at 2 rad/s: ω² r towards the pivot
    >>> tw.constraint_bias(tw.load("pendulum"), [0.0], [2.0], bob).round(12)
    array([0., 0., 4.])
    """
    contacts = as_contacts(model, contacts)
    q, v = model.state(q, v=v)
    return contact_rows(model, q, v, contacts).bias


@also_of_mimics
def contact_placements(model: Model, q: ArrayLike, contacts: Iterable[Contact]) -> dict[str, SE3]:
    """Return where the contacts' frames are in what holds them: the anchors that later states are held against.

    Parameters
    ----------
    model : Model or MimicModel
    q : array_like, shape (..., nq)
    contacts : iterable of Contact

    Returns
    -------
    dict of str to SE3
        By the name of the frame: in the world, or in the frame `to`. Of a `Coupling` the translation
        (q − Σ ratio q, 0, 0), of a `DistanceConstraint` (d, 0, 0).

    Raises
    ------
    NameNotFound, ShapeError, ValueError
        As `constraint_jacobian`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> anchors = tw.contact_placements(model, model.standing(), [tw.PointContact("FR_foot", 0.6)])
    >>> anchors["FR_foot"].translation.round(3) + 0.0
    array([ 0.193, -0.142,  0.   ])
    """
    contacts = as_contacts(model, contacts)
    (q,) = check_state(model, q)
    at = Posture(model, q, joint_placements(model, q))
    return {c.frame: c.place(at) for c in contacts}


def contact_terms(
    model: Model | MimicModel, q: Array, v: Array, contacts: Sequence[Contact], after: int = 0, /, **others: Array
) -> Results:
    """Return the terms of the dynamics under contact, from one program, at first by the textbook: see `cached_program`.

    `placement`, J and `bias` of `ContactRows`, M and W, the `row_scaling`; with `tau` the q̈ of the free motion, `qdd`;
    with `a` the τ of the motion, and `weight`, that of rest. f_ext may be among the others.
    """
    if isinstance(model, MimicModel):
        return terms_of_leaders(model, q, v, contacts, after, **others)

    def of(symbol: str, arguments: str, function: Callable[..., Array]) -> Quantity:
        return Quantity(symbol, tuple(arguments.split()), lambda *x: (function(*x), []))

    def without_acceleration(q: Array, v: Array, f_ext: Array | None = None) -> Array:
        return rnea(model, q, v, 0 * v, f_ext)

    at_rest = tuple(replace(c, velocity=(), acceleration=()) if c.velocity or c.acceleration else c for c in contacts)  # type: ignore[type-var]

    def asked() -> list[Quantity]:
        known = quantities(model, q.dtype)
        rows = partial(contact_rows, model, contacts=at_rest)
        at = of("at", "q v", lambda q, v: np.stack([T.matrix() for T in rows(q, v).placement], axis=-3))
        return [
            *([at, of("W", "q v", lambda q, v: row_scaling(at_rest, rows(q, v).placement))] if contacts else []),
            Quantity("J", ("q", "v"), lambda q, v: with_watch(rows(q, v).J, contacts)),
            of("bias", "q v", lambda q, v: rows(q, v).bias),
            known["M"],
            *([known["qdd"]] if "tau" in others else []),
            *([known["tau"], of("weight", "q v f_ext", without_acceleration)] if "a" in others else []),
        ]

    key = ("contacts", q.dtype, at_rest, *(others.keys() - {"f_ext"}))
    found: Results = cached_program(model, key, q.dtype, asked, warmup_calls=after)(q, v, *others.values())
    at = np.moveaxis(found.at, -3, 0) if contacts else ()
    found.W = found.W if contacts else np.zeros((0, 0))
    found.placement = [SE3._trusted(T[..., :3, :3], T[..., :3, 3]) for T in at]
    return found


def terms_of_leaders(
    model: MimicModel, q: Array, v: Array, contacts: Sequence[Contact], after: int, **others: Array
) -> Results:
    """Return what `contact_terms` does where joints follow others: the terms of all joints, projected by G."""
    q, v = model.expand(q, v)
    asked, tau, G = dict(others), others.get("tau"), model.G
    if tau is not None:
        asked = {"a": np.zeros_like(v)} | {name: x for name, x in others.items() if name != "tau"}
    elif "a" in others:
        asked["a"] = np.matvec(G, others["a"])
    found = contact_terms(model.full, q, v, contacts, after, **asked)
    found.J, found.M = found.J @ G, G.mT @ found.M @ G
    if asked:
        found.tau, found.weight = np.matvec(G.mT, found.tau), np.matvec(G.mT, found.weight)
    if tau is not None:
        found.qdd = model._solve(found.M, tau - found.tau)
    return found


def every_joint(model: Model | MimicModel) -> Model:
    """Return the model of all joints, those that follow others included."""
    full = model.full if isinstance(model, MimicModel) else model
    check_model(full)
    return full


def as_contacts(model: Model | MimicModel, contacts: Iterable[Contact]) -> tuple[Contact, ...]:
    """Return contacts as a tuple, each on a frame of its own that moves in what holds it."""
    full = every_joint(model)
    if isinstance(contacts, str | Contact):
        raise ValueError(f"contacts: expected a sequence of contacts, got the single {contacts!r}")
    contacts = as_sequence(contacts, "contacts", "contacts", ordered=True)
    for c in contacts:
        if not isinstance(c, Contact):
            hint = f"; PointContact({c!r}, mu) makes one of a frame" if isinstance(c, str) else ""
            raise ValueError(f"contacts: expected contacts such as PointContact(frame, mu), got {c!r}{hint}")
        c.check(full)
    frames = [c.frame for c in contacts]
    twice = [name for name in dict.fromkeys(frames) if frames.count(name) > 1]
    if twice:
        raise ValueError(f"contacts: expected one contact on each frame, got more on {twice}")
    return contacts


def per_contact(contacts: Sequence[Contact], rows: Array) -> dict[str, Array]:
    """Cut a vector with one entry for each row of J into pieces by the names of the frames."""
    end = 0
    return {c.frame: rows[..., end : (end := end + c.dim)] for c in contacts}


def real_state(
    model: Model | MimicModel, q: ArrayLike, f_ext: ArrayLike | None = None, *, v: ArrayLike, **others: ArrayLike
) -> tuple[Array, Array, dict[str, Array]]:
    """Check a state as `Model.state` does, and bring it to double precision: the decompositions need it.

    Return q, v, and the others by name, f_ext among them where there is one. Of arrays of doubles only the shapes are
    checked: what is in them is watched by the programs that they go to next.
    """
    if f_ext is None and _are_plain(model, q, v, *others.values()):
        return q, v, others  # type: ignore[return-value]
    given = {"v": v, **others} | ({} if f_ext is None else {"f_ext": f_ext})
    q, *state = model.state(q, **given)
    if q.dtype.kind == "c":
        raise ValueError(f"q: expected real numbers in all arguments, got {q.dtype}")
    named = {name: x.astype(np.float64) for name, x in zip(given, state)}
    return in_double(model, q), named.pop("v"), named


def _are_plain(model: Model | MimicModel, q: ArrayLike, *others: ArrayLike) -> bool:
    """Return whether these are arrays of doubles of one batch shape, with the right last axes."""
    if not (type(q) is np.ndarray and q.dtype == np.float64 and q.shape[-1:] == (model.nq,)):
        return False
    shape = (*q.shape[:-1], model.nv)
    return all(type(x) is np.ndarray and x.dtype == np.float64 and x.shape == shape for x in others)


def given_motion(contacts: Sequence[Contact], name: str) -> Array:
    """Return the given velocities or accelerations of all contacts, in the order of the rows of J."""
    return np.concatenate([np.zeros(0), *(getattr(c, name) or np.zeros(c.dim) for c in contacts)])


def moved(contacts: tuple[Contact, ...], t: float) -> tuple[Contact, ...]:
    """Return contacts as they are after a time at their given, constant accelerations."""
    return tuple(
        replace(c, velocity=tuple((given_motion([c], "velocity") + t * np.array(c.acceleration)).tolist()))  # type: ignore[type-var]
        if c.acceleration
        else c
        for c in contacts
    )


def moved_anchors(model: Model, contacts: Sequence[Contact], anchors: Mapping[str, SE3], t: float) -> dict[str, SE3]:
    """Return where the contacts' frames belong after a time; a given turn goes about an axis that does not turn."""
    later = dict(anchors)
    for c in contacts:
        if (c.velocity or c.acceleration) and c.keeps_place(model):
            turns, more = (given_motion([c], name)[:3] for name in ("velocity", "acceleration"))
            if c.dim == 6 and np.cross(turns, more).any():
                raise ValueError(
                    f"contact {c.frame!r}: acceleration: expected one that turns about the axis of velocity, "
                    f"{turns.tolist()}, got {more.tolist()}"
                )
            way = t * given_motion([c], "velocity") + t**2 / 2 * given_motion([c], "acceleration")
            turn, shift = np.split(np.linalg.pinv(c.directions) @ way, 2)
            T = anchors[c.frame]
            later[c.frame] = SE3._trusted(exp3(turn) @ T.rotation, T.translation + shift)
    return later


def contact_errors(contacts: Sequence[Contact], now: Sequence[SE3], anchors: Mapping[str, SE3]) -> Array:
    """Return how far the contacts are from their anchors, in the order of the rows of J, rad and m."""
    check_kind(anchors, "anchors", Mapping, "placements by frame, as from contact_placements")
    missing = [c.frame for c in contacts if c.frame not in anchors]
    if missing:
        raise unknown_name("anchor", missing[0], anchors)
    parts = [np.zeros((*now[0].translation.shape[:-1], 0))] if now else [np.zeros(0)]
    for c, T in zip(contacts, now):
        check_kind(anchors[c.frame], f"anchors[{c.frame!r}]", SE3, "an SE3")
        anchor = cast(anchors[c.frame], np.float64)
        moved = T.translation - anchor.translation
        turned = c.held_turn(T.rotation @ anchor.rotation.mT) if c.placed[:, :3].any() else np.zeros_like(moved)
        parts.append(np.matvec(c.placed, np.concatenate([turned, moved], axis=-1)))
    return np.concatenate(parts, axis=-1)
