"""Scenes in which a smaller model may do: six of a practitioner and six more, each with motions for the choice and others.

A motion gives the joints that have motors a course, and the rest moves as it must: without torque (`follow`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench import motions
from twistwrench.motions import Motion

Course = Callable[[float], tuple[float, float, float]]


class Case(NamedTuple):
    """A scene, what is needed of a model, the motions that decide, others, and what else `cheapest` is told."""

    scene: tw.Scene
    need: dict[str, Any]
    judged: Sequence[Motion]
    unseen: Sequence[Motion]
    options: dict[str, Any] = {}


def wave(middle: float, size: float, hertz: float, phase: float = 0.0) -> Course:
    """Return q, q̇ and q̈ of a joint that swings."""
    w = 2 * np.pi * hertz

    def at(t: float) -> tuple[float, float, float]:
        s, c = np.sin(w * t + phase), np.cos(w * t + phase)
        return middle + size * s, size * w * c, -size * w * w * s

    return at


def follow(
    model: tw.Model, q: np.ndarray, courses: Mapping[str, Course], passive: Sequence[str] = (), duration: float = 1.0
) -> Motion:
    """Return a motion of 40 states: joints on their courses, those that are passive without torque, the rest still."""
    slices = dict(zip(model.joint_names, zip(model.q_slice, model.v_slice)))
    loose = np.concatenate([np.arange(model.nv)[slices[name][1]] for name in passive] or [np.zeros(0, int)])
    steps, dt = 400, duration / 400
    q, v, states = q.copy(), np.zeros(model.nv), []
    for k in range(steps):
        a = np.zeros(model.nv)
        for name, course in courses.items():
            (at_q, at_v) = slices[name]
            q[at_q], v[at_v], a[at_v] = course(k * dt)
        M = tw.crba(model, q)
        a[loose] = np.linalg.solve(M[np.ix_(loose, loose)], -tw.rnea(model, q, v, a)[loose])
        if k % 10 == 0:
            states.append((q.copy(), v.copy(), a.copy()))
        v[loose] += dt * a[loose]
        q = model.integrate(q, dt * v)
    return Motion.from_states(np.arange(0, steps, 10) * dt, *map(np.stack, zip(*states)))


def with_passive(model: tw.Model, motion: Motion, passive: str) -> Motion:
    """Return the motion of a robot with one more joint, the last, which swings without torque."""
    q, v, rows = 0.0, 0.0, []
    for k in range(len(motion)):
        at = np.r_[motion.q[k], q], np.r_[motion.v[k], v]
        a = -tw.rnea(model, *at, np.r_[motion.a[k], 0])[-1] / tw.crba(model, at[0])[-1, -1]
        rows.append((*at, np.r_[motion.a[k], a]))
        dt = motion.t[min(k + 1, len(motion) - 1)] - motion.t[k]
        v += dt * a
        q += dt * v
    return replace(motion, **dict(zip("qva", map(np.stack, zip(*rows)))))


def box(mass: float, sides: tuple[float, float, float], name: str) -> tw.Model:
    """Return a body that floats."""
    return tw.Builder(name, base="floating", root_inertia=tw.SpatialInertia.from_box(mass, sides)).build()


# ---------------------------------------------------------------- the six of a practitioner


def bucket_on_a_go2() -> Case:
    """Build a Go2 that walks with a bucket on its back, whose bail is a hinge without a motor."""
    go2 = tw.load("go2")
    bail = tw.Builder("bucket", base="floating", root_inertia=tw.SpatialInertia.from_box(0.1, [0.1, 0.1, 0.1]))
    water = tw.SpatialInertia.from_box(1.0, [0.1, 0.1, 0.1]).transform(tw.SE3(np.eye(3), [0, 0, -0.1]))
    bail.link("pail", parent="base_link", joint=tw.Revolute("y"), inertia=water, effort_limit=0.0)
    model = tw.attach(go2, bail.build(), "base", placement=tw.SE3(np.eye(3), [-0.25, 0, 0.2]))
    feet = [tw.PointContact(foot, mu=0.7) for foot in go2.feet]
    judged = motions.walk(go2, samples=100)
    unseen = motions.walk(go2, samples=100, speed=0.4)
    some = [with_passive(model, motion, "pail") for motion in (judged, unseen)]
    return Case(tw.Scene(model, contacts=feet), {"tau": 0.5}, some[:1], some[1:])


def tool_in_two_fingers() -> Case:
    """Build an arm that holds a tool with two fingers: a closed loop, whose tool is a body of its own."""
    arm = tw.load("panda")
    q = arm.integrate(arm.neutral(), np.r_[0, 0.3, 0, -1.5, 0, 1.8, 0.5, 0.02, 0.02])
    tool = box(0.8, (0.04, 0.04, 0.2), "tool")
    both = tw.attach(arm, tool, None, prefix="t_")
    ends = ["panda_leftfinger", "panda_rightfinger"]
    return both, q, ends


if __name__ == "__main__":
    both, q, ends = tool_in_two_fingers()
    print(both.joint_names, both.frame_names)
