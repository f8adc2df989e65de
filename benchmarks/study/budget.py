"""``python -m benchmarks.study budget``: every source of error of one motion, on one scale.

Which digits does a controller need? Those that the largest other error does not drown. So each source alone is put into
the same motion, from the rounding of a float64 to a template, and is measured in what people think in: N m at the worst
motor, mm of the centre of pressure.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

import twistwrench as tw
from twistwrench.algorithms.floating_base import base_placement
from twistwrench.arrays import Array
from twistwrench.motions import MOTIONS, Motion
from twistwrench.motions.support import NEGLIGIBLE, Need, needs
from twistwrench.templates import TEMPLATES

from .record import Record, table

STEP = 1e-3  # seconds between two states of the motion, which is also the step of Euler's method

Change = Callable[[tw.Model, Motion], Need]
"""What a motion would be thought to need, with one thing wrong."""


def rounded(dtype: str, model: tw.Model, motion: Motion) -> Need:
    """Round the states to a number type, and compute in it."""
    q = model.normalize(motion.q.astype(dtype))
    return needs(model, motion, q=q, v=motion.v.astype(dtype), a=motion.a.astype(dtype))


def differentiated(step: float, model: tw.Model, motion: Motion) -> Need:
    """Take velocity and acceleration as central differences of the positions, `step` seconds apart."""
    k = max(1, round(step / (motion.t[1] - motion.t[0])))
    h = k * (motion.t[1] - motion.t[0])
    q, v, a = motion.q, motion.v.copy(), motion.a.copy()
    ahead, back = (model.difference(q[k:-k], other) / h for other in (q[2 * k :], q[: -2 * k]))
    v[k:-k], a[k:-k] = (ahead - back) / 2, (ahead + back) / h
    return needs(model, motion, v=v, a=a)


def integrated(late: bool, model: tw.Model, motion: Motion) -> Need:
    """Integrate the accelerations from the first state on, by Euler's method, without feedback."""
    q, v = motion.q.copy(), motion.v.copy()
    for k, h in enumerate(np.diff(motion.t), 1):
        v[k] = v[k - 1] + h * motion.a[k - 1]
        q[k] = model.integrate(q[k - 1], h * v[k if late else k - 1])
    return needs(model, motion, q=q, v=v)


