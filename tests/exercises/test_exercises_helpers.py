"""What a student's function uses of its file is searched as it is itself: helpers, and numbers beside them."""

import pytest

from .answers import said_of

RELATIVE = """\
def seen_from(A, B):
    return A.rotation.T @ B.rotation, A.rotation.T @ (B.translation - A.translation[::-1])

def moved(I, R, p):
    X = tw.force_transform(R, p)
    return X @ I @ X.T

def base_block(model, q):
    placement = tw.forward_kinematics(model, q).placement
    bodies = zip(model.inertia[1:], placement[1:])
    return sum(moved(body.matrix(), *seen_from(placement[1], T)) for body, T in bodies)
"""
LAMBDA = """\
step = lambda T: tw.motion_transform(T[:3, :3], T[:3, 3])

def body_twists(parent, T, V_joint):
    V = [np.zeros(6)]
    for i in range(1, len(parent)):
        V.append(step(T[i]) @ V[parent[i]] + V_joint[i])
    return np.array(V)
"""
CONSTANT = """\
g = 9.80665

def com_acceleration(p_G, p, k_rate, m):
    x = g * (p_G[0] - p[0]) / p_G[2] - k_rate[1] / (m * p_G[2])
    y = g * (p_G[1] - p[1]) / p_G[2] + k_rate[0] / (m * p_G[2])
    return np.array([x, y])
"""
TWO = """\
def crm(V):
    w, v = tw.skew(V[:3]), tw.skew(V[3:])
    return np.block([[w, np.zeros((3, 3))], [v, w]])

def tree_rnea(parent, S, I, X, qd, qdd, a0):
    n = len(parent)
    V, A, F, tau = [np.zeros(6)], [a0], [np.zeros(6)], [None] * n
    for i in range(1, n):
        p = parent[i]
        joint = S[i] @ qd[i]
        V.append(X[i] @ V[p] + joint)
        A.append(X[i] @ A[p] + S[i] @ qdd[i] + crm(V[p]) @ joint)
        F.append(I[i] @ A[i] + crm(V[i]).T @ I[i] @ V[i])
    for i in reversed(range(1, n)):
        tau[i] = S[i].T @ F[i]
        F[parent[i]] = F[parent[i]] + X[i].T @ F[i]
    return np.concatenate(tau[1:])
"""
VIEWS = """\
def turned(A):
    B = A.copy()
    B[:3], B[3:] = B[3:], B[:3]
    return B

def chapter_order(I):
    return turned(turned(I).T).T
"""
LOCAL = """\
def total(V, I):
    return sum(x.mass for x in I) * V

def linear(V, c):
    return V[3:] + np.cross(c, V[:3])

def momentum_of_links(model, q, v):
    motion, l = tw.forward_kinematics(model, q, v), np.zeros(3)
    for T, V, I in zip(motion.placement[1:], motion.twist[1:], model.inertia[1:]):
        l += T.rotation @ (I.mass * linear(V, I.com))
    return l
"""


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (RELATIVE, "line 12, take out `[::-1]`"),
        (LAMBDA, "Your numbers are those of this slip"),
        (CONSTANT, "line 11, change `9.80665` to `9.81`"),
        pytest.param(TWO, "line 23, change the sign of `crm(V[i]).T @ I[i] @ V[i]`", marks=pytest.mark.slow),
        (LOCAL, "line 15, change `np.cross(c, V[:3])` to `np.cross(V[:3], c)`"),
    ],
)
def test_the_line_of_a_helper_is_reported(tmp_path, text, says):
    assert says in said_of(tmp_path, text)


def test_halves_that_are_exchanged_in_place_are_copied_first(tmp_path):
    says = "line 13, `B[:3], B[3:] = B[3:], B[:3]`: what stands on the right copies nothing"
    assert says in said_of(tmp_path, VIEWS)
