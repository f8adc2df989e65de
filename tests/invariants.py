"""Random trees, and derivatives along their motion, for the tests of what the laws of mechanics say must hold.

Derivatives are by complex steps: f(x + i h) / h with h = 1e-20 is the derivative to the last digit, and along
the configuration manifold the step is q ⊕ i h v.
"""

from __future__ import annotations

import numpy as np
from hypothesis import given

from .strategies import examples, recipes

H = 1e-20
trees = given(recipes(10))
floating = given(recipes(10, bases=("floating",)))
hinges_and_slides = given(recipes(8, bases=("fixed",), kinds=("revolute", "prismatic")))
several = examples(12)


def close(x, y, tolerance=1e-12, *, size=0.0) -> bool:
    """Equal to the largest entry of either, or to `size` where the entries are what is left of larger terms."""
    x, y = np.asarray(x), np.asarray(y)
    assert x.shape == y.shape
    assert size > 0 or np.abs(y).max(initial=0) > 0, "two zeros are always equal"
    return bool(np.abs(x - y).max(initial=0) <= tolerance * max(np.abs(x).max(), np.abs(y).max(), size))


def step(model, q, v):
    """Return q ⊕ i h v, whose imaginary part, over h, is the rate of q along v."""
    return model.integrate(q, 1j * H * v)


def rate(x):
    """Return the derivative of x that a complex step has left in it."""
    return np.asarray(x).imag / H


def in_world(T, wrench):
    """Return a wrench of a frame placed at T, at the world's origin."""
    return T.force_transform() @ wrench


def body_frame(model, i):
    """A frame that coincides with body i's own."""
    return next(n for n, f in model.frames.items() if f.body == i and (f.placement.matrix() == np.eye(4)).all())
