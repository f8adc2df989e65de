"""What is said of an answer is true of the student's own code, also where another slip gives the same numbers."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.exercises import catalogue
from twistwrench.exercises.judge import judge

from .answers import said_of

TWICE = """\
def about_center_of_mass(m, c, I_c):
    build, moved = mine("spatial_inertia"), mine("moved_inertia")
    S = tw.skew(c)
    return moved(build(m, c, I_c - m * S @ S), np.eye(3), -c)
"""
LEVER = """\
def base_wrench_at_rest(model, q):
    base = tw.forward_kinematics(model, q).placement[1]
    f = -model.mass * model.gravity
    tau = np.cross(base.translation - tw.center_of_mass(model, q), f)
    return np.concatenate([base.rotation.T @ tau, base.rotation.T @ f])
"""
EULER = """\
def urdf_pose(xyz, rpy):
    Rx, Ry, Rz = (tw.exp3(rpy[k] * np.eye(3)[k]) for k in range(3))
    return np.block([[Rx @ Ry @ Rz, np.reshape(xyz, (3, 1))], [np.eye(4)[3:]]])
"""
DUAL = """\
def body_twists(parent, T, V_joint):
    V = np.zeros((len(parent), 6))
    for i in range(1, len(parent)):
        V[i] = np.linalg.solve(mine("transforms_of")(T[i])[1], V[parent[i]]) + V_joint[i]
    return V
"""
TYPED = """\
def translation_transforms(p):
    S, E, O = tw.skew(p), np.eye(3), np.zeros((3, 3))
    return np.block([[E, O], [S, E]]), np.block([[E, O], [-S, E]]), np.block([[E, -S], [O, E]])
"""
ONLY_JOINTS = """\
def mass_matrix_by_rnea(model, q):
    n, zero = model.nv, np.zeros(model.nv)
    M, g = np.zeros((n, n)), tw.rnea(model, q, zero, zero)
    for i in range(n):
        M[:, i] = tw.rnea(model, q, zero, np.eye(n)[i])
        if i >= 6:
            M[:, i] -= g
    return M
"""
ONLY_HIPS = """\
def base_block(model, q):
    M = np.zeros((6, 6))
    place = tw.forward_kinematics(model, q).placement
    for i in range(1, len(model.inertia)):
        if i > 1 and model.parent[i] != 1:
            continue
        M += model.inertia[i].transform(place[1].inverse() @ place[i]).matrix()
    return M
"""
FASTEST = """\
def time_ratio(first, second, calls, clock):
    first(), second()
    a, b = [], []
    for _ in range(calls):
        t0 = clock(); first(); t1 = clock(); second(); t2 = clock()
        a.append(t1 - t0); b.append(t2 - t1)
    return max(b) / np.median(a)
"""
LAST = """\
def count_transforms(parent):
    depth = [0] * len(parent)
    for i in range(1, len(parent)):
        depth[i] = depth[parent[i]] + 1
    inner = sum(d > 2 for d in depth)
    return 3 * inner, sum(d - 1 for d in depth[1:])
"""
BIVECTOR = """\
def contact_wrench(R, p, f_c):
    f = R @ np.asarray(f_c)
    B = np.outer(p, f) - np.outer(f, p)
    return np.array([B[2, 1], B[0, 2], B[1, 0], *f]), tw.force_transform(R, p) @ np.array([0, 0, 0, *f_c])
"""
TRANSPORTED = """\
def fall_in_motion(model, q, v):
    w, u = v[:3], v[3:6]
    vdot = tw.aba(model, q, v, 0 * v)[3:6]
    R = tw.forward_kinematics(model, q).placement[1].rotation
    return R @ (vdot - tw.skew(w) @ u), np.array(model.gravity, float)
"""
BOTH_TRANSPOSED = """\
def plucker(R, p):
    X = np.block([[R, np.zeros((3, 3))], [R @ tw.skew(p), R]])
    return X, X.T
"""
READ_TOO_EARLY = """\
def tree_rnea(parent, S, I, X, qd, qdd, a0):
    V, A = [np.zeros(6)], [np.asarray(a0, float)]
    for p, s, x, u, du in list(zip(parent, S, X, qd, qdd))[1:]:
        V.append(x @ V[p] + s @ u)
        A.append(x @ A[p] + s @ du + tw.cross_motion(V[-1]) @ s @ u)
    F = [i @ a + tw.cross_force(v) @ (i @ v) for i, a, v in zip(I, A, V)]
    tau = [s.T @ f for s, f in zip(S, F)]
    for i, p in reversed(list(enumerate(parent))[1:]):
        F[p] = F[p] + X[i].T @ F[i]
    return np.concatenate(tau[1:])
