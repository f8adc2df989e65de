"""The centroidal model: the whole momentum, and nothing about torques (49.10)."""

from __future__ import annotations

from typing import ClassVar

from ..algorithms.centroidal import centroidal_momentum_rate
from ..arrays import Array
from .template import Template

__all__ = ["Centroidal"]


class Centroidal(Template):
    """The rate of the whole centroidal momentum, ḣ_G = A_G a + Ȧ_G v: exact, but without the joints' torques.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model, rng = tw.load("go2"), np.random.default_rng(0)
    >>> v, a = rng.standard_normal((2, model.nv))
    >>> bool(Centroidal.of(model, model.standing()).residual(model.standing(), v, a).relative < 1e-13)
    True
    """

    name: ClassVar[str] = "centroidal"
    assumes: ClassVar[str] = "Nothing; it does not give the joints' torques."

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return the whole state."""
        return q, v, a

    def law(self, *known: Array) -> Array:
        """Return A_G a + Ȧ_G v."""
        return centroidal_momentum_rate(self.model, *known)