def held(model: tw.Model, motion: Motion) -> Need:
    """Hold the third of the moving joints that moves least, in the middle of its motion."""
    q, v, a = motion.q.copy(), motion.v.copy(), motion.a.copy()
    rms = np.sqrt((v[:, 6:] ** 2).mean(axis=0))
    moving = np.flatnonzero(rms > NEGLIGIBLE * rms.max())
    least = 6 + moving[rms[moving].argsort()[: len(moving) // 3]]
    q[:, 1 + least], v[:, least], a[:, least] = q[:, 1 + least].mean(axis=0), 0, 0
    return needs(model, motion, q=q, v=v, a=a)


def template(name: str, model: tw.Model, motion: Motion) -> Need:
    """Take the ground's wrench from a template, and the torques of massless legs beside it."""
    made = TEMPLATES[name].of(model, model.standing())
    rate = made.rate(motion.q, motion.v, motion.a)
    T = base_placement(model, motion.q)
    force = rate[:, 3:] - model.mass * model.gravity
    moment = rate[:, :3] + np.cross(tw.center_of_mass(model, motion.q) - T.translation, force)
    wrench = np.concatenate([np.matvec(T.rotation.mT, x) for x in (moment, force)], axis=1)
    return needs(model, motion, wrench=wrench)


def other_gravity(model: tw.Model, motion: Motion) -> Need:
    """Take 9.8 for 9.81."""
    return needs(replace(model, gravity=model.gravity * 9.8 / 9.81), motion)


def heavier(model: tw.Model, motion: Motion) -> Need:
    """Compute with a trunk of 5 % more mass."""
    world, trunk, *others = model.inertia
    trunk = tw.SpatialInertia(1.05 * trunk.mass, trunk.com, 1.05 * trunk.inertia_at_com)
    return needs(replace(model, inertia=(world, trunk, *others)), motion)


def other_base(change: Callable[[Array, Array], Array], model: tw.Model, motion: Motion) -> Need:
    """Compute with other velocities and accelerations of the base, from its rotation and from the right ones."""
    R = base_placement(model, motion.q).rotation
    v, a = (np.concatenate([change(R, x[:, :6]), x[:, 6:]], axis=1) for x in (motion.v, motion.a))
    return needs(model, motion, v=v, a=a)


def _in_world(R: Array, x: Array) -> Array:
    return np.concatenate([np.matvec(R, x[:, :3]), np.matvec(R, x[:, 3:])], axis=1)


def pitched(model: tw.Model, motion: Motion) -> Need:
    """Turn the base by a degree about its y axis, and with it the whole robot."""
    step = np.deg2rad(1) * np.eye(model.nv)[1]
    return needs(model, motion, q=model.integrate(motion.q, step))


def at_rest(model: tw.Model, motion: Motion) -> Need:
    """Hold each configuration still."""
    return needs(model, motion, v=0 * motion.v, a=0 * motion.a)


SOURCES: dict[str, tuple[str, Change]] = {
    "float64": ("number", partial(rounded, "float64")),
    "float32": ("number", partial(rounded, "float32")),
    "differences of 1 ms": ("time", partial(differentiated, 1e-3)),
    "differences of 10 ms": ("time", partial(differentiated, 1e-2)),
    "Euler, 1 ms": ("time", partial(integrated, False)),
    "semi-implicit Euler, 1 ms": ("time", partial(integrated, True)),
    "g = 9.8 for 9.81": ("model", other_gravity),
    "trunk 5 % heavier": ("model", heavier),
    "joints that move least, held": ("model", held),
    "v = 0, a = 0": ("model", at_rest),
    "rigid body, massless legs": ("model", partial(template, "srbm")),
    "pendulum, massless legs": ("model", partial(template, "lipm")),
    "base pitched by 1°": ("state", pitched),
    "base (v, ω) for (ω, v)": ("slip", partial(other_base, lambda _, x: tw.bridge.to_pinocchio_motion(x))),
    "base velocity in the world's axes": ("slip", partial(other_base, _in_world)),
}
"""The sources of error, their kind, and what each makes of a motion."""


def sampled_motion(model: tw.Model, name: str) -> Motion:
    """Return a motion of `MOTIONS`, a state every `STEP`."""
    motion = MOTIONS[name](model, samples=2)  # of its duration
    return MOTIONS[name](model, samples=1 + round((motion.t[-1] - motion.t[0]) / STEP))


def budget(model: tw.Model, motion: Motion) -> Iterator[Record]:
    """Put each source of error alone into a motion, and measure what it does to the torques and to the ground.

    Each gives two records: the largest error of a motor's `torque`, N m (of a prismatic joint N), and of which; the
    largest shift of the centre of `pressure`, mm. The motion is evenly sampled.

    A degree of the base costs a Go2 ten thousand times what float32 costs:

    >>> model = tw.load("go2")
    >>> trot = tw.motions.trot(model, samples=100)
    >>> found = {r.way: r.error for r in budget(model, trot) if r.quantity == "torque"}
    >>> found["base pitched by 1°"] > 1e4 * found["float32"]
    True
    """
    true = rounded("longdouble", model, motion)
    motors = [name for name, dofs in zip(model.joint_names, model.v_slice) for _ in range(dofs.stop - dofs.start)][6:]
    for name, (_, changed) in SOURCES.items():
        found = changed(model, motion)
        wrong = np.abs(found.tau - true.tau).max(axis=0)
        worst = int(wrong.argmax())
        shift = np.sqrt(((found.pressure - true.pressure) ** 2).sum(axis=1))
        yield Record("torque", name, where=motors[worst], error=float(wrong[worst]))
        yield Record("pressure", name, error=1e3 * float(np.nanmax(shift)))


def shown(found: Sequence[Record]) -> str:
    """Return the table of the records, a line for each source."""
    pairs = zip(found[::2], found[1::2], strict=True)
    rows = [{"": SOURCES[t.way][0], "source": t.way, "N m": t.error, "at": t.where, "mm": p.error} for t, p in pairs]
    return table(
        rows,
        {"": "", "source": "source", "N m": "torque, N m", "at": "at", "mm": "pressure, mm"},
        **{"N m": ".1e", "mm": ".1e"},
    )
