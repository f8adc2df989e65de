"""Spatial algebra: rotations, twists, Plücker transforms, wrenches and inertias (49.2 to 49.5).

Each file imports only from those above it in this table.

==============  =======  ==============================================================================
file            section  what it holds
==============  =======  ==============================================================================
_elementary              functions of one number that lose no digits
orthonormal     49.2     `nearest_rotation`, and the test whether a matrix is a rotation
rotation        49.2     `skew` [ω]×, `exp3`, `log3`; quaternions
roll_pitch_yaw  49.2     URDF's three angles, back from a rotation, and their rates
_quaternions    49.2     steps by quaternions, and rotations as fractions
_physical       49.5     which inertias a body can have
_vector                  what twists and wrenches share
twist           49.2     `Twist`, `hat` [V], `vee`, `screw`
plucker         49.3     `SE3`, `motion_transform` X, `force_transform` X*
exponential     49.3     `exp6`, `log6`, `interpolate`
jacobians       49.3     `Jexp3`, `Jlog3`, `Jexp6`, `Jlog6`
wrench          49.4     `Wrench`, `power`, `center_of_pressure`
cross           49.5     `cross_motion` V×, `cross_force` V×*
ellipsoid       49.5     an inertia as a small picture, for notebooks
inertia         49.5     `SpatialInertia` Î: its forms, sums, momentum, energy; bodies by shape
formulas                 the recursions' own V×, V×*, V ×* Î V: on columns, without checks
==============  =======  ==============================================================================
"""

from .cross import cross_force, cross_motion
from .exponential import exp6, interpolate, log6
from .inertia import SpatialInertia
from .jacobians import Jexp3, Jexp6, Jlog3, Jlog6
from .orthonormal import check_rotation, nearest_rotation
from .plucker import SE3, force_transform, motion_transform
from .roll_pitch_yaw import rotation_to_rpy, rpy_jacobian, rpy_to_rotation
from .rotation import exp3, log3, quaternion_to_rotation, rotation_to_quaternion, skew, unskew
from .twist import Screw, Twist, hat, screw, vee
from .wrench import Wrench, center_of_pressure, power

__all__ = [
    "SE3",
    "Jexp3",
    "Jexp6",
    "Jlog3",
    "Jlog6",
    "Screw",
    "SpatialInertia",
    "Twist",
    "Wrench",
    "center_of_pressure",
    "check_rotation",
    "cross_force",
    "cross_motion",
    "exp3",
    "exp6",
    "force_transform",
    "hat",
    "interpolate",
    "log3",
    "log6",
    "motion_transform",
    "nearest_rotation",
    "power",
    "quaternion_to_rotation",
    "rotation_to_quaternion",
    "rotation_to_rpy",
    "rpy_jacobian",
    "rpy_to_rotation",
    "screw",
    "skew",
    "unskew",
    "vee",
]
