"""What a URDF says of its joints, in time: damping, dry friction and the ends of their ranges.

A damping d is implicit: it acts at the velocity at the end of the step, (M + dt D) v⁺ = M v* + …, and is stable however
large it is. Dry friction is a force of at most f: what moves is braked by f, what rests needs more than f to start. The
end of a range is a row like that of a contact point: it pushes back, and never pulls.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..arrays import Array
from ..model import Model
from .cones import Answer, Metric

__all__ = ["Joints"]

OUTSIDE = 1e-9
"""rad or m: a joint that begins farther beyond its range is a mistake."""

CHANGES = 20
"""So often at most the joints with friction are asked again in a step which of them slide, and which way."""


class Joints:
    """The joints of one axis that have a range, and the degrees of freedom with dry friction.

    Raises
    ------
    ValueError
        If a joint is beyond its range in q, shape (..., nq).
    """

    def __init__(self, model: Model, q: Array) -> None:
        self.model = model
        ends = []
        for joint, sq, sv in zip(model.joints, model.q_slice, model.v_slice):
            if joint is None or not joint.nq == joint.nv == 1:
                continue
            for side, limit in ((1.0, model.lower[sq.start]), (-1.0, model.upper[sq.start])):
                if np.isfinite(limit):
                    ends.append((sq.start, sv.start, side, limit))
        at_q, at_v, self.sign, self.end = np.array(ends).reshape(len(ends), 4).mT
        self.at_q, self.rows = at_q.astype(int), np.zeros((len(ends), model.nv))
        self.rows[np.arange(len(ends)), at_v.astype(int)] = self.sign
        self.friction = np.flatnonzero(model.friction > 0)
        self._refuse_outside(q)

    def gap(self, q: Array) -> Array:
        """Return how far the joints are from the ends of their ranges, below 0 outside."""
        return np.asarray(self.sign * (q[..., self.at_q] - self.end))

    def _refuse_outside(self, q: Array) -> None:
        gap = self.gap(q).min(axis=tuple(range(q.ndim - 1)), initial=np.inf)
        if (gap < -OUTSIDE).any():
            k = int(gap.argmin())
            i = next(i for i, s in enumerate(self.model.q_slice) if s.start <= self.at_q[k] < s.stop)
            s = self.model.q_slice[i]
            lower, upper = (float(x[s.start]) for x in (self.model.lower, self.model.upper))
            raise ValueError(
                f"q: joint {self.model.joint_names[i]!r} begins {-gap[k]:.3g} beyond its range, "
                f"{lower:.6g} to {upper:.6g}, which time stepping keeps"
            )

    def rubbed(
        self, metric: Metric, free: Array, dt: float, solve: Callable[[Array, Array], tuple[Answer, Array]]
    ) -> Answer:
        """Return what `solve` finds with dry friction.

        `solve` takes the free velocity, and rows G with G v ≥ 0; it also returns the impulses along these. A joint that
        slides is braked by f, and may come to rest but not turn back; one that sticks is held both ways. Where the sum
        of its impulses is more than f, it slides the way it is pushed.
        """
        n, at = len(self.friction), self.friction
        if not n:
            return solve(free, np.zeros((0, len(free))))[0]
        most, slides = dt * self.model.friction[at], np.sign(free[at])
        for _ in range(CHANGES):
            rows = np.zeros((2 * n, len(free)))
            rows[np.arange(n), at] = np.where(slides >= 0, 1.0, 0.0)
            rows[n + np.arange(n), at] = np.where(slides <= 0, -1.0, 0.0)
            braking = np.zeros(len(free))
            braking[at] = -slides * most
            found, held = solve(free + metric.respond(braking), rows)
            total = -slides * most + held[:n] - held[n:]
            before, loose = slides, 1e-9 * most
            slides = np.where(total > most + loose, -1.0, np.where(total < -most - loose, 1.0, slides))
            if (slides == before).all():
                break
        return replace(found, total=found.total + braking)
