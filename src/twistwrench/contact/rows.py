"""The rows of a set of contacts: how fast their frames move, J v, and how that changes, J q̈ + J̇ v (49.9).

All in the axes of the world, at the origin of each contact's frame, in the order of the contacts. J v is then the
velocity of a point that goes along with the robot, and its rate is that point's classical acceleration: it is
zero where the point is at rest, not the linear half of the spatial acceleration, which is ω × v less.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.kinematics import frame_placement, motion, placements
from ..algorithms.rnea import rnea
from ..arrays import Array, as_sequence, check_kind
from ..compiler import Results
from ..compiler.quantities import Quantity, quantities
from ..errors import unknown_name
from ..fast.programs import remembered
from ..model import Model, Tree, cast, check_model, columns, in_double, tree_terms
from ..spatial import SE3, log3
from .decomposition import lever
from .types import Contact

__all__ = [
    "ContactRows",
    "as_contacts",
    "constraint_bias",
    "constraint_jacobian",
    "contact_errors",
    "contact_placements",
    "contact_rows",
    "per_contact",
    "real_state",
]


def constraint_jacobian(model: Model, q: ArrayLike, contacts: Iterable[Contact]) -> Array:
    """Return J of contacts of any kind: they are at rest where J v = 0.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    contacts : iterable of Contact
        `PointContact` or `SurfaceContact`.

    Returns
    -------
    ndarray, shape (..., m, nv)
        In the order of the contacts, for each its rows of (ω, v) of its frame, in the axes of the world.

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


def constraint_bias(model: Model, q: ArrayLike, v: ArrayLike, contacts: Iterable[Contact]) -> Array:
    """Return J̇ v of contacts of any kind: their accelerations are J q̈ + J̇ v.

    Parameters
    ----------
    model : Model
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


def contact_placements(model: Model, q: ArrayLike, contacts: Iterable[Contact]) -> dict[str, SE3]:
    """Return where the contacts' frames are: the anchors that later states are held against.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    contacts : iterable of Contact

    Returns
    -------
    dict of str to SE3
        By the name of the frame, in the world.

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
    return {c.frame: frame_placement(model, q, c.frame) for c in as_contacts(model, contacts)}


class ContactRows(NamedTuple):
    """Where the contacts' frames are in the world, their J and their J̇ v."""

    placement: list[SE3]
    J: Array
    bias: Array


def contact_rows(model: Model, q: Array, v: Array, contacts: Sequence[Contact]) -> ContactRows:
    """Return the kinematics of all contacts, from one pass over the tree."""
    tree = tree_terms(model, q)
    bodies = placements(model.parent, tree.placement)
    V, A = motion(tree, columns(model, v), columns(model, np.zeros_like(v)))
    place: list[SE3] = []
    J = [np.zeros((*q.shape[:-1], 0, model.nv), q.dtype)]
    bias = [np.zeros((*q.shape[:-1], 0), q.dtype)]
    for c in contacts:
        body, own = model.frame(c.frame).body, cast(model.frame(c.frame).placement, q.dtype)
        place.append(bodies[body] @ own)
        J.append(_jacobian(model, bodies, tree, body, own.translation)[..., c.rows, :])
        bias.append(_bias(bodies[body], V[body][..., 0], A[body][..., 0], own.translation)[..., c.rows])
    return ContactRows(place, np.concatenate(J, axis=-2), np.concatenate(bias, axis=-1))


