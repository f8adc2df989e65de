"""Numbers that count: a recursion runs on them, and every +, −, ×, ÷ and √ that a computer would do is counted.

What is zero or one whatever the posture costs nothing, as in a program that was written out by hand.
"""

from __future__ import annotations

from collections import Counter
from contextlib import contextmanager

import numpy as np

from twistwrench.model import Tree, tree_terms

COUNTS: Counter[str] = Counter()


class Counted:
    """A number of which only this is known: that it is zero, that it is one, or neither."""

    def __init__(self, known=None):
        self.known = known

    def __add__(self, other):
        other = counted_number(other)
        if self.known == 0 or other.known == 0:
            return other if self.known == 0 else self
        return does("+")

    __radd__ = __add__

    def __sub__(self, other):
        other = counted_number(other)
        return self if other.known == 0 else Counted() if self.known == 0 else does("+")

    def __rsub__(self, other):
        return counted_number(other) - self

    def __mul__(self, other):
        other = counted_number(other)
        if 0 in (self.known, other.known):
            return ZERO
        if 1 in (self.known, other.known):
            return other if self.known == 1 else self
        return does("×")

    __rmul__ = __mul__

    def __truediv__(self, other):
        other = counted_number(other)
        return self if self.known == 0 or other.known == 1 else does("÷")

    def __rtruediv__(self, other):
        return counted_number(other) / self

    def __neg__(self):
        return self if self.known == 0 else Counted()

    def sqrt(self):
        return does("√")


ZERO = Counted(0)


def does(operation):
    COUNTS[operation] += 1
    return Counted()


def counted_number(x):
    return x if isinstance(x, Counted) else Counted(x if x in (0, 1) else None)


def counted(*arrays):
    """An array of counting numbers: zero or one where all the arrays given, one for each posture, are so."""
    same = [np.all([a == known for a in arrays], axis=0) for known in (0, 1)]
    out = np.empty(arrays[0].shape, object)
    for k in np.ndindex(out.shape):
        out[k] = ZERO if same[0][k] else Counted(1 if same[1][k] else None)
    return out


def counted_tree(model):
    """The tree of a model in counting numbers."""
    rng = np.random.default_rng(0)
    trees = [tree_terms(model, model.random_configuration(rng=rng)) for _ in range(2)]
    rounded = [[np.where(np.abs(x) < 1e-15, 0, x) for x in tree.X] for tree in trees]
    first = trees[0]
    return Tree(
        first.parent,
        [counted(S) for S in first.S],
        [counted(I) for I in first.I],
        first.placement,
        [counted(*x) for x in zip(*rounded, strict=True)],
        [counted(r) for r in first.rotor],
        counted(first.gravity),
    )


@contextmanager
def counting():
    """What is done in the block: a Counter by operation."""
    COUNTS.clear()
    done: Counter[str] = Counter()
    yield done
    done.update(COUNTS)
