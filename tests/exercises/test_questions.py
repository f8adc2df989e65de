"""The questions of the notebooks: each answer is found a second time, by a closed form or by another program."""

import re
import tomllib
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.errors import NameNotFound
from twistwrench.exercises.asking import SECTIONS, Asked, questions
from twistwrench.exercises.questions.gaits import GAITS, move

ALL = {name: question for section in SECTIONS for name, question in questions(section).items()}
EVERY = [pytest.param(name, id=name) for name in ALL]


# ---------------------------------------------------------------- the same answers by other means


@cache
def pinocchio():
    return pytest.importorskip("pinocchio", reason="Pinocchio is not installed: some answers are not found again")


@cache
def go2(base="floating"):
    """Go2 in Pinocchio, with its data and its standing posture."""
    model = tw.load("go2", base=base)
    theirs = tw.bridge.to_pinocchio_model(model)
    return theirs, theirs.createData(), tw.load("go2").standing()[0 if base == "floating" else 7 :]


@cache
def mass_matrix():
    """M of the standing Go2 by Pinocchio; the base's rows are (v, ω)."""
    theirs, data, q = go2()
    return pinocchio().crba(theirs, data, q)


def locked_inertia():
    """Mass, centre of mass and inertia about it of the standing Go2 with locked joints, by points and parallel axes."""
    theirs, data, q = go2()
    pin = pinocchio()
    pin.forwardKinematics(theirs, data, q)
    bodies = [
        (i.mass, m.act(i.lever), m.rotation @ i.inertia @ m.rotation.T) for i, m in zip(theirs.inertias, data.oMi)
    ]
    mass = sum(m for m, *_ in bodies)
    com = sum(m * c for m, c, _ in bodies) / mass
    return (
        mass,
        com,
        sum(I + m * ((c - com) @ (c - com) * np.eye(3) - np.outer(c - com, c - com)) for m, c, I in bodies),
    )


def hanging_rods(n):
    """Mass felt across the upper end of n thin rods of 1 kg and 1 m that hang in a row: from their kinetic energy."""
    lever = np.tril(np.ones((n, n)), -1) + np.eye(n) / 2  # of each middle, by the small angles of the rods
    M = np.zeros((n + 1, n + 1))
    M[0, 0], M[0, 1:], M[1:, 0] = n, lever.sum(axis=0), lever.sum(axis=0)
    M[1:, 1:] = lever.T @ lever + np.eye(n) / 12
    return M[0, 0] - M[0, 1:] @ np.linalg.solve(M[1:, 1:], M[1:, 0])


def trunk_share(row):
    """Apparent inertia of the trunk with free joints beside that with locked ones, and itself, by Pinocchio's M."""
    M = mass_matrix()
    free = M[:6, :6] - M[:6, 6:] @ np.linalg.solve(M[6:, 6:], M[6:, :6])
    return free[row, row], free[row, row] / M[row, row]


def hip_under_one_newton_metre(base):
    theirs, data, q = go2(base)
    rest, push = np.zeros(theirs.nv), np.eye(theirs.nv)[theirs.nv - 12]
    return (
        pinocchio().aba(theirs, data, q, rest, push)[theirs.nv - 12]
        - pinocchio().aba(theirs, data, q, rest, rest)[theirs.nv - 12]
    )


def knees_of_a_dropped_go2():
    theirs, data, q = go2()
    knees = pinocchio().aba(theirs, data, q, np.zeros(18), np.zeros(18))[8::3]
    return "still" if np.abs(knees).max() < 1e-9 else "moving"


def digits_at_a_heavy_tip():
    """By Pinocchio's two ways, against each other: RNEA of an acceleration tells how good it is."""
    mpmath = pytest.importorskip("mpmath")
    pin, model = pinocchio(), tw.chain(10, mass_ratio=1e6)
    theirs = tw.bridge.to_pinocchio_model(model)
    data, (q, v, tau) = theirs.createData(), np.random.default_rng(7).standard_normal((3, 10))
    with mpmath.workdps(50):
        state = [tw.newton_euler_3d.as_mpmath(x) for x in (q, v, tau)]
        exact = tw.newton_euler_3d.forward_dynamics(model, *state).astype(float)
    by_aba = pin.aba(theirs, data, q, v, tau)
    solved = np.linalg.solve(pin.crba(theirs, data, q), tau - pin.nonLinearEffects(theirs, data, q, v))
    return "aba" if 100 * np.abs(by_aba - exact).max() < np.abs(solved - exact).max() else "other"


