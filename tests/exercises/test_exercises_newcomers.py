"""What a newcomer writes: brackets forgotten, names of other modules, a return too early; and one way for two."""

import numpy as np
import pytest

import twistwrench as tw
from misstep.judge import judge
from misstep.submissions import submissions
from misstep.workbook import Workbook
from twistwrench.exercises import start
from twistwrench.exercises.chapter import COURSE

from .answers import said_of

BRACKETS = """\
def rotation_transform(R):
    X = np.zeros(6, 6)
    X[:3, :3] = X[3:, 3:] = R
    return X
"""
OTHER_MODULE = """\
def chapter_inverse(X):
    return np.inv(X)
"""
NO_FUNCTION = """\
def rotation_transform(R):
    Z = np.zeros((3, 3))
    return np.block([[R.T(), Z], [Z, R.T()]]).T
"""
WITHOUT_MODULE = """\
def newton_euler(m, I_c, omega, alpha, a_c):
    return I_c @ alpha + skew(omega) @ I_c @ omega, m * a_c
"""
EARLY = """\
def count(kinds):
    nq, nv = 0, 0
    for kind in kinds:
        nq += {"free_flyer": 7, "spherical": 4, "continuous": 2}.get(kind, 1)
        nv += {"free_flyer": 6, "spherical": 3}.get(kind, 1)
        return nq, nv
"""
MISSPELT = """\
def count(kinds):
    nq, nv = 0, 0
    for kind in kinds:
        if kind == "free flyer":
            nq, nv = nq + 7, nv + 6
        elif kind == "spherical":
            nq, nv = nq + 4, nv + 3
        elif kind == "continuous":
            nq, nv = nq + 2, nv + 1
        else:
            nq, nv = nq + 1, nv + 1
    return nq, nv
"""
OR = """\
def count(kinds):
    nq, nv = 0, 0
    for kind in kinds:
        if kind == "revolute" or "prismatic":
            nq, nv = nq + 1, nv + 1
        elif kind == "continuous":
            nq, nv = nq + 2, nv + 1
        elif kind == "spherical":
            nq, nv = nq + 4, nv + 3
        else:
            nq, nv = nq + 7, nv + 6
    return nq, nv
"""
ANEW = """\
def count(kinds):
    for kind in kinds:
        nq = nv = 0
        nq += {"free_flyer": 7, "spherical": 4, "continuous": 2}.get(kind, 1)
        nv += {"free_flyer": 6, "spherical": 3}.get(kind, 1)
    return (nq, nv) if kinds else (0, 0)
"""


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (BRACKETS, "`np.zeros((6, 6))` in place of `np.zeros(6, 6)`"),
        (NO_FUNCTION, "`[R.T, Z]` in place of `[R.T(), Z]`, in 2 places"),
        (WITHOUT_MODULE, "`tw.skew` in place of `skew`"),
        (EARLY, "`return (nq, nv)` after the loop, not in it"),
        (MISSPELT, "`'free_flyer'` in place of `'free flyer'`"),
        (OR, "`kind == 'revolute' or kind == 'prismatic'` in place of"),
    ],
)
def test_the_cure_of_a_newcomer_is_found(tmp_path, text, says):
    assert says in said_of(tmp_path, text)


def test_a_number_that_is_written_there_is_not_added_up(tmp_path):
    assert "+= in place of =" not in said_of(tmp_path, ANEW)


def test_numbers_rounded_to_two_digits_are_nearly_right():
    exercise, part = COURSE.find_part("skew")
    said = judge(exercise, part, lambda w: np.round(part.solution(w), 2)).message("en", level=3)
    assert "right to 2 digits only" in said


def by_rnea(model, q, v, a):
    return tw.rnea(model, q, v, a)


def by_matrix(model, q, v, a):
    return tw.crba(model, q) @ a + tw.nonlinear_effects(model, q, v)


def by_aba(model, q, v, tau):
    return tw.aba(model, q, v, tau)


def by_inverse(model, q, v, tau):
    return tw.inverse_mass_matrix(model, q) @ (tau - tw.nonlinear_effects(model, q, v))


TWO_WAYS = [("torques_two_ways", by_rnea, by_matrix), ("forward_dynamics_two_ways", by_aba, by_inverse)]


@pytest.mark.slow
@pytest.mark.one_case
@pytest.mark.parametrize(("name", "first", "second"), TWO_WAYS)
def test_two_ways_are_not_one(name, first, second):
    exercise, part = COURSE.find_part(name)
    for way in (first, second):
        said = judge(exercise, part, lambda *x, way=way: (way(*x), way(*x))).message("en", level=3)
        assert "the same to the last bit" in " ".join(said.split())


@pytest.mark.one_case
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("name", "first", "second"), TWO_WAYS)
def test_two_honest_ways_are_two(name, first, second, seed):
    exercise, part = COURSE.find_part(name)
    assert judge(exercise, part, lambda *x: (first(*x), second(*x)), seed=seed).state == "done"


def test_a_file_that_changes_numpy_is_told_so(tmp_path):
    start(tmp_path)
    file, cross = tmp_path / "ex_49_0.py", np.cross
    file.write_text(file.read_text(encoding="utf-8") + "\nnp.cross = lambda a, b: 0 * a\n", encoding="utf-8")
    book = Workbook(COURSE, tmp_path, language="en")
    assert "changes `np.cross`" in book.verdict(*COURSE.find_part("skew")).message("en")
    assert np.cross is cross


def test_a_folder_without_answers_is_among_those_of_a_class(tmp_path):
    start(tmp_path / "class" / "anna")
    (tmp_path / "class" / "empty").mkdir()
    start(tmp_path / "class" / "zoe" / "deeper")
    (tmp_path / "room").mkdir()
    found = submissions(COURSE, [tmp_path / "class"], tmp_path / "room", ["49.0"])
    assert [(one.student, len(one.files) > 0) for one in found] == [("anna", True), ("empty", False), ("zoe", True)]


@pytest.mark.parametrize("first", ["", "from __future__ import annotations\n"])
def test_a_file_may_hold_a_dataclass(tmp_path, first):
    start(tmp_path)
    file = tmp_path / "ex_49_0.py"
    point = "\nfrom dataclasses import dataclass\n\n@dataclass\nclass Point:\n    x: float\n    y: float = 0\n"
    file.write_text(first + file.read_text(encoding="utf-8") + point, encoding="utf-8")
    assert Workbook(COURSE, tmp_path).module("49.0").Point(1.0).y == 0
