"""A jump that a robot could make: in flight only gravity acts.

The centre of mass pushes off, falls and lands along polynomials. So does the angular momentum k_G, which is constant in
flight; it is prescribed, and how the base turns follows from it. At every time the velocities of the tasks and k_G give
ω: a differential equation for the orientation, solved by collocation at Chebyshev points, all of them at once, again
and again until nothing changes (Picard).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial import Chebyshev

from ..algorithms.centroidal import centroidal_map
from ..arrays import Array
from ..errors import SingularError
from .curves import PiecewiseCurve, connect, hop, stair
from .inverse_kinematics import Goal, free_columns, nearer, place, solve, targets, tasks, turn_base, turning_jacobian
from .legs import Stand

__all__ = ["FOUR_LEGS", "TWO_LEGS", "Jump", "Leap"]

NODES_PER_PART = 24
"""Collocation points in each part of a phase."""
PARTS_PER_PHASE = 3
PICARD_ITERATIONS = 40
"""Of Picard's iteration, which needs about ten."""


@dataclass(frozen=True)
class Jump:
    """A jump, in units of the height H of the centre of mass, of √(g H) and of rad.

    Parameters
    ----------
    crouch, off : float
        Heights of the centre of mass before the jump and at take-off, H.
    rise : float
        How much higher it flies, H.
    ahead : float
        How far it flies, H.
    pitch : float
        How far a rigid robot would turn in flight, nose down, rad.
    tuck : float
        How much the legs are drawn up at the top, H.
    """

    crouch: float
    off: float
    rise: float
    ahead: float = 0.3
    pitch: float = 0.15
    tuck: float = 0.05


FOUR_LEGS = Jump(crouch=0.85, off=1.05, rise=0.15)
TWO_LEGS = Jump(crouch=0.82, off=0.88, rise=0.04, ahead=0.03, pitch=0.02, tuck=0.0)


