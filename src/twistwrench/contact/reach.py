"""Whether forces within the limits of the contacts can exert a given wrench, and the proof of either answer (49.9).

The forces that contacts bear are sums of rays, the edges of their friction pyramids, and so the wrenches that they
exert together are a cone. Either the given wrench is in it: then forces prove it. Or some twist leads away
from the cone: the wrench does work along it, and no force within the limits does any (the lemma of Farkas). The
residual of nonnegative least squares is such a twist, and one product with the rays shows that it is.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from .decomposition import block_diagonal
from .nonnegative import nonnegative_least_squares
from .types import Contact, Pyramid

__all__ = ["LARGEST", "NEAR", "Reach", "proves", "reach"]

NEAR = 1e-8
"""Tolerance of the wrench, relative to it and to the weight."""

LARGEST = 1e6
"""Upper bound of the sum of all forces, in multiples of the weight."""


class Reach(NamedTuple):
    """An answer, and its proof."""

    reached: bool
    f: Array
    """The forces within the limits that are nearest, at all points, each in its contact's axes, shape (3 k,)."""
    away: Array
    """The direction in which they miss, shape (m,): no force within the limits does work along it, but w does."""
    proved: bool
    """Whether f, or `away`, proves the answer."""
    used: Array
    """Which rays and slacks f is a sum of: where a problem nearly alike begins."""


def reach(
    G: Array,
    w: Array,
    contacts: Sequence[Contact],
    sides: int,
    pyramid: Pyramid,
    also: tuple[Array, Array] | None = None,
    start: Array | None = None,
) -> Reach:
    """Return whether forces f within the limits have G f = w, and C f ≤ d where `also` is (C, d).

    Parameters
    ----------
    G : ndarray, shape (m, 3 k)
    w : ndarray, shape (m,)
        In units in which 1 is large, as are C and d.
    contacts, sides, pyramid
        As `friction_inverse_dynamics`.
    also : (ndarray, ndarray), shapes (n, 3 k) and (n,), optional
    start : ndarray, optional
        `used` of a problem nearly alike.
    """
    T, C, d = _generators(contacts, sides, pyramid, float(np.abs(G).max(initial=0)))
    if also is not None:
        C, d = np.concatenate([C, also[0]]), np.concatenate([d, also[1]])
    E = np.block([[G @ T, np.zeros((len(w), len(d)))], [C @ T, np.eye(len(d))]])  # C f + slack = d
    asked = np.concatenate([w, d])
    length = np.sqrt((E * E).sum(axis=0))
    x, r = nonnegative_least_squares(E, asked, start)
    used = x > 0
    if r @ r <= NEAR**2 and length @ x > LARGEST:  # internal forces: Σ forces + slack = the largest, in units of that
        E = np.block([[E, np.zeros((len(E), 1))], [length / LARGEST, np.ones(1)]])
        asked = np.append(asked, 1.0)
        x, r = nonnegative_least_squares(E, asked)
    left, f = np.sqrt(r @ r), T @ x[: T.shape[1]]
    if left <= NEAR:
        missed = asked - E @ x
        return Reach(True, f, r[: len(w)], bool((x >= 0).all() and np.sqrt(missed @ missed) <= 2 * NEAR), used)
    return Reach(False, f, r[: len(w)] / left, proves(r / left, E, asked), used)


def proves(away: Array, E: Array, asked: Array) -> bool:
    """Return whether no x ≥ 0 up to `LARGEST` has E x = asked: along `away` it exceeds every E x."""
    length = np.sqrt((E * E).sum(axis=0))
    most = (E.mT @ away / np.where(length > 0, length, 1)).max(initial=0)
    return bool(away @ asked > LARGEST * most)


def _generators(contacts: Sequence[Contact], sides: int, pyramid: Pyramid, size: float) -> tuple[Array, Array, Array]:
    """Return T, C, d: the contacts bear the forces f = T x with x ≥ 0 and C f ≤ d.

    The rays of the contacts; for one with limits of its own, its axes both ways and these limits, in the units of G.
    """
    spans, bounds = [], []
    for c in contacts:
        own = type(c).limits is not Contact.limits or not c.pushes
        n = 3 * len(c.points)
        spans.append(np.concatenate([np.eye(n), -np.eye(n)], axis=1) if own else c.rays(sides, pyramid).mT)
        bounds.append(size * c.limits(sides, pyramid) if own else np.zeros((0, n)))
    C = block_diagonal(bounds)
    return block_diagonal(spans), C, np.zeros(len(C))
