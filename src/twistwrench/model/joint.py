"""What every joint offers: how q places the moved frame, and which motions the joint leaves free.

Each joint is a subgroup of the rigid motions. `Joint.transform` gives the placement of the moved frame
in the joint's frame; the columns of `Joint.subspace` are the twists S that the joint allows, constant in
the moved frame, so that the joint's own twist is S q̇ (49.6) and a step of length one along v leads to
T(q) exp(S v). The joints themselves are in `joints`.

A joint is one class: whatever else must be known of it is read from its S, nq, nv and unit part, and its
`kind` puts it into the table `Joint.kinds`, which `random_tree` and the bridge read.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from ..arrays import Array, as_array, as_constant, convert, exact_unit, resolution
from ..errors import ModelError
from ..spatial import SE3, exp6, log3
from ..spatial._elementary import at_first_index, atan2, chosen, sqrt
from ..spatial.exponential import shift, unshift
from ..spatial.jacobians import exp6_jacobian, log6_jacobian
from ..spatial.rotation import cross_matrix, turn_matrix

__all__ = [
    "AxisJoint",
    "GroupJoint",
    "Joint",
    "angle_between",
    "check_subspace",
    "placement",
    "same_side",
    "turn",
    "unit",
]

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


class Joint(ABC):
    """What every joint offers. `q` is (..., nq) and `dv` is (..., nv) throughout."""

    kind: ClassVar[str]
    nq: ClassVar[int]
    nv: ClassVar[int]
    unit: ClassVar[slice | None] = None
    """The entries of q that have norm 1: a quaternion, or a (cos, sin)."""
    pinocchio: ClassVar[tuple[str, ...]] = ()
    """The rest of Pinocchio's names after ``JointModel``: one name, or one before X, Y, Z and one for any axis."""
    kinds: ClassVar[dict[str, type[Joint]]] = {}
    """Every class of joint by its `kind`."""

    def __init_subclass__(cls, **options: Any) -> None:
        """Enter a class that has a `kind` of its own into `kinds`.

        Raises
        ------
        ModelError
            If another class has that kind.
        """
        super().__init_subclass__(**options)
        if "kind" in vars(cls):
            other = Joint.kinds.get(cls.kind, cls)
            if (other.__module__, other.__qualname__) != (cls.__module__, cls.__qualname__):
                raise ModelError(f"kind of {cls.__name__}: {cls.kind!r} is taken by {other.__qualname__}")
            Joint.kinds[cls.kind] = cls
            cls.pinocchio = vars(cls).get("pinocchio", ())  # each kind has a name of its own, or none

    @classmethod
    def sample(cls, rng: np.random.Generator) -> Self:
        """Draw a joint of this class: an axis in any direction where it has one."""
        return cls(rng.standard_normal(3)) if issubclass(cls, AxisJoint) else cls()

    @abstractmethod
    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S, shape (6, nv): the twists that the joint allows, in the moved frame."""

    @abstractmethod
    def transform(self, q: Array) -> SE3:
        """Return the placement of the moved frame in the joint's frame: arithmetic alone, for numbers of any type."""

    def neutral(self) -> Array:
        """Return the q of the identity placement, shape (nq,)."""
        q = np.zeros(self.nq)
        if self.unit is not None:
            q[self._one] = 1.0
        return q

    _one: ClassVar[int] = -1
    """The entry that is 1 in the neutral configuration, where `unit` is set."""

    def integrate(self, q: Array, dv: Array) -> Array:
        """Go from q along the twist S dv for one unit of time."""
        return q + dv

    def difference(self, q0: Array, q1: Array) -> Array:
        """Return the dv that leads from q0 to q1: the inverse of `integrate`."""
        return q1 - q0

    def d_integrate(self, dv: Array) -> tuple[Array, Array]:
        """Return how the end of a step dv moves with its beginning, and with dv: both shape (..., nv, nv)."""
        one = np.broadcast_to(np.eye(self.nv, dtype=dv.dtype), (*dv.shape, self.nv))
        return one, one

    def d_difference(self, q0: Array, q1: Array) -> tuple[Array, Array]:
        """Return the derivatives of `difference` with respect to q0 and to q1: both shape (..., nv, nv)."""
        batch = np.broadcast_shapes(q0.shape[:-1], q1.shape[:-1])
        one = np.broadcast_to(np.eye(self.nv, dtype=q1.dtype), (*batch, self.nv, self.nv))
        return -one, one

    def normalize(self, q: Array) -> Array:
        """Scale the unit part of q to norm 1, without overflow."""
        if self.unit is None:
            return q.copy()
        q = q.copy()
        part = q[..., self.unit]
        size = np.abs(part.real).max(axis=-1, keepdims=True)
        if (size == 0).any():
            where = f"{self.unit.start}:{self.unit.stop} of its q are all zero" + at_first_index(size[..., 0] == 0)
            raise ValueError(f"the entries {where}: no direction")
        q[..., self.unit] = unit(part / size)
        return q

    def random(self, rng: np.random.Generator, lower: Array, upper: Array, size: tuple[int, ...] = ()) -> Array:
        """Draw q, ``(*size, nq)``, uniform between the limits; where wide, see `Model.random_configuration`."""
        span = np.ones(self.nq)
        if self.nq == self.nv:  # entry k of q goes along column k of S: an angle, or a length
            span[self.subspace()[:3].any(axis=0)] = np.pi
        near_zero = np.clip(0.0, lower + span, upper - span)
        wide = upper / 2 - lower / 2 > 100 * span  # halved before, so that nothing overflows
        low = np.where(wide, np.maximum(near_zero - span, lower), lower)
        high = np.where(wide, np.minimum(near_zero + span, upper), upper)
        q: Array = low + (high - low) * rng.random((*size, self.nq))
        if self.unit is not None:
            part = rng.standard_normal((*size, self.unit.stop - self.unit.start))  # uniform on the sphere
            q[..., self.unit] = part / np.sqrt((part**2).sum(axis=-1, keepdims=True))
        return q


