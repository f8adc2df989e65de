"""The model: a tree of bodies and joints, its configuration, and how to make one.

Each file imports only from those above it in this table.

==============  ======================================================================================
file            what it holds
==============  ======================================================================================
joint           `Joint`: the motion subspace S, and the placement that a joint makes of its q
joints          the joints of the package, one class each
constants       the numbers of a model in one number type
state           what a state must be: shapes, finite numbers, quaternions of norm 1
configuration   the manifold of q: ⊕ and ⊖, their derivatives, ways and distances, random configurations
checks          what every model must satisfy: its joints, their limits, its bodies
report          what a loader had to interpret, and how
outline         a model as a tree that unfolds, for notebooks
model           `Model`, frozen, and its frames
arguments       input validation of the algorithms: a model and a state of it
tree            what a recursion reads of a model: S, X, I and the parents
builder         `Builder`: a model made of links, its bodies numbered and welded links merged
samples         `chain` and `random_tree`
serial          `from_screw_axes`, `screw_axes`, `from_dh`: arms as textbooks print them
reduction       `lock_joints`: a smaller model
editing         `attach`: two models as one; `replace_inertia`
rerooting       `reroot`: the same robot hung from another frame
==============  ======================================================================================
"""

from .arguments import check_model, check_state, floats_of, one_configuration
from .builder import Builder, Link, NumberedTree
from .checks import PER_DOF, UNLIMITED, WORLD
from .configuration import ConfigurationSpace
from .constants import Constants, cast, readonly
from .editing import attach, replace_inertia
from .joint import AxisJoint, GroupJoint, Joint, placement, same_side, turn, unit
from .joints import Continuous, FreeFlyer, Helical, Planar, Prismatic, Revolute, Spherical
from .model import Frame, Model
from .reduction import Reduction, idle_joints, lock_joints, matching_joints
from .report import Entry, LoadReport
from .rerooting import Rerooting, reroot
from .samples import KINDS, chain, random_tree
from .serial import ScrewAxes, from_dh, from_screw_axes, screw_axes
from .state import check_arrays, check_entries, in_double, joint_name_at, with_number
from .tree import Tree, columns, composite_inertias, joint_placements, stack_columns, tree_terms, wrenches

__all__ = [
    "KINDS",
    "PER_DOF",
    "UNLIMITED",
    "WORLD",
    "AxisJoint",
    "Builder",
    "ConfigurationSpace",
    "Constants",
    "Continuous",
    "Entry",
    "Frame",
    "FreeFlyer",
    "GroupJoint",
    "Helical",
    "Joint",
    "Link",
    "LoadReport",
    "Model",
    "NumberedTree",
    "Planar",
    "Prismatic",
    "Reduction",
    "Rerooting",
    "Revolute",
    "ScrewAxes",
    "Spherical",
    "Tree",
    "attach",
    "cast",
    "chain",
    "check_arrays",
    "check_entries",
    "check_model",
    "check_state",
    "columns",
    "composite_inertias",
    "floats_of",
    "from_dh",
    "from_screw_axes",
    "idle_joints",
    "in_double",
    "joint_name_at",
    "joint_placements",
    "lock_joints",
    "matching_joints",
    "one_configuration",
    "placement",
    "random_tree",
    "readonly",
    "replace_inertia",
    "reroot",
    "same_side",
    "screw_axes",
    "stack_columns",
    "tree_terms",
    "turn",
    "unit",
    "with_number",
    "wrenches",
]
