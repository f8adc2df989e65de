"""The templates, from the simplest to the full model: point mass, pendulum, rigid body, whole momentum (49.10)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.centroidal import center_of_mass, centroidal_momentum_rate
from ..algorithms.floating_base import base_placement
from ..algorithms.kinematics import frame_placement
from ..arrays import Array, as_arrays, as_number, convert
from ..errors import SingularError
from ..model import Model
from .template import Template, check_arguments, com_acceleration, force, full_rate, locked_inertia

__all__ = ["Centroidal", "FrozenRigidBody", "Full", "LinearPendulum", "PointMass", "RigidBody"]


class PointMass(Template):
    """A point of the robot's mass at its centre of mass: l̇_G = m p̈_G, k̇_G = 0.

    The force is exact, whatever the joints do. The moment is left out.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> template, rest = PointMass.of(model, model.standing()), np.zeros(model.nv)
    >>> falling = tw.aba(model, model.standing(), rest, rest)
    >>> template.rate(model.standing(), rest, falling).round(3) + 0.0
    array([   0.   ,    0.   ,    0.   ,    0.   ,    0.   , -157.794])
    """

    name: ClassVar[str] = "point_mass"
    assumes: ClassVar[str] = "The angular momentum stays as it is."

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return p̈_G."""
        return (com_acceleration(self.model, q, v, a),)

    def law(self, *known: Array) -> Array:
        """Return (0, m p̈_G)."""
        (p_ddot,) = known
        return np.concatenate([np.zeros_like(p_ddot), force(self.model, p_ddot)], axis=-1)


@dataclass(frozen=True, eq=False)
class LinearPendulum(Template):
    """A point mass that stays at one height above the ground: the linear inverted pendulum (LIPM).

    k̇_G = 0 and l̇_G = m p̈_G without its vertical part. The force from the ground then runs through the centre of
    pressure c and the centre of mass, p̈_G = (g/z)(p_G − c) along the ground: linear, since z is constant.

    Attributes
    ----------
    height : float
        z, of the centre of mass above the ground, m: above the lowest foot in the configuration the template was made
        at, unless given to `of`.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> pendulum = LinearPendulum.of(model, model.standing())
    >>> round(pendulum.height, 3)
    0.247
    >>> pendulum.center_of_pressure([0.0, 0, pendulum.height], [1.0, 0, 0]).round(3) + 0.0  # it lags the centre of mass
    array([-0.025,  0.   ,  0.   ])
    """

    height: float

    name: ClassVar[str] = "lipm"
    assumes: ClassVar[str] = "The angular momentum stays as it is, and so does the height of the centre of mass."

    @classmethod
    def of(cls, model: Model, q: ArrayLike, *, height: float | None = None) -> Self:
        """Make the template from a model and a configuration: see `Template.of`.

        Parameters
        ----------
        model : Model
        q : array_like, shape (nq,)
        height : float, optional
            Of the centre of mass above the ground, m; above the lowest of `model.feet` at q unless given.

        Raises
        ------
        SingularError
            If there is no gravity.
        ValueError
            If there is no height: `model.feet` is empty and none was given; or it is not positive.
        """
        held = check_arguments(model, q)
        if held[2] == 0:
            raise SingularError(f"{model.name!r} has no gravity: a pendulum needs one")
        if height is None:
            if not model.feet:
                raise ValueError(f"height: {model.name!r} has no feet, so it must be given")
            up = _up(model)
            feet = [float(up @ frame_placement(model, q, foot).translation) for foot in model.feet]
            height = float(up @ center_of_mass(model, q)) - min(feet)
        if not 0 < as_number(height, "height") < np.inf:
            raise ValueError(f"height: expected a positive number, got {height}")
        return cls(*held, float(height))

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return p̈_G."""
        return (com_acceleration(self.model, q, v, a),)

    def law(self, *known: Array) -> Array:
        """Return (0, m p̈_G), its vertical part left out."""
        (p_ddot,) = known
        return np.concatenate([np.zeros_like(p_ddot), force(self.model, self._along_the_ground(p_ddot))], axis=-1)

    def acceleration(self, p_G: ArrayLike, center_of_pressure: ArrayLike) -> Array:
        """Return p̈_G = (g/z)(p_G − c), along the ground.

        Parameters
        ----------
        p_G, center_of_pressure : array_like, shape (..., 3)
            In the world, m.

        Returns
        -------
        ndarray, shape (..., 3)
            m/s².
        """
        p, c = as_arrays(p_G=(p_G, (3,)), center_of_pressure=(center_of_pressure, (3,)))
        return self._rate_squared * self._along_the_ground(p - c)

    def center_of_pressure(self, p_G: ArrayLike, p_ddot: ArrayLike) -> Array:
        """Return the point on the ground below which the pendulum's law holds: c = p_G − (z/g) p̈_G, z below p_G.

        Parameters
        ----------
        p_G : array_like, shape (..., 3)
            In the world, m.
        p_ddot : array_like, shape (..., 3)
            m/s². Its vertical part is ignored.

        Returns
        -------
        ndarray, shape (..., 3)
            m.
        """
        p, acceleration = as_arrays(p_G=(p_G, (3,)), p_ddot=(p_ddot, (3,)))
        return p - self._along_the_ground(acceleration) / self._rate_squared - self.height * _up(self.model)

    @property
    def _rate_squared(self) -> float:
        return self.weight / self.model.mass / self.height

    def _along_the_ground(self, x: Array) -> Array:
        up = convert(_up(self.model), x.dtype)
        return np.asarray(x - (x * up).sum(axis=-1, keepdims=True) * up)


def _up(model: Model) -> Array:
    return np.asarray(-model.gravity / np.sqrt((model.gravity**2).sum()))


class RigidBody(Template):
    """One rigid body that turns as the base does, with the inertia that the robot has in each configuration.

    l̇_G = m p̈_G and k̇_G = R (I ω̇ + ω × I ω): R places the base, ω is its angular velocity in its own axes, and I is the
    inertia about the centre of mass of the robot with its joints locked at q. What the joints' own motion does to the
    angular momentum is left out.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model, q = tw.load("go2"), tw.load("go2").standing()
    >>> turning = np.array([1.0, 2, 3, 0, 0, 0, *np.zeros(12)])  # with joints that are still: it is a rigid body
    >>> bool(RigidBody.of(model, q).residual(q, turning, 5 * turning).relative < 1e-13)
    True
    """

    name: ClassVar[str] = "srbm"
    assumes: ClassVar[str] = "The joints' motion has no angular momentum."

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return q, R, ω, ω̇ and p̈_G."""
        R = base_placement(self.model, q).rotation
        return q, R, v[..., :3], a[..., :3], com_acceleration(self.model, q, v, a)

    def law(self, *known: Array) -> Array:
        """Return (R (I ω̇ + ω × I ω), m p̈_G)."""
        q, R, w, w_dot, p_ddot = known
        I = self._inertia(q)
        k_dot = np.matvec(R, np.matvec(I, w_dot) + np.cross(w, np.matvec(I, w)))
        return np.concatenate([k_dot, force(self.model, p_ddot)], axis=-1)

    def _inertia(self, q: Array) -> Array:
        return locked_inertia(self.model, q)


