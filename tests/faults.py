"""Slips in the mathematics, one line each: what a tired hand would write. See test_faults.py."""

from typing import NamedTuple

from twistwrench.tracing.anchors import anchors


class Fault(NamedTuple):
    """A line of `file` that becomes another."""

    slip: str
    file: str
    right: str
    wrong: str


def step(slip: str, anchor: str, wrong: str) -> Fault:
    """Put another line where a step of the chapter has its anchor."""
    return Fault(slip, anchors()[anchor].file, anchors()[anchor].line, wrong)


FAULTS = [
    # 49.2: rotations, exponentials, quaternions
    Fault("sign of the cross product", "spatial/rotation.py", "return M - M.mT", "return M.mT - M"),
    Fault("Rodrigues: sign of sin", "spatial/rotation.py", "+ A * W +", "- A * W +"),
    Fault("Rodrigues: half of 1 − cos", "spatial/rotation.py", "+ 2 * (H * W) @ (H * W))", "+ (H * W) @ (H * W))"),
    Fault(
        "quaternion as wxyz",
        "spatial/rotation.py",
        "cross_matrix(q[..., :3]), q[..., 3, None, None]",
        "cross_matrix(q[..., 1:]), q[..., 0, None, None]",
    ),
    Fault("quaternion: conjugate", "spatial/rotation.py", "2 * (w * U + U @ U)", "2 * (-w * U + U @ U)"),
    Fault(
        "roll and yaw swapped",
        "spatial/roll_pitch_yaw.py",
        "[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr]",
        "[cr * cp, cr * sp * sy - sr * cy, cr * sp * cy + sr * sy]",
    ),
    Fault("log: whole angle for half of it", "spatial/rotation.py", "2 * atan2(n, w)", "atan2(n, w)"),
    Fault("exp: no ω × v", "spatial/exponential.py", "v + 2 * H * np.matvec(cross_matrix(H * w), v) +", "v +"),
    Fault("log: sign of ½ ω × p", "spatial/exponential.py", "p - wp +", "p + wp +"),
    Fault("Jacobian of exp: its side", "spatial/jacobians.py", "- 2 * H * (H * W) + CW", "+ 2 * H * (H * W) + CW"),
    Fault("Jacobian of log: no square", "spatial/jacobians.py", " + D * (W @ W))", ")"),
    Fault("Q: A − B for A − 2B", "spatial/jacobians.py", "-(A - 2 * B) * n_v", "-(A - B) * n_v"),
    Fault("Q: the rate of C left out", "spatial/jacobians.py", "+ (B - 3 * C) * n_v * (N @ W)", "+ 0 * (N @ W)"),
    Fault("inverse of a Jacobian: sign of Q", "spatial/jacobians.py", "-J @ Q @ J, J)", "J @ Q @ J, J)"),
    Fault(
        "∂⊕: the beginning as seen from itself",
        "model/joint.py",
        "placement(turn_matrix(-V[..., :3]), shift(-V)).motion",
        "placement(turn_matrix(V[..., :3]), shift(V)).motion",
    ),
    Fault("∂⊖: right for left", "model/joint.py", "-S.mT @ log6_jacobian(-V)", "-S.mT @ log6_jacobian(V)"),
    # 49.3: Plücker transforms
    Fault(
        "X without its coupling",
        "spatial/plucker.py",
        "np.zeros_like(R), cross_matrix(self.translation) @ R, R)",
        "np.zeros_like(R), np.zeros_like(R), R)",
    ),
    Fault(
        "X: R [p]× for [p]× R",
        "spatial/plucker.py",
        "np.zeros_like(R), cross_matrix(self.translation) @ R, R)",
        "np.zeros_like(R), R @ cross_matrix(self.translation), R)",
    ),
    Fault(
        "X* as the transpose of X",
        "spatial/plucker.py",
        "return blocks(R, cross_matrix(self.translation) @ R, np.zeros_like(R), R)",
        "return self.motion_transform().mT",
    ),
    Fault(
        "X* as X",
        "spatial/plucker.py",
        "return blocks(R, cross_matrix(self.translation) @ R, np.zeros_like(R), R)",
        "return self.motion_transform()",
    ),
    Fault(
        "inverse without turning p",
        "spatial/plucker.py",
        "-np.matvec(self.rotation.mT, self.translation)",
        "-self.translation",
    ),
    Fault(
        "product in the wrong order",
        "spatial/plucker.py",
        "self.rotation @ other.rotation",
        "other.rotation @ self.rotation",
    ),
    # 49.5: cross products, inertia
    Fault(
        "V×: [v]× at the top right",
        "spatial/cross.py",
        "blocks(W, np.zeros_like(W), cross_matrix(V[..., 3:]), W)",
        "blocks(W, cross_matrix(V[..., 3:]), np.zeros_like(W), W)",
    ),
    Fault("V×* as +(V×)ᵀ", "spatial/cross.py", "return -motion_cross_matrix(V).mT", "return motion_cross_matrix(V).mT"),
    Fault("V×* as V×", "spatial/cross.py", "return -motion_cross_matrix(V).mT", "return motion_cross_matrix(V)"),
    Fault("parameters: about the centre of mass", "spatial/inertia.py", "- m[..., None] * (C @ C)", "- 0 * (C @ C)"),
    Fault("pseudo-inertia: tr(I) for half of it", "spatial/inertia.py", "_trace(inertia) / 2 *", "_trace(inertia) *"),
    Fault("capsule: no lever of the half spheres", "spatial/inertia.py", "+ 3 * h * r / 8 +", "+"),
    Fault(
        "mesh: centre of a triangle for a tetrahedron's", "spatial/inertia.py", "share @ total / 4", "share @ total / 3"
    ),
    Fault(
        "difference: sign of the parallel axes",
        "spatial/inertia.py",
        "+ np.asarray(m1 * ratio)",
        "- np.asarray(m1 * ratio)",
    ),
    Fault(
        "parallel axes subtracted",
        "spatial/inertia.py",
        "blocks(self.inertia_at_com - m * (C @ C)",
        "blocks(self.inertia_at_com + m * (C @ C)",
    ),
    Fault(
        "coupling of the inertia transposed",
        "spatial/inertia.py",
        "m * C, -m * C, m * np.eye",
        "-m * C, m * C, m * np.eye",
    ),
    Fault(
        "welded inertia turned backwards",
        "spatial/inertia.py",
        "T.rotation @ self.inertia_at_com @ T.rotation.mT",
        "T.rotation.mT @ self.inertia_at_com @ T.rotation",
    ),
    Fault(
        "sum of inertias without parallel axes",
        "spatial/inertia.py",
        "other.inertia_at_com - reduced * (D @ D)",
        "other.inertia_at_com - 0 * reduced * (D @ D)",
    ),
    # the tree
    Fault(
        "joint turned by the axis of another sign",
        "model/joint.py",
        "sin[..., None] * cross_matrix(axis)",
        "sin[..., None] * -cross_matrix(axis)",
    ),
    Fault("planar: v in the world's axes (S swapped)", "model/joints.py", "[:, [3, 4, 2]]", "[:, [4, 3, 2]]"),
    Fault(
        "free-flyer: (v, ω)",
        "model/joints.py",
        "return np.eye(6, dtype=dtype)\n",
        "return np.eye(6, dtype=dtype)[:, [3, 4, 5, 0, 1, 2]]\n",
    ),
    Fault(
        "prismatic axis among the angular rows",
        "model/joints.py",
        "np.concatenate([np.zeros(3, dtype), self._axis(dtype)])",
        "np.concatenate([self._axis(dtype), np.zeros(3, dtype)])",
    ),
    Fault(
        "screw of the other hand in S",
        "model/joints.py",
        "np.concatenate([axis, self._pitch(dtype) * axis])",
        "np.concatenate([axis, -self._pitch(dtype) * axis])",
    ),
    Fault(
        "screw that slides the other way",
        "model/joints.py",
        "self._pitch(q.dtype) * q * axis",
        "-self._pitch(q.dtype) * q * axis",
    ),
    Fault(
        "3-D: p of a screw without what the turn takes along",
        "newton_euler_3d/joints.py",
        "(beside - R @ beside + w",
        "(beside - beside + w",
    ),
    Fault(
        "X from child to parent", "model/tree.py", "T.inverse().motion_transform() for T", "T.motion_transform() for T"
    ),
    Fault(
        "joint before tree transform",
        "model/tree.py",
        "T @ joint.transform(q[..., s]) if",
        "joint.transform(q[..., s]) @ T if",
    ),
    step("composite inertia by X* X⁻¹ of the wrong X", "49.5 IC", "IC[p] = IC[p] + tree.X[i] @ IC[i] @ tree.X[i].mT"),
    # 49.6: RNEA
    step("gravity forgotten", "49.6 A0", "A[0] = 0 * tree.gravity"),
    step("gravity of the wrong sign", "49.6 A0", "A[0] = tree.gravity"),
    step("Coriolis acceleration forgotten", "49.6 A", "A[i] = X[i] @ A[p] + S[i] @ qdd[i]"),
    step(
        "Coriolis acceleration of the wrong sign",
        "49.6 A",
        "A[i] = X[i] @ A[p] + S[i] @ qdd[i] - cross_motion(V[i]) @ vJ",
    ),
    step("gyroscopic wrench forgotten", "49.6 F", "F[i] = B[i] = I[i] @ A[i] - f_ext[i]"),
    step("V× for V×*", "49.6 F", "F[i] = B[i] = I[i] @ A[i] + cross_motion(V[i]) @ I[i] @ V[i] - f_ext[i]"),
    step(
        "external wrench of the wrong sign", "49.6 F", "F[i] = B[i] = I[i] @ A[i] + bias_wrench(I[i], V[i]) + f_ext[i]"
    ),
    step("children's wrenches overwritten", "49.6 F_p", "F[p] = X[i].mT @ F[i]"),
    step("wrench led inward by X", "49.6 F_p", "F[p] = F[p] + X[i] @ F[i]"),
    step("rotor forgotten in RNEA", "49.6 tau", "tau[i] = S[i].mT @ F[i]"),
    Fault(
        "bias wrench: moment of ω × v forgotten",
        "spatial/formulas.py",
        "turning + I[..., :, 3:]",
        "turning + 0 * I[..., :, 3:]",
    ),
    Fault(
        "bias wrench: ω × for half of the momentum", "spatial/formulas.py", "w @ h[..., 3:, :]]", "0 * h[..., 3:, :]]"
    ),
    # 49.7: ABA
    step("bias acceleration forgotten in pa", "49.7 pa", "pa[i] = pA[i] + U[i] @ D_inv[i] @ u[i]"),
    step("Schur complement forgotten", "49.7 Ia", "Ia[i] = symmetric(IA[i])"),
    Fault(
        "articulated inertia left unsymmetric", "spatial/formulas.py", "return A[..., *_upper(A.shape[-1])]", "return A"
    ),
    step("Schur complement added", "49.7 Ia", "Ia[i] = symmetric(IA[i] + U[i] @ D_inv[i] @ U[i].mT)"),
    step("bias wrench not projected", "49.7 u", "u[i] = tau[i]"),
    step("external wrench of the wrong sign in ABA", "49.7 pA", "pA[i] = B[i] = bias_wrench(I[i], V[i]) + f_ext[i]"),
    step("rotor forgotten in ABA", "49.7 D", "D[i] = S[i].mT @ U[i]"),
    step("joint's twist twice in ABA", "49.7 V", "V[i] = X[i] @ V[parent[i]] + 2 * vJ"),
    step("c forgotten in pass 3", "49.7 a", "a = X[i] @ A[parent[i]]"),
    step("sign of Uᵀ a", "49.7 qdd", "qdd[i] = D_inv[i] @ (u[i] + U[i].mT @ a)"),
    # 49.8: CRBA, C
    step("off-diagonal blocks not led inward", "49.8 F_j", "F[parent[j], i] = F[j, i]"),
    step("own inertia for the composite one", "49.8 F", "F[i, i] = I[i] @ S[i]"),
    step("only one triangle", "49.8 M_ij", "M[i, j] = 0 * M[j, i].mT"),
    step("off-diagonals doubled", "49.8 M_ji", "M[j, i] = 2 * S[j].mT @ F[j, i]"),
    step("rotor forgotten in M", "49.8 M_ii", "M[i, i] = symmetric(S[i].mT @ F[i, i])"),
    step("composite inertia led outward", "49.8 IC_p", "IC[p] = IC[p] + X[i] @ IC[i] @ X[i].mT"),
    Fault(
        "a C with the right C v but Ṁ − 2C not skew",
        "algorithms/coriolis.py",
        "angular = (w @ J - J @ w - cross_matrix(momentum[..., :3, 0])) / 2",
        "angular = w @ J",
    ),
    # kinematics
    step(
        "Jacobian in the world without moving its origin",
        "49.2 world",
        "return SE3._trusted(T.rotation, zero).motion_transform()",
    ),
    Fault("point: sign of the lever", "algorithms/points.py", "- cross_matrix(r) @ J", "+ cross_matrix(r) @ J"),
    Fault("point: no ω × (ω × r)", "algorithms/points.py", "+ np.cross(w, np.cross(w, r))", "+ 0 * r"),
    step("spatial for classical acceleration", "49.9 classical", "classical = 0 * np.cross(V[..., :3], V[..., 3:])"),
    step("no V × S q̇ in the accelerations", "49.2 A", "A[i] = X[i] @ A[p] + S[i] @ qdd[i]"),
    # 49.9, 49.10
    Fault(
        "angular for linear rows in J_c",
        "algorithms/floating_base.py",
        '"local_world_aligned")[..., 3:, :]',
        '"local_world_aligned")[..., :3, :]',
    ),
    Fault(
        "foot forces of the wrong sign",
        "algorithms/floating_base.py",
        "tau=(g - J_c.mT @ forces)",
        "tau=(g + J_c.mT @ forces)",
    ),
    Fault("momentum about the world's origin", "algorithms/centroidal.py", "T.translation - p_G", "T.translation"),
    Fault(
        "levers as differences of world coordinates",
        "algorithms/centroidal.py",
        "-first.translation",
        "0 * first.translation",
    ),
    step("momentum rate without V ×* h", "49.10 F", "F = [I[i] @ A[i] for i in range(model.nbodies)]"),
    step("own inertia for the composite one in A_G", "49.10 IC", "IC = tree.I"),
    Fault("potential energy of the wrong sign", "algorithms/energy.py", "weight = -model", "weight = model"),
    Fault("kinetic energy not halved", "algorithms/energy.py", "return twice / 2", "return twice"),
    # 49.7 to 49.10: what is made of M, of IA and of A_G
    step("own inertia left to the parent", "49.7 IA_alone", "IA[p] = IA[p] + X[i].mT @ IA[i] @ X[i]"),
    step("row of L not scaled", "49.8 L", "scaled = L[..., k, inboard[k]]"),
    step(
        "row of L added",
        "49.8 LTDL",
        "L[..., i, j] = L[..., i, j] + scaled[..., place, None] * L[..., k, j]",
    ),
    step("L left without its roots", "49.8 LTL", "return L * D[..., None]"),
    step("solved outward with Lᵀ", "49.8 outward", "Y[..., k, :] = Y[..., k, :] - L[..., i, k, None] * Y[..., i, :]"),
    step(
        "unit force not passed through the joint",
        "49.8 inverse_inward",
        "pA[p] = pA[p] + X[i].mT @ pA[i]",
    ),
    step(
        "M⁻¹: what the parent brings of the wrong sign",
        "49.8 inverse_outward",
        "qdd = D_inv[i] @ (u[i][..., rest] + U[i].mT @ a)",
    ),
    step("Λ⁻¹ without D", "49.9 Delassus", "return symmetric(Y.mT @ Y)"),
    step("inertias that do not turn", "49.10 dI", "dIC = [0 * I[i] for i in bodies]"),
    step("only one half of an inertia's rate", "49.10 dI", "dIC = [cross_force(V[i]) @ I[i] for i in bodies]"),
    step(
        "rate of the body alone",
        "49.10 dIC",
        "dIC[parent[i]] = dIC[parent[i]]",
    ),
    step("S that does not turn", "49.10 dA_G", "dA_G = [X[i] @ dIC[i] @ S[i] for i in bodies]"),
    Fault(
        "the centre of mass taken to rest", "algorithms/momentum_rate.py", "np.zeros_like(v_G), -v_G", "v_G, -0 * v_G"
    ),
    step(
        "I_G turned the wrong way",
        "49.10 I_G",
        "inertia: Array = np.sum([X[i].mT @ tree.I[i] @ X[i] for i in bodies], axis=0)",
    ),
    step("own inertia for what joint i carries", "49.10 A_sub", "A_G[i] = X[i] @ tree.I[i] @ S[i]"),
    step("inboard joints do not move a subtree", "49.10 A_whole", "A_G[i] = 0 * whole @ S[i]"),
    # 49.9: contact
    Fault(
        "contact: spatial acceleration for the classical one",
        "contact/relative.py",
        "a = A[..., 3:] + np.cross(w, V[..., 3:]) +",
        "a = A[..., 3:] +",
    ),
    Fault("distance: the line does not turn", "contact/closures.py", "+ dot(across, across) / d", "+ 0 * d"),
    Fault("distance: all of the rate turns it", "contact/closures.py", "rate - n * dot(n, rate)", "rate"),
    Fault("loop: what holds the frame does not turn", "contact/relative.py", "bias = bias - turning", "bias = bias"),
    step(
        "J_c: the angular rows",
        "49.9 J_c",
        'return frame_jacobian(model, q, contact, "local_world_aligned")[..., :3, :]',
    ),
    Fault(
        "contact: a sole's moments without their lever",
        "contact/forward.py",
        "forces = per_contact(contacts, np.matvec(W.mT, mu))",
        "forces = per_contact(contacts, mu)",
    ),
    Fault(
        "impact: restitution that slows down",
        "contact/forward.py",
        "after = after + e * (after - v)",
        "after = after - e * (after - v)",
    ),
    Fault("contact: a program that pushes the other way", "contact/programs.py", "free + change", "free - change"),
    Fault("a step of a robot that stands without its mean", "simulation/sticking.py", "(v + after) / 2", "v"),
    Fault(
        "friction: a cone that opens downwards", "contact/types.py", "np.full(sides, -slope)", "np.full(sides, slope)"
    ),
    # scenes: held joints
    Fault(
        "held body added in its own frame",
        "model/reduction.py",
        "merged[body] = merged[body] + inertia.transform(T)",
        "merged[body] = merged[body] + inertia",
    ),
    Fault(
        "held body where the joint is neutral",
        "model/reduction.py",
        "in_carrier[p] @ relative[i])",
        "in_carrier[p] @ model.placement[i])",
    ),
    Fault(
        "wrench from outside added to h",
        "scene/dynamics.py",
        "total = total + J.mT",
        "total = total - J.mT",
    ),
    Fault(
        "planar base: slides swapped",
        "scene/planar_base.py",
        "FLOOR_IN_FLYER = [3, 4, 2]",
        "FLOOR_IN_FLYER = [4, 3, 2]",
    ),
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
    Fault(
        "friction with half the cone",
        "simulation/coulomb.py",
        "most = law.mu * K[:, 2]",
        "most = 0.5 * law.mu * K[:, 2]",
    ),
    Fault(
        "points that pull",
        "simulation/coulomb.py",
        "normal = np.maximum(0, L[:, 2] - U[:, 2] / w)",
        "normal = L[:, 2] - U[:, 2] / w",
    ),
    Fault(
        "a bounce at twice the speed",
        "simulation/stepping.py",
        "np.where(hits, share * speed,",
        "np.where(hits, 2 * share * speed,",
    ),
    Fault(
        "gap in the velocity's place", "simulation/stepping.py", "-np.maximum(gap, 0) / self.dt", "-np.maximum(gap, 0)"
    ),
    Fault(
        "damping left out",
        "simulation/stepping.py",
        "self._damping = self.dt * model.damping",
        "self._damping = 0 * model.damping",
    ),
    Fault(
        "no way back from below the ground",
        "simulation/stepping.py",
        ".nearest(way, G, -gap)",
        ".nearest(way, G, 0 * gap)",
    ),
    Fault(
        "dry friction drives", "simulation/stepping.py", "braking[at] = -slides * most", "braking[at] = slides * most"
    ),
    Fault(
        "a joint's range ends nowhere",
        "simulation/stepping.py",
        "self.at_v] = self.sign",
        "self.at_v] = -self.sign",
    ),
    Fault(
        "arm of a sole's corner left out",
        "simulation/ground.py",
        "cross_matrix(arms) @ moves[:, :3]",
        "0 * moves[:, 3:]",
    ),
    Fault(
        "Munthe-Kaas: sign of ½ φ × ω",
        "simulation/straight.py",
        "first / 2 + second / 12",
        "second / 12 - first / 2",
    ),
    Fault(
        "Runge-Kutta: second stage counted once, not twice",
        "simulation/methods.py",
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
        "P0 = np.matvec(back, np.matvec(turn, p0[..., s]))",
        "P0 = np.matvec(back.mT, np.matvec(turn, p0[..., s]))",
    ),
    # templates, motions
    Fault(
        "parallel axes added to an inertia taken to the centre of mass",
        "templates/template.py",
        "composite[..., :3, :3] + mass[..., None, None] * C @ C",
        "composite[..., :3, :3] - mass[..., None, None] * C @ C",
    ),
    Fault(
        "Euler's equation: sign of ω × I ω",
        "templates/reduced.py",
        "np.matvec(I, w_dot) + np.cross(w, np.matvec(I, w))",
        "np.matvec(I, w_dot) - np.cross(w, np.matvec(I, w))",
    ),
    Fault(
        "pendulum: pressure ahead of a mass that speeds up",
        "templates/reduced.py",
        "p - self._along_the_ground(acceleration) / self._rate_squared",
        "p + self._along_the_ground(acceleration) / self._rate_squared",
    ),
    Fault(
        "turning frame: ω in the world's axes",
        "motions/inverse_kinematics.py",
        "np.eye(3) - B(square) * K",
        "np.eye(3) + B(square) * K",
    ),
    # digits
    Fault(
        "condition of M with its units",
        "error_bounds.py",
        "np.asarray(M / unit[..., :, None] / unit[..., None, :])",
        "np.asarray(M / np.trace(M, axis1=-2, axis2=-1)[..., None, None])",
    ),
    Fault(
        "condition for its inverse",
        "error_bounds.py",
        "DIVIDED * eps * factor / np.where(",
        "DIVIDED * eps * factor * np.where(",
    ),
]
