"""Exercise 49.7.1: a robot that falls."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import after

from ..layouts import JOINT_SPACE
from ..robots import held_acceleration, states
from ..wrong import faulty, swapped

__all__ = ["EXERCISE", "fall_from_rest", "fall_in_motion"]


def fall_from_rest(model: Any, q: Any) -> Any:
    """Acceleration without torques at rest, by ABA and by thought."""
    rest = np.zeros(model.nv)
    base = tw.forward_kinematics(model, q).placement[1]
    expected = np.zeros(model.nv)
    expected[3:6] = base.rotation.mT @ model.gravity
    return tw.aba(model, q, rest, rest), expected


def fall_in_motion(model: Any, q: Any, v: Any) -> Any:
    """Acceleration of the base's origin and of the centre of mass, in the axes of the world."""
    a = tw.aba(model, q, v, np.zeros(model.nv))
    base = tw.forward_kinematics(model, q).placement[1]
    of_base = base.rotation @ (a[3:6] + np.cross(v[:3], v[3:6]))
    mass = sum(body.mass for body in model.inertia)
    of_com = tw.centroidal_momentum_rate(model, q, v, a)[3:] / mass
    return of_base, of_com


def _aligned(model: Any, q: Any, v: Any) -> Any:
    """Return the acceleration of the base's origin by its Jacobian, aligned with the world."""
    base, a = model.joint_names[1], tw.aba(model, q, v, np.zeros(model.nv))
    bias = tw.frame_bias_acceleration(model, q, v, base, "local_world_aligned")
    return (tw.frame_jacobian(model, q, base, "local_world_aligned") @ a + bias)[3:]


def _fixed_to_base(model: Any, q: Any, v: Any) -> Any:
    """Return the two accelerations, the second of the point of the base that is at the centre of mass now."""
    base, a = tw.forward_kinematics(model, q).placement[1], tw.aba(model, q, v, np.zeros(model.nv))
    r = base.rotation.mT @ (tw.center_of_mass(model, q) - base.translation)
    of_base = fall_in_motion(model, q, v)[0]
    return of_base, of_base + base.rotation @ (np.cross(a[:3], r) + np.cross(v[:3], np.cross(v[:3], r)))


FROM_REST = Part(
    solution=fall_from_rest,
    returns=(
        Output("q̈ by ABA", JOINT_SPACE, zh="用 ABA 求得的 q̈"),
        Output("q̈ as expected", JOINT_SPACE, zh="预期的 q̈"),
    ),
    cases=lambda rng: [*states(rng, small=1)],
    slips={
        "gravity-compensated": lambda model, q: (np.zeros(model.nv), np.zeros(model.nv)),
        "accelerometer": faulty(fall_from_rest, ("rest, rest), expected", "rest, rest), rest")),
        "base-held": lambda model, q: (
            held_acceleration(model, q, *np.zeros((2, model.nv))),
            fall_from_rest(model, q)[1],
        ),
        "bias-sign": faulty(fall_from_rest, ("return tw", "return -tw")),
        "aligned-for-local": faulty(fall_from_rest, ("base.rotation.mT @ ", "")),
        "rotation-forward": faulty(fall_from_rest, ("rotation.mT", "rotation")),
        "gravity-sign": faulty(fall_from_rest, ("= base", "= -base")),
        "swapped-halves": swapped(fall_from_rest),
        "angular-for-linear": swapped(fall_from_rest, only=(1,)),
        "base-missing": after(fall_from_rest, lambda a: a[6:]),
    },
    residuals=(
        lambda answer, model, q: (answer[0][6:], answer[1][6:]),
        lambda answer, model, q: [tw.rnea(model, q, np.zeros(model.nv), a) for a in answer],
    ),
)

IN_MOTION = Part(
    solution=fall_in_motion,
    returns=(
        Output("a of the base", unit="m/s²", zh="基座的 a"),
        Output("a of the centre of mass", unit="m/s²", zh="质心的 a"),
    ),
    cases=lambda rng: [*states(rng, vectors=1)],
    slips={
        "classical-acceleration": faulty(fall_in_motion, (" + np.cross(v[:3], v[3:6])", "")),
        "cross-order": faulty(fall_in_motion, ("v[:3], v[3:6]", "v[3:6], v[:3]")),
        "coriolis-twice": faulty(fall_in_motion, ("+ np.cross", "+ 2 * np.cross")),
        "term-unturned": faulty(
            fall_in_motion, ("(a[3:6] + np.cross(v[:3], v[3:6]))", "a[3:6] + np.cross(v[:3], v[3:6])")
        ),
        "acceleration-of-the-body": faulty(
            fall_in_motion, ("base.rotation @ (a[3:6] + np.cross(v[:3], v[3:6]))", "a[3:6]")
        ),
        "untransformed": faulty(fall_in_motion, ("base.rotation @ (a[3:6]", "(a[3:6]")),
        "rotation-transposed": faulty(fall_in_motion, ("rotation @", "rotation.mT @")),
        "angular-for-linear": faulty(fall_in_motion, ("a[3:6]", "a[:3]")),
        "as-at-rest": lambda model, q, v: (model.gravity, model.gravity),
        "base-for-com": faulty(fall_in_motion, ("return of_base, of_com", "return of_base, of_base")),
        "com-fixed-to-base": _fixed_to_base,
        "gravity-twice": faulty(fall_in_motion, (" / mass", " / mass + model.gravity")),
        "rate-bias-missing": faulty(
            fall_in_motion, ("tw.centroidal_momentum_rate(model, q, v, a)", "(tw.centroidal_map(model, q) @ a)")
        ),
        "mass-not-divided": faulty(fall_in_motion, (" / mass", "")),
        "gravity-sign": faulty(fall_in_motion, ("of_com = tw", "of_com = -tw")),
        "local-for-aligned": faulty(
            fall_in_motion, ("return of_base, of_com", "return base.rotation.mT @ of_base, base.rotation.mT @ of_com")
        ),
    },
    residuals=(
        lambda answer, model, q, v: answer[0] - _aligned(model, q, v),
        lambda answer, model, q, v: answer[1] - model.gravity,
    ),
)

EXERCISE = Exercise(id="49.7.1", kind="explain", parts=(FROM_REST, IN_MOTION))
