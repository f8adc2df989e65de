"""Exercise 49.6.2: gravity as an acceleration, and as forces."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import negated

from ...model import random_tree
from ..layouts import WRENCH
from ..public import mine
from ..robots import small_robot, states, weightless
from ..wrong import faulty, swapped

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


def _motions(rng: Any) -> Any:
    return [
        (model, weightless(model), model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv)))
        for model in (small_robot(rng), small_robot(rng), random_tree(4, rng=rng))
    ]


def _postures(rng: Any) -> Any:
    """Return Go2 and a small robot, and one whose base is fixed."""
    fixed = random_tree(4, rng=rng)
    return [*states(rng, small=1), (fixed, fixed.random_configuration(rng=rng))]


def _centred(rng: Any) -> Any:
    """Return a robot with a body whose centre of mass is at its origin."""
    model = random_tree(4, rng=rng)
    body = model.inertia[2]
    centred = tw.SpatialInertia(body.mass, np.zeros(3), body.inertia_at_com)
    other = tw.replace_inertia(model, model.joint_names[2], centred)
    return [(other, model.random_configuration(rng=rng))]


WEIGHTS = Part(
    solution=weight_wrenches,
    returns=(Output("W", WRENCH),),
    cases=_postures,
    edges=_centred,
    slips={
        "moment-dropped": faulty(weight_wrenches, ("np.cross(body.com, force)", "np.zeros(3)")),
        "moment-unturned": faulty(weight_wrenches, ("np.cross(", "placement[i].rotation @ np.cross(")),
        "weight-unturned": faulty(weight_wrenches, ("body.com, force", "body.com, body.mass * model.gravity")),
        "lever-from-origin": faulty(
            weight_wrenches, ("(body.com,", "(body.com + placement[i].rotation.mT @ placement[i].translation,")
        ),
        "untransformed": faulty(weight_wrenches, ("placement[i].rotation.mT @ ", "")),
        "aligned-for-local": faulty(
            weight_wrenches, ("placement[i].rotation.mT @ ", ""), ("np.cross(", "np.cross(placement[i].rotation @ ")
        ),
        "rotation-forward": faulty(weight_wrenches, ("rotation.mT", "rotation")),
        "cross-order": faulty(weight_wrenches, ("body.com, force", "force, body.com")),
        "mass-dropped": faulty(weight_wrenches, ("body.mass * ", "")),
        "wrench-about-world": faulty(weight_wrenches, ("W[i] = np", "W[i] = placement[i].force_transform() @ np")),
        "weight-upward": negated(weight_wrenches),
        "swapped-halves": faulty(
            weight_wrenches, ("np.cross(body.com, force), force", "force, np.cross(body.com, force)")
        ),
        "base-weightless": faulty(weight_wrenches, ("range(1,", "range(2,")),
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
    returns=(
        Output("τ with a₀ = −g", zh="取 a₀ = −g 时的 τ"),
        Output("τ with weights", zh="把重力作为外力时的 τ"),
    ),  # the base may be fixed
    cases=_motions,
    slips={
        "gravity-missing": faulty(gravity_two_ways, (", f_ext=W(model, q)", "")),
        "as-at-rest": lambda model, weightless, q, v, a: gravity_two_ways(model, weightless, q, 0 * v, 0 * a),
        "external-sign": faulty(gravity_two_ways, ("f_ext=W", "f_ext=-W")),
        "gravity-twice": lambda model, weightless, q, v, a: gravity_two_ways(model, model, q, v, a),
        "base-weightless": faulty(
            gravity_two_ways, ("W(model, q)", "W(model, q) * (np.arange(model.nbodies) != 1)[:, None]")
        ),
        "swapped-halves": swapped(gravity_two_ways),
    },
    residuals=(lambda answer, model, weightless, q, v, a: answer[0] - answer[1],),
)

EXERCISE = Exercise(id="49.6.2", kind="prove", parts=(WEIGHTS, TWO_WAYS))