def unstable_axis():
    """By Euler's equations: a small error about the others grows where the moment lies between theirs."""
    small, middle, large = np.linalg.eigvalsh(locked_inertia()[2])
    growth = [
        (middle - small) * (small - large),
        (middle - small) * (large - middle),
        (large - small) * (middle - large),
    ]
    return ("smallest", "middle", "largest")[int(np.argmax(growth))]


def rolled_with_locked_legs():
    """By Pinocchio: its M has the locked robot's inertia about the base."""
    return mass_matrix()[3, 3] / go2()[0].inertias[1].matrix()[3, 3]


def eigenvalues_of_a_point_that_are_not_zero():
    """A point at height z: ½ m |v + ω × c|², so that ωx couples with vy, and ωy with vx."""
    m, z = 2.0, 0.1
    pair = m * np.array([[z * z, z], [z, 1]])
    return 2 * int((np.abs(np.linalg.eigvalsh(pair)) > 1e-12).sum()) + 1


def children_of_the_trunk():
    """Weight of a leg: what holds it must pass through its hip."""
    theirs, _, _ = go2()
    return 9.81 * sum(theirs.inertias[i].mass for i in (2, 3, 4))


def load_of_the_front_left_foot():
    """By the levers about the rear feet; the robot is symmetric to the left and right."""
    mass, com, _ = locked_inertia()
    theirs, data, q = go2()
    pinocchio().framesForwardKinematics(theirs, data, q)
    front, rear = (data.oMf[theirs.getFrameId(foot)].translation[0] for foot in ("FL_foot", "RL_foot"))
    return 9.81 * mass * (com[0] - rear) / (front - rear) / 2


def velocity_forces_when_velocities_double():
    """By Pinocchio, gravity taken away."""
    theirs, data, q = go2()
    v = np.random.default_rng(6).standard_normal(18)
    one, two = (pinocchio().nonLinearEffects(theirs, data, q, k * v).copy() for k in (1, 2))
    g = pinocchio().computeGeneralizedGravity(theirs, data, q)
    return np.linalg.norm(two - g) / np.linalg.norm(one - g)


def where_nothing_is_passed_on():
    theirs, _, _ = go2()
    childless = [i for i in range(2, 5) if i not in list(theirs.parents)]
    return ("hip", "thigh", "calf")[childless[0] - 2]


def momentum_rate(q, v, a):
    """Rate of (l, k) by Pinocchio, of states in our order."""
    model, (theirs, data, _) = tw.load("go2"), go2()
    v, a = (tw.bridge.to_pinocchio_tangent(model, x) for x in (v, a))
    return pinocchio().computeCentroidalMomentumTimeVariation(theirs, data, q, v, a).vector.copy()


def motors_in_the_air():
    theirs, data, q = go2()
    still, pull = np.zeros(18), np.r_[np.zeros(6), np.full(12, 10.0)]
    a = pinocchio().aba(theirs, data, q, still, pull)
    lifted = pinocchio().computeCentroidalMomentumTimeVariation(theirs, data, q, still, a).linear[2]
    return "none" if np.isclose(lifted, -9.81 * locked_inertia()[0], rtol=1e-9) else "other"


def turn_of_a_cat():
    """By Pinocchio's A_G, in small steps without a midpoint."""
    pin = pinocchio()
    theirs, data, start = go2()
    q, steps = start.copy(), 2000
    for k in range(steps):
        phase, v = 2 * np.pi * (k + 0.5) / steps, np.zeros(18)
        v[6::3], v[7::3] = 0.5 * np.cos(phase), 0.5 * np.sin(phase)
        A = pin.computeCentroidalMap(theirs, data, q)
        v[:6] = np.linalg.solve(A[:, :6], -A @ v)
        q = pin.integrate(theirs, q, v * 2 * np.pi / steps)
    return np.degrees(np.linalg.norm(pin.difference(theirs, start, q)[3:6]))


