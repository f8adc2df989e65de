"""The kinds of contact with the world: points, soles, and frames that slide on a plane or along a rail (49.4, 49.9)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, as_constant, as_exactly
from ..errors import ShapeError
from ..model import readonly
from ..spatial import exp3
from .types import Contact, Motion, checked_frame, checked_motion, checked_restitution

__all__ = ["PointContact", "SlidingContact", "SurfaceContact"]

PARALLEL = 1e-9
"""Two normals with a smaller angle between them, rad, hold one direction."""


@dataclass(frozen=True)
class PointContact(Contact):
    """A point that does not move: three forces, no moment.

    Parameters
    ----------
    frame : str
        The frame at whose origin the robot touches.
    mu : float
        Coefficient of friction, at least 0.
    normal : array_like, shape (3,), optional
        Of the ground, out of it, in the axes of the world; any length but 0.
    velocity, acceleration : array_like, shape (3,), optional
        Of the ground, in the axes of the world: an elevator, a belt. At rest unless given.
    restitution : float, optional
        e, from 0 to 1, where it hits a ground of `simulate`; the ground's unless given.

    Raises
    ------
    ValueError
        If `mu` is not a number of at least 0, `normal` not a direction, `restitution` not from 0 to 1, or a motion not
        one number for each row.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.PointContact("FL_foot", 0.6).dim
    3
    """

    frame: str
    mu: float
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    velocity: Motion = field(default=(), kw_only=True)
    acceleration: Motion = field(default=(), kw_only=True)
    restitution: float | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "mu", _coefficient(self.frame, self.mu))
        normal = as_exactly(self.normal, f"contact {self.frame!r}: normal", 3)
        object.__setattr__(self, "normal", _unit(self.frame, "normal", normal))
        checked_motion(self, "velocity")
        checked_motion(self, "acceleration")
        checked_restitution(self)

    @property
    def rows(self) -> slice:
        """The three linear rows."""
        return slice(3, 6)

    def axes(self, rotation: Array) -> Array:
        """Return the axes of the world, turned the shortest way until z is the normal."""
        return np.broadcast_to(self._axes, rotation.shape)

    @cached_property
    def _axes(self) -> Array:
        return _normal_axes(self.normal)

    @property
    def points(self) -> Array:
        """The frame's origin."""
        return np.zeros((1, 3))

    @property
    def point_names(self) -> tuple[str, ...]:
        """The frame's name."""
        return (repr(self.frame),)


@dataclass(frozen=True)
class SurfaceContact(Contact):
    """A flat rectangular sole that neither moves nor turns: three moments and three forces.

    The sole can pass every wrench that is a sum of forces at its four corners, each in its own friction cone. So the
    centre of pressure stays within the sole. The moment about the normal is limited too: to μ √(x² + y²) f_z, with the
    half lengths (x, y), if the load is even and there is no other friction; to less otherwise.

    Parameters
    ----------
    frame : str
        At the middle of the sole; x and y along its sides, z the normal, into the robot.
    half_size : array_like, shape (2,)
        Half the lengths of the sole along the frame's x and y, m, above 0.
    mu : float
        Coefficient of friction, at least 0.
    velocity, acceleration : array_like, shape (6,), optional
        Of the ground at the frame's origin, (ω, v) and (α, a) in the axes of the world. At rest unless given.
    restitution : float, optional
        e, from 0 to 1, where it hits a ground of `simulate`; the ground's unless given.

    Raises
    ------
    ValueError
        If `mu` is not a number of at least 0, `half_size` not two numbers above 0, `restitution` not from 0 to 1, or a
        motion not one number for each row.

    Notes
    -----
    An edge, a rectangle of no width, is not a sole: it may turn about itself. Two `PointContact` at its ends hold all
    that an edge holds, five of six rows: one of them is redundant, which every function here allows.

    Caron, Pham and Nakamura (ICRA 2015) give the same limits for pyramids of four sides without the corners.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.SurfaceContact("left_sole", (0.076, 0.0275), 0.6).dim
    6
    """

    frame: str
    half_size: tuple[float, float]
    mu: float
    velocity: Motion = field(default=(), kw_only=True)
    acceleration: Motion = field(default=(), kw_only=True)
    restitution: float | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "mu", _coefficient(self.frame, self.mu))
        half = as_exactly(self.half_size, f"contact {self.frame!r}: half_size", 2)
        if (half <= 0).any():
            flat = "" if (half < 0).any() else "; a line is two PointContacts at its ends, and a point is one"
            raise ValueError(f"contact {self.frame!r}: half_size: expected lengths above 0, got {half.tolist()}{flat}")
        object.__setattr__(self, "half_size", tuple(half.tolist()))
        checked_motion(self, "velocity")
        checked_motion(self, "acceleration")
        checked_restitution(self)

    @property
    def rows(self) -> slice:
        """All six rows."""
        return slice(0, 6)

    def axes(self, rotation: Array) -> Array:
        """Return the frame's own axes."""
        return rotation

    @property
    def points(self) -> Array:
        """The four corners."""
        signs = np.array([[1, 1, 0], [1, -1, 0], [-1, 1, 0], [-1, -1, 0]])
        return signs * [*self.half_size, 0.0]

    @property
    def point_names(self) -> tuple[str, ...]:
        """The corners, by the signs of their x and y."""
        return tuple(f"corner ({x}, {y}) of {self.frame!r}" for x in "+-" for y in "+-")


