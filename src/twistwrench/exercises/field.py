"""What the chapter's readers take for each other: names of the package, and the order of six-vectors."""

import twistwrench
from misstep.diagnose import Field
from misstep.grammar import Habits

from .slips import SLIPS

__all__ = ["FIELD"]

CONFUSABLE = (
    *(("motion_transform", "force_transform"), ("cross_motion", "cross_force"), ("inward", "outward")),
    *(("nonlinear_effects", "gravity"), ("rotation", "translation"), ("com", "translation"), ("C", "F")),
    *(("local", "world", "local_world_aligned"), ("neutral", "standing"), ("lower", "upper")),
    ("FR_foot", "FL_foot", "RR_foot", "RL_foot"),
)
"""Names of the package and of its robots that are taken for each other."""

REARRANGED = ("np.r_[x[3:6], x[:3], x[6:]]",)
"""The other order of a six-vector, or of a vector that begins with one."""

FIELD = Field(SLIPS, Habits(CONFUSABLE, REARRANGED), twistwrench)
