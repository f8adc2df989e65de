"""Exercise 49.2.1: the twist of a foot."""

from functools import cache
from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Quantity
from ..layouts import TWIST
from ..robots import robot
from ..wrong import swapped

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


_speed = cache(foot_speed)


def _base_twist(omega_z: Any) -> Any:
    return np.array([0, 0, omega_z, 0, 0, 0])


def _seen_from(model: Any, q: Any, frame: str) -> Any:
    """Return the placement of the base in a frame."""
    return tw.frame_placement(model, q, frame).inverse() @ tw.frame_placement(model, q, "base")


def _coupled(model: Any, q: Any, omega_z: Any, *, factor: float) -> Any:
    """Multiply the coupling term by a factor: the base's own velocity is zero, so that is all of v."""
    return foot_twist(model, q, omega_z) * np.repeat([1, factor], 3)


def _carried(model: Any, q: Any, omega_z: Any, *, about_world: bool) -> Any:
    """Return the foot's twist with the axes of the world, about the world's origin or the foot's."""
    world_foot = tw.frame_placement(model, q, "FR_foot")
    p = world_foot.translation if about_world else np.zeros(3)
    return tw.motion_transform(world_foot.rotation, p) @ foot_twist(model, q, omega_z)


def _cases(rng: Any) -> Any:
    model = robot("go2")
    return [(model, model.random_configuration(rng=rng), 0.5), (model, model.random_configuration(rng=rng), -1.3)]


TWIST_OF_FOOT = Part(
    solution=foot_twist,
    returns=(Quantity("V", TWIST),),
    cases=_cases,
    slips={
        "swapped-halves": swapped(foot_twist),
        "world-for-local": lambda model, q, omega_z: _carried(model, q, omega_z, about_world=True),
        "aligned-for-local": lambda model, q, omega_z: _carried(model, q, omega_z, about_world=False),
        "untransformed": lambda model, q, omega_z: _base_twist(omega_z),
        "coupling-dropped": lambda model, q, omega_z: _coupled(model, q, omega_z, factor=0),
        "coupling-sign": lambda model, q, omega_z: _coupled(model, q, omega_z, factor=-1),
        "inverse-transform": lambda model, q, omega_z: (
            _seen_from(model, q, "FR_foot").inverse().motion_transform() @ _base_twist(omega_z)
        ),
        "force-for-motion": lambda model, q, omega_z: (
            _seen_from(model, q, "FR_foot").force_transform() @ _base_twist(omega_z)
        ),
        "joint-for-frame": lambda model, q, omega_z: (
            _seen_from(model, q, "FR_calf_joint").motion_transform() @ _base_twist(omega_z)
        ),
        "pinocchio-velocity": lambda model, q, omega_z: (
            _seen_from(model, q, "FR_foot").motion_transform() @ np.array([0, 0, 0, 0, 0, omega_z])
        ),
        "degrees": lambda model, q, omega_z: foot_twist(model, q, np.degrees(omega_z)),
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
    returns=(Quantity("|v|", unit="m/s"),),
    cases=lambda rng: [()],
    rtol=1e-3,
    slips={
        "thousand": lambda: 1000 * _speed(),
        "degrees": lambda: np.degrees(_speed()),
        "lever-all": lambda: 0.5 * np.linalg.norm([0.1934, -0.142, -0.426]),
        "omega-dropped": lambda: 2 * _speed(),
    },
)

EXERCISE = Exercise(
    id="49.2.1",
    kind="explain",
    parts=(TWIST_OF_FOOT, SPEED_OF_FOOT),
)