@dataclass(frozen=True)
class SlidingContact(Contact):
    """A point that slides without friction: on a plane, which holds one direction, or along a rail, which holds two.

    A plane only pushes, where forces have limits; a rail holds both ways.

    Parameters
    ----------
    frame : str
        The frame at whose origin the robot touches.
    normals : array_like, shape (3,) or (2, 3)
        The directions that are held, in the axes of the world, or of `to`; any length but 0. Of a plane, out of it.
    to : str, optional
        A frame of the robot that carries the plane or the rail; the world unless given.
    velocity, acceleration : array_like, shape (k,), optional
        Of the plane or the rail along its k normals, m/s and m/s². At rest unless given.

    Raises
    ------
    ValueError
        If `normals` are not one or two directions that are independent, or a motion not one number for each.

    Examples
    --------
    A bead of 2 kg on a rail that descends at 30°, with an acceleration of g sin 30°:

    >>> import twistwrench as tw
    >>> solid = tw.SpatialInertia(2.0, [0, 0, 0], 0.01 * np.eye(3))
    >>> bead = tw.Builder("bead", base="floating", root="bead", root_inertia=solid).build()
    >>> rail = tw.SlidingContact("bead", [[0, 1, 0], [0.5, 0, 0.75**0.5]])
    >>> held = tw.contact_forward_dynamics(bead, bead.neutral(), np.zeros(6), np.zeros(6), [rail])
    >>> np.linalg.norm(held.qdd).round(9), held.forces["bead"].round(3)
    (np.float64(4.905), array([ 0.   , 16.991]))
    """

    frame: str
    normals: tuple[tuple[float, float, float], ...]
    to: str | None = None
    velocity: Motion = field(default=(), kw_only=True)
    acceleration: Motion = field(default=(), kw_only=True)
    mu = 0.0

    def __post_init__(self) -> None:
        checked_frame(self.frame)
        if self.to is not None:
            checked_frame(self.to)
        which = f"contact {self.frame!r}: normals"
        given = as_constant(as_array(self.normals, which, 3), which)
        if given.shape not in ((3,), (1, 3), (2, 3)):
            raise ShapeError(f"{which}: expected shape (3,) or (2, 3), got {given.shape}")
        units = [_unit(self.frame, "normals", n) for n in given.reshape(-1, 3)]
        if len(units) == 2 and not np.abs(np.cross(units[0], units[1])).max() > PARALLEL:
            raise ValueError(f"{which}: expected two directions that are independent, got {given.tolist()}")
        object.__setattr__(self, "normals", tuple(units))
        checked_motion(self, "velocity")
        checked_motion(self, "acceleration")

    @property
    def pushes(self) -> bool:  # type: ignore[override]
        """Whether it is a plane."""
        return len(self.normals) == 1

    @property
    def rows(self) -> slice:
        """The linear rows, of which those along the normals are held."""
        return slice(3, 6)

    @cached_property
    def directions(self) -> Array:
        """The normals."""
        return readonly(np.concatenate([np.zeros((len(self.normals), 3)), self.normals], axis=1))

    def axes(self, rotation: Array) -> Array:
        """Return axes with the first normal as z."""
        return np.broadcast_to(self._axes, rotation.shape)

    @cached_property
    def _axes(self) -> Array:
        return _normal_axes(self.normals[0])

    def turn(self, rotation: Array) -> Array:
        """Return the identity: λ is along the normals."""
        eye: Array = np.eye(self.dim, dtype=rotation.dtype)
        return np.broadcast_to(eye, (*rotation.shape[:-2], self.dim, self.dim))

    @cached_property
    def spread(self) -> Array:
        """The parts of a force along the normals, of which it is the sum; what is along the rail has no part."""
        return readonly(np.linalg.pinv(np.transpose(self.normals)) @ self._axes)

    @property
    def points(self) -> Array:
        """The frame's origin."""
        return np.zeros((1, 3))

    @property
    def point_names(self) -> tuple[str, ...]:
        """The frame's name."""
        return (repr(self.frame),)


def _normal_axes(normal: tuple[float, float, float]) -> Array:
    """Return the axes turned the shortest way until z is the normal."""
    x, y, z = normal
    sine = np.hypot(x, y)
    turn = np.arctan2(sine, z) / sine * np.array([-y, x, 0]) if sine > 0 else np.array([0.0 if z > 0 else np.pi, 0, 0])
    return exp3(turn)


def _unit(frame: str, name: str, n: Array) -> tuple[float, float, float]:
    if not n.any():
        raise ValueError(f"contact {frame!r}: {name}: expected a direction, got zero")
    n = n / np.abs(n).max()
    x, y, z = (n / np.sqrt(n @ n)).tolist()
    return x, y, z


def _coefficient(frame: str, mu: ArrayLike) -> float:
    checked_frame(frame)
    value = float(as_exactly(mu, f"contact {frame!r}: mu"))
    if value < 0:
        raise ValueError(f"contact {frame!r}: mu: expected at least 0, got {value:g}")
    return value