class Leap:
    """A robot in a jump: how its body parts should move at any time.

    Parameters
    ----------
    stand : Stand
    jump : Jump
    """

    def __init__(self, stand: Stand, jump: Jump) -> None:
        self.stand, self.jump = stand, jump
        g, H = stand.height / stand.unit**2, stand.height
        up = float(np.sqrt(2 * g * jump.rise * H))
        self.push, self.flight = 2.2 * (jump.off - jump.crouch) * H / up, 2 * up / g  # 2.2: the force stays positive
        self.breaks = np.cumsum([0, self.push, self.flight, self.push])
        before, flying, after = ((self.breaks[k], self.breaks[k + 1]) for k in range(3))

        ahead = jump.ahead * H / self.flight  # speed
        leaves = ahead * self.push / 2
        lands = ahead * self.push / 2 + jump.ahead * H
        self.distance = leaves + lands
        low, high = (stand.com[2] + (share - 1) * H for share in (jump.crouch, jump.off))
        x0, y0 = stand.com[:2]
        x = [
            connect([x0, 0, 0, 0], [x0 + leaves, ahead, 0, 0], before),
            connect([x0 + leaves], [x0 + lands], flying),
            connect([x0 + lands, ahead, 0, 0], [x0 + self.distance, 0, 0, 0], after),
        ]
        z = [
            connect([low, 0, 0, 0], [high, up, -g, 0], before),
            connect([high, up], [high], flying),
            connect([high, -up, -g, 0], [low, 0, 0, 0], after),
        ]
        y = [connect([y0], [y0], span) for span in (before, flying, after)]
        self.com = PiecewiseCurve(self.breaks, list(zip(x, y, z)))
        self.momentum = self._momentum([before, flying, after])
        self.turn = self._turn()

    def goal(self, t: Array) -> Goal:
        """Return how the robot should move at times t, shape (n,)."""
        return self._goal(t, self.turn(t))

    def stands(self, t: Array) -> Array:
        """Return which of the model's feet stand, shape (n, k): all or none."""
        flies = (t.real > self.breaks[1]) & (t.real < self.breaks[2])
        return np.repeat(~flies[:, None], len(self.stand.model.feet), axis=1)

    def _goal(self, t: Array, turn: Array) -> Goal:
        pace = 1 / self.flight
        H = self.stand.height
        s = (t - self.breaks[1]) * pace
        up = (self.jump.rise + self.jump.tuck) * H * hop(s, pace)
        step = np.stack([self.distance * stair(s, pace), np.zeros_like(up), up], axis=-1)
        steps = np.repeat(step[:, :, None], len(self.stand.legs), axis=2)
        return Goal(self.com(t), turn, steps, np.zeros((3, len(t), self.stand.model.nv), t.dtype))

    def _momentum(self, spans: list[tuple[float, float]]) -> PiecewiseCurve:
        """Return k_G: about y, constant in flight; as much nose up as nose down, so that it ends nearly level."""
        I_y = centroidal_map(self.stand.model, self.stand.q)[1, 1]
        k = float(I_y) * self.jump.pitch / self.flight
        zero = connect([0.0], [0.0], spans[0])
        held = k * self.flight
        about_y = [
            connect([0, 0, 0], [k, 0, 0], spans[0], area=-held / 2),
            connect([k], [k], spans[1]),
            connect([k, 0, 0], [0, 0, 0], spans[2], area=-held / 2),
        ]
        return PiecewiseCurve(self.breaks, [(zero, p, zero) for p in about_y])

    def _turn(self) -> PiecewiseCurve:
        """Return φ(t): solve J(φ) φ̇ = ω, where momentum and tasks determine ω in the posture with that φ.

        Raises
        ------
        SingularError
            If the iteration does not converge.
        """
        breaks = np.concatenate([np.linspace(*span, PARTS_PER_PHASE, endpoint=False) for span in pairwise(self.breaks)])
        spans = list(pairwise([*breaks, self.breaks[-1]]))
        points = np.cos(np.pi * (np.arange(NODES_PER_PART) + 0.5) / NODES_PER_PART)
        t = np.concatenate([(a + b) / 2 + (b - a) / 2 * points for a, b in spans])
        goal = self._goal(t, np.zeros((3, len(t), 3)))
        q = place(self.stand, goal)
        for _ in range(PICARD_ITERATIONS):
            phi = goal.turn[0]
            rate = np.linalg.solve(turning_jacobian(phi), self._angular_velocity(t, q, goal)[..., None])[..., 0]
            turn = _integral(spans, t, rate)
            goal = goal._replace(turn=turn(t))
            q, error = nearer(self.stand, goal, turn_base(self.stand, goal, q))  # one step: it converges with φ
            if max(np.abs(goal.turn[0] - phi).max(), error.max()) < 1e-13:
                return turn
        raise SingularError(
            f"{self.stand.model.name!r}: no turning of the base found that has the momentum of the jump"
        )

    def _angular_velocity(self, t: Array, q: Array, goal: Goal) -> Array:
        """Return the ω, in the base's axes, that gives the robot its momentum and the feet their velocities."""
        model = self.stand.model
        free = free_columns(self.stand)
        A_G = centroidal_map(model, q)[..., :3, :]
        J = np.concatenate([A_G, tasks(self.stand, q)], axis=-2)[..., [0, 1, 2, *free]]
        wanted = np.concatenate([self.momentum(t)[0], targets(self.stand, goal, 1)], axis=-1)
        return solve(self.stand, J, wanted)[..., :3]


def _integral(spans: list[tuple[float, float]], t: Array, rate: Array) -> PiecewiseCurve:
    """Return the integral of what has the values `rate` at the times t, as many of them in each span."""
    pieces = list[list[Chebyshev]]()
    value = np.zeros(rate.shape[1])
    for span, times, rates in zip(spans, t.reshape(len(spans), -1), rate.reshape(len(spans), -1, rate.shape[1])):
        fits = [Chebyshev.fit(times, x, len(times) - 1, domain=span) for x in rates.mT]
        pieces.append([fit.integ(lbnd=span[0], k=float(x)) for fit, x in zip(fits, value)])
        value = np.array([p(span[1]) for p in pieces[-1]])
    return PiecewiseCurve([span[0] for span in spans] + [spans[-1][1]], pieces)
