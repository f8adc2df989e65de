"""Two slips in one answer, and what only the numbers show: small arguments, exchanged entries, tolerances."""

import re

import numpy as np
import pytest

from twistwrench.exercises import case, catalogue
from twistwrench.exercises.judge import judge
from twistwrench.exercises.wrong import both, faulty, negated

from ..sampling import sampled
from .answers import said_of

PUSHED = """\
def base_rows(M, h, J_c, qdd, forces):
    push = J_c[:, :6].T @ forces
    return (M @ qdd)[:6] - h[:6] + push
"""
HANGING = """\
def com_acceleration(p_G, p, k_rate, m):
    return 9.81 / p_G[2] * (p - p_G[:2]) + k_rate / (m * p_G[2])
"""
HALF_A_LEVER = """\
def base_wrench_at_rest(model, q):
    base = tw.forward_kinematics(model, q).placement[1]
    f = -model.inertia[1].mass * np.asarray(model.gravity)
    tau = np.cross(tw.center_of_mass(model, q), f)
    return np.r_[base.rotation.T @ tau, base.rotation.T @ f]
"""
FROM_THE_SECOND = """\
def momentum_of_links(model, q, v):
    motion, total = tw.forward_kinematics(model, q, v), np.zeros(3)
    for i in range(2, model.nbodies):
        V = np.asarray(motion.twist[i])
        total = total + model.inertia[i].mass * (motion.placement[i].rotation @ V[3:])
    return total
"""
ON_THE_EDGE = """\
def sole_holds(F, d_x, d_y):
    least = 1e-4
    if F[5] <= least:
        return False
    x, y = mine("center_of_pressure")(F)
    return bool(abs(x) <= d_x + least and abs(y) <= d_y + least)
"""
RIGID = """\
def tree_aba(parent, S, I, X, qd, tau, a0):
    n = len(parent)
    V, c, p, A = [np.zeros(6)], [np.zeros(6)], [np.zeros(6)], [x.copy() for x in I]
    for i in range(1, n):
        joint = S[i] @ qd[i]
        V.append(X[i] @ V[parent[i]] + joint)
        c.append(tw.cross_motion(V[i]) @ joint)
        p.append(tw.cross_force(V[i]) @ I[i] @ V[i])
    kept = {}
    for i in range(n - 1, 0, -1):
        U = A[i] @ S[i]
        D = np.linalg.inv(S[i].T @ U)
        u = tau[i] - S[i].T @ p[i]
        kept[i] = U, D, u
        A[parent[i]] = A[parent[i]] + X[i].T @ A[i] @ X[i]
        p[parent[i]] = p[parent[i]] + X[i].T @ (p[i] + A[i] @ c[i] + U @ D @ (u - U.T @ c[i]))
    a, found = [a0], []
    for i in range(1, n):
        U, D, u = kept[i]
        brought = X[i] @ a[parent[i]] + c[i]
        found.append(D @ (u - U.T @ brought))
        a.append(brought + S[i] @ found[-1])
    return np.concatenate(found)
"""
NOT_CARRIED = """\
def tree_crba(parent, S, I, X):
    n, IC = len(parent), [x.copy() for x in I]
    for i in range(n - 1, 0, -1):
        IC[parent[i]] = IC[parent[i]] + X[i].T @ IC[i] @ X[i]
    ends = np.cumsum([s.shape[1] for s in S])
    rows = [slice(end - s.shape[1], end) for end, s in zip(ends, S)]
    M = np.zeros((ends[-1], ends[-1]))
    for i in range(1, n):
        first = IC[i] @ S[i]
        M[rows[i], rows[i]] = S[i].T @ first
        j = i
        while parent[j] > 0:
            wrench = X[j].T @ first
            j = parent[j]
            M[rows[j], rows[i]] = S[j].T @ wrench
            M[rows[i], rows[j]] = M[rows[j], rows[i]].T
    return M
"""
BY_COLUMNS = """\
def out_of_balance(model, q, tau, forces):
    S, J = tw.selection_matrix(model), tw.contact_jacobian(model, q, model.feet)
    return tw.gravity(model, q) - S.T @ tau - J.T @ forces.ravel(order="F")
"""
HUGE = """\
def finite_limits(lower, upper):
    return np.where(lower < -1e9, -1.0, lower), np.where(upper > 1e9, 1.0, upper)
"""
BOTH_ENDS = """\
def on_all_rows(tau):
    return np.pad(tau, 6)
"""

