"""An answer that never ends, or that ends Python, is told with its line, and the others are judged all the same."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from misstep import workbook
from misstep.calls import call_or_none
from misstep.cases import cases
from misstep.errors import CourseError
from misstep.isolation import opened
from misstep.judge import judge
from misstep.skeletons import solved
from misstep.workbook import Workbook
from twistwrench.cli import main
from twistwrench.exercises import case, check, solution, start, status
from twistwrench.exercises.chapter import COURSE

from ..sampling import sampled

LIMIT = 1.5
"""Seconds; a reference takes 0.1 s at most."""

ENDLESS = "i = 0\nwhile i < len(kinds):\n    nq = 1"
SWALLOWED = "while True:\n    try:\n        x = 1\n    except:\n        pass"
IN_C = "import itertools\nreturn sum(itertools.count())"


def write(folder, section, bodies=None, *, more="", head=b""):
    """Fill in functions of a section's file."""
    file = folder / COURSE.file_name(section)
    text = file.read_text(encoding="utf-8")
    for name, body in (bodies or {}).items():
        before, found, after = text.partition(f"def {name}(")
        assert found
        indented = "\n".join("    " + line for line in body.split("\n"))
        text = before + found + after.replace("    return ...", indented, 1)
    file.write_bytes(head + (text + more).encode())


def said(folder, name, language="en", seed=None):
    """Return the verdict on a function, its message on one line; with the failing case where a seed is given."""
    with opened(COURSE, folder, language=language, seed=seed, time_limit=LIMIT) as book:
        verdict = book.verdict(*COURSE.find_part(name))
    message = verdict.message(language, 3) if seed is None else verdict.report(language, 3)
    return verdict.state, " ".join(message.split())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "body", "line"),
    sampled(
        [
            ("skew", SWALLOWED, "while True: or try: or x = 1 or pass"),
            ("count", ENDLESS, "while i < len(kinds): or nq = 1"),
            ("act", IN_C, "return sum(itertools.count())"),
        ],
        1,
        several=True,
    ),
    ids=["swallows every exception", "plain", "inside NumPy or C"],
)
def test_an_endless_loop_is_told_with_its_line(tmp_path, name, body, line):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {name: body})
    state, message = said(tmp_path, name)
    assert state == "wrong"
    assert f"{name}: not yet right. It did not finish in 1.5 s: a loop that never ends? in ex_49_0.py, line " in message
    assert any(f": {one} Read §" in message for one in line.split(" or "))
    assert "1.5 秒内没有结束" in said(tmp_path, name, "zh")[1]


@pytest.mark.slow
def test_the_others_are_judged_all_the_same(tmp_path):
    start(tmp_path, language="en")
    right = "return R @ x + p"
    write(tmp_path, "49.0", {"act": right, "adjoint": "import os\nos._exit(0)"})
    write(tmp_path, "49.1", more="\nwhile True: x = 1\n")
    found = status(tmp_path, time_limit=LIMIT)
    states = {number: state for row in found.rows for number, state in row.states.items()}
    assert {number for number, state in states.items() if state == "wrong"} == {"49.0.3", "49.1.1", "49.1.2"}
    assert states["49.0.2"] == "done"
    assert "It ended the whole Python process." in said(tmp_path, "adjoint")[1]
    file = said(tmp_path, "sizes")[1]
    assert "It did not finish in 1.5 s" in file
    assert "while True: x = 1" in file
    assert "The model answer is shown once" in solution("49.1.1", tmp_path)


@pytest.mark.slow
def test_an_earlier_answer_that_never_ends_is_not_held_against_a_later_one(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {"skew": SWALLOWED})
    body = "X = np.eye(6)\nX[3:, :3] = skew(p)\nreturn X, np.linalg.inv(X), np.linalg.inv(X).T"
    write(tmp_path, "49.3", {"translation_transforms": body})
    assert said(tmp_path, "translation_transforms")[0] == "done"


