"""Contacts within the robot: loops of bodies, and joints that gears couple (49.9).

The same rows as for the ground, J v = 0, hold two frames of one robot together; their forces act on both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import DTypeLike

from ..arrays import Array, as_exactly, as_flag, convert
from ..errors import SingularError
from ..model import Model, readonly
from ..spatial import SE3, log3
from ..spatial._elementary import at_first_index, sqrt
from .kinds import dot, normal_axes, unit_direction
from .relative import FrameRows, Posture, StateMotion
from .types import Contact, RowValues, check_given, checked_frame

__all__ = ["Coupling", "DistanceConstraint", "LoopClosure"]

WELD_ARM_M = 0.1
"""Of a weld that is held more often than needed, forces at so many metres from it weigh as much as those in it."""


MIN_SINE = 1e-8
"""An axis that is turned over within this angle, rad, has no direction back."""


class _Internal(Contact):
    """A contact that bears any force, and has none from outside the robot."""

    mu = 0.0
    pushes = False

    def axes(self, rotation: Array) -> Array:
        """Return those of the rows."""
        return np.broadcast_to(np.eye(3), rotation.shape)

    @property
    def points(self) -> Array:
        """The frame's origin."""
        return np.zeros((1, 3))

    @property
    def point_names(self) -> tuple[str, ...]:
        """The frame's name, for each point."""
        return (repr(self.frame),) * len(self.points)


@dataclass(frozen=True)
class LoopClosure(_Internal):
    """Two frames of one robot that stay together: as a ball joint does, as a hinge does, or welded.

    A frame's origin, or all of it, keeps its place in the frame `to`; with an axis it turns about that alone. A tree of
    bodies becomes a loop: a four-bar, a box that two hands hold. λ acts on `frame`, in the axes of `to`, and the
    opposite wrench on `to` at the same point.

    Parameters
    ----------
    frame, to : str
        On two bodies.
    welded : bool, optional
        Whether the frame cannot turn either: six rows (ω, v) instead of three.
    axis : array_like, shape (3,), optional
        Of a hinge through the frame's origin, in the axes of `to`; any length but 0. Five rows: ω about x and y of the
        axes of `to`, turned the shortest way until z is the axis, then v.
    velocity, acceleration : array_like, shape (3,), (5,) or (6,), optional
        Of the frame in `to`, in the axes of the rows. At rest unless given. The axis of a hinge cannot turn in `to`.

    Raises
    ------
    ValueError
        If a motion is not one number for each row, or turns the axis; if `axis` is zero, or given with `welded`.
    TypeError
        If `welded` is not a bool.

    Examples
    --------
    A parallelogram of two cranks and a bar, in which both cranks turn alike:

    >>> import twistwrench as tw
    >>> bar = tw.SpatialInertia.from_rod(1.0, 1.0)
    >>> builder, side = tw.Builder("parallelogram", gravity=[0, 0, 0]), tw.SE3(np.eye(3), [1.0, 0, 0])
    >>> for name, on, at in (("a", "base_link", None), ("b", "a", side), ("c", "base_link", side)):
    ...     builder.link(name, parent=on, joint=tw.Revolute("y"), inertia=bar, placement=at)
    >>> _ = builder.link("end", parent="b", placement=side), builder.link("tip", parent="c", placement=side)
    >>> model, loop = builder.build(), [tw.LoopClosure("end", "tip")]
    >>> held = tw.contact_forward_dynamics(model, [-0.3, 0.3, -0.3], np.zeros(3), [1.0, 0, 0], loop)
    >>> held.qdd.round(9), int(held.rank), int(held.redundant)  # 1 / (1/12 + 1 + 1/12)
    (array([ 0.85714286, -0.85714286,  0.85714286]), 2, 1)
    >>> int(tw.contact_forward_dynamics(model, [-0.3, 0.3, -0.3], np.zeros(3), [1.0, 0, 0],
    ...                                 [tw.LoopClosure("end", "tip", axis=[0, 1, 0])]).redundant)  # in a plane
    3
    """

    frame: str
    to: str = field()
    welded: bool = False
    axis: tuple[float, float, float] | None = field(default=None, kw_only=True)
    velocity: RowValues = field(default=(), kw_only=True)
    acceleration: RowValues = field(default=(), kw_only=True)

    def __post_init__(self) -> None:
        checked_frame(self.frame)
        checked_frame(self.to)
        which = f"contact {self.frame!r}"
        object.__setattr__(self, "welded", as_flag(self.welded, f"{which}: welded"))
        if self.axis is not None:
            if self.welded:
                raise ValueError(f"{which}: expected an axis to turn about, or welded=True, got both")
            axis = as_exactly(self.axis, f"{which}: axis", 3)
            object.__setattr__(self, "axis", unit_direction(self.frame, "axis", axis))
        check_given(self)
        for name in ("velocity", "acceleration"):
            if self.axis is not None and any(getattr(self, name)[:2]):
                raise ValueError(f"{which}: {name}: expected no turn of the axis in {self.to!r}: its first two are 0")

    @property
    def rows(self) -> slice:
        """The three linear rows; all six of a weld, of which a hinge leaves one free."""
        return slice(3 if self._is_ball else 0, 6)

    @property
    def _is_ball(self) -> bool:
        return self.axis is None and not self.welded

    @property
    def points(self) -> Array:
        """The frame's origin; of a weld and of a hinge six points around it."""
        return np.zeros((1, 3)) if self._is_ball else WELD_ARM_M * np.concatenate([np.eye(3), -np.eye(3)])

    @cached_property
    def directions(self) -> Array:
        """The rows; of a hinge those across its axis, and the linear ones."""
        rows = np.eye(6)[self.rows]
        if self.axis is None:
            return readonly(rows)
        across = normal_axes(self.axis).mT[:2]
        return readonly(np.concatenate([across @ rows[:3], rows[3:]]))

    def row_rotation(self, rotation: Array) -> Array:
        """Return the identity: λ is in the axes of the rows."""
        eye: Array = np.eye(self.dim, dtype=rotation.dtype)
        return np.broadcast_to(eye, (*rotation.shape[:-2], self.dim, self.dim))

    @cached_property
    def grasp_map(self) -> Array:
        """The matrix that makes λ of forces at the points, shape (dim, 3 k)."""
        return readonly(self.directions @ self.wrench_map())

    def held_turn(self, R: Array) -> Array:
        """Return the turn from the anchor; of a hinge that of its axis, however far it has turned about it."""
        if self.axis is None:
            return log3(R)
        axis = np.array(self.axis)
        now = np.matvec(R, axis)
        across = np.cross(axis, now)
        sine = np.linalg.norm(across, axis=-1)[..., None]
        cosine = (now * axis).sum(axis=-1, keepdims=True)
        over = (sine < MIN_SINE) & (cosine < 0)  # all ways back are as long
        unit = np.where(over, self.directions[0, :3], across / np.where(sine > 0, sine, 1))
        tilt: Array = np.arctan2(sine, cosine) * unit
        return tilt


