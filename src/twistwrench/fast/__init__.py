"""The same quantities for a thousand states or a control loop: the textbook's functions as programs.

Same functions, same signatures, same errors as the textbook's, and its recursions, recorded for this model, this
question and this number type when first asked for, which takes some tenths of a second (or ahead, by `prepare`), and
remembered with the model: see ``straightline``. Everything that is asked for in one call shares its work. With
``pip install "twistwrench[compile]"`` float32 and float64 have machine code; without it, and for long double and
complex numbers, NumPy does the same operations for many states at once.

The textbook itself takes, some states at a time, what no program can be made for:

- robots that are too long for a straight line, which the log of `twistwrench.fast.programs` records: with more than 400
  degrees of freedom from the world to a body, or 1000 in all; for q̈, M and what else is heavy there, with more than 80
  from the world to a body; and for M, with more than 20 000 entries on and below its diagonal that are not always zero;
- models in which nothing outboard of a joint has inertia, and joints of a class of your own whose `transform` asks what
  its q is;
- single states that are singular, or nearly: the pivots are watched, and the textbook solves them or names the joint.

Of lines with more than 150 000 operations there is no machine code, since it would take long to make: NumPy does them.

How fast all this is, is in benchmarks/README.md; more states than one machine holds are in docs/dask.md.

From `tw.fast.rnea` to machine code it is four steps: the function, in `functions`; `programs.result`, which finds the
program that the model remembers; `Program.alone`; and there the machine code, which `straightline.extension` calls and
`straightline.llvm` has made.

Each file imports only from those above it in this table.

============  ===================================================================================
file          what it holds
============  ===================================================================================
anchors       the chapter's steps, by which the values of a program's text are called
watch         what a program watches, so that the textbook can take the states that raise the alarm
quantity      `Quantity`: what it depends on, and how it is computed; by the textbook, for some states
derivatives   derivatives of all quantities, and the regressor
quantities    what can be compiled: the textbook's functions
recording     from quantities to a straight line
program       `Program`, which is called as the textbook's functions are
digits        programs in pairs of doubles, in quadruple precision, in mpmath's numbers; and with a bound
compilation   `compile`
programs      the program for a model and a question, made once; where there is none, the textbook
functions     dynamics
kinematics    frames, the centre of mass, energies
steps         q ⊕ v_dt, q₁ ⊖ q₀, their derivatives, and the way between
preparation   `prepare`: programs made ahead
============  ===================================================================================

>>> import numpy as np
>>> import twistwrench as tw
>>> model = tw.load("go2")
>>> rng = np.random.default_rng(0)
>>> q = model.random_configuration(1000, rng=rng)
>>> v = rng.standard_normal((1000, model.nv))
>>> d = tw.fast.dynamics(model, q, v)
>>> d.M.shape, d.h.shape, d.J_c.shape, d.A_G.shape
((1000, 18, 18), (1000, 18), (1000, 12, 18), (1000, 6, 18))
>>> bool(np.abs(d.h[7] - tw.nonlinear_effects(model, q[7], v[7])).max() < 1e-11)
True
"""

from .functions import aba, centroidal_map, crba, dynamics, nonlinear_effects, rnea
from .kinematics import (
    center_of_mass,
    center_of_mass_jacobian,
    frame_bias_acceleration,
    frame_jacobian,
    frame_placement,
    kinetic_energy,
    potential_energy,
)
from .preparation import prepare
from .steps import d_difference, d_integrate, difference, integrate, interpolate

__all__ = [
    "aba",
    "center_of_mass",
    "center_of_mass_jacobian",
    "centroidal_map",
    "crba",
    "d_difference",
    "d_integrate",
    "difference",
    "dynamics",
    "frame_bias_acceleration",
    "frame_jacobian",
    "frame_placement",
    "integrate",
    "interpolate",
    "kinetic_energy",
    "nonlinear_effects",
    "potential_energy",
    "prepare",
    "rnea",
]
