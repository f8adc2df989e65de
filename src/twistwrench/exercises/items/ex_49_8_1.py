"""Exercise 49.8.1: the base's block of the mass matrix."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import after, before

from ..layouts import INERTIA
from ..robots import robot
from ..wrong import faulty, swap, swapped

__all__ = ["EXERCISE", "base_block", "whole_robot"]


def base_block(model: Any, q: Any) -> Any:
    """Inertia of all bodies together, about the base's origin."""
    placement = tw.forward_kinematics(model, q).placement
    base = placement[1].inverse()
    block = np.zeros((6, 6))
    for body, T in zip(model.inertia, placement):
        block = block + body.transform(base @ T).matrix()
    return block


def _by_transforms(model: Any, q: Any) -> Any:
    placement = tw.forward_kinematics(model, q).placement
    block = np.zeros((6, 6))
    for i in range(1, model.nbodies):
        X = (placement[i].inverse() @ placement[1]).motion_transform()
        block = block + X.mT @ model.inertia[i].matrix() @ X
    return block


def whole_robot(block: Any) -> Any:
    """Mass, centre of mass and inertia about it, out of a spatial inertia."""
    m = block[3, 3]
    c = tw.unskew(block[:3, 3:]) / m
    return m, c, block[:3, :3] + m * tw.skew(c) @ tw.skew(c)


def _moved(body: Any, T: Any, R: Any) -> Any:
    """Place a body by T, but turn its inertia about the centre of mass by R."""
    c = T.rotation @ body.com + T.translation
    return tw.SpatialInertia(body.mass, c, R @ body.inertia_at_com @ R.mT).matrix()


def _without_term(body: Any) -> Any:
    """Leave the parallel-axis term out of the inertia of a body."""
    matrix = body.matrix()
    matrix[:3, :3] = body.inertia_at_com
    return matrix


def _about_the_origin(T: Any, base: Any) -> Any:
    """Return a placement seen from a frame at the base with the axes of the world."""
    return tw.SE3(T.rotation, T.translation - base.translation)


def _parts(change: Any) -> Any:
    """Rebuild the block from its four quarters: I, the coupling m [c]×, its negative, m·1."""

    def wrong(model: Any, q: Any) -> Any:
        block = base_block(model, q)
        return np.block(change(block[:3, :3], block[:3, 3:], block[3:, 3:]))

    return wrong


def _blocks(rng: Any) -> Any:
    """Return blocks with the centre of mass at the origin, and near it; and one in whole numbers."""
    half = rng.standard_normal((3, 3))
    bodies = [tw.SpatialInertia(2.0, c * np.ones(3), half @ half.mT + np.eye(3)) for c in (0, 4e-4)]
    whole = np.rint(tw.SpatialInertia(3.0, np.ones(3) / 3, np.eye(3) * 4 / 3).matrix()).astype(int)
    return [*((body.matrix(),) for body in bodies), (whole,)]


def _cases(rng: Any) -> Any:
    model, tree = robot("go2"), tw.random_tree(5, rng=rng, base="floating")
    return [
        (model, model.neutral()),
        (model, model.random_configuration(rng=rng)),
        (tree, tree.random_configuration(rng=rng)),
    ]


BLOCK = Part(
    solution=base_block,
    ways=(_by_transforms,),
    returns=(Output("M_bb", INERTIA),),
    cases=_cases,
    edges=lambda rng: [(tw.chain(6, base="floating"), np.concatenate([np.zeros(6), [1.0], rng.standard_normal(5)]))],
    slips={
        "legs-left-out": lambda model, q: model.inertia[1].matrix(),
        "untransformed": faulty(base_block, ("body.transform(base @ T).matrix()", "body.matrix()")),
        "world-for-local": faulty(base_block, ("base @ T", "T")),
        "aligned-for-local": faulty(base_block, ("base @ T", "_about_the_origin(T, placement[1])")),
        "lever-unrotated": faulty(
            base_block, ("base @ T", "tw.SE3((base @ T).rotation, T.translation - placement[1].translation)")
        ),
        "inertia-in-world-axes": faulty(
            base_block, ("body.transform(base @ T).matrix()", "_moved(body, base @ T, T.rotation)")
        ),
        "inertia-unturned": faulty(
            base_block, ("body.transform(base @ T).matrix()", "_moved(body, base @ T, np.eye(3))")
        ),
        "inverse-transform": faulty(base_block, ("base @ T", "(base @ T).inverse()")),
        "inertia-like-motion": faulty(
            base_block,
            (
                "body.transform(base @ T).matrix()",
                "(base @ T).motion_transform() @ body.matrix() @ (base @ T).inverse().motion_transform()",
            ),
        ),
        "inertia-half-rotated": faulty(
            base_block, ("body.transform(base @ T).matrix()", "(base @ T).force_transform() @ body.matrix()")
        ),
        "parallel-axis-dropped": _parts(
            lambda I, mc, m: [[I + mc @ mc / m[0, 0], mc], [-mc, m]],
        ),
        "parallel-axis-of-bodies": faulty(
            base_block, ("body.transform(base @ T).matrix()", "_without_term(body.transform(base @ T))")
        ),
        "coupling-dropped": _parts(lambda I, mc, m: [[I, 0 * mc], [0 * mc, m]]),
        "com-dropped": _parts(lambda I, mc, m: [[I + mc @ mc / m[0, 0], 0 * mc], [0 * mc, m]]),
        "com-sign": _parts(lambda I, mc, m: [[I, -mc], [mc, m]]),
        "inertia-asymmetric": _parts(lambda I, mc, m: [[I, mc], [mc, m]]),
        "swapped-halves": swapped(base_block),
        "one-triangle": after(base_block, np.triu),
        "doubled-off-diagonal": after(base_block, lambda M: M + M.mT - np.diag(np.diag(M))),
    },
    residuals=(
        lambda answer, model, q: answer - answer.mT,
        lambda answer, model, q: answer[3:, 3:] - model.mass * np.eye(3),
        lambda answer, model, q: [
            V @ answer @ V / 2
            - tw.newton_euler_3d.kinetic_energy(model, q, np.concatenate([V, np.zeros(model.nv - 6)]))
            for V in np.random.default_rng(0).standard_normal((3, 6))
        ],
    ),
)

WHOLE = Part(
    solution=whole_robot,
    returns=(Output("m", unit="kg"), Output("c", unit="m"), Output("I_c", unit="kg m²")),
    cases=lambda rng: [(base_block(*case),) for case in _cases(rng)],
    edges=_blocks,
    slips={
        "mass-dropped": faulty(whole_robot, (" / m", "")),
        "com-sign": lambda block: (block[3, 3], -whole_robot(block)[1], whole_robot(block)[2]),
        "parallel-axis-sign": faulty(whole_robot, ("+ m", "- m")),
        "parallel-axis-dropped": faulty(whole_robot, (" + m * tw.skew(c) @ tw.skew(c)", "")),
        "parallel-axis-all": faulty(whole_robot, ("+ m * tw.skew(c) @ tw.skew(c)", "- m * (c @ c) * np.eye(3)")),
        "parallel-axis-outer": faulty(whole_robot, ("+ m * tw.skew(c) @ tw.skew(c)", "- m * np.outer(c, c)")),
        "swapped-halves": before(whole_robot, swap, which=0),
    },
    residuals=(lambda answer, block: tw.SpatialInertia(*answer).matrix() - block,),
)

EXERCISE = Exercise(id="49.8.1", kind="explain", parts=(BLOCK, WHOLE))