@dataclass(frozen=True)
class DistanceConstraint(_Internal):
    """Two points of one robot that stay at their distance: a rod without mass, with a ball joint at each end.

    The origin of a frame keeps its distance from that of the frame `to`: a leg of a parallel robot, a coupler, a
    rope that stays taut. λ is the force along the line, N, positive where it pushes the two apart.

    Parameters
    ----------
    frame, to : str
        On two bodies; `to` may be on the world.
    velocity, acceleration : array_like, shape (1,), optional
        Of the distance, m/s and m/s²: a leg that a motor extends. It does not change unless given.

    Raises
    ------
    ValueError
        If a motion is not one number.

    Notes
    -----
    d² = |p|², so that d̈ = n·p̈ + |ṗ − n (n·ṗ)|²/d with n = p/d. Where the points meet, the line has no direction:
    SingularError.

    Examples
    --------
    A body of 2 kg on a line of 1 m, at 3 m/s below the hook: the line carries m g + m v²/d.

    >>> import twistwrench as tw
    >>> solid = tw.SpatialInertia(2.0, [0, 0, 0], 0.01 * np.eye(3))
    >>> builder = tw.Builder("bob")
    >>> _ = builder.link("bob", parent="base_link", joint=tw.FreeFlyer(), inertia=solid)
    >>> model, line = builder.build(), [tw.DistanceConstraint("bob", "base_link")]
    >>> q, v = [0, 0, -1, 0, 0, 0, 1], np.array([0, 0, 0, 3.0, 0, 0])
    >>> tw.contact_forward_dynamics(model, q, v, 0 * v, line).forces["bob"]  # pulls
    array([-37.62])
    """

    frame: str
    to: str = field()
    velocity: RowValues = field(default=(), kw_only=True)
    acceleration: RowValues = field(default=(), kw_only=True)
    divides = True

    def __post_init__(self) -> None:
        checked_frame(self.frame)
        checked_frame(self.to)
        check_given(self)

    @property
    def rows(self) -> slice:
        """One row: it stands for the first linear one."""
        return slice(3, 4)

    def held_place(self, T: SE3) -> SE3:
        """Return the distance as the translation (d, 0, 0)."""
        d = self._distance(T.translation)
        turn = np.broadcast_to(np.eye(3, dtype=d.dtype), T.rotation.shape)
        return SE3._trusted(turn, np.concatenate([d, 0 * d, 0 * d], axis=-1))

    def held_rows(self, rows: FrameRows) -> tuple[Array, Array]:
        """Return the row along the line, and d̈ without q̈."""
        J, d = rows.J[..., 3:, :], self._distance(rows.point)
        n = rows.point / d
        rate = np.matvec(J, rows.v)
        across = rate - n * dot(n, rate)
        return n[..., None, :] @ J, dot(n, rows.bias[..., 3:]) + dot(across, across) / d

    def _distance(self, point: Array) -> Array:
        d = sqrt(dot(point, point))
        if d.dtype != object and not d.all():
            where = at_first_index(d[..., 0] == 0)
            raise SingularError(f"contact {self.frame!r}: its points meet, so the line has no direction{where}")
        return d


