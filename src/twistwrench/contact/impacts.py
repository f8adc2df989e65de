"""Impacts: the jump of the velocities in the instant in which contacts close, M (v⁺ − v⁻) = Jᵀ Λ (49.9)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.mimic import MimicModel
from ..arrays import Array, as_number
from ..fast.program import Results
from ..model import Model
from .decomposition import decompose
from .relative import given_motion
from .rows import as_contacts, contact_terms, per_contact, real_state
from .types import Contact

__all__ = ["Impact", "impact", "jump"]


@dataclass(frozen=True)
class Impact:
    """What `impact` returns.

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
    contacts = as_contacts(model, contacts)
    q, v, _ = real_state(model, q, v=v)
    return jump(model, v, contacts, contact_terms(model, q, v, contacts), restitution)


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
