"""A ball that touches, at another point of the body as it turns (49.4, 49.9)."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..arrays import Array, as_exactly
from ..model import readonly
from ..spatial.rotation import cross_matrix
from .kinds import _coefficient, _normal_axes, _unit
from .types import Contact, checked_restitution

__all__ = ["SphereContact"]


@dataclass(frozen=True)
class SphereContact(Contact):
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
        radius = float(as_exactly(self.radius, f"contact {self.frame!r}: radius"))
        if radius <= 0:
            raise ValueError(f"contact {self.frame!r}: radius: expected a length above 0, got {radius:g}")
        normal = as_exactly(self.normal, f"contact {self.frame!r}: normal", 3)
        object.__setattr__(self, "radius", radius)
        object.__setattr__(self, "normal", _unit(self.frame, "normal", normal))
        checked_restitution(self)

    @property
    def rows(self) -> slice:
        """The three linear rows."""
        return slice(3, 6)

    @cached_property
    def directions(self) -> Array:
        """The rows (ω, v) of the lowest point, at −r n from the centre."""
        down = -self.radius * np.array(self.normal)
        return readonly(np.concatenate([-cross_matrix(down), np.eye(3)], axis=1))

    @cached_property
    def placed(self) -> Array:
        """The height alone."""
        n = np.array(self.normal)
        return readonly(np.concatenate([np.zeros((3, 3)), np.outer(n, n)], axis=1))

    def axes(self, rotation: Array) -> Array:
        """Return the axes of the world, turned the shortest way until z is the normal."""
        return np.broadcast_to(_normal_axes(self.normal), rotation.shape)

    @property
    def points(self) -> Array:
        """The lowest point."""
        return np.array([[0.0, 0.0, -self.radius]])

    @property
    def point_names(self) -> tuple[str, ...]:
        """The frame's name."""
        return (repr(self.frame),)
