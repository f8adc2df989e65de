"""What an exercise forbids is noticed: calls that its text rules out, and the reference itself."""

import functools
import sys

import numpy as np
import pytest

import twistwrench as tw
from misstep.judge import judge
from misstep.rules import broken_rules
from twistwrench.algorithms.rnea import newton_euler
from twistwrench.exercises import check, mine, start
from twistwrench.exercises.chapter import COURSE
from twistwrench.exercises.forbidden import FORBIDDEN
from twistwrench.exercises.items.project_trees import tree_of

from .test_exercises_isolation import said, write


def verdict(name, function):
    return judge(*COURSE.find_part(name), function)


def rest_wrench(model, q):
    return tw.rnea(model, q, np.zeros(model.nv), np.zeros(model.nv))[:6]


def summed(model, q):
    return tw.centroidal_map(model, q) @ np.eye(model.nv)


@pytest.mark.parametrize("name", FORBIDDEN)
def test_every_rule_is_that_of_a_function_and_names_what_there_is(name):
    assert COURSE.find_part(name)[1].name == name
    rooms = tw, tw.bridge, tw.newton_euler_3d
    assert all(any(callable(getattr(room, called, None)) for room in rooms) for called in FORBIDDEN[name])


@pytest.mark.one_case
@pytest.mark.parametrize(
    ("name", "function", "called"),
    [
        ("base_wrench_at_rest", rest_wrench, "rnea"),
        ("base_wrench_at_rest", lambda model, q: tw.gravity(model, q)[:6], "gravity"),
        ("mass_matrix_by_rnea", lambda model, q: tw.crba(model, q), "crba"),
        ("base_block", lambda model, q: tw.crba(model, q)[:6, :6], "crba"),
        ("own_centroidal_map", summed, "centroidal_map"),
    ],
)
def test_a_forbidden_call_is_wrong_though_the_numbers_are_right(name, function, called):
    found = verdict(name, function)
    assert found.state == "wrong"
    assert f"calls tw.{called}, and the exercise asks to do without it" in " ".join(found.message("en").split())
    assert f"调用了 tw.{called}" in found.message("zh")


def named(model, q):
    return getattr(tw, "crba")(model, q)  # noqa: B009


def imported(model, q):
    from twistwrench.algorithms.crba import crba

    return crba(model, q)


def renamed(model, q):
    package = tw
    fast = package.fast
    return fast.crba(model, q)


class Tools:
    matrix = staticmethod(tw.crba)

    def of(self, model, q):
        return tw.crba(model, q)


TABLE = {"M": tw.crba}
PROGRAM = tw.compile(tw.load("go2"), "crba")
TOOLS = Tools()

DISGUISES = {
    "itself": tw.crba,
    "partial": functools.partial(tw.crba),
    "cached": functools.cache(lambda model, q: tw.crba(model, q)),
    "default": lambda model, q, f=tw.crba: f(model, q),
    "mapped": lambda model, q: next(map(tw.crba, [model], [q])),
    "in a table": lambda model, q: TABLE["M"](model, q),
    "in a class": lambda model, q: Tools.matrix(model, q),
    "method": TOOLS.of,
    "of an object": lambda model, q: TOOLS.of(model, q),
    "helper": lambda model, q: imported(model, q),
    "imported": imported,
    "renamed": renamed,
    "named": named,
    "evaluated": lambda model, q: eval("tw.crba(model, q)"),
    "compiled": lambda model, q: tw.compile(model, "crba")(q),
    "wanted": lambda model, q: tw.compile(model, want={"M"})(q).M,
    "traced": lambda model, q: tw.trace(model, "crba", q),
    "program": PROGRAM,
    "calls a program": lambda model, q: PROGRAM(q),
    "factors": lambda model, q: tw.ltl(model, q).T @ tw.ltl(model, q),
    "slow": lambda model, q: tw.newton_euler_3d.mass_matrix(model, q),
}


@pytest.mark.parametrize("disguise", DISGUISES)
def test_a_forbidden_call_is_met_in_every_disguise_that_needs_no_malice(disguise):
    part = COURSE.find_part("mass_matrix_by_rnea")[1]
    found = broken_rules(COURSE.rules, part, DISGUISES[disguise])
    assert len(found) == 1
    assert "asks to do without it" in found[0].en


def by_forces(model, q):
    """Without crba."""
    rest = np.zeros(model.nv)
    return np.array([tw.rnea(model, q, rest, e) - tw.rnea(model, q, rest, rest) for e in np.eye(model.nv)]).T


@pytest.mark.parametrize(
    "function", [by_forces, lambda model, q: tw.compile(model, "rnea")(q), mine("skew"), lambda m: m]
)
def test_what_is_not_forbidden_is_not_taken_for_it(function):
    assert broken_rules(COURSE.rules, COURSE.find_part("mass_matrix_by_rnea")[1], function) == []


