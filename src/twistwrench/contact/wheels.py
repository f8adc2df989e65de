"""A thin wheel that touches with its rim, at another point as it rolls, leans and steers (49.4, 49.9)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..arrays import Array, as_exactly, convert
from ..errors import SingularError
from ..model import Model, readonly
from ..spatial import SE3
from ..spatial._elementary import at_first_index, sqrt
from ..spatial.rotation import cross_matrix
from .kinds import _coefficient, _normal_axes, _unit
from .types import Contact, FrameRows, checked_restitution

__all__ = ["WheelContact"]

FLAT = 1e-9
"""Sine of the angle between axle and normal: below, the wheel lies flat."""


@dataclass(frozen=True)
class WheelContact(Contact):
    """A knife edge on a plane: a coin, a disc, the wheel of a bicycle.

    It touches at the lowest point of its rim, at r m from the centre, where m is the direction down within the wheel:
    m = −(n − (n·a) a) / |n − (n·a) a| with the normal n and the axle a. That point of the wheel moves with
    v + ω × r m. Where it sticks, the wheel rolls.

    Parameters
    ----------
    frame : str
        At the centre of the wheel.
    radius : float
        r, m, above 0.
    mu : float
        Coefficient of friction, at least 0.
    axis : array_like, shape (3,), optional
        a, the axle, in the axes of the frame: its y unless given; any length but 0.
    normal : array_like, shape (3,), optional
        n, out of the ground, in the axes of the world; any length but 0.
    restitution : float, optional
        e, from 0 to 1, where it hits a ground of `simulate`; the ground's unless given.

    Raises
    ------
    ValueError
        If `radius` is not a number above 0, `mu` not one of at least 0, `axis` or `normal` not a direction, or
        `restitution` not from 0 to 1.

    Notes
    -----
    Rolling is not holonomic: of the place of a wheel that sticks only its height is held (`project_state`), and of its
    velocity all. A wheel that lies flat has no lowest point: SingularError.

    Examples
    --------
    A disc that leans by θ and whose centre goes round a circle of radius R rolls so for ever at a rate of turn Ω with
    Ω² = 4 g tan θ / (6 R + r sin θ). The point that touches is at rest:

    >>> import twistwrench as tw
    >>> r, R, lean = 0.1, 1.0, 0.3
    >>> disc = tw.SpatialInertia(1.0, [0, 0, 0], r**2 / 4 * np.diag([1.0, 2.0, 1.0]))
    >>> coin = tw.Builder("coin", base="floating", root="coin", root_inertia=disc).build()
    >>> turn = np.sqrt(4 * 9.81 * np.tan(lean) / (6 * R + r * np.sin(lean)))
    >>> q = [0, 0, r * np.cos(lean), -np.sin(lean / 2), 0, 0, np.cos(lean / 2)]
    >>> v = np.array([0, turn * R / r, turn * np.cos(lean), turn * R, 0, 0])
    >>> J = tw.constraint_jacobian(coin, q, [tw.WheelContact("coin", r, 0.8)])
    >>> bool(np.abs(J @ v).max() < 1e-15)
    True
    """

    frame: str
    radius: float
    mu: float
    axis: tuple[float, float, float] = (0.0, 1.0, 0.0)
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    restitution: float | None = field(default=None, kw_only=True)
    divides = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "mu", _coefficient(self.frame, self.mu))
        radius = float(as_exactly(self.radius, f"contact {self.frame!r}: radius"))
        if radius <= 0:
            raise ValueError(f"contact {self.frame!r}: radius: expected a length above 0, got {radius:g}")
        object.__setattr__(self, "radius", radius)
        for name in ("axis", "normal"):
            given = as_exactly(getattr(self, name), f"contact {self.frame!r}: {name}", 3)
            object.__setattr__(self, name, _unit(self.frame, name, given))
        checked_restitution(self)

    @property
    def rows(self) -> slice:
        """The three linear rows, of the point that touches."""
        return slice(3, 6)

    def jacobian(self, model: Model, q: Array) -> Array:
        """Return the rows of J of the point that touches."""
        from .relative import contact_rows

        return contact_rows(model, q, np.zeros(model.nv, q.dtype), [self]).J

    def held_rows(self, rows: FrameRows) -> tuple[Array, Array]:
        """Return the rows of the point that touches, and its J̇ v: the point moves along the rim as well."""
        n, a, upright, arm = self._wheel(rows.rotation)
        J = rows.J[..., 3:, :] - cross_matrix(arm) @ rows.J[..., :3, :]
        w = np.matvec(rows.J[..., :3, :], rows.v)
        leans, turns = _dot(n, a), np.cross(w, a)  # n·a, and the rates of the axle and of n·a
        rate = _dot(n, turns)
        moves = self.radius_as(a) * (rate * a + leans * turns) / upright - arm * (-leans * rate) / (upright * upright)
        bias = rows.bias[..., 3:] + np.cross(rows.bias[..., :3], arm) + np.cross(w, moves)
        return J, bias

    def held_place(self, T: SE3) -> SE3:
        """Return the placement of the frame's axes at the point that touches."""
        arm = self._wheel(T.rotation)[3]
        return SE3._trusted(T.rotation, T.translation + arm)

    @cached_property
    def placed(self) -> Array:
        """The height alone."""
        n = np.array(self.normal)
        return readonly(np.concatenate([np.zeros((3, 3)), np.outer(n, n)], axis=1))

    def axes(self, rotation: Array) -> Array:
        """Return the axes of the world, turned the shortest way until z is the normal."""
        return np.broadcast_to(_normal_axes(self.normal), rotation.shape)

    def arms(self, rotation: Array) -> Array:
        """Return the lowest point of the rim."""
        return self._wheel(rotation)[3][..., None, :]

    @property
    def points(self) -> Array:
        """The lowest point of the wheel where it stands upright."""
        return np.array([[0.0, 0.0, -self.radius]])

    @property
    def point_names(self) -> tuple[str, ...]:
        """The frame's name."""
        return (repr(self.frame),)

    def radius_as(self, like: Array) -> Array:
        """Return the radius in the number type of an array."""
        return convert(np.array(self.radius), like.dtype)

    def _wheel(self, rotation: Array) -> tuple[Array, Array, Array, Array]:
        """Return n and a, the sine of the angle between them, shape (..., 1), and r m, in the axes of the world."""
        n, a = (convert(np.array(way), rotation.dtype) for way in (self.normal, self.axis))
        a = np.matvec(rotation, a)
        up = n - _dot(n, a) * a
        upright = sqrt(_dot(up, up))
        if upright.dtype != object and not (np.abs(upright) > FLAT).all():
            where = at_first_index(np.abs(upright[..., 0]) <= FLAT)
            raise SingularError(f"contact {self.frame!r}: the wheel lies flat, and has no lowest point{where}")
        return n, a, upright, -self.radius_as(a) * up / upright


def _dot(a: Array, b: Array) -> Array:
    """Return a·b, shape (..., 1), of numbers of any kind."""
    return np.asarray((a * b).sum(axis=-1, keepdims=True))
