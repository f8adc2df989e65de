"""The bridge to Pinocchio and MuJoCo: the only place where (ω, v) and (v, ω) change places (section 49.11).

Pinocchio writes a twist as (v, ω) and a wrench as (f, τ); here it is (ω, v) and (τ, f) throughout.
The consequences, and where to find them:

=====================================  ===================================  ========================
quantity                               shape                                ``to_pinocchio_…``
=====================================  ===================================  ========================
twist, spatial acceleration            (..., 6)                             ``motion``
wrench, momentum (``data.hg``)         (..., 6)                             ``force``
v, a, τ, h, g                          (..., nv)                            ``tangent``
frame Jacobian, A_G                    (..., 6, nv)                         ``jacobian``
J_c, selection matrix                  (..., k, nv)                         ``contact_jacobian``
M, C, M⁻¹                              (..., nv, nv)                        ``matrix``
X, X*, V×, V×*, spatial inertia        (..., 6, 6)                          ``transform``
placement                              `SE3`, ``pin.SE3``                   ``se3``
inertia                                `SpatialInertia`, ``pin.Inertia``    ``inertia``
external wrenches                      (nbodies, 6), ``pin.StdVec_Force``   ``f_ext``
model                                  `Model`, ``pin.Model``               ``model``
=====================================  ===================================  ========================

Each has its ``from_pinocchio_…``. q is the same on both sides, entry for entry, and so are the joint
ids, τ of a joint with one degree of freedom, the centre of mass and the energies: none is converted.
The functions on arrays do not need Pinocchio.

From MuJoCo come models (`from_mujoco_model`) and, both ways, states: ``from_mujoco_configuration`` for q, and
``from_mujoco_tangent`` for v and forces, of which only free and ball joints differ; ``from_mujoco_acceleration`` for q̈,
in which MuJoCo has an ω × v that ours does not.
"""

from .model import from_pinocchio_model, to_pinocchio_model
from .mujoco import from_mujoco_model
from .mujoco_states import (
    from_mujoco_acceleration,
    from_mujoco_configuration,
    from_mujoco_tangent,
    to_mujoco_acceleration,
    to_mujoco_configuration,
    to_mujoco_tangent,
)
from .objects import (
    from_pinocchio_f_ext,
    from_pinocchio_inertia,
    from_pinocchio_se3,
    import_pinocchio,
    to_pinocchio_f_ext,
    to_pinocchio_inertia,
    to_pinocchio_se3,
)
from .spatial import (
    from_pinocchio_force,
    from_pinocchio_motion,
    from_pinocchio_transform,
    to_pinocchio_force,
    to_pinocchio_motion,
    to_pinocchio_transform,
)
from .tangent import (
    from_pinocchio_contact_jacobian,
    from_pinocchio_jacobian,
    from_pinocchio_matrix,
    from_pinocchio_tangent,
    to_pinocchio_contact_jacobian,
    to_pinocchio_jacobian,
    to_pinocchio_matrix,
    to_pinocchio_tangent,
)

__all__ = [
    "from_mujoco_acceleration",
    "from_mujoco_configuration",
    "from_mujoco_model",
    "from_mujoco_tangent",
    "from_pinocchio_contact_jacobian",
    "from_pinocchio_f_ext",
    "from_pinocchio_force",
    "from_pinocchio_inertia",
    "from_pinocchio_jacobian",
    "from_pinocchio_matrix",
    "from_pinocchio_model",
    "from_pinocchio_motion",
    "from_pinocchio_se3",
    "from_pinocchio_tangent",
    "from_pinocchio_transform",
    "import_pinocchio",
    "to_mujoco_acceleration",
    "to_mujoco_configuration",
    "to_mujoco_tangent",
    "to_pinocchio_contact_jacobian",
    "to_pinocchio_f_ext",
    "to_pinocchio_force",
    "to_pinocchio_inertia",
    "to_pinocchio_jacobian",
    "to_pinocchio_matrix",
    "to_pinocchio_model",
    "to_pinocchio_motion",
    "to_pinocchio_se3",
    "to_pinocchio_tangent",
    "to_pinocchio_transform",
]
