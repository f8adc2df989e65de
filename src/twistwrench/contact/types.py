"""What a contact is: which motions it stops, and which forces it can bear (49.9, 49.4).

A contact holds a frame of the robot against the world, or against another frame of the robot, `to`. Its wrench λ acts
at the frame's origin, in two sets of axes: those of what holds it, in which Jacobians and results are written, and
the contact's own, whose z axis is the normal, out of the ground and into the robot, in which friction is written.

A new kind of contact defines which rows it constrains, the axes of its friction and its contact points;
everything in this folder needs no more.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.kinematics import frame_jacobian
from ..arrays import Array, as_exactly, as_number, convert
from ..errors import unknown_name
from ..model import Model, readonly
from ..spatial import SE3, log3
from ..spatial.rotation import cross_matrix
from .relative import FrameRows, Loop, Posture, StateMotion

__all__ = ["Contact", "Pyramid", "RowValues", "check_given", "checked_frame"]

Pyramid = Literal["inner", "outer"]

RowValues = tuple[float, ...]
"""One number for each row that a contact holds; none where it is at rest."""


class Contact(ABC):
    """A frame that is held by its surroundings. It does not change: programs are made for it.

    Attributes
    ----------
    frame : str
        The robot's frame.
    to : str or None
        The frame of the robot that holds it; None for the world.
    mu : float
        Coefficient of friction, at least 0: each contact point bears forces with √(f_x² + f_y²) ≤ μ f_z.
    velocity, acceleration : tuple of float
        Of what holds it: J v and J q̈ + J̇ v are these, m/s and m/s², rad/s and rad/s². Empty at rest.
    pushes : bool
        Whether forces have the limits above. If not, the contact bears any, and pulls as well.
    divides : bool
        Whether its rows divide by a length, which may be zero.
    restitution : float or None
        e, from 0 to 1, where it hits a ground; None for the ground's.
    """

    frame: str
    mu: float
    to: str | None = None
    velocity: RowValues = ()
    acceleration: RowValues = ()
    pushes: bool = True
    divides: bool = False
    restitution: float | None = None

    @property
    @abstractmethod
    def rows(self) -> slice:
        """Which of the six rows (ω, v) of the frame's twist are constrained."""

    @abstractmethod
    def axes(self, rotation: Array) -> Array:
        """Return the contact's axes in the world, or in `to`, z the normal, shape (..., 3, 3).

        Parameters
        ----------
        rotation : ndarray, shape (..., 3, 3)
            The frame's axes there.
        """

    @property
    @abstractmethod
    def points(self) -> Array:
        """The contact points, in the contact's axes from the frame's origin, shape (k, 3), m."""

    @property
    @abstractmethod
    def point_names(self) -> tuple[str, ...]:
        """The names of the k points in messages."""

    def arms(self, rotation: Array) -> Array:
        """Return the contact points, from the frame's origin in the axes of the world, shape (..., k, 3).

        Parameters
        ----------
        rotation : ndarray, shape (..., 3, 3)
            The frame's axes in the world.
        """
        arms: Array = self.points @ self.axes(rotation).mT
        return arms

    def check(self, model: Model) -> None:
        """Raise an error if no joint of the model moves the contact.

        Parameters
        ----------
        model : Model

        Raises
        ------
        NameNotFound
            If the model has no such frame.
        ValueError
            If the frame does not move in what holds it.
        """
        body = model.frame(self.frame).body
        if body == 0:
            raise ValueError(f"contact {self.frame!r}: the world carries this frame; it cannot touch anything")
        if self.to is not None and body == model.frame(self.to).body:
            raise ValueError(f"contact {self.frame!r}: expected frames of two bodies, got {self.to!r} of the same one")

    def jacobian(self, model: Model, q: Array) -> Array:
        """Return the rows of J that the contact holds: see `twistwrench.constraint_jacobian`.

        Parameters
        ----------
        model : Model
        q : ndarray, shape (..., nq)

        Returns
        -------
        ndarray, shape (..., dim, nv)
        """
        if self.to is None:
            return convert(self.directions, q.dtype) @ frame_jacobian(model, q, self.frame, "local_world_aligned")
        return self.kinematics(StateMotion.of(model, q, np.zeros(model.nv, q.dtype)))[1]

    def place(self, at: Posture) -> SE3:
        """Return where the contact is in what holds it.

        Of a coupling the translation (q − Σ ratio q, 0, 0), which stays as it is; of points at a distance (d, 0, 0).
        """
        return self.held_place(Loop.of(at.model, self.frame, self.to, at.q.dtype).place(at))

    def kinematics(self, state: StateMotion) -> tuple[SE3, Array, Array]:
        """Return where the contact is in what holds it, and its rows of J and of J̇ v."""
        rows = Loop.of(state.model, self.frame, self.to, state.q.dtype).rows(state)
        return self.held_place(SE3._trusted(rows.rotation, rows.point)), *self.held_rows(rows)

    def keeps_place(self, model: Model) -> bool:
        """Return whether a configuration is held, from which it may drift: not where q of a joint counts no turns."""
        return all(model.joints[model.joint_id(name)].nq == 1 for name in self.joints)  # type: ignore[union-attr]

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints that the contact holds by their own q; none where it holds a frame."""
        return ()

    @cached_property
    def directions(self) -> Array:
        """N, which picks what is held of the six rows (ω, v), in the axes of the world or of `to`, shape (dim, 6)."""
        return readonly(np.eye(6)[self.rows])

    def held_rows(self, rows: FrameRows) -> tuple[Array, Array]:
        """Return what the contact holds of J and of J̇ v of its frame: shapes (..., dim, nv) and (..., dim)."""
        N = convert(self.directions, rows.bias.dtype)
        return N @ rows.J, np.matvec(N, rows.bias)

    def held_place(self, T: SE3) -> SE3:
        """Return what the contact keeps of the frame's placement in what holds it: the placement itself."""
        return T

    def held_turn(self, R: Array) -> Array:
        """Return the turn R from the anchor, in the axes of what holds the contact, as a rotation vector."""
        return log3(R)

    @property
    def placed(self) -> Array:
        """What is held of the frame's place, its turn and its shift, shape (dim, 6): `directions` unless it rolls."""
        return self.directions

    @property
    def dim(self) -> int:
        """The number of constrained rows: 3 for a point, 6 for a surface."""
        return len(self.directions)

    @property
    def frames(self) -> tuple[str, ...]:
        """The robot's frames that the contact is about."""
        return (self.frame,) if self.to is None else (self.frame, self.to)

    def row_rotation(self, rotation: Array) -> Array:
        """Return the matrix that takes λ from the contact's own axes to those of its rows, shape (..., dim, dim).

        Parameters
        ----------
        rotation : ndarray, shape (..., 3, 3)
            As `axes`.
        """
        R = self.axes(rotation).astype(rotation.dtype, copy=False)
        both = np.zeros((*R.shape[:-2], 6, 6), R.dtype)
        both[..., :3, :3] = both[..., 3:, 3:] = R
        return both[..., self.rows, self.rows]

    @cached_property
    def grasp_map(self) -> Array:
        """The matrix G that makes λ of forces at the points, in the contact's axes, shape (dim, 3 k)."""
        return readonly(self.wrench_map()[self.rows])

    def wrench_map(self) -> Array:
        """Return the matrix that makes the whole wrench (τ, f) of forces at the points, shape (6, 3 k)."""
        return np.concatenate([np.concatenate([cross_matrix(p), np.eye(3)]) for p in self.points], axis=1)

    @cached_property
    def grasp_cholesky(self) -> Array:
        """The lower triangle L with L Lᵀ = G Gᵀ, shape (dim, dim)."""
        return readonly(np.linalg.cholesky(self.grasp_map @ self.grasp_map.mT))

    def limits(self, sides: int, pyramid: Pyramid) -> Array:
        """Return A, shape (k (sides + 1), 3 k): the contact bears the forces f at its points where A f ≤ 0.

        For each point the sides of a pyramid in place of the cone, the first facing x, and f_z ≥ 0 last. The limits
        of a surface as a whole (centre of pressure within the sole, moment about the normal) follow from its
        corners.

        Parameters
        ----------
        sides : int
            Of the pyramid, at least 3.
        pyramid : {"inner", "outer"}
            With its edges on the cone, so that no force in it slips, or with its sides against the cone, so that
            no force that holds is left out.

        Raises
        ------
        ValueError
            If `sides` is not a whole number of at least 3, or the pyramid is neither.
        """
        sides = _checked(sides, pyramid)
        if not self.pushes:
            return np.zeros((0, 3 * len(self.points)))
        slope = self.mu * (np.cos(np.pi / sides) if pyramid == "inner" else 1.0)
        angle = 2 * np.pi * np.arange(sides) / sides
        one = np.stack([np.cos(angle), np.sin(angle), np.full(sides, -slope)], axis=-1)
        return np.kron(np.eye(len(self.points)), np.concatenate([one, [[0.0, 0.0, -1.0]]]))

    def rays(self, sides: int, pyramid: Pyramid) -> Array:
        """Return the edges of the pyramids, shape (k sides, 3 k): `limits` allow the nonnegative sums of them.

        Of use only while `limits` are those of this class; a contact with its own needs no rays.

        Parameters
        ----------
        sides, pyramid
            As `limits`.

        Raises
        ------
        ValueError
            As `limits`.

        Examples
        --------
        >>> import twistwrench as tw
        >>> foot = tw.PointContact("FL_foot", 0.5)
        >>> bool((foot.limits(8, "inner") @ foot.rays(8, "inner").T).max() < 1e-15)
        True
        """
        sides = _checked(sides, pyramid)
        slope = self.mu / (1.0 if pyramid == "inner" else np.cos(np.pi / sides))
        angle = 2 * np.pi * (np.arange(sides) + 0.5) / sides
        one = np.stack([slope * np.cos(angle), slope * np.sin(angle), np.ones(sides)], axis=-1)
        return np.kron(np.eye(len(self.points)), one)

    def limit_names(self, sides: int) -> list[str]:
        """Return the names of the rows of `limits` in messages, one for each."""
        names = self.point_names if self.pushes else ()
        return [f"{kind} at {point}" for point in names for kind in (*["friction"] * sides, "lift-off")]


