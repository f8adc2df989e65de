"""The spatial cross products: how twists and wrenches change when a twist carries them along (section 49.5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ._vector import as_spatial
from .plucker import blocks
from .rotation import cross_matrix

__all__ = ["cross_force", "cross_motion"]


def cross_motion(V: ArrayLike, *others: ArrayLike) -> Array:
    """Matrix V× = [[ω]×, 0; [v]×, [ω]×]: the rate of a twist carried along by V (section 49.5).

    Parameters
    ----------
    V : Twist or array_like of shape (..., 6)
        (ω, v), rad/s and m/s.
    *others : array_like
        None: what the matrix is multiplied by comes after ``@``.

    Returns
    -------
    ndarray, shape (..., 6, 6)

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    TypeError
        If `V` is a Wrench, or not the only argument.

    Examples
    --------
    >>> cross_motion([0, 0, 1, 0, 0, 0]) @ [1, 0, 0, 0, 0, 0]
    array([0., 1., 0., 0., 0., 0.])
    """
    _check_alone("cross_motion", "W", others)
    return motion_cross_matrix(as_spatial(V, "V"))


def cross_force(V: ArrayLike, *others: ArrayLike) -> Array:
    """Matrix V×* = −(V×)ᵀ = [[ω]×, [v]×; 0, [ω]×]: the rate of a wrench carried along by V (section 49.5).

    Parameters
    ----------
    V : Twist or array_like of shape (..., 6)
        (ω, v), rad/s and m/s.
    *others : array_like
        None: what the matrix is multiplied by comes after ``@``.

    Returns
    -------
    ndarray, shape (..., 6, 6)

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    TypeError
        If `V` is a Wrench, or not the only argument.

    Examples
    --------
    >>> cross_force([0, 0, 0, 1, 0, 0]) @ [0, 0, 0, 0, 1, 0]
    array([0., 0., 1., 0., 0., 0.])
    """
    _check_alone("cross_force", "F", others)
    return force_cross_matrix(as_spatial(V, "V"))


def _check_alone(name: str, symbol: str, others: tuple[ArrayLike, ...]) -> None:
    """Raise, with the way to cross two, where a function is given more than the one twist whose matrix it returns."""
    if others:
        product = f"{name}(V) @ {symbol} is the product of arrays"
        raise TypeError(f"V: expected one twist, shape (..., 6), got {1 + len(others)} arguments; {product}")


def motion_cross_matrix(V: Array) -> Array:
    """Return V×, without checks and for any number type: the formula of `cross_motion`."""
    W = cross_matrix(V[..., :3])
    return blocks(W, np.zeros_like(W), cross_matrix(V[..., 3:]), W)


def force_cross_matrix(V: Array) -> Array:
    """Return V×*, without checks and for any number type: the formula of `cross_force`."""
    return -motion_cross_matrix(V).mT
