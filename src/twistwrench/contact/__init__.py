"""Contact dynamics: constraints, friction and the stability of a stance (49.9).

In the order in which the files are best read: `types` (what a contact is), `kinds` (points, soles, slides), `spheres`,
`wheels` and `closures` (loops and gears), `relative` (J and J̇ v), `decomposition` (the rank), `rows`, `forward`,
`impacts`, `projection`; `task`, `inverse`, its `limits` and its `qp` (friction), `nonnegative` least squares, `reach`
(whether forces within the limits are enough, and the proof), `stance` (slipping and tipping).
"""

from .closures import Coupling, DistanceConstraint, LoopClosure
from .forward import Baumgarte, ContactDynamics, contact_forward_dynamics
from .impacts import Impact, impact
from .inverse import contact_inverse_dynamics, friction_inverse_dynamics
from .kinds import PointContact, SlidingContact, SurfaceContact
from .projection import project_state
from .rows import constraint_bias, constraint_jacobian, contact_placements
from .spheres import SphereContact
from .stance import StanceMargins, stance_margins
from .task import ContactForces
from .types import Contact
from .wheels import WheelContact

__all__ = [
    "Baumgarte",
    "Contact",
    "ContactDynamics",
    "ContactForces",
    "Coupling",
    "DistanceConstraint",
    "Impact",
    "LoopClosure",
    "PointContact",
    "SlidingContact",
    "SphereContact",
    "StanceMargins",
    "SurfaceContact",
    "WheelContact",
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
