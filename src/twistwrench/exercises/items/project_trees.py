"""The project, stage 2: the trees that the recursions walk, and what their docstrings share."""

from typing import Any

import numpy as np

from ...model import Model
from ...tree import split, walk
from ...trees import random_tree
from ..robots import robot
from ..text import Text

__all__ = ["LISTS", "described", "pieces", "previous", "trees"]

LISTS = Text(
    """parent: tuple of n whole numbers: parent[i] carries body i and comes before it; 0 is the
    world, parent[0] is −1.
    S, I, X: lists of n arrays. S[i] (6, k) has a column for each entry of joint i's velocity;
    I[i] (6, 6) is the inertia of body i in frame i; X[i] (6, 6) takes twists from the parent's
    frame to frame i. Entries 0 are the world's. (They come from `tree =
    twistwrench.tree.walk(model, q)`: tree.parent, tree.S, tree.I, tree.X.)""",
    """parent：n 个整数的元组：parent[i] 承载物体 i 并排在它前面；0 是世界，parent[0] 为 −1。
    S、I、X：各为 n 个数组的列表。S[i] (6, k) 的每一列对应关节 i 速度的一个分量；I[i] (6, 6) 是
    物体 i 在坐标系 i 中的惯量；X[i] (6, 6) 把 twist 从父坐标系变到坐标系 i。第 0 项属于世界。
    （它们来自 `tree = twistwrench.tree.walk(model, q)`：tree.parent、tree.S、tree.I、tree.X。）""",
)
"""What `parent`, `S`, `I` and `X` are."""


def described(first: Text, last: Text) -> Text:
    """Return a docstring: what is returned, the lists, and what else there is."""
    en, zh = (
        "\n".join(line.strip() for line in f"{first.of(k)}\n\n{LISTS.of(k)}\n{last.of(k)}".split("\n"))
        for k in ("en", "zh")
    )
    return Text(en, zh)


def trees(rng: np.random.Generator) -> list[tuple[Model, Any, Any, Any, Any]]:
    """Return model and lists of Go2 and of two trees with joints of every kind, each in some posture."""
    found = []
    for model in (robot("go2"), random_tree(6, rng=rng), random_tree(6, rng=rng, base="floating")):
        tree = walk(model, model.random_configuration(rng=rng))
        found.append((model, tree.parent, [*tree.S], [*tree.I], [*tree.X]))
    return found


def pieces(model: Model, rng: np.random.Generator) -> Any:
    """Return a random velocity, acceleration or torque, one array per joint."""
    return split(model, rng.standard_normal(model.nv))


def previous(parent: Any) -> Any:
    """Return the parents that a chain would have."""
    return tuple(range(-1, len(parent) - 1))
