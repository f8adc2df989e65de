"""A robot at rest on its contacts: whether it can stand there, and how far it is from slipping or tipping (49.9)."""

from __future__ import annotations

from collections.abc import Iterable
from copy import copy
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.centroidal import center_of_mass
from ..algorithms.mimic import MimicModel
from ..arrays import Array
from ..errors import ShapeError
from ..model import Model
from .rows import as_contacts, contact_placements, every_joint, real_state
from .task import ContactProblem, Unbalanced, contact_limits
from .types import Contact, Pyramid

__all__ = ["StanceMargins", "inside", "stance_margins"]

FRICTION_RTOL = 1e-6
MAX_FRICTION_MULTIPLE = 2.0**20
FRICTION_GROWTH = 2.0**9
"""By so much the multiple of the friction grows until it is enough."""


@dataclass(frozen=True)
class StanceMargins:
    """Margins of a stance against pulling, slipping and tipping, from `stance_margins`.

    Attributes
    ----------
    stands : bool
        Whether forces within the limits of the contacts hold the robot.
    friction_used : float
        The least multiple of the coefficients of friction with which it would stand: 0 where it needs none, 1 where it
        is about to slip, infinity where no multiple would do.
    tip : float
        Distance of the centre of mass, seen along gravity, from the edge of the support polygon, m; negative outside.
        On ground that is level, or rough enough, the robot tips where it is below zero.
    reason : str
        Why it cannot stand; empty where it can.
    point_forces : dict of str to ndarray, shape (k, 3), or None
        The proof that it stands: forces within the limits, by the contact's frame, at each of its contact points and
        in its own axes (z the normal), N. None where it cannot.
    falls : ndarray, shape (6,), or None
        The proof that it cannot: a twist (ω, v) of the base, in the base's axes, along which the weight does work and
        no force within the limits does any against it. Only its direction counts. None where it stands.
    """

    stands: bool
    friction_used: float
    tip: float
    reason: str
    point_forces: dict[str, Array] | None = field(default=None, repr=False, compare=False)
    falls: Array | None = field(default=None, repr=False, compare=False)


def stance_margins(
    model: Model | MimicModel, q: ArrayLike, contacts: Iterable[Contact], *, sides: int = 16, pyramid: Pyramid = "inner"
) -> StanceMargins:
    """Return whether a robot can stand in a pose without pulling or slipping, and the margins.

    The motors are taken as unlimited. Each answer comes with a proof: either forces within the limits that hold the
    robot, or a twist of the base along which the weight does work and no force within the limits does negative work.

    Parameters
    ----------
    model : Model or MimicModel
        With a floating base.
    q : array_like, shape (nq,)
        One configuration.
    contacts : iterable of Contact
        At least one.
    sides, pyramid : optional
        As `friction_inverse_dynamics`.

    Returns
    -------
    StanceMargins
        If it cannot stand, `reason` holds the reason; no exception is raised.

    Raises
    ------
    NameNotFound, ShapeError, ValueError
        As `friction_inverse_dynamics`; if the base is fixed, there are no contacts or no gravity, or a contact can also
        pull (a rail, a loop, gears).

    Notes
    -----
    Sections 49.9 and 49.4. The least friction is found to a millionth. On the edge, 1e-8 of the weight may stay
    unbalanced, in the metric of the inertia.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> feet = [tw.PointContact(foot, 0.6) for foot in model.feet]
    >>> margins = tw.stance_margins(model, model.standing(), feet)
    >>> margins.stands, margins.friction_used, round(margins.tip, 3)
    (True, 0.0, 0.142)
    >>> tw.stance_margins(model, model.standing(), feet[1:]).reason  # without FL
    ''
    """
    contacts = as_contacts(model, contacts)
    for c in contacts:
        if not c.pushes or c.to is not None:
            raise ValueError(f"contact {c.frame!r}: expected contacts with the ground that do not pull, got {c!r}")
    if model.base != "floating" or not contacts or not every_joint(model).gravity.any():
        raise ValueError(f"{model.name!r}: expected a floating base, gravity and at least one contact")
    q, rest, _ = real_state(model, q, v=np.zeros(model.nv))
    if q.ndim != 1:
        raise ShapeError(f"q: expected one configuration, shape ({model.nq},), got {q.shape}")
    contact_limits(contacts, sides, pyramid)  # raises for invalid `sides` and `pyramid` where it falls, too
    tip = tip_distance(model, q, contacts)  # type: ignore[arg-type]
    try:
        task = ContactProblem.of(model, q, rest, rest, contacts, None)
    except Unbalanced as error:
        return StanceMargins(False, np.inf, tip, f"it falls: {error}", falls=-error.away)
    answer = task.reach(sides, pyramid)
    used = friction_used(task, sides, pyramid, answer.reached)
    reason = ""
    if used == np.inf and friction_used(_rough(task), sides, pyramid, False) < np.inf:
        reason = "it slips: it would need friction where there is none"
    elif used == np.inf:
        where = f"is {-tip:.3g} m outside the support polygon" if tip < 0 else "is above the support polygon"
        reason = f"it tips: the centre of mass {where}, and some contact would have to pull"
    elif used > 1:
        reason = f"it slips: it would need {used:.3g} times the friction"
    if not answer.reached:
        return StanceMargins(False, used, tip, reason, falls=-answer.away)
    ends = np.cumsum([3 * len(c.points) for c in contacts])[:-1]
    at_points = {c.frame: f.reshape(-1, 3) for c, f in zip(contacts, np.split(answer.f, ends))}
    return StanceMargins(True, used, tip, reason, point_forces=at_points)


