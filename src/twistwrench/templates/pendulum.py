"""The linear inverted pendulum (LIPM): a point mass at constant height (49.10)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.centroidal import center_of_mass
from ..algorithms.kinematics import frame_placement
from ..arrays import Array, as_arrays, as_number, convert
from ..errors import SingularError
from ..model import Model
from .com_motion import com_acceleration, force
from .template import Template, checked

__all__ = ["LinearPendulum"]


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
        held = checked(model, q)
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
