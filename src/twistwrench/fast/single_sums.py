"""Sums over all ancestors, and over all that a link carries, as products with constant matrices.

The links are in the order of v, the base first; what is summed is one row for each, shape (1 + n, 16).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..arrays import Array

__all__ = ["BLOCK", "Sums", "SumsInBlocks", "carried_by", "sums_of"]

BLOCK = 64
"""Links in a block: one matrix for all links would grow with the square of their number."""


class Sums:
    """One matrix for each sum.

    Parameters
    ----------
    carried : ndarray, shape (1 + n, 1 + n)
        1 where the link of the column carries the link of the row, or is it.
    of : ndarray of int, shape (nv,)
        The link of each entry of v.
    before, last : ndarray of int, shape (1 + n,)
        For each link the one that carries its joint, for the base -1; and the last link of its joint.
    """

    def __init__(self, carried: Array, of: Array, before: Array, last: Array) -> None:
        by_link = np.eye(len(carried))[:, of]
        around = np.concatenate([carried, np.zeros((1, len(carried)))])[before] + carried[last]
        self._outward = carried
        self._moving = np.concatenate([by_link, around @ by_link])
        self._carried = np.concatenate([np.ones((1, len(carried))), carried.mT[of]])
        self._outboard = self._carried[1:]

    def outward(self, x: Array) -> Array:
        """Return for each link the sum over it and its ancestors."""
        out: Array = self._outward.dot(x)
        return out

    def outboard(self, x: Array) -> Array:
        """Return for each entry of v, shape (nv, 16), the sum over all that it moves."""
        out: Array = self._outboard.dot(x)
        return out

    def carried(self, x: Array) -> Array:
        """Return the sum over all links, and for each entry of v the one over all that it moves, (1 + nv, 16)."""
        out: Array = self._carried.dot(x)
        return out

    def moving(self, x: Array) -> Array:
        """Return sums of the twists x, shape (nv, 16), that the entries of v make, as (2, 1 + n, 4, 4).

        The first is the twist of each link's joint. The second is the sum of the twists of the
        links before and after the joint.
        """
        out: Array = self._moving.dot(x)
        return out.reshape(2, -1, 4, 4)


class Block(NamedTuple):
    """Some consecutive links.

    Attributes
    ----------
    here : slice
    sums : ndarray, shape (m, m)
        As `carried` of `Sums`.
    below : ndarray of int, shape (m,), or None
        For each link the nearest ancestor in an earlier block; None in the first block.
    roots, carriers : ndarray of int
        The links whose parents are in earlier blocks, and these parents.
    """

    here: slice
    sums: Array
    below: Array | None
    roots: Array
    carriers: Array


class SumsInBlocks:
    """The same for many links, block by block, so that the work grows in step with their number.

    Parameters
    ----------
    parent : ndarray of int, shape (1 + n,)
    of, before, last
        As in `Sums`.
    """

    def __init__(self, parent: Array, of: Array, before: Array, last: Array) -> None:
        self._of, self._before, self._last = of, before, last
        self._blocks = [_block(parent, start) for start in range(0, len(parent), BLOCK)]

    def outward(self, x: Array) -> Array:
        """Return for each link the sum over it and its ancestors."""
        total = np.empty_like(x)
        for here, sums, below, _, _ in self._blocks:
            total[here] = sums.dot(x[here])
            if below is not None:
                total[here] += total[below]
        return total

    def outboard(self, x: Array) -> Array:
        """Return for each entry of v, shape (nv, 16), the sum over all that it moves."""
        out: Array = self._inward(x)[self._of]
        return out

    def carried(self, x: Array) -> Array:
        """Return the sum over all links, and for each entry of v the one over all that it moves, (1 + nv, 16)."""
        out: Array = self._inward(x)[np.concatenate([[0], self._of])]
        return out

    def moving(self, x: Array) -> Array:
        """Return sums of the twists x, as `Sums.moving`."""
        joint = np.zeros((len(self._last), 16))
        base = len(x) - len(joint) + 1
        joint[0], joint[1:] = x[:base].sum(axis=0), x[base:]
        twist = self.outward(joint)
        around = twist[self._last]
        around[1:] += twist[self._before[1:]]
        return np.stack([joint, around]).reshape(2, -1, 4, 4)

    def _inward(self, x: Array) -> Array:
        """Return for each link the sum over it and all that it carries."""
        total = x.copy()
        for here, sums, below, roots, carriers in reversed(self._blocks):
            total[here] = sums.mT.dot(total[here])
            if below is not None:
                np.add.at(total, carriers, total[roots])
        return total


def _block(parent: Array, start: int) -> Block:
    here = slice(start, min(start + BLOCK, len(parent)))
    inside, below = parent[here] - start, parent[here].copy()
    sums = np.eye(len(inside))
    for i, p in enumerate(inside):
        if 0 <= p < i:
            sums[i] += sums[p]
            below[i] = below[p]
    roots = np.flatnonzero(inside < 0)
    return Block(here, sums, below if start else None, start + roots, parent[here][roots])


def carried_by(parent: Array) -> Array:
    """Return the matrix with 1 where the link of the column carries the link of the row, or is it."""
    carried = np.eye(len(parent))
    for i in range(1, len(parent)):
        carried[i] += carried[parent[i]]
    return carried


def sums_of(parent: Array, of: Array, before: Array, last: Array) -> Sums | SumsInBlocks:
    """Return the sums for some links."""
    if len(parent) <= BLOCK:
        return Sums(carried_by(parent), of, before, last)
    return SumsInBlocks(parent, of, before, last)
