"""What a method asks of the mechanics: the forces of the policy, and the acceleration that follows."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from ..checks import Array, as_array
from ..errors import ShapeError
from ..fast import aba
from ..model import Model
from .divergence import refuse_divergence

__all__ = ["Policy", "System"]

Policy = Callable[[float, Array, Array], ArrayLike]
"""From time, q (..., nq) and v (..., nv) to joint forces (..., nv)."""


class System:
    """A model that moves under a policy.

    Parameters
    ----------
    model : Model
    tau : callable, array_like or None
        As in `simulate`.
    v : ndarray, shape (..., nv)
        A velocity, for the shape and the number type of all that follow.
    dt : float
        Duration of a step, s.

    Attributes
    ----------
    evaluations : int
        How often forces were asked for.
    """

    def __init__(self, model: Model, tau: Policy | ArrayLike | None, v: Array, dt: float) -> None:
        self.model, self.dt, self.evaluations = model, dt, 0
        self._policy = tau if callable(tau) else None
        constant = np.zeros_like(v) if tau is None or callable(tau) else self._checked("tau", tau, v)
        self._constant = np.broadcast_to(constant, v.shape)

    def force(self, t: float, q: Array, v: Array) -> Array:
        """Return the joint forces of the policy in a state, shape (..., nv)."""
        self.evaluations += 1
        if self._policy is None:
            return self._constant
        for x in (q, v):
            x.flags.writeable = False  # a policy cannot change the state behind our back
        tau = self._checked("tau(t, q, v)", self._policy(t, q, v), v, f" at t = {t:.6g}")
        return np.broadcast_to(tau, v.shape)

    def acceleration(self, t: float, q: Array, v: Array) -> Array:
        """Return the acceleration in a state, shape (..., nv) (49.7)."""
        refuse_divergence(self.model, "v", v, dt=self.dt)
        return aba(self.model, q, v, self.force(t, q, v))

    def integrate(self, q: Array, u: Array) -> Array:
        """Return q ⊕ u."""
        refuse_divergence(self.model, "v dt", u)
        return self.model.integrate(q, u)

    def _checked(self, name: str, tau: ArrayLike, v: Array, when: str = "") -> Array:
        """Return joint forces in the number type of v, or say what is wrong with them."""
        try:
            checked = as_array(tau, name)
        except ValueError as error:
            raise type(error)(f"{error}{when}") from None
        if checked.dtype.kind == "c":
            raise ValueError(f"{name}: expected real numbers, got {checked.dtype}{when}")
        if checked.shape not in (v.shape, v.shape[-1:]):
            hint, floats = "", self.model.base == "floating"
            if floats and checked.shape[-1:] == (self.model.nv - 6,):
                hint = "; the six entries of the floating base come first: zeros, as it has no motor"
            raise ShapeError(f"{name}: expected shape {v.shape}, got {checked.shape}{when}{hint}")
        return checked.astype(v.dtype, copy=False)
