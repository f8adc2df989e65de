"""A formula is an answer: read by SymPy, and tried as a function is."""

import pytest

import twistwrench as tw
from misstep.errors import CourseError
from misstep.formulas import judge_formula, typed
from misstep.workbook import Workbook
from twistwrench.errors import NameNotFound
from twistwrench.exercises import check, start
from twistwrench.exercises.chapter import COURSE

pytest.importorskip("sympy", reason="SymPy is not installed: formulas are not read")

INERTIA = "block([[I_c - m*skew(c)*skew(c), m*skew(c)], [-m*skew(c), m*eye(3)]])"
RIGHT = {
    "act": "R*x + p",
    "skew": "Matrix([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])",
    "newton_euler": "I_c*alpha + cross(omega, I_c*omega), m*a_c",
    "twist_matrix": "Matrix([[0, -omega_z, 0, v_x], [omega_z, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]])",
    "spatial_inertia": INERTIA,
    "polishing_torques": "M*a + h - J.T*force",
    "contact_wrench": "stack(cross(p, R*f_c), R*f_c), stack(skew(p)*R*f_c, R*f_c)",
}
WRONG = [
    ("act", "R*x - p", "translation-sign"),
    ("act", "R.T*x + p", "rotation-transposed"),
    ("spatial_inertia", INERTIA.replace("I_c - m", "I_c + m"), "steiner-sign"),
]


def judged(name, formula):
    return judge_formula(*COURSE.find_part(name), formula)


@pytest.mark.parametrize("name", RIGHT)
def test_a_right_formula_is_right(name):
    assert judged(name, RIGHT[name]).state == "done"


@pytest.mark.parametrize(("name", "formula", "slip"), WRONG)
def test_a_wrong_formula_has_its_slip_named(name, formula, slip):
    verdict = judged(name, formula)
    assert verdict.state == "wrong"
    assert slip in verdict.slips or slip not in COURSE.find_part(name)[1].slips
    assert verdict.slips
    assert verdict.case.compared


def test_another_form_of_the_same_formula_is_right():
    assert judged("act", "p + (x.T*R.T).T").state == "done"


@pytest.mark.parametrize(
    ("name", "formula", "said"),
    [
        ("act", "R*x +", "cannot be read"),
        ("act", "R*x + q", "cannot be read"),
        ("twist_matrix", "Matrix([[0, -w, 0, v_x]])", "unknown in the formula: w; known: omega_z, v_x"),
        ("newton_euler", "m*a_c", "expected 2 results with a comma between, got 1"),
        ("count", "7", "not a formula in its arguments (kinds)"),
    ],
)
def test_what_cannot_be_read_is_explained(name, formula, said):
    verdict = judged(name, formula)
    assert verdict.state == "wrong"
    assert said in verdict.message("en", level=3)


def test_a_formula_is_checked_in_a_cell():
    assert check("49.0.2", act="R*x + p", language="en").right
    assert "the translation has the wrong sign" in repr(check("49.0.2", act="R*x - p", language="en"))
    with pytest.raises(NameNotFound, match="adjoint"):
        check("49.0.3", adjont="T")


def test_a_formula_may_stand_in_the_file_and_is_used_by_later_exercises(tmp_path):
    start(tmp_path, language="en")
    file = tmp_path / "ex_49_0.py"
    file.write_text(file.read_text(encoding="utf-8") + f'\nskew = "{RIGHT["skew"]}"\n', encoding="utf-8")
    book = Workbook(COURSE, tmp_path)
    assert book.verdict(*COURSE.find_part("skew")).state == "done"
    assert (book.best("skew")([1.0, 2.0, 3.0]) == tw.skew([1.0, 2.0, 3.0])).all()
    assert not book.borrowed


def test_without_sympy_the_message_names_what_to_install(monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "sympy", None)
    with pytest.raises(CourseError, match="pip install sympy"):
        typed(COURSE.find_part("act")[1], "R*x + p")
