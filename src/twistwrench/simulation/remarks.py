"""What a motion is worth: the first time that a robot did what a real one would not, or that a foot lost the ground."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ..algorithms.kinematics import forward_kinematics, frame_placement
from ..arrays import Array
from ..contact import Contact, PointContact, SphereContact, SurfaceContact, WheelContact
from ..model import Model
from .stepping import TimeStepping

__all__ = ["Remark", "of_alternation", "of_contacts", "of_ground", "of_joints", "of_left_out"]

LOOSE = 1e-9
"""Relative to what is allowed, or in rad and m: rounding stays below."""

DEEP = 1e-3
"""m: what is less far below the contacts may be a foot's own size."""

SLIDES = 1e-3
"""m/s: how fast a point that touches slides at least."""

MISSES = 1e-3
"""Relative to the fastest point: how far a step may miss Coulomb's law before it is said."""

ALTERNATES, GROWS, SHAKES = 8, 4.0, 0.1
"""So many changes of v in a row with opposite signs, of which the last is so many times the first, and above so many
rad/s or m/s, are no motion but gains that are too high for the step."""

SENTENCES = {
    "pull": "contact {name!r} pulls, by {value:.4g} N",
    "slip": "contact {name!r} holds {value:.4g} N along the ground; without slipping it can {limit:.4g} N",
    "tip": "contact {name!r} holds a moment of {value:.4g} N m; without tipping it can {limit:.4g} N m",
    "sunk": "the body of joint {name!r} is below all contacts, at {value:.4g} m",
    "range": "joint {name!r} is at {value:.4g}, beyond its range, which ends at {limit:.4g}",
    "speed": "joint {name!r} moves at {value:.4g} rad/s or m/s; it can {limit:.4g}",
    "effort": "the motor of joint {name!r} gives {value:.4g} N m or N; it can {limit:.4g}",
    "lift-off": "contact {name!r} leaves the ground",
    "slide": "contact {name!r} slides, at {value:.4g} m/s",
    "alternates": "the velocity of joint {name!r} alternates and grows, soon by {value:.4g} rad/s or m/s a step: lower "
    "gains, damping of the model, or a smaller dt?",
    "coulomb": "contact {name!r} misses Coulomb's law by {value:.4g} m/s, more than {limit:.4g}: a smaller dt?",
    "damping": "joint {name!r} has damping, here up to {value:.4g} N m or N, which only 'time-stepping' applies",
    "friction": "joint {name!r} has dry friction, {value:.4g} N m or N, which only 'time-stepping' applies",
}


class Remark(NamedTuple):
    """The first time that something happened in a motion.

    Attributes
    ----------
    t : float
        When, s.
    kind : str
        "pull", "slip", "tip" of a contact that sticks, "sunk" of a body below all of them; "range", "speed", "effort"
        of a joint, "alternates" of one whose velocity changes its way in each step, by more and more; "lift-off",
        "slide" of a contact on a ground, and "coulomb" where no forces were found that fulfil Coulomb's law to 1e-3 of
        the fastest point; "damping", "friction" of a joint that moves, which only time stepping applies; the value is
        the largest that was left out.
    name : str
        Of the frame of the contact, or the joint.
    value, limit : float
        How large it was then, and what is allowed; in N, N m, rad, m, rad/s or m/s.
    """

    t: float
    kind: str
    name: str
    value: float
    limit: float

    def __str__(self) -> str:
        return f"from t = {self.t:.4g} s " + SENTENCES[self.kind].format(**self._asdict())


def first(t: Array, kind: str, name: str, value: Array, limit: Array | float, sign: float = 1.0) -> Iterator[Remark]:
    """Yield the first time that values, time first, are above a limit, or with the sign −1 below it."""
    limit = np.broadcast_to(limit, value.shape)
    over = sign * (value - limit) > LOOSE * np.maximum(1, np.abs(limit))
    if over.any():
        k = tuple(int(i) for i in np.argwhere(over)[0])
        yield Remark(float(t[k[0]]), kind, name, float(value[k]), float(limit[k]))


def of_joints(model: Model, t: Array, q: Array, v: Array, tau: Array) -> Iterator[Remark]:
    """Yield the joints that left their ranges, or were faster or stronger than they can be."""
    for name, joint, at_q, at_v in zip(model.joint_names, model.joints, model.q_slice, model.v_slice):
        if joint is None:
            continue
        if joint.nq == joint.nv:
            yield from first(t, "range", name, q[..., at_q], model.upper[at_q])
            yield from first(t, "range", name, q[..., at_q], model.lower[at_q], -1.0)
        yield from first(t, "speed", name, np.abs(v[..., at_v]), model.velocity_limit[at_v])
        yield from first(t, "effort", name, np.abs(tau[..., at_v]), model.effort_limit[at_v])


