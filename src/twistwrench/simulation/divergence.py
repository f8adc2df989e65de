"""When a step has gone wrong, and the error that reports it."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from ..arrays import Array
from ..model import GroupJoint, Model, joint_name_at
from ..spatial._elementary import at_first_index

__all__ = ["DivergenceError", "check_divergence", "check_turn"]

MAX_STEP_TRAVEL = 1e6
"""No joint goes that far in one step, in rad or m."""


class DivergenceError(ValueError):
    """A motion that left all bounds, or a step that could not be solved. The message names the time and the joint.

    Attributes
    ----------
    motion : Simulation
        The motion until then.
    """

    motion: Any = None


def check_divergence(model: Model, what: str, x: Array, *, dt: float = 1.0) -> None:
    """Raise DivergenceError where an entry of x, a velocity for dt, is not finite or goes beyond all bounds."""
    bound = min(MAX_STEP_TRAVEL / dt, _largest(x.dtype))
    if not np.abs(x).max(initial=0) <= bound:
        wrong = np.asarray(~(np.abs(x) <= bound))
        entry = tuple(int(k) for k in np.argwhere(wrong)[0])
        joint = joint_name_at(model, entry[-1])
        raise DivergenceError(
            f"the motion diverges: joint {joint!r} has {what}[{entry[-1]}] = {float(x[entry]):.3g}"
            f"{at_first_index(np.asarray(wrong.any(axis=-1)))}; a smaller dt or weaker forces?"
        )


def check_turn(model: Model, u: Array) -> None:
    """Raise DivergenceError where a ball, a floating base or a planar joint turns by more than 2π in a step u."""
    for name, joint, s in zip(model.joint_names, model.joints, model.v_slice):
        if isinstance(joint, GroupJoint) and joint.nv > 1:
            angle = np.linalg.norm(np.matvec(joint.subspace(u.dtype)[:3], u[..., s]), axis=-1).max(initial=0)
            if not angle <= 2 * np.pi:
                raise DivergenceError(f"joint {name!r} turns by more than a whole turn in one step, by {angle:.3g} rad")


@cache
def _largest(dtype: np.dtype[Any]) -> float:
    """Return half of the largest number that the algorithms take."""
    return float(np.finfo(dtype).max ** (1 / 5)) / 2
