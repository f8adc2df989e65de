"""What a wrong result is: another quantity with a name, what an earlier call has left, an array with two names."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.exercises import catalogue
from twistwrench.exercises.folder.workbook import Workbook
from twistwrench.exercises.judge import judge

NOT_COPIED = """
import numpy as np
import twistwrench as tw

def translation_transforms(p):
    X = np.eye(6)
    X[3:, :3] = tw.skew(p)
    inverse = X
    inverse[3:, :3] *= -1
    force = np.eye(6)
    force[:3, 3:] = tw.skew(p)
    return X, inverse, force
"""

KEPT = """
import numpy as np

def skew(w, out={}):
    if "first" not in out:
        x, y, z = w
        out["first"] = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return out["first"].copy()
"""


def message(name, function):
    return " ".join(judge(*catalogue.find_part(name), function, search=True).message("en").split())


def in_file(folder, name, text):
    exercise, part = catalogue.find_part(name)
    (folder / catalogue.file_name(exercise.section)).write_text(text)
    book = Workbook(folder, language="en")
    book.search = True
    return " ".join(book.verdict(exercise, part).message("en").split())


def own_centroidal_map(model, q):
    return tw.crba(model, q)[:6]


def rotation_transform(R):
    T = np.eye(4)
    T[:3, :3] = R
    return T


def forward_dynamics_two_ways(model, q, v, tau):
    return (tw.rnea(model, q, v, tau),) * 2


@pytest.mark.parametrize(
    ("function", "says"),
    [
        (own_centroidal_map, "your A_G: the base's rows of M (the momentum about the base's origin, in its axes)."),
        (rotation_transform, "your X: the 4 × 4 matrix of the rotation. X has the shape (4, 4); it must be (6, 6)."),
        (forward_dynamics_two_ways, "inverse dynamics (RNEA) gives, with `tau` in the place of the accelerations."),
    ],
)
def test_another_quantity_is_called_by_its_name(function, says):
    said = message(function.__name__, function)
    assert "What you return is another quantity:" in said
    assert says in said


def test_a_block_is_not_called_by_the_name_of_the_whole():
    def pinocchio_inertia(m, c, I_c):
        off = m * tw.skew(c)
        return np.block([[m * np.eye(3), off], [off.T, I_c]])

    said = message("pinocchio_inertia", pinocchio_inertia)
    assert said.count("the right block, with the other sign.") == 2
    assert "about the body's origin" not in said
    assert "your I, the block of rows k (angular), columns ω: the argument `I_c`." in said


def test_a_block_of_another_quantity_is_told_with_its_place():
    def own_centroidal_map(model, q):
        return np.vstack([tw.crba(model, q)[:3], tw.centroidal_map(model, q)[3:]])

    exercise, part = catalogue.find_part("own_centroidal_map")
    said = " ".join(judge(exercise, part, own_centroidal_map, search=False).message("en").split())
    assert "columns of the joints: the entries [:3, 6:] of the mass matrix M." in said


def test_numbers_that_are_nothing_known_get_no_name():
    assert "another quantity" not in message("act", lambda R, p, x: np.sin(R @ x) + np.cos(p) * x[::-1])


def test_what_an_earlier_call_has_left_is_said(tmp_path):
    said = in_file(tmp_path, "skew", KEPT)
    assert "Called for the first time it is right" in said
    assert "`out` keeps something" in said


def test_a_second_name_for_one_array_is_said_at_its_line(tmp_path):
    said = in_file(tmp_path, "translation_transforms", NOT_COPIED)
    assert "line 8, `inverse = X` copies nothing" in said
    assert "Write `inverse = X.copy()`." in said
