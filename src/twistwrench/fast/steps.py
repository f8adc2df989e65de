"""Steps q ⊕ u as programs: what a simulation does as often as it asks for an acceleration (49.2, 49.3)."""

from __future__ import annotations

import numpy as np

from ..arrays import Array
from ..model import Model
from .programs import cached_program
from .quantities import Quantity

__all__ = ["integrate", "turns"]


def integrate(model: Model, q: Array, u: Array) -> Array:
    """Return what `Model.integrate` does, of real arrays: q ⊕ u, by a program.

    It has the series of the sines, and needs no question; where the joints turn by more than a radian together it is
    the textbook that goes the step.
    """

    def step(q: Array, u: Array) -> tuple[Array, list[object]]:
        return (model._step(q, u), turns(model, u)) if u.dtype == object else (model.integrate(q, u), [])

    asked = Quantity("q", ("q", "v"), step)
    there: Array = cached_program(model, ("step", u.dtype), u.dtype, lambda: [asked], single=True)(q, u)
    return there


def turns(model: Model, u: Array) -> list[object]:
    """Return the angular entries of a step u of each joint that is a group: their squares are the angle's."""
    parts = zip(model.joints, model.v_slice)
    turning = [np.matvec(joint.subspace(object)[:3], u[s]) for joint, s in parts if joint and joint.unit is not None]
    return [entry for w in turning for entry in w]
