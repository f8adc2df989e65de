"""A function as a listing: its source, its changes, its values, and an end to every loop."""

import ast

import numpy as np
import pytest

from misstep.grammar import Habits, code, edits
from misstep.listing import Change, Listing, source_with_helpers, text_of

from .functions import center, projectile, stiffness, written

LOOP = "def count(n):\n    k = 0\n    while k < n:\n        k = k + 1\n    return k\n"


def test_a_function_is_read_with_what_it_uses_and_keeps_its_lines(tmp_path):
    function = written(tmp_path, "G = 9.81\n\n\ndef other():\n    return 0\n\n\ndef fall(t):\n    return G * t\n")
    assert source_with_helpers(function).split("\n") == ["G = 9.81", *[""] * 6, "def fall(t):", "    return G * t", ""]


def test_a_change_is_made_and_taken_back():
    listing = Listing(stiffness)
    place = next(x for x in listing.places if text_of(x.node) == "R.T")
    changed = listing.mutant((Change(place, code("R")),))
    K, R = np.diag([1.0, 2.0, 3.0]), np.linalg.qr(np.arange(9.0).reshape(3, 3) + np.eye(3))[0]
    np.testing.assert_array_equal(changed(K, R), R @ K @ R)
    np.testing.assert_array_equal(listing.compiled()(K, R), stiffness(K, R))


def test_each_expression_has_the_value_that_it_had_first():
    listing = Listing(projectile).trace(lambda f: f(2.0, 0.0, 3.0))
    values = {text_of(x.node): listing.value(x.node) for x in listing.places if isinstance(x.node, ast.expr)}
    assert values["speed * np.cos(angle) * t"] == 6.0
    assert values["t ** 2"] == 9.0


def test_a_loop_that_a_change_makes_endless_is_stopped(tmp_path):
    listing = Listing(written(tmp_path, LOOP), source=LOOP)
    place = next(x for x in listing.places if text_of(x.node) == "k + 1")
    with pytest.raises(RuntimeError, match="endless"):
        listing.mutant((Change(place, code("k")),))(3)
    assert listing.compiled()(3) == 3


def texts(function, *arguments, habits=None):
    listing = Listing(function, given=dict(zip(function.__code__.co_varnames, arguments)))
    return {(x.rule, x.before, x.after) for x in edits(listing.trace(lambda f: f(*arguments)), habits or Habits())}


def test_only_things_of_one_kind_are_exchanged_and_only_matrices_are_turned():
    K, R = np.diag([1.0, 2.0, 3.0]), np.eye(3)[[1, 2, 0]]
    found = texts(stiffness, K, R)
    assert ("order", "R @ K", "K @ R") in found
    assert ("turn", "R @ K @ R.T", "R @ K @ R") in found
    found = texts(projectile, 2.0, 0.5, 3.0)
    assert not {x for x in found if x[0] == "turn"}
    assert ("name", "np.cos", "np.sin") in found


def test_names_that_a_field_takes_for_each_other():
    found = texts(projectile, 2.0, 0.5, 3.0, habits=Habits(confusable=(("cos", "tan"),)))
    assert ("name", "np.cos", "np.tan") in found


def test_every_edit_can_be_made_and_shows_a_difference():
    m, r = np.array([1.0, 2.0]), np.array([[1.0, 2, 3], [4, 5, 6.5]])
    listing = Listing(center, given={"m": m, "r": r}).trace(lambda f: f(m, r))
    every = list(edits(listing))
    assert len({x.rule for x in every}) >= 6
    assert all(x.before != x.after for x in every)
    assert sum(listing.mutant(x.changes) is not None for x in every) > 0.9 * len(every)
