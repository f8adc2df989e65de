"""Exponential and logarithm of SE(3): from a constant twist to a placement and back, and between two (49.3)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, check_kind, check_overflow
from ._elementary import cosine_defect, length, sinc, sine_defect_root
from ._vector import as_spatial
from .plucker import SE3
from .rotation import cross_matrix, exp3, log3

__all__ = ["exp6", "interpolate", "log6"]


def exp6(V: ArrayLike) -> SE3:
    """Placement reached in unit time at the constant body twist V (sections 49.2 and 49.3).

    R = exp3(ω) and p = v + B ω×v + C ω×(ω×v), where B = (1 − cos θ)/θ² and C = (θ − sin θ)/θ³. B comes as 2 H²,
    H = sin ½θ / θ, and H and √C go to one ω each: a product that stays near 1 however fast the turn.

    Parameters
    ----------
    V : Twist or array_like of shape (..., 6)
        (ω, v): rad and m, that is a twist times a time.

    Returns
    -------
    SE3
        T_AB: where frame B is, in the frame A it started from.

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.
    TypeError
        If `V` is a Wrench.
    ValueError
        If the numbers are so large that the way to the placement overflows.

    Examples
    --------
    >>> exp6([0, 0, 0, 1, 2, 3]).translation
    array([1., 2., 3.])
    """
    V = as_array(as_spatial(V, "V"), "V", 6)
    p = shift(V)
    return SE3._trusted(exp3(V[..., :3]), p)


def shift(V: Array) -> Array:
    """Return the translation p of exp6(V)."""
    w, v = V[..., :3], V[..., 3:]
    theta = length(w)[..., None]
    check_overflow(theta, "V")
    H, C = sinc(theta / 2) / 2, cross_matrix(sine_defect_root(theta) * w)
    with np.errstate(over="ignore", invalid="ignore"):
        p = v + 2 * H * np.matvec(cross_matrix(H * w), v) + np.matvec(C, np.matvec(C, v))
    check_overflow(p, "V")
    return np.asarray(p)


def log6(T: SE3 | ArrayLike) -> Array:
    """Twist that leads to a placement in unit time: the inverse of `exp6` for angles up to π (section 49.3).

    ω = log3(R) and v = p − ½ ω×p + D ω×(ω×p), where D = (1 − ½θ cot ½θ)/θ².

    Parameters
    ----------
    T : SE3 or array_like of shape (..., 4, 4)
        Placement T_AB.

    Returns
    -------
    ndarray, shape (..., 6)
        (ω, v): rad and m, in frame B as in frame A.

    Raises
    ------
    ShapeError
        If the shape is wrong or the matrix is not in SE(3).

    Examples
    --------
    >>> log6(exp6([0, 0, 3, 1, 0, 0])).round(15) + 0.0
    array([0., 0., 3., 1., 0., 0.])
    """
    T = T if isinstance(T, SE3) else SE3.from_matrix(T)
    w = log3(T.rotation)
    return np.concatenate([w, unshift(w, T.translation)], axis=-1)


def unshift(w: Array, p: Array) -> Array:
    """Return the linear part of log6, of a rotation vector and a translation: what `shift` leads to p."""
    half = length(w)[..., None] / 2
    D = cosine_defect(half) / sinc(half)  # 4 D
    wp = np.cross(w / 2, p)
    return np.asarray(p - wp + D * np.cross(w / 2, wp))


def interpolate(T0: SE3, T1: SE3, u: ArrayLike) -> SE3:
    """Placement on the way from T0 to T1 along one screw: T0 exp6(u log6(T0⁻¹ T1)) (section 49.3).

    The twist of the way is constant. With equal translations only the rotation changes, about an axis that stands
    still, at most by π; with equal rotations it is the straight line.

    Parameters
    ----------
    T0, T1 : SE3
    u : array_like, shape (...)
        0 at T0, 1 at T1; a number beyond these goes on along the same screw.

    Returns
    -------
    SE3

    Raises
    ------
    ShapeError, ValueError
        If `u` is not a number or the batch axes do not broadcast.
    TypeError
        If `T0` or `T1` is not an SE3.

    Examples
    --------
    >>> quarter = SE3(exp3([0, 0, np.pi / 2]), [1, 1, 0])
    >>> interpolate(SE3.identity(), quarter, 0.5).translation.round(3)  # on an arc about (0, 1, 0)
    array([0.707, 0.293, 0.   ])
    """
    for name, T in (("T0", T0), ("T1", T1)):
        check_kind(T, name, SE3, "an SE3")
    return T0 @ exp6(as_array(u, "u")[..., None] * log6(T0.inverse() @ T1))
