"""The single rigid body (SRBM): the whole robot turns as its base does (49.10)."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from ..algorithms.floating_base import base_placement
from ..arrays import Array
from .com_motion import com_acceleration, force, locked_inertia
from .template import Template

__all__ = ["RigidBody"]


class RigidBody(Template):
    """One rigid body that turns as the base does, with the inertia that the robot has in each configuration.

    l̇_G = m p̈_G and k̇_G = R (I ω̇ + ω × I ω): R places the base, ω is its angular velocity in its own axes, and I is the
    inertia about the centre of mass of the robot with its joints locked at q. What the joints' own motion does to the
    angular momentum is left out.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model, q = tw.load("go2"), tw.load("go2").standing()
    >>> turning = np.array([1.0, 2, 3, 0, 0, 0, *np.zeros(12)])  # with joints that are still: it is a rigid body
    >>> bool(RigidBody.of(model, q).residual(q, turning, 5 * turning).relative < 1e-13)
    True
    """

    name: ClassVar[str] = "srbm"
    assumes: ClassVar[str] = "The joints' motion has no angular momentum."

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return q, R, ω, ω̇ and p̈_G."""
        R = base_placement(self.model, q).rotation
        return q, R, v[..., :3], a[..., :3], com_acceleration(self.model, q, v, a)

    def law(self, *known: Array) -> Array:
        """Return (R (I ω̇ + ω × I ω), m p̈_G)."""
        q, R, w, w_dot, p_ddot = known
        I = self._inertia(q)
        k_dot = np.matvec(R, np.matvec(I, w_dot) + np.cross(w, np.matvec(I, w)))
        return np.concatenate([k_dot, force(self.model, p_ddot)], axis=-1)

    def _inertia(self, q: Array) -> Array:
        return locked_inertia(self.model, q)
