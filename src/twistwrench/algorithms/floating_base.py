"""The equation of a floating base: M q̈ + h = Sᵀ τ + J_cᵀ λ (49.9)."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_names, as_sequence, tolerance
from ..errors import SingularError
from ..model import FreeFlyer, Model, check_model, check_state, one_configuration
from ..spatial import SE3
from ..tables import html_table
from ._mimic import also_of_mimics
from .kinematics import frame_jacobian
from .rnea import gravity

__all__ = [
    "Equilibrium",
    "HeldRows",
    "as_frames",
    "as_held",
    "base_placement",
    "contact_jacobian",
    "selection_matrix",
    "static_equilibrium",
]


def selection_matrix(model: Model) -> Array:
    """Return S, which picks the actuated entries of v: Sᵀ τ are the motors' forces.

    Parameters
    ----------
    model : Model

    Returns
    -------
    ndarray, shape (n, nv)
        n = nv − 6 with a floating base, whose six entries have no motor; n = nv with a fixed base.

    Examples
    --------
    >>> import twistwrench as tw
    >>> S = tw.selection_matrix(tw.load("go2"))
    >>> S.shape, bool((S.T @ np.ones(12))[:6].any())
    ((12, 18), False)
    """
    check_model(model)
    return np.eye(model.nv)[_unactuated(model) :]


class HeldRows(Protocol):
    """Rows of J that a contact holds, of any kind in `twistwrench.contact`: what is asked of it here."""

    @abstractmethod
    def check(self, model: Model) -> None:
        """Raise an error if it is not one of this model."""

    @abstractmethod
    def jacobian(self, model: Model, q: Array) -> Array:
        """Return the rows that it holds, shape (..., dim, nv)."""


def _unactuated(model: Model) -> int:
    return 6 if model.base == "floating" else 0


@also_of_mimics
def contact_jacobian(model: Model, q: ArrayLike, contacts: Iterable[str | HeldRows]) -> Array:
    """Return J_c of point contacts: the velocities of the contact points are J_c v.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    contacts : iterable of str or Contact
        The frames at whose origins the robot touches its surroundings, or contacts of any kind.

    Returns
    -------
    ndarray, shape (..., 3 k, nv)
        For each of k frames the three linear rows, in the axes of the world; of a contact its own.

    Raises
    ------
    NameNotFound
        If the model has no such frame.
    ShapeError, ValueError
        As `Model.state`; or if `contacts` is a single string.

    Notes
    -----
    Section 49.9. The linear rows are the last three of our 6 × nv Jacobians and the first three of
    Pinocchio's; the chapter's listing in 49.11 takes the wrong ones, and a J_c of rank 9 for a
    robot that stands, 10 in general.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> J_c = tw.contact_jacobian(model, model.standing(), model.feet)
    >>> J_c.shape, int(np.linalg.matrix_rank(J_c))
    ((12, 18), 12)
    """
    (q,) = check_state(model, q)
    contacts = as_held(model, contacts)
    rows = [_held_rows(model, q, contact) for contact in contacts]
    return np.concatenate([np.zeros((*q.shape[:-1], 0, model.nv), q.dtype), *rows], axis=-2)


def _held_rows(model: Model, q: Array, contact: str | HeldRows) -> Array:
    if not isinstance(contact, str):
        return contact.jacobian(model, q)
    return frame_jacobian(model, q, contact, "local_world_aligned")[..., 3:, :]  # 49.9 J_c: the linear rows


def as_frames(contacts: Iterable[str | HeldRows]) -> tuple[str | HeldRows, ...]:
    """Return frames and contacts as a tuple."""
    return as_sequence(contacts, "contacts", "frame names", letters=False, ordered=True)


def as_held(model: Model, contacts: Iterable[str | HeldRows]) -> tuple[str | HeldRows, ...]:
    """Return frames and contacts as a tuple; raise an error for those that the model has not."""
    held: tuple[Any, ...] = as_frames(contacts)
    for contact in held:
        check = getattr(contact, "check", None)
        check(model) if callable(check) else model.frame(contact)
    return held


def base_placement(model: Model, q: Array) -> SE3:
    """Return the placement of a floating base in the world, at a checked q."""
    return model.constants(q.dtype).placement[1] @ FreeFlyer().transform(q[..., model.q_slice[1]])


@dataclass(frozen=True)
class Equilibrium:
    """Torques and contact forces of a robot at rest, from `static_equilibrium`.

    Attributes
    ----------
    tau : ndarray, shape (n,)
        Torques of the actuated joints, N m or N.
    forces : ndarray, shape (k, 3)
        Of the ground on each contact, in the axes of the world, N.
    contacts : tuple of str
        The frames of the k contacts, in the order of the rows of `forces`.
    """

    tau: Array
    forces: Array
    contacts: tuple[str, ...]

    def _repr_html_(self) -> str:
        forces = [[name, *(f"{round(float(x), 3) + 0.0:g}" for x in f)] for name, f in zip(self.contacts, self.forces)]
        table = html_table(("contact", "f_x [N]", "f_y [N]", "f_z [N]"), forces)
        return f"{table}<pre>tau = {np.array2string(self.tau, precision=4)} N m</pre>"


def static_equilibrium(model: Model, q: ArrayLike, contacts: Iterable[str] | None = None) -> Equilibrium:
    """Return the torques and the contact forces that hold a robot with a floating base at rest.

    The six base rows of g(q) = Sᵀ τ + J_cᵀ λ do not contain τ, so they give λ: of all solutions, the one of least norm.
    The other rows then give the torques. Forces may pull, and friction is ignored.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
        One real configuration. The least-squares problem is solved in float64.
    contacts : iterable of str, optional
        Frames that touch the ground; `model.feet` unless given.

    Returns
    -------
    Equilibrium
        tau, forces and the names of the contacts.

    Raises
    ------
    SingularError
        If no forces at these contacts balance the weight; the message gives the unbalanced wrench.
    NameNotFound, ShapeError, ValueError
        As `contact_jacobian`; or if the base is fixed, there are no contacts, or q is a batch or complex.

    Notes
    -----
    Section 49.9 and exercise 49.11.3, where the chapter leaves out Sᵀ τ.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> held = tw.static_equilibrium(model, model.standing())
    >>> held.forces[:, 2].sum().round(3)  # the feet carry the whole weight
    np.float64(157.794)
    """
    check_model(model)
    contacts = as_names(model.feet if contacts is None else contacts, "contacts", "frame names", ordered=True)
    if model.base != "floating":
        raise ValueError(
            f"{model.name!r}: expected a floating base, got a {model.base} one, which holds the robot; "
            'twistwrench.load(..., base="floating") makes it float, and gravity(model, q) are the torques as it is'
        )
    if not contacts:
        raise ValueError(f"{model.name!r}: expected at least one contact, got none")
    for name in contacts:
        model.frame(name)
    q = one_configuration(model, q)
    g, J_c = gravity(model, q), contact_jacobian(model, q, contacts)
    b = _unactuated(model)
    forces = np.linalg.lstsq(J_c[:, :b].mT.astype(np.float64), g[:b].astype(np.float64))[0].astype(q.dtype)
    left = g[:b] - J_c[:, :b].mT @ forces
    if np.abs(left).max() > tolerance(q.dtype) * np.abs(g[:b]).max():
        raise SingularError(f"no forces at {list(contacts)} balance the weight: (τ, f) = {left} is left over")
    return Equilibrium(tau=(g - J_c.mT @ forces)[b:], forces=forces.reshape(-1, 3), contacts=contacts)
