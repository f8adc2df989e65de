"""Pictures for the notebooks. Every function takes the axes to draw on, or makes some, and returns them.

Needs matplotlib, which is imported when the first picture is made: ``pip install "twistwrench[plot]"``.

- `style`: colours; axes on which a metre is a metre in every direction.
- `frames`: frames, arrows.
- `robot`: a robot as a stick figure.
- `screws`: screw axes, the field of a twist.
- `matrices`: a matrix as coloured squares.
- `contacts`: friction cones, soles and their centre of pressure.
- `inertias`: bodies as ellipsoids, the apparent mass in each direction.
- `flow`: what a recursion carries along the tree.
- `sparsity`: the mass matrix and its factors beside the tree.
- `stance`: a robot on its feet, with its support polygon.
- `stride`: a robot from the side, and from above.
- `words`: figures with Chinese words.
"""

from ..spatial import center_of_pressure as center_of_pressure  # by its former name as well
from .contacts import friction_cone, sole
from .flow import flow, tree_layout
from .frames import arrows, triad
from .inertias import apparent_mass_ellipse, ellipsoid, ellipsoids, semi_axes
from .matrices import ANGULAR_LINEAR, matrix
from .robot import robot, sticks
from .screws import point_velocity, screw_axis, twist_field
from .sparsity import fill_in, filled_in, mass_matrix, same_branch
from .stance import foot_forces, hull, support_polygon
from .stride import side_view, top_view
from .style import COLOURS, XYZ, axes_2d, axes_3d, fit
from .words import chinese

felt_mass = apparent_mass_ellipse  # both by their former names as well
seats = tree_layout

__all__ = [
    "ANGULAR_LINEAR",
    "COLOURS",
    "XYZ",
    "apparent_mass_ellipse",
    "arrows",
    "axes_2d",
    "axes_3d",
    "chinese",
    "ellipsoid",
    "ellipsoids",
    "fill_in",
    "filled_in",
    "fit",
    "flow",
    "foot_forces",
    "friction_cone",
    "hull",
    "mass_matrix",
    "matrix",
    "point_velocity",
    "robot",
    "same_branch",
    "screw_axis",
    "semi_axes",
    "side_view",
    "sole",
    "sticks",
    "support_polygon",
    "top_view",
    "tree_layout",
    "triad",
    "twist_field",
]
