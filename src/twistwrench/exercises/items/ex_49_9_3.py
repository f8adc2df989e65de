"""Exercise 49.9.3: the base's rows as a constraint."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import before

from ..layouts import JOINT_SPACE, WRENCH
from ..robots import robot
from ..wrong import doubled, faulty, swapped

__all__ = ["EXERCISE", "base_rows", "complete_motion"]


def base_rows(M: Any, h: Any, J_c: Any, qdd: Any, forces: Any) -> Any:
    """By how much a motion and contact forces miss the base's rows."""
    return M[:6] @ qdd + h[:6] - J_c[:, :6].mT @ forces


def complete_motion(M: Any, h: Any, J_c: Any, qdd_joints: Any, forces: Any) -> Any:
    """Accelerations and torques that go with the joints' accelerations and the contact forces."""
    given = J_c[:, :6].mT @ forces - h[:6] - M[:6, 6:] @ qdd_joints
    qdd = np.concatenate([np.linalg.solve(M[:6, :6], given), qdd_joints])
    tau = M[6:] @ qdd + h[6:] - J_c[:, 6:].mT @ forces
    return qdd, tau


def _cases(rng: Any) -> Any:
    model, cases = robot("go2"), []
    for _ in range(3):
        q, v = model.random_configuration(rng=rng), rng.standard_normal(18)
        J_c = tw.contact_jacobian(model, q, model.feet)
        h = tw.nonlinear_effects(model, q, v)
        cases.append((tw.crba(model, q), h, J_c, rng.standard_normal(18), rng.normal(scale=40, size=12)))
    return cases


def _joints_only(rng: Any) -> Any:
    return [(M, h, J_c, qdd[6:], forces) for M, h, J_c, qdd, forces in _cases(rng)]


def _by_axis(forces: Any) -> Any:
    """Take x of all feet to come first, then y, then z."""
    return forces.reshape(3, 4).mT.ravel()


ROWS = Part(
    solution=base_rows,
    returns=(Output("M_b q̈ + h_b − J_cbᵀλ", WRENCH),),
    cases=_cases,
    slips={
        "joints-missing": faulty(base_rows, ("M[:6] @ qdd", "M[:6, :6] @ qdd[:6]")),
        "bias-for-zero": faulty(base_rows, (" + h[:6]", "")),
        "bias-sign": faulty(base_rows, ("+ h[:6]", "- h[:6]")),
        "contact-missing": faulty(base_rows, (" - J_c[:, :6].mT @ forces", "")),
        "external-sign": faulty(base_rows, ("- J_c", "+ J_c")),
        "base-missing": lambda M, h, J_c, qdd, forces: (M @ qdd + h - J_c.mT @ forces)[6:],
        "one-triangle": before(base_rows, np.triu, which=0),
        "doubled-off-diagonal": before(base_rows, doubled, which=0),
        "swapped-halves": swapped(base_rows),
        "axis-by-axis": before(base_rows, _by_axis, which=4),
        "forces-merely-summed": faulty(
            base_rows, ("J_c[:, :6].mT @ forces", "np.concatenate([np.zeros(3), forces.reshape(-1, 3).sum(0)])")
        ),
    },
)

COMPLETE = Part(
    solution=complete_motion,
    returns=(Output("q̈", JOINT_SPACE), Output("τ", unit="N m")),
    cases=_joints_only,
    slips={
        "joints-missing": faulty(complete_motion, (" - M[:6, 6:] @ qdd_joints", "")),
        "base-acceleration-missing": faulty(complete_motion, ("M[6:] @ qdd +", "M[6:, 6:] @ qdd_joints +")),
        "base-held": faulty(complete_motion, ("np.linalg.solve(M[:6, :6], given)", "np.zeros(6)")),
        "base-and-joints-apart": faulty(
            complete_motion,
            (" - M[:6, 6:] @ qdd_joints", ""),
            ("M[6:] @ qdd +", "M[6:, 6:] @ qdd_joints +"),
        ),
        "contact-missing": before(complete_motion, lambda forces: 0 * forces, which=4),
        "contact-on-base-only": faulty(complete_motion, (" - J_c[:, 6:].mT @ forces", "")),
        "bias-for-zero": before(complete_motion, lambda h: 0 * h, which=1),
        "bias-sign": before(complete_motion, lambda h: -h, which=1),
        "external-sign": before(complete_motion, lambda forces: -forces, which=4),
        "one-triangle": before(complete_motion, np.triu, which=0),
        "doubled-off-diagonal": before(complete_motion, doubled, which=0),
        "axis-by-axis": before(complete_motion, _by_axis, which=4),
        "contact-on-joints-only": faulty(complete_motion, ("J_c[:, :6].mT @ forces - h", "-h")),
    },
    residuals=(
        lambda answer, M, h, J_c, qdd_joints, forces: (
            M @ answer[0] + h - np.concatenate([np.zeros(6), answer[1]]) - J_c.mT @ forces
        ),
        lambda answer, M, h, J_c, qdd_joints, forces: answer[0][6:] - qdd_joints,
    ),
)

EXERCISE = Exercise(id="49.9.3", kind="explain", parts=(ROWS, COMPLETE))
