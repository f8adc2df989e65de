"""Motion in time: a robot that moves under the forces of a policy, step by step on the configuration manifold.

- `run`: `simulate`, the loop. Start here.
- `methods`: the methods by name; Euler's, midpoint and Runge-Kutta.
- `variational`: the method that keeps momentum and, over long times, energy.
- `stepping`: the method with a ground, impulses in each step, damping, friction and ranges of joints; start there for
  contact in time.
- `sticking`: the step of a robot that stands, as one program.
- `programs`: the terms of any other step.
- `cones`: which points take part, and the velocity after their impulses.
- `coulomb`: Coulomb's law for one step.
- `held`: loops, couplings and rails beside it.
- `ground`: the ground and the points that may touch it.
- `straight`: steps in axes that do not turn.
- `system`: the forces of the policy, the contacts, and the acceleration.
- `divergence`: when a step has gone wrong.
- `diagnosis`: why.
- `mimics`: robots some of whose joints follow others.
- `result`: the motion, and what it is worth.
- `growth`: how far off a motion is at its end.
"""

from .divergence import DivergenceError
from .ground import Ground
from .methods import METHODS, Method
from .remark import Remark
from .result import Simulation
from .run import simulate
from .system import Policy

__all__ = ["METHODS", "DivergenceError", "Ground", "Method", "Policy", "Remark", "Simulation", "simulate"]
