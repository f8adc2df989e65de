"""Exercise 49.6.3: what holds a robot at rest."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import as_column, negated, times

from ..layouts import WRENCH
from ..robots import states
from ..wrong import faulty, swapped

__all__ = ["EXERCISE", "base_wrench_at_rest", "go2_base_wrench"]


def base_wrench_at_rest(model: Any, q: Any) -> Any:
    """Wrench on the base that holds the robot, without RNEA."""
    base = tw.forward_kinematics(model, q).placement[1]
    mass = sum(body.mass for body in model.inertia)
    lever = base.rotation.mT @ (tw.center_of_mass(model, q) - base.translation)
    force = -mass * base.rotation.mT @ model.gravity
    return np.concatenate([np.cross(lever, force), force])


def _in_the_world(model: Any, q: Any) -> Any:
    base = tw.forward_kinematics(model, q).placement[1]
    force = -sum(body.mass for body in model.inertia) * model.gravity
    moment = np.cross(tw.center_of_mass(model, q) - base.translation, force)
    return np.concatenate([base.rotation.mT @ moment, base.rotation.mT @ force])


def go2_base_wrench() -> Any:
    """Wrench on the base of Go2 in its neutral posture, by RNEA."""
    model = tw.load("go2")
    rest = np.zeros(model.nv)
    return tw.rnea(model, model.neutral(), rest, rest)[:6]


def _hold_base(model: Any, q: Any) -> Any:
    """Return what holds the base alone, without the legs."""
    force = -model.inertia[1].mass * tw.forward_kinematics(model, q).placement[1].rotation.mT @ model.gravity
    return np.concatenate([np.cross(model.inertia[1].com, force), force])


BY_HAND = Part(
    solution=base_wrench_at_rest,
    ways=(_in_the_world,),
    returns=(Output("F", WRENCH),),
    cases=lambda rng: [*states(rng)],
    slips={
        "as-printed": faulty(base_wrench_at_rest, ("np.cross(lever, force), force", "np.zeros(3), -force")),
        "base-wrench-sign": negated(base_wrench_at_rest),
        "moment-dropped": faulty(base_wrench_at_rest, ("np.cross(lever, force)", "np.zeros(3)")),
        "lever-from-world": faulty(base_wrench_at_rest, (" - base.translation", "")),
        "lever-unrotated": faulty(base_wrench_at_rest, ("base.rotation.mT @ (", "(")),
        "lever-half-turned": faulty(
            base_wrench_at_rest,
            ("(tw.center_of_mass(model, q) - base.translation)", "tw.center_of_mass(model, q) - base.translation"),
        ),
        "moment-unturned": faulty(base_wrench_at_rest, ("np.cross(", "base.rotation @ np.cross(")),
        "force-like-point": faulty(
            base_wrench_at_rest, ("@ model.gravity", "@ (model.gravity + base.translation / mass)")
        ),
        "aligned-for-local": faulty(
            base_wrench_at_rest, ("base.rotation.mT @ (", "("), ("base.rotation.mT @ model", "model")
        ),
        "wrench-about-world": faulty(
            base_wrench_at_rest,
            ("base.rotation.mT @ (", ""),
            (" - base.translation)", ""),
            ("base.rotation.mT @ model", "model"),
        ),
        "rotation-forward": faulty(
            base_wrench_at_rest,
            ("base.rotation.mT @ (", "base.rotation @ ("),
            ("base.rotation.mT @ model", "base.rotation @ model"),
        ),
        "cross-order": faulty(base_wrench_at_rest, ("lever, force", "force, lever")),
        "legs-left-out": _hold_base,
        "one-link": faulty(base_wrench_at_rest, ("sum(body.mass for body in model.inertia)", "model.inertia[1].mass")),
        "base-weightless": lambda model, q: base_wrench_at_rest(model, q) - _hold_base(model, q),
        "mass-for-weight": times(base_wrench_at_rest, 1 / 9.81),
        "swapped-halves": swapped(base_wrench_at_rest),
        "column-vector": as_column(base_wrench_at_rest),
    },
    residuals=(lambda answer, model, q: answer - tw.gravity(model, q)[:6],),
)


def _numbers(moment: float, force: float) -> Any:
    return lambda: np.array([0, moment, 0, 0, 0, force])


OF_GO2 = Part(
    solution=go2_base_wrench,
    returns=(Output("F", WRENCH),),
    cases=lambda rng: [()],
    rtol=1e-4,  # the moment is 1.297 beside a force of 157.8
    slips={
        "as-printed": _numbers(0, -157.794),
        "moment-dropped": _numbers(0, 157.794),
        "base-wrench-sign": _numbers(1.29745, -157.794),
        "qwxyz": _numbers(1.29745, -157.794),
        "cross-order": _numbers(1.29745, 157.794),
        "standing-for-neutral": _numbers(0.272905, 157.794),
        "nominal-mass": _numbers(-1.29745 * 12 / 16.085, 117.72),
        "legs-left-out": _numbers(-1.43342, 71.3874),
        "one-link": _numbers(-1.29745 * 7.277 / 16.085, 71.3874),
        "base-weightless": _numbers(0.13597, 86.4065),
        "mass-for-weight": _numbers(-1.29745 / 9.81, 16.085),
        "swapped-halves": lambda: np.array([0, 0, 157.794, 0, -1.29745, 0]),
    },
    alike=(frozenset({"base-wrench-sign", "qwxyz"}),),
)

EXERCISE = Exercise(id="49.6.3", kind="explain", parts=(OF_GO2, BY_HAND))
