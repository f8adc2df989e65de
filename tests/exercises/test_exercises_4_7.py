"""The exercises of 49.4 to 49.7: their references against Pinocchio, and how somebody measures a time."""

import numpy as np
import pytest

import twistwrench as tw
from misstep.judge import judge
from misstep.text import Text
from twistwrench.exercises.chapter import COURSE
from twistwrench.exercises.robots import robot, small_robot, weightless
from twistwrench.exercises.stopwatch import UP, Machine, Task

TOLERANCE = 1e-12


def reference(name):
    return COURSE.find_part(name)[1].solution


def cases(name, seed=49):
    return COURSE.find_part(name)[1].cases(np.random.default_rng(seed))


@pytest.fixture(scope="module")
def pin():
    return pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")


@pytest.fixture(scope="module")
def go2(pin):
    model = tw.bridge.to_pinocchio_model(robot("go2"))
    return model, model.createData()


def close(a, b):
    np.testing.assert_allclose(a, b, rtol=0, atol=TOLERANCE * np.abs(b).max())


# ---------------------------------------------------------------- references against Pinocchio


def test_a_contact_seen_from_the_world_is_what_pinocchio_makes_of_it(pin):
    for R, p, f_c in cases("contact_wrench"):
        wanted = tw.bridge.from_pinocchio_force(pin.SE3(R, p).act(pin.Force(f_c, np.zeros(3))).vector)
        for F in reference("contact_wrench")(R, p, f_c):
            close(F, wanted)


def test_the_center_of_pressure_of_forces_straight_up_is_their_weighted_mean():
    rng = np.random.default_rng(4)
    points = np.c_[rng.uniform(-0.1, 0.1, (5, 2)), np.zeros(5)]
    load = rng.uniform(10, 100, 5)
    F = reference("sole_wrench")(points, load[:, None] * [0, 0, 1])
    close(reference("center_of_pressure")(F), load @ points[:, :2] / load.sum())


def test_a_pull_and_a_push_beyond_the_edge_are_refused():
    holds = reference("sole_holds")
    assert holds(np.array([0, 0, 0, 0, 0, 100.0]), 0.1, 0.05)
    assert holds(np.array([5.0, -10, 0, 0, 0, 100]), 0.1, 0.05)  # on both edges
    assert not holds(np.array([5.1, 0, 0, 0, 0, 100]), 0.1, 0.05)
    assert not holds(np.array([0, 0, 0, 0, 0, -100.0]), 0.1, 0.05)


def test_ten_numbers_make_the_matrix_that_pinocchio_makes(pin):
    build, reorder = reference("spatial_inertia"), reference("chapter_order")
    for m, c, I_c in cases("spatial_inertia"):
        close(build(m, c, I_c), reorder(pin.Inertia(m, c, I_c).matrix()))


def test_the_link_of_the_text_is_positive_definite_and_its_slips_are_not():
    matrix, eigenvalues = reference("link_inertia")()
    np.testing.assert_allclose(matrix[0, [0, 4]], [0.03, -0.2], rtol=1e-14)
    pair = 1.015 + np.array([-1, 1]) * np.sqrt(1.015**2 - 0.02)  # of [[0.03, ±0.2], [±0.2, 2]], twice
    assert eigenvalues == pytest.approx([0.005, *pair[[0, 0]], 2, *pair[[1, 1]]], rel=TOLERANCE)
    slips = COURSE.find_part("link_inertia")[1].slips
    assert slips["parallel-axis-dropped"]()[1][0] < 0
    assert slips["parallel-axis-sign"]()[1][0] < 0


def test_an_inertia_moves_as_in_pinocchio(pin):
    for m, c, I_c in cases("spatial_inertia"):
        R, p = tw.exp3(c), 3 * c + 1
        wanted = pin.SE3(R, p).act(pin.Inertia(m, c, I_c)).matrix()
        got = reference("moved_inertia")(reference("spatial_inertia")(m, c, I_c), R, p)
        close(got, tw.bridge.from_pinocchio_transform(wanted))


def test_the_base_of_go2_is_pinocchios_body_1(go2):
    mass, matrix = reference("base_inertia")(robot("go2"))
    wanted = go2[0].inertias[1]
    assert mass == pytest.approx(wanted.mass, rel=TOLERANCE)
    close(matrix, tw.bridge.from_pinocchio_transform(wanted.matrix()))


