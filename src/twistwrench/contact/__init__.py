"""Contact dynamics: constraints, friction and the stability of a stance (49.9).

In the order in which the files are best read: `types` (points and soles), `rows` (J and J̇ v), `decomposition` (the
rank), `forward`, `impacts`, `projection`; `inverse`, its `limits` and its `qp` (friction), `nonnegative` least squares,
`reach` (whether forces within the limits are enough, and the proof), `stance` (slipping and tipping).
"""

from .forward import Baumgarte, ContactDynamics, contact_forward_dynamics
from .impacts import Impact, impact
from .inverse import ContactForces, contact_inverse_dynamics, friction_inverse_dynamics
from .projection import project_state
from .rows import constraint_bias, constraint_jacobian, contact_placements
from .stance import StanceMargins, stance_margins
from .types import Contact, PointContact, SurfaceContact

__all__ = [
    "Baumgarte",
    "Contact",
    "ContactDynamics",
    "ContactForces",
    "Impact",
    "PointContact",
    "StanceMargins",
    "SurfaceContact",
    "constraint_bias",
    "constraint_jacobian",
    "contact_forward_dynamics",
    "contact_inverse_dynamics",
    "contact_placements",
    "friction_inverse_dynamics",
    "impact",
    "project_state",
    "stance_margins",
]
