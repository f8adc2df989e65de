"""The joints: how a configuration places the moved frame, and which motions it leaves free.

Each joint is a subgroup of the rigid motions. `transform` gives the placement (R, p) of the moved
frame in the joint's frame; the columns of `subspace` are the twists S that the joint allows, constant
in the moved frame, so that the joint's own twist is S q̇ (49.6) and a step of length one along v is
T(q) exp(S v). The layouts of q are Pinocchio's.

===========  ===  ===  ============================  ==========================  ==============
kind         nq   nv   q                             v                           Featherstone
===========  ===  ===  ============================  ==========================  ==============
revolute      1    1   angle                         rate                        RBDA table 4.1
prismatic     1    1   length                        rate                        RBDA table 4.1
continuous    2    1   (cos, sin)                    rate
planar        4    3   (x, y, cos, sin)              (vx, vy, ωz), moved frame   RBDA table 4.1
spherical     4    3   (qx, qy, qz, qw)              ω, moved frame              RBDA table 4.1
free_flyer    7    6   (x, y, z, qx, qy, qz, qw)     (ω, v), moved frame         RBDA table 4.1
===========  ===  ===  ============================  ==========================  ==============
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from .checks import Array, as_array
from .errors import ModelError
from .exponential import exp6, log6
from .plucker import SE3
from .rotation import quaternion_to_rotation, rotation_to_quaternion, skew

__all__ = ["Continuous", "FreeFlyer", "Joint", "Planar", "Prismatic", "Revolute", "Spherical"]

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


class Joint(ABC):
    """What every joint offers. `q` is (..., nq) and `dv` is (..., nv) throughout."""

    kind: ClassVar[str]
    nq: ClassVar[int]
    nv: ClassVar[int]
    unit: ClassVar[slice | None] = None
    """The entries of q that have norm 1: a quaternion, or a (cos, sin)."""

    @abstractmethod
    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S, shape (6, nv): the twists that the joint allows, in the moved frame."""

    @abstractmethod
    def transform(self, q: Array) -> SE3:
        """Return the placement of the moved frame in the joint's frame."""

    def neutral(self) -> Array:
        """Return the q that moves nothing, shape (nq,)."""
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

    def normalize(self, q: Array) -> Array:
        """Scale the unit part of q to norm 1, without overflow."""
        if self.unit is None:
            return q.copy()
        q = q.copy()
        part = q[..., self.unit]
        size = np.abs(part.real).max(axis=-1, keepdims=True)
        if (size == 0).any():
            raise ValueError(f"the entries {self.unit.start}:{self.unit.stop} of its q are all zero: no direction")
        q[..., self.unit] = _unit(part / size)
        return q

    def random(self, rng: np.random.Generator, lower: Array, upper: Array) -> Array:
        """Draw a q: uniform between the limits; without limits a turn in ±π, a length in ±1 m."""
        span = np.pi if self.kind == "revolute" else 1.0
        low, high = np.where(np.isfinite(lower), lower, -span), np.where(np.isfinite(upper), upper, span)
        q = low + (high - low) * rng.random(self.nq)
        if self.unit is not None:
            part = rng.standard_normal(self.unit.stop - self.unit.start)  # uniform on the sphere
            q[self.unit] = part / np.sqrt((part**2).sum())
        return q


class _GroupJoint(Joint):
    """A joint whose q has a unit part, so that a step is no addition but T(q) exp(S dv)."""

    @abstractmethod
    def coordinates(self, T: SE3, near: Array) -> Array:
        """Return the q with ``transform(q) == T``; of two quaternions, the one closer to `near`."""

    def integrate(self, q: Array, dv: Array) -> Array:
        """Go from q along the twist S dv for one unit of time: T(q) exp(S dv)."""
        S = self.subspace(dv.dtype)
        return self.coordinates(self.transform(q) @ exp6(np.matvec(S, dv)), near=q)

    def difference(self, q0: Array, q1: Array) -> Array:
        """Return the dv that leads from q0 to q1: Sᵀ log(T(q0)⁻¹ T(q1)), a turn of at most π."""
        S = self.subspace(q1.dtype)
        dv: Array = np.matvec(S.mT, log6(self.transform(q0).inverse() @ self.transform(q1)))
        return dv


