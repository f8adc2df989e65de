"""Exercise 49.9.3: the base's rows as a constraint."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Quantity
from ..layouts import JOINT_SPACE, WRENCH
from ..robots import robot
from ..wrong import swapped

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


def _uncoupled(M: Any) -> Any:
    """Return M without what couples base and joints."""
    M = M.copy()
    M[:6, 6:], M[6:, :6] = 0, 0
    return M


def _held(M: Any, h: Any, J_c: Any, qdd_joints: Any, forces: Any) -> Any:
    """Keep the base from accelerating."""
    qdd = np.concatenate([np.zeros(6), qdd_joints])
    return qdd, (M @ qdd + h - J_c.mT @ forces)[6:]


def _rowless(M: Any, h: Any, J_c: Any, qdd_joints: Any, forces: Any) -> Any:
    """Leave the base's acceleration out of the joint rows."""
    qdd, _ = complete_motion(M, h, J_c, qdd_joints, forces)
    return qdd, M[6:, 6:] @ qdd_joints + h[6:] - J_c[:, 6:].mT @ forces


def _uncoupled_above(M: Any, h: Any, J_c: Any, qdd_joints: Any, forces: Any) -> Any:
    """Leave the joints' acceleration out of the base's rows."""
    qdd = np.concatenate([np.linalg.solve(M[:6, :6], J_c[:, :6].mT @ forces - h[:6]), qdd_joints])
    return qdd, (M @ qdd + h - J_c.mT @ forces)[6:]


def _forceless(M: Any, h: Any, J_c: Any, qdd_joints: Any, forces: Any) -> Any:
    """Leave the contact forces out of the torques."""
    qdd, tau = complete_motion(M, h, J_c, qdd_joints, forces)
    return qdd, tau + J_c[:, 6:].mT @ forces


ROWS = Part(
    solution=base_rows,
    returns=(Quantity("M_b q̈ + h_b − J_cbᵀλ", WRENCH),),
    cases=_cases,
    slips={
        "joints-missing": lambda M, h, J_c, qdd, forces: base_rows(_uncoupled(M), h, J_c, qdd, forces),
        "bias-for-zero": lambda M, h, J_c, qdd, forces: base_rows(M, 0 * h, J_c, qdd, forces),
        "bias-sign": lambda M, h, J_c, qdd, forces: base_rows(M, -h, J_c, qdd, forces),
        "contact-missing": lambda M, h, J_c, qdd, forces: base_rows(M, h, J_c, qdd, 0 * forces),
        "external-sign": lambda M, h, J_c, qdd, forces: base_rows(M, h, J_c, qdd, -forces),
        "base-missing": lambda M, h, J_c, qdd, forces: (M @ qdd + h - J_c.mT @ forces)[6:],
        "one-triangle": lambda M, h, J_c, qdd, forces: base_rows(np.tril(M), h, J_c, qdd, forces),
        "doubled-off-diagonal": lambda M, h, J_c, qdd, forces: base_rows(
            2 * M - np.diag(np.diag(M)), h, J_c, qdd, forces
        ),
        "swapped-halves": swapped(base_rows),
    },
)

COMPLETE = Part(
    solution=complete_motion,
    returns=(Quantity("q̈", JOINT_SPACE), Quantity("τ", unit="N m")),
    cases=_joints_only,
    slips={
        "joints-missing": _uncoupled_above,
        "base-acceleration-missing": _rowless,
        "base-held": _held,
        "contact-missing": _forceless,
        "bias-for-zero": lambda M, h, J_c, qdd_joints, forces: complete_motion(M, 0 * h, J_c, qdd_joints, forces),
        "bias-sign": lambda M, h, J_c, qdd_joints, forces: complete_motion(M, -h, J_c, qdd_joints, forces),
        "external-sign": lambda M, h, J_c, qdd_joints, forces: complete_motion(M, h, J_c, qdd_joints, -forces),
        "one-triangle": lambda M, h, J_c, qdd_joints, forces: complete_motion(np.triu(M), h, J_c, qdd_joints, forces),
        "doubled-off-diagonal": lambda M, h, J_c, qdd_joints, forces: complete_motion(
            2 * M - np.diag(np.diag(M)), h, J_c, qdd_joints, forces
        ),
    },
    residuals=(
        lambda answer, M, h, J_c, qdd_joints, forces: (
            M @ answer[0] + h - np.concatenate([np.zeros(6), answer[1]]) - J_c.mT @ forces
        ),
        lambda answer, M, h, J_c, qdd_joints, forces: answer[0][6:] - qdd_joints,
    ),
)

EXERCISE = Exercise(
    id="49.9.3",
    kind="explain",
    parts=(ROWS, COMPLETE),
)
