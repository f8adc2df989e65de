"""Forward dynamics under contact: M q̈ + h = Sᵀ τ + Jᵀ λ with J q̈ + J̇ v = 0 (49.9).

Among all accelerations that the contacts allow the robot takes the one nearest to that of its free motion, in the
metric of M (Gauss's principle of least constraint). The pseudo-inverse finds it in one step also where rows of J
depend on each other; a damped (proximal) solve would have to be iterated.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.mimic import MimicModel
from ..arrays import Array, as_number
from ..errors import SingularError
from ..model import Model
from ..spatial import SE3
from ..spatial._elementary import at_first_index
from .decomposition import decompose
from .relative import contact_errors, given_motion
from .rows import as_contacts, contact_terms, per_contact, real_state
from .types import Contact

__all__ = ["Baumgarte", "ContactDynamics", "contact_forward_dynamics"]

CONTRADICTION = 1e-8
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
    """What `contact_forward_dynamics` returns.

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
    contacts = as_contacts(model, contacts)
    q, v, others = real_state(model, q, f_ext, v=v, tau=tau)
    terms = contact_terms(model, q, v, contacts, **others)
    at, J, free = terms.placement, terms.J, terms.qdd
    W, slip = terms.W, np.matvec(J, v) - given_motion(contacts, "velocity")
    asked = given_motion(contacts, "acceleration")
    target = asked - terms.bias
    if stabilise is not None:
        if not isinstance(stabilise, Baumgarte):
            raise TypeError(f"stabilise: expected a Baumgarte or None, got {stabilise!r}")
        error = contact_errors(contacts, at, stabilise.anchors)
        target = target - 2 * stabilise.damping * stabilise.frequency * slip - stabilise.frequency**2 * error
    parts = decompose(model, terms.M, W @ J)
    qdd, mu = free, np.zeros(slip.shape)
    for _ in range(2):  # the second time removes the rounding of the first
        x, change = parts.respond(np.matvec(W, target - np.matvec(J, qdd)))
        qdd, mu = qdd + parts.unwhiten(x), mu + change
    residual = np.matvec(J, qdd) - target
    size = np.matvec(np.abs(W @ J), np.abs(free)).max(axis=-1, initial=0)
    if (largest(np.matvec(W, residual)) > CONTRADICTION * (size + largest(np.matvec(W, target)))).any():
        held = v - parts.unwhiten(parts.respond(np.matvec(W, slip))[0])  # and no drift to bring back
        wanted = np.matvec(W, asked - contact_terms(model, q, held, contacts).bias)
        refuse_contradiction(contacts, wanted - parts.within(wanted), CONTRADICTION * (size + largest(wanted)))
    forces = per_contact(contacts, np.matvec(W.mT, mu))
    return ContactDynamics(qdd, forces, parts.rank, J.shape[-2] - parts.rank, slip, residual)


def largest(x: Array) -> Array:
    """Return the largest magnitude over the last axis."""
    return np.asarray(np.abs(x).max(axis=-1, initial=0))


def refuse_contradiction(contacts: Sequence[Contact], left: Array, rounding: Array) -> None:
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
