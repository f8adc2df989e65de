"""Random trees with joints of every kind, against 50 digits and against Pinocchio."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given

import twistwrench as tw

from ..strategies import KINDS, Recipe, examples, recipes
from ..truth import assert_agree, check_against_the_truth, pinocchio, textbook

LONG_CHAIN = Recipe(40, seed=7, base="floating", kinds=("revolute",), branching=0.0)
BIG_TREE = Recipe(40, seed=3, base="fixed")
UNPUSHED = Recipe(1, seed=5602, base="fixed", kinds=("prismatic",))
"""A slide that hardly accelerates: what its momentum is changed by is small beside the terms of its velocity."""


@given(recipes(8))
@examples(3)
def test_every_quantity_is_right_to_the_last_digits_of_50(recipe):
    check_against_the_truth(recipe, np.float64)


@pytest.mark.slow(one_in=3)
@given(recipes(40))
@example(LONG_CHAIN)
@example(BIG_TREE)
@examples(1, every=6)
def test_every_quantity_is_right_to_the_last_digits_of_50_for_up_to_40_bodies(recipe):
    check_against_the_truth(recipe, np.float64)


@pytest.mark.slow
@given(recipes(5))
@examples(4)
def test_complex_states_are_right_too(recipe):
    check_against_the_truth(recipe, np.complex128)


def check_against_pinocchio(recipe: Recipe) -> None:
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    model, s, frame = recipe.model, recipe.state(), recipe.frame()
    ours = textbook(model, s, frame)
    ours["joint wrenches"] = ours["joint wrenches"][1:]
    theirs = pinocchio(pin, model, s, frame)
    assert set(ours) == set(theirs)
    assert_agree(model, s, ours, theirs, against=ours)


@given(recipes(40))
@example(LONG_CHAIN)
@example(BIG_TREE)
@example(UNPUSHED)
@examples(8)
def test_every_quantity_is_pinocchios(recipe):
    check_against_pinocchio(recipe)


@pytest.mark.slow
@given(recipes(40))
@examples(12, every=60)
def test_every_quantity_is_pinocchios_at_length(recipe):
    check_against_pinocchio(recipe)


@given(recipes(40))
@examples(10)
def test_a_random_tree_is_what_was_asked_for(recipe):
    model = recipe.model
    assert model.nbodies == recipe.n + 1
    assert model.base == recipe.base
    for inertia, name in zip(model.inertia[1:], model.joint_names[1:], strict=True):
        inertia.check_physical(name)
    moved = model.joints[2:] if recipe.base == "floating" else model.joints[1:]
    assert {joint.kind for joint in moved} <= set(recipe.kinds)
    assert all(parent < i for i, parent in enumerate(model.parent))
    if recipe.branching == 0:
        assert model.parent == tuple(range(-1, recipe.n))


def test_random_trees_differ_with_the_seed_and_repeat_with_it():
    one, again, other = (tw.random_tree(6, rng=seed) for seed in (1, 1, 2))
    assert one.joint_names == again.joint_names
    assert one.joint_names != other.joint_names
    q = one.random_configuration(rng=0)
    assert (tw.crba(one, q) == tw.crba(again, q)).all()


def test_random_trees_have_all_that_can_go_wrong():
    models = [tw.random_tree(30, rng=seed, base="floating") for seed in range(3)]
    for model in models:
        assert {joint.kind for joint in model.joints[1:]} == set(KINDS)
        assert (model.armature == 0).any()
        assert (model.armature > 0).any()
        assert any(name.startswith("welded") for name in model.frame_names)
        children = [model.parent.count(i) for i in range(model.nbodies)]
        assert max(children) > 1
        assert list(model.joint_names) != sorted(model.joint_names)
        axes = [np.array(joint.axis) for joint in model.joints[1:] if hasattr(joint, "axis")]
        assert all((np.abs(axis) > 1e-3).all() for axis in axes)
