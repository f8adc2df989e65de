"""Input validation of every algorithm: a model, and a state of it."""

from __future__ import annotations

from numpy.typing import ArrayLike

from ..arrays import Array
from ..errors import ShapeError, no_model
from .model import Model
from .state import check_entries

__all__ = ["check_model", "check_state", "floats_of", "one_configuration"]


def check_model(model: object) -> None:
    """Raise TypeError for what is not a model, where it is given."""
    if not isinstance(model, Model):
        raise no_model(model)


def check_state(model: Model, q: ArrayLike, **others: ArrayLike | None) -> tuple[Array, ...]:
    """Check a model and a state of it, in numbers of any type: see `Model.state` and `exact`."""
    check_model(model)
    return check_entries(model, True, q=q, **others)


def floats_of(model: Model, q: ArrayLike, **others: ArrayLike | None) -> tuple[Array, ...]:
    """Check a model and a state of it, in floating-point numbers: see `Model.state`."""
    check_model(model)
    return model.state(q, **others)


def one_configuration(model: Model, q: ArrayLike) -> Array:
    """Check a model and one configuration of it, real and without batch axes, shape (nq,)."""
    (q,) = floats_of(model, q)
    if q.ndim != 1 or q.dtype.kind == "c":
        raise ShapeError(f"q: expected one real configuration, shape ({model.nq},), got {q.dtype} of shape {q.shape}")
    return q
