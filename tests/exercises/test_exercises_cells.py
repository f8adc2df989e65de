"""`check`, where the answer is written: the same verdict as in a folder, as text and as HTML, and nothing hangs."""

import os
import re
import warnings
from dataclasses import replace

import numpy as np
import pytest

import twistwrench as tw
from misstep.checked import case_html
from misstep.errors import CourseError
from misstep.judge import judge
from misstep.verdict import Compared
from twistwrench.errors import NameNotFound
from twistwrench.exercises import check
from twistwrench.exercises.chapter import COURSE

LIMIT = 1.0


def act(R, p, x):
    return R @ x - p


def right(R, p, x):
    return R @ x + p


def endless(R, p, x):
    while True:
        pass


def html(checked):
    text = checked._repr_html_()
    for tag in ("div", "table", "details", "pre", "svg"):
        assert len(re.findall(f"<{tag}[ >]", text)) == text.count(f"</{tag}>"), tag
    return text


def test_a_wrong_answer_has_the_message_and_the_numbers():
    checked = check("49.0.2", act, seed=4, language="en")
    plain = judge(*COURSE.find_part("act"), act, seed=4)
    assert checked.verdicts["act"].lines == plain.lines
    told = plain.report("en").replace("twistwrench exercises hint act", 'tw.exercises.hint("act")')
    assert told in repr(checked)
    text = html(checked)
    assert text.count('class="tw-bad"') == text.count('class="tw-good"') == 3
    assert "the translation has the wrong sign" in text[text.index("<details><summary>hint 1 of 4") :]
    assert "the translation has the wrong sign" not in plain.message("en")
    assert not checked.right
    assert checked.points == 0


def test_the_hints_come_one_click_at_a_time():
    text = html(check("49.0.2", act, language="en", time_limit=0))
    first, second = (text.index(f"hint {k} of 4") for k in (1, 2))
    assert "</details>" not in text[first:second]  # the second is inside the first
    assert "<details open" not in text
    assert "twistwrench exercises hint" not in text  # they are below
    assert "hint 1" not in html(check("49.0.2", right, language="en", time_limit=0))


@pytest.mark.slow
def test_a_large_array_lists_what_differs():
    part = COURSE.find_part("mass_matrix_by_rnea")
    wrong = judge(*part, lambda model, q: np.ones((model.nv, model.nv)))
    whole = Compared(part[1].returns[0].label, np.eye(12), np.ones((12, 12)), np.eye(12) == 0)
    text = case_html(replace(wrong.case, compared=(whole,)), "en")
    assert "[0, 1]" in text
    assert "126 more entries" in text


def test_one_part_of_two_gives_half_the_points():
    def mass_matrix_by_rnea(model, q):
        rest = np.zeros(model.nv)
        gravity = tw.rnea(model, q, rest, rest)
        return np.array([tw.rnea(model, q, rest, e) - gravity for e in np.eye(model.nv)]).T

    checked = check("49.6.1", mass_matrix_by_rnea, language="zh", time_limit=0)
    assert checked.right
    assert checked.points == 0.5
    assert "正确" in repr(checked)


def test_a_name_is_needed_only_where_there_are_several_functions():
    assert check("49.0.2", right, time_limit=0).right
    assert check("49.0.2", time_limit=0).verdicts["act"].state == "wrong"  # `act`, as it is defined in this file
    with pytest.raises(NameNotFound, match=r"function of 49\.6\.1"):
        check("49.6.1", right)
    with pytest.raises(TypeError, match=r"expected the function itself, as in check\('49.0.2', act\), got ndarray"):
        check("49.0.2", act(np.eye(3), np.zeros(3), np.zeros(3)))
    with pytest.raises(CourseError, match=r"expected a function of 49.6.1 \(torques_two_ways, "):
        check("49.6.1")
    with pytest.raises(NameNotFound, match="did you mean"):
        check("49.0.22", act)


def adjoint(T):
    columns = [T @ tw.hat(e) @ np.linalg.inv(T) for e in np.eye(6)]
    return np.array([[A[2, 1], A[0, 2], A[1, 0], *A[:3, 3]] for A in columns]).T


def test_words_are_noted_and_the_model_answer_comes_once_the_functions_are_right():
    def shown(checked):
        return "".join((repr(checked) + html(checked)).split())

    words, answer = "It moves <twists>, I think.", "".join(COURSE.exercise("49.0.3").answer.en.split())
    check("49.0.3", lambda T: np.eye(6), language="en")
    before = check("49.0.3", words=words, language="en")
    assert not before.right
    assert before.points == 0
    assert answer not in shown(before)
    check("49.0.3", adjoint)
    after = check("49.0.3", words=words)
    assert answer in shown(after)
    assert "<pre>Itmoves&lt;twists&gt;,Ithink.</pre>" in shown(after)
    assert not after.right
    assert check("49.0.3", adjoint, words=words).right
    assert not check("49.0.3", adjoint, words="up").right
    assert "right" not in repr(after).split("\n")[0]


def test_an_endless_loop_is_stopped_with_its_line():
    said = repr(check("49.0.2", endless, language="en", time_limit=LIMIT))
    assert "It did not finish in 1 s" in said
    assert "while True:" in said or "pass" in said
    assert "twistwrench exercises case act 0" in said


def test_an_endless_loop_in_a_later_case_has_that_case():
    def act(R, p, x):
        while x[0] < 0:
            pass
        return R @ x + p

    said = repr(check("49.0.2", act, language="en", time_limit=LIMIT, seed=3))
    assert "It did not finish in 1 s" in said
    assert "twistwrench exercises case act 0" not in said


def test_an_interrupt_of_the_student_is_none_of_ours():
    def act(R, p, x):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        check("49.0.2", act, time_limit=LIMIT)


@pytest.mark.slow
def test_nothing_forks(monkeypatch):
    """A copy of a process with threads may hold a lock for ever."""
    monkeypatch.setattr(os, "fork", lambda: pytest.fail("forked"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert check("49.0.2", right).right


def test_the_progress_is_that_of_the_section():
    check("49.0.2", act, language="en", time_limit=0)
    before = check("49.0.2", act, language="en", time_limit=0).progress
    after = check("49.0.2", right, language="en", time_limit=0).progress
    assert after.count("●") == before.count("●") + 1
    assert "of 5 exercises" in after


@pytest.mark.slow
def test_a_notebook_shows_it(tmp_path):
    nbformat = pytest.importorskip("nbformat", reason="nbformat is not installed: no notebook is run")
    nbclient = pytest.importorskip("nbclient", reason="nbclient is not installed: no notebook is run")
    cells = [
        "from twistwrench.exercises import check",
        "def act(R, p, x):\n    return R @ x + p[7]\ncheck('49.0.2', act, language='en')",
        "def act(R, p, x):\n    while True:\n        n = 1\ncheck('49.0.2', act, language='en', time_limit=1)",
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    wrong, late = (cell.outputs[-1].data for cell in notebook.cells[1:])
    assert "in your cell, line 2:" in wrong["text/plain"]
    assert '<div class="tw-wrong">' in wrong["text/html"]
    assert "It did not finish in 1 s" in late["text/plain"]
    assert "in your cell, line " in late["text/plain"]
