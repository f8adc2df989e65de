"""Constant matrices that make twists and momenta of products of coordinates, for one state."""

from __future__ import annotations

import numpy as np

from ..arrays import Array
from .vectors import CYCLE

__all__ = ["MOMENTUM", "TURN", "TWISTS"]


def _of_products() -> tuple[Array, Array, Array]:
    """Return `TURN`, `SLIDE` and `MOMENTUM`."""
    turn, slide = np.zeros((4, 3, 4, 4)), np.zeros((4, 3, 4, 4))
    for i, j, k in CYCLE:
        turn[3, k, j, i], turn[3, k, i, j] = 1, -1  # z×
        turn[j, k, i, 3], turn[k, j, i, 3] = 1, -1  # p × z
        slide[3, i, i, 3] = 1
    momentum = np.zeros((6, 6, 3, 3, 4))
    for row in range(3):
        for i, j, k in CYCLE:
            momentum[row, i, row, i, 3] = momentum[3 + row, 3 + i, row, i, 3] = 1  # R
            momentum[row, 3 + j, row, i, k], momentum[row, 3 + i, row, j, k] = 1, -1  # −R c×
    return turn.reshape(12, 16), slide.reshape(12, 16), momentum.reshape(36, 36)


TURN, SLIDE, MOMENTUM = _of_products()
TWISTS = np.concatenate([TURN[9:], SLIDE[9:]])
"""From the products of p̄ = (p, 1) and z to the Ŝ of a turn about z through p, and to that of a slide along z; and from
those of R and c̄ = (c, 1) to the 6 × 6 matrix that takes a momentum to the point c and to the axes of the world. Last
the Ŝ of turns about, and slides along, the axes of the base."""
