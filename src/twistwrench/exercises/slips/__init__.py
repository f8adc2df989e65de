"""The catalogue of slips, and helpers that make wrong implementations out of right ones."""

from .algebra import ALGEBRA
from .bodies import BODIES
from .contact import CONTACT
from .dynamics import DYNAMICS
from .floating import FLOATING
from .inertia import INERTIA
from .measuring import MEASURING
from .order import ORDER
from .pipeline import PIPELINE
from .recursion import RECURSION
from .slip import Slip

__all__ = ["SLIPS", "Slip"]

SLIPS: dict[str, Slip] = {
    **ORDER,
    **ALGEBRA,
    **CONTACT,
    **INERTIA,
    **BODIES,
    **DYNAMICS,
    **RECURSION,
    **MEASURING,
    **FLOATING,
    **PIPELINE,
}
"""Every slip by its key. An exercise maps the keys that can occur in it to wrong implementations."""