def sideways_momentum(name):
    """Largest k_y of a gait, by Pinocchio."""
    model, (theirs, data, _) = tw.load("go2"), go2()
    q, v = move(np.linspace(0, 1, 61) / GAITS[name].strides, GAITS[name])
    return max(
        abs(
            pinocchio()
            .computeCentroidalMomentum(theirs, data, one, tw.bridge.to_pinocchio_tangent(model, rate))
            .angular[1]
        )
        for one, rate in zip(q, v)
    )


@cache
def trot_by_pinocchio():
    """Vertical force and horizontal moment over a trot, its accelerations by differences."""
    trot, dt = GAITS["trot"], 1e-5
    t = np.linspace(0, 1, 241) / trot.strides
    q, v = move(t, trot)
    a = (move(t + dt, trot)[1] - move(t - dt, trot)[1]) / (2 * dt)
    rates = np.array([momentum_rate(*state) for state in zip(q, v, a)])
    return rates[:, 2] + 9.81 * locked_inertia()[0], np.hypot(rates[:, 3], rates[:, 4])


def trunk_turned_by_a_knee():
    theirs, data, q = go2()
    push = np.eye(18)[8]
    change = pinocchio().aba(theirs, data, q, np.zeros(18), push) - pinocchio().aba(
        theirs, data, q, np.zeros(18), np.zeros(18)
    )
    return "turns" if np.linalg.norm(change[3:6]) > 1 else "nothing"


def torques_of_other_foot_forces():
    """Whether ‖τ‖ falls if the feet are pulled together or apart, from the least forces; Pinocchio's Jacobians."""
    pin = pinocchio()
    theirs, data, q = go2()
    J = np.vstack(
        [
            pin.computeFrameJacobian(theirs, data, q, theirs.getFrameId(f), pin.LOCAL_WORLD_ALIGNED)[:3].copy()
            for f in tw.load("go2").feet
        ]
    )
    g = pin.computeGeneralizedGravity(theirs, data, q)
    forces = np.linalg.pinv(J[:, :6].T) @ g[:6]
    squeeze = np.tile([0, -1, 0, 0, 1, 0], 2)
    size = [np.linalg.norm((g - J.T @ (forces + k * squeeze))[6:]) for k in (-1, 0, 1)]
    return "no" if min(size[0], size[2]) < size[1] else "yes"


def push_at_the_edge():
    """Lever of the weight over lever of the push."""
    mass, _, _ = locked_inertia()
    theirs, data, q = go2()
    pinocchio().framesForwardKinematics(theirs, data, q)
    return 9.81 * mass * data.oMf[theirs.getFrameId("FL_foot")].translation[1] / q[2]


def rank_on_straight_legs(hip):
    """By hand: a foot cannot move along the line from its hip's axis, unless the trunk moves that line."""
    sides = np.array([1, -1, 1, -1])
    axes = np.stack([[0.19, 0.19, -0.19, -0.19], 0.0465 * sides, 0 * sides], axis=-1)  # of the hips, m
    turned = [tw.exp3([-s * hip, 0, 0]) @ [0, s * 0.0955, -0.426] for s in sides]
    along = np.hstack([np.cross(axes + turned, turned), turned])  # rate of a leg's length by a twist of the trunk
    return 8 + np.linalg.matrix_rank(along, tol=1e-9)


def yaw_of_a_push():
    """By Pinocchio: the right moment about z and its negative, from a force on the trunk."""
    pin = pinocchio()
    theirs, data, q = go2()
    still = np.zeros(18)

    def yaw(moment):
        outside = pin.StdVec_Force(theirs.njoints, pin.Force.Zero())
        outside[1] = pin.Force(np.array([0, 30.0, 0]), np.array([0, 0, moment]))
        return pin.aba(theirs, data, q, still, still, outside)[5]

    return "other" if yaw(0.28 * 30) > 0 > yaw(-0.28 * 30) else "less"


