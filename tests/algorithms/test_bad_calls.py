"""A bad call ends in a `TypeError` or `ValueError` that names the argument, or succeeds with finite numbers."""

from __future__ import annotations

import random
import warnings

import pytest

from .. import badcalls

pytest.importorskip("matplotlib", reason="matplotlib is not installed: the sweep goes over the pictures, too")
pytest.importorskip("daqp", reason="daqp is not installed: the sweep goes over friction, too")

TAKERS = {taker.name: taker for taker in badcalls.takers()}
DRAWN, FEW = 8, 2
"""How many bad calls of a function the short form draws; of a picture, which takes a tenth of a second, a few."""

SEED = random.randrange(10**6)
"""Anew for each run: what the short form draws today it has not drawn yesterday. A failure prints it."""

SLOW = {"motions.jump", "view"}


def ends(taker, drawn=None):
    """Return the bad calls of a function that end otherwise, with their ends: all of them, or so many drawn."""
    needs = {"bridge": "pinocchio", "newton_euler_3d": "mpmath"}.get(taker.name.partition(".")[0])
    if needs:
        pytest.importorskip(needs)
    given = {"ax": badcalls.axes(taker.name)} if "ax" in taker.good else {}
    taker.function(**taker.good | given)
    found, calls = {}, list(badcalls.calls(taker))
    if drawn is not None:
        calls = random.Random(f"{SEED} {taker.name}").sample(calls, min(drawn, len(calls)))
    for argument, value, call in calls:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            if end := badcalls.verdict(taker, argument, call):
                found[argument, value] = end
    return found


def test_every_public_function_is_swept():
    assert len(TAKERS) > 140
    assert {"rnea", "fast.aba", "plot.triad", "motions.Motion", "Model.support", "Scene.cheapest"} <= set(TAKERS)


@pytest.mark.parametrize("name", [name for name in TAKERS if name not in SLOW])
def test_a_bad_call_names_its_argument(name):
    assert ends(TAKERS[name], FEW if name.startswith("plot") else DRAWN) == {}, f"SEED = {SEED}"


@pytest.mark.slow
@pytest.mark.parametrize("name", TAKERS)
def test_any_bad_call_names_its_argument(name):
    assert ends(TAKERS[name]) == {}


def test_a_call_that_ends_badly_is_noticed():
    def careless(model, q):
        return q.nothing if q is None else [float("nan")]

    taker = badcalls.Taker("careless", careless, {"model": badcalls.GO2, "q": 1.0})
    found = ends(taker)
    assert found["q", "None"].startswith("AttributeError")
    assert found["q", "text"].startswith("not finite")
