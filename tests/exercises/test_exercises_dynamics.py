"""The references of 49.8 to 49.11 and of the project against mechanics without 6-D vectors, and against Pinocchio."""

from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import newton_euler_3d as mechanics
from twistwrench.exercises.chapter import COURSE
from twistwrench.model import joint_placements, tree_terms
from twistwrench.model.tree import split

GO2 = tw.load("go2")
WORLD = np.zeros(3)


def reference(name):
    return COURSE.find_part(name)[1].solution


def some_trees():
    """Yield robots without rotors, which the lists of the recursions do not know, and states of them."""
    rng = np.random.default_rng(49)
    for model in (GO2, tw.random_tree(6, rng=rng), tw.random_tree(7, rng=rng, base="floating")):
        bare = replace(model, armature=np.zeros(model.nv))
        yield bare, bare.random_configuration(rng=rng), *rng.standard_normal((2, bare.nv))


TREES = [pytest.param(*state, id=state[0].name + " " + state[0].base) for state in some_trees()]


def lists(model, q):
    tree = tree_terms(model, q)
    return tree.parent, [*tree.S], [*tree.I], [*tree.X]


def near(a, b, scale=1.0):
    np.testing.assert_allclose(a, b, rtol=0, atol=1e-12 * scale * max(1, np.abs(b).max(initial=0)))


# ---------------------------------------------------------------- the project on any tree


@pytest.mark.parametrize(("model", "q", "v", "a"), TREES)
def test_placements_and_twists_are_those_of_ordinary_vectors(model, q, v, a):
    T = np.array([placement.matrix() for placement in joint_placements(model, q)])
    R, p = mechanics.placements(model, q)
    oMi = reference("body_placements")(model.parent, T)
    near(oMi[:, :3, :3], R)
    near(oMi[:, :3, 3], p)
    V_joint = np.array([S @ rate for S, rate in zip(tree_terms(model, q).S, split(model, v), strict=True)])
    near(reference("body_twists")(model.parent, T, V_joint), mechanics.body_twists(model, q, v))


@pytest.mark.parametrize(("model", "q", "v", "a"), TREES)
def test_joints_pass_on_what_newton_and_euler_ask_for(model, q, v, a):
    T = np.array([placement.matrix() for placement in joint_placements(model, q)])
    motion = tw.forward_kinematics(model, q, v, a)
    fall = np.array([np.r_[WORLD, P.rotation.T @ model.gravity] for P in motion.placement])
    need = [
        I.matrix() @ (A - g) + tw.cross_force(V) @ I.matrix() @ V
        for I, V, A, g in zip(model.inertia, motion.twist, motion.acceleration, fall, strict=True)
    ]
    carried = reference("carried_wrenches")(model.parent, T, np.array(need))
    wanted = mechanics.joint_wrenches(model, q, v, a)
    near(carried[1:], wanted[1:], 10)


@pytest.mark.parametrize(("model", "q", "v", "a"), TREES)
def test_the_recursions_are_right(model, q, v, a):
    parent, S, I, X = lists(model, q)
    a0 = np.r_[WORLD, -model.gravity]
    qd, rest = split(model, v), split(model, a)
    near(reference("tree_rnea")(parent, S, I, X, qd, rest, a0), mechanics.inverse_dynamics(model, q, v, a), 10)
    near(reference("tree_crba")(parent, S, I, X), mechanics.mass_matrix(model, q), 10)
    near(reference("tree_energy")(parent, S, I, X, qd), mechanics.kinetic_energy(model, q, v), 10)
    qdd = mechanics.forward_dynamics(model, q, v, a)
    near(reference("tree_aba")(parent, S, I, X, qd, rest, a0), qdd, np.linalg.cond(mechanics.mass_matrix(model, q)))


def test_a_foots_rows_are_those_of_j_c():
    q = GO2.random_configuration(rng=np.random.default_rng(1))
    J_c = tw.contact_jacobian(GO2, q, GO2.feet)
    for k, foot in enumerate(GO2.feet):
        frame = GO2.frame(foot)
        J = tw.frame_jacobian(GO2, q, GO2.joint_names[frame.body])
        R = tw.forward_kinematics(GO2, q).placement[frame.body].rotation
        near(reference("rows_of_foot")(J, R, frame.placement.translation), J_c[3 * k : 3 * k + 3])


def test_the_momentum_is_that_of_ordinary_vectors():
    rng = np.random.default_rng(2)
    q, (v, a) = GO2.random_configuration(rng=rng), rng.standard_normal((2, 18))
    near(reference("own_centroidal_map")(GO2, q), mechanics.centroidal_map(GO2, q))
    near(reference("momentum_rate")(GO2, q, v, a), mechanics.centroidal_momentum_rate(GO2, q, v, a))
    near(reference("momentum_of_links")(GO2, q, v), mechanics.centroidal_momentum(GO2, q, v)[3:])
    rate, wrench = reference("rate_and_wrench")(GO2, q, v, rng.standard_normal(12), rng.standard_normal((4, 3)))
    near(rate, wrench, 100)


def test_the_loads_by_levers_are_those_of_the_dynamics():
    q = GO2.standing()
    feet = np.array([tw.frame_placement(GO2, q, foot).translation for foot in GO2.feet])
    by_levers = reference("vertical_loads")(tw.center_of_mass(GO2, q), feet, GO2.mass * 9.81)
    near(by_levers[[0, 2]], reference("standing_loads")())
    forces, tau = reference("standing_forces")(mechanics.gravity(GO2, q), tw.contact_jacobian(GO2, q, GO2.feet))
    near(by_levers, forces[:, 2])
    near(tau, tw.static_equilibrium(GO2, q).tau)


# ---------------------------------------------------------------- 49.8 to 49.11


