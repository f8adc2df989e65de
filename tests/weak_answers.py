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
        "skew",
        "return np.array([[0, w[2], -w[1]], [-w[2], 0, w[0]], [w[1], -w[0], 0]])",
        "skew-symmetric matrix is transposed",
    ),
    Weak("skew", "return np.array([[0, -w[2], w[1]], [w[2], 0, w[0]], [-w[1], w[0], 0]])", "wrong in [1, 2]"),
    Weak("act", "return R @ (x + p)", "p is rotated as well"),
    Weak("act", "return np.linalg.inv(R) @ x + p", "take out `np.linalg.inv`"),
    Weak(
        "adjoint",
        "return np.array([tw.vee(np.linalg.inv(T) @ tw.hat(e) @ T) for e in np.eye(6)]).T",
        "the transform goes the wrong way",
    ),
    Weak("adjoint", "return np.array([tw.vee(T @ tw.hat(e) @ np.linalg.inv(T)) for e in np.eye(6)])", "is transposed"),
    Weak(
        "count",
        "n = sum(6 if k == 'free_flyer' else 3 if k == 'spherical' else 1 for k in kinds)\nreturn n + 1, n",
        "nq: too small",
    ),
    Weak(
        "count",
        "nq, nv = 7, 6\nfor k in kinds:\n    if k == 'free_flyer':\n        continue\n    elif k == 'spherical':\n"
        "        nq, nv = nq + 4, nv + 3\n    elif k == 'continuous':\n        nq, nv = nq + 2, nv + 1\n    else:\n"
        "        nq, nv = nq + 1, nv + 1\nreturn nq, nv",
        "exactly one free-flyer is counted, however many there are",
    ),
    Weak("newton_euler", "return I_c @ alpha, m * a_c", "gyroscopic term is missing"),
    Weak(
        "newton_euler", "return m * a_c, I_c @ alpha + np.cross(omega, I_c @ omega)", "return them in the other order"
    ),
    # 49.1
    Weak("sizes", "return 19, 19, 18, 18", "nq in place of nv"),
    Weak("sizes", "return 18", "It must return 4 things"),
    Weak("polishing_torques", "return M @ a + h + J.T @ force", "the external force has the wrong sign"),
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
        "Your numbers are those of this slip: Xᵀ taken for X*",
    ),
    Weak("rotation_transform", "return np.kron(R, np.eye(2))", "`np.kron(R, np.eye(2))` to `np.kron(np.eye(2), R)`"),
    Weak(
        "plucker",
        "X = np.block([[R, np.zeros((3, 3))], [R @ skew(p), R]])\nreturn X, np.linalg.inv(X).T",
        "R [p]× in place of [p]× R",
    ),
    Weak(
        "chain_two_ways",
        "X = mine('plucker')\nA, B = X(R_AB, p_AB)[0], X(R_BC, p_BC)[0]\nreturn X(R_AB @ R_BC, p_AB + p_BC)[0], A @ B",
        "p_BC is added without being rotated into A",
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
        "For F by X*, this slip gives what you have: X taken for X*",
    ),
    Weak("sole_wrench", "f = forces.sum(0)\nreturn np.r_[np.cross(points.mean(0), f), f]", "at the mean of the points"),
    Weak("center_of_pressure", "return F[:2] / F[5]", "the axes of the centre of pressure are exchanged"),
    Weak(
        "sole_holds",
        "return bool(abs(F[0] / F[5]) <= d_y and abs(F[1] / F[5]) <= d_x)",
        "the ground is allowed to pull",
    ),
    Weak(
        "sole_holds",
        "return bool(F[5] > 0 and abs(F[1] / F[5]) < d_x and abs(F[0] / F[5]) < d_y)",
        "the edge is excluded: < in place of ≤",
    ),
    # 49.5
    Weak(
        "spatial_inertia",
        "C = tw.skew(c)\nreturn np.block([[I_c + m * C @ C, m * C], [-m * C, m * np.eye(3)]])",
        "the parallel-axis term has the wrong sign",
    ),
    Weak(
        "link_inertia",
        "return np.diag([0.03, 0.03, 0.005, 2, 2, 2]), np.array([0.005, 0.03, 0.03, 2, 2, 2])",
        "the two off-diagonal blocks, m [c]× and −m [c]×, are left out",
    ),
    Weak(
        "link_inertia",
        "I = build(2.0, np.array([0, 0, 0.1]), np.diag([0.01, 0.01, 0.005]))\nreturn I, np.sort(np.diag(I))",
        "the diagonal in place of the eigenvalues",
    ),
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
        "h is computed with the acceleration",
    ),
    Weak(
        "torques_two_ways",
        "M, h = tw.crba(model, q), tw.nonlinear_effects(model, q, v)\n"
        "M = M + M.T - np.diag(M.diagonal())\nreturn tw.rnea(model, q, v, a), M @ a + h",
        "the entries of M off the diagonal are doubled",
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
        "Two slips at once would give just these numbers: the moment is left out",
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
        "ω × v is missing, and the rotation to the world",
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
        "the clock that is passed in is not read",
    ),
    Weak("measured_ratio", "return 18 * 18 / 18", "the number of degrees of freedom, in place of a measured ratio"),
    # 49.8
    Weak(
        "base_block",
        "T = tw.forward_kinematics(model, q).placement\n"
        "return sum(I.transform(X).matrix() for I, X in zip(model.inertia[1:], T[1:]))",
        "the inertia about the world's origin, in its axes",
    ),
    Weak("base_block", "return model.inertia[1].matrix()", "the base alone: the other bodies are left out"),
    Weak("whole_robot", "return np.trace(block) / 6, tw.unskew(block[:3, 3:]), block[:3, :3]", "m [kg]: too"),
    Weak("mass_matrix_sizes", "return 19, 12", "nq in place of nv"),
    Weak("held_mass_matrix", "M = M + M.T - np.diag(np.diag(M))\nreturn M[6:, 6:]", "off the diagonal are doubled"),
    Weak("held_mass_matrix", "return M[6:18, 6:18]", "the sizes of one robot are written into the function"),
    # 49.9
    Weak(
        "out_of_balance",
        "J = np.vstack([tw.frame_jacobian(model, q, foot)[3:] for foot in model.feet])\n"
        "S = np.hstack([np.zeros((12, 6)), np.eye(12)])\n"
        "return tw.gravity(model, q) - S.T @ tau - J.T @ forces.ravel()",
        "along the axes of the feet's own frames, not the world's",
    ),
    Weak("out_of_balance", "return tw.gravity(model, q) - tau - forces.ravel()", "It stopped with ValueError"),
    Weak(
        "net_wrench",
        "F = np.zeros(6)\nfor foot, f in zip(model.feet, forces):\n"
        "    p = tw.frame_placement(model, q, foot).translation\n    F += np.concatenate([np.cross(p, f), f])\n"
        "F[5] -= model.mass * 9.81\nreturn F",
        "the moments of the ground's forces are about the world's origin",
    ),
    Weak("selection", "return np.eye(nv)[:, 6:]", "S and Sᵀ are exchanged"),
    Weak("on_all_rows", "return np.concatenate([np.zeros(7), tau])", "seven zeros for the base in place of six"),
    Weak(
        "base_rows",
        "return M[:6, :6] @ qdd[:6] + h[:6] - J_c[:, :6].T @ forces",
        "the coupling between base and joints",
    ),
    Weak(
        "complete_motion",
        "qdd_base = np.linalg.solve(M[:6, :6], J_c[:, :6].T @ forces - h[:6] - M[:6, 6:] @ qdd_joints)\n"
        "return np.concatenate([qdd_base, qdd_joints]), M[6:, 6:] @ qdd_joints + h[6:] - J_c[:, 6:].T @ forces",
        "the acceleration of the base is left out",
    ),
    # 49.10
    Weak(
        "split_map",
        "A_G = tw.centroidal_map(model, q)\nreturn A_G[:, :7], A_G[:, 7:]",
        "seven columns for the base in place of six",
    ),
    Weak(
        "base_columns",
        "cx = tw.skew(c)\nreturn np.block([[R @ I_G @ R.T, np.zeros((3, 3))], [-m * cx @ R, m * R]])",
        "R I_G Rᵀ in place of R I_G",
    ),
    Weak(
        "base_columns",
        "cx = tw.skew(c)\nreturn np.block([[R @ (I_G - m * cx @ cx), m * cx @ R], [-m * cx @ R, m * R]])",
        "the block of rows k (angular), columns v: must be zero",
    ),
    Weak("linear_momentum", "return A_G[:3] @ v", "the angular momentum in place of the linear one"),
    Weak(
        "momentum_of_links",
        "motion = tw.forward_kinematics(model, q, v)\nl = np.zeros(3)\n"
        "for I, T, V in zip(model.inertia, motion.placement, motion.twist):\n    l += I.mass * T.rotation @ V[3:]\n"
        "return l",
        "the links' origins in place of their centres of mass",
    ),
    Weak(
        "com_acceleration",
        "a = 9.81 / p_G[2] * (p_G[:2] - p)\nreturn a + np.array([k_rate[1], -k_rate[0]]) / (m * p_G[2])",
        "k̇_G has the wrong sign",
    ),
    Weak(
        "rate_at_pace",
        "return s * tw.centroidal_momentum_rate(model, q, v, a)[:3]",
        "is multiplied by s in place of s²",
    ),
    # 49.11
    Weak("finite_limits", "return -np.ones(len(lower)), np.ones(len(upper))", "also those that are finite"),
    Weak(
        "by_mass_matrix",
        "M = M + M.T - np.diag(M.diagonal())\nreturn M @ a + h, np.linalg.solve(M, tau - h)",
        "the entries of M off the diagonal are doubled",
    ),
    Weak(
        "pinocchio_inertia",
        "cx = tw.skew(c)\nI = np.zeros((6, 6))\nI[:3, :3] = I_c - m * cx @ cx\nI[:3, 3:] = m * cx\n"
        "I[3:, :3] = -m * cx\nI[3:, 3:] = m * np.eye(3)\nreturn I",
        "(ω, v) and (v, ω) are swapped",
    ),
    Weak(
        "pinocchio_action",
        "X = np.zeros((6, 6))\nX[:3, :3] = R\nX[3:, :3] = tw.skew(p) @ R\nX[3:, 3:] = R\nreturn X",
        "(ω, v) and (v, ω) are swapped",
    ),
    Weak("com_velocity", "return h_G[3:] / m", "the angular momentum in place of the linear momentum"),
    Weak(
        "contact_rows", "return np.concatenate([j[3:, :] for j in J])", "the angular rows in place of the linear ones"
    ),
    Weak(
        "count_transforms",
        "n = len(parent) - 1\nreturn 2 * n, n * (n - 1) // 2",
        "For RNEA, this slip gives what you have: two transforms",
    ),
    Weak(
        "growth",
        "return np.log(seconds[-1] / seconds[0]) / np.log(sizes[-1] / sizes[0])",
        "only the first and the last",
    ),
    Weak(
        "standing_forces",
        "f = np.linalg.lstsq(J_c.T, g, rcond=None)[0]\nreturn f.reshape(-1, 3), (g - J_c.T @ f)[6:]",
        "Sᵀτ is left out",
    ),
    Weak("standing_forces", "f = np.linalg.lstsq(J_c.T, g, rcond=None)[0]\nreturn f, g[6:]", "the shape (12,)"),
    Weak("standing_loads", "w = 16.085 * 9.81\nreturn w / 4, w / 4", "carry the same"),
    # the project
    Weak(
        "base_pose",
        "w, x, y, z = q[3:7]\nT = np.eye(4)\nT[:3, 3] = q[:3]\n"
        "T[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],"
        "[2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],"
        "[2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]\nreturn T",
        "(qw, qx, qy, qz)",
    ),
    Weak(
        "urdf_pose",
        "T = np.eye(4)\nfor angle, axis in zip(rpy, np.eye(3)):\n    T[:3, :3] = T[:3, :3] @ tw.exp3(angle * axis)\n"
        "T[:3, 3] = xyz\nreturn T",
        "the Euler angles are applied in the wrong order",
    ),
    Weak(
        "transforms_of",
        "X = tw.motion_transform(T[:3, :3], T[:3, 3])\nreturn X, X.T",
        "Xᵀ taken for X*",
    ),
    Weak("cross_operators", "A = tw.cross_motion(V)\nreturn A, A.T", "(V×)ᵀ in place of"),
    Weak(
        "body_twists",
        "V = np.zeros((len(parent), 6))\nfor i in range(1, len(parent)):\n"
        "    V[i] = transforms(T[i])[0] @ V[parent[i]] + V_joint[i]\nreturn V",
        "the transform goes the wrong way",
    ),
    Weak(
        "carried_wrenches",
        "for i in reversed(range(1, len(parent))):\n    F[parent[i]] += transforms(T[i])[1] @ F[i]\nreturn F",
        "It changes its argument `F`",
    ),
    Weak(
        "tree_rnea",
        "n = len(parent)\nV, A, F, tau = [np.zeros(6)] * n, [a0] * n, [np.zeros(6)] * n, [None] * n\n"
        "for i in range(1, n):\n    V[i] = X[i] @ V[parent[i]] + S[i] @ qd[i]\n"
        "    A[i] = X[i] @ A[parent[i]] + S[i] @ qdd[i] + tw.cross_motion(V[i]) @ S[i] @ qd[i]\n"
        "for i in range(n - 1, 0, -1):\n    F[i] = I[i] @ A[i] + tw.cross_force(V[i]) @ I[i] @ V[i]\n"
        "    tau[i] = S[i].T @ F[i]\n    F[parent[i]] = F[parent[i]] + X[i].T @ F[i]\nreturn np.concatenate(tau[1:])",
        "the forces of the children are missing in τ",
    ),
    Weak(
        "tree_crba",
        "IC = I\nfor i in range(len(parent) - 1, 0, -1):\n"
        "    IC[parent[i]] = IC[parent[i]] + X[i].T @ IC[i] @ X[i]\nreturn IC[1]",
        "It changes its argument `I`",
    ),
    Weak(
        "tree_energy", "return sum(v @ (s.T @ i @ s) @ v for s, i, v in zip(S, I, qd)) / 2", "twist is not carried on"
    ),
    Weak("rows_of_foot", "return R @ (J[3:] + tw.skew(r) @ J[:3])", "change the sign of `tw.skew(r) @ J[:3]`"),
    Weak("accelerated", "return np.linalg.inv(M) @ (J_c.T @ forces - h)", "the motors do nothing"),
    Weak(
        "own_centroidal_map",
        "A_G = np.zeros((6, model.nv))\nfor i, T in enumerate(tw.forward_kinematics(model, q).placement):\n    if i:\n"
        "        J = tw.frame_jacobian(model, q, model.joint_names[i])\n"
        "        A_G += T.force_transform() @ model.inertia[i].matrix() @ J\nreturn A_G",
        "the angular momentum is about the world's origin",
    ),
    Weak(
        "momentum_rate",
        "return tw.centroidal_map(model, q) @ a",
        "Ȧ_G v is left out of the rate",
    ),
    Weak(
        "rate_and_wrench",
        "S, J_c = tw.selection_matrix(model), tw.contact_jacobian(model, q, model.feet)\n"
        "a = acceleration(tw.crba(model, q), tw.nonlinear_effects(model, q, v), S, J_c, tau, forces.ravel())\n"
        "p = [tw.frame_placement(model, q, foot).translation for foot in model.feet]\n"
        "F = np.concatenate([np.cross(p - tw.center_of_mass(model, q), forces).sum(0), forces.sum(0)])\n"
        "return rate(model, q, v, a), F",
        "the weight is missing",
    ),
    Weak(
        "get_dynamics",
        "M = tw.crba(model, q)\nM = M + M.T - np.diag(np.diag(M))\n"
        "J_c = np.vstack([tw.frame_jacobian(model, q, foot, 'local_world_aligned')[:3] for foot in feet])\n"
        "return M, tw.gravity(model, q), J_c, tw.centroidal_map(model, q)",
        "For J_c, this slip gives what you have: the angular rows in place of the linear ones",
    ),
    Weak("vertical_loads", "return np.full(len(feet), weight / len(feet))", "the same share of the weight"),
    Weak(
        "consistency_error",
        "return np.max(inverse(model, q, v, forward(model, q, v, tau)) - tau)",
        "error: ",
    ),
    Weak(
        "time_per_call",
        "start = clock()\nfor _ in range(calls):\n    task()\nreturn (clock() - start) / calls",
        "all calls are timed as one block",
    ),
]