def coupling_terms_at_a_calf():
    """By Pinocchio: how much of the velocity and of the classical acceleration of the foot is not that of the knee."""
    pin, model = pinocchio(), tw.load("go2")
    theirs, data, q = go2()
    rates = 3 * np.random.default_rng(1).standard_normal((2, 18))
    v, a = (tw.bridge.to_pinocchio_tangent(model, x) for x in rates)
    pin.forwardKinematics(theirs, data, q, v, a)
    pin.updateFramePlacements(theirs, data)
    calf, foot = theirs.getJointId("FR_calf_joint"), theirs.getFrameId("FR_foot")
    shares = []
    for of_foot, of_calf in (
        (
            pin.getFrameVelocity(theirs, data, foot, pin.LOCAL_WORLD_ALIGNED),
            pin.getVelocity(theirs, data, calf, pin.LOCAL_WORLD_ALIGNED),
        ),
        (
            pin.getFrameClassicalAcceleration(theirs, data, foot, pin.LOCAL_WORLD_ALIGNED),
            pin.getClassicalAcceleration(theirs, data, calf, pin.LOCAL_WORLD_ALIGNED),
        ),
    ):
        shares.append(np.linalg.norm(of_foot.linear - of_calf.linear) / np.linalg.norm(of_foot.linear))
    w, alpha, inertia = data.v[calf].angular, data.a[calf].angular, theirs.inertias[calf].inertia
    gyroscopic = np.cross(w, inertia @ w)
    shares.append(np.linalg.norm(gyroscopic) / np.linalg.norm(gyroscopic + inertia @ alpha))
    return "none" if min(shares) > 0.03 else "one"


def quaternion_turns_up(x, y, z, w):
    """Where the z axis of a body points, by the third column of the matrix of its quaternion."""
    up = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
    return ("side", "up", "down")[int(np.sign(round(up[2], 9))) % 3]


def leg_that_turns_at_once():
    """By Pinocchio: ω·v of the calf, which a hinge would make zero."""
    pin = pinocchio()
    theirs, data, q = go2()
    v = np.zeros(18)
    v[[theirs.joints[theirs.getJointId(f"FR_{part}_joint")].idx_v for part in ("hip", "thigh", "calf")]] = 3, -2, 4
    pin.forwardKinematics(theirs, data, q, v)
    calf = data.v[theirs.getJointId("FR_calf_joint")]
    return "screw" if abs(calf.angular @ calf.linear) > 1e-3 else "hinge"


def steps_around_a_circle():
    """Each step of 1 + [V] t has the determinant 1 + (ω t)²."""
    return "larger" if (1 + (2 * np.pi / 12) ** 2) ** 12 > 1.1 else "back"


def axis_of_a_slow_turn():
    """The rounding of v, a few 1e-17 m/s, over ω."""
    return "velocity" if 1e-17 / 1e-13 > 1e-6 > 1e-16 else "both"


def singular_values_far_apart():
    """Of a shift by d the largest singular value is d/2 + sqrt(1 + d²/4), and the smallest its inverse."""
    return (10 / 2 + np.sqrt(1 + 10**2 / 4)) ** 2


def inverse_of_the_action():
    """Pinocchio's action of the inverse placement, in (v, ω)."""
    T = pinocchio().SE3(tw.exp3([0.3, -0.2, 0.5]), np.array([0.1, -0.4, 0.7]))
    corner = -T.rotation.T @ tw.skew(T.translation)
    return "blocks" if np.allclose(T.inverse().action[:3, 3:], corner) else "other"


def force_taken_by_the_transpose():
    """Pinocchio's SE3.actInv takes a force from A to B."""
    pin = pinocchio()
    T = pin.SE3(tw.exp3([0.3, -0.2, 0.5]), np.array([0.1, -0.4, 0.7]))
    F = pin.Force(np.arange(1.0, 7))
    return "back" if np.allclose(T.action.T @ F.vector, T.actInv(F).vector) else "nowhere"


def reach_of_a_sole():
    """µ f_z times half the diagonal of the sole of the humanoid's file, 152 mm by 55 mm."""
    human = tw.load("humanoid")
    place = tw.frame_placement(human, human.standing(), "left_sole").inverse()
    corner = place.act(tw.frame_placement(human, human.standing(), "left_sole_fl").translation)
    return 0.6 * 98.1 * np.sqrt(corner[0] ** 2 + corner[1] ** 2)


def line_of_four_forces():
    """The balance of moments: the forces act where the weight does."""
    return "com" if np.isclose(load_of_the_front_left_foot() * 4, 9.81 * locked_inertia()[0], rtol=0.05) else "feet"


def zeros_of_a_mass_matrix():
    M = [
        pinocchio().crba(go2()[0], go2()[1], tw.load("go2").random_configuration(rng=np.random.default_rng(k))).copy()
        for k in range(4)
    ]
    return (np.abs(M) < 1e-12).all(axis=0).sum()


