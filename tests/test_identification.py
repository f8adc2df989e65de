"""Which combinations of inertial parameters can be told: published counts, a rule by hand, exact ranks, Pinocchio."""

from fractions import Fraction

import numpy as np
import pytest

import twistwrench as tw
from twistwrench import bridge
from twistwrench.fast.derivatives import regressor

from .robots import shared

SOLID = tw.SpatialInertia(1.0, [0.1, 0.2, 0.3], np.diag([0.1, 0.2, 0.15]))


def count(model):
    return len(tw.base_parameters(model).independent)


def ten_numbers(model):
    return np.concatenate([inertia.parameters() for inertia in model.inertia[1:]])


def planar_2r(gravity):
    robot = tw.Builder("2R", gravity=gravity)
    robot.link("first", parent="base_link", joint=tw.Revolute("z"), inertia=SOLID)
    robot.link("second", parent="first", joint=tw.Revolute("z"), inertia=SOLID,
               placement=tw.SE3(np.eye(3), [0.7, 0, 0]))  # fmt: skip
    return robot.build()


def arm(joints, rng, gravity=(0, 0, -9.81)):
    """An arm of any geometry."""
    robot, last = tw.Builder("arm", gravity=gravity), "base_link"
    for k, joint in enumerate(joints):
        place = tw.SE3(tw.exp3(rng.standard_normal(3)), rng.standard_normal(3))
        robot.link(f"link{k}", parent=last, joint=joint, placement=place, inertia=SOLID)
        last = f"link{k}"
    return robot.build()


# ---------------------------------------------------------------- published


@pytest.mark.one_case
@pytest.mark.parametrize(
    ("robot", "published"),
    [
        ("ur5", 36),  # Gautier and Khalil: 7 · 6 − 4 − 2, as of every arm of six hinges on a vertical first one
        ("panda", 43 + 2 * 4),  # 43 of the arm (Gaz et al., 2019), and 4 of each finger
        ("go2", 10 + 12 * 7),  # a floating base, 7 a hinge (Ayusawa, Venture and Nakamura, 2014)
    ],
)
def test_the_numbers_are_those_that_are_published(robot, published):
    assert count(shared(robot)) == published


def test_of_a_planar_arm_the_combinations_are_those_of_the_textbook():
    """Khalil and Dombre, Siciliano: Izz₁ + l² m₂, mx₁ + l m₂, my₁, Izz₂, mx₂, my₂; of gravity along the axes four."""
    base = tw.base_parameters(planar_2r([0, -9.81, 0]))
    l = 0.7
    number = {name: k for k, name in enumerate(base.names)}
    expected = np.zeros((6, 20))
    sums = [{"mx of first": 1, "m of second": l}, {"my of first": 1}, {"Izz of first": 1, "m of second": l * l},
            {"mx of second": 1}, {"my of second": 1}, {"Izz of second": 1}]  # fmt: skip
    for row, terms in zip(expected, sums):
        for name, x in terms.items():
            row[number[name]] = x
    np.testing.assert_allclose(base.combinations, expected, rtol=0, atol=1e-12)
    flat = tw.base_parameters(planar_2r([0, 0, -9.81]))
    assert [base.names[k] for k in flat.independent] == [
        "Izz of first",
        "mx of second",
        "my of second",
        "Izz of second",
    ]
    assert flat.combinations[0, number["m of second"]] == pytest.approx(l * l, rel=1e-12)
    assert "Izz of first + 0.49 m of second + Izz of second" not in str(flat)  # that is another parameter


@pytest.mark.parametrize(("upright", "n"), [(True, 3), (False, 3), (True, 6), (False, 7)])
def test_the_rule_of_mayeda_for_arms_of_hinges(upright, n):
    """7 n − 4, and two fewer where gravity is along the first axis (Mayeda, Yoshida and Osuka, 1990)."""
    rng = np.random.default_rng(n)
    model = arm([tw.Revolute("z")] * n, rng)
    down = tw.frame_placement(model, model.neutral(), "link0").rotation[:, 2]
    model = arm([tw.Revolute("z")] * n, np.random.default_rng(n), 9.81 * down if upright else (0, 0, -9.81))
    assert count(model) == 7 * n - 4 - 2 * upright


# ---------------------------------------------------------------- a rule by hand, for joints of every kind


def moved_through(joint):
    """How many inertias act alike on both sides of a joint: those that feel no motion of it, and stay when turned."""
    S, rng = joint.subspace(), np.random.default_rng(0)
    rows = []
    for _ in range(6):
        q = joint.integrate(joint.neutral(), rng.standard_normal(joint.nv))
        X = joint.transform(q).inverse().motion_transform()
        rows.append(np.stack([(X.T @ I @ X - I).ravel() for I in UNITS], axis=1))
    rows.append(np.stack([(I @ S).ravel() for I in UNITS], axis=1))
    return 10 - np.linalg.matrix_rank(np.concatenate(rows), tol=1e-9)


def unit(k):
    ten = np.eye(10)[k]
    C = tw.skew(ten[1:4])
    xx, xy, yy, xz, yz, zz = ten[4:]
    return np.block([[np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), C], [-C, ten[0] * np.eye(3)]])


UNITS = [unit(k) for k in range(10)]


