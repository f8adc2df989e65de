"""The full model, which the templates are held against (49.9, 49.10)."""

from __future__ import annotations

from typing import ClassVar

from ..arrays import Array
from .template import Template, full_rate

__all__ = ["Full"]


class Full(Template):
    """The full model: RNEA, whose base rows are ḣ_G less the weight, and whose other rows are the torques.

    What the other templates are compared with.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model, rest = tw.load("go2"), np.zeros(18)
    >>> bool(np.abs(Full.of(model, model.standing()).rate(model.standing(), rest, rest)).max() < 1e-12)
    True
    """

    name: ClassVar[str] = "full"
    assumes: ClassVar[str] = "Nothing."

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return the whole state."""
        return q, v, a

    def law(self, *known: Array) -> Array:
        """Return the base's rows of RNEA at the centre of mass, and the weight."""
        return full_rate(self.model, *known)
