"""What is said to be the slip is one that somebody makes, not a change that switches off what is wrong."""

import numpy as np
import pytest

from twistwrench.exercises import catalogue
from twistwrench.exercises.judge import judge

from ..sampling import sampled
from .answers import said_of

SKEW = """\
def skew(w):
    n = np.linalg.norm(w)
    x, y, z = (w / n) if n > 0 else w
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
"""
SOLE = """\
def sole_holds(F, d_x, d_y):
    if F[5] <= 0 or abs(F[2]) > 1e-9:
        return False
    x, y = -F[1] / F[5], F[0] / F[5]
    return bool(abs(x) <= d_x and abs(y) <= d_y)
"""
RATIO = """\
def time_ratio(first, second, calls, clock):
    first(); second()
    ratios = []
    for _ in range(calls):
        t0 = clock(); first(); t1 = clock(); second(); t2 = clock()
        ratios.append((t2 - t1) / (t1 - t0))
    return float(np.mean(ratios))
"""
NET = """\
def net_wrench(model, q, forces):
    com = tw.center_of_mass(model, q)
    F = np.zeros(6)
    for foot, f in zip(model.feet, forces):
        r = {}
        F[:3] += np.cross({})
        F[3:] += f
    F[3:] += model.mass * model.gravity
    return F
"""
FOOT = "tw.frame_placement(model, q, foot).translation"
CARRIED = """\
def carried_wrenches(parent, T, F):
    out = np.array(F, dtype=float)
    for i in range(len(parent) - 1, 0, -1):
        out[parent[i]] += mine("transforms_of")(T[i])[1] @ F[i]
    return out
"""
PLUCKER = """\
def plucker(R, p):
    S, O = tw.skew(p), np.zeros((3, 3))
    return np.block([[R, S @ R], [O, R]]), np.block([[R, O], [S @ R, R]])
"""
ARC = """\
def arc(omega_z, v_x):
    c, s, T = np.cos(omega_z), np.sin(omega_z), np.eye(4)
    if abs(omega_z) < 0.02:
        T[0, 3] = v_x
        return T
    T[:2] = [[c, -s, 0, v_x / omega_z * s], [s, c, 0, v_x / omega_z * (1 - c)]]
    return T
"""

CARRIED_OVER = """\
def foot_wrench(model, q, foot):
    weight = -model.mass * np.asarray(model.gravity)
    foot = tw.frame_placement(model, q, foot)
    return foot.motion_transform().T @ np.hstack([np.zeros(3), weight / 4])
"""
HELD = """\
def base_wrench_at_rest(model, q):
    base, total_mass = tw.forward_kinematics(model, q).placement[1], 0.0
    for body in model.inertia:
        total_mass = total_mass + body.mass
    f = base.rotation.T @ (total_mass * np.asarray(model.gravity))
    c = base.rotation.T @ (tw.center_of_mass(model, q) - base.translation)
    return np.concatenate([np.cross(c, f), f])
"""
WRITTEN_TO = """\
def plucker(R, p):
    X, Y = np.zeros((6, 6)), np.zeros((6, 6))
    X[:3, :3] = X[3:, 3:] = Y[:3, :3] = Y[3:, 3:] = R
    X[3:, :3] = tw.skew(p) @ R
    X[:3, 3:] = tw.skew(p) @ R
    return X, Y
"""
ALL_NUMBERS = """\
def sole_wrench(points, forces):
    return np.r_[np.sum(np.cross(points, forces)) * np.ones(3), np.sum(forces, axis=0)]
"""
TO_THE_LAST = """\
def selection(nv):
    n, S = nv - 6, np.zeros((nv - 6, nv))
    for i in range(1, n):
        S[i - 1, 5 + i] = 1
    return S
"""
ROWS_ONLY = """\
def pinocchio_inertia(m, c, I_c):
    I = tw.SpatialInertia(m, c, I_c).matrix()
    return np.vstack([I[3:], I[:3]])
"""


