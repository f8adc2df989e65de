"""The constants of a model in the number type of a call."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import DTypeLike

from ..arrays import Array, convert, resolution
from ..spatial import SE3, SpatialInertia
from ..spatial._quaternions import exact_rotation

if TYPE_CHECKING:
    from .model import Model

__all__ = ["Constants", "cast", "readonly"]


@dataclass(frozen=True, eq=False)
class Constants:
    """What the recursions read of a model, in one number type, read-only. Entry 0 of each is the world's.

    Attributes
    ----------
    S : tuple of ndarray, shape (6, nv of joint i)
        The joint's motion subspace, in the body's frame.
    I : tuple of ndarray, shape (6, 6)
        The body's spatial inertia, in its frame.
    placement : tuple of SE3
        As `Model.placement`.
    gravity : ndarray, shape (6,)
        The spatial acceleration (0, g) of free fall, in the world.
    armature : ndarray, shape (nv,)
    rotor : tuple of ndarray, shape (nv of joint i, nv of joint i)
        The joint's part of the armature, as a diagonal matrix.
    """

    S: tuple[Array, ...]
    I: tuple[Array, ...]
    placement: tuple[SE3, ...]
    gravity: Array
    armature: Array
    rotor: tuple[Array, ...]

    @classmethod
    def of(cls, model: Model, dtype: np.dtype[Any]) -> Constants:
        """Convert the constants of `model`."""
        inertia = [
            SpatialInertia(convert(i.mass, dtype), convert(i.com, dtype), convert(i.inertia_at_com, dtype))
            for i in model.inertia
        ]
        return cls(
            S=tuple(readonly(joint.subspace(dtype) if joint else np.zeros((6, 0), dtype)) for joint in model.joints),
            I=tuple(readonly(i.matrix()) for i in inertia),
            placement=tuple(cast(T, dtype) for T in model.placement),
            gravity=readonly(convert(np.concatenate([np.zeros(3), model.gravity]), dtype)),
            armature=readonly(convert(model.armature, dtype)),
            rotor=tuple(readonly(np.diag(convert(model.armature[s], dtype))) for s in model.v_slice),
        )


def readonly(x: Array) -> Array:
    """Return x, read-only: all later results depend on it."""
    x.flags.writeable = False
    return x


def cast(T: SE3, dtype: DTypeLike) -> SE3:
    """Convert a placement to a number type, its rotation orthonormal to that type's precision.

    For a finer type than it has, two steps of Newton's iteration for the nearest rotation,
    R ← R (3 − RᵀR)/2, remove what the coarser one could not hold. As objects it is a rotation exactly.
    """
    if T.rotation.dtype == dtype:
        return T
    if np.dtype(dtype) == object:
        return SE3._trusted(exact_rotation(T.rotation), convert(T.translation, dtype))
    R = convert(T.rotation, dtype)
    if resolution(R.dtype) < resolution(T.rotation.dtype):
        for _ in range(2):
            R = R @ (3 * np.eye(3, dtype=R.dtype) - R.mT @ R) / 2
    return SE3(R, convert(T.translation, dtype))
