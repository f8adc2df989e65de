"""A loop that a hinge closes: five rows. By hand, the tree that has the hinge as a joint, Pinocchio, many turns."""

from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge

ROD = tw.SpatialInertia(1.3, [0.02, 0.1, -0.3], np.diag([0.05, 0.04, 0.02]))
AXIS = np.array([0.48, 0.6, 0.64])
PIVOT = tw.SE3(tw.exp3([0.2, -0.4, 0.3]), [0.1, -0.2, 0.3])


def tree(axis=AXIS):
    """An arm whose last joint is the hinge."""
    robot = tw.Builder("tree")
    robot.link("arm", parent="base_link", joint=tw.Revolute("y"), inertia=ROD)
    robot.link("rod", parent="arm", joint=tw.Revolute(axis), placement=PIVOT, inertia=ROD)
    return robot.build()


def cut():
    """The same arm and a free rod: the hinge holds the rod's frame in the arm's frame `pivot`."""
    robot = tw.Builder("cut")
    robot.link("arm", parent="base_link", joint=tw.Revolute("y"), inertia=ROD)
    robot.link("pivot", parent="arm", placement=PIVOT)
    robot.link("rod", parent="base_link", joint=tw.FreeFlyer(), inertia=ROD)
    return robot.build()


TREE, CUT = tree(), cut()
HINGE = tw.LoopClosure("rod", "pivot", axis=3 * AXIS)


def state_of_cut(q, v):
    T = tw.frame_placement(TREE, q, "rod")
    place = tw.FreeFlyer().from_placement(T, CUT.neutral()[1:])
    return np.r_[q[0], place], np.r_[v[0], tw.frame_jacobian(TREE, q, "rod") @ v]


@pytest.mark.parametrize("seed", range(4))
def test_a_free_rod_on_a_hinge_moves_as_on_a_joint(seed):
    rng = np.random.default_rng(seed)
    q, v = rng.uniform(-3, 3, 2), rng.standard_normal(2)
    here, rates = state_of_cut(q, v)
    expected = tw.aba(TREE, q, v, [0.7, 0.0])
    held = tw.contact_forward_dynamics(CUT, here, rates, np.r_[0.7, np.zeros(6)], [HINGE])
    assert (int(held.rank), int(held.redundant)) == (5, 0)
    motion = tw.frame_jacobian(TREE, q, "rod") @ expected + tw.frame_bias_acceleration(TREE, q, v, "rod")
    np.testing.assert_allclose(held.qdd, np.r_[expected[0], motion], rtol=0, atol=1e-12)
    # λ is the wrench of the joint, in the axes of the pivot: none about the axis.
    wrench = tw.joint_wrenches(TREE, q, v, expected)[2]
    turn = tw.exp3(q[1] * AXIS)
    force = np.r_[turn @ wrench[:3], turn @ wrench[3:]]
    np.testing.assert_allclose(HINGE.directions.T @ held.forces["rod"], force, rtol=0, atol=1e-12)


def test_pinocchio_moves_the_tree_in_the_same_way():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    q, v = np.array([0.4, 2.5]), np.array([1.0, -2.0])
    there = bridge.to_pinocchio_model(TREE)
    expected = pin.aba(there, there.createData(), q, v, np.array([0.3, 0.0]))
    held = tw.contact_forward_dynamics(CUT, *state_of_cut(q, v), np.r_[0.3, np.zeros(6)], [HINGE])
    assert held.qdd[0] == pytest.approx(expected[0], rel=1e-12)


def test_a_compound_pendulum_by_hand():
    """m g l sin θ over the inertia about the axis, and the force in the pivot that carries it."""
    m, l, J = 2.0, 0.4, 0.3
    rod = tw.SpatialInertia(m, [0, 0, -l], np.diag([0.1, J, 0.2]))
    robot = tw.Builder("pendulum")
    robot.link("rod", parent="base_link", joint=tw.FreeFlyer(), inertia=rod)
    model, theta, rate = robot.build(), 0.7, 1.5
    q = np.r_[0, 0, 0, 0, np.sin(theta / 2), 0, np.cos(theta / 2)]
    v = np.r_[0, rate, 0, 0, 0, 0]
    held = tw.contact_forward_dynamics(model, q, v, np.zeros(6), [tw.LoopClosure("rod", "base_link", axis=[0, 1, 0])])
    alpha = -m * 9.81 * l * np.sin(theta) / (J + m * l**2)
    np.testing.assert_allclose(held.qdd, [0, alpha, 0, 0, 0, 0], rtol=0, atol=1e-13)
    inward, along = np.array([np.sin(theta), 0, np.cos(theta)]), np.array([np.cos(theta), 0, -np.sin(theta)])
    force = m * (l * rate**2 * inward - l * alpha * along) + [0, 0, m * 9.81]
    np.testing.assert_allclose(held.forces["rod"], np.r_[0, 0, force], rtol=0, atol=1e-12)