@pytest.mark.parametrize(
    ("text", "says", "never"),
    sampled(
        [
            (SKEW, "take out `/ n`", "norm(w)` is wrong"),
            (SOLE, "line 12, take out `abs(F[2]) > 1e-09`", " and abs"),
            (ARC, "do not take the branch for `abs(omega_z) < 0.02`", "< -0.02"),
            (RATIO, "line 17, change `np.mean` to `np.median`", "loop"),
            (NET.format(f"{FOOT} - com", "f, r"), "change `np.cross(f, r)` to `np.cross(r, f)`", "wrong end"),
            (NET.format(f"com - {FOOT}", "r, f"), f"change `com - {FOOT}` to `{FOOT} - com`", "factors of the cross"),
            (CARRIED, "line 14, change `F[i]` to `out[i]`", "missing in τ"),
            (PLUCKER, "X is returned first", "transposed"),
            (CARRIED_OVER, "a point contact has no moment about itself", "change `"),
            (HELD, "change the sign of `np.concatenate([np.cross(c, f), f])`", "body.mass"),
            (WRITTEN_TO, "line 15, change `X[:3, 3:]` to `Y[:3, 3:]`", "another quantity"),
            (
                ALL_NUMBERS,
                "change `np.sum(np.cross(points, forces))` to `np.sum(np.cross(points, forces), axis=0)`",
                "?",
            ),
            (TO_THE_LAST, "line 13, change `range(1, n)` to `range(1, n + 1)`", "known slips"),
            (ROWS_ONLY, "the columns of what is returned, `x`, have their two halves exchanged", "np.r_"),
        ],
        3,
        several=True,
    ),
)
def test_the_slip_is_one_that_somebody_makes(tmp_path, text, says, never):
    said = said_of(tmp_path, text)
    assert says in said
    assert never not in said


def balanced_about_the_middle(p_G, feet, weight):
    levers = [np.ones(len(feet)), feet[:, 0] - p_G[0], feet[:, 1] - feet[:, 1].mean()]
    return np.linalg.pinv(np.vstack(levers))[:, 0] * weight


@pytest.mark.parametrize(
    ("name", "answer", "says"),
    sampled(
        [
            ("com_velocity", lambda h_G, m: h_G[:3] / 16.085, "v_G does not change with m, and must"),
            (
                "vertical_loads",
                balanced_about_the_middle,
                "f_z does not change with p_G[1], and must",
            ),
            (
                "newton_euler",
                lambda m, I_c, omega, alpha, a_c: (
                    np.diag(I_c) * alpha + np.cross(omega, np.diag(I_c) * omega),
                    m * a_c,
                ),
                "only the diagonal of `I_c` is used",
            ),
            (
                "newton_euler",
                lambda m, I_c, omega, alpha, a_c: (
                    np.linalg.norm(I_c, axis=1) * alpha + np.cross(omega, np.linalg.norm(I_c, axis=1) * omega),
                    m * a_c,
                ),
                "It is right where I_c is diagonal",
            ),
        ],
        1,
        several=True,
    ),
)
def test_what_a_result_does_not_depend_on_is_said(name, answer, says):
    said = " ".join(judge(*catalogue.find_part(name), answer).message("en").split())
    assert says in said
    assert said.count("and must: ") <= 1


def test_of_true_or_false_it_is_not_said():
    def holds(F, d_x, d_y):
        return bool(abs(F[0]) <= d_x * abs(F[5]) and abs(F[1]) <= d_y * abs(F[5]))

    assert "does not change" not in judge(*catalogue.find_part("sole_holds"), holds).message("en")


def test_a_small_bound_is_not_given_a_minus(tmp_path):
    told = said_of(
        tmp_path,
        "def sole_holds(F, d_x, d_y):\n"
        "    p = mine('center_of_pressure')\n"
        "    eps = np.finfo(float).eps\n"
        "    if not F[5] > eps:\n"
        "        return False\n"
        "    return all(-d <= x <= d for x, d in zip(p(F), (d_x, d_y)))\n",
    )
    assert "too strict" in told
    assert "change the sign" not in told


def test_a_slip_of_all_numbers_is_not_said_of_one(tmp_path):
    """Thirteen joints would make all four one too large; here the pose of the base has eight numbers."""
    told = said_of(tmp_path, "def sizes():\n    return 8 + 12, 6 + 12, 6 + 12, 6 + 12\n")
    assert "too large" in told
    assert "joints are counted" not in told