def _checked(sides: int, pyramid: Pyramid) -> int:
    """Return the number of sides; raise for an invalid one, or an invalid pyramid."""
    if not isinstance(sides, int | np.integer) or sides < 3:
        raise ValueError(f"sides: expected a whole number, at least 3, got {sides!r}")
    if not isinstance(pyramid, str) or pyramid not in ("inner", "outer"):
        raise ValueError(f"pyramid: expected 'inner' or 'outer', got {pyramid!r}")
    return int(sides)


def check_given(contact: Contact) -> None:
    """Check what a contact may be given: a motion, one number for each row, and a restitution from 0 to 1."""
    for name in ("velocity", "acceleration"):
        given: ArrayLike = getattr(contact, name)
        if not (isinstance(given, tuple) and not given):
            checked = as_exactly(given, f"contact {contact.frame!r}: {name}", contact.dim)
            object.__setattr__(contact, name, tuple(checked.tolist()))
    if contact.restitution is not None:
        which = f"contact {contact.frame!r}: restitution"
        if not 0 <= as_number(contact.restitution, which) <= 1:
            raise ValueError(f"{which}: expected a number from 0 to 1, got {contact.restitution!r}")
        object.__setattr__(contact, "restitution", float(contact.restitution))


def checked_frame(frame: str) -> None:
    """Raise if the name of a frame is not a text."""
    if not isinstance(frame, str):
        raise unknown_name("frame", frame, ())
