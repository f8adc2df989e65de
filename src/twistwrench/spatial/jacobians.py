"""Derivatives of the exponential and the logarithm: what a small change of w or of V leads to (section 49.3).

A change may be made in the frame that was reached, on the right of the placement, or in the frame that was left, on
the left: exp(w + dw) = exp(w) exp(J dw), or exp(J dw) exp(w). The names are Pinocchio's, where the right one is meant.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, check_choice, check_overflow
from ._elementary import cosine_defect, length, nonzero, sinc, sine_defect_root
from ._vector import as_spatial
from .exponential import log6
from .plucker import SE3, blocks
from .rotation import cross_matrix, log3

__all__ = ["Jexp3", "Jexp6", "Jlog3", "Jlog6"]

Side = Literal["right", "left"]


def Jexp3(w: ArrayLike, side: Side = "right") -> Array:
    """Jacobian of `exp3`: exp3(w + dw) = exp3(w) exp3(J dw) to first order (section 49.2).

    J = 1 − B[w]× + C[w]×², B = (1 − cos θ)/θ² and C = (θ − sin θ)/θ³; on the left w changes its sign. So is
    ω = J ẇ the angular velocity of a rotation vector that changes: in the turned frame, on the left in the fixed one.

    Parameters
    ----------
    w : array_like, shape (..., 3)
        Rotation vector, rad.
    side : {"right", "left"}
        "left": exp3(w + dw) = exp3(J dw) exp3(w).

    Returns
    -------
    ndarray, shape (..., 3, 3)

    Raises
    ------
    ShapeError, ValueError
        If the last axis is not 3 long, the angle overflows, or `side` is neither.

    Examples
    --------
    >>> from twistwrench.spatial.rotation import exp3
    >>> w, dw = np.array([0.3, 2.0, -0.5]), 1e-7 * np.array([1, 2, 3])
    >>> bool(np.allclose(exp3(w + dw), exp3(w) @ exp3(Jexp3(w) @ dw), rtol=0, atol=1e-13))
    True
    """
    w = _on(side, as_array(w, "w", 3))
    check_overflow(length(w), "w")
    return _right_jacobian(w)


def Jlog3(R: ArrayLike, side: Side = "right") -> Array:
    """Jacobian of `log3`: log3(R exp3(dw)) = log3(R) + J dw to first order (section 49.2).

    J = 1 + ½[w]× + D[w]×², D = (1 − ½θ cot ½θ)/θ², w = log3(R); on the left w changes its sign. It is the inverse
    of `Jexp3` at w. At π, where w jumps from one sign to the other, it is the derivative on the side of w.

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)
        Rotation matrix.
    side : {"right", "left"}
        "left": log3(exp3(dw) R) = log3(R) + J dw.

    Returns
    -------
    ndarray, shape (..., 3, 3)

    Raises
    ------
    ShapeError, ValueError
        If the shape is wrong, `R` is not a rotation, or `side` is neither.

    Examples
    --------
    >>> from twistwrench.spatial.rotation import exp3
    >>> w = np.array([0.3, 2.0, -0.5])
    >>> (Jlog3(exp3(w)) @ Jexp3(w)).round(14) + 0.0
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    return _right_inverse(_on(side, log3(R)))


def Jexp6(V: ArrayLike, side: Side = "right") -> Array:
    """Jacobian of `exp6`: exp6(V + dV) = exp6(V) exp6(J dV) to first order (section 49.3).

    J = [J₃, 0; Q, J₃] with J₃ of `Jexp3` at ω and Q its change along v: a twist is a rotation vector of dual numbers,
    ω + εv with ε² = 0, and J is J₃ of that number. On the left V changes its sign.

    Parameters
    ----------
    V : Twist or array_like of shape (..., 6)
        (ω, v): rad and m, that is a twist times a time.
    side : {"right", "left"}
        "left": exp6(V + dV) = exp6(J dV) exp6(V).

    Returns
    -------
    ndarray, shape (..., 6, 6)

    Raises
    ------
    ShapeError, ValueError
        If the last axis is not 6 long, the angle overflows, or `side` is neither.
    TypeError
        If `V` is a Wrench.

    Examples
    --------
    >>> from twistwrench.spatial.exponential import exp6
    >>> V, dV = np.array([0.3, 2, -0.5, 1, 0, 2]), 1e-7 * np.arange(6)
    >>> there = exp6(V) @ exp6(Jexp6(V) @ dV)
    >>> bool(np.allclose(exp6(V + dV).matrix(), there.matrix(), rtol=0, atol=1e-12))
    True
    """
    V = _on(side, as_array(as_spatial(V, "V"), "V", 6))
    check_overflow(length(V[..., :3]), "V")
    return exp6_jacobian(V)


