"""A link of a model that is being built, validated on its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_constant, as_exactly, check_kind
from ..errors import ModelError, ShapeError
from ..spatial import SE3, SpatialInertia
from .constants import cast
from .joint import Joint, check_subspace
from .model import PER_DOF

__all__ = ["UNLIMITED", "WORLD", "Link", "placement_of"]

WORLD = "universe"
"""The name of the world, which carries the root; nothing else may have it."""

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


@dataclass(frozen=True)
class Link:
    """A link, the joint or the weld that carries it, and the joint's limits: all in float64."""

    name: str
    parent: str
    joint: Joint | None
    joint_name: str
    placement: SE3
    inertia: SpatialInertia
    lower: Array
    upper: Array
    velocity_limit: Array
    effort_limit: Array
    armature: Array
    damping: Array
    friction: Array

    @classmethod
    def checked(
        cls,
        name: str,
        parent: str,
        joint: Joint | None,
        joint_name: str,
        placement: SE3,
        inertia: SpatialInertia,
        numbers: Mapping[str, ArrayLike],
    ) -> Link:
        """Make a link from checked arguments. `numbers` are the entries of `UNLIMITED` that were given."""
        numbers = UNLIMITED | dict(numbers)
        _expect_names(name, joint_name)
        if joint is not None:
            check_kind(joint, f"link {name!r}: joint", Joint, "a joint such as Revolute('z')")
            if not type(joint).__module__.startswith(f"{__package__}."):  # ours are tested
                check_subspace(joint, joint_name)
        check_kind(placement, f"link {name!r}: placement", SE3, "an SE3")
        check_kind(inertia, f"link {name!r}: inertia", SpatialInertia, "a SpatialInertia")
        _expect_one(placement.translation, f"link {name!r}: placement")
        _expect_one(inertia.com, f"link {name!r}: inertia")
        limits = {key: as_constant(x, f"link {name!r}: {key}") for key, x in numbers.items()}
        if joint is None and any((limits[key] != x).any() for key, x in UNLIMITED.items()):
            raise ModelError(f"link {name!r}: limits and armature belong to a joint, and this link is welded")
        own = SpatialInertia._trusted(
            *(x.astype(np.float64) for x in (inertia.mass, inertia.com, inertia.inertia_at_com))
        )
        vectors = _vectors(joint, f"joint {joint_name!r}", numbers)
        return cls(name, parent, joint, joint_name, cast(placement, np.float64), own, **vectors)


def _expect_names(name: str, joint_name: str) -> None:
    for what, x in (("link", name), ("joint", joint_name)):
        if not isinstance(x, str):
            raise TypeError(f"{what}: expected a name, got {type(x).__name__} {x!r}")
        if x == WORLD:
            raise ModelError(f"{what} {x!r}: the name belongs to the world")


def _expect_one(vector: Array, what: str) -> None:
    """Raise for a batch of placements or inertias, or complex ones: a model has one of each, and real."""
    if vector.ndim != 1:
        raise ShapeError(f"{what}: expected a single one, got a batch of shape {vector.shape[:-1]}")
    if vector.dtype.kind == "c":
        raise ModelError(f"{what}: expected real numbers, got {vector.dtype}")


def _vectors(joint: Joint | None, what: str, numbers: Mapping[str, ArrayLike]) -> dict[str, Array]:
    """Return limits and armature as float64 vectors; a scalar stands for every entry."""
    nq, nv = (joint.nq, joint.nv) if joint else (0, 0)
    sizes = {key: nq if key in ("lower", "upper") else nv for key in UNLIMITED}
    x = {key: _vector(numbers[key], size, f"{what}: {key}") for key, size in sizes.items()}
    if (x["lower"] > x["upper"]).any():
        raise ModelError(f"{what}: lower limit {x['lower']} is above upper limit {x['upper']}")
    if (x["lower"] == np.inf).any() or (x["upper"] == -np.inf).any():
        raise ModelError(f"{what}: no number lies between lower limit {x['lower']} and upper limit {x['upper']}")
    for key in PER_DOF:
        if (x[key] < 0).any():
            raise ModelError(f"{what}: {key} {numbers[key]!r} is below zero")
    for key in ("armature", "damping", "friction"):
        if np.isinf(x[key]).any():
            raise ModelError(f"{what}: {key} {numbers[key]!r} is not finite")
    return x


def _vector(value: ArrayLike, size: int, what: str) -> Array:
    x = as_constant(value, what)
    if x.shape not in ((), (size,)):
        raise ShapeError(f"{what}: expected shape () or ({size},), got {x.shape}")
    if np.isnan(x).any():
        raise ModelError(f"{what}: is not a number")
    return np.broadcast_to(x, size).copy()


def placement_of(T: ArrayLike, name: str) -> SE3:
    """Return the placement of a 4 × 4 matrix; an error names the argument."""
    try:
        return SE3.from_matrix(as_exactly(T, name, 4, 4))
    except ShapeError as error:
        raise ShapeError(f"{name}: {str(error).removeprefix('T: ').removeprefix(f'{name}: ')}") from None
