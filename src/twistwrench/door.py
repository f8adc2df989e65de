"""What every algorithm lets in: a model, and a state of it."""

from __future__ import annotations

from numpy.typing import ArrayLike

from .checks import Array
from .errors import no_model
from .model import Model

__all__ = ["check_model", "state_of"]


def check_model(model: object) -> None:
    """Refuse what is no model, where it comes in."""
    if not isinstance(model, Model):
        raise no_model(model)


def state_of(model: Model, q: ArrayLike, **others: ArrayLike | None) -> tuple[Array, ...]:
    """Check a model and a state of it: see `Model.state`."""
    check_model(model)
    return model.state(q, **others)
