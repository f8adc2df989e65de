"""Who touches when: a motion cut into the stretches of time in which the same contacts stand (49.9)."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..arrays import Array
from ..contact import Contact
from ..model import Model
from ..motions import Motion
from ..motions.motion import check_motion

if TYPE_CHECKING:
    from .scene import Scene

__all__ = ["Phase", "phases"]


class Phase(NamedTuple):
    """A stretch of a motion in which the same contacts stand: one entry of what `Scene.phases` returns.

    Attributes
    ----------
    start, end : float
        The times of its first and its last state, s.
    states : slice
        Which states of the motion it has.
    scene : Scene
        With the contacts that stand. Its `model` is the same in all phases.
    """

    start: float
    end: float
    states: slice
    scene: Scene


def phases(scene: Scene, motion: Motion) -> tuple[Phase, ...]:
    """See `Scene.phases`."""
    check_motion(motion)
    scene.full_model.state(motion.q, v=motion.v, a=motion.a)  # raises where it is another robot's
    stands = standing_contacts(scene.full_model, scene.contacts, motion)
    scenes: dict[bytes, Scene] = {}
    found: list[Phase] = []
    for states in stretches(stands):
        row = stands[states.start]
        t = motion.t[states]
        if row.tobytes() not in scenes:
            scenes[row.tobytes()] = copy(scene)
            scenes[row.tobytes()].contacts = tuple(c for c, on in zip(scene.contacts, row) if on)
        found.append(Phase(float(t[0]), float(t[-1]), states, scenes[row.tobytes()]))
    return tuple(found)


def standing_contacts(model: Model, contacts: Sequence[Contact], motion: Motion) -> Array:
    """Return which contacts stand at each time, bool of shape (n, k).

    A contact stands with the foot on its frame, or else with all feet on its body; one on a body without feet always
    does, and so does what holds two frames of the robot together.
    """
    body = [model.frame(foot).body for foot in motion.feet]
    columns = list[Array]()
    for contact in contacts:
        if contact.to is None and contact.frame in motion.feet:
            columns.append(motion.contacts[:, motion.feet.index(contact.frame)])
        else:
            on = [
                k for k, carrier in enumerate(body) if (contact.to, carrier) == (None, model.frame(contact.frame).body)
            ]
            columns.append(np.asarray(motion.contacts[:, on].all(axis=1)))
    return np.stack(columns, axis=1) if columns else np.zeros((len(motion), 0), bool)


def stretches(stands: Array) -> list[slice]:
    """Return the stretches of rows that are alike."""
    change = np.flatnonzero((stands[1:] != stands[:-1]).any(axis=1)) + 1
    edges = [0, *change.tolist(), len(stands)]
    return [slice(a, b) for a, b in pairwise(edges)]
