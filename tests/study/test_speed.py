"""`python -m benchmarks.study speed`: what it times is what it says, and what it prints."""

import importlib
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from study.__main__ import main as study_main
from study.record import Record
from study.speed import QUANTITIES, ours, random_states, shown, speed

import twistwrench as tw
from twistwrench.timing import round_robin

from ..robots import shared
from ..sampling import sampled

HUMANOID = shared("humanoid")


@pytest.mark.one_case
@pytest.mark.parametrize("quantity", sampled(QUANTITIES, 2))
def test_both_ways_are_asked_for_the_same(quantity):
    s = random_states(HUMANOID, 3)
    book, fast = (ours(package, HUMANOID, quantity, s)() for package in (tw, tw.fast))
    books, fasts = (list(vars(x).values()) if quantity == "set" else [x] for x in (book, fast))
    for b, f in zip(books, fasts, strict=True):
        np.testing.assert_allclose(f, b, rtol=0, atol=1e-12 * np.abs(b).max())


def test_random_states_are_repeated_when_there_are_many():
    s = random_states(shared("pendulum"), 1500)
    np.testing.assert_array_equal(s.q[1000:], s.q[:500])
    assert len(np.unique(s.v)) == 1000


def test_what_does_ten_times_the_work_takes_longer():
    little, much = round_robin([lambda: sum(range(1000)), lambda: sum(range(10_000))], rounds=5, least=1e-3)
    assert 2 < np.median(much.seconds) / np.median(little.seconds) < 50


@pytest.mark.slow
def test_every_quantity_is_timed_in_every_way_and_shown():
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: there is nothing to compare with")
    model = shared("pendulum")
    found = speed(model, rounds=1, states=10)
    assert [(r.way, r.number, r.states) for r in found[:5]] == [
        ("Pinocchio", "float64", 300),
        ("textbook", "float64", 1),
        ("fast", "float64", 1),
        ("fast", "float64", 10),
        ("fast", "float32", 10),
    ]
    assert len(found) == 5 * len(QUANTITIES)
    assert all(0 < r.q1 <= r.seconds <= r.q3 for r in found)
    text = shown(model, found)
    assert all(meaning in text for meaning in QUANTITIES.values())


@pytest.mark.slow
def test_without_pinocchio_times_stand_alone(monkeypatch):
    record = Record("rnea", "fast", seconds=12.3456e-6)
    text = shown(HUMANOID, [replace(record, quiet=False)])
    assert "Pinocchio is not installed" in text
    assert "~12.3" in text
    assert "other things to do" in text
    assert "other things to do" not in shown(HUMANOID, [record])
    monkeypatch.setattr("study.speed.find_spec", lambda name: None)
    monkeypatch.setattr("study.record.round_robin", partial(round_robin, least=0, most=0))
    assert "Pinocchio" not in {r.way for r in speed(shared("pendulum"), rounds=1, states=2)}


@pytest.mark.slow
def test_the_command_has_a_row_for_every_quantity_of_a_robot_with_feet(monkeypatch, capsys):
    monkeypatch.setattr("study.record.round_robin", partial(round_robin, least=0, most=0))
    assert study_main(["speed", "go2"]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("go2, nv = 18: microseconds for one state")
    rows = {line[:26].strip(): line[26:].split("  ") for line in out.splitlines()}
    assert all(sum(cell != "" for cell in rows[meaning]) == 5 for meaning in QUANTITIES.values())
    assert err == ""
    assert study_main(["speed", "pendulum", "--base", "floating"]) == 2
    assert "joint 'root_joint': with its outboard joints free it moves no inertia" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["README.md", "README.zh-CN.md"])
def test_the_tables_of_the_page_are_those_of_the_results(name, monkeypatch):
    folder = Path(__file__).parents[2] / "benchmarks"
    monkeypatch.syspath_prepend(str(folder))
    tables = importlib.import_module("tables")
    page = (folder / name).read_text(encoding="utf-8")
    assert tables.fill(page, tables.tables()) == page
    assert page.count("<!-- table") == len(tables.tables())