def check_subspace(joint: Joint, name: str) -> None:
    """Raise ModelError where a step along v does not lead from T(q) to T(q) exp(S v): S is not constant there."""
    v0, v = np.random.default_rng(0).standard_normal((2, joint.nv))
    q = joint.integrate(joint.neutral(), v0)
    there = joint.transform(q) @ exp6(np.matvec(joint.subspace(), v))
    off = np.abs(joint.transform(joint.integrate(q, v)).matrix() - there.matrix()).max()
    if not off < 1e-9:
        raise ModelError(
            f"joint {name!r}: expected an S that is constant in the moved frame, transform(integrate(q, v)) = "
            f"transform(q) exp(S v); the two are {off:.2g} apart. A joint of several axes that are not so is a chain: "
            "one joint for each axis, with massless links between them"
        )


class GroupJoint(Joint):
    """A joint whose q has a unit part, so that a step is not an addition but T(q) exp(S dv).

    The columns of its S are orthonormal: Sᵀ reads dv off the twist S dv.
    """

    @abstractmethod
    def from_placement(self, T: SE3, near: Array) -> Array:
        """Return the q with ``transform(q) == T``; of two quaternions, the one closer to `near`."""

    def integrate(self, q: Array, dv: Array) -> Array:
        """Go from q along the twist S dv for one unit of time: T(q) exp(S dv)."""
        S = self.subspace(dv.dtype)
        V = np.matvec(S, dv)
        return self.from_placement(self.transform(q) @ placement(turn_matrix(V[..., :3]), shift(V)), near=q)

    def difference(self, q0: Array, q1: Array) -> Array:
        """Return the dv that leads from q0 to q1: Sᵀ log(T(q0)⁻¹ T(q1)), a turn of at most π."""
        dv: Array = np.matvec(self.subspace(q1.dtype).mT, self._twist_between(q0, q1))
        return dv

    def turn_between(self, q0: Array, q1: Array) -> Array:
        """Return the rotation vector that leads from q0 to q1, shape (..., 3)."""
        return log3(self.transform(q0).rotation.mT @ self.transform(q1).rotation)

    def _twist_between(self, q0: Array, q1: Array) -> Array:
        """Return log(T(q0)⁻¹ T(q1)), the positions subtracted before they are turned, far from the origin too."""
        T0, T1 = self.transform(q0), self.transform(q1)
        w, p = self.turn_between(q0, q1), np.matvec(T0.rotation.mT, T1.translation - T0.translation)
        return np.concatenate([w, unshift(w, p)], axis=-1)

    def d_integrate(self, dv: Array) -> tuple[Array, Array]:
        """Return SᵀXS, X of exp(−S dv), and SᵀJS, J of `Jexp6`: the beginning moves the end as seen from there."""
        S = self.subspace(dv.dtype)
        V = np.matvec(S, dv)
        X = placement(turn_matrix(-V[..., :3]), shift(-V)).motion_transform()
        return S.mT @ X @ S, S.mT @ exp6_jacobian(V) @ S

    def d_difference(self, q0: Array, q1: Array) -> tuple[Array, Array]:
        """Return −SᵀJS and SᵀJS, with J of `Jlog6` on the left, for q0, and on the right."""
        S, V = self.subspace(q1.dtype), self._twist_between(q0, q1)
        return -S.mT @ log6_jacobian(-V) @ S, S.mT @ log6_jacobian(V) @ S


