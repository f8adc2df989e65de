"""What every model must satisfy, whoever makes it: `Builder`, a loader, the bridge, or `dataclasses.replace`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_constant, check_kind
from ..errors import ModelError, ShapeError
from ..spatial import SE3, SpatialInertia
from .joint import Joint, check_subspace

__all__ = ["PER_DOF", "UNLIMITED", "WORLD", "as_entries", "check_body", "check_limits", "check_name", "check_placement"]

WORLD = "universe"
"""The name of the world, which carries the root; nothing else may have it."""

PER_DOF = ("armature", "velocity_limit", "effort_limit", "damping", "friction")
"""The attributes of a `Model` with one entry for each degree of freedom."""

UNLIMITED = {
    "lower": -np.inf,
    "upper": np.inf,
    "velocity_limit": np.inf,
    "effort_limit": np.inf,
    "armature": 0.0,
    "damping": 0.0,
    "friction": 0.0,
}
"""The defaults of a joint's limits, armature, damping and friction."""


def check_name(name: object, what: str) -> None:
    """Raise for what is not a name, or is the world's."""
    check_kind(name, what, str, "a name")
    if name == WORLD:
        raise ModelError(f"{what} {name!r}: the name belongs to the world")


def check_body(what: str, joint: Joint | None, joint_name: str, placement: SE3, inertia: SpatialInertia) -> None:
    """Raise for a joint, a placement or an inertia of another kind, for batches of them, and complex ones."""
    if joint is not None:
        check_kind(joint, f"{what}: joint", Joint, "a joint such as Revolute('z')")
        if not type(joint).__module__.startswith(f"{__package__}."):  # ours are tested
            check_subspace(joint, joint_name)
    check_kind(inertia, f"{what}: inertia", SpatialInertia, "a SpatialInertia")
    _check_one(inertia.com, f"{what}: inertia")
    check_placement(placement, what)


def check_placement(placement: SE3, what: str) -> None:
    """Raise for what is not one placement, of real numbers."""
    what = what if what == "placement" else f"{what}: placement"  # of an argument of this name, or of a part
    check_kind(placement, what, SE3, "an SE3")
    _check_one(placement.translation, what)


def _check_one(vector: Array, what: str) -> None:
    if vector.ndim != 1:
        raise ShapeError(f"{what}: expected a single one, got a batch of shape {vector.shape[:-1]}")
    if vector.dtype.kind == "c":
        raise ModelError(f"{what}: expected real numbers, got {vector.dtype}")


def as_entries(value: ArrayLike, key: str, size: int, base: int, what: str) -> Array:
    """Return numbers of joints as a vector of that size, in float64.

    One number stands for every entry. The first `base` entries, those of a floating base, may be left out: they are
    then as in `UNLIMITED`.
    """
    x = as_constant(value, what)
    if x.shape in ((), (size - base,)):
        return np.concatenate([np.full(base, UNLIMITED[key]), np.broadcast_to(x, size - base)])
    if x.shape != (size,):
        others = f", or ({size - base},) without the floating base" if base else ""
        raise ShapeError(f"{what}: expected shape () or ({size},){others}, got {x.shape}")
    return x


def check_limits(numbers: Mapping[str, Array], joints: Sequence[tuple[str, slice, slice]]) -> None:
    """Raise ModelError where limits leave no room, or what cannot be negative is; name the joint.

    Parameters
    ----------
    numbers : mapping of str to ndarray
        A vector for each key of `UNLIMITED`.
    joints : sequence of (str, slice, slice)
        Of each joint its name, and where its entries stand in q and in v.
    """
    lower, upper = numbers["lower"], numbers["upper"]
    for key, x in numbers.items():
        _refuse(np.isnan(x), joints, key, key + ": is not a number")
    crossed = lower > upper
    empty = (lower == np.inf) | (upper == -np.inf)
    _refuse(crossed, joints, "lower", "lower limit {0:g} is above upper limit {1:g}", lower, upper)
    _refuse(empty, joints, "lower", "no number lies between lower limit {0:g} and upper limit {1:g}", lower, upper)
    for key in PER_DOF:
        _refuse(numbers[key] < 0, joints, key, key + " {0:g} is below zero", numbers[key])
    for key in ("armature", "damping", "friction"):
        _refuse(np.isinf(numbers[key]), joints, key, key + " {0:g} is not finite", numbers[key])


def _refuse(wrong: Array, joints: Sequence[tuple[str, slice, slice]], key: str, why: str, *shown: Array) -> None:
    """Raise ModelError where an entry is wrong, with the name of its joint."""
    if wrong.any():
        k = int(wrong.argmax())
        ends = [(name, (of_q if key in ("lower", "upper") else of_v).stop) for name, of_q, of_v in joints]
        joint = next(name for name, stop in ends if k < stop)
        raise ModelError(f"joint {joint!r}: " + why.format(*(x[k] for x in shown)))
