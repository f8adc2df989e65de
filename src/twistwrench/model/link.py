"""A link of a model that is being built, validated on its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_constant, as_exactly, convert
from ..errors import ModelError, ShapeError
from ..spatial import SE3, SpatialInertia
from .checks import UNLIMITED, as_entries, check_body, check_limits, check_name
from .constants import cast
from .joint import Joint

__all__ = ["Link", "placement_of"]


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
        check_name(name, "link")
        check_name(joint_name, "joint")
        check_body(f"link {name!r}", joint, joint_name, placement, inertia)
        limits = {key: as_constant(x, f"link {name!r}: {key}") for key, x in numbers.items()}
        if joint is None and any((x != UNLIMITED[key]).any() for key, x in limits.items()):
            raise ModelError(f"link {name!r}: limits and armature belong to a joint, and this link is welded")
        try:
            own = SpatialInertia._trusted(
                *(convert(x, np.float64) for x in (inertia.mass, inertia.com, inertia.inertia_at_com))
            )
            at = cast(placement, np.float64)
        except ValueError as error:
            raise ModelError(f"link {name!r}: {error}") from None
        nq, nv = (joint.nq, joint.nv) if joint else (0, 0)
        vectors = {
            key: as_entries(x, key, nq if key in ("lower", "upper") else nv, 0, f"joint {joint_name!r}: {key}")
            for key, x in (UNLIMITED | dict(numbers)).items()
        }
        check_limits(vectors, [(joint_name, slice(0, nq), slice(0, nv))])
        return cls(name, parent, joint, joint_name, at, own, **vectors)


def placement_of(T: ArrayLike, name: str) -> SE3:
    """Return the placement of a 4 × 4 matrix; an error names the argument."""
    try:
        return SE3.from_matrix(as_exactly(T, name, 4, 4))
    except ShapeError as error:
        raise ShapeError(f"{name}: {str(error).removeprefix('T: ').removeprefix(f'{name}: ')}") from None
