"""Whether a rigid body with a given mass and inertia can exist (section 49.5)."""

from __future__ import annotations

import numpy as np

from ..arrays import Array, comparable, tolerance
from ..errors import ModelError
from ._elementary import at_first_index, largest

__all__ = ["check_not_negative", "check_numbers", "check_physical"]

# Relative room for rounding: a thin rod (0, I, I) and a thin plate (I, I, 2I) are limits, and pass.
MOMENT_RTOL = 1e-9


def check_numbers(mass: Array, inertia_at_com: Array) -> None:
    """Raise ModelError where a mass is negative, or an inertia not symmetric."""
    wrong = np.asarray(comparable(mass) < 0)
    if wrong.any():
        got = f"{comparable(mass)[wrong][0]:.6g} kg{at_first_index(wrong)}"
        raise ModelError(f"mass: expected no negative mass, got {got}")
    off = largest(comparable(inertia_at_com - inertia_at_com.mT), 2)
    wrong = off > tolerance(inertia_at_com.dtype) * largest(comparable(inertia_at_com), 2)
    if wrong.any():
        raise ModelError(
            f"inertia_at_com: expected a symmetric matrix, got |I − Iᵀ| = {off[wrong][0]:.3g} kg m²"
            + at_first_index(wrong)
        )


def check_physical(link: str, mass: Array, com: Array, inertia_at_com: Array) -> None:
    """Raise ModelError, with the link, the condition and its numbers, unless a body with this inertia can exist."""
    mass = comparable(mass)
    if (mass <= 0).any():
        raise ModelError(f"link {link!r}: the mass must be positive, got {mass.min():.6g} kg")
    moments = check_not_negative(link, mass, com, inertia_at_com)
    a, b, c = np.moveaxis(moments, -1, 0)
    excess = np.asarray(c - (a + b))
    broken = excess > MOMENT_RTOL * (a + b) + _rounding(mass, com)
    if broken.any():
        much = excess[broken][0]
        raise ModelError(
            f"link {link!r}: the largest principal moment must not exceed the sum of the other two (triangle "
            f"inequality), got {_numbers(moments[broken][0])} kg m², {much:.3g} too much"
        )


def check_not_negative(link: str, mass: Array, com: Array, inertia_at_com: Array) -> Array:
    """Return the principal moments; raise ModelError where one of them is negative. All are zero for a point mass."""
    # NumPy has eigenvalues in single and double precision only: double is enough to judge by.
    moments: Array = np.linalg.eigvalsh(comparable(inertia_at_com).astype(np.float64))
    negative = moments[..., 0] < -MOMENT_RTOL * np.abs(moments[..., 2]) - _rounding(comparable(mass), com)
    if negative.any():
        raise ModelError(
            f"link {link!r}: the inertia about the centre of mass must be positive definite, "
            f"got principal moments {_numbers(moments[negative][0])} kg m²"
        )
    return moments


def _rounding(mass: Array, com: Array) -> Array:
    """Return what rounding leaves of an inertia of zero that was computed from that about the body's frame."""
    room: Array = 4 * np.finfo(np.float64).eps * mass * (comparable(com) ** 2).sum(-1)
    return room


def _numbers(moments: Array) -> str:
    return ", ".join(f"{x:.6g}" for x in moments)
