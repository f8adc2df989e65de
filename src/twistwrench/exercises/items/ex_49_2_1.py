"""Exercise 49.2.1: the twist of a foot."""

from functools import cache
from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import after, before

from ..layouts import TWIST
from ..robots import robot
from ..wrong import faulty, swapped

__all__ = ["EXERCISE", "foot_speed", "foot_twist"]


def foot_twist(model: Any, q: Any, omega_z: Any) -> Any:
    """Body twist of FR_foot while the base turns."""
    world_base = tw.frame_placement(model, q, "base")
    world_foot = tw.frame_placement(model, q, "FR_foot")
    foot_base = world_foot.inverse() @ world_base
    return foot_base.motion_transform() @ np.array([0, 0, omega_z, 0, 0, 0])


def foot_speed() -> Any:
    """Speed of FR_foot at the neutral posture."""
    model = tw.load("go2")
    x, y, _ = tw.frame_placement(model, model.neutral(), "FR_foot").translation
    return 0.5 * np.hypot(x, y)


def _by_vectors(model: Any, q: Any, omega_z: Any) -> Any:
    base, foot = tw.frame_placement(model, q, "base"), tw.frame_placement(model, q, "FR_foot")
    omega = base.rotation @ np.array([0, 0, omega_z])
    velocity = np.cross(omega, foot.translation - base.translation)
    return np.concatenate([foot.rotation.mT @ omega, foot.rotation.mT @ velocity])


_speed = cache(foot_speed)

IN_BASE_AXES = faulty(
    foot_twist, ("return foot_base", "return tw.motion_transform(foot_base.rotation.mT, np.zeros(3)) @ foot_base")
)
"""At the foot's origin, but along the axes of the base."""


def _cases(rng: Any) -> Any:
    model = robot("go2")
    return [(model, model.random_configuration(rng=rng), 0.5), (model, model.random_configuration(rng=rng), -1.3)]


TWIST_OF_FOOT = Part(
    solution=foot_twist,
    ways=(_by_vectors,),
    returns=(Output("V", TWIST),),
    cases=_cases,
    slips={
        "swapped-halves": swapped(foot_twist),
        "world-for-local": faulty(foot_twist, ("return foot_base", "return world_foot.motion_transform() @ foot_base")),
        "aligned-for-local": faulty(
            foot_twist, ("return foot_base", "return tw.motion_transform(world_foot.rotation, np.zeros(3)) @ foot_base")
        ),
        "base-for-local": IN_BASE_AXES,
        "half-rotated": lambda *given: np.concatenate([foot_twist(*given)[:3], IN_BASE_AXES(*given)[3:]]),
        "only-v-rotated": lambda *given: np.concatenate([IN_BASE_AXES(*given)[:3], foot_twist(*given)[3:]]),
        "untransformed": faulty(foot_twist, ("foot_base.motion_transform() @ ", "")),
        "coupling-dropped": after(foot_twist, lambda V: V * np.repeat([1, 0], 3)),
        "coupling-sign": after(foot_twist, lambda V: V * np.repeat([1, -1], 3)),
        "inverse-transform": faulty(foot_twist, ("foot_base.motion", "foot_base.inverse().motion")),
        "force-for-motion": faulty(foot_twist, ("foot_base.motion", "foot_base.force")),
        "joint-for-frame": faulty(foot_twist, ('q, "FR_foot"', 'q, "FR_calf_joint"')),
        "world-axis-for-base": faulty(
            foot_twist,
            ("np.array([0, 0, omega_z, 0, 0, 0])", "np.pad(world_base.rotation.mT @ [0, 0, omega_z], (0, 3))"),
        ),
        "spatial-for-body": faulty(foot_twist, ("return foot_base", "return world_foot.inverse()")),
        "lever-from-world": faulty(
            foot_twist,
            ("return foot_base", "return world_foot.inverse()"),
            ("np.array([0, 0, omega_z, 0, 0, 0])", "np.pad(world_base.rotation @ [0, 0, omega_z], (0, 3))"),
        ),
        "pinocchio-velocity": faulty(foot_twist, ("[0, 0, omega_z, 0, 0, 0]", "[0, 0, 0, 0, 0, omega_z]")),
        "degrees": before(foot_twist, np.degrees, which=2),
    },
    alike=(frozenset({"coupling-dropped", "force-for-motion"}),),  # X* maps (ω, 0) to (R ω, 0)
    residuals=(
        lambda answer, model, q, omega_z: (answer[:3] ** 2).sum() - omega_z**2,
        lambda answer, model, q, omega_z: (
            tw.frame_jacobian(model, q, "FR_foot", reference="local")[:, 2] * omega_z - answer
        ),
    ),
)

SPEED_OF_FOOT = Part(
    solution=foot_speed,
    returns=(Output("|v|", unit="m/s"),),
    cases=lambda rng: [()],
    rtol=1e-3,
    slips={
        "thousand": lambda: 1000 * _speed(),
        "degrees": lambda: np.degrees(_speed()),
        "lever-all": lambda: 0.5 * np.linalg.norm([0.1934, -0.142, -0.426]),
        "omega-dropped": lambda: 2 * _speed(),
        "norm-of-six": lambda: np.hypot(0.5, _speed()),
    },
)

EXERCISE = Exercise(id="49.2.1", kind="explain", parts=(TWIST_OF_FOOT, SPEED_OF_FOOT))