def of_alternation(model: Model, t: Array, v: Array, tau: Array) -> Iterator[Remark]:
    """Yield the joints whose velocity changes its way in each step, under other forces, and each time by more."""
    change = np.diff(v, axis=0)
    if len(change) <= ALTERNATES:
        return
    turns = (change[1:] * change[:-1] < 0) & (np.diff(tau[: len(change)], axis=0) != 0)
    runs = np.lib.stride_tricks.sliding_window_view(turns, ALTERNATES, axis=0).all(axis=-1)
    begins, ends = np.abs(change[:-ALTERNATES]), np.abs(change[ALTERNATES:])
    found = np.where(runs & (ends > GROWS * begins) & (ends > SHAKES), ends, 0.0)
    for name, joint, at in zip(model.joint_names, model.joints, model.v_slice):
        if joint is not None:
            yield from first(t, "alternates", name, found[..., at], 0.0)


def of_left_out(model: Model, t: Array, v: Array) -> Iterator[Remark]:
    """Yield the joints that moved as if they had no damping or no dry friction, which the file gives them."""
    for name, joint, at in zip(model.joint_names, model.joints, model.v_slice):
        if joint is not None:
            braked = model.damping[at] * np.abs(v[..., at]), model.friction[at] * (v[..., at] != 0)
            for kind, value in zip(("damping", "friction"), braked):
                yield from (r._replace(value=float(value.max())) for r in first(t, kind, name, value, 0.0))


def of_contacts(
    model: Model, t: Array, q: Array, contacts: Sequence[Contact], forces: dict[str, Array]
) -> Iterator[Remark]:
    """Yield the contacts that stick and pulled, or would have slipped or tipped, and the bodies that sank below all.

    A sole would tip where its centre of pressure leaves it. Of others, such as loops, nothing is said.
    """
    contacts = [c for c in contacts if isinstance(c, PointContact | SphereContact | SurfaceContact | WheelContact)]
    for c in contacts:
        axes, wrench = c.axes(frame_placement(model, q, c.frame).rotation), np.zeros((*q.shape[:-1], 6))
        wrench[..., c.rows] = forces[c.frame]
        f, moment = np.matvec(axes.mT, wrench[..., 3:]), np.abs(np.matvec(axes.mT, wrench[..., :3]))
        loose, pressed = LOOSE * np.abs(f).max(initial=0), np.maximum(f[..., 2], 0)
        yield from first(t, "pull", c.frame, -f[..., 2], loose)
        yield from first(t, "slip", c.frame, np.hypot(f[..., 0], f[..., 1]), c.mu * pressed + loose)
        if isinstance(c, SurfaceContact):
            for axis, half in ((1, c.half_size[0]), (0, c.half_size[1])):
                yield from first(t, "tip", c.frame, moment[..., axis], half * pressed + loose)
    if contacts and not any(c.velocity or c.acceleration for c in contacts):
        feet = [frame_placement(model, q[0], c.frame).translation[..., 2] for c in contacts]
        floor, bodies = np.min(feet, axis=0) - DEEP, forward_kinematics(model, q).placement[1:]
        if all((T.translation[0, ..., 2] >= floor).all() for T in bodies):
            for name, T in zip(model.joint_names[1:], bodies):
                yield from first(t, "sunk", name, T.translation[..., 2], floor, -1.0)


def of_ground(stepping: TimeStepping, t: Array) -> Iterator[Remark]:
    """Yield the contacts on a ground that left it after they had touched it, slid on it, or missed Coulomb's law."""
    force, slides, end = np.array(stepping.forces), np.array(stepping.slides), 0
    missed, most = np.array(stepping.missed), MISSES * np.array(stepping.fastest)
    for c in stepping.contacts if len(force) else ():
        points = slice(end, end := end + len(c.points))
        touches = (force[..., points, 2] > 0).any(axis=-1)
        left = np.maximum.accumulate(touches, axis=0) & ~touches
        yield from first(t, "lift-off", c.frame, left.astype(float), 0.0)
        yield from first(t, "slide", c.frame, slides[..., points].max(axis=-1), SLIDES)
        yield from first(t, "coulomb", c.frame, missed[..., points].max(axis=-1), most)
