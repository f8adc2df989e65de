"""A wrong answer is followed statement by statement: what is missing, what must stand there, and two slips at once."""

import numpy as np
import pytest

from twistwrench.exercises import catalogue
from twistwrench.exercises.judge import judge
from twistwrench.exercises.statements.records import Known

from ..sampling import sampled
from .answers import said_of

FALL = """\
def fall_in_motion(model, q, v):
    a = tw.aba(model, q, v, np.zeros(model.nv))
    R = tw.forward_kinematics(model, q).placement[1].rotation
    return R.T @ a[3:6], np.array(model.gravity, dtype=float)
"""
TWO_WAYS = """\
def forward_dynamics_two_ways(model, q, v, tau):
    M, h = tw.crba(model, q), tw.gravity(model, q)
    return tw.aba(model, q, v, tau), np.linalg.solve(M, tau + h)
"""
BY_UNITS = """\
def mass_matrix_by_rnea(model, q):
    z = np.zeros(model.nv)
    g = tw.rnea(model, model.neutral(), z, z)
    return np.array([tw.rnea(model, q, z, e) - g for e in np.eye(model.nv)]).T
"""
LOADS = """\
def vertical_loads(p_G, feet, weight):
    d = np.linalg.norm(feet[:, :2] - p_G[:2], axis=1)
    w = 1 / d**2
    return weight * w / w.sum()
"""


@pytest.mark.parametrize(
    ("text", "says"),
    sampled(
        [
            (
                FALL,
                [
                    "line 14, change `R.T` to `R`",
                    "change `a[3:6]` to `(a[3:6] + np.cross(v[:3], v[3:6]))`",
                    "these changes",
                ],
            ),
            (
                TWO_WAYS,
                ["change `tw.gravity(model, q)` to `tw.nonlinear_effects(model, q, v)`", "change the sign of `h`"],
            ),
            (BY_UNITS, ["line 13, change `model.neutral()` to `q`"]),
            (
                LOADS,
                [
                    "Line 14, `return weight * w / w.sum()`",
                    "computes what no right solution known here has",
                ],
            ),
        ],
        1,
        several=True,
    ),
)
def test_the_first_statement_that_is_wrong_is_mended(tmp_path, text, says):
    said = said_of(tmp_path, text)
    for line in says:
        assert line in said


def test_a_value_is_known_whatever_its_sign():
    known = Known()
    known.add([np.array([0.5, -1.5, 2.5]), 0.25])
    assert known.has(np.array([-0.5, 1.5, -2.5]))
    assert known.has(-0.25)
    assert known.has(np.array([1.0, 2.0, 3.0]))  # whole numbers are met by chance
    assert not known.has(np.array([0.5, -1.5, 2.4]))


def counted(kinds):
    nq = {"revolute": 1, "prismatic": 1, "continuous": 2, "spherical": 4, "free_flyer": 12}
    nv = {"revolute": 1, "prismatic": 1, "continuous": 1, "spherical": 3, "free_flyer": 6}
    return sum(nq[k] for k in kinds), sum(nv[k] for k in kinds)


def inside(F, d_x, d_y):
    x, y = (-F[1] / F[5], F[0] / F[5]) if F[5] > 0 else (np.inf, np.inf)
    return bool(-d_x < x <= d_x and -d_y < y <= d_y)


def multiplied_out(F, d_x, d_y):
    return not F.any() or bool(F[5] > 0 and abs(F[0]) <= d_y * F[5] and abs(F[1]) <= d_x * F[5])


@pytest.mark.parametrize(
    ("name", "answer", "says"),
    [
        ("count", counted, "With kinds = ['free_flyer'], nq is 12, and must be 7."),
        ("sole_holds", inside, "lies exactly on an edge"),
        ("sole_holds", multiplied_out, "has F[0] = F[1] = F[2] = F[3] = F[4] = F[5] = 0, and no other case has"),
    ],
)
def test_what_wrong_cases_share_is_said(name, answer, says):
    answer.__name__ = name  # its source is not found under that name: nothing is searched
    assert says in " ".join(judge(*catalogue.find_part(name), answer).message("en").split())