@pytest.mark.parametrize("file", ["<stdin>", "<string>", "<console>", "<python-input-3>", "<ipython-input-1-ab>"])
def test_what_is_typed_or_run_by_exec_is_the_students(file):
    names = {"tw": tw}
    exec(compile("def base_block(model, q):\n    return tw.crba(model, q)[:6, :6]", file, "exec"), names)
    found = check("49.8.1", names["base_block"], language="en", time_limit=0).verdicts["base_block"]
    assert found.state == "wrong"
    assert "line 2 calls tw.crba" in " ".join(found.message("en").split())


@pytest.mark.slow
def test_the_reference_is_refused_whatever_its_name(tmp_path):
    reference = COURSE.find_part("skew")[1].solution
    assert not check("49.0.1", reference, time_limit=0).right
    start(tmp_path, language="en")
    head = "from twistwrench.exercises.items.ex_49_0_1 import skew as given"
    write(tmp_path, "49.0", more=f"\n{head}\nskew = given\n")
    assert "those of the reference" in said(tmp_path, "skew")[1]


def test_the_right_answer_is_not_there_while_the_students_function_runs():
    def skew(w):
        frame, held = sys._getframe(), []
        while frame is not None:
            held += [x for x in frame.f_locals.values() if isinstance(x, np.ndarray) and x.shape == (3, 3)]
            frame = frame.f_back
        return held[-1] if held else np.zeros((3, 3))

    assert verdict("skew", skew).state == "wrong"


@pytest.mark.slow
def test_what_the_package_calls_by_itself_is_not_held_against_the_student():
    def by_levers(model, q):
        base = tw.forward_kinematics(model, q).placement[1]
        force = -model.mass * base.rotation.mT @ model.gravity
        return np.concatenate([np.cross(base.inverse().act(tw.center_of_mass(model, q)), force), force])

    assert verdict("base_wrench_at_rest", by_levers).state == "done"
    assert verdict("torques_two_ways", COURSE.find_part("torques_two_ways")[1].solution).state == "done"


def test_wrong_numbers_are_explained_first():
    assert "calls tw.rnea" not in verdict("base_wrench_at_rest", lambda m, q: -rest_wrench(m, q)).message("en")


def test_the_reference_is_not_an_answer(tmp_path):
    skew = mine("skew")
    assert "those of the reference" in verdict("skew", lambda w: skew(w)).message("en")
    start(tmp_path, language="en")
    body = "from twistwrench.exercises.chapter import COURSE\nreturn COURSE.find_part('skew')[1].solution(w)"
    write(tmp_path, "49.0", {"skew": body})
    assert "those of the reference, which it calls" in " ".join(said(tmp_path, "skew")[1].split())


def test_the_listing_of_an_algorithm_is_not_an_answer():
    def by_listing(parent, S, I, X, qd, qdd, a0):
        column = [x[:, None] for x in qd], [x[:, None] for x in qdd], [np.zeros((6, 1))] * len(parent)
        return newton_euler(tree_of(parent, S, I, X, a0), *column).tau

    assert "those of the reference" in verdict("tree_rnea", by_listing).message("en")


def test_what_needs_pinocchio_is_not_done_by_the_package():
    pytest.importorskip("pinocchio")
    found = verdict("jacobian_from_pinocchio", by_the_package)
    assert "calls tw.bridge.from_pinocchio_model, and the exercise asks" in " ".join(found.message("en").split())


def by_the_package(model, q, frame):
    own = tw.bridge.from_pinocchio_model(model)
    return tw.frame_jacobian(own, q, frame, reference="local_world_aligned")


def test_an_answer_that_changes_the_model_is_met():
    """Its numbers are compared with those of the model as it was."""
    pin = pytest.importorskip("pinocchio")
    solution = COURSE.find_part("acceleration_from_pinocchio")[1].solution

    def weightless(model, q, v, tau):
        model.gravity = pin.Motion.Zero()
        return solution(model, q, v, tau)

    assert "It changes its argument `model`" in verdict("acceleration_from_pinocchio", weightless).message("en")


def test_a_result_that_is_written_down_is_not_computed():
    def about_center_of_mass(m, com, I_c):
        return np.block([[I_c, 0 * I_c], [0 * I_c, m * np.eye(3)]])

    found = verdict("about_center_of_mass", about_center_of_mass)
    assert "com is not used: the exercise asks to compute them" in " ".join(found.message("en").split())

    def about_center_of_mass(m, com, I_c):
        I, S = np.zeros((6, 6)), tw.skew(com)
        I[:3, :3] = I_c - m * S @ S + m * S @ S
        I[3:, 3:] = m * np.eye(3)
        return I

    assert verdict("about_center_of_mass", about_center_of_mass).state == "done"