def rows_that_the_base_couples():
    """Eliminating the base adds a full matrix to the rest: all places between the legs."""
    return 6 * 9


def doubled_off_the_diagonal():
    q = tw.load("go2").random_configuration(rng=np.random.default_rng(8))
    M = pinocchio().crba(go2()[0], go2()[1], q)
    return "negative" if np.linalg.eigvalsh(2 * M - np.diag(M.diagonal())).min() < 0 else "larger"


def ground_under_a_rising_trunk():
    """By Pinocchio's centre of mass, its acceleration by differences of positions."""
    pin, model = pinocchio(), tw.load("go2")
    theirs, data, q = go2()
    J, dt, height = tw.contact_jacobian(model, q, model.feet), 1e-3, []
    for rise in (-dt, 0, dt):
        moved, trunk = q.copy(), np.array([0, 0, 0, 0, 0, rise])
        for _ in range(8):  # Newton's method: the feet stay
            feet = np.concatenate([tw.frame_placement(model, moved, f).translation for f in model.feet])
            start = np.concatenate([tw.frame_placement(model, q, f).translation for f in model.feet])
            step = np.concatenate([trunk, np.zeros(12)])
            J = tw.contact_jacobian(model, moved, model.feet)
            step[6:] = np.linalg.solve(J[:, 6:], start - feet - J[:, :6] @ trunk)
            moved, trunk = model.integrate(moved, step), 0 * trunk
        height.append(pin.centerOfMass(theirs, data, moved)[2])
    return 9.81 * locked_inertia()[0] + locked_inertia()[0] * (height[2] - height[0]) / (2 * dt)


def digits_of_pinocchio():
    """Pinocchio's digits, against the same truth."""
    mpmath, model = pytest.importorskip("mpmath"), tw.load("go2")
    theirs, data, _ = go2()
    rng = np.random.default_rng(11)
    q, (v, a) = model.random_configuration(rng=rng), rng.standard_normal((2, 18))
    with mpmath.workdps(50):
        state = [tw.newton_euler_3d.as_mpmath(x) for x in (q, v, a)]
        exact = tw.newton_euler_3d.inverse_dynamics(model, *state).astype(float)
    ours = pinocchio().rnea(theirs, data, q, *(tw.bridge.to_pinocchio_tangent(model, x) for x in (v, a)))
    return -np.log10(np.abs(tw.bridge.from_pinocchio_tangent(model, ours) - exact).max() / np.abs(exact).max())


def risen_base():
    """Pinocchio's `data.a_gf` of the base."""
    theirs, data, q = go2()
    pinocchio().rnea(theirs, data, q, np.zeros(18), np.zeros(18))
    return data.a_gf[1].linear[2]


def felt(own, others):
    """Of which of the texts a number is nearest to; to choose a word."""
    return min(others, key=lambda name: abs(others[name] - own))