@pytest.mark.slow
def test_pytest_goes_on_after_an_endless_loop(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {"count": ENDLESS, "act": "print('here')\nreturn x"})
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "--time-limit", str(LIMIT), "ex_49_0.py"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 1
    assert "It did not finish in 1.5 s" in done.stdout
    assert "here" in done.stdout  # what it printed, below its message
    assert "2 failed" in done.stdout
    assert "Next: 49.0.1" in done.stdout


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="only Linux can limit the memory of a process")
def test_ten_gigabytes_are_an_error_in_a_line_of_the_student(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {"act": "big = np.ones(10**10 // 8)\nreturn R @ x + p + 0 * big.sum()"})
    state, message = said(tmp_path, "act")
    assert state == "wrong"
    assert "It stopped with MemoryError" in message or "ArrayMemoryError" in message
    assert ": big = np.ones(10**10 // 8) Read §" in message


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
def test_a_fork_does_no_harm(tmp_path):
    start(tmp_path, language="en")
    endless = "import os\nif os.fork() == 0:\n    while True:\n        pass\nreturn R @ x + p"
    write(tmp_path, "49.0", {"act": endless, "skew": "import os\nos.fork()\nreturn tw.skew(w) + 1"})
    assert said(tmp_path, "act")[0] == "done"
    assert said(tmp_path, "skew")[0] == "wrong"


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="groups of processes are those of POSIX")
def test_what_an_answer_starts_ends_with_the_check(tmp_path):
    start(tmp_path, language="en")
    body = "import subprocess\np0 = subprocess.Popen(['sleep', '4711'])\nopen('pid', 'a').write(f'{p0.pid} ')"
    write(tmp_path, "49.0", {"act": body.replace("'pid'", repr(str(tmp_path / "pid"))) + "\nreturn R @ x + p"})
    assert said(tmp_path, "act")[0] == "done"
    time.sleep(0.2)
    for pid in (tmp_path / "pid").read_text().split():
        state = subprocess.run(["ps", "-o", "stat=", "-p", pid], capture_output=True, text=True, check=False).stdout
        assert not state.strip() or "Z" in state


@pytest.mark.slow
def test_a_loop_that_prints_does_not_flood_the_screen(tmp_path, capfd):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {"act": "while True:\n    print('x' * 1000)"})
    assert "It did not finish" in said(tmp_path, "act")[1]
    printed = capfd.readouterr().err
    assert len(printed) < 20_000
    assert "[...]" in printed