def test_what_holds_the_base_is_what_pinocchios_rnea_says(pin, go2):
    model, rest = robot("go2"), np.zeros(18)
    for seed in range(3):
        q = model.random_configuration(rng=seed)
        wanted = pin.rnea(*go2, q, rest, rest)[:6]
        close(reference("base_wrench_at_rest")(model, q), tw.bridge.from_pinocchio_force(wanted))


def test_a_fall_is_pinocchios(pin, go2):
    model, rng = robot("go2"), np.random.default_rng(7)
    q, v = model.random_configuration(rng=rng), rng.standard_normal(18)
    v_pin, rest = tw.bridge.to_pinocchio_tangent(model, v), np.zeros(18)
    close(
        reference("fall_from_rest")(model, q)[1], tw.bridge.from_pinocchio_tangent(model, pin.aba(*go2, q, rest, rest))
    )
    a = pin.aba(*go2, q, v_pin, rest)
    pin.forwardKinematics(*go2, q, v_pin, a)
    of_base, of_com = reference("fall_in_motion")(model, q, v)
    close(of_base, pin.getClassicalAcceleration(*go2, 1, pin.LOCAL_WORLD_ALIGNED).linear)
    pin.centerOfMass(*go2, q, v_pin, a)
    close(of_com, go2[1].acom[0])


def test_robots_without_weight_differ_in_nothing_else():
    model = small_robot(np.random.default_rng(3))
    q = model.random_configuration(rng=1)
    assert not tw.gravity(weightless(model), q).any()
    np.testing.assert_array_equal(tw.crba(weightless(model), q), tw.crba(model, q))


# ---------------------------------------------------------------- measuring


def interleaved(reduce, *, warm_up=0, in_a_row=1, of_ratios=False):
    """Return a measurement that calls the two in turn."""

    def function(first, second, calls, clock):
        for _ in range(warm_up):
            first()
            second()
        times = []
        for _ in range(calls // in_a_row):
            start = clock()
            for _ in range(in_a_row):
                first()
            between = clock()
            for _ in range(in_a_row):
                second()
            times.append((between - start, clock() - between))
        a, b = np.transpose(times)
        return reduce(b / a) if of_ratios else reduce(b) / reduce(a)

    return function


def one_after_the_other(reduce):
    """Return a measurement with a warm-up that first times the one and then the other."""

    def of(function, calls, clock):
        function()
        times = []
        for _ in range(calls):
            start = clock()
            function()
            times.append(clock() - start)
        return reduce(times)

    return lambda first, second, calls, clock: 1 / (of(first, calls, clock) / of(second, calls, clock))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    "measure",
    [
        interleaved(np.min),
        interleaved(np.median),
        interleaved(np.median, warm_up=5),
        interleaved(np.median, of_ratios=True),
        interleaved(np.min, in_a_row=10),
        interleaved(np.median, in_a_row=5),
    ],
)
def test_every_sound_measurement_passes(measure, seed):
    assert judge(*COURSE.find_part("time_ratio"), measure, seed=seed).state == "done"


@pytest.mark.parametrize(
    ("measure", "slip"),
    [
        (one_after_the_other(np.min), "blocks-in-turn"),
        (one_after_the_other(np.median), "blocks-in-turn"),
        (one_after_the_other(np.mean), "mean-of-blocks"),
        (interleaved(np.mean, warm_up=5), "mean-of-times"),
        (interleaved(np.sum), "mean-of-times"),
        (lambda first, second, calls, clock: interleaved(np.min)(second, first, calls, clock), "ratio-inverted"),
    ],
)
def test_an_unsound_measurement_is_told_why_however_it_is_written(measure, slip):
    assert judge(*COURSE.find_part("time_ratio"), measure).slips == (slip,)


def test_a_machine_slows_down_pauses_and_starts_slowly():
    machine = Machine(Text("", ""), start=1.0, pause=10.0, paused_at=[2], slow_from=3)
    work, took = Task(machine, 0.5), []
    for _ in range(4):
        start = machine()
        work()
        took.append(machine() - start)
    assert took == [1.5, 0.5, 10.5, 1.5]
    machine.reset()
    assert (machine(), machine.readings) == (UP, 1)  # it does not begin at zero, as no real one does


@pytest.mark.parametrize(
    ("ratio", "state"), [(1.1, "done"), (0.8, "done"), (2.4, "done"), (18, "wrong"), (2e-3, "wrong")]
)
def test_a_measured_ratio_need_only_be_plausible(ratio, state):
    assert judge(*COURSE.find_part("measured_ratio"), lambda: ratio).state == state
