"""The kinds of contact: which motions each one stops, and which forces it can bear (49.9, 49.4).

A contact holds a frame of the robot against something that does not move. Its wrench λ acts on the robot at the
frame's origin, in two sets of axes: the world's, in which Jacobians and results are written, and the contact's own,
whose z axis is the normal, out of the ground and into the robot, in which friction is written.

A new kind of contact defines which rows it constrains, the axes of its friction and its contact points;
everything in this folder needs no more.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_exactly
from ..errors import unknown_name
from ..model import readonly
from ..spatial import exp3
from ..spatial.rotation import cross_matrix

__all__ = ["Contact", "PointContact", "Pyramid", "SurfaceContact"]

Pyramid = Literal["inner", "outer"]


class Contact(ABC):
    """A frame that is held at rest by its surroundings. It does not change: programs are made for it.

    Attributes
    ----------
    frame : str
        The robot's frame.
    mu : float
        Coefficient of friction, at least 0: each contact point bears forces with √(f_x² + f_y²) ≤ μ f_z.
    """

    frame: str
    mu: float

    @property
    @abstractmethod
    def rows(self) -> slice:
        """Which of the six rows (ω, v) of the frame's twist are constrained."""

    @abstractmethod
    def axes(self, rotation: Array) -> Array:
        """Return the contact's axes in the world, z the normal, shape (..., 3, 3).

        Parameters
        ----------
        rotation : ndarray, shape (..., 3, 3)
            The frame's axes in the world.
        """

    @property
    @abstractmethod
    def points(self) -> Array:
        """The contact points, in the contact's axes from the frame's origin, shape (k, 3), m."""

    @property
    @abstractmethod
    def point_names(self) -> tuple[str, ...]:
        """The names of the k points in messages."""

    @property
    def dim(self) -> int:
        """The number of constrained rows: 3 for a point, 6 for a surface."""
        return len(range(6)[self.rows])

    @cached_property
    def spread(self) -> Array:
        """The matrix G that makes λ of forces at the points, in the contact's axes, shape (dim, 3 k)."""
        G = np.concatenate([np.concatenate([cross_matrix(p), np.eye(3)]) for p in self.points], axis=1)
        return readonly(G[self.rows])

    @cached_property
    def spread_root(self) -> Array:
        """The lower triangle L with L Lᵀ = G Gᵀ, shape (dim, dim)."""
        return readonly(np.linalg.cholesky(self.spread @ self.spread.mT))

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
        return [f"{kind} at {point}" for point in self.point_names for kind in (*["friction"] * sides, "lift-off")]


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

    Raises
    ------
    ValueError
        If `mu` is not a number of at least 0, or `normal` not a direction.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.PointContact("FL_foot", 0.6).dim
    3
    """

    frame: str
    mu: float
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "mu", _coefficient(self.frame, self.mu))
        n = as_exactly(self.normal, f"contact {self.frame!r}: normal", 3)
        if not n.any():
            raise ValueError(f"contact {self.frame!r}: normal: expected a direction, got zero")
        n = n / np.abs(n).max()
        object.__setattr__(self, "normal", tuple((n / np.sqrt(n @ n)).tolist()))

    @property
    def rows(self) -> slice:
        """The three linear rows."""
        return slice(3, 6)

    def axes(self, rotation: Array) -> Array:
        """Return the axes of the world, turned the shortest way until z is the normal."""
        return np.broadcast_to(self._axes, rotation.shape)

    @cached_property
    def _axes(self) -> Array:
        x, y, z = self.normal
        sine = np.hypot(x, y)
        turn = (
            np.arctan2(sine, z) / sine * np.array([-y, x, 0]) if sine > 0 else np.array([0.0 if z > 0 else np.pi, 0, 0])
        )
        return exp3(turn)

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

    It bears what forces at its four corners add up to, each in its own friction cone. So the centre of pressure stays
    within the sole, and the moment about the normal is limited as well: to μ √(x² + y²) f_z for the half lengths
    (x, y) where the sole is loaded evenly and no friction is needed otherwise, to less elsewhere.

    Parameters
    ----------
    frame : str
        At the middle of the sole; x and y along its sides, z the normal, into the robot.
    half_size : array_like, shape (2,)
        Half the lengths of the sole along the frame's x and y, m, above 0.
    mu : float
        Coefficient of friction, at least 0.

    Raises
    ------
    ValueError
        If `mu` is not a number of at least 0, or `half_size` not two numbers above 0.

    Notes
    -----
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

    def __post_init__(self) -> None:
        object.__setattr__(self, "mu", _coefficient(self.frame, self.mu))
        half = as_exactly(self.half_size, f"contact {self.frame!r}: half_size", 2)
        if (half <= 0).any():
            raise ValueError(f"contact {self.frame!r}: half_size: expected lengths above 0, got {half.tolist()}")
        object.__setattr__(self, "half_size", tuple(half.tolist()))

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


def _checked(sides: int, pyramid: Pyramid) -> int:
    """Return the number of sides; raise for an invalid one, or an invalid pyramid."""
    if not isinstance(sides, int | np.integer) or sides < 3:
        raise ValueError(f"sides: expected a whole number, at least 3, got {sides!r}")
    if not isinstance(pyramid, str) or pyramid not in ("inner", "outer"):
        raise ValueError(f"pyramid: expected 'inner' or 'outer', got {pyramid!r}")
    return int(sides)


def _coefficient(frame: str, mu: ArrayLike) -> float:
    if not isinstance(frame, str):
        raise unknown_name("frame", frame, ())
    value = float(as_exactly(mu, f"contact {frame!r}: mu"))
    if value < 0:
        raise ValueError(f"contact {frame!r}: mu: expected at least 0, got {value:g}")
    return value
