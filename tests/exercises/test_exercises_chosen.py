"""Of several changes that make a function right, the one that may be meant: not one that blames a right line."""

import pytest

from ..sampling import sampled
from .answers import said_of

CLASSICAL = """\
def fall_from_rest(model, q):
    base, nothing = tw.forward_kinematics(model, q).placement[1], np.zeros(model.nv)
    turned = base.rotation.T @ np.asarray(model.gravity)
    expected = np.zeros(model.nv)
    expected[3:6] = turned - np.cross(turned, base.translation)
    return tw.aba(model, q, nothing, nothing), expected
"""
BY_COLUMNS = """\
def act(R, p, x):
    products = R * x
    return products.sum(axis=0) + p
"""
INVERSE_PLACEMENT = """\
def plucker(R, p):
    X = np.block([[R, np.zeros((3, 3))], [tw.skew(p) @ R, R]])
    back = -p
    product = tw.skew(back) @ R.T
    return X, np.block([[R.T, np.zeros((3, 3))], [product, R.T]]).T
"""
FROM_THE_WORLD = """\
def weight_wrenches(model, q):
    W = np.zeros((model.nbodies, 6))
    for i, (T, body) in enumerate(zip(tw.forward_kinematics(model, q).placement, model.inertia)):
        force = body.mass * np.asarray(model.gravity)
        lever = T.translation + T.rotation @ body.com
        W[i] = np.r_[T.rotation.T @ np.cross(lever, force), T.rotation.T @ force]
    return W
"""
LEVER = """\
def base_wrench_at_rest(model, q):
    base = tw.forward_kinematics(model, q).placement[1]
    r = base.rotation.T @ (tw.center_of_mass(model, q) - base.translation)
    f = -model.mass * base.rotation.T @ np.asarray(model.gravity)
    return np.concatenate([-tw.skew(r) @ f, f])
"""
ONE_ARRAY = """\
def sole_wrench(points, forces):
    tau = f = np.zeros(3)
    for point, force in zip(points, forces):
        tau += np.cross(point, force)
        f += force
    return np.concatenate([tau, f])
"""
IN_A_LIST = """\
def body_twists(parent, T, V_joint):
    V = [np.zeros(6)] * len(parent)
    for i in range(1, len(parent)):
        X = np.linalg.inv(mine("transforms_of")(T[i])[0])
        V[i] += X @ V[parent[i]] + V_joint[i]
    return np.array(V)
"""
FREE = """\
def held_mass_matrix(M):
    base, joints = slice(0, 6), slice(6, None)
    return M[joints, joints] - M[joints, base] @ np.linalg.solve(M[base, base], M[base, joints])
"""
MANY = """\
def momentum_of_links(model, q, v):
    motion = tw.forward_kinematics(model, q, v)
    R, V = np.array([T.rotation for T in motion.placement]), np.asarray(motion.twist)
    u = V[:, 3:] + np.cross(V[:, :3], [body.com for body in model.inertia])
    return np.einsum("n,nij,ni->j", [body.mass for body in model.inertia], R, u)
"""
ORDER = """\
def out_of_balance(model, q, tau, forces):
    S, J = tw.selection_matrix(model), tw.contact_jacobian(model, q, model.feet)
    return tw.gravity(model, q) - S.T @ tau - J.T @ np.asarray(forces).flatten("F")
"""
APPENDED = """\
def mass_matrix_by_rnea(model, q):
    z, e, columns, column = np.zeros(model.nv), np.eye(model.nv), [], np.zeros(model.nv)
    for k in range(model.nv):
        column[:] = tw.rnea(model, q, z, e[k]) - tw.rnea(model, q, z, z)
        columns.append(column)
    return np.array(columns).T
"""
ROUNDS = """\
def weight_wrenches(model, q):
    placement, N = tw.forward_kinematics(model, q).placement, model.nbodies - 1
    W = np.zeros((N + 1, 6))
    for i in range(1, N):
        f = placement[i].rotation.T @ model.gravity * model.inertia[i].mass
        W[i] = np.r_[np.cross(model.inertia[i].com, f), f]
    return W
"""
WAY = """\
def body_twists(parent, T, V_joint):
    def way(i):
        return [0] if i == 0 else [*way(parent[i]), i]
    V = np.zeros((len(parent), 6))
    for i in range(1, len(parent)):
        for above, here in zip(way(i), way(i)[1:]):
            V[i] = np.linalg.solve(mine("transforms_of")(T[above])[0], V[i]) + V_joint[here]
    return V
"""
SIZES = """\
def mass_matrix_sizes():
    return tw.load("go2").nv, tw.load("go2").nv
"""
ANEW = """\
def mass_matrix_by_rnea(model, q):
    rest = np.zeros(model.nv)
    M, e = np.zeros((model.nv, model.nv)), np.zeros(model.nv)
    e = np.zeros(model.nv)
    for k in range(model.nv):
        e[k] = 1.0
        M[:, k] = tw.rnea(model, q, rest, e) - tw.rnea(model, q, rest, rest)
    return M
"""


@pytest.mark.parametrize(
    ("text", "says", "never"),
    sampled(
        [
            (CLASSICAL, "take out `- np.cross(turned, base.translation)`", "`turned` does"),
            (BY_COLUMNS, "line 13, change `axis=0` to `axis=1`", "The slip:"),
            (INVERSE_PLACEMENT, "line 13, change `-p` to `R.T @ -p`", "The slip:"),
            (FROM_THE_WORLD, "line 15, take out `T.translation +`", "`T.rotation @ body.com` does not"),
            (LEVER, "the sign of `tw.skew(r)", "wrong end"),
            (ONE_ARRAY, "line 12, `tau = f = np.zeros(3)` makes one array", "change `"),
            (IN_A_LIST, "line 12, `V = [np.zeros(6)] * len(parent)` makes one array", "change `"),
            (APPENDED, "line 15, `columns.append(column)` puts the same array into the list", "change `"),
            (ROUNDS, "line 14, change `range(1, N)` to `range(1, N + 1)`", "take out `- 1`"),
            (FREE, "take out `", "slice(6, 0)"),
            (MANY, "R.mT", "R.T"),
            (ORDER, "change `np.asarray(forces).flatten('F')` to `np.asarray(forces).flatten('C')`", "forces.T"),
            (WAY, "not yet right", "The slip:"),
            (SIZES, "the six rows of the base are kept", "change `"),
            (ANEW, "line 14, make `e = np.zeros(model.nv)` anew", "line 15"),
        ],
        3,
        several=True,
    ),
)
def test_the_change_is_where_the_slip_is(tmp_path, text, says, never):
    said = said_of(tmp_path, text)
    assert says in said
    assert never not in said
