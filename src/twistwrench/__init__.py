"""Spatial vector algebra and floating-base dynamics, to be read beside the chapter it follows.

Every 6-D quantity is (angular, linear): twists (ω, v), wrenches (τ, f). Arrays in, arrays out, with
any number of leading batch axes; float32, float64, longdouble and their complex twins are kept.
"""
from . import newton_euler_3d
from .builder import Builder
from .centroidal import center_of_mass, centroidal_map, centroidal_momentum, centroidal_momentum_rate
from .coriolis import coriolis_matrix
from .energy import kinetic_energy, potential_energy
from .errors import FrameError, ModelError, NameNotFound, ShapeError, SingularError
from .exponential import exp6, log6
from .floating_base import (
    Dynamics,
    Equilibrium,
    contact_jacobian,
    dynamics,
    selection_matrix,
    static_equilibrium,
)
from .forward_dynamics import aba
from .inertia import SpatialInertia, cross_force, cross_motion
from .inverse_dynamics import gravity, joint_wrenches, nonlinear_effects, rnea
from .joint import Continuous, FreeFlyer, Planar, Prismatic, Revolute, Spherical
from .kinematics import forward_kinematics, frame_bias_acceleration, frame_jacobian, frame_placement
from .mass_matrix import crba
from .model import Model
from .plucker import SE3, force_transform, motion_transform
from .rotation import exp3, log3, skew, unskew
from .trees import chain, random_tree
from .twist import Twist, hat, screw, vee
from .wrench import Wrench, power
