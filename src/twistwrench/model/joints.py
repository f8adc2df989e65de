"""The joints of the package. The layouts of q are Pinocchio's; table 4.1 of RBDA has the same joints.

===========  ===  ===  ============================  ==========================  ==============
kind         nq   nv   q                             v                           Featherstone
===========  ===  ===  ============================  ==========================  ==============
revolute      1    1   angle                         rate                        RBDA table 4.1
prismatic     1    1   length                        rate                        RBDA table 4.1
continuous    2    1   (cos, sin)                    rate
helical       1    1   angle                         rate                        RBDA table 4.1
planar        4    3   (x, y, cos, sin)              (vx, vy, ωz), moved frame   RBDA table 4.1
spherical     4    3   (qx, qy, qz, qw)              ω, moved frame              RBDA table 4.1
free_flyer    7    6   (x, y, z, qx, qy, qz, qw)     (ω, v), moved frame         RBDA table 4.1
===========  ===  ===  ============================  ==========================  ==============
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from ..arrays import Array, as_number, convert
from ..errors import ModelError
from ..spatial import SE3, rotation_to_quaternion
from ..spatial._elementary import cos, sin
from ..spatial._quaternions import exp_quaternion, quaternion_product, turn_between
from ..spatial.exponential import shift
from ..spatial.rotation import cross_matrix, quaternion_matrix
from .joint import AxisJoint, GroupJoint, Joint, angle_between, placement, same_side, turn, unit

__all__ = ["Continuous", "FreeFlyer", "Helical", "Planar", "Prismatic", "Revolute", "Spherical"]


class Revolute(AxisJoint):
    """A turn about an axis. q is the angle in rad.

    Parameters
    ----------
    axis : {"x", "y", "z"} or array_like, shape (3,)
        Normalised here.

    Raises
    ------
    ModelError, ValueError
        If the axis is zero or not a real vector of three.

    Examples
    --------
    >>> Revolute([0, 3, 4]).axis
    (0.0, 0.6, 0.8)
    >>> Revolute("z").subspace()[:, 0]
    array([0., 0., 1., 0., 0., 0.])
    """

    kind, nq = "revolute", 1
    pinocchio = ("R", "RevoluteUnaligned")

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S = (axis, 0)."""
        return np.concatenate([self._axis(dtype), np.zeros(3, dtype)])[:, None]

    def transform(self, q: Array) -> SE3:
        """Return the turn by the angle q about the axis."""
        return turn(self._axis(q.dtype), cos(q), sin(q))


class Prismatic(AxisJoint):
    """A slide along an axis. q is the length in m.

    Parameters
    ----------
    axis : {"x", "y", "z"} or array_like, shape (3,)
        Normalised here.

    Raises
    ------
    ModelError, ValueError
        If the axis is zero or not a real vector of three.

    Examples
    --------
    >>> Prismatic("x").transform(np.array([0.5])).translation
    array([0.5, 0. , 0. ])
    """

    kind, nq = "prismatic", 1
    pinocchio = ("P", "PrismaticUnaligned")

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S = (0, axis)."""
        return np.concatenate([np.zeros(3, dtype), self._axis(dtype)])[:, None]

    def transform(self, q: Array) -> SE3:
        """Return the shift by q along the axis."""
        return placement(np.eye(3, dtype=q.dtype), q * self._axis(q.dtype))


class Continuous(AxisJoint, GroupJoint):
    """A turn without end about an axis. q is (cos, sin).

    Parameters
    ----------
    axis : {"x", "y", "z"} or array_like, shape (3,)
        Normalised here.

    Raises
    ------
    ModelError, ValueError
        If the axis is zero or not a real vector of three.

    Examples
    --------
    >>> wheel = Continuous("y")
    >>> wheel.integrate(wheel.neutral(), np.array([np.pi / 2])).round(15)
    array([0., 1.])
    """

    kind, nq = "continuous", 2
    pinocchio = ("RUB", "RevoluteUnboundedUnaligned")
    unit = slice(0, 2)
    _one = 0

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S = (axis, 0)."""
        return np.concatenate([self._axis(dtype), np.zeros(3, dtype)])[:, None]

    def transform(self, q: Array) -> SE3:
        """Return the turn with this cosine and sine about the axis."""
        cs = unit(q)
        return turn(self._axis(q.dtype), cs[..., :1], cs[..., 1:])

    def integrate(self, q: Array, dv: Array) -> Array:
        """Turn the point (cos, sin) by the angle dv."""
        c, s, cos_dv, sin_dv = q[..., :1], q[..., 1:], cos(dv), sin(dv)
        return unit(np.concatenate([c * cos_dv - s * sin_dv, s * cos_dv + c * sin_dv], axis=-1))

    def difference(self, q0: Array, q1: Array) -> Array:
        """Return the angle from q0 to q1, the short way round."""
        return angle_between(q0, q1)

    def d_integrate(self, dv: Array) -> tuple[Array, Array]:
        """Return 1 and 1: about one axis angles add up."""
        return Joint.d_integrate(self, dv)

    def d_difference(self, q0: Array, q1: Array) -> tuple[Array, Array]:
        """Return −1 and 1."""
        return Joint.d_difference(self, q0, q1)

    def from_placement(self, T: SE3, near: Array) -> Array:
        """Read cosine and sine off the turn: cos = (tr R − 1)/2, sin = axis · (R − Rᵀ)/2."""
        R = T.rotation
        k = cross_matrix(self._axis(R.dtype))
        return unit(np.stack([(np.trace(R, axis1=-2, axis2=-1) - 1) / 2, (R * k).sum((-2, -1)) / 2], axis=-1))


