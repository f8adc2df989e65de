"""The rows of `validate` that `twistwrench.fast` has, computed by it and otherwise unchanged."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from .. import fast
from ..arrays import Array
from ..model import Model
from .quantities import QUANTITIES
from .states import States

__all__ = ["FAST"]

Ours = Callable[[Model, States], Array]

MIN_BATCH_STATES = 16
"""The least number of states in a batch: fewer would be computed one by one."""


def _both_ways(call: Ours) -> Ours:
    """Return a function that computes the first state alone, and the others in a batch."""

    def ours(model: Model, s: States) -> Array:
        repeated = s[np.resize(np.arange(len(s)), max(MIN_BATCH_STATES, len(s)))]
        out = call(model, repeated)[: len(s)].copy()
        out[0] = call(model, s[0])
        return out

    return ours


CALLS: dict[str, Ours] = {
    "step on the manifold": lambda m, s: fast.integrate(m, s.q, s.dv),
    "difference of two q": lambda m, s: fast.difference(m, s.q, fast.integrate(m, s.q, s.dv)),
    "inverse dynamics": lambda m, s: fast.rnea(m, s.q, s.v, s.a),
    "inverse dynamics, f_ext": lambda m, s: fast.rnea(m, s.q, s.v, s.a, s.f_ext),
    "forward dynamics": lambda m, s: fast.aba(m, s.q, s.v, s.tau),
    "forward dynamics, f_ext": lambda m, s: fast.aba(m, s.q, s.v, s.tau, s.f_ext),
    "mass matrix M": lambda m, s: fast.crba(m, s.q),
    "J_c of the feet": lambda m, s: np.asarray(fast.dynamics(m, s.q, s.v, want={"J_c"}).J_c),
    "h = C v + g": lambda m, s: fast.nonlinear_effects(m, s.q, s.v),
    "kinetic energy": lambda m, s: fast.kinetic_energy(m, s.q, s.v),
    "potential energy": lambda m, s: fast.potential_energy(m, s.q),
    "centre of mass": lambda m, s: fast.center_of_mass(m, s.q),
    "centroidal map A_G": lambda m, s: fast.centroidal_map(m, s.q),
}

FAST = tuple(replace(row, ours=_both_ways(CALLS[row.name])) for row in QUANTITIES if row.name in CALLS)
