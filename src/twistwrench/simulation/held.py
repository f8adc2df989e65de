"""What holds in every step of time stepping, pulling or pushing: loops, couplings, rails.

Their rows are equations beside the cones. All velocities that fulfil them are one of these plus what they leave free,
so that a step looks for its velocity in what is left: the metric of M is projected onto it. J is that in the middle of
the step, and J v at its end what the contact moves with there, J(q⁺) v⁺ = u. As J(q⁺) = J + ½ dt J̇, that is

    J v⁺ = u − ½ dt J̇ v,

and the impulses along the rows do no work on the mean of the velocities before and after. What is missing to third
order in dt is taken from v at the end.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..contact import Contact, contact_placements
from ..contact.decomposition import Decomposition, decompose
from ..contact.forward import jump
from ..contact.rows import contact_errors, contact_terms, given_motion, moved, moved_anchors, per_contact
from ..errors import SingularError
from ..model import Model
from ..spatial import SE3
from .straight import turning

__all__ = ["Held", "Rows"]

MAX_DRIFT_M = 1e-6
"""m: what is farther from its anchor after a step has come apart."""


class Rows(NamedTuple):
    """The equations W J v = u of one moment, in m/s, and their decomposition in a metric."""

    W: Array
    J: Array
    u: Array
    parts: Decomposition

    @property
    def span(self) -> Array:
        """Orthonormal columns: what the rows hold, in units of √(2 × kinetic energy)."""
        return self.parts.U[:, self.parts.s_inv > 0]

    def corrected(self, v: Array) -> Array:
        """Return the nearest velocity that fulfils the equations."""
        corrected: Array = v + self.parts.unwhiten(self.parts.respond(self.u - self.J @ v)[0])
        return corrected

    def balance(self, b: Array) -> Array:
        """Return the least λ with Jᵀ λ = b."""
        least: Array = self.W.mT @ self.parts.balance(b)
        return least


class Held(NamedTuple):
    """The contacts of a motion that hold, and where: the anchors have the batch axes of the motion."""

    model: Model
    contacts: tuple[Contact, ...]
    anchors: dict[str, SE3]

    @classmethod
    def beginning(cls, model: Model, contacts: Sequence[Contact], q: Array) -> Held:
        """Return contacts that hold from where they are in q, shape (..., nq)."""
        return cls(model, tuple(contacts), contact_placements(model, q, contacts))

    def at(self, item: tuple[int, ...]) -> Held:
        """Return those of one item of a batch."""
        one = {name: SE3(T.rotation[item], T.translation[item]) for name, T in self.anchors.items()}
        return self._replace(anchors=one)

    def velocity_rows(self, q: Array, v: Array, M: Array, dt: float, since: float) -> Rows:
        """Return the rows in the middle of a step of dt that ends at the time `since`, in the metric of M."""
        contacts = moved(self.contacts, since)
        terms = contact_terms(self.model, q, v, contacts)
        bias = terms.bias - terms.J @ turning(self.model, v)  # in axes that stand still
        u = terms.W @ (given_motion(contacts, "velocity") - dt / 2 * bias)
        return Rows(terms.W, terms.W @ terms.J, u, decompose(self.model, M, terms.W @ terms.J))

    def position_rows(self, q: Array, since: float) -> Rows:
        """Return the rows that lead back to the anchors: u is how far they are, m."""
        terms = contact_terms(self.model, q, np.zeros(self.model.nv), self.contacts)
        anchors = moved_anchors(self.model, self.contacts, self.anchors, since)
        far = terms.W @ contact_errors(self.contacts, terms.placement, anchors)
        return Rows(terms.W, terms.W @ terms.J, -far, decompose(self.model, terms.M, terms.W @ terms.J))

    def settle(self, q: Array, v: Array, since: float) -> Array:
        """Return the nearest velocity with which the contacts move as what they hold to, where they are now."""
        contacts = moved(self.contacts, since)
        return jump(self.model, v, contacts, contact_terms(self.model, q, v, contacts)).v

    def check_drift(self, rows: Rows) -> None:
        """Raise SingularError where a contact has not come back to its anchor."""
        left = {frame: float(np.abs(u).max()) for frame, u in per_contact(self.contacts, rows.u).items()}
        worst = max(left, key=lambda frame: left[frame], default="")
        if worst and left[worst] > MAX_DRIFT_M:
            raise SingularError(f"contact {worst!r} comes apart by {left[worst]:.3g} m; a smaller dt?")
