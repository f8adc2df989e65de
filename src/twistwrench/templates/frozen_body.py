"""The single rigid body whose inertia does not follow the joints (49.10)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, convert
from ..model import Model
from .com_motion import locked_inertia
from .rigid_body import RigidBody
from .template import checked

__all__ = ["FrozenRigidBody"]


@dataclass(frozen=True, eq=False)
class FrozenRigidBody(RigidBody):
    """As `RigidBody`, but with the inertia of one configuration, the one the template was made at.

    Attributes
    ----------
    inertia : ndarray, shape (3, 3)
        About the centre of mass, in the base's axes, kg m².

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> FrozenRigidBody.of(model, model.standing()).inertia.diagonal().round(3)
    array([0.166, 0.501, 0.562])
    """

    inertia: Array = field(repr=False)

    name: ClassVar[str] = "srbm_frozen"
    assumes: ClassVar[str] = "The joints' motion has no angular momentum, and does not change the inertia either."

    @classmethod
    def of(cls, model: Model, q: ArrayLike) -> Self:
        """Make the template from a model and a configuration: see `Template.of`."""
        held = checked(model, q)
        return cls(*held, locked_inertia(model, held[1]))

    def _inertia(self, q: Array) -> Array:
        return np.broadcast_to(convert(self.inertia, q.dtype), (*q.shape[:-1], 3, 3))
