"""ḣ_G of a robot whose base does not float: held, or on the floor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..algorithms.centroidal import center_of_mass, centroidal_momentum_rate
from ..algorithms.kinematics import forward_kinematics
from ..algorithms.rnea import rnea
from ..arrays import Array
from ..model import Model

__all__ = ["Anchored", "radius_of_gyration"]


@dataclass(frozen=True, eq=False)
class Anchored:
    """A model of any base that predicts the rate of its momentum about given points, and its torques with it.

    The points are the centres of mass of the whole robot: a body that is held to the world has no part in those of
    the model.
    """

    model: Model
    about: Array
    """Shape (n, 3), in the world, m."""

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return the whole state."""
        return q, v, a

    def law(self, *known: Array) -> Array:
        """Return (k̇, l̇) about the points, in the axes of the world; the torques are computed on the way."""
        q, v, a = known
        rnea(self.model, q, v, a)
        rate = centroidal_momentum_rate(self.model, q, v, a)
        arm = center_of_mass(self.model, q) - self.about
        return np.concatenate([rate[..., :3] + np.cross(arm, rate[..., 3:]), rate[..., 3:]], axis=-1)


def radius_of_gyration(model: Model, q: Array) -> float:
    """Return √(trace I_G / 2 m) of a robot with its joints locked in one configuration, m."""
    G, squares = center_of_mass(model, q), 0.0
    for T, inertia in list(zip(forward_kinematics(model, q).placement, model.inertia))[1:]:
        arm = T.translation + T.rotation @ inertia.com - G
        squares += float(inertia.mass * (arm @ arm) + np.trace(inertia.inertia_at_com) / 2)
    return float(np.sqrt(squares / model.mass))