"""
NORMAL = """\
def center_of_pressure(F):
    n = np.array([0.0, 0, 1])
    return (np.cross(F[:3], n) / (F[3:] @ n))[:2]
"""
WORLD_COUNTED = """\
def mass_matrix_sizes():
    bodies, joints = tw.load("go2").nbodies, 12
    return 6 * bodies - 5 * joints, 6 * (bodies - 1) - 5 * joints
"""
IN_HALVES = """\
def split_map(model, q):
    base, joints = np.hsplit(tw.centroidal_map(model, q), 2)
    return base, joints
"""
REAR_FIRST = """\
def standing_loads():
    model = tw.load("go2")
    q = model.standing()
    J = tw.contact_jacobian(model, q, model.feet)
    loads = np.linalg.pinv(J[:, :6].T) @ tw.gravity(model, q)[:6]
    return loads[8], loads[2]
"""


@pytest.mark.parametrize(
    ("text", "says", "never"),
    [
        (TWICE, "take out `- m * S @ S`", "missing"),
        (LEVER, "the lever arm is taken from the wrong end", "factors of the cross"),
        (EULER, "change `Rx @ Ry @ Rz` to `Rz @ Ry @ Rx`", "Rx, Ry, Rz = "),
        (DUAL, "a twist is transformed like a wrench", "Xᵀ"),
        (TYPED, "change the sign of `S`", "Xᵀ"),
        (ONLY_JOINTS, "do always what is done only where `i >= 6` holds", "n >= 6"),
        (ONLY_HIPS, "do not take the branch for `i > 1 and model.parent[i] != 1`", "i < 1"),
        (FASTEST, "ratio", "anew in each round"),
        (LAST, "RNEA", "to `3 * i`"),
        (REAR_FIRST, "front and rear are exchanged", "wrong end"),
        (BIVECTOR, "`np.outer(f, p) - np.outer(p, f)`", "lever arm"),
        (TRANSPORTED, "tw.skew(u) @ w", "lever arm"),
        (IN_HALVES, "has the shape (6, 9)", "is zero"),
        (BOTH_TRANSPOSED, "Your X* is your X transposed", "−p"),
        (READ_TOO_EARLY, "are added too late", "each of these"),
        (NORMAL, "the order of the factors is the sign", "velocity"),
        (WORLD_COUNTED, "rows (fixed): too large", "are kept"),
    ],
)
def test_the_students_own_line_decides(tmp_path, text, says, never):
    said = said_of(tmp_path, text)
    assert says in said
    assert never not in said


def test_what_stands_only_in_a_right_solution_is_not_called_the_slip():
    """He reads ω from the upper triangle; nothing of a right solution stands in his code."""

    def adjoint(T):
        hats = [T @ tw.hat(e) @ np.linalg.inv(T) for e in np.eye(6)]
        return np.array([[M[1, 2], M[2, 0], M[0, 1], M[0, 3], M[1, 3], M[2, 3]] for M in hats]).T

    said = judge(*catalogue.find_part("adjoint"), adjoint).message("en")
    assert "the right block, with the other sign" in said
    assert "`R`" not in said


def test_a_sum_or_a_difference_that_changes_one_of_its_terms_is_told_so():
    class First(catalogue.find_part("SpatialVector")[1].solution):
        def __add__(self, other):
            self.vector = super().__add__(other).vector
            return self

    class Second(catalogue.find_part("SpatialVector")[1].solution):
        def __sub__(self, other):
            other.vector = -other.vector
            return self + other

    for answer in (First, Second):
        assert "changes one of its two terms" in judge(*catalogue.find_part("SpatialVector"), answer).message("en")


def test_a_property_is_said_to_fail_only_where_there_are_numbers():
    """The forces add up to the weight, but for a weight of zero, where they are not numbers."""

    def clipped(p_G, feet, weight):
        levers = np.vstack([np.ones(len(feet)), feet[:, 0] - p_G[0], feet[:, 1] - p_G[1]])
        loads = np.maximum(np.linalg.pinv(levers)[:, 0] * weight, 0)
        return loads * weight / loads.sum()

    with np.errstate(invalid="ignore"):
        said = judge(*catalogue.find_part("vertical_loads"), clipped).message("en")
    assert "the forces add up to the weight" not in said


def test_what_comes_in_where_the_answer_is_right_is_not_said_to_be_left_out():
    def center_of_pressure(F):
        return np.array([-F[1], F[0]]) / F[5] if F[5] > 0 else np.zeros(2)

    said = judge(*catalogue.find_part("center_of_pressure"), center_of_pressure).message("en")
    assert "does not come into it" not in said


def test_a_change_of_a_right_solution_is_called_just_that():
    def polishing_torques(M, h, J, a, force):
        return M @ a + h - np.linalg.pinv(J) @ force

    said = judge(*catalogue.find_part("polishing_torques"), polishing_torques).message("en")
    assert "Your numbers are those of a right solution but for this: `np.linalg.inv(J)` in place of `J.T`" in said


def test_each_result_is_explained_by_itself(tmp_path):
    """A sign in the centre of mass, and a term that the moments of inertia lack: one change mends neither."""
    text = """\
