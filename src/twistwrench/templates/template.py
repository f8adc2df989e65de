"""What every template offers: a prediction of ḣ_G, and its difference from the full model's."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.centroidal import center_of_mass
from ..algorithms.floating_base import base_placement
from ..algorithms.kinematics import forward_kinematics
from ..algorithms.rnea import rnea
from ..arrays import Array, convert
from ..errors import SingularError
from ..model import Model, composite_inertias, one_configuration, tree_terms
from ..spatial import SE3, skew

__all__ = ["Residual", "Template", "com_acceleration", "force", "full_rate", "locked_inertia"]


@dataclass(frozen=True)
class Residual:
    """Error of a template, from `Template.residual`: the prediction minus the full model's ḣ_G.

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
        return cls(*check_arguments(model, q))

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


def check_arguments(model: Model, q: ArrayLike) -> tuple[Model, Array, float, float]:
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


def com_acceleration(model: Model, q: Array, v: Array, a: Array) -> Array:
    """Return p̈_G, the acceleration of the centre of mass, in the axes of the world, shape (..., 3).

    The mean over the bodies of c̈_i = R_i (a + ω × v + α × c + ω × (ω × c)): (α, a) is the spatial acceleration of
    body i, (ω, v) its twist and c its centre of mass, all in its own frame.
    """
    moving = forward_kinematics(model, q, v, a)
    if moving.twist is None or moving.acceleration is None:
        raise RuntimeError("v and a were given")
    mass = np.array([inertia.mass for inertia in model.inertia]).astype(q.dtype)
    c = np.stack([inertia.com for inertia in model.inertia]).astype(q.dtype)
    w, alpha = moving.twist[..., :3], moving.acceleration[..., :3]
    local = moving.acceleration[..., 3:] + np.cross(w, moving.twist[..., 3:] + np.cross(w, c)) + np.cross(alpha, c)
    R = np.stack([T.rotation for T in moving.placement], axis=-3)
    return np.asarray((mass[:, None] * np.matvec(R, local)).sum(axis=-2) / mass.sum())


def force(model: Model, p_ddot: Array) -> Array:
    """Return l̇_G = m p̈_G."""
    return np.asarray(convert(np.asarray(model.mass), p_ddot.dtype) * p_ddot)


def locked_inertia(model: Model, q: Array) -> Array:
    """Return the inertia about the centre of mass of the robot with its joints locked, in the base's axes, (..., 3, 3).

    Of the composite inertia at the base, I_O, m c and m: I_G = I_O + m [c]× [c]×.
    """
    composite = composite_inertias(tree_terms(model, q))[1]
    mass, mc = composite[..., 3, 3], composite[..., [2, 0, 1], [4, 5, 3]]  # m [c]× is the block at the top right
    C = skew(mc / mass[..., None])
    return np.asarray(composite[..., :3, :3] + mass[..., None, None] * C @ C)