ORACLES = {
    "49.1-along": lambda: "same",  # r × f = 0 for r along f
    "49.1-sign": yaw_of_a_push,
    "49.1-walked": lambda: 0.6 * 10,
    "49.1-negligible": coupling_terms_at_a_calf,
    "49.1-rolled": lambda: quaternion_turns_up(np.sqrt(0.5), np.sqrt(0.5), 0, 0),
    "49.1-full": lambda: 40 * 40,
    "49.2-origin": lambda: 0.6 * np.hypot(1.0, 0.5 + 0.8 / 0.6),  # ω times the distance of the axis
    "49.2-centre": lambda: 0.8 / 0.6,
    "49.2-straight": steps_around_a_circle,
    "49.2-together": leg_that_turns_at_once,
    "49.2-slow": axis_of_a_slow_turn,
    "49.2-order": lambda: "rolls",  # 1 where ω about x is read
    "49.3-back": inverse_of_the_action,
    "49.3-transpose": force_taken_by_the_transpose,
    "49.3-own": lambda: "own",  # X X = 1 for a transpose only if R² = 1 and p = 0
    "49.3-first": lambda: 1,  # the calf's is read before the first step
    "49.3-condition": singular_values_far_apart,
    "49.4-parts": lambda: "sum",
    "49.4-four": line_of_four_forces,
    "49.4-couple": lambda: "nothing",
    "49.4-axis": lambda: "screw" if 2 * (0.1934 * 18 + 0.142 * 12) > 1 else "force",  # the levers of the feet
    "49.4-hip": lambda: "none",
    "49.4-spin": reach_of_a_sole,
    "49.5-point": eigenvalues_of_a_point_that_are_not_zero,
    "49.5-roll": rolled_with_locked_legs,
    "49.5-plate": lambda: "never" if 1 + 1 < 10 else "any",
    "49.5-antisymmetric": lambda: "product",  # [v]× stands in one corner
    "49.5-gyroscopic": lambda: "stays" if np.cross([0.4, -0.3, 0.5], [0.4, -0.6, 1.5]).any() else "gone",
    "49.5-turnover": unstable_axis,
    "49.6-slider": lambda: 2.0 * 3.0,  # ω v: the rate of the axis, times the speed along it
    "49.6-child": children_of_the_trunk,
    "49.6-cost": lambda: 40 / 4,
    "49.6-hip": lambda: load_of_the_front_left_foot() - children_of_the_trunk(),
    "49.6-double": velocity_forces_when_velocities_double,
    "49.6-overwritten": where_nothing_is_passed_on,
    "49.7-rod": lambda: 2.0 / 4,
    "49.7-chain": lambda: felt(hanging_rods(6) / hanging_rods(1), {"six": 6, "twice": 2, "hardly": 1}),
    "49.7-roll": lambda: 100 * trunk_share(3)[1],
    "49.7-lifted": lambda: trunk_share(2)[0],
    "49.7-hip": lambda: (
        "more" if hip_under_one_newton_metre("floating") > hip_under_one_newton_metre("fixed") else "less"
    ),
    "49.7-knees": knees_of_a_dropped_go2,
    "49.7-tip": digits_at_a_heavy_tip,
    "49.8-both": lambda: "calf",  # the only body beyond the knee
    "49.8-zeros": zeros_of_a_mass_matrix,
    "49.8-fill": rows_that_the_base_couples,
    "49.8-bare": lambda: 1,
    "49.8-chain": lambda: (48 * 47 / 2 + 48) / (24 * 23 / 2 + 24),
    "49.8-recipe": doubled_off_the_diagonal,
    "49.9-kick": trunk_turned_by_a_knee,
    "49.9-least": torques_of_other_foot_forces,
    "49.9-tipping": push_at_the_edge,
    "49.9-stretch": lambda: rank_on_straight_legs(0.0),
    "49.9-upright": lambda: rank_on_straight_legs(np.arctan2(0.0955, 0.426)),
    "49.9-calf": lambda: 6 - 1,  # two points, and the distance between them
    "49.10-air": motors_in_the_air,
    "49.10-cat": lambda: "turned" if turn_of_a_cat() > 1 else "same",
    "49.10-standing": lambda: 0.0,
    "49.10-gait": lambda: max(
        ("walk", "trot", "bound"), key=lambda name: sideways_momentum({"walk": "slow walk"}.get(name, name))
    ),
    "49.10-load": lambda: 100 * trot_by_pinocchio()[0].min() / (9.81 * locked_inertia()[0]),
    "49.10-shift": lambda: 1000 * (trot_by_pinocchio()[1] / trot_by_pinocchio()[0]).max(),
    "49.10-rigid": lambda: 0.0,  # what does not turn has no angular momentum
    "49.11-order": lambda: "silent",
    "49.11-eigenvalues": lambda: "same",  # a permutation is orthogonal
    "49.11-quaternion": lambda: {"down": "back", "up": "level"}.get(quaternion_turns_up(1, 0, 0, 0)),
    "49.11-risen": risen_base,
    "49.11-rise": ground_under_a_rising_trunk,
    "49.11-digits": digits_of_pinocchio,
}


ROUGH = {"49.6-cost": 0.05, "49.8-chain": 0.05, "49.11-digits": 0.05}
"""Where the second way leaves something out: the lines before the loops, luck in rounding."""


def test_every_answer_has_an_oracle():
    assert list(ORACLES) == list(ALL)


@pytest.mark.parametrize("name", EVERY)
def test_an_answer_is_found_a_second_time(name):
    question, truth, again = ALL[name], ALL[name].compute()["truth"], ORACLES[name]()
    if question.choices:
        assert truth == again
    else:
        assert truth == pytest.approx(again, rel=ROUGH.get(name, 1e-4), abs=1e-9)