@dataclass(frozen=True)
class _AxisJoint(Joint):
    """A joint with one degree of freedom, along or about a unit axis of its frame."""

    axis: tuple[float, float, float]
    """Unit vector, the same in the joint's frame and in the moved frame."""

    nv: ClassVar[int] = 1

    def __init__(self, axis: str | ArrayLike) -> None:
        if isinstance(axis, str) and axis not in AXES:
            raise ModelError(f"axis: expected 'x', 'y', 'z' or a vector of 3, got {axis!r}")
        a = as_array(AXES[axis] if isinstance(axis, str) else axis, "axis", 3).astype(np.float64)
        if a.ndim != 1 or not a.any():
            raise ModelError(f"axis: expected one vector that is not zero, got {a.tolist()}")
        if abs((a * a).sum() - 1) > 4 * np.finfo(np.float64).eps:  # what is normalised stays, to the last bit
            a = _unit(a / np.abs(a).max())
        object.__setattr__(self, "axis", (float(a[0]), float(a[1]), float(a[2])))

    def _axis(self, dtype: DTypeLike) -> Array:
        """Return the axis in a number type, of norm 1 to that type's own precision."""
        a = np.asarray(self.axis).astype(dtype)
        return _unit(a) if np.finfo(a.dtype).eps < np.finfo(np.float64).eps else a


class Revolute(_AxisJoint):
    """A turn about an axis. q is the angle in rad.

    Parameters
    ----------
    axis : {"x", "y", "z"} or array_like, shape (3,)
        Normalised here.

    Raises
    ------
    ModelError
        If the axis is zero or not a vector of three.

    Examples
    --------
    >>> Revolute([0, 3, 4]).axis
    (0.0, 0.6, 0.8)
    >>> Revolute("z").subspace()[:, 0]
    array([0., 0., 1., 0., 0., 0.])
    """

    kind, nq = "revolute", 1

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S = (axis, 0)."""
        return np.concatenate([self._axis(dtype), np.zeros(3, dtype)])[:, None]

    def transform(self, q: Array) -> SE3:
        """Return the turn by the angle q about the axis."""
        return _turn(self._axis(q.dtype), np.cos(q[..., 0]), np.sin(q[..., 0]))


class Prismatic(_AxisJoint):
    """A slide along an axis. q is the length in m.

    Parameters
    ----------
    axis : {"x", "y", "z"} or array_like, shape (3,)
        Normalised here.

    Raises
    ------
    ModelError
        If the axis is zero or not a vector of three.

    Examples
    --------
    >>> Prismatic("x").transform(np.array([0.5])).translation
    array([0.5, 0. , 0. ])
    """

    kind, nq = "prismatic", 1

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S = (0, axis)."""
        return np.concatenate([np.zeros(3, dtype), self._axis(dtype)])[:, None]

    def transform(self, q: Array) -> SE3:
        """Return the shift by q along the axis."""
        return _placement(np.eye(3, dtype=q.dtype), q * self._axis(q.dtype))


class Continuous(_AxisJoint, _GroupJoint):
    """A turn without end about an axis. q is (cos, sin).

    Parameters
    ----------
    axis : {"x", "y", "z"} or array_like, shape (3,)
        Normalised here.

    Raises
    ------
    ModelError
        If the axis is zero or not a vector of three.

    Examples
    --------
    >>> wheel = Continuous("y")
    >>> wheel.integrate(wheel.neutral(), np.array([np.pi / 2])).round(15)
    array([0., 1.])
    """

    kind, nq = "continuous", 2
    unit = slice(0, 2)
    _one = 0

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S = (axis, 0)."""
        return np.concatenate([self._axis(dtype), np.zeros(3, dtype)])[:, None]

    def transform(self, q: Array) -> SE3:
        """Return the turn with this cosine and sine about the axis."""
        cs = _unit(q)
        return _turn(self._axis(q.dtype), cs[..., 0], cs[..., 1])

    def coordinates(self, T: SE3, near: Array) -> Array:
        """Read cosine and sine off the turn: cos = (tr R − 1)/2, sin = axis · (R − Rᵀ)/2."""
        R = T.rotation
        k = skew(self._axis(R.dtype))
        return _unit(np.stack([(np.trace(R, axis1=-2, axis2=-1) - 1) / 2, (R * k).sum((-2, -1)) / 2], axis=-1))


@dataclass(frozen=True)
class Planar(_GroupJoint):
    """A slide in the x-y plane and a turn about z. q is (x, y, cos, sin).

    Examples
    --------
    >>> Planar().subspace().T
    array([[0., 0., 0., 1., 0., 0.],
           [0., 0., 0., 0., 1., 0.],
           [0., 0., 1., 0., 0., 0.]])
    """

    kind, nq, nv = "planar", 4, 3
    unit = slice(2, 4)
    _one = 2

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S: the columns are the unit twists of vx, vy and ωz."""
        return np.eye(6, dtype=dtype)[:, [3, 4, 2]]

    def transform(self, q: Array) -> SE3:
        """Return the shift by (x, y, 0) and the turn about z."""
        cs = _unit(q[..., 2:])
        turn = _turn(np.eye(3, dtype=q.dtype)[2], cs[..., 0], cs[..., 1])
        return _placement(turn.rotation, np.concatenate([q[..., :2], np.zeros_like(q[..., :1])], axis=-1))

    def coordinates(self, T: SE3, near: Array) -> Array:
        """Read x, y, cosine and sine off the placement."""
        return np.concatenate([T.translation[..., :2], _unit(T.rotation[..., :2, 0])], axis=-1)


