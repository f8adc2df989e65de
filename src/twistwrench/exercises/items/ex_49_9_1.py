"""Exercise 49.9.1: what is left of the equation when a robot stands still."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import after

from ..layouts import JOINT_SPACE, WRENCH
from ..robots import robot
from ..wrong import faulty, swapped

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


def _stacked(model: Any, q: Any, rows: Any = slice(3, 6), reference: Any = "local_world_aligned") -> Any:
    """Stack other rows of the feet's Jacobians, or in other axes."""
    return np.vstack([tw.frame_jacobian(model, q, foot, reference)[rows] for foot in model.feet])


CALVES = tuple(f"{leg}_calf_joint" for leg in ("FL", "FR", "RL", "RR"))


def _cases(rng: Any) -> Any:
    model = robot("go2")
    return [
        (model, model.random_configuration(rng=rng), rng.normal(scale=5, size=12), rng.normal(scale=40, size=(4, 3)))
        for _ in range(2)
    ]


def _base_wrench(model: Any, q: Any, forces: Any) -> Any:
    """Return the wrench on the base that weight and feet amount to, from its six rows, taken to the centre of mass."""
    at_base = (_stacked(model, q).mT @ forces.ravel() - tw.gravity(model, q))[:6]
    T = tw.frame_placement(model, q, "base")
    return tw.force_transform(T.rotation, T.translation - tw.center_of_mass(model, q)) @ at_base


def _weight_at(lever: Any) -> Any:
    """Return what adds a moment of the weight, which acts at the end of a lever from the centre of mass."""

    def wrong(model: Any, q: Any, forces: Any) -> Any:
        moment = np.cross(lever(q, tw.center_of_mass(model, q)), model.mass * model.gravity)
        return net_wrench(model, q, forces) + np.concatenate([moment, np.zeros(3)])

    return wrong


def _moved(lever: Any) -> Any:
    """Return what takes the wrench about another point; the lever goes from there to the centre of mass."""
    return lambda model, q, forces: (
        tw.force_transform(np.eye(3), lever(q, tw.center_of_mass(model, q))) @ net_wrench(model, q, forces)
    )


BALANCE = Part(
    solution=out_of_balance,
    returns=(Output("g − Sᵀτ − J_cᵀλ", JOINT_SPACE),),
    cases=_cases,
    slips={
        "torques-left-out": faulty(out_of_balance, (" - S.mT @ tau", "")),
        "contact-missing": faulty(out_of_balance, (" - J_c.mT @ forces.ravel()", "")),
        "gravity-missing": faulty(out_of_balance, ("tw.gravity(model, q) - S", "-S")),
        "gravity-sign": faulty(out_of_balance, ("return tw", "return -tw")),
        "external-sign": faulty(out_of_balance, ("- J_c", "+ J_c")),
        "selection-first": faulty(out_of_balance, ("S.mT @ tau", "np.roll(S.mT @ tau, -6)")),
        "base-missing": after(out_of_balance, lambda x: x[6:]),
        "angular-for-linear": faulty(
            out_of_balance, ("tw.contact_jacobian(model, q, model.feet)", "_stacked(model, q, slice(0, 3))")
        ),
        "local-for-aligned": faulty(
            out_of_balance, ("tw.contact_jacobian(model, q, model.feet)", "_stacked(model, q, reference='local')")
        ),
        "world-for-aligned": faulty(
            out_of_balance, ("tw.contact_jacobian(model, q, model.feet)", "_stacked(model, q, reference='world')")
        ),
        "joint-for-frame": faulty(out_of_balance, ("model.feet", "CALVES")),
        "swapped-halves": swapped(out_of_balance),
        "axis-by-axis": faulty(out_of_balance, ("forces.ravel()", "forces.T.ravel()")),
        "contact-on-joints-only": faulty(out_of_balance, ("J_c.mT @", "(J_c * (np.arange(18) > 5)).mT @")),
        "contact-on-base-only": faulty(out_of_balance, ("J_c.mT @", "(J_c * (np.arange(18) < 6)).mT @")),
    },
    residuals=(lambda answer, model, q, tau, forces: answer[:6] - out_of_balance(model, q, 0 * tau, forces)[:6],),
)

NET = Part(
    solution=net_wrench,
    returns=(Output("F", WRENCH),),
    cases=lambda rng: [(model, q, forces) for model, q, _, forces in _cases(rng)],
    slips={
        "moment-about-origin": faulty(net_wrench, ("feet - p_G", "feet")),
        "base-for-com": faulty(net_wrench, ("tw.center_of_mass(model, q)", "q[:3]")),
        "lever-reversed": faulty(net_wrench, ("feet - p_G", "p_G - feet")),
        "cross-order": faulty(net_wrench, ("feet - p_G, forces", "forces, feet - p_G")),
        "coupling-dropped": faulty(net_wrench, ("moment = np", "moment = 0 * np")),
        "gravity-missing": faulty(net_wrench, (" + model.mass * model.gravity", "")),
        "weight-upward": faulty(net_wrench, ("+ model.mass", "- model.mass")),
        "mass-for-weight": faulty(net_wrench, ("model.mass * model.gravity", "np.array([0, 0, -model.mass])")),
        "one-link": faulty(net_wrench, ("model.mass", "model.inertia[1].mass")),
        "nominal-mass": faulty(net_wrench, ("model.mass", "12")),
        "averaged": lambda model, q, forces: net_wrench(model, q, forces / 4),
        "swapped-halves": swapped(net_wrench),
        "weight-at-origin": _weight_at(lambda q, p_G: -p_G),
        "weight-at-base": _weight_at(lambda q, p_G: q[:3] - p_G),
        "weight-moment-added": _weight_at(lambda q, p_G: p_G),
        "wrench-about-origin": _moved(lambda q, p_G: p_G),
        "wrench-about-base": _moved(lambda q, p_G: p_G - q[:3]),
    },
    alike=(frozenset({"lever-reversed", "cross-order"}),),
    residuals=(lambda answer, model, q, forces: answer - _base_wrench(model, q, forces),),
)

EXERCISE = Exercise(id="49.9.1", kind="explain", parts=(BALANCE, NET))
