"""The exercises: references pass, every slip is named, and a student's path through a folder works."""

import subprocess
import sys
from itertools import combinations

import numpy as np
import pytest

from twistwrench.cli import main
from twistwrench.exercises import catalogue, hint, skeletons, solution, start, status
from twistwrench.exercises.compare import agree
from twistwrench.exercises.judge import judge
from twistwrench.exercises.slips import SLIPS
from twistwrench.exercises.table import slip_table
from twistwrench.exercises.text import Text

HERE = [catalogue.exercise(number) for number in catalogue.available()]
PARTS = [pytest.param(e, part, id=f"{e.id.replace('.', '_')}-{part.name}") for e in HERE for part in e.parts]
CELLS = [pytest.param(*c, id=f"{c.exercise.id.replace('.', '_')}-{c.part.name}-{c.slip}") for c in slip_table()]
SEEDS = (0, 1, 2)

CHAPTER = {
    *("49.0.1", "49.0.2", "49.0.3", "49.0.4", "49.0.5"),
    *("49.1.1", "49.1.2", "49.2.1", "49.2.2", "49.3.1", "49.3.2", "49.3.3", "49.4.1", "49.4.2", "49.4.3"),
    *("49.5.1", "49.5.2", "49.5.3", "49.6.1", "49.6.2", "49.6.3", "49.7.1", "49.7.2", "49.8.1", "49.8.2"),
    *("49.9.1", "49.9.2", "49.9.3", "49.10.1", "49.10.2", "49.10.3", "49.11.1", "49.11.2", "49.11.3"),
    *("project.1", "project.2", "project.3", "project.4"),
}


# ---------------------------------------------------------------- what there is


@pytest.mark.parametrize("number", sorted(CHAPTER))
def test_every_exercise_of_the_chapter_is_there(number):
    if number not in catalogue.available():
        pytest.xfail("not written yet")
    assert catalogue.exercise(number).id == number


def test_there_are_no_others():
    assert set(catalogue.IDS) == CHAPTER


def test_functions_have_names_of_their_own():
    names = [part.name for e in HERE for part in e.parts]
    assert sorted(names) == sorted(set(names))


def texts(e):
    yield from (e.title, e.text, *e.hints, *([e.answer] if e.answer else []))
    for part in e.parts:
        yield from (part.doc, *(p.text for p in part.properties))


@pytest.mark.parametrize("e", HERE, ids=lambda e: e.id)
def test_every_text_is_there_in_both_languages(e):
    assert all(t.en.strip() and t.zh.strip() for t in texts(e))
    for t in (e.title, e.text, *e.hints, *([e.answer] if e.answer else [])):
        assert not any("\u4e00" <= c <= "\u9fff" for c in t.en), t.en
        assert any("\u4e00" <= c <= "\u9fff" for c in t.zh), t.zh
    assert len(e.hints) >= 2
    assert e.parts
    assert e.answer is not None or e.kind in ("code", "number")


def test_the_catalogue_of_slips():
    assert len(SLIPS) >= 40
    for slip in SLIPS.values():
        assert all(isinstance(t, Text) and t.en and t.zh for t in (slip.title, slip.why))
        assert slip.section in catalogue.SECTIONS
    titles = [s.title.en for s in SLIPS.values()]
    assert len(titles) == len(set(titles))


def test_every_slip_of_the_catalogue_occurs_somewhere():
    missing = set(SLIPS) - {cell.slip for cell in slip_table()}
    if {*catalogue.available()} != CHAPTER:
        pytest.xfail("exercises are missing")
    assert missing == set()


# ---------------------------------------------------------------- references and slips


@pytest.mark.parametrize(("e", "part"), PARTS)
def test_the_reference_passes(e, part):
    for seed in SEEDS:
        assert judge(e, part, part.solution, seed=seed).state == "done"


@pytest.mark.parametrize(("e", "part"), PARTS)
def test_the_reference_has_the_properties(e, part):
    for seed in SEEDS:
        for arguments in part.cases(np.random.default_rng(seed)):
            answer = part.value(part.solution, arguments)
            for item in part.properties:
                residual = np.asarray(item.residual(answer, *arguments), complex)
                np.testing.assert_allclose(residual, 0, atol=1e-8, err_msg=item.text.en)


@pytest.mark.parametrize(("e", "part", "slip"), CELLS)
def test_a_slip_is_named(e, part, slip):
    for seed in SEEDS:
        verdict = judge(e, part, part.slips[slip], seed=seed)
        assert verdict.state == "wrong"
        assert slip in verdict.slips
        for language in ("en", "zh"):
            message = verdict.message(language)
            assert SLIPS[slip].title.of(language) in message
            assert len(message.splitlines()) <= 20


