"""The public names, and the file that holds each; a file is loaded when the first of its names is used."""

from . import bridge, exercises, fast, motions, newton_euler_3d, plot, templates
from . import contact as contact
from . import loading as loading
from . import model as model
from . import scene as scene
from . import simulation as simulation
from . import validate as validate
from .advice import advise
from .algorithms.aba import aba, aba_terms
from .algorithms.articulated import articulated_inertia
from .algorithms.centroidal import (
    center_of_mass,
    centroidal_map,
    centroidal_momentum,
    centroidal_momentum_rate,
    centroidal_terms,
)
from .algorithms.coriolis import coriolis_matrix
from .algorithms.crba import crba, crba_terms
from .algorithms.delassus import delassus_matrix, operational_space_inertia
from .algorithms.energy import kinetic_energy, potential_energy
from .algorithms.factorization import ltdl, ltl, solve_mass_matrix
from .algorithms.floating_base import contact_jacobian, selection_matrix, static_equilibrium
from .algorithms.frame_wrench import frame_wrench
from .algorithms.inverse_mass import inverse_mass_matrix
from .algorithms.kinematics import forward_kinematics, frame_bias_acceleration, frame_jacobian, frame_placement
from .algorithms.mimic import MimicModel
from .algorithms.momentum_rate import (
    center_of_mass_acceleration,
    center_of_mass_jacobian,
    center_of_mass_velocity,
    centroidal_inertia,
    centroidal_map_rate,
)
from .algorithms.points import point_acceleration, point_jacobian, point_velocity
from .algorithms.rnea import gravity, joint_wrenches, nonlinear_effects, rnea, rnea_terms
from .algorithms.subtree import subtree
from .algorithms.whole_body import Dynamics, dynamics
from .contact import (
    Baumgarte,
    Contact,
    Coupling,
    DistanceConstraint,
    LoopClosure,
    PointContact,
    SlidingContact,
    SphereContact,
    SurfaceContact,
    WheelContact,
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
from .error_bounds import accuracy
from .errors import FrameError, ModelError, NameNotFound, ShapeError, SingularError
from .exercises.asking import ask
from .fast.compilation import compile
from .identification import base_parameters
from .loading import load, robots
from .model.builder import Builder
from .model.editing import attach, replace_inertia
from .model.joints import Continuous, FreeFlyer, Helical, Planar, Prismatic, Revolute, Spherical
from .model.model import Model
from .model.reduction import lock_joints
from .model.rerooting import reroot
from .model.samples import chain, random_tree
from .model.serial import from_dh, from_screw_axes, screw_axes
from .scene import Scene
from .simulation import DivergenceError, Ground, simulate
from .simulation.growth import motion_error
from .spatial.cross import cross_force, cross_motion
from .spatial.exponential import exp6, interpolate, log6
from .spatial.inertia import SpatialInertia
from .spatial.jacobians import Jexp3, Jexp6, Jlog3, Jlog6
from .spatial.orthonormal import nearest_rotation
from .spatial.plucker import SE3, force_transform, motion_transform
from .spatial.rotation import exp3, log3, skew, unskew
from .spatial.twist import Screw, Twist, hat, screw, vee
from .spatial.wrench import Wrench, center_of_pressure, power
from .tracing import trace
from .viewing import view

__version__: str

__all__ = [
    "SE3",
    "Baumgarte",
    "Builder",
    "Contact",
    "Continuous",
    "Coupling",
    "DistanceConstraint",
    "DivergenceError",
    "Dynamics",
    "FrameError",
    "FreeFlyer",
    "Ground",
    "Helical",
    "Jexp3",
    "Jexp6",
    "Jlog3",
    "Jlog6",
    "LoopClosure",
    "MimicModel",
    "Model",
    "ModelError",
    "NameNotFound",
    "Planar",
    "PointContact",
    "Prismatic",
    "Revolute",
    "Scene",
    "Screw",
    "ShapeError",
    "SingularError",
    "SlidingContact",
    "SpatialInertia",
    "SphereContact",
    "Spherical",
    "SurfaceContact",
    "Twist",
    "WheelContact",
    "Wrench",
    "aba",
    "aba_terms",
    "accuracy",
    "advise",
    "articulated_inertia",
    "ask",
    "attach",
    "base_parameters",
    "bridge",
    "center_of_mass",
    "center_of_mass_acceleration",
    "center_of_mass_jacobian",
    "center_of_mass_velocity",
    "center_of_pressure",
    "centroidal_inertia",
    "centroidal_map",
    "centroidal_map_rate",
    "centroidal_momentum",
    "centroidal_momentum_rate",
    "centroidal_terms",
    "chain",
    "compile",
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
    "delassus_matrix",
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
    "frame_wrench",
    "friction_inverse_dynamics",
    "from_dh",
    "from_screw_axes",
    "gravity",
    "hat",
    "impact",
    "interpolate",
    "inverse_mass_matrix",
    "joint_wrenches",
    "kinetic_energy",
    "load",
    "lock_joints",
    "log3",
    "log6",
    "ltdl",
    "ltl",
    "motion_error",
    "motion_transform",
    "motions",
    "nearest_rotation",
    "newton_euler_3d",
    "nonlinear_effects",
    "operational_space_inertia",
    "plot",
    "point_acceleration",
    "point_jacobian",
    "point_velocity",
    "potential_energy",
    "power",
    "project_state",
    "random_tree",
    "replace_inertia",
    "reroot",
    "rnea",
    "rnea_terms",
    "robots",
    "screw",
    "screw_axes",
    "selection_matrix",
    "simulate",
    "skew",
    "solve_mass_matrix",
    "stance_margins",
    "static_equilibrium",
    "subtree",
    "templates",
    "trace",
    "unskew",
    "vee",
    "view",
]
