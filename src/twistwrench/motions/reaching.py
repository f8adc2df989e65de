"""From one configuration to another, on any robot: an arm, a drone, a cart."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import as_count, as_number
from ..errors import ShapeError
from ..model import Model, check_model
from .curves import stair
from .motion import Motion

__all__ = ["reach"]


def reach(model: Model, q0: ArrayLike, q1: ArrayLike, *, duration: float = 1.0, samples: int = 200) -> Motion:
    """Return a motion of any robot from rest in one configuration to rest in another.

    It goes straight, q = q0 ⊕ s(t) (q1 ⊖ q0): each joint along one twist, at the pace of a smooth step s.

    Parameters
    ----------
    model : Model
    q0, q1 : array_like, shape (nq,)
        Where it begins and ends.
    duration : float
        s, above 0.
    samples : int
        Number of states, evenly spaced.

    Returns
    -------
    Motion
        Without feet.

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`; if q0 or q1 is a batch; if the duration is not above 0, or there are less than two samples.

    Examples
    --------
    >>> import twistwrench as tw
    >>> arm = tw.load("planar_arm")
    >>> swing = reach(arm, arm.neutral(), [1.0, -0.5, 0.2], duration=0.8)
    >>> swing, swing.v.max().round(3)
    (<Motion 'reach': 200 states in 0.8 s, 0 feet>, np.float64(2.734))
    """
    check_model(model)
    way = model.difference(q0, q1)
    if way.ndim != 1 or way.dtype.kind == "c":
        raise ShapeError(f"q0, q1: expected one real configuration each, got a difference of shape {way.shape}")
    duration = as_number(duration, "duration")
    if not 0 < duration < np.inf:
        raise ValueError(f"duration: expected a number above 0, got {duration!r}")
    t = np.linspace(0, duration, as_count(samples, "samples", 2))
    s, pace, change = stair(t / duration, 1 / duration)[..., None]
    q = model.integrate(np.broadcast_to(q0, (len(t), model.nq)), s * way)
    return Motion("reach", t, q, pace * way, change * way, (), np.zeros((len(t), 0), bool))
