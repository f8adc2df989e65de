"""The public names: what `twistwrench` offers, and the section that holds each."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from . import bridge, fast, newton_euler_3d
from .builder import Builder
from .centroidal import center_of_mass, centroidal_map, centroidal_momentum, centroidal_momentum_rate, centroidal_terms
from .contact import (
    Baumgarte,
    ContactDynamics,
    ContactForces,
    Impact,
    PointContact,
    StanceMargins,
    SurfaceContact,
    constraint_bias,
    constraint_jacobian,
    contact_forward_dynamics,
    contact_inverse_dynamics,
    contact_placements,
    friction_inverse_dynamics,
    impact,
    project_state,
    stance_margins,
)
from .coriolis import coriolis_matrix
from .cross import cross_force, cross_motion
from .digits import Accuracy, accuracy
from .energy import kinetic_energy, potential_energy
from .errors import FrameError, ModelError, NameNotFound, ShapeError, SingularError
from .exponential import exp6, log6
from .floating_base import Equilibrium, contact_jacobian, selection_matrix, static_equilibrium
from .forward_dynamics import aba, aba_terms
from .inertia import SpatialInertia
from .inverse_dynamics import gravity, joint_wrenches, nonlinear_effects, rnea, rnea_terms
from .joint_types import Continuous, FreeFlyer, Helical, Planar, Prismatic, Revolute, Spherical
from .kinematics import forward_kinematics, frame_bias_acceleration, frame_jacobian, frame_placement
from .mass_matrix import crba, crba_terms
from .mimic import MimicModel
from .model import Model
from .orthonormal import nearest_rotation
from .plucker import SE3, force_transform, motion_transform
from .reduction import Reduction, lock_joints
from .robots import load, robots
from .rotation import exp3, log3, skew, unskew
from .scene import Scene
from .simulation import DivergenceError, Simulation, simulate
from .tracing import Trace, trace
from .trees import chain, random_tree
from .twist import Screw, Twist, hat, screw, vee
from .viewing import view
from .whole_body import Dynamics, dynamics
from .wrench import Wrench, power

if TYPE_CHECKING:
    from . import exercises, motions, plot, templates

__all__ = [
    "SE3",
    "Accuracy",
    "Baumgarte",
    "Builder",
    "ContactDynamics",
    "ContactForces",
    "Continuous",
    "DivergenceError",
    "Dynamics",
    "Equilibrium",
    "FrameError",
    "FreeFlyer",
    "Helical",
    "Impact",
    "MimicModel",
    "Model",
    "ModelError",
    "NameNotFound",
    "Planar",
    "PointContact",
    "Prismatic",
    "Reduction",
    "Revolute",
    "Scene",
    "Screw",
    "ShapeError",
    "Simulation",
    "SingularError",
    "SpatialInertia",
    "Spherical",
    "StanceMargins",
    "SurfaceContact",
    "Trace",
    "Twist",
    "Wrench",
    "aba",
    "aba_terms",
    "accuracy",
    "bridge",
    "center_of_mass",
    "centroidal_map",
    "centroidal_momentum",
    "centroidal_momentum_rate",
    "centroidal_terms",
    "chain",
    "constraint_bias",
    "constraint_jacobian",
    "contact_forward_dynamics",
    "contact_inverse_dynamics",
    "contact_jacobian",
    "contact_placements",
    "coriolis_matrix",
    "crba",
    "crba_terms",
    "cross_force",
    "cross_motion",
    "dynamics",
    "exercises",
    "exp3",
    "exp6",
    "fast",
    "force_transform",
    "forward_kinematics",
    "frame_bias_acceleration",
    "frame_jacobian",
    "frame_placement",
    "friction_inverse_dynamics",
    "gravity",
    "hat",
    "impact",
    "joint_wrenches",
    "kinetic_energy",
    "load",
    "lock_joints",
    "log3",
    "log6",
    "motion_transform",
    "motions",
    "nearest_rotation",
    "newton_euler_3d",
    "nonlinear_effects",
    "plot",
    "potential_energy",
    "power",
    "project_state",
    "random_tree",
    "rnea",
    "rnea_terms",
    "robots",
    "screw",
    "selection_matrix",
    "simulate",
    "skew",
    "stance_margins",
    "static_equilibrium",
    "templates",
    "trace",
    "unskew",
    "vee",
    "view",
]


def __getattr__(name: str) -> Any:
    if name not in (
        "exercises",
        "motions",
        "plot",
        "templates",
    ):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return import_module(f".{name}", __package__)
