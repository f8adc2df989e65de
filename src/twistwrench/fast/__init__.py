"""The same quantities for a thousand states or a control loop, in plain NumPy.

Same functions, same signatures, same results to rounding, same errors as the textbook algorithms; three more ideas.

**1. All links at once, in the axes of the base.** The textbook goes from link to link, and turns every twist and
every wrench from the axes of one into those of the next. Turn everything into the axes of the base once, and going
from link to link is only adding. Angular velocities add up on the way from the base to the tips, forces on the way
back, inertias too, and one addition does for all links at the same distance from the base::

      the plan's links              level 1            level 2            level 3
                                                                                       FL, FR, RL, RR:
      0 base of Go2  ───────┬───  1 FL_hip  ───────  5 FL_thigh ───────  9 FL_calf     level 2 += level 1
                            ├───  2 FR_hip  ───────  6 FR_thigh ─────── 10 FR_calf     level 3 += level 2
                            ├───  3 RL_hip  ───────  7 RL_thigh ─────── 11 RL_calf     two additions
                            └───  4 RR_hip  ───────  8 RR_thigh ─────── 12 RR_calf     instead of eight

Each link keeps its own origin: a velocity is that of the link's origin, a moment is about the link's origin, and
only lever arms between neighbours enter. So no digits are lost, however far the robot is from the
world's origin and however long it is.

**2. The states come last in memory.** An array of vectors has its axes in the order component, link, state::

      x[0]   link 0  ████████████████ …   states 0, 1, 2, … next to each other: the processor takes eight at a time
             link 1  ████████████████ …
               ⋮
      x[1]   link 0  ████████████████ …   x[1] is one block: y components of all links and all states
               ⋮
      x[2]     ⋮                          a × b is six products and three differences of such blocks

A batch is cut into chunks whose arrays stay in the cache. To the caller, batch axes come first as everywhere: what
is returned is a transposed view.

**3. A plan, made once.** Everything that does not depend on the state is worked out beforehand, once per model and
number type: which links make a level; inertias and offsets, turned such that every joint moves about or along its z
axis; joints with several degrees of freedom, cut into one link for each. So there is one kind of link, and no kinds of
joint in the algorithms.

For one state the cost is in the calls, not in the arithmetic. There the same three ideas become products of
constant matrices with 4 × 4 matrices that hold all links: see `single`.

The files, in the order in which they are best read: `dofs` and `plan` (the constants); `vectors`, `frames` (where the
links are), `forces` (RNEA), `masses` (CRBA, centroidal momentum), `contacts`, `articulated` (ABA), `kernels`, `outputs`
(arrays of the caller), `batch` (chunks); for one state `single_sums`, `products`, `single_plan`, `single` and
`single_aba`; `arguments` (checks), `dispatch`, `api`.

Which to take: the textbook to read, for a state now and then, and where an intermediate result is wanted; this for
batches and loops. Long double and complex numbers work here as well, by the same code, and gain less. Forward dynamics
that may be singular is left to the textbook, which bounds each rounding and names the joint. A joint of a class of
your own is read off its S, and its `transform` places it where its q is of no known layout. How fast all this is, and
what bounds it, is in benchmarks/README.md; more states than one machine holds are in docs/dask.md.

>>> import numpy as np
>>> import twistwrench as tw
>>> model = tw.load("go2")
>>> rng = np.random.default_rng(0)
>>> q = np.stack([model.random_configuration(rng=rng) for _ in range(1000)])
>>> v = rng.standard_normal((1000, model.nv))
>>> d = tw.fast.dynamics(model, q, v)
>>> d.M.shape, d.h.shape, d.J_c.shape, d.A_G.shape
((1000, 18, 18), (1000, 18), (1000, 12, 18), (1000, 6, 18))
>>> bool(np.abs(d.h[7] - tw.nonlinear_effects(model, q[7], v[7])).max() < 1e-11)
True
"""

from .api import aba, centroidal_map, crba, dynamics, nonlinear_effects, rnea

__all__ = ["aba", "centroidal_map", "crba", "dynamics", "nonlinear_effects", "rnea"]