def test_three_numbers_pass_a_hinge_and_six_a_slide():
    assert [moved_through(joint) for joint in (tw.Revolute([1, 2, 2]), tw.Prismatic("x"), tw.Spherical())] == [3, 6, 1]


@pytest.mark.one_case
@pytest.mark.parametrize("seed", range(6))
def test_on_a_floating_base_each_joint_hides_what_passes_it(seed):
    model = tw.random_tree(9, rng=seed, base="floating")
    assert count(model) == 10 + sum(10 - moved_through(joint) for joint in model.joints[2:])


# ---------------------------------------------------------------- exact ranks, Pinocchio, what it is for


def exact_rank(A):
    """The rank of a matrix of fractions by elimination: nothing is rounded."""
    rank, A = 0, A.copy()
    for k in range(A.shape[1]):
        pivot = next((i for i in range(rank, len(A)) if A[i, k]), None)
        if pivot is None:
            continue
        A[[rank, pivot]] = A[[pivot, rank]]
        below = np.flatnonzero(A[rank + 1 :, k]) + rank + 1
        A[below, k:] -= np.outer(A[below, k] / A[rank, k], A[rank, k:])
        rank += 1
    return rank


@pytest.mark.parametrize("axes", [("z", "z", "x"), ("y", [0.36, 0.48, -0.8], "y"), ("x", "x", "x")])
def test_the_rank_of_fractions_is_the_same(axes):
    robot, last, rng = tw.Builder("exact"), "base_link", np.random.default_rng(1)
    for k, axis in enumerate(axes):
        turn = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]]) if k == 2 else np.eye(3)
        robot.link(f"link{k}", parent=last, joint=tw.Continuous(axis), inertia=SOLID,
                   placement=tw.SE3(turn, [0.5, 0.25 * k, 0]))  # fmt: skip
        last = f"link{k}"
    model = robot.build()
    pythagorean = [(3, 4, 5), (5, 12, 13), (8, 15, 17), (20, 21, 29), (-7, 24, 25), (9, -40, 41)]
    rows = []
    for _ in range(12):
        chosen = [pythagorean[i] for i in rng.integers(0, 6, 3)]
        q = np.array([Fraction(x, c) for a, b, c in chosen for x in (a, b)], object)
        v, a = np.array([[Fraction(int(x), 4) for x in row] for row in rng.integers(-9, 9, (2, 3))], object)
        rows.append(regressor(model, q, v, a))
    Y = np.concatenate(rows)
    assert exact_rank(np.array([[Fraction(x) for x in row] for row in Y], object)) == count(model)


@pytest.mark.parametrize("seed", range(3))
def test_the_rank_of_pinocchios_regressor_is_the_same(seed):
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    rng = np.random.default_rng(seed)
    kinds = [(tw.Revolute("z"), tw.Prismatic("x"), tw.Revolute("y"))[k] for k in rng.integers(0, 3, 5)]
    model = arm(kinds, rng)
    there = bridge.to_pinocchio_model(model)
    data = there.createData()
    Y = [pin.computeJointTorqueRegressor(there, data, *rng.standard_normal((3, 5))).copy() for _ in range(60)]
    Y = np.concatenate(Y)
    assert np.linalg.matrix_rank(Y / np.maximum(np.linalg.norm(Y, axis=0), 1e-9), tol=1e-7) == count(model)


def test_least_squares_find_them_and_they_give_the_torques():
    model, rng = shared("ur5"), np.random.default_rng(0)
    base = tw.base_parameters(model)
    q, v, a = rng.standard_normal((3, 50, 6))
    Y = tw.compile(model, "Y", backend="numpy")(q, v, a)[..., base.independent].reshape(-1, 36)
    found = np.linalg.lstsq(Y, tw.rnea(model, q, v, a).ravel(), rcond=None)[0]
    right = base.combinations @ ten_numbers(model)
    np.testing.assert_allclose(found, right, rtol=0, atol=1e-11)
    assert 0.3 < base.share.min() <= base.share.max() <= 1 + 1e-12


@pytest.mark.parametrize("length", [1e-3, 1.0, 1e3])
def test_units_and_limits_do_not_count(length):
    """A pendulum about an oblique upright axis: one number, and rounding is none; then two links of any size."""
    axis = np.array([1.0, 2.0, 2.0]) / 3
    one = tw.Builder("upright", gravity=9.81 * length * axis)
    one.link("rod", parent="base_link", joint=tw.Revolute(axis), inertia=SOLID)
    model = one.build()
    assert count(model) == 1
    two = tw.Builder("2R", gravity=[0, -9.81 * length, 0])
    for name, on in (("first", "base_link"), ("second", "first")):
        two.link(name, parent=on, joint=tw.Revolute("z"), inertia=SOLID, lower=-1e-9, upper=1e-9,
                 placement=tw.SE3(np.eye(3), [0.7 * length, 0, 0]))  # fmt: skip
    assert count(two.build()) == 6


def test_a_robot_without_joints_has_none():
    base = tw.base_parameters(tw.Builder("rock").build())
    assert base.combinations.shape == (0, 0)
    assert str(base) == "0 base parameters of 0 numbers:"
    with pytest.raises(TypeError):
        tw.base_parameters("ur5")
