"""The kinds of contact with the world (49.4, 49.9).

Points, soles, frames that slide on a plane or along a rail; balls, which touch at another point of the body as they
turn; thin wheels, which touch with the rim at another point as they roll, lean and steer.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, as_constant, as_exactly, convert
from ..errors import ShapeError, SingularError
from ..model import Model, readonly
from ..spatial import SE3, exp3
from ..spatial._elementary import at_first_index, sqrt
from ..spatial.rotation import cross_matrix
from .relative import FrameRows, StateMotion
from .types import Contact, RowValues, check_given, checked_frame

__all__ = [
    "PointContact",
    "SlidingContact",
    "SphereContact",
    "SurfaceContact",
    "WheelContact",
    "dot",
    "normal_axes",
    "unit_direction",
]

MIN_ANGLE_RAD = 1e-9
"""Two normals with a smaller angle between them, rad, hold one direction."""

FLAT_SINE = 1e-9
"""Sine of the angle between axle and normal: below, the wheel lies flat."""


class _OnPlane(Contact):
    """A contact at one point of a plane, of which it has the normal."""

    normal: tuple[float, float, float]

    @property
    def rows(self) -> slice:
        """The three linear rows."""
        return slice(3, 6)

    def axes(self, rotation: Array) -> Array:
        """Return the axes of the world, turned the shortest way until z is the normal."""
        return np.broadcast_to(self._axes, rotation.shape)

    @cached_property
    def _axes(self) -> Array:
        return normal_axes(self.normal)

    @property
    def point_names(self) -> tuple[str, ...]:
        """The frame's name."""
        return (repr(self.frame),)


class _Rolling(_OnPlane):
    """A contact of a body that rolls on a plane: it touches at its lowest point."""

    radius: float

    @cached_property
    def placed(self) -> Array:
        """The height alone."""
        n = np.array(self.normal)
        return readonly(np.concatenate([np.zeros((3, 3)), np.outer(n, n)], axis=1))

    @property
    def points(self) -> Array:
        """The lowest point."""
        return np.array([[0.0, 0.0, -self.radius]])