def contact_terms(
    model: Model, q: Array, v: Array, contacts: Sequence[Contact], after: int = 0, /, **others: Array
) -> Results:
    """Return what the dynamics under contact need, from one program, the first times by the textbook: see `remembered`.

    `placement`, J and `bias` of `ContactRows`, M and W, the `lever`; with `tau` the q̈ of the free motion, `qdd`; with
    `a` the τ of the motion, and `weight`, that of rest. f_ext may be among the others.
    """

    def of(symbol: str, arguments: str, function: Callable[..., Array]) -> Quantity:
        return Quantity(symbol, tuple(arguments.split()), lambda *x: (function(*x), []))

    def at_rest(q: Array, v: Array, f_ext: Array | None = None) -> Array:
        return rnea(model, q, v, 0 * v, f_ext)

    def asked() -> list[Quantity]:
        known, rows = quantities(model, q.dtype), partial(contact_rows, model, contacts=contacts)
        at = of("at", "q v", lambda q, v: np.stack([T.matrix() for T in rows(q, v).placement], axis=-3))
        return [
            *([at, of("W", "q v", lambda q, v: lever(contacts, rows(q, v).placement))] if contacts else []),
            of("J", "q v", lambda q, v: rows(q, v).J),
            of("bias", "q v", lambda q, v: rows(q, v).bias),
            known["M"],
            *([known["qdd"]] if "tau" in others else []),
            *([known["tau"], of("weight", "q v f_ext", at_rest)] if "a" in others else []),
        ]

    key = ("contacts", q.dtype, tuple(contacts), *(others.keys() - {"f_ext"}))
    found: Results = remembered(model, key, q.dtype, asked, after=after)(q, v, *others.values())
    at = np.moveaxis(found.at, -3, 0) if contacts else ()
    found.W = found.W if contacts else np.zeros((0, 0))
    found.placement = [SE3._trusted(T[..., :3, :3], T[..., :3, 3]) for T in at]
    return found


def _jacobian(model: Model, bodies: Sequence[SE3], tree: Tree, body: int, point: Array) -> Array:
    """Return the rows (ω, v) of a point of a body, in the axes of the world, shape (..., 6, nv).

    The point is expressed in one body after the other: a difference of positions in the world would lose digits far
    from its origin, and with them the rank.
    """
    J = np.zeros((*bodies[0].translation.shape[:-1], 6, model.nv), point.dtype)
    for i in model.support(body):
        S = tree.S[i]
        turn, shift = S[:3], S[3:] + np.cross(S[:3], point[..., None], axis=-2)
        J[..., :3, model.v_slice[i]] = bodies[i].rotation @ turn
        J[..., 3:, model.v_slice[i]] = bodies[i].rotation @ shift
        point = tree.placement[i].act(point)
    return J


def _bias(at: SE3, V: Array, A: Array, arm: Array) -> Array:
    """Return (α, a) of a point of a body without q̈, in the axes of the world, shape (..., 6).

    From the body's spatial acceleration A: its origin's classical one is ω × v more.
    """
    w, alpha = V[..., :3], A[..., :3]
    a = A[..., 3:] + np.cross(w, V[..., 3:]) + np.cross(alpha, arm) + np.cross(w, np.cross(w, arm))
    return np.concatenate([np.matvec(at.rotation, alpha), np.matvec(at.rotation, a)], axis=-1)


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
        turned = log3(T.rotation @ anchor.rotation.mT) if c.rows.start < 3 else np.zeros_like(moved)
        parts.append(np.concatenate([turned, moved], axis=-1)[..., c.rows])
    return np.concatenate(parts, axis=-1)


def as_contacts(model: Model, contacts: Iterable[Contact]) -> tuple[Contact, ...]:
    """Return contacts as a tuple, each on a frame of its own that the robot carries."""
    check_model(model)
    if isinstance(contacts, str | Contact):
        raise ValueError(f"contacts: expected a sequence of contacts, got the single {contacts!r}")
    contacts = as_sequence(contacts, "contacts", "contacts", ordered=True)
    for c in contacts:
        if not isinstance(c, Contact):
            hint = f"; PointContact({c!r}, mu) makes one of a frame" if isinstance(c, str) else ""
            raise ValueError(f"contacts: expected PointContact or SurfaceContact, got {c!r}{hint}")
        if model.frame(c.frame).body == 0:
            raise ValueError(f"contact {c.frame!r}: the world carries this frame; it cannot touch anything")
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
    model: Model, q: ArrayLike, f_ext: ArrayLike | None = None, *, v: ArrayLike, **others: ArrayLike
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


def _are_plain(model: Model, q: ArrayLike, *others: ArrayLike) -> bool:
    """Return whether these are arrays of doubles of one batch shape, with the right last axes."""
    if not (type(q) is np.ndarray and q.dtype == np.float64 and q.shape[-1:] == (model.nq,)):
        return False
    shape = (*q.shape[:-1], model.nv)
    return all(type(x) is np.ndarray and x.dtype == np.float64 and x.shape == shape for x in others)
