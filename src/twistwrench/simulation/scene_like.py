"""What `simulate` needs of a scene, which comes later in the order of the rooms."""

from __future__ import annotations

from abc import abstractmethod
from typing import Protocol

from numpy.typing import ArrayLike

from ..arrays import Array
from ..contact import Contact
from ..errors import no_model
from ..model import Model
from .system import Push

__all__ = ["SceneLike", "parts"]


class SceneLike(Protocol):
    """A model with contacts, and wrenches from outside."""

    model: Model
    contacts: tuple[Contact, ...]

    @abstractmethod
    def f_ext(self, q: ArrayLike) -> Array:
        """Return the wrenches on the bodies in a configuration, shape (..., nbodies, 6)."""


def parts(robot: Model | SceneLike) -> tuple[Model, tuple[Contact, ...], Push | None]:
    """Return the model, the contacts and the wrenches of a scene; of a model alone, only the model."""
    if isinstance(robot, Model):
        return robot, (), None
    if not hasattr(robot, "f_ext"):
        raise no_model(robot, "robot", "a Model or a Scene")
    return robot.model, robot.contacts, robot.f_ext
