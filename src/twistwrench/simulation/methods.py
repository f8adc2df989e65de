"""The methods of `simulate` by name, and what each conserves.

The explicit ones are Euler's two, and Runge-Kutta by Munthe-Kaas, on the configuration manifold. A step is made in the
axes of its beginning (`straight`): there u and v can be added, what flies goes straight, and only at the end v is
turned into the axes that are then the robot's.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..arrays import Array
from .straight import go_straight, in_turned_axes, straight_rate, turning
from .system import System
from .variational import variational

__all__ = ["EULER", "METHODS", "MIDPOINT", "RK4", "Method", "StepFunction", "Tableau", "runge_kutta", "semi_implicit"]

StepFunction = Callable[[System, float, Array, Array], tuple[Array, Array]]
"""From a system, t, q and v to the next q and v."""

Tableau = tuple[Sequence[float], Sequence[Sequence[float]], Sequence[float]]
"""Butcher's: nodes c, rows of coefficients a, weights b."""

EULER: Tableau = ((0.0,), ((),), (1.0,))
MIDPOINT: Tableau = ((0.0, 1 / 2), ((), (1 / 2,)), (0.0, 1.0))
RK4: Tableau = ((0.0, 1 / 2, 1 / 2, 1.0), ((), (1 / 2,), (0.0, 1 / 2), (0.0, 0.0, 1.0)), (1 / 6, 1 / 3, 1 / 3, 1 / 6))


@dataclass(frozen=True)
class Method:
    """A way to make one step.

    Parameters
    ----------
    title : str
    order : int
        With a dt half as long the error at a given time is 2 to this power times smaller.
    step : callable
        From a `System`, t, q and v to the next q and v.
    keeps : str
        What it keeps of the laws of mechanics, at any dt.
    contacts : bool
        Whether it can let points and soles stick.

    Examples
    --------
    >>> import twistwrench as tw
    >>> tw.simulation.METHODS["rk4"].order
    4
    """

    title: str
    order: int
    step: StepFunction
    keeps: str
    contacts: bool = True


def runge_kutta(tableau: Tableau, system: System, t: float, q: Array, v: Array) -> tuple[Array, Array]:
    """Make one step of an explicit Runge-Kutta method, up to order 4, for the way u from q and for v.

    H. Munthe-Kaas, High order Runge-Kutta methods on manifolds, 1999: u can be added, so that the method keeps its
    order, and what u leads to never leaves the manifold.
    """
    (nodes, rows, weights), dt = tableau, v.dtype.type(system.dt)
    u_rates: list[Array] = []
    v_rates: list[Array] = []
    for c, row in zip(nodes, rows):
        u = dt * weighted(row, u_rates, v)
        v_stage = v + dt * weighted(row, v_rates, v)
        v_rates.append(acceleration(system, t + c * system.dt, q, u, v_stage))
        u_rates.append(straight_rate(system.model, u, v_stage))  # u̇, not v
    return arrive(system, q, dt * weighted(weights, u_rates, v), v + dt * weighted(weights, v_rates, v))


def semi_implicit(system: System, t: float, q: Array, v: Array) -> tuple[Array, Array]:
    """Make one step of the semi-implicit Euler method: the new velocity first, and q along it."""
    dt = v.dtype.type(system.dt)
    v = v + dt * (system.acceleration(t, q, v) + turning(system.model, v))
    return arrive(system, q, dt * v, v)


def acceleration(system: System, t: float, q: Array, u: Array, v: Array) -> Array:
    """Return v̇ in the axes of q, where q has gone the way u and moves with v, which is in these axes, too."""
    model = system.model
    if not u.any():
        return system.acceleration(t, q, v) + turning(model, v)
    there, v_there = arrive(system, q, u, v)
    return in_turned_axes(model, system.acceleration(t, there, v_there) + turning(model, v_there), -u)


def arrive(system: System, q: Array, u: Array, v: Array) -> tuple[Array, Array]:
    """Return the state after a way u from q with the velocity v, which is given in the axes of q."""
    system.check_travel(u)
    return go_straight(system.model, q, u), in_turned_axes(system.model, v, u)


def weighted(weights: Sequence[float], terms: Sequence[Array], like: Array) -> Array:
    """Return Σ w x, and zeros like another array where there is nothing to add."""
    return sum((like.dtype.type(w) * x for w, x in zip(weights, terms) if w), np.zeros_like(like))


def time_stepping(system: System, t: float, q: Array, v: Array) -> tuple[Array, Array]:
    """Make one step with what may touch."""
    if system.stepping is None:
        raise TypeError("a system without what may touch cannot be stepped so")
    return system.stepping.step(system.force(t, q, v), q, v, system.time_since_start(t))


METHODS = {
    "euler": Method("explicit Euler", 1, partial(runge_kutta, EULER), "nothing: the energy grows"),
    "semi-implicit": Method(
        "semi-implicit Euler", 1, semi_implicit, "the energy nearly, where M is constant and no body tumbles"
    ),
    "midpoint": Method("explicit midpoint", 2, partial(runge_kutta, MIDPOINT), "nothing"),
    "rk4": Method("Runge-Kutta", 4, partial(runge_kutta, RK4), "nothing; the errors are small"),
    "variational": Method(
        "variational",
        2,
        variational,
        "conserved momenta to rounding; the symplectic form, and so nearly the energy",
        contacts=False,
    ),
    "time-stepping": Method(
        "time stepping",
        1,
        time_stepping,
        "no impulse of a contact or a joint's range adds energy; in free motion nothing",
        contacts=False,
    ),
}