def test_without_a_limit_the_answers_run_in_this_process(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {"skew": "import os\nraise ValueError(os.getpid())"})
    assert f"ValueError: {os.getpid()}" not in said(tmp_path, "skew")[1]
    with opened(COURSE, tmp_path, time_limit=0) as book:
        assert f"ValueError: {os.getpid()}" in book.verdict(*COURSE.find_part("skew")).message("en")


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="signals are those of POSIX")
def test_one_interrupt_ends_the_check(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {"count": ENDLESS})
    command = [sys.executable, "-m", "twistwrench", "exercises", "status", str(tmp_path), "--time-limit", "600"]
    process = subprocess.Popen(
        command,
        stderr=subprocess.PIPE,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    time.sleep(5)
    os.killpg(process.pid, signal.SIGINT)
    before = time.monotonic()
    assert b"Traceback" not in process.communicate(timeout=30)[1]
    assert process.returncode == 130
    assert time.monotonic() - before < 5
    left = subprocess.run(["ps", "-eo", "pgid=,stat="], capture_output=True, text=True, check=True).stdout
    ours = [line.split()[1] for line in left.splitlines() if line.split()[0] == str(process.pid)]
    assert not [state for state in ours if "Z" not in state]


# ---------------------------------------------------------------- files as editors write them


def test_a_file_with_a_byte_order_mark_is_read(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {"act": "return R @ x + p"}, head=b"\xef\xbb\xbf")
    assert Workbook(COURSE, tmp_path).verdict(*COURSE.find_part("act")).state == "done"


def test_a_file_that_names_its_coding_is_read(tmp_path):
    start(tmp_path, language="zh")
    file = tmp_path / "ex_49_0.py"
    text = "# -*- coding: gb18030 -*-\n" + file.read_text(encoding="utf-8")
    file.write_bytes(text.encode("gb18030"))
    assert Workbook(COURSE, tmp_path).verdict(*COURSE.find_part("act")).state == "to do"


@pytest.mark.parametrize("coding", ["gb18030", "utf-16"])
def test_a_file_in_another_coding_is_told_what_to_do(tmp_path, coding):
    start(tmp_path, language="zh")
    file = tmp_path / "ex_49_0.py"
    file.write_bytes(file.read_text(encoding="utf-8").encode(coding))
    verdict = Workbook(COURSE, tmp_path).verdict(*COURSE.find_part("act"))
    assert "ex_49_0.py is not written in UTF-8: save it as UTF-8" in verdict.message("en")
    assert "另存为 UTF-8" in verdict.message("zh")


def test_an_error_at_the_top_of_a_file_has_its_line(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", more="\nx = 1\nx[0]\n")
    said = Workbook(COURSE, tmp_path).verdict(*COURSE.find_part("act")).message("en")
    lines = (tmp_path / "ex_49_0.py").read_text(encoding="utf-8").splitlines()
    assert f"ex_49_0.py, line {lines.index('x[0]') + 1} cannot be read: TypeError" in " ".join(said.split())


def test_a_start_on_a_full_disk_leaves_no_half_file(tmp_path, monkeypatch, capsys):
    whole = Path.write_text

    def full(self, text, **how):
        whole(self, text[:0], **how)
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_text", full)
    assert main(["exercises", "start", str(tmp_path)]) == 2
    assert "pytest.ini: No space left on device" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
    monkeypatch.undo()
    new, kept = start(tmp_path, language="en")
    assert new
    assert not kept


def test_a_function_cannot_be_its_own_reference(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.0", {"skew": 'return mine("skew")(w)'})
    verdict = Workbook(COURSE, tmp_path).verdict(*COURSE.find_part("skew"))
    assert verdict.state == "wrong"
    assert "mine('skew') is the function that you are to write here" in verdict.message("en")


# ---------------------------------------------------------------- what is said, and how often it is judged


def test_words_are_asked_for_where_the_functions_are_right(tmp_path):
    start(tmp_path, language="en")
    write(tmp_path, "49.8", {"base_block": "return tw.crba(model, q)[:6, :6]"})
    exercise = COURSE.exercise("49.8.1")
    words = Workbook(COURSE, tmp_path).verdict_in_words(exercise)
    assert (words.state, words.lines) == ("to do", ())
    text = solved(COURSE, "49.8", "en").replace("answer_49_8_1 = ", "rest = ")
    (tmp_path / "ex_49_8.py").write_text(text, encoding="utf-8")
    words = Workbook(COURSE, tmp_path).verdict_in_words(exercise)
    assert "answer_49_8_1" in words.lines[0].en


@pytest.mark.slow
@pytest.mark.parametrize("name", ["tree_rnea"])
def test_the_number_of_cases_does_not_depend_on_the_clock(name, monkeypatch):
    exercise, part = COURSE.find_part(name)
    slow = iter(range(0, 10**9, 1000))

    def wrong(*arguments):
        calls.append(1)
        answer = part.solution(*arguments)
        return tuple(2 * x for x in answer) if isinstance(answer, tuple) else 2 * np.asarray(answer)

    counts = []
    for clock in (time.process_time, lambda: float(next(slow))):
        monkeypatch.setattr(time, "process_time", clock)
        calls = []
        verdict = judge(exercise, part, wrong, search=False)
        counts.append((len(calls), verdict.message("en")))
    assert counts[0] == counts[1]
    assert counts[0][0] > len(cases(part, 0))


def test_numpy_is_that_of_the_others_while_a_change_is_call_or_none():
    solvers = {name: getattr(np.linalg, name) for name in ("svd", "pinv", "lstsq")}
    part, seen = COURSE.find_part("act")[1], []

    def act(R, p, x):
        seen.append({name: getattr(np.linalg, name) for name in solvers} == solvers)
        return np.linalg.pinv(R) @ np.full(3, np.nan)

    call_or_none(part, act, cases(part, 0)[0])
    assert seen == [True]


@pytest.mark.slow
def test_a_hint_is_shown_where_nothing_can_be_written_down(tmp_path, monkeypatch, capsys):
    def read_only(path, text):
        raise OSError(30, "Read-only file system", str(path))

    start(tmp_path, language="en")
    monkeypatch.setattr(workbook, "write_text", read_only)
    for language in ([], ["--language", "en"]):
        assert main(["exercises", "hint", "49.3.1", "--dir", str(tmp_path), *language]) == 0
        assert "hint 1 of 2" in capsys.readouterr().out
    assert main(["exercises", "solution", "49.3.1", "--yes", "--dir", str(tmp_path)]) == 0
    assert "a solution" in capsys.readouterr().out


@pytest.mark.parametrize("command", [["status", "."], ["case", "act"]])
def test_a_negative_seed_is_told_in_a_sentence(command, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(["exercises", *command, "--seed", "-5"])
    assert "expected a whole number, 0 or more, got '-5'" in capsys.readouterr().err
    with pytest.raises(CourseError, match="seed: expected a whole number, 0 or more, got -5"):
        check("49.0.1", tw.skew, seed=-5)
    with pytest.raises(CourseError, match="time_limit: expected seconds, 0 or more, got -1"):
        check("49.0.1", tw.skew, time_limit=-1)
    with pytest.raises(CourseError, match="seed: expected a whole number, 0 or more, got -5"):
        case("act", seed=-5)