@dataclass(frozen=True)
class Helical(AxisJoint):
    """A screw: a turn about an axis, and a slide along it by `pitch` times the angle. q is the angle in rad.

    Parameters
    ----------
    axis : {"x", "y", "z"} or array_like, shape (3,)
        Normalised here.
    pitch : float
        m/rad; positive for a right-handed thread.

    Raises
    ------
    ModelError, ValueError
        If the axis is zero or not a real vector of three, or the pitch is not a finite number.

    Examples
    --------
    >>> spindle = Helical("z", 0.005 / (2 * np.pi))  # 5 mm a turn
    >>> spindle.transform(np.array([2 * np.pi])).translation
    array([0.   , 0.   , 0.005])
    """

    pitch: float

    kind, nq = "helical", 1
    pinocchio = ("H", "HelicalUnaligned")

    def __init__(self, axis: str | ArrayLike, pitch: float) -> None:
        super().__init__(axis)
        if not np.isfinite(as_number(pitch, "pitch")):
            raise ModelError(f"pitch: expected a finite number, got {pitch}")
        object.__setattr__(self, "pitch", as_number(pitch, "pitch"))

    @classmethod
    def sample(cls, rng: np.random.Generator) -> Self:
        """Draw a screw with an axis in any direction and a pitch of up to 0.5 m/rad to either hand."""
        return cls(rng.standard_normal(3), rng.uniform(-0.5, 0.5))

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S = (axis, pitch axis)."""
        axis = self._axis(dtype)
        return np.concatenate([axis, self._pitch(dtype) * axis])[:, None]

    def transform(self, q: Array) -> SE3:
        """Return the turn by the angle q about the axis, and the shift by pitch q along it."""
        axis = self._axis(q.dtype)
        return placement(turn(axis, cos(q), sin(q)).rotation, self._pitch(q.dtype) * q * axis)

    def _pitch(self, dtype: DTypeLike) -> float:
        """Return the pitch; for arrays of objects, which need not mix with floats, as a fraction."""
        exact = np.dtype(dtype) == object and isinstance(self.pitch, float)
        return convert(np.array(self.pitch), dtype).item() if exact else self.pitch


@dataclass(frozen=True)
class Planar(GroupJoint):
    """A slide in the x-y plane and a turn about z. q is (x, y, cos, sin).

    Examples
    --------
    >>> Planar().subspace().T
    array([[0., 0., 0., 1., 0., 0.],
           [0., 0., 0., 0., 1., 0.],
           [0., 0., 1., 0., 0., 0.]])
    """

    kind, nq, nv = "planar", 4, 3
    pinocchio = ("Planar",)
    unit = slice(2, 4)
    _one = 2

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S: the columns are the unit twists of vx, vy and ωz."""
        return np.eye(6, dtype=dtype)[:, [3, 4, 2]]

    def transform(self, q: Array) -> SE3:
        """Return the shift by (x, y, 0) and the turn about z."""
        cs = unit(q[..., 2:])
        turned = turn(np.eye(3, dtype=q.dtype)[2], cs[..., :1], cs[..., 1:])
        return placement(turned.rotation, np.concatenate([q[..., :2], np.zeros_like(q[..., :1])], axis=-1))

    def turn_between(self, q0: Array, q1: Array) -> Array:
        """Return (0, 0, angle)."""
        angle = angle_between(q0[..., 2:], q1[..., 2:])
        return np.concatenate([0 * angle, 0 * angle, angle], axis=-1)

    def from_placement(self, T: SE3, near: Array) -> Array:
        """Read x, y, cosine and sine off the placement."""
        return np.concatenate([T.translation[..., :2], unit(T.rotation[..., :2, 0])], axis=-1)


