"""Exercise 49.6.2: gravity as an acceleration, and as forces."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Quantity
from ..layouts import JOINT_SPACE, WRENCH
from ..robots import robot, small_robot, weightless
from ..workbook import mine
from ..wrong import negated, swap, swapped

__all__ = ["EXERCISE", "gravity_two_ways", "weight_wrenches"]


def weight_wrenches(model: Any, q: Any) -> Any:
    """Weight of each body as a wrench in its own frame."""
    placement = tw.forward_kinematics(model, q).placement
    W = np.zeros((model.nbodies, 6))
    for i in range(1, model.nbodies):
        body = model.inertia[i]
        force = body.mass * placement[i].rotation.mT @ model.gravity
        W[i] = np.concatenate([np.cross(body.com, force), force])
    return W


def gravity_two_ways(model: Any, weightless: Any, q: Any, v: Any, a: Any) -> Any:
    """Joint forces with the world rising, and with a weight on each body."""
    W = mine("weight_wrenches")
    return tw.rnea(model, q, v, a), tw.rnea(weightless, q, v, a, f_ext=W(model, q))


def _weights(model: Any, q: Any, wrench: Any) -> Any:
    """Make the row of each body out of mass, centre of mass, R and g."""
    placement = tw.forward_kinematics(model, q).placement
    rows = [wrench(body.mass, body.com, T.rotation, model.gravity) for body, T in zip(model.inertia[1:], placement[1:])]
    return np.array([np.zeros(6), *(np.concatenate(row) for row in rows)])


def _about_world(model: Any, q: Any) -> Any:
    """Take each wrench to the world frame."""
    placement = tw.forward_kinematics(model, q).placement
    return np.array([T.force_transform() @ F for T, F in zip(placement, weight_wrenches(model, q))])


def _without_base(model: Any, q: Any) -> Any:
    W = weight_wrenches(model, q)
    W[1] = 0
    return W


def _postures(rng: Any) -> Any:
    return [(model, model.random_configuration(rng=rng)) for model in (robot("go2"), small_robot(rng))]


def _motions(rng: Any) -> Any:
    return [
        (model, weightless(model), model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv)))
        for model in (small_robot(rng), small_robot(rng))
    ]


def _second(f_ext: Any) -> Any:
    """Use other outside wrenches in the second way."""

    def wrong(model: Any, weightless: Any, q: Any, v: Any, a: Any) -> Any:
        return tw.rnea(model, q, v, a), tw.rnea(weightless, q, v, a, f_ext=f_ext(model, q))

    return wrong


WEIGHTS = Part(
    solution=weight_wrenches,
    returns=(Quantity("W", WRENCH),),
    cases=_postures,
    slips={
        "moment-dropped": lambda model, q: _weights(model, q, lambda m, c, R, g: (np.zeros(3), m * R.mT @ g)),
        "untransformed": lambda model, q: _weights(model, q, lambda m, c, R, g: (np.cross(c, m * g), m * g)),
        "aligned-for-local": lambda model, q: _weights(model, q, lambda m, c, R, g: (np.cross(R @ c, m * g), m * g)),
        "rotation-forward": lambda model, q: _weights(model, q, lambda m, c, R, g: (np.cross(c, m * R @ g), m * R @ g)),
        "cross-order": lambda model, q: _weights(
            model, q, lambda m, c, R, g: (np.cross(m * R.mT @ g, c), m * R.mT @ g)
        ),
        "mass-dropped": lambda model, q: _weights(model, q, lambda m, c, R, g: (np.cross(c, R.mT @ g), R.mT @ g)),
        "wrench-about-world": _about_world,
        "weight-upward": negated(weight_wrenches),
        "swapped-halves": lambda model, q: np.array([swap(F) for F in weight_wrenches(model, q)]),
        "base-weightless": _without_base,
    },
    residuals=(
        lambda answer, model, q: [F[:3] - np.cross(body.com, F[3:]) for body, F in zip(model.inertia, answer)],
        lambda answer, model, q: (
            sum(T.rotation @ F[3:] for T, F in zip(tw.forward_kinematics(model, q).placement, answer))
            - sum(body.mass for body in model.inertia) * model.gravity
        ),
    ),
)

TWO_WAYS = Part(
    solution=gravity_two_ways,
    given='W = mine("weight_wrenches")',
    returns=(Quantity("τ with a₀ = −g", JOINT_SPACE), Quantity("τ with weights", JOINT_SPACE)),
    cases=_motions,
    slips={
        "gravity-missing": _second(lambda model, q: np.zeros((model.nbodies, 6))),
        "external-sign": _second(lambda model, q: -weight_wrenches(model, q)),
        "gravity-twice": lambda model, weightless, q, v, a: gravity_two_ways(model, model, q, v, a),
        "base-weightless": _second(_without_base),
        "swapped-halves": swapped(gravity_two_ways),
    },
    residuals=(lambda answer, model, weightless, q, v, a: answer[0] - answer[1],),
)

EXERCISE = Exercise(
    id="49.6.2",
    kind="prove",
    parts=(WEIGHTS, TWO_WAYS),
)
