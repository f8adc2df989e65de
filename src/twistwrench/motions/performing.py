"""The three motions, for any robot of the catalogue that has legs of three or six joints."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..model import Model
from .following import follow
from .gaits import BRISK_WALK, CRAWL, TROT, WALK, Gait, Steps
from .legs import stand
from .motion import Motion

__all__ = ["MOTIONS", "jump", "trot", "walk"]


def walk(model: Model, *, samples: int = 200) -> Motion:
    """Return a slow walk: one stride, over which the robot goes straight ahead at a steady pace.

    With four legs a crawl, one foot at a time. The trunk stays level, and at one height.

    Parameters
    ----------
    model : Model
        A robot that stands on two or four legs (`Model.feet`), each of three joints and a point foot or of six and a
        sole.
    samples : int
        Number of states, evenly spaced over the stride.

    Returns
    -------
    Motion

    Raises
    ------
    ModelError
        If the robot has no such legs.
    SingularError
        If they are too short for these steps.

    Examples
    --------
    >>> import twistwrench as tw
    >>> walk(tw.load("go2"), samples=50).contacts.sum(axis=1).min()  # never less than three feet
    np.int64(3)
    """
    return _steps(model, "walk", {4: CRAWL, 2: WALK}, samples)


def trot(model: Model, *, samples: int = 200) -> Motion:
    """Return a trot: one stride. Diagonal legs together; on two legs it is a brisk walk.

    Parameters
    ----------
    model : Model
        As for `walk`.
    samples : int
        Number of states, evenly spaced over the stride.

    Returns
    -------
    Motion

    Raises
    ------
    ModelError, SingularError
        As `walk`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> motion = trot(tw.load("go2"))
    >>> round(float(abs(motion.v).max()), 1)  # rad/s, of a knee
    14.4
    """
    return _steps(model, "trot", {4: TROT, 2: BRISK_WALK}, samples)


def jump(model: Model, *, samples: int = 200) -> Motion:
    """Return a jump forward off all feet, in which the trunk pitches.

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
    ModelError, SingularError
        As `walk`.
    """
    raise NotImplementedError


def _steps(model: Model, name: str, gaits: dict[int, Gait], samples: int) -> Motion:
    standing = stand(model)
    steps = Steps(standing, gaits.get(len(standing.legs), gaits[4]))
    t = np.linspace(0, steps.period, samples)
    q, v, a = follow(standing, steps.goal(t))
    return Motion(name, t, q, v, a, model.feet, steps.stands(t))


MOTIONS: dict[str, Callable[..., Motion]] = {"walk": walk, "trot": trot, "jump": jump}
"""Every motion by its name."""
