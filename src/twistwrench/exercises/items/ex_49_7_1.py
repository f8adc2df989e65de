"""Exercise 49.7.1: a robot that falls."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Quantity
from ..layouts import JOINT_SPACE
from ..robots import robot, small_robot
from ..wrong import after, swapped

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


def _instead(by_aba: Any = None, expected: Any = None) -> Any:
    """Put something else in the place of either answer; each of model, q, and R of the base."""

    def wrong(model: Any, q: Any) -> Any:
        R = tw.forward_kinematics(model, q).placement[1].rotation
        first, second = fall_from_rest(model, q)
        if expected is not None:
            second = np.zeros(model.nv)
            second[3:6] = expected(model.gravity, R)
        return first if by_aba is None else by_aba(model, q), second

    return wrong


def _held(model: Any, q: Any) -> Any:
    """Return the acceleration of the joints when the base is held."""
    M, g = tw.crba(model, q), tw.gravity(model, q)
    return np.concatenate([np.zeros(6), -np.linalg.solve(M[6:, 6:], g[6:])])


def _moving(of_base: Any) -> Any:
    """Make the base's acceleration in another way, of R, the spatial one and ω, v."""

    def wrong(model: Any, q: Any, v: Any) -> Any:
        a = tw.aba(model, q, v, np.zeros(model.nv))
        R = tw.forward_kinematics(model, q).placement[1].rotation
        return of_base(R, a, v[:3], v[3:6]), fall_in_motion(model, q, v)[1]

    return wrong


def _of_momentum(of_com: Any) -> Any:
    """Make the centre of mass's acceleration in another way."""

    def wrong(model: Any, q: Any, v: Any) -> Any:
        a = tw.aba(model, q, v, np.zeros(model.nv))
        return fall_in_motion(model, q, v)[0], of_com(model, q, v, a, sum(body.mass for body in model.inertia))

    return wrong


def _turned(model: Any, q: Any, v: Any) -> Any:
    R = tw.forward_kinematics(model, q).placement[1].rotation
    return tuple(R.mT @ x for x in fall_in_motion(model, q, v))


def _aligned(model: Any, q: Any, v: Any) -> Any:
    """Return the acceleration of the base's origin by its Jacobian, aligned with the world."""
    base, a = model.joint_names[1], tw.aba(model, q, v, np.zeros(model.nv))
    bias = tw.frame_bias_acceleration(model, q, v, base, "local_world_aligned")
    return (tw.frame_jacobian(model, q, base, "local_world_aligned") @ a + bias)[3:]


def _postures(rng: Any) -> Any:
    return [(model, model.random_configuration(rng=rng)) for model in (robot("go2"), small_robot(rng))]


def _states(rng: Any) -> Any:
    models = [robot("go2"), small_robot(rng), small_robot(rng)]
    return [(model, model.random_configuration(rng=rng), rng.standard_normal(model.nv)) for model in models]


FROM_REST = Part(
    solution=fall_from_rest,
    returns=(Quantity("q̈ by ABA", JOINT_SPACE), Quantity("q̈ as expected", JOINT_SPACE)),
    cases=_postures,
    slips={
        "gravity-compensated": lambda model, q: (np.zeros(model.nv), np.zeros(model.nv)),
        "base-held": _instead(_held),
        "bias-sign": _instead(lambda model, q: -fall_from_rest(model, q)[0]),
        "aligned-for-local": _instead(expected=lambda g, R: g),
        "rotation-forward": _instead(expected=lambda g, R: R @ g),
        "gravity-sign": _instead(expected=lambda g, R: -R.mT @ g),
        "swapped-halves": swapped(fall_from_rest),
        "base-missing": after(fall_from_rest, lambda a: a[6:]),
    },
    residuals=(
        lambda answer, model, q: (answer[0][6:], answer[1][6:]),
        lambda answer, model, q: [tw.rnea(model, q, np.zeros(model.nv), a) for a in answer],
    ),
)

IN_MOTION = Part(
    solution=fall_in_motion,
    returns=(Quantity("a of the base", unit="m/s²"), Quantity("a of the centre of mass", unit="m/s²")),
    cases=_states,
    slips={
        "classical-acceleration": _moving(lambda R, a, w, u: R @ a[3:6]),
        "cross-order": _moving(lambda R, a, w, u: R @ (a[3:6] + np.cross(u, w))),
        "untransformed": _moving(lambda R, a, w, u: a[3:6]),
        "rotation-transposed": _moving(lambda R, a, w, u: R.mT @ (a[3:6] + np.cross(w, u))),
        "angular-for-linear": _moving(lambda R, a, w, u: R @ (a[:3] + np.cross(w, u))),
        "as-at-rest": lambda model, q, v: (model.gravity, model.gravity),
        "base-for-com": lambda model, q, v: (fall_in_motion(model, q, v)[0],) * 2,
        "rate-bias-missing": _of_momentum(lambda model, q, v, a, m: (tw.centroidal_map(model, q) @ a)[3:] / m),
        "mass-not-divided": _of_momentum(lambda model, q, v, a, m: m * model.gravity),
        "gravity-sign": _of_momentum(lambda model, q, v, a, m: -model.gravity),
        "local-for-aligned": _turned,
    },
    residuals=(
        lambda answer, model, q, v: answer[0] - _aligned(model, q, v),
        lambda answer, model, q, v: answer[1] - model.gravity,
    ),
)

EXERCISE = Exercise(
    id="49.7.1",
    kind="explain",
    parts=(FROM_REST, IN_MOTION),
)
