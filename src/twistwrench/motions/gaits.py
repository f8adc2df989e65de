"""Walk and trot: a schedule of steps, and the centre of mass of a pendulum (49.10).

The feet are loaded and unloaded smoothly; the weighted mean of the loaded ones is where the centre of pressure should
be, inside the support polygon. For a pendulum of constant height the centre of mass of a steady gait then follows in
closed form, harmonic by harmonic: x_n = p_n / (1 + (n ω)² z / g). The plan
neglects what the legs' own momentum does to the centre of pressure; the templates measure it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..algorithms.kinematics import forward_kinematics
from ..arrays import Array
from ..errors import ModelError
from .curves import Harmonics, hop, stair
from .inverse_kinematics import Goal
from .legs import Stand

__all__ = ["BRISK_WALK", "CRAWL", "TROT", "WALK", "Gait", "Steps"]

HARMONICS = 13
SAMPLES = 256


@dataclass(frozen=True)
class Gait:
    """A steady gait, in units of the height H of the centre of mass and of √(H/g).

    Parameters
    ----------
    period : float
        Of one stride, √(H/g).
    duty : float
        The share of the stride for which a foot stands.
    ramp : float
        The share of the stride in which a foot is loaded, and in which it is unloaded again.
    phases : tuple of float
        When in the stride each leg comes down: left and right, or front left, front right, rear left, rear right.
    speed : float
        √(g H).
    height : float
        Of the centre of mass, H.
    lift, bob : float
        How high a foot and how far up and down the centre of mass goes, H.
    swing : float
        How far the arms swing, rad.
    turn : tuple of float
        How far the base rolls and yaws once in a stride and pitches twice, rad: roll, pitch, yaw.
    direction : float
        Where it goes, from straight ahead to the left, rad. It does not turn.
    """

    period: float
    duty: float
    ramp: float
    phases: tuple[float, ...]
    speed: float
    height: float = 1.0
    lift: float = 0.15
    bob: float = 0.0
    swing: float = 0.0
    turn: tuple[float, float, float] = (0.0, 0.0, 0.0)
    direction: float = 0.0


LEFT_RIGHT = (0.0, 0.5)
CRAWL = Gait(14.0, 0.8, 0.1, phases=(0.25, 0.75, 0.0, 0.5), speed=0.045, turn=(0.02, 0.0, 0.0))
TROT = Gait(2.6, 0.58, 0.08, phases=(0.0, 0.5, 0.5, 0.0), speed=0.4, lift=0.2, bob=0.02, turn=(0.02, 0.02, 0.02))
WALK = Gait(7.0, 0.65, 0.15, LEFT_RIGHT, speed=0.08, height=0.94, lift=0.05, swing=0.1, turn=(0.02, 0.0, 0.04))
BRISK_WALK = Gait(
    4.4, 0.6, 0.1, LEFT_RIGHT, speed=0.14, height=0.93, lift=0.04, bob=0.01, swing=0.25, turn=(0.02, 0.0, 0.08)
)


class Steps:
    """A robot in a gait: how its body parts should move at any time.

    Parameters
    ----------
    stand : Stand
    gait : Gait
    """

    def __init__(self, stand: Stand, gait: Gait) -> None:
        self.stand, self.gait = stand, gait
        self.period = gait.period * stand.unit
        self.speed = gait.speed * stand.height / stand.unit
        self.phase = _phases(stand, gait)
        self.arms = _arms(stand)
        times = np.arange(SAMPLES) / SAMPLES * self.period
        w = 2 * np.pi / self.period * np.arange(HARMONICS)
        gain = 1 / (1 + w**2 * gait.height * stand.unit**2)
        self.ahead = np.array([np.cos(gait.direction), np.sin(gait.direction), 0])
        drift = self.speed * self.ahead
        self.path = Harmonics(drift, self.pressure(times) - times[:, None] * drift, self.period, gain)

    def goal(self, t: Array) -> Goal:
        """Return how the robot should move at times t, shape (n,)."""
        com = self.path(t)
        com[..., 2] = self.gait.bob * self.stand.height * self._cosine(t, 2)  # twice: onto each foot or pair of feet
        com[0, ..., 2] += self.stand.com[2] - (1 - self.gait.height) * self.stand.height
        turn = np.stack([size * self._cosine(t, n) for size, n in zip(self.gait.turn, (1, 2, 1))], axis=-1)
        steps = np.stack([self.step(t, phase) for phase in self.phase], axis=2)
        return Goal(com, turn, steps, self._swing(t))

    def step(self, t: Array, phase: float) -> Array:
        """Return the jet of how far one foot is from where it stands in the standing posture, shape (3, n, 3)."""
        gait = self.gait
        turns, u = self._stride(t, phase)
        pace = 1 / self.period / (1 - gait.duty)
        s = (u - gait.duty) / (1 - gait.duty)
        stride = self.speed * self.period
        x = stride * stair(s, pace)
        x[0] += stride * (turns + phase + gait.duty / 2)  # below the hip in the middle of its stance
        up = gait.lift * self.stand.height * hop(s, pace)
        return np.asarray(x[..., None] * self.ahead + up[..., None] * [0, 0, 1])

    def stands(self, t: Array) -> Array:
        """Return which of the model's feet stand, shape (n, k)."""
        out = np.zeros((len(t), len(self.stand.model.feet)), bool)
        for leg, phase in zip(self.stand.legs, self.phase):
            out[:, leg.feet] = (self._stride(t, phase)[1].real <= self.gait.duty)[:, None]
        return out

    def pressure(self, t: Array) -> Array:
        """Return where the centre of pressure should be: the mean of the feet, each as it is loaded, shape (n, 3)."""
        load, loaded = np.zeros((len(t), 1)), np.zeros((len(t), 3))
        for leg, phase in zip(self.stand.legs, self.phase):
            u = self._stride(t, phase)[1]
            on = stair(u / self.gait.ramp, 1)[0]
            off = stair((self.gait.duty - u) / self.gait.ramp, 1)[0]
            w = (on * off)[:, None]
            load = load + w
            loaded = loaded + w * (leg.center + self.step(t, phase)[0] * [1, 1, 0])
        return np.asarray(loaded / load)

    def _stride(self, t: Array, phase: float) -> tuple[Array, Array]:
        """Return how many strides a leg has begun before this one, and how far it is in this one, 0 to 1."""
        strides = t / self.period - phase
        turns = np.floor(strides.real)
        return turns, strides - turns

    def _swing(self, t: Array) -> Array:
        """Return the jet of the arms, each against the leg of its side, shape (3, n, nv)."""
        out = np.zeros((3, len(t), self.stand.model.nv), t.dtype)
        for column, sign, left in self.arms:
            late = self.gait.phases[int(not left)] + self.gait.duty / 2 - 0.25  # cos(· + π/2): back when it is ahead
            out[..., column] = sign * self.gait.swing * self._cosine(t - late * self.period, 1)
        return out

    def _cosine(self, t: Array, times: int) -> Array:
        """Return the jet of a cosine that many times a stride, shape (3, n)."""
        w = 2 * np.pi * times / self.period
        return np.stack([np.cos(w * t), -w * np.sin(w * t), -(w**2) * np.cos(w * t)])


