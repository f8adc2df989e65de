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
    # 49.4
    Weak("foot_loads", "return 12 * 9.81 / 4, 15 * 9.81 / 4", "f_z (model) [N]: too small"),
    Weak(
        "foot_wrench",
        "m = sum(body.mass for body in model.inertia)\nreturn np.array([0, 0, 0, 0, 0, m * 9.81 / 4])",
        "the world's axes in place of the body's own",
    ),
    Weak(
        "contact_wrench",
        "f = R @ f_c\nF = np.r_[np.cross(f, p), f]\nreturn F, plucker(R, p)[0] @ np.r_[0, 0, 0, f_c]",
        "The slip in F by X*: X taken for X*",
    ),
    Weak("sole_wrench", "f = forces.sum(0)\nreturn np.r_[np.cross(points.mean(0), f), f]", "at the mean of the points"),
    Weak("center_of_pressure", "return F[:2] / F[5]", "the axes of the centre of pressure are exchanged"),
    Weak(
        "sole_holds",
        "return bool(abs(F[0] / F[5]) <= d_y and abs(F[1] / F[5]) <= d_x)",
        "the ground is allowed to pull",
    ),
    # 49.5
    Weak(
        "spatial_inertia",
        "C = tw.skew(c)\nreturn np.block([[I_c + m * C @ C, m * C], [-m * C, m * np.eye(3)]])",
        "the parallel-axis term has the wrong sign",
    ),
    Weak("link_inertia", "return np.diag([0.03, 0.03, 0.005, 2, 2, 2]), 0.005", "columns v: zero, and must not be"),
    Weak("chapter_order", "return I[[3, 4, 5, 0, 1, 2]]", "only the rows are exchanged"),
    Weak("base_inertia", "b = model.inertia[0]\nreturn b.mass, b.matrix()", "body 0, the universe"),
    Weak(
        "base_inertia",
        "b = model.inertia[1]\nreturn b.mass, tw.bridge.to_pinocchio_transform(b.matrix())",
        "(ω, v) and (v, ω) are swapped",
    ),
    Weak("moved_inertia", "X, _ = plucker(R, p)\nreturn X @ I @ np.linalg.inv(X)", "X I X⁻¹ in place of X* I X⁻¹"),
    Weak(
        "about_center_of_mass",
        "zero = np.zeros((3, 3))\nreturn np.block([[I_c, zero], [zero, np.eye(3)]])",
        "the mass is missing",
    ),
    # 49.6
    Weak(
        "torques_two_ways",
        "h = tw.rnea(model, q, v, a)\nreturn h, tw.crba(model, q) @ a + h",
        "h is taken with the acceleration",
    ),
    Weak(
        "torques_two_ways",
        "M, h = tw.crba(model, q), tw.nonlinear_effects(model, q, v)\n"
        "M = M + M.T - np.diag(M.diagonal())\nreturn tw.rnea(model, q, v, a), M @ a + h",
        "the entries off the diagonal are doubled",
    ),
    Weak(
        "mass_matrix_by_rnea",
        "rest = np.zeros(model.nv)\nreturn np.array([tw.rnea(model, q, rest, e) for e in np.eye(model.nv)]).T",
        "gravity is left in the columns",
    ),
    Weak(
        "weight_wrenches",
        "W = np.zeros((model.nbodies, 6))\nT = tw.forward_kinematics(model, q).placement\n"
        "for i in range(1, model.nbodies):\n    W[i, 3:] = model.inertia[i].mass * T[i].rotation.T @ model.gravity\n"
        "return W",
        "the moment of the weight is left out",
    ),
    Weak(
        "gravity_two_ways",
        "return tw.rnea(model, q, v, a), tw.rnea(model, q, v, a, f_ext=mine('weight_wrenches')(model, q))",
        "gravity is counted twice",
    ),
    Weak("go2_base_wrench", "return np.array([0, 0, 0, 0, 0, -16.085 * 9.81])", "as the chapter prints it"),
    Weak(
        "base_wrench_at_rest",
        "m = sum(body.mass for body in model.inertia)\nreturn np.array([0, 0, 0, 0, 0, m * 9.81])",
        "the τ rows: zero, and must not be",
    ),
    # 49.7
    Weak(
        "fall_from_rest",
        "rest, expected = np.zeros((2, model.nv))\nexpected[5] = -9.81\nreturn tw.aba(model, q, rest, rest), expected",
        "the world's axes in place of the body's own",
    ),
    Weak(
        "fall_in_motion",
        "a = tw.aba(model, q, v, np.zeros(model.nv))\nreturn a[3:6], model.gravity",
        "the change of frame is left out",
    ),
    Weak(
        "forward_dynamics_two_ways",
        "return tw.aba(model, q, v, tau), np.linalg.solve(tw.crba(model, q), tau)",
        "h is left out",
    ),
    Weak(
        "time_ratio",
        "start = clock()\nfor _ in range(calls):\n    first()\nmiddle = clock()\nfor _ in range(calls):\n    second()\n"
        "return (clock() - middle) / (middle - start)",
        "one block of calls for each",
    ),
    Weak(
        "time_ratio",
        "from timeit import timeit\nreturn timeit(second, number=calls) / timeit(first, number=calls)",
        "the clock that is handed in is not read",
    ),
    Weak("measured_ratio", "return 18 * 18 / 18", "an order of growth is taken for a time"),
]