@dataclass(frozen=True)
class Coupling(_Internal):
    """A joint that others drive: its rate is the sum of theirs, each times a ratio. Gears, belts, a differential.

    λ is the force on the joint itself, N m or N; on each of the others it is −ratio times as large.

    Parameters
    ----------
    frame : str
        The joint, of one degree of freedom.
    ratios : mapping of str to float
        By the names of the other joints; −0.5 for a pair of gears that halves the rate and turns it around. An empty
        one leaves the joint alone: it has the given velocity, or is locked.
    velocity, acceleration : array_like, shape (1,), optional
        What is added to the sum, rad/s or m/s. Zero unless given.

    Raises
    ------
    ValueError
        If a ratio is not a finite number, if the joint drives itself, or a motion is not one number.
    TypeError
        If `ratios` is not a mapping.

    Notes
    -----
    A configuration is held where q counts the turns. With a continuous joint only the rates are.

    Examples
    --------
    A motor of inertia J₂ that drives an arm of J₁ by gears of 1 : 10 lends it J₁ + 10² J₂:

    >>> import twistwrench as tw
    >>> pair = tw.Builder("gears", gravity=[0, 0, 0])
    >>> for name, J in (("arm", 2.0), ("motor", 0.05)):
    ...     disc = tw.SpatialInertia(1.0, [0, 0, 0], np.diag([J, J, 1.5 * J]) / 1.5)
    ...     _ = pair.link(name, parent="base_link", joint=tw.Revolute("z"), inertia=disc, joint_name=name)
    >>> pair, gears = pair.build(), [tw.Coupling("motor", {"arm": -10.0})]
    >>> tw.contact_forward_dynamics(pair, [0, 0], [0, 0], [14.0, 0], gears).qdd
    array([  2., -20.])
    """

    frame: str
    ratios: tuple[tuple[str, float], ...]
    velocity: RowValues = field(default=(), kw_only=True)
    acceleration: RowValues = field(default=(), kw_only=True)

    def __post_init__(self) -> None:
        checked_frame(self.frame)
        given = dict(self.ratios) if isinstance(self.ratios, tuple) else self.ratios
        if not isinstance(given, Mapping):
            raise TypeError(f"coupling {self.frame!r}: ratios: expected a mapping of joints to numbers, got {given!r}")
        if self.frame in given:
            raise ValueError(f"coupling {self.frame!r}: ratios: expected other joints, got the joint itself")
        ratios = (
            (name, float(as_exactly(x, f"coupling {self.frame!r}: ratio of {name!r}"))) for name, x in given.items()
        )
        object.__setattr__(self, "ratios", tuple(ratios))
        check_given(self)

    def check(self, model: Model) -> None:
        """Raise an error if one of these is not a joint of one degree of freedom."""
        for name in self.frames:
            if model.joints[model.joint_id(name)].nv != 1:  # type: ignore[union-attr]
                raise ValueError(f"coupling {self.frame!r}: expected joints of one degree of freedom, got {name!r}")

    def coefficients(self, model: Model, entries: Sequence[slice], n: int, dtype: DTypeLike) -> Array:
        """Return the coupling as a row, shape (1, n), where joint i of a model has these entries."""
        row = np.zeros((1, n))
        for name, x in ((self.frame, -1.0), *self.ratios):
            row[:, entries[model.joint_id(name)]] = -x
        return convert(row, dtype)

    def jacobian(self, model: Model, q: Array) -> Array:
        """Return the row of J, which does not depend on q."""
        row = self.coefficients(model, model.v_slice, model.nv, q.dtype)
        return np.broadcast_to(row, (*q.shape[:-1], 1, model.nv))

    def place(self, at: Posture) -> SE3:
        """Return the translation (q − Σ ratio q, 0, 0), zero where q does not count the turns."""
        model, q = at.model, at.q
        off = np.zeros((*q.shape[:-1], 3), q.dtype)
        if self.keeps_place(model):
            off[..., :1] = np.matvec(self.coefficients(model, model.q_slice, model.nq, q.dtype), q)
        return SE3._trusted(np.broadcast_to(np.eye(3, dtype=q.dtype), (*q.shape[:-1], 3, 3)), off)

    def kinematics(self, state: StateMotion) -> tuple[SE3, Array, Array]:
        """Return its place, its row of J, and J̇ v = 0."""
        q = state.q
        return self.place(state.posture), self.jacobian(state.model, q), np.zeros((*q.shape[:-1], 1), q.dtype)

    @property
    def rows(self) -> slice:
        """One row: it stands for the first linear one."""
        return slice(3, 4)

    @property
    def frames(self) -> tuple[str, ...]:
        """The joints' own frames, which have their names."""
        return self.joints

    @property
    def joints(self) -> tuple[str, ...]:
        """The driven joint and those that drive it."""
        return (self.frame, *(name for name, _ in self.ratios))
