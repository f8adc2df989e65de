"""What a weak student would write, section by section, and what the message must say about it.

Each is plausible, and wrong. Some make a slip of the catalogue, some are wrong in a way of their own.
"""

from typing import NamedTuple


class Weak(NamedTuple):
    """A wrong function: its name, its body, and what its message must contain."""

    name: str
    body: str
    says: str


ANSWERS = [
    # 49.0
    Weak(
        "skew", "return np.array([[0, w[2], -w[1]], [-w[2], 0, w[0]], [w[1], -w[0], 0]])", "cross matrix is transposed"
    ),
    Weak("skew", "return np.array([[0, -w[2], w[1]], [w[2], 0, w[0]], [-w[1], w[0], 0]])", "wrong in [1, 2]"),
    Weak("act", "return R @ (x + p)", "translation comes before the rotation"),
    Weak("act", "return np.linalg.inv(R) @ x + p", "Rᵀ in place of R"),
    Weak("adjoint", "return np.array([tw.vee(np.linalg.inv(T) @ tw.hat(e) @ T) for e in np.eye(6)]).T", "the inverse"),
    Weak("adjoint", "return np.array([tw.vee(T @ tw.hat(e) @ np.linalg.inv(T)) for e in np.eye(6)])", "is transposed"),
    Weak(
        "count",
        "n = sum(6 if k == 'free_flyer' else 3 if k == 'spherical' else 1 for k in kinds)\nreturn n + 1, n",
        "nq: too small",
    ),
    Weak("newton_euler", "return I_c @ alpha, m * a_c", "gyroscopic term is missing"),
    Weak("newton_euler", "return m * a_c, I_c @ alpha + np.cross(omega, I_c @ omega)", "swapped"),
    # 49.1
    Weak("sizes", "return 19, 19, 18, 18", "nq in place of nv"),
    Weak("sizes", "return 18", "It must return 4 things"),
    Weak("polishing_torques", "return M @ a + h + J.T @ force", "the outside force is added"),
    # 49.2
    Weak(
        "foot_twist",
        "v = np.zeros(18)\nv[5] = omega_z\nreturn tw.frame_jacobian(model, q, 'FR_foot', reference='local') @ v",
        "the base moves where it should turn",
    ),
    Weak(
        "foot_twist",
        "v = np.zeros(18)\nv[2] = omega_z\nreturn tw.frame_jacobian(model, q, 'FR_foot', reference='world') @ v",
        "expressed in the world frame",
    ),
    Weak("foot_speed", "return 0.5 * np.sqrt(0.1934**2 + 0.142**2 + 0.426**2)", "the distance from the axis"),
    Weak("twist_matrix", "M = np.eye(4)\nM[:3, :3] = tw.skew([0, 0, omega_z])\nM[0, 3] = v_x\nreturn M", "is 1"),
    Weak("arc", "return np.exp(tw.hat([0, 0, omega_z, v_x, 0, 0]))", "np.exp takes the exponential of each entry"),
    Weak("arc", "return np.eye(4) + tw.hat([0, 0, omega_z, v_x, 0, 0])", "1 + [V] in place of the exponential"),
    # 49.3
    Weak(
        "translation_transforms",
        "X = np.eye(6)\nX[3:, :3] = skew(p)\nreturn X, np.linalg.inv(X), X.T",
        "The slip: Xᵀ taken for X*",
    ),
    Weak("rotation_transform", "return np.kron(R, np.eye(2))", "X, the block of rows ω, columns v: must be zero"),
    Weak(
        "plucker",
        "X = np.block([[R, np.zeros((3, 3))], [R @ skew(p), R]])\nreturn X, np.linalg.inv(X).T",
        "R [p]× in place of [p]× R",
    ),
    Weak(
        "chain_two_ways",
        "X = mine('plucker')\nA, B = X(R_AB, p_AB)[0], X(R_BC, p_BC)[0]\nreturn X(R_AB @ R_BC, p_AB + p_BC)[0], A @ B",
        "p_BC is added without turning it into A",
    ),
]
