"""Motion in time: a robot that moves under the forces of a policy, step by step on the configuration manifold.

- `run`: `simulate`, the loop. Start here.
- `methods`: the methods by name.
- `explicit`: Euler's methods, midpoint and Runge-Kutta.
- `variational`: the method that keeps momentum and, over long times, energy.
- `tangent`: what the exponential map does to rates and momenta.
- `stepping`: the method with a ground, impulses in each step; start there for contact in time.
- `straight`: axes that do not turn within a step.
- `cones`: which points take part, and the velocity after their impulses.
- `coulomb`: Coulomb's law for one step.
- `held`: loops, couplings and rails beside it.
- `passive`: damping, dry friction and ranges of joints.
- `ground`: the ground and the points that may touch it.
- `system`: the forces of the policy, the contacts, and the acceleration.
- `divergence`: when a step has gone wrong.
- `diagnosis`: why.
- `mimics`: robots some of whose joints follow others.
- `straight`: steps in axes that do not turn.
- `remarks`: what a motion is worth.
- `result`: the motion.
- `scene_like`: what `simulate` needs of a scene.
"""

from .divergence import DivergenceError
from .ground import Ground
from .methods import METHODS, Method
from .remarks import Remark
from .result import Simulation
from .run import simulate
from .system import Policy

__all__ = ["METHODS", "DivergenceError", "Ground", "Method", "Policy", "Remark", "Simulation", "simulate"]