@pytest.mark.parametrize(("e", "part"), PARTS)
def test_slips_can_be_told_apart(e, part):
    """Two that give the same answer must be declared, and what is declared must be so."""
    cases = list(part.cases(np.random.default_rng(7)))
    answers = {slip: [part.value(wrong, c) for c in cases] for slip, wrong in part.slips.items()}
    for one, other in combinations(answers, 2):
        same = all(agree(part, a, b, c) for a, b, c in zip(answers[one], answers[other], cases, strict=True))
        assert same == any({one, other} <= group for group in part.alike), (one, other)


@pytest.mark.parametrize(("e", "part"), PARTS)
def test_what_is_not_begun_is_to_do(e, part):
    def untouched(*arguments):
        return ...

    def raising(*arguments):
        raise NotImplementedError

    if part.call is None:
        assert judge(e, part, untouched).state == judge(e, part, raising).state == "to do"


# ---------------------------------------------------------------- a student's path


def pytest_in(folder, *arguments):
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-W", "error", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300, check=False)


def write_solutions(folder, language):
    for section in catalogue.SECTIONS:
        if catalogue.of_section(section):
            (folder / catalogue.file_name(section)).write_text(skeletons.solved(section, language), encoding="utf-8")


@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_fresh_folder_is_all_to_do(tmp_path, language):
    new, kept = start(tmp_path / "mine", language=language)
    assert not kept
    assert {p.name for p in new} >= {"pytest.ini", "ex_49_3.py"}
    found = status(tmp_path / "mine")
    assert (found.done, found.total) == (0, len(HERE))
    assert {s for row in found.rows for s in row.states.values()} == {"to do"}


def test_start_touches_nothing_that_is_there(tmp_path):
    (tmp_path / "ex_49_3.py").write_text("mine = 1\n")
    new, kept = start(tmp_path, language="en")
    assert [p.name for p in kept] == ["ex_49_3.py"]
    assert (tmp_path / "ex_49_3.py").read_text() == "mine = 1\n"
    again, kept = start(tmp_path)
    assert not again
    assert len(kept) == len(new) + 1


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_solutions_give_everything(tmp_path, language):
    start(tmp_path, language=language)
    write_solutions(tmp_path, language)
    found = status(tmp_path)
    assert {n: s for row in found.rows for n, s in row.states.items() if s != "done"} == {}
    assert "100 %" in str(found)


def test_a_path_through_pytest(tmp_path):
    start(tmp_path, language="en")
    fresh = pytest_in(tmp_path)
    assert fresh.returncode == 0, fresh.stdout
    assert "failed" not in fresh.stdout
    assert "to do: 49.3.1 translation_transforms" in pytest_in(tmp_path, "-rs").stdout

    file = tmp_path / "ex_49_3.py"
    written = file.read_text(encoding="utf-8")
    wrong = written.replace("return ...", "return np.eye(6), np.eye(6), np.eye(6)", 1)
    file.write_text(wrong, encoding="utf-8")
    failed = pytest_in(tmp_path, "-k", "49_3")
    assert failed.returncode == 1
    assert "The slip: the coupling term is missing." in failed.stdout
    assert "Traceback" not in failed.stdout
    assert ".py:" not in failed.stdout.split("short test summary")[0].replace("ex_49_3.py::", "")

    write_solutions(tmp_path, "en")
    passed = pytest_in(tmp_path, "-m", "s49_3")
    assert passed.returncode == 0
    assert "passed" in passed.stdout
    assert "the model answer" in passed.stdout
    assert "the model answer" not in pytest_in(tmp_path, "-m", "s49_3").stdout
    assert main(["exercises", "status", str(tmp_path)]) == 0


def test_hints_come_one_at_a_time(tmp_path):
    start(tmp_path, language="en")
    first, second = hint("49.3.1", tmp_path), hint("49.3.1", tmp_path)
    assert "hint 1 of 2" in first
    assert "hint 2 of 2" in second
    assert hint("49.3.1", tmp_path, again=True) == second
    assert "提示 1/2" in hint("49.3.1", tmp_path, every=True, language="zh")


def test_a_model_answer_waits_for_the_attempt(tmp_path):
    start(tmp_path, language="en")
    model = catalogue.exercise("49.3.2").answer.en.split()[:4]
    assert " ".join(model) not in solution("49.3.2", tmp_path)
    file = tmp_path / "ex_49_3.py"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("answer_49_3_2 = ...", 'answer_49_3_2 = "Where p is zero."'), encoding="utf-8")
    assert " ".join(model) in solution("49.3.2", tmp_path)
