"""What a message says: of the case that it shows, the first cause first, and nothing that gives the solution away."""

import warnings

import numpy as np
import pytest

import twistwrench as tw
from misstep.differences import differences
from misstep.judge import judge
from misstep.verdict import as_json, from_json
from misstep.workbook import Workbook, offered
from twistwrench.errors import NameNotFound
from twistwrench.exercises import check, hint, start
from twistwrench.exercises.chapter import COURSE
from twistwrench.exercises.forbidden import FORBIDDEN
from twistwrench.exercises.slips import SLIPS

from .answers import said_of
from .test_exercises_isolation import said, write


def verdict(name, function):
    return judge(*COURSE.find_part(name), function)


def message(name, function, language="en"):
    return " ".join(verdict(name, function).message(language).split())


# ---------------------------------------------------------------- what gives the solution away


def test_the_reference_gives_no_warning_and_a_students_function_does(tmp_path):
    start(tmp_path, language="en")
    book = Workbook(COURSE, tmp_path)
    with warnings.catch_warnings(record=True) as met:
        warnings.simplefilter("always")
        offered("center_of_pressure", book)(np.zeros(6))
        verdict("sole_holds", lambda F, d_x, d_y: bool(offered("center_of_pressure", book)(F)[0] <= d_x))
    assert met == []
    with pytest.warns(RuntimeWarning, match="divide"):
        verdict("center_of_pressure", lambda F: np.array([-F[1], F[0]]) / (0 * F[5]))


def test_a_wrong_center_of_pressure_and_a_sole_leave_nothing_of_the_solution_on_stderr(tmp_path, capfd):
    start(tmp_path, language="en")
    bodies = {
        "center_of_pressure": "return F[:2]",
        "sole_holds": 'x, y = mine("center_of_pressure")(F)\nreturn bool(F[5] > 0 and abs(x) <= d_x and abs(y) <= d_y)',
    }
    write(tmp_path, "49.4", bodies)
    for name in bodies:
        said(tmp_path, name)
    assert "ex_49_4_3" not in capfd.readouterr().err


# ---------------------------------------------------------------- what is said of the case that is shown


def test_the_relation_is_that_of_the_case_shown():
    found = verdict("count", lambda kinds: (19, 18))
    nq, nv = (compared.expected for compared in found.case.compared)
    assert nq > 0
    assert nv > 0
    assert "must be zero" not in found.message("en")


def test_an_argument_that_is_changed_is_the_only_cause_and_the_hint_is_a_copy():
    def act(R, p, x):
        x[:] = R @ x + p
        return x

    found = verdict("act", act)
    assert len(found.lines) == 2
    assert "`x`" in found.lines[1].en
    assert "np.array(x, dtype=float)" in found.help[0].en
    name, x = found.case.inputs[2]
    assert (name, x.dtype.kind) == ("x", "f")


def test_whole_numbers_are_sent_and_shown_as_such():
    found = from_json(as_json([np.array([99, -58]), 18, np.uint8(7)]))
    assert [np.asarray(x).dtype.kind for x in found] == ["i", "i", "i"]
    assert verdict("selection", lambda nv: np.eye(nv)).case.given("en") == ["nv = 18"]


def test_a_whole_array_that_cuts_off_is_named():
    def skew(w):
        W = np.zeros((3, 3), dtype=int)
        W[0, 1], W[0, 2], W[1, 0], W[1, 2], W[2, 0], W[2, 1] = -w[2], w[1], w[2], -w[0], -w[1], w[0]
        return W

    assert "dtype=float" in message("skew", skew)
    assert "dtype=float" in message("skew", skew, "zh")


@pytest.mark.parametrize(("factor", "is_said"), [(1 + 2e-3, False), (1 + 3e-4, False), (1 + 1e-6, True)])
def test_digits_are_counted_only_where_few_are_wrong(factor, is_said):
    _, part = COURSE.find_part("newton_euler")
    tau = np.array([1.0, 2.0, 3.0])
    lines, _ = differences(part, (factor * tau, tau), (tau, tau))
    assert ("digits" in lines[0].en) == is_said


def test_an_entry_that_is_marked_is_seen_to_differ():
    _, part = COURSE.find_part("on_all_rows")
    found = verdict("on_all_rows", lambda tau: part.solution(tau) * (1 + 1e-5))
    rows = [line for line in found.case.text("en").split("\n") if "[" in line and "]  " in line]
    assert rows
    for row in rows:
        expected, got = row.rpartition("  [")[0].split()[-1], row.rpartition("[")[2].strip(" ]")
        assert expected != got


# ---------------------------------------------------------------- lists


@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_list_of_blocks_is_no_matrix(language):
    for rows in (lambda R: [[R, 0], [0, R]], lambda R: [[R, 0 * R], [0 * R, R]]):
        assert "np.block(...)" in message("rotation_transform", rows, language)


