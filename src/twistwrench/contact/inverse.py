"""Inverse dynamics under contact: which joint forces and contact forces make the robot move as it should (49.9).

The six base rows of M q̈ + h = Sᵀ τ + Jᵀ λ have no τ: they determine the total wrench of the contacts. Of all forces at
the contact points that exert it the least are chosen, without limits or within the friction cones; τ follows.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_flag
from ..errors import ShapeError, SingularError
from ..model import Model
from ..spatial._elementary import at_first_index
from .decomposition import Decomposition, decompose, point_map
from .limits import Limits, contact_limits, motor_limits
from .qp import least_breach, least_within
from .reach import NEAR, Reach, reach
from .rows import as_contacts, contact_terms, per_contact, real_state
from .types import Contact, Pyramid

__all__ = ["ContactForces", "Task", "contact_inverse_dynamics", "friction_inverse_dynamics"]

FEW = 20
"""So many times the textbook is asked: whether a robot stands is often asked once, and not of these contacts again."""

BALANCED = 1e-8
"""Tolerance of the base's wrench, relative to it; rounding stays far below."""


@dataclass(frozen=True)
class ContactForces:
    """What `contact_inverse_dynamics` and `friction_inverse_dynamics` return.

    Attributes
    ----------
    tau : ndarray, shape (..., nv)
        Joint forces as `aba` takes them, N m or N; the six of a floating base are zero.
    forces : dict of str to ndarray, shape (..., 3) or (..., 6)
        λ on the robot, by the contact's frame: f, or (τ, f), at the frame's origin in the axes of the world, N m and N.
    binding : tuple of str
        The active limits, by names; empty where no limits were requested.
    residual : ndarray, shape (..., m)
        J a + J̇ v, the acceleration of the contacts under `a`: zero if they stay at rest, rad/s² and m/s².
    """

    tau: Array
    forces: dict[str, Array]
    binding: tuple[str, ...]
    residual: Array


def contact_inverse_dynamics(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    contacts: Iterable[Contact],
    f_ext: ArrayLike | None = None,
) -> ContactForces:
    """Return the joint forces and the least contact forces of a motion: M a + h = Sᵀ τ + Jᵀ λ.

    Forces may pull, and friction is ignored. With a fixed base the joints do all, and λ = 0 is the least.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v, a : array_like, shape (..., nv)
    contacts : iterable of Contact
    f_ext : array_like, shape (..., nbodies, 6), optional
        Wrench (τ, f) on each body from outside, as `rnea`.

    Returns
    -------
    ContactForces
        In double precision. The forces are the least at the contact points: of a sole, at its corners.

    Raises
    ------
    SingularError
        If no forces at these contacts make the base move so; the message gives the unbalanced wrench.
    NameNotFound, ShapeError, ValueError
        As `constraint_jacobian`; complex numbers.

    See Also
    --------
    twistwrench.friction_inverse_dynamics : the same within the friction cones.

    Notes
    -----
    Section 49.9. Moments and forces are weighed against each other by the inertia of the robot as one rigid body, so
    that no unit decides the rank.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> rest, feet = np.zeros(model.nv), [tw.PointContact(foot, 0.6) for foot in model.feet]
    >>> held = tw.contact_inverse_dynamics(model, model.standing(), rest, rest, feet)
    >>> sum(held.forces.values()).round(3) + 0.0
    array([  0.   ,   0.   , 157.794])
    """
    task = Task.of(model, q, v, a, contacts, f_ext)
    return task.result(model, task.least, ())


def friction_inverse_dynamics(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    contacts: Iterable[Contact],
    f_ext: ArrayLike | None = None,
    *,
    sides: int = 8,
    pyramid: Pyramid = "inner",
    effort_limits: bool = False,
) -> ContactForces:
    """Return the joint forces and the least contact forces within the friction cones: a quadratic programme.

    No contact pulls, none slips, and the pressure on a sole stays within it. Quicker with the extra
    ``pip install "twistwrench[qp]"``, where the least forces alone are not within the limits.

    Parameters
    ----------
    model : Model
    q : array_like, shape (nq,)
        One state.
    v, a : array_like, shape (nv,)
    contacts : iterable of Contact
    f_ext : array_like, shape (nbodies, 6), optional
    sides : int, optional
        Of the pyramids that stand for the cones, at least 3. An inner pyramid has its sides at cos(π/sides) of μ: at
        71 % with 4, at 92 % with 8, at 98 % with 16.
    pyramid : {"inner", "outer"}, optional
        Inner: forces that are found are within the cones. Outer: if none are found, none exist in the cones.
    effort_limits : bool, optional
        Keep each joint force within `Model.effort_limit`, too: contacts take what a motor cannot hold.

    Returns
    -------
    ContactForces
        In double precision.

    Raises
    ------
    SingularError
        If no forces within the limits make the robot move so; the message names the limits that are violated.
    NameNotFound, ShapeError, ValueError
        As `contact_inverse_dynamics`; a batch; less than 3 sides; a pyramid that is neither.

    Notes
    -----
    Sections 49.9 and 49.4. A motion is possible if forces within the limits miss the base's wrench by at most 1e-8 of
    it. Where they only just reach it, they are feasible forces, not the least.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> a, feet = np.zeros(model.nv), [tw.PointContact(foot, 0.6) for foot in model.feet]
    >>> a[3] = 5.0  # m/s², forwards
    >>> push = tw.friction_inverse_dynamics(model, model.standing(), 0 * a, a, feet)
    >>> bool(push.forces["RL_foot"][0] <= 0.6 * push.forces["RL_foot"][2])
    True
    """
    task = Task.of(model, q, v, a, contacts, f_ext)
    if task.least.ndim != 1:
        asked = "q, v, a" if f_ext is None else "q, v, a, f_ext"
        raise ShapeError(f"{asked}: expected one state, got a batch of shape {task.least.shape[:-1]}")
    effort_limits = as_flag(effort_limits, "effort_limits")
    motors = task.motors(model) if effort_limits else None
    rows, free = contact_limits(task.contacts, sides, pyramid), task.free
    rows = rows.join(motors) if motors else rows
    A, b = rows.A @ free, rows.b - rows.A @ task.least
    found = least_within(A, b, task.size)
    if found is not None:
        z, tight = found
        f = task.least + free @ z
    else:  # no forces, or barely some
        answer = task.reach(sides, pyramid, motors)
        if not answer.reached:
            worst = rows.breached(least_breach(A, b, task.size))
            raise SingularError(f"cannot: no forces within the limits do this; they would have to break {worst}")
        f, tight = answer.f, rows.A @ answer.f - rows.b > -NEAR * task.size
    binding = tuple(dict.fromkeys(name for name, leans in zip(rows.names, tight) if leans))
    return task.result(model, f, binding)


