"""Ways of differentiating inverse dynamics: ∂τ/∂q, column k along the step q ⊕ ε e_k."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench import newton_euler_3d as ne
from twistwrench.arrays import Array, resolution
from twistwrench.model import Model
from twistwrench.validate.manifold import integrate
from twistwrench.validate.oracle import Oracle

from .dynamics import Robot, Truth
from .numbers import DIGITS, HARDWARE, digits, exactly
from .quantity import Way

__all__ = ["central_difference", "complex_step", "derivative", "difference_in_twice_the_digits", "forward_difference"]

Function = Callable[[Array, Array, Array], Array]
"""τ of (q, v, a), for any number of leading axes."""


def derivative(robot: Robot) -> tuple[Truth, list[Way]]:
    """Return the truth of ∂τ/∂q, shape (nv, nv), and the ways. v and a are held fixed."""
    model = robot.model

    exact, fast = partial(difference_in_twice_the_digits, model), partial(tw.fast.rnea, model)

    def pinocchio(pin: Any, m: Any, d: Any, q: Array, v: Array, a: Array) -> Any:
        pin.computeRNEADerivatives(m, d, q, v, a)
        return d

    def read(oracle: Oracle, data: Any) -> Array:
        return oracle.matrix(np.reshape(data.dtau_dq, (model.nv, model.nv)))

    return exact, [
        *robot.compiled("dtau_dq", numbers=HARDWARE),
        Way("tw.fast.rnea, complex step", partial(complex_step, fast, model)),
        Way("tw.rnea, complex step", partial(complex_step, partial(tw.rnea, model), model)),
        Way("newton_euler_3d, forward difference", exact, DIGITS, batches=False),
        *robot.pinocchio("pin.computeRNEADerivatives", pinocchio, read),
        Way("tw.fast.rnea, central difference", partial(central_difference, fast, model)),
        Way("tw.fast.rnea, forward difference", partial(forward_difference, fast, model)),
    ]


def forward_difference(f: Function, model: Model, q: Array, v: Array, a: Array) -> Array:
    """Return (f(q ⊕ h e_k) − f(q)) / h, (..., nv, nv). What is left out is of size h, rounding of size ε / h: h = √ε.

    Examples
    --------
    >>> model = tw.load("pendulum")
    >>> q = np.array([0.3])
    >>> exact = tw.gravity(model, q) / np.tan(q)  # τ = m g l sin q
    >>> error = forward_difference(lambda *s: tw.rnea(model, *s), model, q, 0 * q, 0 * q).item() / exact.item() - 1
    >>> 1e-11 < abs(error) < 1e-8
    True
    """
    h = resolution(q.dtype) ** (1 / 2)
    there, v, a = _steps(model, q, h), v[..., None, :], a[..., None, :]
    columns: Array = (f(there, v, a) - f(q[..., None, :], v, a)) / h
    return columns.mT


def central_difference(f: Function, model: Model, q: Array, v: Array, a: Array) -> Array:
    """Return (f(q ⊕ h e_k) − f(q ⊖ h e_k)) / 2h, (..., nv, nv). Left out: h²; rounding: ε / h; so h = ∛ε."""
    h = resolution(q.dtype) ** (1 / 3)
    v, a = v[..., None, :], a[..., None, :]
    columns: Array = (f(_steps(model, q, h), v, a) - f(_steps(model, q, -h), v, a)) / (2 * h)
    return columns.mT


def complex_step(f: Function, model: Model, q: Array, v: Array, a: Array) -> Array:
    """Return Im f(q ⊕ ih e_k) / h, (..., nv, nv). Nothing is subtracted, so h may be as small as the type allows."""
    h = np.finfo(q.dtype).tiny ** (1 / 2)
    columns: Array = f(_steps(model, q, 1j * h), v[..., None, :], a[..., None, :]).imag / h
    return columns.mT


def _steps(model: Model, q: Array, h: Any) -> Array:
    """Return q ⊕ h e_k for every k, (..., nv, nq)."""
    return model.integrate(q[..., None, :], h * np.eye(model.nv, dtype=q.dtype))


def difference_in_twice_the_digits(model: Model, q: Array, v: Array, a: Array) -> Array:
    """Return ∂τ/∂q of one state of mpmath numbers, to their number of digits.

    A forward difference loses half the digits: it is computed with twice as many, and a few more.
    """
    wide = digits(2 * q.flat[0].context.dps + 4)
    h = wide.mpf(10) ** (-wide.dps // 2)
    q, v, a = (np.asarray(np.frompyfunc(wide.convert, 1, 1)(x), object) for x in (q, v, a))
    steps = exactly(np.eye(model.nv), wide) * h
    here = ne.inverse_dynamics(model, q, v, a)
    return np.stack([(ne.inverse_dynamics(model, integrate(model, q, e), v, a) - here) / h for e in steps], axis=1)