@dataclass(frozen=True)
class AxisJoint(Joint):
    """A joint with one degree of freedom, along or about a unit axis of its frame."""

    axis: tuple[float, float, float]
    """Unit vector, the same in the joint's frame and in the moved frame."""

    nv: ClassVar[int] = 1

    def __init__(self, axis: str | ArrayLike) -> None:
        if isinstance(axis, str) and axis not in AXES:
            raise ModelError(f"axis: expected 'x', 'y', 'z' or a vector of 3, got {axis!r}")
        a = as_constant(as_array(AXES[axis] if isinstance(axis, str) else axis, "axis", 3), "axis")
        if a.ndim != 1 or not a.any():
            raise ModelError(f"axis: expected one vector that is not zero, got {a.tolist()}")
        size = np.abs(a).max()
        if size > 2 or abs((a * a).sum() - 1) > 4 * resolution(np.float64):  # a unit vector stays as it is
            a = unit(a / size)
        object.__setattr__(self, "axis", (float(a[0]), float(a[1]), float(a[2])))

    def _axis(self, dtype: DTypeLike) -> Array:
        """Return the axis in a number type, of norm 1 to that type's own precision.

        Objects need not mix with floats: for them the axis becomes the nearest fractions of norm 1.
        """
        if np.dtype(dtype) == object:
            axis = np.array(self.axis)
            return axis if axis.dtype == object else exact_unit(convert(axis, dtype))
        a = np.asarray(self.axis).astype(dtype)
        return unit(a) if resolution(a.dtype) < resolution(np.float64) else a


def unit(x: Array) -> Array:
    """Divide by the norm over the last axis, differentiably in complex numbers."""
    unit: Array = x / sqrt((x * x).sum(axis=-1, keepdims=True))
    return unit


def turn(axis: Array, cos: Array, sin: Array) -> SE3:
    """Turn about a unit axis, with cos and sin of shape (..., 1): the part along it stays, the part across it turns.

    R = aaᵀ + cos (1 − aaᵀ) + sin [a]×, which for a coordinate axis holds cos and sin untouched.
    """
    along = axis[:, None] * axis
    across = np.eye(3, dtype=axis.dtype) - along
    R = along + cos[..., None] * across + sin[..., None] * cross_matrix(axis)
    return placement(R, np.zeros(3, R.dtype))


def placement(R: Array, p: Array) -> SE3:
    """Make a placement of one batch shape and dtype."""
    batch = np.broadcast_shapes(R.shape[:-2], p.shape[:-1])
    return SE3._trusted(np.broadcast_to(R, (*batch, 3, 3)), np.broadcast_to(p, (*batch, 3)))


def same_side(quaternion: Array, near: Array) -> Array:
    """Of q and −q, which are the same turn, take the one closer to `near`."""
    return chosen(-(quaternion * near).sum(axis=-1, keepdims=True), -quaternion, quaternion)


def angle_between(p: Array, q: Array) -> Array:
    """Return the angle from one (cos, sin) to another, above −π and up to π, shape (..., 1).

    Its sine is p × q, or p × (q − p), which keeps all digits of a small angle; adding 0 takes the sign off a zero.
    """
    d = q - p
    return atan2(p[..., :1] * d[..., 1:] - p[..., 1:] * d[..., :1] + 0, (p * q).sum(axis=-1, keepdims=True))
