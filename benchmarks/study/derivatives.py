"""Ways of differentiating inverse dynamics: ∂τ/∂q, column k along the step q ⊕ h e_k."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench import newton_euler_3d as ne
from twistwrench.arrays import Array, resolution
from twistwrench.validate.manifold import integrate

from .numbers import DIGITS, FLOATS, HARDWARE, convert
from .quantities import Robot, in_each
from .record import Way

SLOPE = "dID/dq"

Function = Callable[[Array, Array, Array], Array]
"""τ of (q, v, a), for any number of leading axes."""


def derivatives(robot: Robot) -> list[Way]:
    """Return the ways of computing ∂τ/∂q, shape (nv, nv). v and a are held fixed."""
    model, oracle = robot.model, robot.oracle
    fast, slow = robot.ours("ID", tw.fast), robot.ours("ID")

    def read(_: Any) -> Array:
        return oracle.matrix(np.reshape(oracle.data.dtau_dq, (model.nv, model.nv)))

    return [
        *robot.compiled(SLOPE, "dtau_dq", HARDWARE),
        *in_each(FLOATS, SLOPE, "tw.fast.rnea, complex step", partial(complex_step, fast, model)),
        *in_each(FLOATS, SLOPE, "tw.rnea, complex step", partial(complex_step, slow, model)),
        *in_each(DIGITS, SLOPE, "newton_euler_3d, forward difference", partial(slope_truth, model), batches=False),
        *robot.pinocchio(SLOPE, "computeRNEADerivatives", read),
        *in_each(FLOATS, SLOPE, "tw.fast.rnea, central difference", partial(central_difference, fast, model)),
        *in_each(FLOATS, SLOPE, "tw.fast.rnea, forward difference", partial(forward_difference, fast, model)),
    ]


def forward_difference(f: Function, model: tw.Model, q: Array, v: Array, a: Array, h: Any = None) -> Array:
    """Return (f(q ⊕ h e_k) − f(q)) / h, (..., nv, nv). What is left out is of size h, rounding of size ε / h: h = √ε.

    >>> model, q = tw.load("pendulum"), np.array([0.3])
    >>> exact = tw.gravity(model, q) / np.tan(q)  # τ = m g l sin q
    >>> error = forward_difference(lambda *s: tw.rnea(model, *s), model, q, 0 * q, 0 * q).item() / exact.item() - 1
    >>> 1e-11 < abs(error) < 1e-8
    True
    """
    h = h or resolution(q.dtype) ** (1 / 2)
    v, a = v[..., None, :], a[..., None, :]
    columns: Array = (f(_steps(model, q, h), v, a) - f(q[..., None, :], v, a)) / h
    return columns.mT


def central_difference(f: Function, model: tw.Model, q: Array, v: Array, a: Array, h: Any = None) -> Array:
    """Return (f(q ⊕ h e_k) − f(q ⊖ h e_k)) / 2h, (..., nv, nv). Left out: h²; rounding: ε / h; so h = ∛ε."""
    h = h or resolution(q.dtype) ** (1 / 3)
    v, a = v[..., None, :], a[..., None, :]
    columns: Array = (f(_steps(model, q, h), v, a) - f(_steps(model, q, -h), v, a)) / (2 * h)
    return columns.mT


def complex_step(f: Function, model: tw.Model, q: Array, v: Array, a: Array, h: Any = None) -> Array:
    """Return Im f(q ⊕ ih e_k) / h, (..., nv, nv). Nothing is subtracted, so h may be as small as the type allows."""
    h = h or np.finfo(q.dtype).tiny ** (1 / 2)
    columns: Array = f(_steps(model, q, 1j * h), v[..., None, :], a[..., None, :]).imag / h
    return columns.mT


def _steps(model: tw.Model, q: Array, h: Any) -> Array:
    """Return q ⊕ h e_k for every k, (..., nv, nq)."""
    return model.integrate(q[..., None, :], h * np.eye(model.nv, dtype=q.dtype))


def slope_truth(model: tw.Model, q: Array, v: Array, a: Array) -> Array:
    """Return ∂τ/∂q of one state of mpmath numbers, to their number of digits.

    A forward difference loses half the digits: it is computed with twice as many, and a few more.
    """
    q, v, a, steps = (convert(x, f"{2 * q.flat[0].context.dps + 4} digits") for x in (q, v, a, np.eye(model.nv)))
    context = q.flat[0].context
    h = context.mpf(10) ** (-context.dps // 2)
    here = ne.inverse_dynamics(model, q, v, a)
    return np.stack([(ne.inverse_dynamics(model, integrate(model, q, h * e), v, a) - here) / h for e in steps], axis=1)
