"""Every source of error of one motion, on one scale.

Which digits does a controller need? Those that the largest other error does not drown. So each source alone is put into
the same motion, from the rounding of a float64 to a template, and is measured in what people think in: N m at the worst
motor, mm of the centre of pressure.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench.motions import Motion

from .sources import SOURCES, rounded

__all__ = ["Source", "budget"]


class Source(NamedTuple):
    """A source of error, and what it does to one motion at worst.

    Attributes
    ----------
    name : str
    kind : str
        Number, time, model, state or slip.
    torque : float
        Largest error of a motor's torque, N m (of a prismatic joint N).
    joint : str
        Where.
    pressure : float
        Largest shift of the centre of pressure, mm.
    """

    name: str
    kind: str
    torque: float
    joint: str
    pressure: float


def budget(model: tw.Model, motion: Motion) -> Iterator[Source]:
    """Put each source of error alone into a motion, and measure what it does to the torques and to the ground.

    Parameters
    ----------
    model : Model
        With a floating base.
    motion : Motion
        Evenly sampled.

    Yields
    ------
    Source
        In the order of `SOURCES`.

    Examples
    --------
    A degree of the base costs a Go2 ten thousand times what float32 costs:

    >>> model = tw.load("go2")
    >>> found = {source.name: source for source in budget(model, tw.motions.trot(model, samples=100))}
    >>> found["base pitched by 1°"].torque > 1e4 * found["float32"].torque
    True
    """
    true = rounded("longdouble")(model, motion)
    motors = [name for name, dofs in zip(model.joint_names, model.v_slice) for _ in range(dofs.stop - dofs.start)][6:]
    for name, (kind, changed) in SOURCES.items():
        found = changed(model, motion)
        wrong = np.abs(found.tau - true.tau).max(axis=0)
        worst = int(wrong.argmax())
        shift = np.sqrt(((found.pressure - true.pressure) ** 2).sum(axis=1))
        yield Source(name, kind, float(wrong[worst]), motors[worst], 1e3 * float(np.nanmax(shift)))
