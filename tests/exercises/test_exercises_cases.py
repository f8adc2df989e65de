"""The cases of an answer: no turn and half a turn, negative arguments, a second call, and a change that ends Python."""

import os

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.exercises import catalogue
from twistwrench.exercises.cases import case, cases, further_cases
from twistwrench.exercises.forking import judged
from twistwrench.exercises.judge import judge

PARTS = {p.name: p for e in map(catalogue.exercise, catalogue.available()) for p in e.parts if not e.needs}


def message(name, function):
    verdict = judge(*catalogue.find_part(name), function)
    assert verdict.state == "wrong"
    return " ".join(verdict.message("en").split())


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
        level, turned = (list(orientations(name, arguments)) for arguments in further_cases(PARTS[name], 0)[:2])
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

    assert "entries that are not numbers" in message("base_pose", base_pose)


def test_a_function_that_keeps_a_buffer_is_met():
    out = np.zeros(18)

    def on_all_rows(tau):
        result = out if len(tau) == 12 else np.zeros(6 + len(tau))
        result[6:] += tau
        return result

    assert "it keeps something from one call to the next" in message("on_all_rows", on_all_rows)


def test_a_function_that_remembers_by_size_is_met():
    known = {}

    def on_all_rows(tau):
        return known.setdefault(len(tau), np.concatenate([np.zeros(6), tau]))

    assert "the same array as in an earlier call" in message("on_all_rows", on_all_rows)


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


def test_further_cases_are_had_by_their_number():
    part = PARTS["base_pose"]
    (q,) = case("base_pose", len(cases(part, 3)), seed=3)
    assert np.array_equal(q[3:7], [0, 0, 0, 1])


@pytest.mark.skipif(os.name != "posix", reason="a copy of the process is made on Linux")
def test_a_change_that_ends_the_process_is_not_taken_for_the_answer():
    """The search tries changes of the student's function, and a library may end Python at one of them."""
    calls = []

    def act(R, p, x):
        calls.append(0)
        if len(calls) > 14:
            os._exit(1)
        return R @ x * np.cos(p)

    found = judged(*catalogue.find_part("act"), act, seed=0, time_limit=10)
    assert "ended the whole process" not in found.message("en")


def test_one_array_does_not_count_twice():
    def chain_two_ways(R_AB, p_AB, R_BC, p_BC):
        X = tw.motion_transform(R_AB @ R_BC, p_AB + R_AB @ p_BC)
        return X, X

    assert "one and the same array" in message("chain_two_ways", chain_two_ways)