def whole_robot(block):
    m = block[3, 3]
    c = np.array([block[2, 4], block[0, 5], block[0, 4]]) / m
    return m, c, block[:3, :3] - m * (c @ c) * np.eye(3)
"""
    said = said_of(tmp_path, text)
    assert "In c:" in said
    assert "change the sign of `block[0, 4]`" in said
    assert "In I_c:" in said
    assert "m |c|² on all three axes" in said


def test_a_name_whose_value_is_zero_is_reported_as_zero(tmp_path):
    text = """\
def fall_from_rest(model, q):
    v, tau = np.zeros(model.nv), tw.gravity(model, q)
    R = tw.forward_kinematics(model, q).placement[1].rotation
    tau[:6] = 0
    return tw.aba(model, q, v, tau), np.r_[np.zeros(3), R.T @ model.gravity, np.zeros(model.nv - 6)]
"""
    assert "set `tau` to zero in `tw.aba(model, q, v, tau)`" in said_of(tmp_path, text)


def test_two_changes_of_one_piece_are_one(tmp_path):
    text = """\
def base_wrench_at_rest(model, q):
    T = tw.forward_kinematics(model, q).placement
    masses = np.array([body.mass for body in model.inertia])
    m = masses.sum()
    com = (masses[:, None] * np.array([t.translation for t in T])).sum(axis=0) / m
    force = -m * T[1].rotation.T @ model.gravity
    return np.r_[np.cross(T[1].rotation.T @ (com - T[1].translation), force), force]
"""
    said = said_of(tmp_path, text)
    assert "to `tw.center_of_mass(model, q)" in said
    assert "* m * m" not in said
    assert "With this change" in said


def test_a_factor_that_is_missing_is_reported(tmp_path):
    text = """\
def whole_robot(block):
    m = np.trace(block[3:, 3:])
    c = tw.unskew(block[:3, 3:]) / m
    return m, c, block[:3, :3] + m * tw.skew(c) @ tw.skew(c)
"""
    assert "change `np.trace(block[3:, 3:])` to `np.trace(block[3:, 3:]) / 3`" in said_of(tmp_path, text)


def test_a_term_of_which_only_the_diagonal_is_used_is_reported(tmp_path):
    text = """\
def spatial_inertia(m, c, I_c):
    x, y, z = c
    I_o, C = np.array(I_c, dtype=float), m * tw.skew(c)
    I_o[0, 0] += m * (y**2 + z**2)
    I_o[1, 1] += m * (x**2 + z**2)
    I_o[2, 2] += m * (x**2 + y**2)
    return np.block([[I_o, C], [C.T, m * np.eye(3)]])
"""
    assert "only the diagonal of `m * C @ C` is used" in said_of(tmp_path, text)


def test_what_stands_outside_a_call_and_belongs_into_it_is_reported(tmp_path):
    text = """\
def forward_dynamics_two_ways(model, q, v, tau):
    M, h = tw.crba(model, q), tw.nonlinear_effects(model, q, v)
    return tw.aba(model, q, v, tau), np.linalg.solve(M, tau) - h
"""
    assert "to `np.linalg.solve(M, tau - h)`" in said_of(tmp_path, text)


def test_a_slip_with_the_same_numbers_is_not_made_two(tmp_path):
    text = (
        "def base_pose(q):\n"
        "    px, py, pz, w, x, y, z = q[:7]\n"
        "    T = np.eye(4)\n"
        "    T[0] = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), px]\n"
        "    T[1] = [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), py]\n"
        "    T[2] = [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), pz]\n"
        "    return T\n"
    )
    said = said_of(tmp_path, text)
    assert "the quaternion is read as (qw, qx, qy, qz)" in said
    assert "Two slips" not in said
