"""The sources of error, each of which makes a motion seem to need something else."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

import twistwrench as tw
from twistwrench.algorithms.floating_base import base_placement
from twistwrench.arrays import Array
from twistwrench.motions import Motion
from twistwrench.motions.support import NEGLIGIBLE, Need, needs
from twistwrench.templates import TEMPLATES

__all__ = ["SOURCES", "differentiated", "rounded", "template"]

Change = Callable[[tw.Model, Motion], Need]
"""What a motion would be thought to need, with one thing wrong."""


def rounded(dtype: str) -> Change:
    """Round the states to a number type, and compute in it."""

    def change(model: tw.Model, motion: Motion) -> Need:
        q = model.normalize(motion.q.astype(dtype))
        return needs(model, motion, q=q, v=motion.v.astype(dtype), a=motion.a.astype(dtype))

    return change


def differentiated(step: float) -> Change:
    """Take velocity and acceleration as central differences of the positions, `step` seconds apart."""

    def change(model: tw.Model, motion: Motion) -> Need:
        k = max(1, round(step / (motion.t[1] - motion.t[0])))
        h = k * (motion.t[1] - motion.t[0])
        q, v, a = motion.q, motion.v.copy(), motion.a.copy()
        ahead, back = (model.difference(q[k:-k], other) / h for other in (q[2 * k :], q[: -2 * k]))
        v[k:-k], a[k:-k] = (ahead - back) / 2, (ahead + back) / h
        return needs(model, motion, v=v, a=a)

    return change


def integrated(late: bool) -> Change:
    """Integrate the accelerations from the first state on, by Euler's method, without feedback."""

    def change(model: tw.Model, motion: Motion) -> Need:
        q, v = motion.q.copy(), motion.v.copy()
        for k, h in enumerate(np.diff(motion.t), 1):
            v[k] = v[k - 1] + h * motion.a[k - 1]
            q[k] = model.integrate(q[k - 1], h * v[k if late else k - 1])
        return needs(model, motion, q=q, v=v)

    return change


def held(model: tw.Model, motion: Motion) -> Need:
    """Hold the third of the moving joints that moves least, in the middle of its motion."""
    q, v, a = motion.q.copy(), motion.v.copy(), motion.a.copy()
    rms = np.sqrt((v[:, 6:] ** 2).mean(axis=0))
    moving = np.flatnonzero(rms > NEGLIGIBLE * rms.max())
    least = 6 + moving[rms[moving].argsort()[: len(moving) // 3]]
    q[:, 1 + least], v[:, least], a[:, least] = q[:, 1 + least].mean(axis=0), 0, 0
    return needs(model, motion, q=q, v=v, a=a)


def template(name: str) -> Change:
    """Take the ground's wrench from a template, and the torques of massless legs beside it."""

    def change(model: tw.Model, motion: Motion) -> Need:
        made = TEMPLATES[name].of(model, model.standing())
        rate = made.rate(motion.q, motion.v, motion.a)
        T = base_placement(model, motion.q)
        force = rate[:, 3:] - model.mass * model.gravity
        moment = rate[:, :3] + np.cross(tw.center_of_mass(model, motion.q) - T.translation, force)
        wrench = np.concatenate([np.matvec(T.rotation.mT, x) for x in (moment, force)], axis=1)
        return needs(model, motion, wrench=wrench)

    return change


def other_model(change: Callable[[tw.Model], tw.Model]) -> Change:
    """Compute with another model."""
    return lambda model, motion: needs(change(model), motion)


def other_base(change: Callable[[Array, Array], Array]) -> Change:
    """Compute with other velocities and accelerations of the base, from its rotation and from the right ones."""

    def wrong(model: tw.Model, motion: Motion) -> Need:
        R = base_placement(model, motion.q).rotation
        v, a = (np.concatenate([change(R, x[:, :6]), x[:, 6:]], axis=1) for x in (motion.v, motion.a))
        return needs(model, motion, v=v, a=a)

    return wrong


def _heavier(model: tw.Model) -> tw.Model:
    world, trunk, *others = model.inertia
    trunk = tw.SpatialInertia(1.05 * trunk.mass, trunk.com, 1.05 * trunk.inertia_at_com)
    return replace(model, inertia=(world, trunk, *others))


def pitched(model: tw.Model, motion: Motion) -> Need:
    """Turn the base by a degree about its y axis, and with it the whole robot."""
    step = np.zeros(model.nv)
    step[1] = np.deg2rad(1)
    return needs(model, motion, q=model.integrate(motion.q, step))


def at_rest(model: tw.Model, motion: Motion) -> Need:
    """Hold each configuration still."""
    return needs(model, motion, v=0 * motion.v, a=0 * motion.a)


def _in_world(R: Array, x: Array) -> Array:
    return np.concatenate([np.matvec(R, x[:, :3]), np.matvec(R, x[:, 3:])], axis=1)


SOURCES: dict[str, tuple[str, Change]] = {
    "float64": ("number", rounded("float64")),
    "float32": ("number", rounded("float32")),
    "differences of 1 ms": ("time", differentiated(1e-3)),
    "differences of 10 ms": ("time", differentiated(1e-2)),
    "Euler, 1 ms": ("time", integrated(late=False)),
    "semi-implicit Euler, 1 ms": ("time", integrated(late=True)),
    "g = 9.8 for 9.81": ("model", other_model(lambda model: replace(model, gravity=model.gravity * 9.8 / 9.81))),
    "trunk 5 % heavier": ("model", other_model(_heavier)),
    "joints that move least, held": ("model", held),
    "v = 0, a = 0": ("model", at_rest),
    "rigid body, massless legs": ("model", template("srbm")),
    "pendulum, massless legs": ("model", template("lipm")),
    "base pitched by 1°": ("state", pitched),
    "base (v, ω) for (ω, v)": ("slip", other_base(lambda _, x: tw.bridge.to_pinocchio_motion(x))),
    "base velocity in the world's axes": ("slip", other_base(_in_world)),
}
"""The sources of error, their kind, and what each makes of a motion."""
