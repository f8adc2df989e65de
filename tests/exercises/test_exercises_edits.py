"""The search over small edits: what it finds, that it is true, and that no edit of a reference passes the check."""

import time

import numpy as np
import pytest

from twistwrench.exercises import catalogue
from twistwrench.exercises.calls import copied, tried
from twistwrench.exercises.cases import every_case
from twistwrench.exercises.changes.edits import Source
from twistwrench.exercises.changes.search import candidates
from twistwrench.exercises.compare import agree
from twistwrench.exercises.judge import judge
from twistwrench.exercises.wrong import faulty


def message(name, function, language="en"):
    return " ".join(judge(*catalogue.find_part(name), function).message(language).split())


def changed(name, *pairs):
    part = catalogue.find_part(name)[1]
    listing = part.beside[-1] if part.beside else None
    return faulty(part.solution, *pairs, of=listing)


@pytest.mark.parametrize(
    ("name", "pairs", "says"),
    [
        ("newton_euler", [("I_c @ alpha", "I_c @ omega")], "`I_c @ omega` in place of `I_c @ alpha`"),
        ("act", [("R @ x + p", "R @ (x - p)")], "`R @ (x - p)` in place of `R @ x + p`"),
        ("polishing_torques", [("J.mT", "np.linalg.inv(J)")], "`np.linalg.inv(J)` in place of `J.T`"),
        ("tree_rnea", [("X[i] @ V[p]", "X[i].mT @ V[p]")], "this slip makes V[2] wrong first."),
        (
            "tree_rnea",
            [("cross_motion(V[i]) @ vJ", "cross_motion(V[p]) @ vJ")],
            "A[2] wrong first. These stay right for every body: V.",
        ),
        ("tree_crba", [("S[j].mT @ F", "S[i].mT @ F")], "`S[i]` in place of `S[j]`, in its line `M[j, i]"),
        ("tree_aba", [("X[i].mT @ Ia[i] @ X[i]", "X[i] @ Ia[i] @ X[i].mT")], "in place of `X[i].T @ Ia[i] @ X[i]`"),
    ],
)
def test_the_edit_that_gives_the_numbers_is_found(name, pairs, says):
    assert says in message(name, changed(name, *pairs))


def test_a_slip_of_the_list_tells_where_a_recursion_goes_wrong_as_well():
    said = message("tree_rnea", changed("tree_rnea", (" + cross_motion(V[i]) @ vJ", "")))
    assert "the velocity term V × S q̇ is missing." in said
    assert "this slip makes A[2] wrong first. These stay right for every body: V." in said


def test_results_that_are_exchanged_are_told_as_that():
    def fall_in_motion(*given):
        return catalogue.find_part("fall_in_motion")[1].solution(*given)[::-1]

    assert "a of the base and a of the centre of mass are exchanged" in message("fall_in_motion", fall_in_motion)


def test_where_no_edit_fits_an_argument_is_named_for_which_it_is_right():
    said = message("sole_wrench", lambda points, forces: np.r_[points.sum(0) ** 2 * forces.sum(), forces.sum(0)])
    assert "It is right where points = 0: look at what you do with points." in said


def test_an_edit_that_would_never_end_is_given_up():
    part = catalogue.find_part("tree_crba")[1]
    began = time.monotonic()
    said = message("tree_crba", lambda *lists: np.cos(part.solution(*lists)))
    assert "It is not one of the known slips" in said
    assert time.monotonic() - began < 60  # a search may take 8 s, and this machine may be busy


def test_ways_are_right():
    ways = [(p, way) for e in map(catalogue.exercise, catalogue.available()) for p in e.parts for way in p.ways]
    assert ways
    for part, way in ways:
        for arguments in part.cases(np.random.default_rng(5)):
            assert agree(part, part.value(way, arguments), part.value(part.solution, arguments), arguments), way


PARTS = {
    part.name: part
    for exercise in map(catalogue.exercise, catalogue.available())
    for part in exercise.parts
    if part.arguments and not exercise.needs  # Pinocchio can end the process at an edit
}

SECONDS = 4
"""Of the processor, for the edits of one function: the likeliest come first."""


@pytest.mark.slow  # seconds each
@pytest.mark.parametrize("name", PARTS)
def test_no_edit_of_a_reference_passes(name):
    """An edit that passes on the cases of a seed is right on those of other seeds too: it writes the same otherwise."""
    part = PARTS[name]
    drawn = {seed: every_case(part, seed) for seed in range(4)}
    right = {seed: [part.value(part.solution, copied(case)) for case in drawn[seed]] for seed in drawn}

    def passes(edit, seed):
        answers = ((tried(part, edit.function, c), expected, c) for c, expected in zip(drawn[seed], right[seed]))
        return all(a is not None and agree(part, a, b, c) for a, b, c in answers)

    missed, number, end = [], 0, time.process_time() + SECONDS
    for edit in candidates(part, drawn[0][0]):
        if edit.first is not None or time.process_time() > end:
            break
        number += 1
        if passes(edit, 0) and not all(passes(edit, seed) for seed in (1, 2, 3)):
            missed.append(f"{edit.right} -> {edit.wrong}")
    assert number > 10
    assert missed == []


def test_a_change_of_several_lines_can_be_changed_once_more():
    """What is put in place of lines gets one line, and no columns of two lines."""
    text = (
        "def newton_euler(m, I_c, omega, alpha, a_c):\n"
        "    moment = np.array([\n"
        "        I_c[0][0] * alpha[0],\n"
        "        I_c[1][1] * alpha[1],\n"
        "    ])\n"
        "    return moment, m * a_c\n"
    )
    names = {"np": np}
    exec(text, names)
    source = Source(names["newton_euler"], names["newton_euler"], {}, {}, text)
    kinds = ("exchanged", "sign", "transposed")
    changed = [source.after(edit).compiled() for kind in kinds for edit in source.edits(kind)]
    assert len(changed) > 10
