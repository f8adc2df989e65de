"""A class of students who are odd, unlucky or hostile: everybody else's mark is there, nothing hangs, nothing stays."""

import csv
import secrets
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from misstep.compare import plain
from misstep.judge import judge
from misstep.workbook import Workbook
from twistwrench.exercises.chapter import COURSE

from .hostile import BODIES, FILES, ODD, ROOMS, hand_in

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the harm is done with what Linux has")

LIMIT = 1.5
UNREADABLE = {f"file, {kind}" for kind in FILES} - {"file, names that raise", "file, patches"}


@pytest.fixture(autouse=True)
def mark(monkeypatch):
    """Return what all have in their environment that are started by a test."""
    word = secrets.token_hex(16)
    monkeypatch.setenv("TWISTWRENCH_TEST", word)
    return word


def left(mark):
    """Return the processes that a test has started, however they call themselves."""
    found = []
    for place in Path("/proc").glob("[0-9]*"):
        try:
            if mark.encode() in (place / "environ").read_bytes():
                found.append((place / "cmdline").read_bytes())
        except OSError:
            pass
    return found


@pytest.mark.slow
def test_a_hostile_class_is_graded_by_the_command(tmp_path, mark):
    room, file = tmp_path / "class", tmp_path / "marks.csv"
    room.mkdir()
    hand_in(room)
    command = [sys.executable, "-m", "twistwrench", "exercises", "grade", str(room), "--only", "49.0.1", "49.0.2"]
    others = ["--html", str(tmp_path / "a.html"), "--language", "en"]
    done = subprocess.run(
        [*command, "--csv", str(file), "--timeout", str(LIMIT), *others],
        capture_output=True,
        text=True,
        timeout=900,
        check=True,
    )
    rows = list(csv.DictReader(file.read_text(encoding="utf-8-sig").splitlines()))
    students = sorted(path.name for path in room.iterdir())
    assert len(students) > 40
    assert sorted(row["student"] for row in rows if row["function"] == "act") == students
    for row in rows:
        harmless = row["student"].startswith("room") or row["student"] in ("file, names that raise", "file, patches")
        right = row["student"] not in UNREADABLE if row["function"] == "act" else harmless
        if row["function"]:
            assert (row["points"], row["state"] == "done") == ("1" if right else "0", right), row
            assert bool(row["reason"]) != right, row
    assert done.stderr.count(f"/{len(students)}  ") == len(students)
    time.sleep(0.2)
    assert not left(mark)
    assert not (room / "was here").exists()


# ---------------------------------------------------------------- in this process


ITSELF = [1.0]
ITSELF.append(ITSELF)


@pytest.mark.parametrize("kind", ["tensor", "large", "in itself", "silent error", "attributes", "class", "text"])
def test_an_odd_answer_is_wrong_and_no_more(kind):
    held = {"np": np}
    exec(ODD, held)
    exec("def skew(w):\n    " + BODIES[kind].replace("\n", "\n    "), held)
    found = judge(*COURSE.find_part("skew"), held["skew"])
    assert found.state == "wrong"
    assert found.message("en")
    assert found.message("zh")


@pytest.mark.parametrize("given", [2**2000, [[2**2000] * 3] * 3, ITSELF, {1: 2}, {3, 4}, b"ab", iter([1])])
def test_what_becomes_no_number_keeps_the_name_of_its_class(given):
    converted = plain(given)
    assert type(converted).__name__ == type(given).__name__
    assert converted is not given


def test_what_is_plain_is_returned_itself():
    for given in (np.eye(3), [np.eye(3), 1.0, "x"], (1, None, ...), 3, np.float64(2), True):
        assert plain(given) is given
    assert (plain(tw.SE3.identity()) == np.eye(4)).all()
    assert (plain(range(3)) == [0, 1, 2]) is True


@pytest.mark.parametrize("kind", ROOMS)
def test_a_damaged_hidden_file_is_read_as_far_as_it_goes(tmp_path, kind):
    (tmp_path / ".twistwrench.json").write_text(ROOMS[kind], encoding="utf-8")
    state = Workbook(COURSE, tmp_path).state
    assert (state["hints"], state["compared"], state["solutions"]) == ({}, [], [])
    assert Workbook(COURSE, tmp_path).language in ("en", "zh")