@dataclass(frozen=True, eq=False)
class FrozenRigidBody(RigidBody):
    """As `RigidBody`, but with the inertia of one configuration, the one the template was made at.

    Attributes
    ----------
    inertia : ndarray, shape (3, 3)
        About the centre of mass, in the base's axes, kg m².

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> FrozenRigidBody.of(model, model.standing()).inertia.diagonal().round(3)
    array([0.166, 0.501, 0.562])
    """

    inertia: Array = field(repr=False)

    name: ClassVar[str] = "srbm_frozen"
    assumes: ClassVar[str] = "The joints' motion has no angular momentum, and does not change the inertia either."

    @classmethod
    def of(cls, model: Model, q: ArrayLike) -> Self:
        """Make the template from a model and a configuration: see `Template.of`."""
        held = check_arguments(model, q)
        return cls(*held, locked_inertia(model, held[1]))

    def _inertia(self, q: Array) -> Array:
        return np.broadcast_to(convert(self.inertia, q.dtype), (*q.shape[:-1], 3, 3))


class Centroidal(Template):
    """The rate of the whole centroidal momentum, ḣ_G = A_G a + Ȧ_G v: exact, but without the joints' torques.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model, rng = tw.load("go2"), np.random.default_rng(0)
    >>> v, a = rng.standard_normal((2, model.nv))
    >>> bool(Centroidal.of(model, model.standing()).residual(model.standing(), v, a).relative < 1e-13)
    True
    """

    name: ClassVar[str] = "centroidal"
    assumes: ClassVar[str] = "Nothing; it does not give the joints' torques."

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return the whole state."""
        return q, v, a

    def law(self, *known: Array) -> Array:
        """Return A_G a + Ȧ_G v."""
        return centroidal_momentum_rate(self.model, *known)


class Full(Template):
    """The full model: RNEA, whose base rows are ḣ_G less the weight, and whose other rows are the torques.

    What the other templates are compared with.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model, rest = tw.load("go2"), np.zeros(18)
    >>> bool(np.abs(Full.of(model, model.standing()).rate(model.standing(), rest, rest)).max() < 1e-12)
    True
    """

    name: ClassVar[str] = "full"
    assumes: ClassVar[str] = "Nothing."

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return the whole state."""
        return q, v, a

    def law(self, *known: Array) -> Array:
        """Return the base's rows of RNEA at the centre of mass, and the weight."""
        return full_rate(self.model, *known)
