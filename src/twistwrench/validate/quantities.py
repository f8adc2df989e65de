"""All rows, in the order of the chapter."""

from __future__ import annotations

from .dynamics_rows import DYNAMICS
from .kinematics_rows import KINEMATICS
from .momentum_rows import MOMENTUM
from .quantity import ComparedQuantity

__all__ = ["QUANTITIES"]

QUANTITIES: tuple[ComparedQuantity, ...] = tuple(
    sorted((*KINEMATICS, *DYNAMICS, *MOMENTUM), key=lambda row: float(row.section.split(".")[1]))
)
