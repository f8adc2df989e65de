"""The whole robot of a scene: its base, its gravity, and where it stands."""

from __future__ import annotations

from dataclasses import replace
from os import PathLike

from numpy.typing import ArrayLike

from ..arrays import Array, as_exactly
from ..errors import ModelError, no_model
from ..loading import load
from ..model import Model, in_double, one_configuration

__all__ = ["posture", "whole_robot"]


def whole_robot(robot: str | PathLike[str] | Model, base: str | None, gravity: ArrayLike | None) -> Model:
    """Return the robot with the gravity of the scene, and with a floating base where the scene needs one."""
    if not isinstance(base, str | None) or base not in (None, "fixed", "floating", "planar"):
        raise ModelError(f"base: expected 'fixed', 'floating' or 'planar', got {base!r}")
    if not isinstance(robot, str | PathLike | Model):
        raise no_model(robot, "robot", "a name, a path or a Model")
    flies = base in ("floating", "planar")
    model = robot if isinstance(robot, Model) else load(robot, base="floating" if flies else None)
    if flies and model.base != "floating":
        raise ModelError(f"base: {model.name!r} has a fixed base, not a {base} one; load it with base='floating'")
    if gravity is None:
        return model
    return replace(model, gravity=as_exactly(gravity, "gravity", 3))


def posture(model: Model, q: ArrayLike | None) -> Array:
    """Return where a scene's robot stands: q, or the standing posture, or the neutral one."""
    if q is None:
        return model.standing() if "standing" in model.postures else model.neutral()
    return in_double(model, one_configuration(model, q))