# ---------------------------------------------------------------- what is told


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("name", EVERY)
def test_the_right_guess_is_right_and_the_usual_wrong_ones_get_their_sentence(name, language):
    question, facts = ALL[name], ALL[name].compute()

    def told(answer):
        return Asked(question, facts, answer, language)

    assert told(facts["truth"]).right is True
    for wrong, said in question.usual.items():
        asked = told(wrong if question.choices else facts[wrong])
        assert asked.right is False
        assert said.of(language).format(**facts) in asked._verdict
    if question.choices:
        assert {*question.choices} == {*question.usual, facts["truth"]}  # no choice without its sentence
    assert len(question.usual) >= 1
    shown = Asked(question, facts, None, language)
    assert shown.right is None
    assert "{" not in repr(told(facts["truth"])) + repr(shown)


@pytest.mark.parametrize("name", EVERY)
def test_a_question_is_in_both_languages_with_the_same_numbers(name):
    question = ALL[name]
    for text in (question.text, question.why, *question.choices.values(), *question.usual.values()):
        assert not re.search("[\u4e00-\u9fff]", text.en)
        assert re.search("[\u4e00-\u9fff]", text.zh) or text.en == text.zh
        assert sorted(re.findall(r"\{.*?\}", text.en)) == sorted(re.findall(r"\{.*?\}", text.zh))


@pytest.mark.parametrize("section", SECTIONS)
def test_a_data_file_holds_what_is_used_and_nothing_else(section):
    file = Path(tw.exercises.__file__).parent / "questions" / f"section_{section.replace('.', '_')}.toml"
    for name, entry in tomllib.loads(file.read_text(encoding="utf-8")).items():
        kinds = {"choices"} if "choices" in entry else {"unit", "rtol", "atol"}
        assert {"text", "why", "usual"} <= set(entry) <= {"text", "why", "usual"} | kinds, name
        pairs = [entry["text"], entry["why"], *entry["usual"].values(), *entry.get("choices", {}).values()]
        assert {len(pair) for pair in pairs} == {2}, name


def test_a_guess_that_is_near_is_right_and_another_is_told_by_how_much():
    near, far, sign, zero = (tw.ask("49.7-rod", guess, language="en") for guess in (0.51, 10, -0.5, 0))
    assert near.right
    assert "20" in far._verdict  # the factor
    assert len({far._verdict, sign._verdict, zero._verdict}) == 3


def test_a_notebook_shows_the_answer_folded_and_marks_what_is_text():
    asked, guessed = tw.ask("49.7-knees", ...), tw.ask("49.7-knees", "A)")
    assert asked._repr_html_().count("<details>") == len(asked.question.choices)
    assert guessed.guess == "fold"
    assert guessed.letter == "a"
    page = guessed._repr_html_()
    assert page.index("tw-wrong") < page.index("<details>") < page.index("Gravity accelerates")
    assert isinstance(guessed, Asked)


def test_the_guess_is_drawn_beside_the_truth():
    plt = pytest.importorskip("matplotlib.pyplot", reason="matplotlib is not installed: nothing is drawn")
    _, ax = plt.subplots()
    tw.ask("49.7-lifted", ...).draw(ax)
    assert not ax.lines
    tw.ask("49.7-lifted", 16, language="en").draw(ax, "y")
    assert [line.get_ydata()[0] for line in ax.lines] == [16, pytest.approx(13.4, abs=0.1)]
    plt.close("all")


@pytest.mark.parametrize(
    ("name", "guess", "error", "told"),
    [
        ("49.7-knee", None, NameNotFound, "49.7-knees"),
        ("49.12-knees", None, NameNotFound, "49.12-knees"),
        ("49.7-knees", "d", ValueError, "a, b, c"),
        ("49.7-knees", 0.0, ValueError, "a, b, c"),
        ("49.7-lifted", "heavy", ValueError, "kg"),
        ("49.7-lifted", np.nan, ValueError, "kg"),
    ],
)
def test_what_is_no_question_or_no_guess_is_refused_by_name(name, guess, error, told):
    with pytest.raises(error, match=re.escape(told)):
        tw.ask(name, guess)


@pytest.mark.parametrize("name", [None, 3, "49.9-nothing"])
def test_what_is_no_name_of_a_question_is_not_known(name):
    with pytest.raises(tw.NameNotFound, match="question"):
        tw.ask(name)
