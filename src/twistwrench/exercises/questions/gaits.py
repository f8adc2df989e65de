"""Three prescribed gaits of Go2 by formulas: a slow walk, a trot and a bound. Time may be complex, for derivatives."""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw

__all__ = ["GAITS", "PrescribedGait", "acceleration", "move"]

TINY = 1e-100  # s, step of the complex-step derivative


class PrescribedGait(NamedTuple):
    """How the legs swing and the trunk goes along; a leg whose phase is 0 is in the middle of its swing at t = 0."""

    strides: float  # per second
    phases: tuple[float, float, float, float]  # of FL, FR, RL, RR, in strides
    sway: float = 0.4  # rad, of a leg
    bend: float = 0.7  # rad, of a knee while its leg swings forward
    bob: float = 0.0095  # m, of the trunk
    pitch: float = 0.0  # rad, of the trunk

    @property
    def speed(self) -> float:
        """Speed in m/s at which the feet that stand do not slide, nearly."""
        return float(self.sway * 2 * np.pi * self.strides * _standing_height())


GAITS = {
    "slow walk": PrescribedGait(0.5, (0, 0.5, 0.75, 0.25), sway=0.15, bend=0.3, bob=0.0),
    "trot": PrescribedGait(2.5, (0, 0.5, 0.5, 0)),
    "bound": PrescribedGait(2.5, (0, 0, 0.5, 0.5), pitch=0.15),
}


def move(t: Any, gait: PrescribedGait) -> tuple[np.ndarray, np.ndarray]:
    """Return q and v of Go2 at times t."""
    t, w, height = np.asarray(t)[..., None], 2 * np.pi * gait.strides, _standing_height()
    phase = w * t + 2 * np.pi * np.array(gait.phases)
    sway, d_sway = -gait.sway * np.sin(phase), -gait.sway * w * np.cos(phase)
    lift = (1 + np.cos(phase)) / 2
    knee, d_knee = 1.8 + gait.bend * lift**2, -gait.bend * w * lift * np.sin(phase)
    legs = np.stack([0 * sway, sway + knee / 2, -knee], axis=-1).reshape(*t.shape[:-1], 12)
    d_legs = np.stack([0 * sway, d_sway + d_knee / 2, -d_knee], axis=-1).reshape(*t.shape[:-1], 12)

    z = height + gait.bob * (1 - np.cos(2 * w * t)) + 0.19 * gait.pitch
    d_z = 2 * gait.bob * w * np.sin(2 * w * t)
    tilt, d_tilt = -gait.pitch * np.cos(w * t), gait.pitch * w * np.sin(w * t)
    none, c, s = 0 * t, np.cos(tilt), np.sin(tilt)
    q = [gait.speed * t, none, z, none, np.sin(tilt / 2), none, np.cos(tilt / 2), legs]
    v = [none, d_tilt, none, c * gait.speed - s * d_z, none, s * gait.speed + c * d_z, d_legs]  # in the base's axes
    return np.concatenate(q, axis=-1), np.concatenate(v, axis=-1)


def acceleration(t: Any, gait: PrescribedGait) -> np.ndarray:
    """Return the rate of v."""
    return np.asarray(move(np.asarray(t) + 1j * TINY, gait)[1].imag / TINY)


@cache
def _standing_height() -> float:
    return float(tw.load("go2").standing()[2])
