"""The project, stage 1: a toolbox of spatial vectors."""

from misstep.exercise import Exercise

from .project_operators import CROSS, TRANSFORMS
from .project_toolbox import POSE_OF_BASE, POSE_OF_URDF, VECTOR
from .project_tree import PLACEMENTS, TWISTS, WRENCHES

__all__ = ["EXERCISE"]

EXERCISE = Exercise(
    id="project.1",
    kind="code",
    parts=(VECTOR, POSE_OF_BASE, POSE_OF_URDF, TRANSFORMS, CROSS, PLACEMENTS, TWISTS, WRENCHES),
)
