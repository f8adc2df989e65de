"""Centre of mass, momentum about it, energies (49.5, 49.10)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..checks import Array
from ..errors import SingularError
from .arithmetic import Arithmetic, take
from .bodies import Body, cross, walk

__all__ = [
    "center_of_mass",
    "centroidal_map",
    "centroidal_momentum",
    "centroidal_momentum_rate",
    "kinetic_energy",
    "potential_energy",
]


def center_of_mass(model: Any, q: ArrayLike) -> Array:
    """Return the position of the centre of mass."""
    number, q, rest = take(model, q=q, v=None)
    return _center(walk(number, model, q, rest, rest)[1:])


def centroidal_momentum(model: Any, q: ArrayLike, v: ArrayLike) -> Array:
    """Return h_G = (k, l)."""
    number, q, v, rest = take(model, q=q, v=v, a=None)
    bodies = walk(number, model, q, v, rest)[1:]
    center, k, l = _center(bodies), number.zeros(3), number.zeros(3)
    for b in bodies:
        l = l + b.mass * b.com_velocity
        k = k + b.inertia @ b.omega + cross(b.com - center, b.mass * b.com_velocity)  # lever arm
    return np.concatenate([k, l])


def centroidal_momentum_rate(model: Any, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Array:
    """Return ḣ_G = A_G a + Ȧ_G v."""
    number, q, v, a = take(model, q=q, v=v, a=a)
    bodies = walk(number, model, q, v, a)[1:]
    center, k, l = _center(bodies), number.zeros(3), number.zeros(3)
    for b in bodies:
        l = l + b.mass * b.com_acceleration
        k = k + b.inertia @ b.alpha + cross(b.omega, b.inertia @ b.omega)  # Euler
        k = k + cross(b.com - center, b.mass * b.com_acceleration)  # lever arm
    return np.concatenate([k, l])


def centroidal_map(model: Any, q: ArrayLike) -> Array:
    """Return A_G, (6, nv)."""
    number, q, rest = take(model, q=q, v=None)
    bodies = walk(number, model, q, rest, rest)[1:]
    center, A = _center(bodies), number.zeros(6, model.nv)
    for b in bodies:
        Jw, Jv = b.jacobian(b.com)
        A[:3, b.index] += b.inertia @ Jw + cross((b.com - center)[:, None], b.mass * Jv)
        A[3:, b.index] += b.mass * Jv
    return A


def kinetic_energy(model: Any, q: ArrayLike, v: ArrayLike) -> Any:
    """Return T."""
    number, q, v, rest = take(model, q=q, v=v, a=None)
    T = (number.array(model.armature) * v * v).sum() / 2
    for b in walk(number, model, q, v, rest)[1:]:
        T = T + (b.mass * (b.com_velocity @ b.com_velocity) + b.omega @ b.inertia @ b.omega) / 2
    return T


def potential_energy(model: Any, q: ArrayLike) -> Any:
    """Return V."""
    number, q, rest = take(model, q=q, v=None)
    weight = [b.mass * (number.array(model.gravity) @ b.com) for b in walk(number, model, q, rest, rest)[1:]]
    return -sum(weight)


def _center(bodies: list[Body]) -> Array:
    mass = sum(b.mass for b in bodies)
    if mass == 0:
        raise SingularError("no centre of mass: the moving bodies have no mass")
    return sum(b.mass * b.com for b in bodies) / mass
