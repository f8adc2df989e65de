"""What contacts have to do for a motion: the wrench that no motor gives, and the least forces that exert it (49.9)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.mimic import MimicModel
from ..arrays import Array, as_names
from ..errors import SingularError, check_known
from ..model import Model
from ..spatial._elementary import at_first_index
from .decomposition import Decomposition, decompose, point_map
from .limits import Limits, motor_limits
from .reach import Reach, reach
from .relative import given_motion
from .rows import as_contacts, contact_terms, per_contact, real_state
from .types import Contact, Pyramid

__all__ = ["ContactForces", "Task", "Unbalanced", "passive_entries"]

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
class Task:
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
    ) -> Task:
        """Set up and solve the rows without a motor; raise SingularError if no forces at these contacts do."""
        contacts = as_contacts(model, contacts)
        q, v, others = real_state(model, q, f_ext, v=v, a=a)
        terms = contact_terms(model, q, v, contacts, FEW, **others)
        J, b, P = terms.J, terms.tau, point_map(contacts, terms.placement)
        base = passive_entries(model, None) if passive is None else passive
        parts = decompose(model, terms.M[..., base[:, None], base], P.mT @ J[..., base])
        least = parts.balance(b[..., base])
        weight = terms.weight[..., base]
        left = b[..., base] - np.matvec(J[..., base].mT @ P, least)
        off, *sizes = (parts.size(x) for x in (left, b[..., base], weight))
        missed = np.asarray(off > BALANCED * np.maximum(*sizes))
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