class Unbalanced(SingularError):
    """No forces at the contacts, even pulling ones, balance the base's wrench; ``left`` is the unbalanced part."""

    def __init__(self, message: str, left: Array, L: Array) -> None:
        super().__init__(message)
        self.away = np.linalg.solve(L.mT, np.linalg.solve(L, left[..., None]))[..., 0]


@dataclass(frozen=True)
class Task:
    """The total wrench that the contacts must exert, and the least forces f at their points that do.

    f has three entries for each point, in the axes of its contact; ``free`` spans what may be added to it. ``size`` is
    the size of such forces, N, and ``asked`` that of their total wrench, in the metric of M: the larger of this
    motion's and of the weight's.
    """

    contacts: tuple[Contact, ...]
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
        model: Model,
        q: ArrayLike,
        v: ArrayLike,
        a: ArrayLike,
        contacts: Iterable[Contact],
        f_ext: ArrayLike | None,
    ) -> Task:
        """Set up and solve the base rows; raise SingularError if no forces at these contacts do."""
        contacts = as_contacts(model, contacts)
        q, v, others = real_state(model, q, f_ext, v=v, a=a)
        terms = contact_terms(model, q, v, contacts, FEW, **others)
        J, b, P = terms.J, terms.tau, point_map(contacts, terms.placement)
        base = slice(0, 6 if model.base == "floating" else 0)
        parts = decompose(model, terms.M[..., base, base], P.mT @ J[..., base])
        least = parts.balance(b[..., base])
        weight = terms.weight[..., base]
        left = b[..., base] - np.matvec(J[..., base].mT @ P, least)
        off, *sizes = (parts.size(x) for x in (left, b[..., base], weight))
        missed = np.asarray(off > BALANCED * np.maximum(*sizes))
        if missed.any():
            names = [c.frame for c in contacts]
            over = ", ".join(f"{x:.3g}" for x in left[missed][0])
            raise Unbalanced(
                f"no forces at {names} do this{at_first_index(missed)}: (τ, f) = ({over}) is left over", left, parts.L
            )
        size = max(float(np.abs(f).max(initial=0)) for f in (least, parts.balance(weight)))
        asked = float(np.maximum(*sizes).max(initial=0))  # where neither is anything, any unit will do
        return cls(contacts, b, J, P, parts, least, size or 1.0, asked or 1.0, np.matvec(J, others["a"]) + terms.bias)

    def reach(
        self, sides: int, pyramid: Pyramid, also: Limits | None = None, contacts: Sequence[Contact] = ()
    ) -> Reach:
        """Return whether forces within the limits do this, and the proof, whose twist is the base's in b's order.

        Of the task's contacts, or of others at the same points; `also` are more limits.
        """
        base = slice(0, len(self.parts.L))
        G, w = (np.linalg.solve(self.parts.L, x) for x in ((self.J.mT @ self.P)[base], self.b[base]))
        more = None if also is None else (also.A, also.b / self.size)
        found = reach(G * self.size / self.asked, w / self.asked, contacts or self.contacts, sides, pyramid, more)
        return found._replace(f=self.size * found.f, away=np.linalg.solve(self.parts.L.mT, found.away))

    def motors(self, model: Model) -> Limits:
        """Return the limits of the motors, as limits of the forces."""
        return motor_limits(model, self.b, self.J.mT @ self.P)

    @property
    def free(self) -> Array:
        """Return the internal forces, which exert no wrench, as orthonormal columns, shape (3 k, ...)."""
        V = self.parts.V[:, self.parts.s_inv > 0]
        return np.linalg.qr(V, mode="complete")[0][:, V.shape[1] :]

    def result(self, model: Model, f: Array, binding: tuple[str, ...]) -> ContactForces:
        """Return joint forces and contact forces of the forces f at the points."""
        force = np.matvec(self.P, f)
        tau = self.b - np.matvec(self.J.mT, force)
        if model.base == "floating":
            tau[..., :6] = 0
        return ContactForces(tau, per_contact(self.contacts, force), binding, self.residual)
