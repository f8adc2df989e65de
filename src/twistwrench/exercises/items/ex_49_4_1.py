"""Exercise 49.4.1: what one foot carries."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import as_column, negated, times

from ..layouts import WRENCH
from ..robots import robot
from ..wrong import faulty, swapped

__all__ = ["EXERCISE", "foot_loads", "foot_wrench"]


def foot_loads() -> Any:
    """Force on one foot, for 12 kg and for the model's mass."""
    mass = sum(body.mass for body in tw.load("go2").inertia)
    return 12 * 9.81 / 4, mass * 9.81 / 4


def foot_wrench(model: Any, q: Any, foot: Any) -> Any:
    """Wrench of the ground on one of four feet, in the foot's frame."""
    mass = sum(body.mass for body in model.inertia)
    R = tw.frame_placement(model, q, foot).rotation
    upward = -mass * model.gravity / 4
    return np.concatenate([np.zeros(3), R.mT @ upward])


def _loads(mass: float, *, model: float = 16.085, g: float = 9.81, feet: int = 4) -> Any:
    return mass * g / feet, model * g / feet


def _about(model: Any, q: Any, foot: Any, frame: str) -> Any:
    """Take the same wrench to another frame."""
    foot_in_world = tw.frame_placement(model, q, foot)
    there = tw.frame_placement(model, q, frame).inverse() if frame else tw.SE3.identity()
    return (there @ foot_in_world).force_transform() @ foot_wrench(model, q, foot)


def _with_moment(model: Any, q: Any, foot: Any, sign: int) -> Any:
    """Add the moment of the force about the world's origin, in the foot's axes, or the opposite one."""
    F, T = foot_wrench(model, q, foot), tw.frame_placement(model, q, foot)
    return np.concatenate([sign * np.cross(T.rotation.mT @ T.translation, F[3:]), F[3:]])


def _cases(rng: Any) -> Any:
    model = robot("go2")
    feet = rng.permutation(["FL_foot", "FR_foot", "RL_foot", "RR_foot"])
    return [
        (model, model.integrate(model.standing(), rng.normal(scale=0.3, size=model.nv)), str(foot)) for foot in feet
    ]


LOADS = Part(
    solution=foot_loads,
    returns=(Output("f_z (12 kg)", unit="N", zh="f_z（12 kg）"), Output("f_z (model)", unit="N", zh="f_z（模型）")),
    cases=lambda rng: [()],
    rtol=5e-4,
    slips={
        "nominal-mass": lambda: _loads(12, model=12),
        "one-link": lambda: _loads(12, model=7.277),
        "base-weightless": lambda: _loads(12, model=16.085 - 7.277),
        "last-left-out": lambda: _loads(12, model=16.085 - 0.194),
        "welded-left-out": lambda: _loads(12, model=16.085 - 12 * 0.089 - 4 * 0.04),
        "rotors-left-out": lambda: _loads(12, model=16.085 - 12 * 0.089),
        "not-shared": lambda: _loads(12, feet=1),
        "shared-by-two": lambda: _loads(12, feet=2),
        "mass-for-weight": lambda: _loads(12, g=1),
        "g-rounded": lambda: _loads(12, g=9.8),
        "g-ten": lambda: _loads(12, g=10),
        "force-sign": lambda: _loads(-12, model=-16.085),
        "thousand": lambda: _loads(12, g=9810),
    },
)

OF_FOOT = Part(
    solution=foot_wrench,
    returns=(Output("F", WRENCH),),
    cases=_cases,
    edges=lambda rng: [(robot("go2"), robot("go2").neutral(), "RL_foot")],
    slips={
        "swapped-halves": swapped(foot_wrench),
        "aligned-for-local": faulty(foot_wrench, ("R.mT @ upward", "upward")),
        "rotation-forward": faulty(foot_wrench, ("R.mT", "R")),
        "force-at-origin": lambda model, q, foot: _with_moment(model, q, foot, -1),
        "moment-about-world": lambda model, q, foot: _with_moment(model, q, foot, 1),
        "wrench-about-world": lambda model, q, foot: _about(model, q, foot, ""),
        "joint-for-frame": lambda model, q, foot: _about(model, q, foot, foot[:2] + "_calf_joint"),
        "force-sign": negated(foot_wrench),
        "not-shared": times(foot_wrench, 4),
        "shared-by-two": times(foot_wrench, 2),
        "mass-for-weight": times(foot_wrench, 1 / 9.81),
        "nominal-mass": faulty(foot_wrench, ("-mass *", "-12 *")),
        "one-link": faulty(foot_wrench, ("-mass *", "-model.inertia[1].mass *")),
        "g-ten": times(foot_wrench, 10 / 9.81),
        "g-rounded": times(foot_wrench, 9.8 / 9.81),
        "column-vector": as_column(foot_wrench),
    },
    residuals=(
        lambda answer, model, q, foot: answer[:3],
        lambda answer, model, q, foot: (tw.frame_placement(model, q, foot).rotation @ answer[3:])[:2],
        lambda answer, model, q, foot: (
            4 * np.sqrt((answer[3:] ** 2).sum()) - np.sqrt((tw.gravity(model, q)[3:6] ** 2).sum())
        ),
    ),
)

EXERCISE = Exercise(id="49.4.1", kind="number", parts=(LOADS, OF_FOOT))