@dataclass(frozen=True)
class Spherical(GroupJoint):
    """A turn about any axis. q is the quaternion (qx, qy, qz, qw), v is ω in the moved frame.

    Examples
    --------
    >>> ball = Spherical()
    >>> ball.difference(ball.neutral(), np.array([1.0, 0, 0, 0]))  # half a turn about x
    array([3.14159265, 0.        , 0.        ])
    """

    kind, nq, nv = "spherical", 4, 3
    pinocchio = ("Spherical",)
    unit = slice(0, 4)

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S = (1, 0): the three angular columns."""
        return np.eye(6, 3, dtype=dtype)

    def transform(self, q: Array) -> SE3:
        """Return the turn of the quaternion."""
        return placement(quaternion_matrix(q), np.zeros(3, q.dtype))

    def integrate(self, q: Array, dv: Array) -> Array:
        """Turn by dv for one unit of time: as the joints with a unit part do, by a product of quaternions."""
        return same_side(unit(quaternion_product(q, exp_quaternion(dv))), q)

    def turn_between(self, q0: Array, q1: Array) -> Array:
        """Return the rotation vector from the quaternion q0 to q1."""
        return turn_between(q0, q1)

    def from_placement(self, T: SE3, near: Array) -> Array:
        """Read the quaternion off the turn, with the sign that is closer to `near`."""
        return same_side(rotation_to_quaternion(T.rotation), near)


@dataclass(frozen=True)
class FreeFlyer(GroupJoint):
    """No constraint at all. q is (x, y, z, qx, qy, qz, qw), v is the body twist (ω, v).

    Examples
    --------
    >>> free = FreeFlyer()
    >>> free.integrate(free.neutral(), np.array([0, 0, 0, 1.0, 2, 3]))
    array([1., 2., 3., 0., 0., 0., 1.])
    """

    kind, nq, nv = "free_flyer", 7, 6
    pinocchio = ("FreeFlyer",)
    unit = slice(3, 7)

    def subspace(self, dtype: DTypeLike = np.float64) -> Array:
        """Return S = 1: every twist."""
        return np.eye(6, dtype=dtype)

    def transform(self, q: Array) -> SE3:
        """Return the placement with this position and quaternion."""
        return placement(quaternion_matrix(q[..., 3:]), q[..., :3])

    def integrate(self, q: Array, dv: Array) -> Array:
        """Go along the twist dv for one unit of time: T(q) exp(dv), the turn by a product of quaternions."""
        there = q[..., :3] + np.matvec(quaternion_matrix(q[..., 3:]), shift(dv))
        turned = quaternion_product(q[..., 3:], exp_quaternion(dv[..., :3]))
        return np.concatenate([there, same_side(unit(turned), q[..., 3:])], axis=-1)

    def turn_between(self, q0: Array, q1: Array) -> Array:
        """Return the rotation vector from the quaternion of q0 to that of q1."""
        return turn_between(q0[..., 3:], q1[..., 3:])

    def from_placement(self, T: SE3, near: Array) -> Array:
        """Read position and quaternion off the placement, the sign closer to `near`."""
        quaternion = same_side(rotation_to_quaternion(T.rotation), near[..., 3:])
        return np.concatenate([T.translation, quaternion], axis=-1)
