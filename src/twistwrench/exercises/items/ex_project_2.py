"""The project, stage 2: the whole-body dynamics."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import before

from ..layouts import JOINT_SPACE
from ..robots import robot, small_robot
from ..wrong import doubled, faulty
from .project_aba import ABA
from .project_crba import CRBA
from .project_rnea import ENERGY, RNEA

__all__ = ["EXERCISE", "accelerated", "rows_of_foot"]


def rows_of_foot(J: Any, R: Any, r: Any) -> Any:
    """Contact rows of a foot, out of the Jacobian of the body that carries it."""
    return R @ (J[3:] - tw.skew(r) @ J[:3])


def accelerated(M: Any, h: Any, S: Any, J_c: Any, tau: Any, forces: Any) -> Any:
    """Accelerations under torques and contact forces."""
    return np.linalg.solve(M, S.mT @ tau + J_c.mT @ forces - h)


def _feet(rng: Any) -> Any:
    model, cases = robot("go2"), []
    for foot in ("FL_foot", "RR_foot"):
        q, frame = model.random_configuration(rng=rng), model.frame(foot)
        T = tw.forward_kinematics(model, q).placement[frame.body]
        J = tw.frame_jacobian(model, q, model.joint_names[frame.body])
        cases.append((J, T.rotation, np.array(frame.placement.translation)))
    other = small_robot(rng)
    q = other.random_configuration(rng=rng)
    R = tw.forward_kinematics(other, q).placement[3].rotation
    return [*cases, (tw.frame_jacobian(other, q, other.joint_names[3]), R, rng.standard_normal(3))]


def _equations(rng: Any) -> Any:
    model, cases = robot("go2"), []
    for _ in range(2):
        q, v = model.random_configuration(rng=rng), rng.standard_normal(18)
        M, h, J_c = tw.crba(model, q), tw.nonlinear_effects(model, q, v), tw.contact_jacobian(model, q, model.feet)
        S, loads = tw.selection_matrix(model), rng.normal(scale=10, size=(2, 12))
        cases.append((M, h, S, J_c, *loads))
    (M, h, S, *rest) = cases[0]
    return [*cases, (M, h, S[rng.permutation(12)], *rest)]  # motors that are numbered otherwise


BASE = np.arange(18) < 6

FOOT = Part(
    solution=rows_of_foot,
    returns=(Output("rows of J_c", zh="J_c 的各行"),),
    cases=_feet,
    slips={
        "angular-for-linear": lambda J, R, r: R @ J[:3],
        "joint-for-frame": lambda J, R, r: R @ J[3:],
        "cross-order": lambda J, R, r: R @ (J[3:] + tw.skew(r) @ J[:3]),
        "local-for-aligned": lambda J, R, r: J[3:] - tw.skew(r) @ J[:3],
        "rotation-transposed": lambda J, R, r: R.mT @ (J[3:] - tw.skew(r) @ J[:3]),
        "coupling-unrotated": lambda J, R, r: R @ J[3:] - tw.skew(r) @ J[:3],
        "lever-of-link": lambda J, R, r: R @ J[3:] - tw.skew(r) @ R @ J[:3],
        "swapped-halves": lambda J, R, r: R @ (J[:3] - tw.skew(r) @ J[3:]),
    },
)

EQUATION = Part(
    solution=accelerated,
    returns=(Output("q̈", JOINT_SPACE),),
    cases=_equations,
    slips={
        "contact-missing": faulty(accelerated, (" + J_c.mT @ forces", "")),
        "force-sign": faulty(accelerated, ("+ J_c", "- J_c")),
        "torques-missing": faulty(accelerated, ("S.mT @ tau + ", "")),
        "bias-for-zero": faulty(accelerated, (" - h", "")),
        "bias-sign": faulty(accelerated, ("- h", "+ h")),
        "selection-assumed": faulty(accelerated, ("S.mT @ tau", "np.concatenate([np.zeros(6), tau])")),
        "selection-transposed": faulty(accelerated, ("S.mT @ tau", "np.concatenate([np.zeros(6), S[:, 6:] @ tau])")),
        "selection-first": faulty(accelerated, ("S.mT @ tau", "np.roll(S.mT @ tau, -6)")),
        "joints-missing": before(accelerated, lambda M: M * (BASE[:, None] == BASE), which=0),
        "one-triangle": before(accelerated, np.triu, which=0),
        "doubled-off-diagonal": before(accelerated, doubled, which=0),
    },
    residuals=(lambda answer, M, h, S, J_c, tau, forces: M @ answer + h - S.mT @ tau - J_c.mT @ forces,),
)

EXERCISE = Exercise(id="project.2", kind="code", parts=(RNEA, ENERGY, CRBA, ABA, FOOT, EQUATION))
