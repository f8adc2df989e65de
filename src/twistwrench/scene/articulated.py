"""ḣ_G and τ of a robot on any base: floating, held, or on the floor."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..algorithms.centroidal import center_of_mass, centroidal_momentum_rate
from ..algorithms.kinematics import forward_kinematics
from ..algorithms.rnea import rnea
from ..arrays import Array
from ..model import Model
from ..templates.template import full_rate

__all__ = ["Articulated", "radius_of_gyration"]

Reduce = Callable[[Array, Array], tuple[Array, Array]]


@dataclass(frozen=True, eq=False)
class Articulated:
    """A model with joints, in place of the whole robot: it predicts ḣ_G, and the torques of the joints it has.

    A body that is held to the world has no part in the momentum of the model; so ḣ_G is about the centre of mass of the
    whole robot, which a model whose base does not float must be given.
    """

    full: Model
    model: Model
    reduce: Reduce
    """From a state of the whole robot to one of the model."""
    kept: Array
    """The entries of the whole robot's τ that it has, and where they are in its own: shape (2, k)."""

    @classmethod
    def of(cls, full: Model, model: Model, reduce: Reduce) -> Articulated:
        """Return a model in place of the whole robot; joints of one name and size are the same."""
        there = dict(zip(full.joint_names, full.v_slice))
        both = [(there[name], s) for name, s in zip(model.joint_names[1:], model.v_slice[1:]) if name in there]
        same = [(s, t) for s, t in both if s.stop - s.start == t.stop - t.start]  # not the base, where it is another
        pairs = [pair for s, t in same for pair in zip(range(full.nv)[s], range(model.nv)[t])]
        return cls(full, model, reduce, np.array(pairs, int).reshape(-1, 2).mT)

    def read(self, q: Array, v: Array, a: Array) -> tuple[Array, ...]:
        """Return the model's state, and where it does not float the centre of mass of the whole robot."""
        known = (*self.reduce(q, v), self.reduce(q, a)[1])
        return known if self.model.base == "floating" else (*known, center_of_mass(self.full, q))

    def law(self, *known: Array) -> tuple[Array, Array]:
        """Return ḣ_G = (k̇, l̇), shape (..., 6), and τ without contact forces, shape (..., k)."""
        q, v, a, *about = known
        tau = rnea(self.model, q, v, a)[..., self.kept[1]]
        if not about:
            return full_rate(self.model, q, v, a), tau
        rate = centroidal_momentum_rate(self.model, q, v, a)
        moment = rate[..., :3] + np.cross(center_of_mass(self.model, q) - about[0], rate[..., 3:])
        return np.concatenate([moment, rate[..., 3:]], axis=-1), tau


def radius_of_gyration(model: Model, q: Array) -> float:
    """Return √(trace I_G / 2 m) of a robot with its joints locked in one configuration, m."""
    G, squares = center_of_mass(model, q), 0.0
    for T, inertia in list(zip(forward_kinematics(model, q).placement, model.inertia))[1:]:
        arm = T.translation + T.rotation @ inertia.com - G
        squares += float(inertia.mass * (arm @ arm) + np.trace(inertia.inertia_at_com) / 2)
    return float(np.sqrt(squares / model.mass))
