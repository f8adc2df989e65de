"""The three motions, for any robot of the catalogue that has legs of three or six joints."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..arrays import as_count, as_number
from ..model import Model
from .gaits import BRISK_WALK, CRAWL, TROT, WALK, Gait, Steps
from .inverse_kinematics import follow
from .jumping import FOUR_LEGS, TWO_LEGS, Leap
from .legs import Stand, stand
from .motion import Motion

__all__ = ["MOTIONS", "jump", "trot", "walk"]

MAX_IN_HEIGHTS = 100.0
"""In units of the height of the centre of mass, and of the time of falling from it: no leg reaches farther."""


def walk(
    model: Model,
    *,
    samples: int = 200,
    speed: float | None = None,
    height: float | None = None,
    direction: float = 0.0,
    step_length: float | None = None,
) -> Motion:
    """Return a slow walk: one stride, over which the robot goes straight on at a steady pace.

    With four legs a crawl, one foot at a time. The trunk stays level, and at one height.

    Parameters
    ----------
    model : Model
        A robot that stands on two or four legs (`Model.feet`), each of three joints and a point foot or of six and a
        sole.
    samples : int
        Number of states, evenly spaced over the stride.
    speed : float, optional
        m/s, at least 0; at 0 it steps in place.
    height : float, optional
        Of the centre of mass above the ground, m.
    direction : float, optional
        Where it goes, rad from straight ahead to the left; π is backwards. The robot does not turn.
    step_length : float, optional
        How far a foot is set when it steps, m. By it and the speed the time of a stride is changed.

    Returns
    -------
    Motion

    Raises
    ------
    ModelError
        If the robot has no such legs.
    SingularError
        If they are too short for these steps.
    ValueError
        If there are less than two samples, or another number is out of its range.

    Examples
    --------
    >>> import twistwrench as tw
    >>> walk(tw.load("go2"), samples=50).contacts.sum(axis=1).min()  # never less than three feet
    np.int64(3)
    """
    return _steps(model, "walk", {4: CRAWL, 2: WALK}, samples, speed, height, direction, step_length)


def trot(
    model: Model,
    *,
    samples: int = 200,
    speed: float | None = None,
    height: float | None = None,
    direction: float = 0.0,
    step_length: float | None = None,
) -> Motion:
    """Return a trot: one stride. Diagonal legs together; on two legs it is a brisk walk.

    Parameters
    ----------
    model : Model
        As for `walk`.
    samples : int
        Number of states, evenly spaced over the stride.
    speed : float, optional
        m/s, at least 0; at 0 it steps in place.
    height : float, optional
        Of the centre of mass above the ground, m.
    direction : float, optional
        Where it goes, rad from straight ahead to the left; π is backwards. The robot does not turn.
    step_length : float, optional
        How far a foot is set when it steps, m. By it and the speed the time of a stride is changed.

    Returns
    -------
    Motion

    Raises
    ------
    ModelError, SingularError, ValueError
        As `walk`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> motion = trot(tw.load("go2"))
    >>> round(float(abs(motion.v).max()), 1)  # rad/s, of a knee
    15.0
    """
    return _steps(model, "trot", {4: TROT, 2: BRISK_WALK}, samples, speed, height, direction, step_length)


def jump(model: Model, *, samples: int = 200) -> Motion:
    """Return a jump forward off all feet, in which the trunk pitches.

    In flight the centre of mass falls freely and the angular momentum does not change, whatever the legs do: the way
    the trunk turns is solved for that.

    Parameters
    ----------
    model : Model
        As for `walk`.
    samples : int
        Number of states, evenly spaced.

    Returns
    -------
    Motion

    Raises
    ------
    ModelError, SingularError, ValueError
        As `walk`.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> motion = jump(model, samples=50)
    >>> flies = ~motion.contacts.any(axis=1)
    >>> bool(np.abs(tw.motions.ground(model, motion).wrench[flies]).max() < 1e-8)  # in flight the ground does nothing
    True
    """
    standing = stand(model)
    leap = Leap(standing, TWO_LEGS if len(standing.legs) == 2 else FOUR_LEGS)
    return _sample("jump", standing, leap, leap.breaks[-1], samples)


def _steps(
    model: Model,
    name: str,
    gaits: dict[int, Gait],
    samples: int,
    speed: float | None,
    height: float | None,
    direction: float,
    step_length: float | None,
) -> Motion:
    standing = stand(model)
    H, unit = standing.height, standing.unit
    ahead = _within(direction, "direction", -MAX_IN_HEIGHTS, MAX_IN_HEIGHTS)
    gait = replace(gaits.get(len(standing.legs), gaits[4]), direction=ahead)
    if speed is not None:
        pace = _within(speed, "speed", 0, MAX_IN_HEIGHTS * H / unit)
        gait = replace(gait, speed=pace * unit / H)
        name = f"{name} at {pace:.3g} m/s"
    if height is not None:
        gait = replace(gait, height=_within(height, "height", H / MAX_IN_HEIGHTS, MAX_IN_HEIGHTS * H) / H)
    if step_length is not None:
        if gait.speed == 0:
            raise ValueError(f"step_length: expected None, since the speed is 0, got {step_length!r}")
        length = _within(step_length, "step_length", H / MAX_IN_HEIGHTS, MAX_IN_HEIGHTS * H)
        gait = replace(gait, period=length / H / gait.speed)
    steps = Steps(standing, gait)
    return _sample(name, standing, steps, steps.period, samples)


def _within(value: float, name: str, least: float, most: float) -> float:
    """Return a number that is not absurd for a robot of this size: whether its legs are long enough is seen later."""
    number = as_number(value, name)
    if not least <= number <= most:
        raise ValueError(f"{name}: expected a number from {least:.3g} to {most:.3g}, got {value!r}")
    return number


def _sample(name: str, standing: Stand, plan: Steps | Leap, duration: float, samples: int) -> Motion:
    t = np.linspace(0, duration, as_count(samples, "samples", 2))
    q, v, a = follow(standing, plan.goal(t))
    return Motion(name, t, q, v, a, standing.model.feet, plan.stands(t))


MOTIONS: dict[str, Callable[..., Motion]] = {"walk": walk, "trot": trot, "jump": jump}
"""Every motion by its name."""
