"""The project, stage 2: the trees of the recursions."""

from functools import partial
from typing import Any

import numpy as np

from ...model import Model, Tree, random_tree, tree_terms
from ...model.tree import split
from ..robots import robot

__all__ = ["columns", "motions", "pieces", "previous", "tree_of", "trees", "upward", "with_massless_link"]


def tree_of(parent: Any, S: Any, I: Any, X: Any, a0: Any) -> Tree:
    """Return the tree that the recursions take, without rotors."""
    rotor = [np.zeros((s.shape[1], s.shape[1])) for s in S]
    return Tree(parent, S, I, [], X, rotor, gravity=-np.reshape(a0, (6, 1)))


def columns(arrays: Any) -> Any:
    """Return the array of each joint as a column."""
    return [np.reshape(x, (-1, 1)) for x in arrays]


def trees(rng: np.random.Generator) -> list[tuple[Model, Any, Any, Any, Any]]:
    """Return model and lists of Go2 and of two trees with joints of every kind, each in some posture.

    Of the second the world carries the last body, and so more than one.
    """
    found = []
    rooted = next(tree for tree in iter(partial(random_tree, 6, rng=rng), None) if tree.parent[-1] == 0)
    for model in (robot("go2"), rooted, random_tree(6, rng=rng, base="floating")):
        tree = tree_terms(model, model.random_configuration(rng=rng))
        found.append((model, tree.parent, [*tree.S], [*tree.I], [*tree.X]))
    return found


def with_massless_link(rng: np.random.Generator) -> tuple[Model, Any, Any, Any, Any]:
    """Return a tree as above of which a body without mass carries others."""
    model, parent, S, I, X = trees(rng)[2]
    k = max(parent)  # the last that carries a body
    return model, parent, S, [0 * x if i == k else x for i, x in enumerate(I)], X


def upward(rng: np.random.Generator) -> Any:
    """Return −g as the acceleration of the world for each of the trees: on earth, elsewhere, and along no axis."""
    return [
        np.array([0, 0, 0, 0, 0, 9.81]),
        np.array([0, 0, 0, 0, 0, 1.62]),
        np.array([0, 0, 0, *rng.normal(scale=5, size=3)]),
    ]


def pieces(model: Model, rng: np.random.Generator) -> Any:
    """Return a random velocity, acceleration or torque, one array per joint."""
    return split(model, rng.standard_normal(model.nv))


def motions(rng: np.random.Generator) -> Any:
    """Return the trees, each with a velocity, an acceleration or torques, and the acceleration of the world."""
    return [
        (*lists, pieces(model, rng), pieces(model, rng), a0) for (model, *lists), a0 in zip(trees(rng), upward(rng))
    ]


def previous(parent: Any) -> Any:
    """Return the parents that a chain would have."""
    return tuple(range(-1, len(parent) - 1))