def _phases(stand: Stand, gait: Gait) -> list[float]:
    """Return each leg's phase, whatever order the legs come in."""
    if len(stand.legs) != len(gait.phases):
        raise ModelError(f"{stand.model.name!r}: expected {len(gait.phases)} legs for this gait, got {len(stand.legs)}")
    off = [leg.center - stand.com for leg in stand.legs]
    corners = [2 * int(p[0] < 0) * (len(off) == 4) + int(p[1] < 0) for p in off]
    return [gait.phases[k] for k in corners]


def _arms(stand: Stand) -> list[tuple[int, float, bool]]:
    """Return the joint that swings each arm: its place in v, the sign that swings back, and whether it is the left one.

    The first on its branch that is beside the middle plane, turns about y and is of no leg.
    """
    model = stand.model
    T = forward_kinematics(stand.model, stand.q).placement
    legs = {column for leg in stand.legs for column in leg.columns}
    found = list[tuple[int, float, bool]]()
    taken = set[int]()
    for i in range(2, model.nbodies):
        joint = model.joints[i]
        column = model.v_slice[i].start
        axis = T[i].rotation @ joint.subspace()[:3, 0] if joint and joint.nv == 1 else np.zeros(3)
        beside = abs(T[i].translation[1]) > 0.05 * stand.height
        if column not in legs and beside and abs(axis[1]) > 0.9 and not taken & set(model.support(i)):
            taken.add(i)
            found.append((column, float(np.sign(axis[1])), bool(T[i].translation[1] > 0)))
    return found
