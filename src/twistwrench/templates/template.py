"""What every template offers: a prediction of ḣ_G, and its difference from the full model's."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.centroidal import center_of_mass
from ..algorithms.floating_base import base_placement
from ..algorithms.rnea import rnea
from ..arrays import Array, convert
from ..errors import SingularError
from ..model import Model, one_configuration
from ..spatial import SE3
from .com_motion import locked_inertia

__all__ = ["Residual", "Template", "full_rate"]


@dataclass(frozen=True)
class Residual:
    """What `Template.residual` returns: the prediction minus the full model's ḣ_G.

    Attributes
    ----------
    moment : ndarray, shape (..., 3)
        At the centre of mass, in the axes of the world, N m.
    force : ndarray, shape (..., 3)
        In the axes of the world, N.
    weight : float
        Of the robot, N; 0 without gravity.
    length : float
        Radius of gyration of the robot about its centre of mass, m, in the configuration the template was made at.
    """

    moment: Array
    force: Array
    weight: float
    length: float

    @property
    def relative(self) -> Array:
        """The size of the wrench left out as a share of the weight, shape (...).

        √(‖force‖² + ‖moment / length‖²) / weight. Raises SingularError without gravity, and of a point.
        """
        if self.weight == 0:
            raise SingularError("relative residual: without gravity there is no weight to compare with")
        if self.length == 0:
            raise SingularError("relative residual: a point has no radius of gyration, by which moments are divided")
        squares = (self.force * self.force).sum(-1) + (self.moment * self.moment).sum(-1) / self.length**2
        return np.asarray(np.sqrt(squares) / self.weight)


@dataclass(frozen=True, eq=False)
class Template(ABC):
    """A reduced model of a robot with a floating base, which predicts ḣ_G of a motion (49.10).

    ḣ_G is (k̇_G, l̇_G), the rate of the centroidal momentum: what the ground and the weight together must do for the
    motion to happen. A template is made from a model and a configuration by ``of``, computes from a state (q, v, a) the
    few quantities that it uses (`read`), and predicts ḣ_G from those (`law`).

    Attributes
    ----------
    model : Model
    q : ndarray, shape (nq,)
        The configuration that the template was made at. What a template keeps constant has its value there.
    """

    model: Model = field(repr=False)
    q: Array = field(repr=False)
    weight: float
    length: float

    name: ClassVar[str]
    """Its name in `TEMPLATES`."""
    assumes: ClassVar[str]
    """What it assumes, in one sentence."""

    @classmethod
    def of(cls, model: Model, q: ArrayLike) -> Self:
        """Make the template from a model and a configuration.

        Parameters
        ----------
        model : Model
            With a floating base.
        q : array_like, shape (nq,)
            One configuration, real, for example ``model.standing()``. Velocities do not matter to any template.

        Raises
        ------
        ValueError
            If the base is fixed.
        SingularError
            If nothing that moves has mass.
        ShapeError, ValueError
            As `Model.state`; or if q is a batch or complex.
        """
        return cls(*checked(model, q))

    @abstractmethod
    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return what the template uses of a state: the arguments of its `law`."""

    @abstractmethod
    def law(self, *known: Array) -> Array:
        """Return ḣ_G from what `read` returns, shape (..., 6)."""

    def rate(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Array:
        """Predict ḣ_G of states in motion.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v, a : array_like, shape (..., nv)

        Returns
        -------
        ndarray, shape (..., 6)
            k̇_G in N m and l̇_G in N, at the centre of mass, in the axes of the world.

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        return self.law(*self.read(*self.model.state(q, v=v, a=a)))

    def residual(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Residual:
        """Return the template's error: its ḣ_G minus that of the full model, which is read off RNEA's base rows.

        Parameters
        ----------
        q : array_like, shape (..., nq)
        v, a : array_like, shape (..., nv)

        Returns
        -------
        Residual

        Raises
        ------
        ShapeError, ValueError
            As `Model.state`.
        """
        q, v, a = self.model.state(q, v=v, a=a)
        error = self.law(*self.read(q, v, a)) - full_rate(self.model, q, v, a)
        return Residual(error[..., :3], error[..., 3:], self.weight, self.length)


def checked(model: Model, q: ArrayLike) -> tuple[Model, Array, float, float]:
    """Return what every template has: model, configuration, weight and radius of gyration."""
    q = one_configuration(model, q)
    if model.base != "floating":
        raise ValueError(f"{model.name!r}: expected a floating base, got a {model.base} one")
    if model.mass == 0:
        raise SingularError(f"{model.name!r}: nothing that moves has mass")
    weight = model.mass * float(np.sqrt((model.gravity**2).sum()))
    length = float(np.sqrt(np.trace(locked_inertia(model, q)) / 2 / model.mass))
    return model, q.copy(), weight, length


def full_rate(model: Model, q: Array, v: Array, a: Array) -> Array:
    """Return ḣ_G as the full model has it: the base's rows of RNEA, taken to the centre of mass, and the weight.

    Parameters
    ----------
    model : Model
    q, v, a : ndarray
        As checked by `Model.state`.

    Returns
    -------
    ndarray, shape (..., 6)
    """
    at_origin = q.copy()
    at_origin[..., :3] = 0  # where the robot stands does not matter, and far away would cost digits
    base = base_placement(model, at_origin)
    to_G = SE3._trusted(base.rotation, base.translation - center_of_mass(model, at_origin)).force_transform()
    g = convert(model.mass * model.gravity, q.dtype)
    rate: Array = np.matvec(to_G, rnea(model, q, v, a)[..., :6]) + np.concatenate([np.zeros_like(g), g])
    return rate
