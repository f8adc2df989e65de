"""The method and the step with the least work that keep the error of a motion."""

from __future__ import annotations

import time
from contextlib import suppress
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .arrays import Array, as_number
from .model import Model
from .simulation import METHODS, DivergenceError, simulate
from .simulation.growth import motion_error

__all__ = ["Plan", "StepSize", "cheapest_steps"]

STARTS = 64
"""Random starts of a motion."""

SAFETY = 1.5
"""On the estimated error."""

FIRST_DT, MAX_DT = 0.01, 0.1
"""The step that is tried first, and the longest, s."""

AIM = 0.7
"""The share of the error that is allowed for which a step is predicted."""

WORTH_TRYING, MAX_CHANGE = 1.2, 16.0
"""By how much a step must differ from one that does, to be tried; and by how much it may change at once."""

STEADY = 10.0
"""A motion that multiplies errors by less is not what makes them large."""

MAX_STEPS = 200_000
"""No method is tried with more."""

MAX_TRIES = 8

EVALUATIONS = {"rk4": 4, "midpoint": 2, "semi-implicit": 1}
"""Of q̈ in a step. The variational method has the order of the midpoint rule, and costs more."""

TRIED = tuple(EVALUATIONS)


class StepSize(NamedTuple):
    """A method and a step: the largest error, mm, and the seconds that a motion takes here."""

    method: str
    dt: float
    error: float
    seconds: float
    steps: int

    @property
    def work(self) -> int:
        """Evaluations of q̈."""
        return self.steps * EVALUATIONS[self.method]


class Plan(NamedTuple):
    """Result of `cheapest_steps`: the ways that were tried, and in words what they are worth."""

    ways: tuple[StepSize, ...]
    starts: int
    sure: str
    instead: str


def cheapest_steps(
    model: Model,
    within: float,
    duration: float,
    start: tuple[ArrayLike, ArrayLike] | None = None,
    *,
    progress: bool = False,
) -> Plan:
    """Return for each method the longest step that keeps every point of a motion within so many mm, and its time.

    Parameters
    ----------
    model : Model
    within : float
        mm.
    duration : float
        s.
    start : tuple of array_like, optional
        q and v; 64 random ones unless given.
    progress : bool
        Show what is being tried.
    """
    if not 0 < as_number(duration, "duration") < np.inf:
        raise ValueError(f"duration: expected a time above zero, s, got {duration!r}")
    q, v = _starts(model) if start is None else model.state(start[0], v=start[1])
    starts = int(np.prod(q.shape[:-1], dtype=int))
    ways = list[StepSize]()
    for method in TRIED:
        most = min([MAX_STEPS, *(way.work / EVALUATIONS[method] for way in ways if way.error <= within)])
        ways.append(_longest_step(model, method, within, duration, q, v, most, progress))
    sure = (
        "of the motion from this start"
        if start is not None
        else (
            f"the largest error of {starts} motions from random states, without joint forces: with 95 % confidence, "
            f"{0.05 ** (1 / starts):.0%} of all such motions are less far off"
        )
    )
    instead = "" if any(way.error <= within for way in ways) else _horizon(model, within, duration, q, v)
    return Plan(tuple(ways), starts, sure, instead)


def _starts(model: Model) -> tuple[Array, Array]:
    """Draw states: q within the limits, v of 1 rad/s and 1 m/s."""
    rng = np.random.default_rng(0)
    return model.random_configuration(STARTS, rng=rng), rng.standard_normal((STARTS, model.nv))


def _longest_step(
    model: Model, method: str, within: float, duration: float, q: Array, v: Array, most: float, progress: bool
) -> StepSize:
    """Return the longest step of a method that keeps the error; the last one tried if that takes more than most."""
    order = METHODS[method].order
    count = int(np.ceil(duration / FIRST_DT))
    kept: StepSize | None = None
    too_few = 0  # steps that did not keep the error, or could not
    tried = StepSize(method, duration / count, np.inf, np.inf, count)
    for _ in range(MAX_TRIES):
        if count > most and np.isfinite(tried.error):
            break
        dt = duration / count
        if progress:
            print(f"{method}, dt = {dt:.3g} s ...", flush=True)
        try:
            found = motion_error(model, q, v, dt=dt, duration=duration, method=method)
        except DivergenceError:
            too_few = count
            count = int(np.sqrt(count * kept.steps)) if kept else 4 * count
            continue
        error = float(SAFETY * found.total.max())
        tried = StepSize(method, dt, error, np.nan, count)
        if error <= within:
            kept = tried
        elif SAFETY * found.rounding.max() > within:
            break
        else:
            too_few = count
        change = (error / (AIM * within)) ** (1 / order)
        if kept:
            fewest = max(too_few, int(duration / MAX_DT))
            count = max(int(np.ceil(count * change)), int(np.ceil(np.sqrt(fewest * kept.steps))))
            if count * WORTH_TRYING > kept.steps:
                break
        else:
            count = int(np.ceil(count * np.clip(change, WORTH_TRYING, MAX_CHANGE)))
    best = kept or tried
    return best._replace(seconds=_seconds(model, best, duration, q, v))


def _seconds(model: Model, way: StepSize, duration: float, q: Array, v: Array) -> float:
    """Return the processor time of one motion, the first."""
    first = (0,) * (q.ndim - 1)
    try:
        simulate(model, q[first], v[first], dt=way.dt, steps=1, method=way.method)  # its programs are made
        begin = time.process_time()
        simulate(model, q[first], v[first], dt=way.dt, duration=duration, method=way.method)
    except DivergenceError:
        return np.inf
    return time.process_time() - begin


def _horizon(model: Model, within: float, duration: float, q: Array, v: Array) -> str:
    """Return in words how long the error of a double stays within so many mm, as it grows with the motion."""
    with suppress(DivergenceError):
        dt = duration / np.ceil(duration / FIRST_DT)
        if motion_error(model, q, v, dt=dt, duration=duration).growth.max() < STEADY:
            return "the rounding of doubles alone is more"
    shortest = duration
    while shortest > duration / 1000:
        shortest /= 2
        dt = shortest / np.ceil(shortest / (FIRST_DT / 4))
        try:
            found = motion_error(model, q, v, dt=dt, duration=shortest)
        except DivergenceError:
            continue
        if SAFETY * found.rounding.max() <= within:
            return f"the motion multiplies errors; for {shortest:.2g} s doubles are exact enough, and a smaller dt does"
    return "the motion multiplies errors faster than doubles can follow"
