"""Rigid-body dynamics with 3-D vectors only: the slow, obvious way (49.1)."""

from .dynamics import (
    coriolis_matrix,
    forward_dynamics,
    gravity,
    inverse_dynamics,
    joint_wrenches,
    mass_matrix,
    nonlinear_effects,
)
from .kinematics import (
    Motion,
    body_accelerations,
    body_twists,
    frame_bias_acceleration,
    frame_jacobian,
    frame_placement,
    motion,
    placements,
)
from .momentum import (
    center_of_mass,
    centroidal_map,
    centroidal_momentum,
    centroidal_momentum_rate,
    kinetic_energy,
    potential_energy,
)

__all__ = [
    "Motion",
    "body_accelerations",
    "body_twists",
    "center_of_mass",
    "centroidal_map",
    "centroidal_momentum",
    "centroidal_momentum_rate",
    "coriolis_matrix",
    "forward_dynamics",
    "frame_bias_acceleration",
    "frame_jacobian",
    "frame_placement",
    "gravity",
    "inverse_dynamics",
    "joint_wrenches",
    "kinetic_energy",
    "mass_matrix",
    "motion",
    "nonlinear_effects",
    "placements",
    "potential_energy",
]