def test_mine_hands_on_what_was_judged(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {"act": "return (R @ x + p).tolist()"})
    moved = offered("act", Workbook(COURSE, tmp_path))(np.eye(3), np.zeros(3), np.ones(3))
    np.testing.assert_array_equal(moved, np.ones(3), strict=True)
    place = "R, t = tw.exp3([0, 0, omega_z]), omega_z\nv = v_x / t\n"
    write(tmp_path, "49.2", {"arc": place + "return tw.SE3(R, [v * np.sin(t), v * (1 - np.cos(t)), 0])"})
    book = Workbook(COURSE, tmp_path)
    found = offered("arc", book)(1.0, 2.0)
    assert book.borrowed == set()
    assert type(found) is np.ndarray


# ---------------------------------------------------------------- where to read on, and what to ask


def test_a_stop_says_where_to_read_and_how_to_ask():
    for function in (lambda R, p, x: undefined, lambda R, p, x: R @ x @ p @ x):  # noqa: F821
        assert [line.en for line in verdict("act", function).more] == [
            "Read §49.3.",
            "For more: twistwrench exercises hint act",
        ]


def test_the_questions_at_the_beginning_send_to_a_section_that_teaches():
    for exercise in COURSE.of_section("49.0"):
        assert exercise.taught in {*COURSE.sections} - {"49.0"}
    assert "49.0" not in {slip.section for slip in SLIPS.values()}
    assert verdict("count", lambda kinds: (1, 2)).more[0].en == "Read §49.1."


EULER = """
def newton_euler(m, I_c, omega, alpha, a_c):
    tau = I_c @ alpha + np.cross(omega, I_c @ omega)
    return RETURNED
"""


@pytest.mark.parametrize(
    ("returned", "words"),
    [
        ("tau[:, None], m * a_c", "shape (3, 1)"),
        ("tau + np.cos(alpha), m * a_c", "Kind of slip: something too much."),
        ("I_c @ alpha + np.cross(omega, I_c @ np.deg2rad(omega)), m * a_c", "Kind of slip: something too much."),
    ],
)
def test_an_edit_that_leaves_out_says_that_something_is_too_much_and_a_shape_says_itself(tmp_path, returned, words):
    told = said_of(tmp_path, EULER.strip().replace("RETURNED", returned))
    assert words in told
    assert "shape" not in words or "Kind of slip" not in told


# ---------------------------------------------------------------- hints where a notebook has checked


def plucker(R, p):
    zero, coupling = np.zeros((3, 3)), -tw.skew(p) @ R
    return np.block([[R, zero], [coupling, R]]), np.block([[R, coupling], [zero, R]])


def test_the_circle_says_what_is_not_checked_yet():
    def arc(omega_z, v_x):
        c, s = np.cos(omega_z), np.sin(omega_z)
        x, y = v_x * s / omega_z, v_x * (1 - c) / omega_z
        return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]])

    assert "twist_matrix" in check("49.2.2", arc, language="en").progress


def test_a_hint_after_check_knows_what_was_wrong_and_the_language(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = check("49.3.2", plucker, language="zh")
    assert 'tw.exercises.hint("plucker")' in repr(found)
    first, second = hint("49.3.2"), hint("plucker")
    assert found.verdicts["plucker"].help[0].zh[:10] in first
    assert first != second
    check("49.3.2", language="en", words="Only where p is zero.")
    assert hint("plucker", again=True).startswith("49.3.2 plucker: hint 2")


# ---------------------------------------------------------------- numbers of exercises


def test_numbers_are_read_as_tests_write_them_and_a_section_names_its_exercises():
    assert hint("49_0_1", language="en") == hint("49.0.1", language="en")
    assert check("49_0_2", lambda R, p, x: R @ x + p).right
    with pytest.raises(NameNotFound, match=r"49\.3\.1, 49\.3\.2, 49\.3\.3"):
        hint("49.3")


# ---------------------------------------------------------------- what is forbidden


CALLS = {
    "skew": lambda w: tw.skew(w),
    "adjoint": lambda T: tw.SE3.from_matrix(T).motion_transform(),
    "twist_matrix": lambda omega_z, v_x: tw.hat([0, 0, omega_z, v_x, 0, 0]),
    "arc": lambda omega_z, v_x: tw.exp6([0, 0, omega_z, v_x, 0, 0]).matrix(),
    "plucker": lambda R, p: (tw.motion_transform(R, p), tw.force_transform(R, p)),
    "spatial_inertia": lambda m, c, I_c: tw.SpatialInertia(m, c, I_c).matrix(),
    "transforms_of": lambda T: (tw.SE3.from_matrix(T).motion_transform(), tw.SE3.from_matrix(T).force_transform()),
}


@pytest.mark.parametrize("name", CALLS)
def test_what_is_to_be_written_down_is_not_called_and_the_text_says_so(name):
    assert "numbers are right, but" in message(name, CALLS[name])
    exercise = COURSE.find_part(name)[0]
    if exercise.section != "project":  # its text names what is allowed
        for language in ("en", "zh"):
            named = [x for x in FORBIDDEN[name] if f"`tw.{x}`" in exercise.text.of(language)]
            assert named