def test_two_points_on_the_axis_hold_what_the_hinge_holds():
    robot = tw.Builder("cut")
    robot.link("arm", parent="base_link", joint=tw.Revolute("y"), inertia=ROD)
    robot.link("pivot", parent="arm", placement=PIVOT)
    robot.link("there", parent="pivot", placement=tw.SE3(np.eye(3), AXIS))
    robot.link("rod", parent="base_link", joint=tw.FreeFlyer(), inertia=ROD)
    robot.link("here", parent="rod", placement=tw.SE3(np.eye(3), AXIS))
    model, tau = robot.build(), np.r_[0.7, np.zeros(6)]
    state = state_of_cut(np.array([0.3, 1.1]), np.array([0.5, -1.0]))
    points = [tw.LoopClosure("rod", "pivot"), tw.LoopClosure("here", "there")]
    one, two = (tw.contact_forward_dynamics(model, *state, tau, held) for held in ([HINGE], points))
    np.testing.assert_allclose(one.qdd, two.qdd, rtol=0, atol=1e-12)
    assert (int(two.rank), int(two.redundant)) == (5, 1)


def test_it_turns_many_times_and_stays_on_its_axis():
    q, v = np.array([0.2, 0.0]), np.array([3.0, 20.0])
    here, rates = state_of_cut(q, v)
    free, right = (replace(model, gravity=np.zeros(3)) for model in (CUT, TREE))
    held = tw.simulate(free, here, rates, dt=2e-3, duration=0.8, contacts=[HINGE])
    right = tw.simulate(right, q, v, dt=2e-3, duration=0.8)
    assert np.ptp(right.q[:, 1]) > 4 * np.pi
    np.testing.assert_allclose(held.q[-1, 0], right.q[-1, 0], rtol=0, atol=1e-4)
    axes = [tw.frame_placement(CUT, held.q, name).rotation @ AXIS for name in ("pivot", "rod")]
    assert np.abs(axes[0] - axes[1]).max() < 1e-9


@pytest.mark.parametrize("turn", [0.0, 1.0, 3.0, np.pi, 3.3, 6.0])
def test_a_tilt_is_taken_back_however_far_the_hinge_has_turned(turn):
    anchors = tw.contact_placements(CUT, state_of_cut(np.array([0.3, 0.0]), np.zeros(2))[0], [HINGE])
    here, rates = state_of_cut(np.array([0.3, turn]), np.zeros(2))
    tilted = CUT.integrate(here, [0.0, 0.05, -0.08, 0.03, 0.01, 0.02, -0.01])
    back, _ = tw.project_state(CUT, tilted, rates, [HINGE], anchors)[:2]
    T = tw.frame_placement(CUT, back, "pivot").inverse() @ tw.frame_placement(CUT, back, "rod")
    np.testing.assert_allclose(T.rotation @ AXIS, AXIS, rtol=0, atol=1e-9)
    np.testing.assert_allclose(T.translation, 0, rtol=0, atol=1e-9)
    assert np.abs(CUT.difference(tilted, back)).max() < 0.15  # the nearest, not another turn


def test_an_axis_that_is_turned_over_is_an_error_of_half_a_turn():
    over = HINGE.held_turn(tw.exp3(np.pi * np.cross(AXIS, [1.0, 0, 0]) / np.linalg.norm(np.cross(AXIS, [1.0, 0, 0]))))
    assert np.linalg.norm(over) == pytest.approx(np.pi, rel=1e-9)
    assert abs(over @ AXIS) < 1e-6
    flipped = tw.LoopClosure("rod", "pivot", axis=[0, 0, 1]).held_turn(np.diag([1.0, -1, -1]))
    assert np.linalg.norm(flipped) == pytest.approx(np.pi, rel=1e-12)
    assert flipped[2] == 0


def test_what_is_no_hinge_is_refused_by_name():
    for given, said in (
        ({"axis": [0, 0, 0]}, "axis: expected a direction"),
        ({"axis": [0, 1]}, "axis"),
        ({"axis": [0, 0, 1], "welded": True}, "got both"),
        ({"axis": [0, 0, 1], "velocity": [1, 0, 0, 0, 0]}, "no turn of the axis in 'pivot'"),
        ({"axis": [0, 0, 1], "velocity": [0, 0, 0]}, "velocity"),
    ):
        with pytest.raises(ValueError, match=f"'rod'.*{said}"):
            tw.LoopClosure("rod", "pivot", **given)
    assert tw.LoopClosure("rod", "pivot", axis=[0, 0, 2]) == tw.LoopClosure("rod", "pivot", axis=(0, 0, 1.0))