@dataclass(frozen=True)
class Spherical(_GroupJoint):
    """A turn about any axis. q is the quaternion (qx, qy, qz, qw), v is ω in the moved frame.

    Examples
    --------
    >>> ball = Spherical()
    >>> ball.difference(ball.neutral(), np.array([1.0, 0, 0, 0]))  # half a turn about x
    array([3.14159265, 0.        , 0.        ])
    """

    kind, nq, nv = "spherical", 4, 3
    unit = slice(0, 4)

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S = (1, 0): the three angular columns."""
        return np.eye(6, 3, dtype=dtype)

    def transform(self, q: Array) -> SE3:
        """Return the turn of the quaternion."""
        return _placement(quaternion_to_rotation(q), np.zeros(3, q.dtype))

    def coordinates(self, T: SE3, near: Array) -> Array:
        """Read the quaternion off the turn, with the sign that is closer to `near`."""
        return _same_side(rotation_to_quaternion(T.rotation), near)


@dataclass(frozen=True)
class FreeFlyer(_GroupJoint):
    """No constraint at all. q is (x, y, z, qx, qy, qz, qw), v is the body twist (ω, v).

    Examples
    --------
    >>> free = FreeFlyer()
    >>> free.integrate(free.neutral(), np.array([0, 0, 0, 1.0, 2, 3]))
    array([1., 2., 3., 0., 0., 0., 1.])
    """

    kind, nq, nv = "free_flyer", 7, 6
    unit = slice(3, 7)

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S = 1: every twist."""
        return np.eye(6, dtype=dtype)

    def transform(self, q: Array) -> SE3:
        """Return the placement with this position and quaternion."""
        return _placement(quaternion_to_rotation(q[..., 3:]), q[..., :3])

    def coordinates(self, T: SE3, near: Array) -> Array:
        """Read position and quaternion off the placement, the sign closer to `near`."""
        quaternion = _same_side(rotation_to_quaternion(T.rotation), near[..., 3:])
        return np.concatenate([T.translation, quaternion], axis=-1)


def _unit(x: Array) -> Array:
    """Divide by the norm over the last axis, differentiably in complex numbers."""
    unit: Array = x / np.sqrt((x * x).sum(axis=-1, keepdims=True))
    return unit


def _turn(axis: Array, cos: Array, sin: Array) -> SE3:
    """Turn about a unit axis: the part along it stays, the part across it turns.

    R = aaᵀ + cos (1 − aaᵀ) + sin [a]×, which for a coordinate axis holds cos and sin untouched.
    """
    along = np.outer(axis, axis)
    across = np.eye(3, dtype=axis.dtype) - along
    R = along + cos[..., None, None] * across + sin[..., None, None] * skew(axis)
    return _placement(R, np.zeros(3, R.dtype))


def _placement(R: Array, p: Array) -> SE3:
    """Make a placement of one batch shape and dtype."""
    batch = np.broadcast_shapes(R.shape[:-2], p.shape[:-1])
    return SE3._trusted(np.broadcast_to(R, (*batch, 3, 3)), np.broadcast_to(p, (*batch, 3)))


def _same_side(quaternion: Array, near: Array) -> Array:
    """Of q and −q, which are the same turn, take the one closer to `near`."""
    return np.where((quaternion * near).sum(axis=-1, keepdims=True).real < 0, -quaternion, quaternion)
