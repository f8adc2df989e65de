"""The point mass: all of the robot's mass at its centre, and no angular momentum (49.10)."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from ..arrays import Array
from .com_motion import com_acceleration, force
from .template import Template

__all__ = ["PointMass"]


class PointMass(Template):
    """A point of the robot's mass at its centre of mass: l̇_G = m p̈_G, k̇_G = 0.

    The force is exact, whatever the joints do. The moment is left out.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> template, rest = PointMass.of(model, model.standing()), np.zeros(model.nv)
    >>> falling = tw.aba(model, model.standing(), rest, rest)
    >>> template.rate(model.standing(), rest, falling).round(3) + 0.0
    array([   0.   ,    0.   ,    0.   ,    0.   ,    0.   , -157.794])
    """

    name: ClassVar[str] = "point_mass"
    assumes: ClassVar[str] = "The angular momentum stays as it is."

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return p̈_G."""
        return (com_acceleration(self.model, q, v, a),)

    def law(self, *known: Array) -> Array:
        """Return (0, m p̈_G)."""
        (p_ddot,) = known
        return np.concatenate([np.zeros_like(p_ddot), force(self.model, p_ddot)], axis=-1)