def friction_used(task: ContactProblem, sides: int, pyramid: Pyramid, stands: bool) -> float:
    """Return the least multiple of the coefficients of friction at which there are forces within the limits.

    At most 1 if it stands with the friction there is, and more if not.
    """
    start: Array | None = None

    def missing(multiple: float) -> tuple[float, float]:
        """Return how far the nearest forces are from holding the robot, and how fast that falls with the multiple."""
        nonlocal start
        found = task.reach(
            sides, pyramid, contacts=[_with_friction(c, multiple * c.mu) for c in task.contacts], start=start
        )
        start = found.used
        if found.reached:
            return 0.0, 0.0
        along = found.f.reshape(-1, 3) * [1, 1, 0]  # what grows with the multiple
        B = (task.J.mT @ task.P)[task.passive]
        left = found.away @ (task.b[task.passive] - B @ found.f)
        return float(left), float(found.away @ (B @ along.ravel()) / multiple) if multiple else 0.0

    if stands and missing(0.0)[0] == 0:
        return 0.0
    low, high = (0.0, 1.0) if stands else (1.0, 2.0)
    while not (high == 1.0 or missing(high)[0] == 0):
        low = high
        high = FRICTION_GROWTH * high
        if high > MAX_FRICTION_MULTIPLE:
            return np.inf
    guess = (low + high) / 2
    newton = True
    while high - low > FRICTION_RTOL * high:
        width, (left, slope) = high - low, missing(guess)
        low, high = (low, guess) if left == 0 else (guess, high)
        guess = guess + 1.0000001 * left / slope if left > 0 and slope > 0 else high * (1 - FRICTION_RTOL / 2)
        newton = high - low < width / 2 or not newton  # else halve the interval
        guess = guess if newton and low < guess < high else (low + high) / 2
    return high


def _rough(task: ContactProblem) -> ContactProblem:
    """Return the task with some friction at every contact, since multiples of zero stay zero."""
    return replace(task, contacts=tuple(_with_friction(c, 1.0) for c in task.contacts))


def _with_friction(contact: Contact, mu: float) -> Contact:
    other = copy(contact)
    object.__setattr__(other, "mu", mu)
    return other


def tip_distance(model: Model, q: Array, contacts: Iterable[Contact]) -> float:
    """Return how far inside the support polygon the centre of mass is, seen along gravity, m."""
    G = center_of_mass(model, q)
    places = contact_placements(model, q, contacts)
    points = np.concatenate(
        [T.translation + c.points @ c.axes(T.rotation).mT for c, T in zip(contacts, places.values())]
    )
    level = np.linalg.svd(every_joint(model).gravity[None])[2][1:]  # two axes across gravity
    return inside((points - G) @ level.mT)


def inside(points: Array) -> float:
    """Return how far the origin is inside the smallest convex polygon around points, shape (k, 2); outside, negative.

    An edge is a line through two points that has all others on its left. Outside, the nearest of all lines between two
    points is an edge.
    """
    start = np.repeat(points, len(points), 0)
    end = np.tile(points, (len(points), 1))
    along = end - start
    size = float(np.abs(points).max())
    length = np.hypot(*along.mT)
    start, along, length = (x[length > 1e-12 * size] for x in (start, along, length))
    if len(length) == 0:  # one point only
        return 0.0 - float(np.hypot(*points[0]))
    left = np.stack([-along[:, 1], along[:, 0]], axis=-1) / length[:, None]
    origin = -(start * left).sum(axis=-1)  # how far each line has the origin on its left
    others = points @ left.mT + origin
    edges = others.min(axis=0) >= -1e-12 * size
    if origin[edges].min() > 0:
        return float(origin[edges].min())
    share = np.clip(-(start * along).sum(axis=-1) / length**2, 0, 1)
    return 0.0 - float(np.hypot(*(start + share[:, None] * along).mT).min())
