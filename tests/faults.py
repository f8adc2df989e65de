"""Slips in the mathematics, one line each: what a tired hand would write. See test_faults.py."""

from typing import NamedTuple


class Fault(NamedTuple):
    """A line of `file` that becomes another."""

    slip: str
    file: str
    right: str
    wrong: str


FAULTS = [
    # 49.2: rotations, exponentials, quaternions
    Fault("sign of the cross product", "rotation.py", "return M - M.mT", "return M.mT - M"),
    Fault("Rodrigues: sign of sin", "rotation.py", "+ A * W +", "- A * W +"),
    Fault("Rodrigues: half of 1 − cos", "rotation.py", "+ 2 * (H * W) @ (H * W))", "+ (H * W) @ (H * W))"),
    Fault(
        "quaternion as wxyz",
        "rotation.py",
        "cross_matrix(q[..., :3]), q[..., 3, None, None]",
        "cross_matrix(q[..., 1:]), q[..., 0, None, None]",
    ),
    Fault("quaternion: conjugate", "rotation.py", "2 * (w * U + U @ U)", "2 * (-w * U + U @ U)"),
    Fault("roll and yaw swapped", "rotation.py", "(cr, cp, cy), (sr, sp, sy) =", "(cy, cp, cr), (sy, sp, sr) ="),
    Fault("log: whole angle for half of it", "rotation.py", "2 * atan2(n, w)", "atan2(n, w)"),
    Fault("exp: no ω × v", "exponential.py", "v + 2 * H * np.cross(H * w, v) +", "v +"),
    Fault("log: sign of ½ ω × p", "exponential.py", "p - wp / 2", "p + wp / 2"),
    # 49.3: Plücker transforms
    Fault(
        "X without its coupling",
        "plucker.py",
        "np.zeros_like(R), cross_matrix(self.translation) @ R, R)",
        "np.zeros_like(R), np.zeros_like(R), R)",
    ),
    Fault(
        "X: R [p]× for [p]× R",
        "plucker.py",
        "np.zeros_like(R), cross_matrix(self.translation) @ R, R)",
        "np.zeros_like(R), R @ cross_matrix(self.translation), R)",
    ),
    Fault(
        "X* as the transpose of X",
        "plucker.py",
        "return blocks(R, cross_matrix(self.translation) @ R, np.zeros_like(R), R)",
        "return self.motion_transform().mT",
    ),
    Fault(
        "X* as X",
        "plucker.py",
        "return blocks(R, cross_matrix(self.translation) @ R, np.zeros_like(R), R)",
        "return self.motion_transform()",
    ),
    Fault(
        "inverse without turning p", "plucker.py", "-np.matvec(self.rotation.mT, self.translation)", "-self.translation"
    ),
    Fault(
        "product in the wrong order", "plucker.py", "self.rotation @ other.rotation", "other.rotation @ self.rotation"
    ),
    # 49.5: cross products, inertia
    Fault(
        "V×: [v]× at the top right",
        "cross.py",
        "blocks(W, np.zeros_like(W), cross_matrix(V[..., 3:]), W)",
        "blocks(W, cross_matrix(V[..., 3:]), np.zeros_like(W), W)",
    ),
    Fault("V×* as +(V×)ᵀ", "cross.py", "return -motion_cross_matrix(V).mT", "return motion_cross_matrix(V).mT"),
    Fault("V×* as V×", "cross.py", "return -motion_cross_matrix(V).mT", "return motion_cross_matrix(V)"),
    Fault(
        "parallel axes subtracted",
        "inertia.py",
        "blocks(self.inertia_at_com - m * (C @ C)",
        "blocks(self.inertia_at_com + m * (C @ C)",
    ),
    Fault("coupling of the inertia transposed", "inertia.py", "m * C, -m * C, m * np.eye", "-m * C, m * C, m * np.eye"),
    Fault(
        "welded inertia turned backwards",
        "inertia.py",
        "T.rotation @ self.inertia_at_com @ T.rotation.mT",
        "T.rotation.mT @ self.inertia_at_com @ T.rotation",
    ),
    Fault(
        "sum of inertias without parallel axes",
        "inertia.py",
        "other.inertia_at_com - reduced * (D @ D)",
        "other.inertia_at_com - 0 * reduced * (D @ D)",
    ),
    # the tree
    Fault(
        "joint turned by the axis of another sign",
        "joint.py",
        "sin[..., None] * cross_matrix(axis)",
        "sin[..., None] * -cross_matrix(axis)",
    ),
    Fault("planar: v in the world's axes (S swapped)", "joint_types.py", "[:, [3, 4, 2]]", "[:, [4, 3, 2]]"),
    Fault(
        "free-flyer: (v, ω)",
        "joint_types.py",
        "return np.eye(6, dtype=dtype)\n",
        "return np.eye(6, dtype=dtype)[:, [3, 4, 5, 0, 1, 2]]\n",
    ),
    Fault(
        "prismatic axis among the angular rows",
        "joint_types.py",
        "np.concatenate([np.zeros(3, dtype), self._axis(dtype)])",
        "np.concatenate([self._axis(dtype), np.zeros(3, dtype)])",
    ),
    Fault("X from child to parent", "tree.py", "T.inverse().motion_transform() for T", "T.motion_transform() for T"),
    Fault(
        "joint before tree transform",
        "tree.py",
        "T @ joint.transform(q[..., s]) if",
        "joint.transform(q[..., s]) @ T if",
    ),
    Fault(
        "composite inertia by X* X⁻¹ of the wrong X",
        "tree.py",
        "tree.X[i].mT @ IC[i] @ tree.X[i]",
        "tree.X[i] @ IC[i] @ tree.X[i].mT",
    ),
    # 49.6: RNEA
    Fault(
        "gravity forgotten",
        "inverse_dynamics.py",
        "A[0] = -model.constants(q.dtype).gravity",
        "A[0] = 0 * model.constants(q.dtype).gravity",
    ),
    Fault("gravity of the wrong sign", "inverse_dynamics.py", "A[0] = -model.constants", "A[0] = model.constants"),
    Fault(
        "Coriolis acceleration forgotten",
        "inverse_dynamics.py",
        " + np.matvec(cross_motion(V[i]), vJ)  # acc",
        "  # acc",
    ),
    Fault(
        "Coriolis acceleration of the wrong sign",
        "inverse_dynamics.py",
        "+ np.matvec(cross_motion(V[i]), vJ)  # acc",
        "- np.matvec(cross_motion(V[i]), vJ)  # acc",
    ),
    Fault("gyroscopic wrench forgotten", "inverse_dynamics.py", "+ np.matvec(cross_force(V[i]), h) - f_ext", "- f_ext"),
    Fault("V× for V×*", "inverse_dynamics.py", "np.matvec(cross_force(V[i]), h)", "np.matvec(cross_motion(V[i]), h)"),
    Fault("external wrench of the wrong sign", "inverse_dynamics.py", "h) - f_ext[..., i, :]", "h) + f_ext[..., i, :]"),
    Fault(
        "children's wrenches overwritten",
        "inverse_dynamics.py",
        "F[p] = F[p] + np.matvec(X[i].mT, F[i])",
        "F[p] = np.matvec(X[i].mT, F[i])",
    ),
    Fault(
        "wrench led inward by X",
        "inverse_dynamics.py",
        "F[p] = F[p] + np.matvec(X[i].mT, F[i])",
        "F[p] = F[p] + np.matvec(X[i], F[i])",
    ),
    Fault(
        "rotor forgotten in RNEA",
        "inverse_dynamics.py",
        "join(tau) + model.constants(q.dtype).armature * a",
        "join(tau) + 0 * model.constants(q.dtype).armature * a",
    ),
    # 49.7: ABA
    Fault("bias acceleration forgotten in pa", "forward_dynamics.py", "pA[i] + np.matvec(Ia, c[i]) +", "pA[i] +"),
    Fault("Schur complement forgotten", "forward_dynamics.py", "Ia = IA[i] - given", "Ia = IA[i]"),
    Fault("articulated inertia left unsymmetric", "forward_dynamics.py", "Ia = (Ia + Ia.mT) / 2", "Ia = Ia"),
    Fault("Schur complement added", "forward_dynamics.py", "Ia = IA[i] - given", "Ia = IA[i] + given"),
    Fault(
        "bias wrench not projected", "forward_dynamics.py", "u[i] = tau[i] - np.matvec(S[i].mT, pA[i])", "u[i] = tau[i]"
    ),
    Fault(
        "external wrench of the wrong sign in ABA",
        "forward_dynamics.py",
        "np.matvec(IA[i], V[i])) - f_ext",
        "np.matvec(IA[i], V[i])) + f_ext",
    ),
    Fault(
        "rotor forgotten in ABA",
        "forward_dynamics.py",
        "S[i].mT @ U[i] + _diagonal(rotor[i])",
        "S[i].mT @ U[i] + 0 * _diagonal(rotor[i])",
    ),
    Fault("c forgotten in pass 3", "forward_dynamics.py", "V[tree.parent[i]]) + vJ\n", "V[tree.parent[i]]) + 2 * vJ\n"),
    Fault(
        "D's inverse transposed blockwise",
        "forward_dynamics.py",
        "np.matvec(D_inv[i], u[i] - np.matvec(U[i].mT, A[i]))",
        "np.matvec(D_inv[i], u[i] + np.matvec(U[i].mT, A[i]))",
    ),
    # 49.8: CRBA, C
    Fault(
        "off-diagonal blocks not led inward", "mass_matrix.py", "F = tree.X[j].mT @ F", "F = F + 0 * (tree.X[j].mT @ F)"
    ),
    Fault("own inertia for the composite one", "mass_matrix.py", "IC = composite_inertias(tree)", "IC = tree.I"),
    Fault(
        "only one triangle",
        "mass_matrix.py",
        "M[..., at[i], at[j]] = M[..., at[j], at[i]].mT",
        "M[..., at[i], at[j]] = 0",
    ),
    Fault(
        "off-diagonals doubled",
        "mass_matrix.py",
        "M[..., at[j], at[i]] = tree.S[j].mT @ F",
        "M[..., at[j], at[i]] = 2 * tree.S[j].mT @ F",
    ),
    Fault("rotor forgotten in M", "mass_matrix.py", "M[..., k, k] += model", "M[..., k, k] += 0 * model"),
    Fault(
        "a C with the right C v but Ṁ − 2C not skew",
        "coriolis.py",
        "B = (cross_force(V[i]) @ I - I @ cross_motion(V[i]) + _cross_bar(np.matvec(I, V[i]))) / 2",
        "B = cross_force(V[i]) @ I",
    ),
    # kinematics
    Fault(
        "Jacobian in the world without moving its origin",
        "kinematics.py",
        "        return T.motion_transform()\n",
        "        return SE3._trusted(T.rotation, zero).motion_transform()\n",
    ),
    Fault(
        "spatial for classical acceleration",
        "kinematics.py",
        "np.cross(V[..., :3], V[..., 3:])",
        "0 * np.cross(V[..., :3], V[..., 3:])",
    ),
    Fault(
        "no V × S q̇ in the accelerations",
        "kinematics.py",
        "np.matvec(tree.S[i], qdd[i]) + np.matvec(cross_motion(V[i]), vJ)",
        "np.matvec(tree.S[i], qdd[i])",
    ),
    # 49.9, 49.10
    Fault(
        "angular for linear rows in J_c",
        "floating_base.py",
        '"local_world_aligned")[..., 3:, :]',
        '"local_world_aligned")[..., :3, :]',
    ),
    Fault(
        "foot forces of the wrong sign", "floating_base.py", "tau=(g - J_c.mT @ forces)", "tau=(g + J_c.mT @ forces)"
    ),
    Fault("momentum about the world's origin", "centroidal.py", "T.translation - p_G", "T.translation"),
    Fault("levers as differences of world coordinates", "centroidal.py", "-first.translation", "0 * first.translation"),
    Fault(
        "momentum rate without V ×* h",
        "centroidal.py",
        "np.matvec(I[i], A[i]) + np.matvec(cross_force(V[i]), np.matvec(I[i], V[i]))",
        "np.matvec(I[i], A[i])",
    ),
    Fault("own inertia for the composite one in A_G", "centroidal.py", "IC = composite_inertias(tree)", "IC = tree.I"),
    Fault("potential energy of the wrong sign", "energy.py", "weight = -model", "weight = model"),
    Fault("kinetic energy not halved", "energy.py", "return twice / 2", "return twice"),
    # 49.9: contact
    Fault(
        "contact: spatial acceleration for the classical one",
        "contact/rows.py",
        "a = A[..., 3:] + np.cross(w, V[..., 3:]) +",
        "a = A[..., 3:] +",
    ),
    Fault("contact: a sole's moments without their lever", "contact/forward.py", "np.matvec(W.mT, mu)", "mu"),
    Fault(
        "impact: restitution that slows down",
        "contact/impacts.py",
        "v=v - (1 + restitution)",
        "v=v - (1 - restitution)",
    ),
    Fault(
        "friction: a cone that opens downwards", "contact/types.py", "np.full(sides, -slope)", "np.full(sides, slope)"
    ),
    # scenes: held joints
    Fault(
        "held body added in its own frame",
        "reduction.py",
        "merged[body] = merged[body] + inertia.transform(T)",
        "merged[body] = merged[body] + inertia",
    ),
    Fault(
        "held body where the joint is neutral",
        "reduction.py",
        "in_carrier[p] @ relative[i])",
        "in_carrier[p] @ model.placement[i])",
    ),
    Fault(
        "wrench from outside added to h",
        "scene/once.py",
        "h = h - np.matvec(angular",
        "h = h + np.matvec(angular",
    ),
    Fault("planar base: slides swapped", "scene/floor.py", "FLOOR_IN_FLYER = [3, 4, 2]", "FLOOR_IN_FLYER = [4, 3, 2]"),
    # 49.1: the truth itself
    Fault(
        "3-D: velocity of a point without its lever",
        "newton_euler_3d/bodies.py",
        "velocity = self.velocity + cross(self.omega, r)  # (1)",
        "velocity = self.velocity",
    ),
    Fault(
        "3-D: no centripetal acceleration", "newton_euler_3d/bodies.py", "+ cross(self.omega, cross(self.omega, r))", ""
    ),
    Fault(
        "3-D: Coriolis acceleration once, not twice",
        "newton_euler_3d/bodies.py",
        "coriolis = 2 * cross",
        "coriolis = cross",
    ),
    Fault(
        "3-D: joint's rate not carried along",
        "newton_euler_3d/bodies.py",
        "turn @ a + cross(carrier.omega, omega_joint)",
        "turn @ a",
    ),
    Fault(
        "3-D: inertia not turned into the world",
        "newton_euler_3d/bodies.py",
        "inertia=R @ number.array(given.inertia_at_com) @ R.mT",
        "inertia=number.array(given.inertia_at_com)",
    ),
    # motion in time
    Fault("Munthe-Kaas: sign of ½ [u, v]", "simulation/tangent.py", "v + first / 2 +", "v - first / 2 +"),
    Fault(
        "Runge-Kutta: second stage counted once, not twice",
        "simulation/explicit.py",
        "(1 / 6, 1 / 3, 1 / 3, 1 / 6))",
        "(1 / 6, 1 / 6, 1 / 3, 1 / 6))",
    ),
    Fault(
        "∂L/∂q with the body's twist, not its carrier's",
        "simulation/variational.py",
        "np.matvec(cross_force(carrier[i]), h[i])",
        "np.matvec(cross_force(V[i]), h[i])",
    ),
    Fault(
        "variational: momentum carried the wrong way",
        "simulation/variational.py",
        "P0 = exp_transposed(ad, self.p0)",
        "P0 = exp_transposed(-ad, self.p0)",
    ),
    # templates, motions
    Fault(
        "parallel axes added to an inertia taken to the centre of mass",
        "templates/reading.py",
        "composite[..., :3, :3] + mass[..., None, None] * C @ C",
        "composite[..., :3, :3] - mass[..., None, None] * C @ C",
    ),
    Fault(
        "Euler's equation: sign of ω × I ω",
        "templates/rigid_body.py",
        "np.matvec(I, w_dot) + np.cross(w, np.matvec(I, w))",
        "np.matvec(I, w_dot) - np.cross(w, np.matvec(I, w))",
    ),
    Fault(
        "pendulum: pressure ahead of a mass that speeds up",
        "templates/pendulum.py",
        "p - self._along_the_ground(acceleration) / self._rate_squared",
        "p + self._along_the_ground(acceleration) / self._rate_squared",
    ),
    Fault(
        "turning frame: ω in the world's axes",
        "motions/turning.py",
        "np.eye(3) - B(square) * K",
        "np.eye(3) + B(square) * K",
    ),
    # digits
    Fault(
        "condition of M with its units",
        "digits.py",
        "eigh(M / unit[..., :, None] / unit[..., None, :])",
        "eigh(M / np.trace(M, axis1=-2, axis2=-1)[..., None, None])",
    ),
    Fault("condition for its inverse", "digits.py", "DIVIDED * eps / np.where(", "DIVIDED * eps * np.where("),
    Fault(
        "solve in kg and m",
        "fast/one_aba.py",
        "np.linalg.solve(feels / unit[:, None] / unit, (tau - K[:6, 6] - I.dot(rising)) / unit) / unit",
        "np.linalg.solve(feels, tau - K[:6, 6] - I.dot(rising))",
    ),
]
