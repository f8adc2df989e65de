"""Rigid-body dynamics without 6-D vectors: the slow, obvious way (49.1).

Read this first. Everything here is the mechanics of a first course: where each body is, how fast it
moves, how it accelerates, all in the axes of the world; then Newton for each centre of mass, Euler for
the turning about it, and D'Alembert to find the forces at the joints. There is no new algebra.

Instead there are coupling terms. A body turns as well as moves, so no velocity, force or rate
of change can be carried from one point or frame to the next without a correction, and each has its own:

===  =============================================  ==========================================
 1   a velocity at another point                    v_P = v_O + ω × r
 2   an acceleration at another point               a_P = a_O + α × r + ω × (ω × r)
 3   a joint that slides (u) in a turning carrier   a gains 2 ω × u
 4   a vector fixed in a turning body               its rate gains ω × the vector
 5   a moment about another point                   n_P = n_C + (c − p) × f
 6   the inertia of a body that turns               d(Iω)/dt = I α + ω × I ω
===  =============================================  ==========================================

Leave one out, change its sign, or take the lever arm from the wrong end, and every
result still seems plausible: half of the common mistakes that the chapter lists in 49.1 are of this
kind, a forgotten 1 and a 5 with the wrong sign. The sources mark their lines with the numbers
(1) to (6); the tests take them out one by one. From 49.2 on, six-dimensional vectors put 1 and 5
into one matrix X, remove the centripetal part of 2 by their definition of acceleration, and turn 3,
4 and 6 into one product V×. They are measured against this package.

It is written independently of all that follows and shares no formula with it, so that an error there
is not repeated here. Nothing in it is optimised. And it works in any kind of
number: given mpmath's, it gives the truth to as many digits as mpmath is set to; given SymPy's, a
formula; given fractions, a fraction, where there is one (the cosine of 0 is one, that of 1/3 is not).
All constants of the model are taken as the exact numbers that their doubles are; rotations, joint axes
and the quaternions of q, which as doubles have length 1 only to rounding, are normalised to the last digit.

One state per call, no batches. All vectors are ordered (ω, v) and (τ, f), as everywhere in twistwrench.

- `arithmetic`, `exact`, `state`: the number type of a call.
- `joints`: how each kind of joint moves.
- `bodies`: every body in the world, and its Jacobians. Start here.
- `kinematics`, `frames`: placements, twists, accelerations; named frames.
- `forces`: inverse dynamics, h, g, the wrenches in the joints.
- `matrices`: M, C, forward dynamics.
- `momentum`: centre of mass, centroidal momentum, energies.

Examples
--------
The weight of a Go2, to fifty digits. The last ones are not noise: the masses are doubles, and this is
their exact sum times the double nearest to 9.81:

>>> import mpmath
>>> import twistwrench as tw
>>> model = tw.load("go2")
>>> with mpmath.workdps(50):
...     print(gravity(model, as_mpmath(model.neutral()))[5])
157.79385000000002289963774160241958323749740674906

The force that lifts 3 kg up a rail at a third of a m/s², as a fraction:

>>> from fractions import Fraction
>>> rail = tw.Builder("rail", gravity=[0, 0, -10])
>>> load = tw.SpatialInertia(3.0, [0, 0, 0], [[1, 0, 0], [0, 1, 0], [0, 0, 1]])
>>> rail.link("load", parent="base_link", joint=tw.Prismatic("z"), inertia=load)
>>> inverse_dynamics(rail.build(), [0], [0], [Fraction(1, 3)])
array([Fraction(31, 1)], dtype=object)
"""

from .arithmetic import as_mpmath
from .forces import gravity, inverse_dynamics, joint_wrenches, nonlinear_effects
from .frames import frame_bias_acceleration, frame_jacobian, frame_placement
from .kinematics import BodyMotion, body_accelerations, body_twists, motion, placements
from .matrices import coriolis_matrix, forward_dynamics, mass_matrix
from .momentum import (
    center_of_mass,
    centroidal_map,
    centroidal_momentum,
    centroidal_momentum_rate,
    kinetic_energy,
    potential_energy,
)

Motion = BodyMotion  # by its former name as well

__all__ = [
    "BodyMotion",
    "as_mpmath",
    "body_accelerations",
    "body_twists",
    "center_of_mass",
    "centroidal_map",
    "centroidal_momentum",
    "centroidal_momentum_rate",
    "coriolis_matrix",
    "forward_dynamics",
    "frame_bias_acceleration",
    "frame_jacobian",
    "frame_placement",
    "gravity",
    "inverse_dynamics",
    "joint_wrenches",
    "kinetic_energy",
    "mass_matrix",
    "motion",
    "nonlinear_effects",
    "placements",
    "potential_energy",
]
