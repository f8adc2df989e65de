"""Smooth motions to try models on: of legged robots a slow walk, a trot and a jump (49.10); of any robot `reach`.

The robot's centre of mass, base and feet follow curves that are three times differentiable; positions come by Newton's
method, velocities and accelerations from the same Jacobian. So v is the rate of q and a that of v to rounding, what
stands does not move, and in flight the robot falls as it must. The legs' lengths and the times are in units of the
height of the centre of mass, so that a big robot does what a small one does, more slowly.

=========  ==================================================  =====================================================
motion     four legs                                           two legs
=========  ==================================================  =====================================================
`walk`     a crawl: one foot at a time                         a slow walk
`trot`     a trot: diagonal pairs, no flight                   a brisk walk: a biped has no diagonals to trot with
`jump`     forward off all feet, the trunk pitching in flight  the same off both feet
=========  ==================================================  =====================================================

Walk and trot take a speed, a height, a direction and a length of the steps. `reach` goes from one configuration to
another on any robot, an arm or a drone.
"""

from .motion import Motion
from .reaching import reach
from .support import GroundLoad, ground, limits_broken
from .walking import MOTIONS, jump, trot, walk

Ground = GroundLoad  # by its former name as well

__all__ = ["MOTIONS", "GroundLoad", "Motion", "ground", "jump", "limits_broken", "reach", "trot", "walk"]
