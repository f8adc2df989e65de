"""The cases of an answer: no turn and half a turn, negative arguments, a second call, and a change that ends Python."""

from functools import partial

import numpy as np
import pytest

import twistwrench as tw
from misstep.cases import cases, further_cases
from misstep.judge import judge
from twistwrench.exercises import case
from twistwrench.exercises.chapter import COURSE
from twistwrench.exercises.stopwatch import seconds

PARTS = {p.name: p for e in COURSE.exercises for p in e.parts if not e.needs}


def message(name, function):
    verdict = judge(*COURSE.find_part(name), function)
    assert verdict.state == "wrong"
    return " ".join(verdict.message("en", level=3).split())


def orientations(name, arguments):
    """Return the rotations among the arguments of a function."""
    for argument, value in zip(PARTS[name].arguments.split(", "), arguments):
        if argument == "q" and np.size(value) >= 7:
            yield rotation_of(value)
        elif argument.startswith("R") and np.shape(value) == (3, 3):
            yield value
        elif argument == "T":
            yield from np.reshape(value, (-1, 4, 4))[-1:, :3, :3]


def test_each_answer_meets_no_turn_and_half_a_turn():
    """Every q, R and T of the arguments comes level and turned by 180°, and is still an orientation."""
    for name in ("act", "adjoint", "base_pose", "body_twists", "foot_twist", "net_wrench", "plucker"):
        level, turned = (list(orientations(name, arguments)) for arguments in further_cases(COURSE, PARTS[name], 0)[:2])
        assert level
        for R, Q in zip(level, turned):
            assert np.allclose(R, np.eye(3), atol=1e-15)
            assert np.isclose(np.trace(Q), -1)  # 1 + 2 cos 180°
            assert np.allclose(Q @ Q.mT, np.eye(3))
            assert np.linalg.det(Q) > 0


def rotation_of(q):
    x, y, z, w = q[3:7]
    u = np.array([x, y, z])
    return (w * w - u @ u) * np.eye(3) + 2 * np.outer(u, u) + 2 * w * tw.skew(u)


def test_a_formula_that_divides_by_the_angle_is_met():
    def base_pose(q):
        angle = 2 * np.arctan2(np.linalg.norm(q[3:6]), q[6])
        with np.errstate(invalid="ignore"):
            axis = q[3:6] / np.linalg.norm(q[3:6])
        T = np.eye(4)
        K = tw.skew(np.nan_to_num(axis, nan=1.0))
        T[:3, :3] += np.sin(angle) * K + (1 - np.cos(angle)) * K @ K if np.isfinite(axis).all() else np.nan
        T[:3, 3] = q[:3]
        return T

    said = judge(*COURSE.find_part("base_pose"), base_pose, search=False).message("en", level=3)
    assert "entries that are not finite numbers" in " ".join(said.split())


def test_a_function_that_keeps_a_buffer_is_met():
    out = np.zeros(18)

    def on_all_rows(tau):
        result = out if len(tau) == 12 else np.zeros(6 + len(tau))
        result[6:] += tau
        return result

    assert "keeps something from one call to the next" in message("on_all_rows", on_all_rows)


def test_a_function_that_remembers_by_size_is_met():
    known = {}

    def on_all_rows(tau):
        return known.setdefault(len(tau), np.concatenate([np.zeros(6), tau]))

    assert "keeps something" in message("on_all_rows", on_all_rows)


def test_a_constant_is_not_taken_for_something_kept():
    assert "keeps something" not in message("on_all_rows", lambda tau: np.zeros(6 + len(tau)))


@pytest.mark.parametrize(
    ("name", "function"),
    [
        ("center_of_pressure", lambda F: np.array([-F[1], F[0]]) / abs(F[5])),
        ("twist_matrix", lambda omega_z, v_x: tw.hat([0, 0, abs(omega_z), v_x, 0, 0])),
        ("arc", lambda omega_z, v_x: tw.exp6([0, 0, omega_z, abs(v_x), 0, 0]).matrix()),
        ("finite_limits", lambda lo, up: (np.maximum(lo, -1e6) if np.isfinite(lo[0]) else lo, up)),
    ],
)
def test_arguments_of_both_signs_are_met(name, function):
    message(name, function)


def reference(name):
    return COURSE.find_part(name)[1].solution


def straight_below(omega, least):
    return tw.exp6([0, 0, omega * (abs(omega) >= least), 1, 0, 0]).matrix()


def of_pressure(F, d_x, d_y, *, beyond=0.0, least=0.0):
    return bool(F[5] > least and abs(F[1]) <= (d_x + beyond) * F[5] and abs(F[0]) <= (d_y + beyond) * F[5])


def off(forward, inverse, model, q, v, tau):
    back = inverse(model, q, v, forward(model, q, v, tau))
    return np.abs(back - tau), np.abs(tau).max()


def consistency_in_single(forward, inverse, model, q, v, tau):
    back, expected = (np.asarray(x, np.float32) for x in (inverse(model, q, v, forward(model, q, v, tau)), tau))
    return float(np.abs(back - expected).max() / np.abs(expected).max())


def in_blocks(first, second, calls, clock):
    return min(seconds(second, calls + 10, clock)) / min(seconds(first, calls + 10, clock))


def after_the_pattern_of_omega(omega_z, v_x):
    A = np.zeros((4, 4), type(omega_z))
    A[1, 0], A[0, 1], A[0, 3] = omega_z, -omega_z, v_x
    return A


def in_place(R, p, x):
    moved = R @ x
    moved += p
    return moved


