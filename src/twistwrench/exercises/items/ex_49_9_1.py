"""Exercise 49.9.1: what is left of the equation when a robot stands still."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Quantity
from ..layouts import JOINT_SPACE, WRENCH
from ..robots import robot
from ..wrong import after, swapped

__all__ = ["EXERCISE", "net_wrench", "out_of_balance"]


def out_of_balance(model: Any, q: Any, tau: Any, forces: Any) -> Any:
    """Leftover of g = Sᵀτ + J_cᵀλ."""
    S = tw.selection_matrix(model)
    J_c = tw.contact_jacobian(model, q, model.feet)
    return tw.gravity(model, q) - S.mT @ tau - J_c.mT @ forces.ravel()


def net_wrench(model: Any, q: Any, forces: Any) -> Any:
    """Wrench of weight and feet about the centre of mass."""
    p_G = tw.center_of_mass(model, q)
    feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])
    moment = np.cross(feet - p_G, forces).sum(0)
    return np.concatenate([moment, forces.sum(0) + model.mass * model.gravity])


def _terms(model: Any, q: Any, tau: Any, forces: Any) -> Any:
    """Return g, Sᵀτ and J_cᵀλ."""
    on_joints = np.concatenate([np.zeros(6), tau])
    return tw.gravity(model, q), on_joints, _carried(model, q, forces)


def _carried(model: Any, q: Any, forces: Any, rows: Any = slice(3, 6), **where: Any) -> Any:
    """Return J_cᵀλ, with chosen rows and reference of the Jacobians."""
    frames = where.pop("frames", model.feet)
    where = where or {"reference": "local_world_aligned"}
    return sum(tw.frame_jacobian(model, q, name, **where)[rows].mT @ f for name, f in zip(frames, forces))


def _left(combine: Any) -> Any:
    """Combine g, Sᵀτ and J_cᵀλ wrongly."""
    return lambda model, q, tau, forces: combine(*_terms(model, q, tau, forces))


def _jacobian(rows: Any = slice(3, 6), **where: Any) -> Any:
    """Take other Jacobians."""

    def wrong(model: Any, q: Any, tau: Any, forces: Any) -> Any:
        g, on_joints, _ = _terms(model, q, tau, 0 * forces)
        return g - on_joints - _carried(model, q, forces, rows, **where)

    return wrong


CALVES = tuple(f"{leg}_calf_joint" for leg in ("FL", "FR", "RL", "RR"))


def _about(point: Any) -> Any:
    """Take the moments about another point; the weight then has a moment, which is left out."""

    def wrong(model: Any, q: Any, forces: Any) -> Any:
        feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])
        answer = net_wrench(model, q, forces)
        answer[:3] = np.cross(feet - point(model, q), forces).sum(0)
        return answer

    return wrong


def _weight(weight: Any) -> Any:
    """Take another weight."""

    def wrong(model: Any, q: Any, forces: Any) -> Any:
        answer = net_wrench(model, q, forces)
        answer[3:] = forces.sum(0) + weight(model)
        return answer

    return wrong


def _cases(rng: Any) -> Any:
    model = robot("go2")
    return [
        (model, model.random_configuration(rng=rng), rng.normal(scale=5, size=12), rng.normal(scale=40, size=(4, 3)))
        for _ in range(2)
    ]


def _of_base(model: Any, q: Any, forces: Any) -> Any:
    """Return the wrench on the base that weight and feet amount to, from its six rows, taken to the centre of mass."""
    at_base = (_carried(model, q, forces) - tw.gravity(model, q))[:6]
    T = tw.frame_placement(model, q, "base")
    return tw.force_transform(T.rotation, T.translation - tw.center_of_mass(model, q)) @ at_base


BALANCE = Part(
    solution=out_of_balance,
    returns=(Quantity("g − Sᵀτ − J_cᵀλ", JOINT_SPACE),),
    cases=_cases,
    slips={
        "torques-left-out": _left(lambda g, joints, feet: g - feet),
        "contact-missing": _left(lambda g, joints, feet: g - joints),
        "gravity-missing": _left(lambda g, joints, feet: -joints - feet),
        "gravity-sign": _left(lambda g, joints, feet: -g - joints - feet),
        "external-sign": _left(lambda g, joints, feet: g - joints + feet),
        "selection-first": _left(lambda g, joints, feet: g - np.concatenate([joints[6:], np.zeros(6)]) - feet),
        "base-missing": after(out_of_balance, lambda x: x[6:]),
        "angular-for-linear": _jacobian(slice(0, 3), reference="local_world_aligned"),
        "local-for-aligned": _jacobian(reference="local"),
        "world-for-aligned": _jacobian(reference="world"),
        "joint-for-frame": _jacobian(frames=CALVES),
        "swapped-halves": swapped(out_of_balance),
    },
    residuals=(lambda answer, model, q, tau, forces: answer[:6] - out_of_balance(model, q, 0 * tau, forces)[:6],),
)

NET = Part(
    solution=net_wrench,
    returns=(Quantity("F", WRENCH),),
    cases=lambda rng: [(model, q, forces) for model, q, _, forces in _cases(rng)],
    slips={
        "moment-about-origin": _about(lambda model, q: np.zeros(3)),
        "base-for-com": _about(lambda model, q: q[:3]),
        "lever-reversed": after(net_wrench, lambda F: F * np.repeat([-1, 1], 3)),
        "cross-order": after(net_wrench, lambda F: F * np.repeat([-1, 1], 3)),
        "coupling-dropped": after(net_wrench, lambda F: F * np.repeat([0, 1], 3)),
        "gravity-missing": _weight(lambda model: 0 * model.gravity),
        "weight-upward": _weight(lambda model: -model.mass * model.gravity),
        "mass-for-weight": _weight(lambda model: np.array([0, 0, -model.mass])),
        "one-link": _weight(lambda model: model.inertia[1].mass * model.gravity),
        "nominal-mass": _weight(lambda model: 12 * model.gravity),
        "averaged": lambda model, q, forces: net_wrench(model, q, forces / 4),
        "swapped-halves": swapped(net_wrench),
    },
    alike=(frozenset({"lever-reversed", "cross-order"}),),
    residuals=(lambda answer, model, q, forces: answer - _of_base(model, q, forces),),
)

EXERCISE = Exercise(
    id="49.9.1",
    kind="explain",
    parts=(BALANCE, NET),
)
