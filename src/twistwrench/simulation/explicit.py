"""Explicit methods on the configuration manifold: Euler's two, and Runge-Kutta by Munthe-Kaas."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import Array
from .system import System
from .tangent import rate

__all__ = ["EULER", "MIDPOINT", "RK4", "Tableau", "runge_kutta", "semi_implicit"]

Tableau = tuple[Sequence[float], Sequence[Sequence[float]], Sequence[float]]
"""Butcher's: nodes c, rows of coefficients a, weights b."""

EULER: Tableau = ((0.0,), ((),), (1.0,))
MIDPOINT: Tableau = ((0.0, 1 / 2), ((), (1 / 2,)), (0.0, 1.0))
RK4: Tableau = ((0.0, 1 / 2, 1 / 2, 1.0), ((), (1 / 2,), (0.0, 1 / 2), (0.0, 0.0, 1.0)), (1 / 6, 1 / 3, 1 / 3, 1 / 6))


def runge_kutta(tableau: Tableau, system: System, t: float, q: Array, v: Array) -> tuple[Array, Array]:
    """Make one step of an explicit Runge-Kutta method, up to order 4, for u in q ⊕ u and for v.

    H. Munthe-Kaas, High order Runge-Kutta methods on manifolds, 1999: u can be added, so that the method keeps its
    order, and q ⊕ u never leaves the manifold.
    """
    (nodes, rows, weights), dt = tableau, v.dtype.type(system.dt)
    u_rates: list[Array] = []
    v_rates: list[Array] = []
    for c, row in zip(nodes, rows):
        u, v_stage = dt * weighted(row, u_rates, v), v + dt * weighted(row, v_rates, v)
        q_stage = system.integrate(q, u) if row else q
        v_rates.append(system.acceleration(t + c * system.dt, q_stage, v_stage))
        u_rates.append(rate(system.model, u, v_stage))  # u̇, not v
    return system.integrate(q, dt * weighted(weights, u_rates, v)), v + dt * weighted(weights, v_rates, v)


def weighted(weights: Sequence[float], terms: Sequence[Array], like: Array) -> Array:
    """Return Σ w x, and zeros like another array where there is nothing to add."""
    return sum((like.dtype.type(w) * x for w, x in zip(weights, terms) if w), np.zeros_like(like))


def semi_implicit(system: System, t: float, q: Array, v: Array) -> tuple[Array, Array]:
    """Make one step of the semi-implicit Euler method: the new velocity first, and q along it."""
    dt = v.dtype.type(system.dt)
    v = v + dt * system.acceleration(t, q, v)
    return system.integrate(q, dt * v), v