def Jlog6(T: SE3 | ArrayLike, side: Side = "right") -> Array:
    """Jacobian of `log6`: log6(T exp6(dV)) = log6(T) + J dV to first order (section 49.3).

    J = [J₃, 0; −J₃ Q J₃, J₃] with J₃ of `Jlog3` and Q of `Jexp6`: the inverse of that one.

    Parameters
    ----------
    T : SE3 or array_like of shape (..., 4, 4)
        Placement T_AB.
    side : {"right", "left"}
        "left": log6(exp6(dV) T) = log6(T) + J dV.

    Returns
    -------
    ndarray, shape (..., 6, 6)

    Raises
    ------
    ShapeError, ValueError
        If the shape is wrong, the matrix is not in SE(3), or `side` is neither.

    Examples
    --------
    >>> Jlog6(SE3(np.eye(3), [1, 0, 0]))[3:, :3]  # from a metre away, a small turn counts as half a way
    array([[ 0. ,  0. ,  0. ],
           [ 0. ,  0. , -0.5],
           [ 0. ,  0.5,  0. ]])
    """
    return log6_jacobian(_on(side, log6(T)))


def exp6_jacobian(V: Array) -> Array:
    """Return J of `Jexp6`, on the right: arithmetic alone."""
    J, Q = _right_jacobian(V[..., :3]), _change(V[..., :3], V[..., 3:])
    return blocks(J, np.zeros_like(J), Q, J)


def log6_jacobian(V: Array) -> Array:
    """Return J of `Jlog6`, on the right, of V = log6(T): arithmetic alone."""
    J, Q = _right_inverse(V[..., :3]), _change(V[..., :3], V[..., 3:])
    return blocks(J, np.zeros_like(J), -J @ Q @ J, J)


def _on(side: Side, x: Array) -> Array:
    """Return x, or −x on the left: exp(−x) is the inverse of exp(x), which turns the sides round."""
    check_choice(side, "side", ("right", "left"))
    return x if side == "right" else -x


def _right_jacobian(w: Array) -> Array:
    """Return 1 − B[w]× + C[w]×²; ½√B and √C go to one [w]× each, as in `exp6`."""
    theta = length(w)[..., None, None]
    W = cross_matrix(w)
    H, CW = sinc(theta / 2) / 2, sine_defect_root(theta) * W
    return np.asarray(np.eye(3, dtype=w.dtype) - 2 * H * (H * W) + CW @ CW)


def _right_inverse(w: Array) -> Array:
    """Return 1 + ½[w]× + D[w]×², with D as in `log6`."""
    half = length(w)[..., None, None] / 2
    W = cross_matrix(w / 2)
    D = cosine_defect(half) / sinc(half)  # 4 D
    return np.asarray(np.eye(3, dtype=w.dtype) + W + D * (W @ W))


def _change(w: Array, v: Array) -> Array:
    """Return how fast `_right_jacobian` changes where w changes by v: the rates of B, C and [w]×, by the product rule.

    θ changes by n·v, n = w/θ; then θ Ḃ = (A − 2B) n·v, with A = sin θ / θ, and θ Ċ = (B − 3C) n·v.
    """
    theta = length(w)[..., None, None]
    W = cross_matrix(w)
    V = cross_matrix(v)
    n = w / nonzero(theta)[..., 0]
    N = cross_matrix(n)
    n_v = (n * v).sum(-1, keepdims=True)[..., None]
    H, c = sinc(theta / 2) / 2, sine_defect_root(theta)
    A = sinc(theta)
    B = 2 * H * H
    C = c * c
    cW = c * W
    turning = -(A - 2 * B) * n_v * N + (B - 3 * C) * n_v * (N @ W)
    return np.asarray(turning - B * V + c * (V @ cW + cW @ V))