UNIT_SPEED = """\
def mass_matrix_by_rnea(model, q):
    M, rest = np.zeros((model.nv, model.nv)), np.zeros(model.nv)
    for k in range(6, model.nv):
        e = np.zeros(model.nv)
        e[k] = 1.0
        M[:, k] = tw.rnea(model, q, rest, e) - tw.rnea(model, q, e, rest)
    return M
"""


@pytest.mark.parametrize(
    ("text", "says"),
    sampled(
        [
            (PUSHED, ["change the sign of `h[:6]`", "change the sign of `push`"]),
            (HANGING, ["Two slips at once", "k̇_G is added as it is", "the pendulum hangs"]),
            (HALF_A_LEVER, ["change `model.inertia[1].mass` to `model.mass`", "- base.translation"]),
            (FROM_THE_SECOND, ["to `(V[3:] + np.cross(V[:3], model.inertia[i].com))`", "to `range(1, "]),
            (ON_THE_EDGE, ["change `0.0001` to `0.0`"]),
            (RIGID, ["change `A[i]` to `(A[i] - U @ D @ U.T)`"]),
            (NOT_CARRIED, ["let `wrench = X[j].T @ first` carry on what the round before has computed"]),
            (BY_COLUMNS, ["change `forces.ravel(order='F')` to `forces.ravel()`"]),
            (HUGE, ["large limits are taken for infinite ones"]),
            (
                UNIT_SPEED,
                ["`tw.rnea(model, q, rest, rest)`", "`tw.rnea(model, q, e, e)`", "changes of one of them"],
            ),
            (BOTH_ENDS, ["change `np.pad(tau, 6)` to `np.pad(tau, (6, 0))`"]),
        ],
        3,
        several=True,
    ),
)
def test_what_must_stand_there_is_found(tmp_path, text, says):
    said = said_of(tmp_path, text)
    for words in says:
        assert words in said


def broken_off(omega_z, v_x):
    V = np.zeros((4, 4))
    V[0, 1], V[1, 0], V[0, 3] = -omega_z, omega_z, v_x
    return np.eye(4) + V + V @ V / 2 + V @ V @ V / 6


def turned_about(q):
    x, y, z, w = q[3:7]
    T = np.eye(4)
    T[0, :3] = 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)
    T[1, :3] = 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)
    T[2, :3] = 2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)
    T[:3, 3] = q[:3]
    return T


def diagonal_exchanged(q):
    T = catalogue.find_part("base_pose")[1].solution(q)
    T[0, 0], T[1, 1] = T[1, 1], T[0, 0]
    return T


def columns_exchanged(q):
    T = catalogue.find_part("base_pose")[1].solution(q)
    T[:3, :2] = T[:3, [1, 0]]
    return T


@pytest.mark.parametrize(
    ("name", "answer", "says"),
    [
        ("arc", broken_off, "terms up to order 3 in omega_z, v_x are right"),
        ("base_pose", turned_about, "rows 1 and 2 are exchanged"),
        ("base_pose", columns_exchanged, "columns 0 and 1 are exchanged"),
        ("base_pose", diagonal_exchanged, "the entries [0, 0] and [1, 1] are exchanged"),
    ],
)
def test_what_the_numbers_show_is_said(name, answer, says):
    exercise, part = catalogue.find_part(name)
    assert says in " ".join(judge(exercise, part, answer).message("en").split())