@dataclass(frozen=True)
class PointContact(_OnPlane):
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
    velocity: RowValues = field(default=(), kw_only=True)
    acceleration: RowValues = field(default=(), kw_only=True)
    restitution: float | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "mu", _coefficient(self.frame, self.mu))
        normal = as_exactly(self.normal, f"contact {self.frame!r}: normal", 3)
        object.__setattr__(self, "normal", unit_direction(self.frame, "normal", normal))
        check_given(self)

    @property
    def points(self) -> Array:
        """The frame's origin."""
        return np.zeros((1, 3))


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
    velocity: RowValues = field(default=(), kw_only=True)
    acceleration: RowValues = field(default=(), kw_only=True)
    restitution: float | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "mu", _coefficient(self.frame, self.mu))
        half = as_exactly(self.half_size, f"contact {self.frame!r}: half_size", 2)
        if (half <= 0).any():
            flat = "" if (half < 0).any() else "; a line is two PointContacts at its ends, and a point is one"
            raise ValueError(f"contact {self.frame!r}: half_size: expected lengths above 0, got {half.tolist()}{flat}")
        object.__setattr__(self, "half_size", tuple(half.tolist()))
        check_given(self)

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
    >>> np.linalg.norm(held.qdd).round(9), held.forces["bead"].round(3) + 0.0
    (np.float64(4.905), array([ 0.   , 16.991]))
    """

    frame: str
    normals: tuple[tuple[float, float, float], ...]
    to: str | None = None
    velocity: RowValues = field(default=(), kw_only=True)
    acceleration: RowValues = field(default=(), kw_only=True)
    mu = 0.0

    def __post_init__(self) -> None:
        checked_frame(self.frame)
        if self.to is not None:
            checked_frame(self.to)
        which = f"contact {self.frame!r}: normals"
        given = as_constant(as_array(self.normals, which, 3), which)
        if given.shape not in ((3,), (1, 3), (2, 3)):
            raise ShapeError(f"{which}: expected shape (3,) or (2, 3), got {given.shape}")
        units = [unit_direction(self.frame, "normals", n) for n in given.reshape(-1, 3)]
        if len(units) == 2 and not np.abs(np.cross(units[0], units[1])).max() > MIN_ANGLE_RAD:
            raise ValueError(f"{which}: expected two directions that are independent, got {given.tolist()}")
        object.__setattr__(self, "normals", tuple(units))
        check_given(self)

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
        return normal_axes(self.normals[0])

    def row_rotation(self, rotation: Array) -> Array:
        """Return the identity: λ is along the normals."""
        eye: Array = np.eye(self.dim, dtype=rotation.dtype)
        return np.broadcast_to(eye, (*rotation.shape[:-2], self.dim, self.dim))

    @cached_property
    def grasp_map(self) -> Array:
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


def normal_axes(normal: tuple[float, float, float]) -> Array:
    """Return the axes turned the shortest way until z is the normal."""
    x, y, z = normal
    sine = np.hypot(x, y)
    turn = np.arctan2(sine, z) / sine * np.array([-y, x, 0]) if sine > 0 else np.array([0.0 if z > 0 else np.pi, 0, 0])
    return exp3(turn)


def unit_direction(frame: str, name: str, n: Array) -> tuple[float, float, float]:
    """Return a direction with the length 1; raise if it is zero."""
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


def _length(frame: str, radius: ArrayLike) -> float:
    value = float(as_exactly(radius, f"contact {frame!r}: radius"))
    if value <= 0:
        raise ValueError(f"contact {frame!r}: radius: expected a length above 0, got {value:g}")
    return value


@dataclass(frozen=True)
class SphereContact(_Rolling):
    """A ball on a plane: it touches at its lowest point, which is another one of the body as it turns.

    That point moves with v + ω × (−r n), where v is the velocity of the centre and n the normal. Where it sticks, the
    ball rolls.

    Parameters
    ----------
    frame : str
        At the centre of the ball.
    radius : float
        r, m, above 0.
    mu : float
        Coefficient of friction, at least 0.
    normal : array_like, shape (3,), optional
        n, out of the ground, in the axes of the world; any length but 0.
    restitution : float, optional
        e, from 0 to 1, where it hits a ground of `simulate`; the ground's unless given.

    Raises
    ------
    ValueError
        If `radius` is not a number above 0, `mu` not one of at least 0, `normal` not a direction, or `restitution` not
        from 0 to 1.

    Notes
    -----
    Rolling is not holonomic: of the place of a ball that sticks only its height is held (`project_state`), and of its
    velocity all.

    Examples
    --------
    A solid ball rolls down a slope with 5/7 of g sin 30°:

    >>> import twistwrench as tw
    >>> solid = tw.SpatialInertia(2.0, [0, 0, 0], 0.4 * 2.0 * 0.1**2 * np.eye(3))
    >>> ball = tw.Builder("ball", base="floating", root="ball", root_inertia=solid).build()
    >>> touch = [tw.SphereContact("ball", 0.1, 0.6, normal=[0.5, 0, 0.75**0.5])]
    >>> rolls = tw.contact_forward_dynamics(ball, ball.neutral(), np.zeros(6), np.zeros(6), touch)
    >>> np.linalg.norm(rolls.qdd[3:]).round(9), round(5 / 7 * 9.81 / 2, 9)
    (np.float64(3.503571429), 3.503571429)
    """

    frame: str
    radius: float
    mu: float
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    restitution: float | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "mu", _coefficient(self.frame, self.mu))
        normal = as_exactly(self.normal, f"contact {self.frame!r}: normal", 3)
        object.__setattr__(self, "radius", _length(self.frame, self.radius))
        object.__setattr__(self, "normal", unit_direction(self.frame, "normal", normal))
        check_given(self)

    @cached_property
    def directions(self) -> Array:
        """The rows (ω, v) of the lowest point, at −r n from the centre."""
        down = -self.radius * np.array(self.normal)
        return readonly(np.concatenate([-cross_matrix(down), np.eye(3)], axis=1))


@dataclass(frozen=True)
class WheelContact(_Rolling):
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
        object.__setattr__(self, "radius", _length(self.frame, self.radius))
        for name in ("axis", "normal"):
            given = as_exactly(getattr(self, name), f"contact {self.frame!r}: {name}", 3)
            object.__setattr__(self, name, unit_direction(self.frame, name, given))
        check_given(self)

    def jacobian(self, model: Model, q: Array) -> Array:
        """Return the rows of J of the point that touches."""
        return self.kinematics(StateMotion.of(model, q, np.zeros(model.nv, q.dtype)))[1]

    def held_rows(self, rows: FrameRows) -> tuple[Array, Array]:
        """Return the rows of the point that touches, and its J̇ v: the point moves along the rim as well."""
        n, a, upright, arm = self._wheel(rows.rotation)
        J = rows.J[..., 3:, :] - cross_matrix(arm) @ rows.J[..., :3, :]
        w = np.matvec(rows.J[..., :3, :], rows.v)
        leans, turns = dot(n, a), np.cross(w, a)  # n·a, and the rates of the axle and of n·a
        rate = dot(n, turns)
        moves = self.radius_as(a) * (rate * a + leans * turns) / upright - arm * (-leans * rate) / (upright * upright)
        bias = rows.bias[..., 3:] + np.cross(rows.bias[..., :3], arm) + np.cross(w, moves)
        return J, bias

    def held_place(self, T: SE3) -> SE3:
        """Return the placement of the frame's axes at the point that touches."""
        arm = self._wheel(T.rotation)[3]
        return SE3._trusted(T.rotation, T.translation + arm)

    def arms(self, rotation: Array) -> Array:
        """Return the lowest point of the rim."""
        return self._wheel(rotation)[3][..., None, :]

    def radius_as(self, like: Array) -> Array:
        """Return the radius in the number type of an array."""
        return convert(np.array(self.radius), like.dtype)

    def _wheel(self, rotation: Array) -> tuple[Array, Array, Array, Array]:
        """Return n and a, the sine of the angle between them, shape (..., 1), and r m, in the axes of the world."""
        n, a = (convert(np.array(way), rotation.dtype) for way in (self.normal, self.axis))
        a = np.matvec(rotation, a)
        up = n - dot(n, a) * a
        upright = sqrt(dot(up, up))
        if upright.dtype != object and not (np.abs(upright) > FLAT_SINE).all():
            where = at_first_index(np.abs(upright[..., 0]) <= FLAT_SINE)
            raise SingularError(f"contact {self.frame!r}: the wheel lies flat, and has no lowest point{where}")
        return n, a, upright, -self.radius_as(a) * up / upright


def dot(a: Array, b: Array) -> Array:
    """Return a·b, shape (..., 1), of numbers of any kind."""
    return np.asarray((a * b).sum(axis=-1, keepdims=True))