@pytest.mark.parametrize(
    ("name", "function"),
    [
        ("twist_matrix", after_the_pattern_of_omega),
        ("act", in_place),
        ("sole_holds", partial(of_pressure, least=1e-16)),
        *(("arc", lambda w, v, least=least: straight_below(w, least)) for least in (0.3, 1e-2, 1e-4, 1e-6)),
        ("sole_holds", lambda F, d_x, d_y: bool(abs(F[1]) <= d_x * F[5] and abs(F[0]) <= d_y * F[5])),
        *(("sole_holds", partial(of_pressure, beyond=beyond)) for beyond in (1e-3, 1e-6, -1e-7)),
        ("sole_holds", partial(of_pressure, least=1e-3)),
        ("time_ratio", in_blocks),
        ("measured_ratio", lambda: 1 / 2.3),
        ("finite_limits", lambda lo, up: (np.where(abs(lo) > 10, -1, lo), np.where(abs(up) > 10, 1, up))),
        ("finite_limits", lambda lo, up: (np.where(lo < -1e9, -1, lo), np.where(up > 1e9, 1, up))),
        ("get_dynamics", lambda model, q, v, feet: reference("get_dynamics")(model, q, v, sorted(feet))),
        ("consistency_error", lambda *case: (lambda e, most: e.max() / most * (e.max() > 1e-6 * most))(*off(*case))),
        ("consistency_error", lambda *case: (lambda e, most: np.nan_to_num(e).max() / most)(*off(*case))),
        ("consistency_error", consistency_in_single),
        ("act", lambda R, p, x: (R if np.trace(R) < 2.999999 else np.eye(3)) @ x + p),
        ("cross_operators", lambda V: reference("cross_operators")(V * (abs(V) > 1e-4))),
        ("tree_rnea", lambda *lists: reference("tree_rnea")(*lists[:-1], np.array([0, 0, 0, 0, 0, 9.81]))),
        ("growth", lambda N, t: np.polyfit(np.arange(len(N)), np.log2(t), 1)[0]),
    ],
)
def test_thresholds_orders_and_limits_are_met(name, function):
    assert judge(*COURSE.find_part(name), function, search=False).state == "wrong"


@pytest.mark.one_case
@pytest.mark.parametrize("way", [np.median, min, lambda times: np.mean(sorted(times)[25:75])])
def test_a_right_way_to_measure_is_not_refused(way):
    def per_call(task, calls, clock):
        task()
        return way(seconds(task, calls, clock))

    def ratio(first, second, calls, clock):
        pairs = [(seconds(first, 1, clock)[0], seconds(second, 1, clock)[0]) for _ in range(calls)]
        return way([b for _, b in pairs]) / way([a for a, _ in pairs])

    for name, function in (("time_per_call", per_call), ("time_ratio", ratio)):
        assert {judge(*COURSE.find_part(name), function, seed=seed).state for seed in range(5)} == {"done"}


def test_the_branch_that_is_right_to_rounding_is_not_refused():
    assert "numbers are right" in message("arc", lambda w, v: tw.exp6([0, 0, w, v, 0, 0]).matrix())


def test_further_cases_are_had_by_their_number():
    part = PARTS["base_pose"]
    (q,) = case("base_pose", len(cases(part, 3)), seed=3)
    assert np.array_equal(q[3:7], [0, 0, 0, 1])


def test_what_is_right_but_in_a_special_case_is_refused():
    """Every further kind of case catches an answer that is right in all others."""

    def whole(R, p, x):
        moved = np.zeros_like(x)
        moved[:] = R @ x + p
        return moved

    def near(p):
        X = tw.motion_transform(np.eye(3), p if np.abs(p).max() > 1e-8 else np.zeros(3))
        return X, np.linalg.inv(X), np.linalg.inv(X).mT

    def at_rest(m, I_c, omega, alpha, a_c):
        tau, f = PARTS["newton_euler"].solution(m, I_c, omega, alpha, a_c)
        return (tau if alpha.any() else 0 * tau), f

    def joints(model, q, v, a):
        M, h = tw.crba(model, q), tw.nonlinear_effects(model, q, v)
        return tw.rnea(model, q, v, a), np.zeros(len(q) - 1) + M @ a + h

    def of_the_last(tau):
        out = np.zeros(6 + len(tau))
        out[-len(tau) :] = tau
        return out

    def after_its_pattern(A_G):
        w = np.zeros_like(A_G[:, 0])
        w[5] = 9.81
        return A_G.mT @ w

    def with_mass(I, R, p):
        X = np.linalg.inv(tw.motion_transform(R, p))
        return X.mT @ (I * I[3, 3] / I[3, 3]) @ X

    said = message("act", whole)
    assert "numbers are right" not in said
    assert "Wrong in 1 of" in judge(*COURSE.find_part("translation_transforms"), near, search=False).message("en")
    for function in (of_the_last, after_its_pattern, with_mass):
        name = {after_its_pattern: "gravity_from_map", with_mass: "moved_inertia"}.get(function, "on_all_rows")
        assert judge(*COURSE.find_part(name), function, search=False).state == "wrong"
    assert judge(*COURSE.find_part("newton_euler"), at_rest, search=False).state == "wrong"
    assert judge(*COURSE.find_part("torques_two_ways"), joints, search=False).state == "wrong"


def test_one_array_does_not_count_twice():
    def chain_two_ways(R_AB, p_AB, R_BC, p_BC):
        X = tw.motion_transform(R_AB @ R_BC, p_AB + R_AB @ p_BC)
        return X, X

    assert "one and the same array" in message("chain_two_ways", chain_two_ways)
