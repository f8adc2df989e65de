"""The methods of `simulate` by name, and what each conserves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from ..arrays import Array
from .explicit import EULER, MIDPOINT, RK4, runge_kutta, semi_implicit
from .system import System
from .variational import variational

__all__ = ["METHODS", "Method", "Step"]


Step = Callable[[System, float, Array, Array], tuple[Array, Array]]
"""From a system, t, q and v to the next q and v."""


def time_stepping(system: System, t: float, q: Array, v: Array) -> tuple[Array, Array]:
    """Make one step with what may touch."""
    if system.stepping is None:
        raise TypeError("a system without what may touch cannot be stepped so")
    return system.stepping.step(system.force(t, q, v), q, v, system.since(t))


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
    """

    title: str
    order: int
    step: Step
    keeps: str
    contacts: bool = True


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
