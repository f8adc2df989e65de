"""Can it stand? Limits of the joints, forces at the contacts, motors, and what fails of these."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..contact import Contact, stance_margins
from ..contact.inverse import friction_inverse_dynamics
from ..contact.task import ContactProblem
from ..errors import SingularError
from ..model import Model

__all__ = ["Standing", "standing"]

LIMIT_ATOL = 1e-9
"""How far outside a limit a joint may be for rounding, rad or m."""


@dataclass(frozen=True)
class Standing:
    """Verdict on a stance, from `Scene.can_stand`. True where the robot stands; printed, it gives the reason.

    Attributes
    ----------
    reasons : tuple of str
        Why it cannot; empty where it can.
    word : {"stand", "hold"}
        What it does: a robot whose base is fixed holds.
    """

    reasons: tuple[str, ...]
    word: str = "stand"

    def __bool__(self) -> bool:
        return not self.reasons

    def __str__(self) -> str:
        return f"it {self.word}s" if self else f"cannot {self.word}: " + "; ".join(self.reasons)


def standing(model: Model, q: Array, contacts: Sequence[Contact], f_ext: Array) -> Standing:
    """See `Scene.can_stand`."""
    reasons = outside_limits(model, q)
    if f_ext.any() or model.base != "floating":
        rest = np.zeros(model.nv)
        try:
            friction_inverse_dynamics(model, q, rest, rest, contacts, f_ext, sides=16)
            fails = ""
        except SingularError as error:
            fails = str(error).removeprefix("cannot: ")
    else:
        fails = stance_margins(model, q, contacts).reason
    if not fails:
        fails = weak_motors(model, q, contacts, f_ext)
    return Standing((*reasons, *([fails] if fails else [])), "stand" if model.base == "floating" else "hold")


def outside_limits(model: Model, q: Array) -> list[str]:
    """Name the joints that a pose takes outside their limits."""
    outside = np.maximum(q - model.upper, model.lower - q) > LIMIT_ATOL
    return [
        f"joint {name!r} is at {q[s].round(3).tolist()}, outside its limits {model.lower[s].round(3).tolist()} "
        f"to {model.upper[s].round(3).tolist()}"
        for name, s in zip(model.joint_names, model.q_slice)
        if outside[s].any()
    ]


def weak_motors(model: Model, q: Array, contacts: Sequence[Contact], f_ext: Array) -> str:
    """Name the motor that is too weak whatever the contact forces within the friction cones."""
    rest = np.zeros(model.nv)
    task = ContactProblem.of(model, q, rest, rest, contacts, f_ext)
    if task.reach(16, "inner", task.motors(model)).reached:
        return ""
    first = 2 if model.base == "floating" else 1
    motors = np.arange(model.v_slice[first].start, model.nv)
    strong = model.effort_limit[motors]
    tau = friction_inverse_dynamics(model, q, rest, rest, contacts, f_ext, sides=16).tau[motors]
    names = [name for name, s in zip(model.joint_names[first:], model.v_slice[first:]) for _ in range(s.stop - s.start)]
    worst = max(np.flatnonzero(np.isfinite(strong)), key=lambda k: abs(tau[k]) - strong[k])
    needs = f"would have to hold {abs(tau[worst]):.3g}, and its limit is {strong[worst]:.3g}"
    if not contacts:
        return f"the motor of {names[worst]!r} {needs}"
    return f"no forces at the contacts spare the motors: with the least ones that of {names[worst]!r} {needs}"
