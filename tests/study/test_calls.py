"""`python benchmarks/calls.py`: what it times is what it says, and what is missing is left out by name."""

import csv

import calls
import numpy as np
import pytest
import tables

import twistwrench as tw


@pytest.fixture(autouse=True)
def short(monkeypatch):
    """Time each call once."""
    robin = calls.round_robin
    monkeypatch.setattr(calls, "round_robin", lambda x, rounds: robin(x, rounds=1, least=1e-4, most=1e-3))


def test_every_way_to_call_gives_the_same():
    model = tw.load("go2")
    ways = {call.how: call.run() for call in calls.of_rnea(model)}
    pushed = ways.pop("… `f_ext=`")
    (first, *others) = ways.values()
    for way, found in zip([*ways][1:], others):
        np.testing.assert_allclose(np.reshape(found, -1), first, rtol=0, atol=1e-11, err_msg=way)
    assert abs(pushed - first).max() > 0.1


def test_ratios_are_to_the_row_above():
    rows = calls.measured("rnea", tw.load("double_pendulum"), 1)
    assert rows[0]["ratio"] == 1
    assert rows[3]["ratio"] == pytest.approx(rows[3]["us"] / rows[0]["us"])
    assert all(row["us"] > 0 for row in rows)


def test_what_is_not_offered_is_left_out_by_name(monkeypatch, capsys):
    monkeypatch.setattr(tw.fast, "integrate", None, raising=False)
    rows = calls.measured("steps", tw.load("double_pendulum"), 1)
    assert "`fast.integrate`" not in {row["how"] for row in rows}
    assert "`fast.integrate`: left out" in capsys.readouterr().out


def test_the_page_has_every_row():
    path = calls.RESULTS / "calls.csv"
    with path.open() as file:
        found = list(csv.DictReader(file))
    assert {row["group"] for row in found} >= {"dynamics", "rnea", "states", "contacts", "bounds", "chains", "first"}
    assert tables.calls().count("\n") == len(found) + 1
