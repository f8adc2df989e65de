"""Exercise 49.11.1: the seven tests of the chapter's listing, mended."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.faults import after, before

from ..layouts import CONTACT_JACOBIAN, JOINT_SPACE
from ..robots import robot
from ..wrong import doubled, faulty, swap
from .pinocchio_order import ACTION, INERTIA_MATRIX

__all__ = [
    "EXERCISE",
    "by_mass_matrix",
    "com_velocity",
    "contact_rows",
    "finite_limits",
]


def finite_limits(lower: Any, upper: Any) -> Any:
    """Limits to draw a configuration from."""
    return np.where(np.isfinite(lower), lower, -1.0), np.where(np.isfinite(upper), upper, 1.0)


def by_mass_matrix(M: Any, h: Any, a: Any, tau: Any) -> Any:
    """M a + h and M⁻¹ (τ − h) (tests 1 and 2)."""
    return M @ a + h, np.linalg.solve(M, tau - h)


def com_velocity(h_G: Any, m: Any) -> Any:
    """Velocity of the centre of mass (test 6)."""
    return h_G[:3] / m


def contact_rows(J: Any) -> Any:
    """Contact Jacobian of four feet (test 7)."""
    return np.vstack([J_foot[:3] for J_foot in J])


def _limits(rng: Any) -> Any:
    """Return limits as Pinocchio has them: of a free-flyer, of joints, of another free-flyer; and one-sided ones."""
    free = np.array([np.inf] * 3 + [1.01] * 4)
    joints = rng.uniform(0.5, 3, (3, 12))
    tails = [joints[0], np.concatenate([joints[1, :4], free]), joints[2]]
    limits = [
        (-np.concatenate([free, tail]), np.concatenate([free, tail * rng.uniform(0.2, 1, len(tail))])) for tail in tails
    ]
    limits[2][0][-2], limits[2][1][-1] = -np.inf, np.inf
    limits[0][1][-1] = 0.3 * limits[0][0][-1]  # a knee: both limits are negative
    sizes = [*rng.uniform(1, 3) * np.array([0, *10.0 ** np.array([*range(-6, 9, 3), 300])]), np.finfo(float).max / 2]
    return [*limits, *((np.array([-np.inf, -x, x]), np.array([x, np.inf, 2 * x])) for x in sizes)]


def _dynamics(rng: Any) -> Any:
    """Return M, h, a and τ of Go2, in Pinocchio's order."""
    model, cases = robot("go2"), []
    for _ in range(2):
        q, (v, a, tau) = model.random_configuration(rng=rng), rng.standard_normal((3, 18))
        cases.append((swap(tw.crba(model, q)), swap(tw.nonlinear_effects(model, q, v)), swap(a), swap(tau)))
    return cases


def _jacobians(rng: Any) -> Any:
    model = robot("go2")
    postures = [model.random_configuration(rng=rng) for _ in range(2)]
    return [
        (np.array([swap(tw.frame_jacobian(model, q, foot, "local_world_aligned")) for foot in model.feet]),)
        for q in postures
    ]


RANDOM = Part(
    solution=finite_limits,
    returns=(Output("lower", zh="下限 lower"), Output("upper", zh="上限 upper")),
    cases=_limits,
    slips={
        "limits-all": faulty(
            finite_limits, ("np.isfinite(lower), lower", "False, lower"), ("np.isfinite(upper), upper", "False, upper")
        ),
        "limits-position-only": faulty(
            finite_limits,
            ("np.isfinite(lower)", "np.arange(len(lower)) > 2"),
            ("np.isfinite(upper)", "np.arange(len(upper)) > 2"),
        ),
        "limits-first-three": faulty(
            finite_limits,
            ("np.isfinite(lower)", "np.isfinite(lower) | (np.arange(len(lower)) > 2)"),
            ("np.isfinite(upper)", "np.isfinite(upper) | (np.arange(len(upper)) > 2)"),
        ),
        "limits-clipped": lambda lower, upper: (np.maximum(lower, -1.0), np.minimum(upper, 1.0)),
        "limits-together": faulty(
            finite_limits,
            ("np.isfinite(lower), lower", "np.isfinite(upper - lower), lower"),
            ("np.isfinite(upper), upper", "np.isfinite(upper - lower), upper"),
        ),
        "limits-between": lambda lower, upper: (np.clip(lower, -1, 1), np.clip(upper, -1, 1)),
        "limits-large": lambda lower, upper: (np.where(lower < -1e10, -1, lower), np.where(upper > 1e10, 1, upper)),
        "one-sided": faulty(finite_limits, ("np.where(np.isfinite(lower), lower, -1.0)", "lower")),
    },
    residuals=(lambda answer, *limits: np.hstack([(a - x)[np.isfinite(x)] for a, x in zip(answer, limits)]),),
)

MATRIX = Part(
    solution=by_mass_matrix,
    returns=(Output("τ", JOINT_SPACE), Output("q̈", JOINT_SPACE)),
    cases=_dynamics,
    slips={
        "doubled-off-diagonal": before(by_mass_matrix, doubled, which=0),
        "diagonal-doubled": before(by_mass_matrix, lambda M: M + np.diag(np.diag(M)), which=0),
        "one-triangle": before(by_mass_matrix, np.triu, which=0),
        "bias-for-zero": before(by_mass_matrix, lambda h: 0 * h, which=1),
        "bias-sign": before(by_mass_matrix, lambda h: -h, which=1),
        "column-vector": after(by_mass_matrix, lambda x: x[:, None]),
    },
    residuals=(lambda answer, M, h, a, tau: M @ answer[1] + h - tau,),
)

VELOCITY = Part(
    solution=com_velocity,
    returns=(Output("v_G", unit="m/s"),),
    cases=lambda rng: [(rng.standard_normal(6), float(rng.uniform(5, 80))) for _ in range(3)],
    slips={
        "angular-for-linear": lambda h_G, m: h_G[3:] / m,
        "mass-dropped": lambda h_G, m: h_G[:3],
    },
    residuals=(lambda answer, h_G, m: m * answer - h_G[:3],),
)

CONTACTS = Part(
    solution=contact_rows,
    returns=(Output("J_c", CONTACT_JACOBIAN),),
    cases=_jacobians,
    slips={
        "angular-for-linear": lambda J: np.vstack([J_foot[3:] for J_foot in J]),
        "transposed-answer": lambda J: contact_rows(J).mT,
        "contact-rows-all": lambda J: J.reshape(24, -1),
        "axis-by-axis": lambda J: J[:, :3].swapaxes(0, 1).reshape(12, -1),
        "columns-exchanged": lambda J: np.array([*map(swap, contact_rows(J))]),
    },
    residuals=(lambda answer, J: answer[:3] - J[0][:3],),
)

EXERCISE = Exercise(id="49.11.1", kind="explain", parts=(RANDOM, MATRIX, INERTIA_MATRIX, ACTION, VELOCITY, CONTACTS))
