"""How far off a motion is at its end: what each step adds to the error, and what the motion itself makes of it.

A pendulum that hangs keeps an error as small as it was; one that stands upright multiplies it by e every 0.3 s. So the
error of one step says little. Here the whole motion is computed again with half the steps, which contains both, and
once more from a start that is 1e-9 away, which shows the growth alone: as much is made of every rounding.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.kinematics import forward_kinematics
from ..arrays import Array, as_number
from ..model import Model, check_model
from .methods import METHODS
from .result import Simulation
from .run import simulate
from .system import Policy

__all__ = ["MotionError", "apart", "motion_error"]

LOOKS = 200
"""How often the two motions are compared, from the start to the end."""

LINEAR_MM = 1.0
"""Beyond this distance, mm, two motions are two motions, and no longer one with an error."""

MAX_EXPONENT = 700.0
"""The largest number whose exponential is a double, rounded down."""

NUDGE = 1e-9
"""How far from the start, in rad and m, the motion begins that shows the growth."""


class MotionError(NamedTuple):
    """Error of a motion at its end, from `motion_error`: how far the robot's worst point is off, in mm.

    Attributes
    ----------
    steps : ndarray, shape (...)
        By the size of the steps. The points are the origins of the frames and the centres of mass of the bodies.
    rounding : ndarray, shape (...)
        By rounding to 16 digits in every step.
    growth : ndarray, shape (...)
        What the motion multiplies a small error by, from the start to the end.
    """

    steps: Array
    rounding: Array
    growth: Array

    @property
    def total(self) -> Array:
        """Both together, mm."""
        return self.steps + self.rounding


def motion_error(
    model: Model,
    q: ArrayLike,
    v: ArrayLike,
    *,
    dt: float,
    duration: float,
    method: str = "rk4",
    tau: Policy | ArrayLike | None = None,
) -> MotionError:
    """Return how far off a motion without contacts is at its end.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)
        The start.
    dt, duration : float
        As `simulate` takes them, s.
    method : {"rk4", "euler", "semi-implicit", "midpoint", "variational"}
    tau : callable or array_like, shape (..., nv), optional
        As `simulate` takes it.

    Returns
    -------
    MotionError

    Raises
    ------
    DivergenceError, NameNotFound, ShapeError, ValueError
        As `simulate`.

    Notes
    -----
    With order p the motion is off by c dtᵖ, and with half the steps by 2⁻ᵖ of it: the difference of the two ends is
    1 − 2⁻ᵖ of the error (L. F. Richardson, 1911). So it is where the error is small against the motion.

    Examples
    --------
    >>> import twistwrench as tw
    >>> pendulum = tw.load("pendulum")
    >>> hangs = motion_error(pendulum, [0.1], [0.0], dt=0.01, duration=5.0)
    >>> stands = motion_error(pendulum, [np.pi - 0.01], [0.0], dt=0.01, duration=2.0)
    >>> round(float(hangs.growth), 1), float(stands.growth) > 150
    (1.0, True)
    """
    check_model(model)
    q, v = model.state(q, v=v)
    if not as_number(duration, "duration") > 0:
        raise ValueError(f"duration: expected a time above zero, s, got {duration!r}")
    rng = np.random.default_rng(0)
    aside = model.integrate(q, NUDGE * rng.choice([-1.0, 1.0], (*q.shape[:-1], model.nv)))
    options: dict[str, Any] = {"duration": duration, "method": method, "tau": tau}
    whole = simulate(model, q, v, dt=dt, **options)
    half = simulate(model, q, v, dt=dt / 2, **options)
    nudged = simulate(model, aside, v, dt=dt, **options)
    made = len(whole.t) - 1
    growth = _growth(model, whole, nudged)
    size = np.abs(_points(model, whole.q[-1])).max(axis=(-2, -1)) + 1  # m
    often = made / np.maximum(1, 2 * np.log(np.maximum(growth, 1)))  # steps whose rounding has grown that much
    rounding = 1e3 * size * np.finfo(np.float64).eps * np.sqrt(often) * np.maximum(growth, 1)
    share = 1 - 2.0 ** -METHODS[whole.method].order
    return MotionError(apart(model, whole.q[-1], half.q[-1]) / share, rounding, growth)


def _growth(model: Model, whole: Simulation, nudged: Simulation) -> Array:
    """Return by what the distance of two motions has grown; where it outgrows `LINEAR_MM`, at the rate up to then."""
    steps = len(whole.t) - 1
    looked = np.unique(np.linspace(0, steps, LOOKS).astype(int))
    distance = np.stack([apart(model, whole.q[k], nudged.q[k]) for k in looked])
    linear = np.cumsum(distance > LINEAR_MM, axis=0) == 0
    last = np.maximum(linear.sum(axis=0) - 1, 1)
    ratio = np.take_along_axis(distance, last[None], axis=0)[0] / distance[0]
    return np.asarray(np.exp(np.minimum(np.log(ratio) * steps / looked[last], MAX_EXPONENT)))


def apart(model: Model, q: Array, other: Array) -> Array:
    """Return the largest distance of a point of a robot in two configurations, mm."""
    off = _points(model, q) - _points(model, other)
    return np.asarray(1e3 * np.sqrt((off * off).sum(axis=-1)).max(axis=-1))


def _points(model: Model, q: Array) -> Array:
    """Return the origins of the frames that move, and the centres of mass, in the world, shape (..., n, 3)."""
    placement, *_ = forward_kinematics(model, q)
    frames = [(f.body, f.placement.translation) for f in model.frames.values() if f.body > 0]
    centres = [(i, model.inertia[i].com) for i in range(1, model.nbodies)]
    return np.stack([placement[i].act(point) for i, point in [*frames, *centres]], axis=-2)