def test_two_changes_are_of_one_text():
    solution = catalogue.find_part("accelerated")[1].solution
    first, second = faulty(solution, ("- h", "+ h")), faulty(solution, ("+ J_c", "- J_c"))
    M, J_c = np.eye(3), np.zeros((1, 3))
    answer = both(first, second)(M, np.ones(3), np.eye(3), J_c, np.zeros(3), np.zeros(1))
    np.testing.assert_allclose(answer, np.ones(3))
    assert both(first, negated(solution)) is None


@pytest.mark.parametrize(
    ("text", "never"),
    [
        # the force that a motion transform would turn as well: a wrench with no moment
        (
            "def foot_wrench(model, q, foot):\n"
            "    T = tw.frame_placement(model, q, foot)\n"
            "    F = np.array([0, 0, 0, 0, 0, model.mass * 9.81 / 4])\n"
            "    return T.inverse().force_transform() @ F\n",
            "motion_transform",
        ),
        # the two ways are not made one
        (
            "def forward_dynamics_two_ways(model, q, v, tau):\n"
            "    one, S = tw.aba(model, q, v, tau), tw.selection_matrix(model)\n"
            "    right = S.T @ (S @ tau) - tw.nonlinear_effects(model, q, v)\n"
            "    return one, np.linalg.solve(tw.crba(model, q), right)\n",
            "to `one`",
        ),
        # −R is no rotation
        (
            "def adjoint(T):\n"
            "    R, p = T[:3, :3], T[:3, 3]\n"
            "    back = np.eye(4)\n"
            "    back[:3, :3], back[:3, 3] = R.T, -R.T @ p\n"
            "    hats = [T @ tw.hat(e) @ back for e in np.eye(6)]\n"
            "    return np.array([[M[1, 2], M[2, 0], M[0, 1], M[0, 3], M[1, 3], M[2, 3]] for M in hats]).T\n",
            "the sign of `R.T`",
        ),
    ],
)
def test_no_mending_is_offered_that_nobody_would_make(tmp_path, text, never):
    assert never not in said_of(tmp_path, text)


@pytest.mark.parametrize(
    ("text", "says"),
    sampled(
        [
            (
                "def momentum_rate(model, q, v, a):\n"
                "    dt = 1e-3\n"
                "    times = (0, dt)\n"
                "    now, then = (tw.centroidal_momentum(model, model.integrate(q, t * v), v + t * a) for t in times)\n"
                "    return (then - now) / dt\n",
                "With 0.0001 in place of 0.001 in line 12 the error is 10 times smaller",
            ),
            (
                "def arc(omega_z, v_x):\n"
                "    T = np.eye(4)\n"
                "    for _ in range(100):\n"
                "        T = T @ (np.eye(4) + tw.hat(np.array([0, 0, omega_z, v_x, 0, 0])) / 100)\n"
                "    return T\n",
                "not one of the known slips",  # the number of steps stands in two places
            ),
            (
                "N = 100\n\n"
                "def arc(omega_z, v_x):\n"
                "    T = np.eye(4)\n"
                "    for _ in range(N):\n"
                "        T = T @ (np.eye(4) + tw.hat(np.array([0, 0, omega_z, v_x, 0, 0])) / N)\n"
                "    return T\n",
                "With 1000 in place of 100 in line 11 the error is 10 times smaller",
            ),
        ],
        1,
        several=True,
    ),
)
def test_an_approximation_is_reported_by_what_makes_it_better(tmp_path, text, says):
    assert says in said_of(tmp_path, text)


def test_a_change_that_leaves_special_cases_wrong_says_so(tmp_path):
    """Two slips: the second, what is returned for a robot without joints, is seen there only."""
    said = said_of(
        tmp_path,
        "def base_wrench_at_rest(model, q):\n"
        "    if model.nv == 6:\n"
        "        return np.zeros(6)\n"
        "    R, p = tw.forward_kinematics(model, q).placement[1].rotation, q[:3]\n"
        "    f = R.T @ -model.gravity * model.mass\n"
        "    return np.r_[np.cross(R.T @ tw.center_of_mass(model, q) - p, f), f]\n",
    )
    assert "right in the cases tried so far: line 16, change `R.T @ tw.center_of_mass(model, q) - p`" in said
    assert "In special cases it is then still wrong" in said
    number = re.search(r"twistwrench exercises case base_wrench_at_rest (\d+) --seed 0", said)
    assert case("base_wrench_at_rest", int(number[1]), seed=0)[0].nv == 6


