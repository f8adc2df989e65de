"""Contact dynamics: constraints, friction and the stability of a stance (49.9).

In the order in which the files are best read, each of which imports from earlier ones only: `relative` (how a frame
moves in what holds it), `types` (what a contact is, and its rows of J), `kinds` (points, soles, slides, balls,
wheels), `closures` (loops and gears); `decomposition` (the rank), `rows` (J and J̇ v of many contacts), `elimination`
(the contact equations solved without a test of rank), `programs` (what is compiled of them, and its derivatives),
`calls` (a program that is found again at once), `forward` (accelerations, impacts, drift); `qp` (least forces within
limits), `task` (the wrench that contacts must exert, their limits, and the proof that these allow it or not),
`inverse` (the forces of a motion), `stance` (slipping and tipping).
"""

from .closures import Coupling, DistanceConstraint, LoopClosure
from .forward import Baumgarte, ContactDynamics, Impact, contact_forward_dynamics, impact, project_state
from .inverse import contact_inverse_dynamics, friction_inverse_dynamics
from .kinds import PointContact, SlidingContact, SphereContact, SurfaceContact, WheelContact
from .rows import constraint_bias, constraint_jacobian, contact_placements
from .stance import StanceMargins, stance_margins
from .task import ContactForces
from .types import Contact

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