def test_the_held_robot_is_the_one_with_a_fixed_base():
    held = tw.load("go2", base="fixed")
    q = GO2.random_configuration(rng=np.random.default_rng(3))
    near(reference("held_mass_matrix")(tw.crba(GO2, q)), mechanics.mass_matrix(held, q[7:]))
    assert reference("mass_matrix_sizes")() == (GO2.nv, held.nv)


def test_gravity_is_read_off_the_map():
    q = GO2.random_configuration(rng=np.random.default_rng(4))
    near(reference("gravity_from_map")(mechanics.centroidal_map(GO2, q)), mechanics.gravity(GO2, q))


def test_figures_of_the_model_answers():
    M = tw.crba(GO2, GO2.neutral())
    m, c, _ = reference("whole_robot")(M[:6, :6])
    near(c.round(3), [0.008, 0, -0.028])
    assert (round(m, 3), round(M[0, 2], 4), GO2.inertia[1].mass.round(3)) == (16.085, 0.0017, 7.277)
    _, c, I_G = reference("whole_robot")(tw.crba(GO2, GO2.standing())[:6, :6])
    near(c.round(3), [-0.002, 0, -0.018])
    near(I_G.diagonal().round(3), [0.166, 0.501, 0.562])
    front, rear = reference("standing_loads")()
    assert (round(front, 2), round(rear, 2), round(100 * (rear / front - 1), 1)) == (39.10, 39.80, 1.8)
    assert reference("count_transforms")(GO2.parent) == (39, 24)
    assert reference("count_transforms")(tw.chain(13).parent) == (39, 78)


# ---------------------------------------------------------------- Pinocchio


@pytest.fixture(scope="module")
def theirs():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    model = tw.bridge.to_pinocchio_model(GO2)
    return pin, model, model.createData()


def test_the_toolbox_gives_pinocchios_data(theirs):
    pin, model, data = theirs
    rng = np.random.default_rng(5)
    q, (v, a) = GO2.random_configuration(rng=rng), rng.standard_normal((2, 18))
    pin.rnea(model, data, q, *(tw.bridge.to_pinocchio_tangent(GO2, x) for x in (v, a)))
    pin.forwardKinematics(model, data, q, tw.bridge.to_pinocchio_tangent(GO2, v))
    T = np.array([placement.matrix() for placement in joint_placements(GO2, q)])
    V_joint = np.array([S @ rate for S, rate in zip(tree_terms(GO2, q).S, split(GO2, v), strict=True)])
    near(reference("body_placements")(GO2.parent, T), [M.homogeneous for M in data.oMi])
    V = reference("body_twists")(GO2.parent, T, V_joint)
    near(V, [np.r_[V.angular, V.linear] for V in data.v])
    near(reference("base_pose")(q), data.oMi[1].homogeneous)


def test_wrenches_are_pinocchios(theirs):
    pin, model, data = theirs
    rng = np.random.default_rng(6)
    q, (v, a) = GO2.random_configuration(rng=rng), rng.standard_normal((2, 18))
    pin.rnea(model, data, q, *(tw.bridge.to_pinocchio_tangent(GO2, x) for x in (v, a)))
    T = np.array([placement.matrix() for placement in joint_placements(GO2, q)])
    need = np.array([np.r_[F.angular, F.linear] for F in data.f])  # what all joints bear ...
    for i in range(1, GO2.nbodies):  # ... less what goes on to the children is what the bodies need
        for child in (k for k in range(1, GO2.nbodies) if GO2.parent[k] == i):
            F = data.liMi[child].act(data.f[child])
            need[i] -= np.r_[F.angular, F.linear]
    need[0] = 0
    carried = reference("carried_wrenches")(GO2.parent, T, need)
    near(carried[1:], [np.r_[F.angular, F.linear] for F in list(data.f)[1:]])


def test_the_seven_tests_hold_when_mended(theirs):
    pin, model, data = theirs
    pin.seed(49)
    lower, upper = reference("finite_limits")(model.lowerPositionLimit, model.upperPositionLimit)
    q, (v, a, tau) = pin.randomConfiguration(model, lower, upper), np.random.default_rng(7).standard_normal((3, 18))
    assert np.isfinite(q).all()
    M, h = pin.crba(model, data, q).copy(), pin.rnea(model, data, q, v, 0 * v).copy()
    torque, acceleration = reference("by_mass_matrix")(M, h, a, tau)
    near(torque, pin.rnea(model, data, q, v, a), 10)
    near(acceleration, pin.aba(model, data, q, v, tau), 1e3)
    for i in (1, 3, 5):
        I = model.inertias[i]
        near(reference("pinocchio_inertia")(I.mass, I.lever, I.inertia), I.matrix())
    pin.forwardKinematics(model, data, q)
    for i in (1, 4, 7):
        near(reference("pinocchio_action")(data.oMi[i].rotation, data.oMi[i].translation), data.oMi[i].action)
    h_G = pin.computeCentroidalMomentum(model, data, q, v).vector.copy()
    A_G = pin.computeCentroidalMap(model, data, q).copy()
    near(A_G @ v, h_G)
    pin.centerOfMass(model, data, q, v)
    near(reference("com_velocity")(h_G, pin.computeTotalMass(model)), data.vcom[0])
    near(reference("pinocchio_linear_momentum")(A_G, v), pin.computeTotalMass(model) * data.vcom[0])
    J = [pin.computeFrameJacobian(model, data, q, model.getFrameId(foot), pin.LOCAL_WORLD_ALIGNED) for foot in GO2.feet]
    J_c = reference("contact_rows")(np.array(J))
    assert np.linalg.matrix_rank(J_c) == 12
    near(J_c, tw.bridge.to_pinocchio_contact_jacobian(GO2, tw.contact_jacobian(GO2, q, GO2.feet)))