def test_whole_numbers_are_not_said_of_a_change_that_brings_them_in(tmp_path):
    said = said_of(
        tmp_path,
        "def polishing_torques(M, h, J, a, force):\n"
        "    tau = np.dot(M, a)\n"
        "    tau = h - np.dot(J.T, force)\n"
        "    return tau\n",
    )
    assert "to `tau += h - np.dot(J.T, force)`. With this change, and no other, the numbers are right" in said
    assert "whole numbers" not in said


def test_a_change_that_leaves_whole_numbers_wrong_says_so(tmp_path):
    """Two slips: the second is an array made after another one, which may hold whole numbers."""
    said = said_of(
        tmp_path,
        "def spatial_inertia(m, c, I_c):\n"
        "    C, top = tw.skew(c), np.array(I_c)\n"
        "    top -= (m * C @ C).astype(top.dtype)\n"
        "    return np.block([[top, m * C], [m * C, m * np.eye(3)]])\n",
    )
    assert "in the cases tried so far: line 14, change the sign of `m * C`, in `[m * C, m * np.eye(3)]`" in said
    assert "Where arguments are whole numbers it is then still wrong" in said


@pytest.mark.parametrize(
    ("text", "never"),
    [
        (  # the larger of slope and intercept
            "def growth(sizes, seconds):\n"
            "    x, y = np.log(sizes), np.log(seconds)\n"
            "    slopes = np.diff(y) / np.diff(x)\n"
            "    return float(np.mean(slopes))\n",
            "max",
        ),
        (  # the matrix of a twist is not normal: U* is not its inverse
            "def arc(omega_z, v_x):\n"
            "    d, U = np.linalg.eig(tw.hat(np.array([0, 0, omega_z, v_x, 0, 0], dtype=float)))\n"
            "    return np.einsum('ij,j,kj->ik', U, np.exp(d), U.conj()).real\n",
            "put zeros",
        ),
        (  # an index of zeros, so that the loop does nothing
            "def gravity_two_ways(model, weightless, q, v, a):\n"
            "    local = mine('weight_wrenches')(model, q)\n"
            "    world = np.array(local)\n"
            "    for i, T in enumerate(tw.forward_kinematics(model, q).placement):\n"
            "        world[i, :3] = T.rotation @ local[i, :3]\n"
            "        world[i, 3:] = T.rotation @ local[i, 3:]\n"
            "    return tw.rnea(model, q, v, a), tw.rnea(weightless, q, v, a, f_ext=world)\n",
            "zeros",
        ),
        pytest.param(  # h(q, v) = Ṁ v − ½ ∂(vᵀM v)/∂q + g with the base's twist for velocities: Ṁ is not missing
            "def forward_dynamics_two_ways(model, q, v, tau):\n"
            "    steps = 1e-5 * np.eye(model.nv)\n"
            "    D = [\n"
            "        (tw.crba(model, model.integrate(q, e)) - tw.crba(model, model.integrate(q, -e))) / 2e-5\n"
            "        for e in steps\n"
            "    ]\n"
            "    h = np.einsum('kij,k,j->i', D, v, v) - 0.5 * np.einsum('kij,i,j->k', D, v, v) + tw.gravity(model, q)\n"
            "    return tw.aba(model, q, v, tau), np.linalg.solve(tw.crba(model, q), tau - h)\n",
            "only its gravity",
            marks=pytest.mark.slow,
        ),
    ],
)
def test_what_is_switched_off_is_no_cure(tmp_path, text, never):
    assert never not in said_of(tmp_path, text)
