"""The catalogue of slips, and helpers that make wrong implementations out of right ones."""

from .algebra import ALGEBRA
from .dynamics import DYNAMICS
from .inertia import INERTIA
from .order import ORDER
from .slip import Slip

__all__ = ["SLIPS", "Slip"]

SLIPS: dict[str, Slip] = {**ORDER, **ALGEBRA, **INERTIA, **DYNAMICS}
"""Every slip by its key. An exercise maps the keys that can occur in it to wrong implementations."""
