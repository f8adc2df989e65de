"""How a body turns whose orientation is R = exp3(φ(t)): ω and ω̇ from φ and its derivatives.

ω = J φ̇ in the body's axes, with J = 1 − B [φ]× + C [φ]×², B = (1 − cos θ)/θ², C = (θ − sin θ)/θ³ and θ = |φ|.
B and C are even, so that they are power series in θ².
"""

from __future__ import annotations

import math

import numpy as np

from ..arrays import Array
from ..spatial import skew

__all__ = ["body_rates", "turning_jacobian"]

TERMS = 14
"""Of the series: enough for turns of up to 3 rad."""
B = np.polynomial.Polynomial([(-1) ** k / math.factorial(2 * k + 2) for k in range(TERMS)])
C = np.polynomial.Polynomial([(-1) ** k / math.factorial(2 * k + 3) for k in range(TERMS)])


def turning_jacobian(phi: Array) -> Array:
    """Return J, which takes φ̇ to the angular velocity in the body's axes, shape (..., 3, 3)."""
    square, K = (phi * phi).sum(-1)[..., None, None], skew(phi)
    return np.asarray(np.eye(3) - B(square) * K + C(square) * K @ K)


def body_rates(jet: Array) -> Array:
    """Return ω and ω̇ in the body's axes from the jet of φ, shape (2, ..., 3)."""
    phi, rate, second = jet
    square, growth = (phi * phi).sum(-1)[..., None], 2 * (phi * rate).sum(-1)[..., None]
    first = np.cross(phi, rate)
    w_dot = (
        np.matvec(turning_jacobian(phi), second)
        - B.deriv()(square) * growth * first
        + C.deriv()(square) * growth * np.cross(phi, first)
        + C(square) * np.cross(rate, first)
    )
    return np.stack([np.matvec(turning_jacobian(phi), rate), w_dot])
