"""Rotations: the cross product as a matrix, exponential and logarithm, quaternions (section 49.2).

Nothing here has a small-angle threshold. Every coefficient is written so that nothing cancels,
and only an angle that is exactly zero is a case of its own. Complex arguments pass through
analytically, so that a complex step differentiates every function of this file.

The public functions check their arguments and call a formula each, named after the matrix that it
returns (`cross_matrix`, `quaternion_matrix`): arithmetic on arrays of any number type, objects
included, without comparisons. The recursions call the formulas only.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, as_number_array, check_overflow, comparable, tolerance
from ..errors import ShapeError, SingularError
from ._elementary import at_first_index, atan2, largest, length, nonzero, sinc
from .orthonormal import check_rotation

__all__ = [
    "exp3",
    "log3",
    "quaternion_to_rotation",
    "rotation_to_quaternion",
    "skew",
    "unskew",
]


def skew(w: ArrayLike) -> Array:
    """Matrix of the cross product: ``skew(w) @ x`` is w × x, written [w]× (section 49.2).

    Parameters
    ----------
    w : array_like, shape (..., 3)
        A vector, in any unit.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Skew-symmetric, in the frame and the unit of `w`.

    Raises
    ------
    ShapeError
        If the last axis of `w` is not 3 long.
    ValueError
        If the length of `w` overflows.

    Examples
    --------
    >>> skew([1, 2, 3])
    array([[ 0., -3.,  2.],
           [ 3.,  0., -1.],
           [-2.,  1.,  0.]])
    """
    return cross_matrix(as_number_array(w, "w", 3))


def unskew(M: ArrayLike) -> Array:
    """Vector of a skew-symmetric matrix: the inverse of `skew` (section 49.2).

    Parameters
    ----------
    M : array_like, shape (..., 3, 3)
        Skew-symmetric to within the square root of the resolution of its dtype, relative to its
        largest entry. What rounding has left of a symmetric part is dropped.

    Returns
    -------
    ndarray, shape (..., 3)

    Raises
    ------
    ShapeError
        If the last two axes of `M` are not 3 by 3, or `M` is not skew-symmetric.

    Examples
    --------
    >>> unskew([[0, -3, 2], [3, 0, -1], [-2, 1, 0]])
    array([1., 2., 3.])
    """
    M = as_number_array(M, "M", 3, 3)
    if M.dtype == object:  # exact: what is written down must cancel
        if (M + M.mT != 0).any():
            raise ShapeError("M: expected a skew-symmetric matrix, got |M + Mᵀ| that is not zero")
        return np.stack([M[..., 2, 1], M[..., 0, 2], M[..., 1, 0]], axis=-1)
    off = largest((M / 2 + M.mT / 2).real, 2)
    wrong = off > tolerance(M.dtype) * largest(M.real, 2) / 2
    if wrong.any():
        got = f"{2 * float(off[wrong][0]):.3g}{at_first_index(wrong)}"
        raise ShapeError(f"M: expected a skew-symmetric matrix, got |M + Mᵀ| = {got}")
    return skew_part(M)


def exp3(w: ArrayLike) -> Array:
    """Rotation by the angle θ = |w| about w: R = 1 + A[w]× + B[w]×² (section 49.2, Rodrigues' formula).

    A = sin θ / θ and B = (1 − cos θ)/θ². B comes as 2 H², H = sin ½θ / θ, where nothing cancels, and H goes to each
    factor of [w]×²: the square is then symmetric to the last bit, and exp3(−w) the exact transpose of exp3(w).

    Parameters
    ----------
    w : array_like, shape (..., 3)
        Rotation vector, rad.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        R, which takes coordinates in the turned frame to the frame it was turned from.

    Raises
    ------
    ShapeError
        If the last axis of `w` is not 3 long.

    Examples
    --------
    >>> exp3([0, 0, np.pi / 2]).round(15) + 0.0
    array([[ 0., -1.,  0.],
           [ 1.,  0.,  0.],
           [ 0.,  0.,  1.]])
    """
    return turn_matrix(as_array(w, "w", 3))


def log3(R: ArrayLike) -> Array:
    """Rotation vector of a rotation matrix: the inverse of `exp3` for angles up to π (section 49.2).

    The angle is 2 atan2(|xyz|, w) of the quaternion: as good next to 0 and next to π as between.
    At π exactly, both signs of the axis are right; the largest component is then positive.

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)
        Rotation matrix.

    Returns
    -------
    ndarray, shape (..., 3)
        w, rad, with |w| ≤ π.

    Raises
    ------
    ShapeError
        If the last two axes of `R` are not 3 by 3, or `R` is not a rotation.

    Examples
    --------
    >>> log3(exp3([0.0, 3.0, 0.0]))
    array([0., 3., 0.])
    """
    q = rotation_to_quaternion(R)
    return rotation_vector(q[..., :3], q[..., 3:])


def quaternion_to_rotation(xyzw: ArrayLike) -> Array:
    """Rotation matrix of a quaternion, scalar last (section 49.2).

    Parameters
    ----------
    xyzw : array_like, shape (..., 4)
        (x, y, z, w), of any length but zero: the length is divided out.

    Returns
    -------
    ndarray, shape (..., 3, 3)

    Raises
    ------
    ShapeError
        If the last axis is not 4 long.
    SingularError
        If a quaternion is zero.

    Examples
    --------
    >>> quaternion_to_rotation([0, 0, 1, 1])
    array([[ 0., -1.,  0.],
           [ 1.,  0.,  0.],
           [ 0.,  0.,  1.]])
    """
    q = as_number_array(xyzw, "xyzw", 4)
    size = largest(comparable(q), 1)
    if (size == 0).any():
        raise SingularError("xyzw: the zero quaternion is not a rotation" + at_first_index(size == 0))
    return quaternion_matrix(q if q.dtype == object else q / size[..., None])


def rotation_to_quaternion(R: ArrayLike) -> Array:
    """Quaternion of a rotation matrix, of unit length, scalar last, w ≥ 0 (section 49.2).

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)
        Rotation matrix.

    Returns
    -------
    ndarray, shape (..., 4)
        (x, y, z, w).

    Raises
    ------
    ShapeError
        If the last two axes of `R` are not 3 by 3, or `R` is not a rotation.

    Examples
    --------
    >>> rotation_to_quaternion(np.diag([1, -1, -1]))
    array([1., 0., 0., 0.])
    """
    R = as_array(R, "R", 3, 3)
    check_rotation(R, "R")
    Q = np.empty((*R.shape[:-2], 4, 4), R.dtype)  # 4 q qᵀ, whose entries are sums of those of R
    trace = np.trace(R, axis1=-2, axis2=-1)[..., None, None]
    Q[..., :3, :3] = R + R.mT + np.eye(3) * (1 - trace)
    Q[..., :3, 3] = Q[..., 3, :3] = 2 * skew_part(R)
    Q[..., 3, 3] = 1 + trace[..., 0, 0]
    squares = np.diagonal(Q, axis1=-2, axis2=-1)
    k = squares.real.argmax(-1)[..., None]  # the largest is at least 1: dividing by its root loses nothing
    row = np.take_along_axis(Q, k[..., None], axis=-2)[..., 0, :]
    q = row / (2 * np.sqrt(np.take_along_axis(squares, k, axis=-1)))
    return np.asarray(np.where(q[..., 3:].real < 0, -q, q))


def turn_matrix(w: Array) -> Array:
    """Return 1 + A [w]× + B [w]×²: the formula of `exp3`."""
    theta = length(w)[..., None, None]
    W = cross_matrix(w)
    check_overflow(theta, "w")
    A, H = sinc(theta), sinc(theta / 2) / 2
    return np.asarray(np.eye(3, dtype=w.dtype) + A * W + 2 * (H * W) @ (H * W))


def rotation_vector(xyz: Array, w: Array) -> Array:
    """Return the rotation vector of a quaternion (xyz, w) of any length with w ≥ 0: the formula of `log3`."""
    n = length(xyz)[..., None]
    ratio = 2 * atan2(n, w) / nonzero(n)
    return np.asarray(xyz * (ratio if n.dtype == object else np.where(n == 0, 2, ratio)))


def quaternion_matrix(q: Array) -> Array:
    """Return the rotation 1 + 2 (w [u]× + [u]×²)/|q|² of q = (u, w): the formula of `quaternion_to_rotation`."""
    U, w = cross_matrix(q[..., :3]), q[..., 3, None, None]
    square = (q * q).sum(-1, keepdims=True)[..., None]
    return np.asarray(np.eye(3, dtype=q.dtype) + 2 * (w * U + U @ U) / square)


def cross_matrix(w: Array) -> Array:
    """Return [w]×: the formula of `skew`."""
    M = np.zeros((*w.shape, 3), w.dtype)
    M[..., 2, 1], M[..., 0, 2], M[..., 1, 0] = w[..., 0], w[..., 1], w[..., 2]
    return M - M.mT


def skew_part(M: Array) -> Array:
    """Return the vector of ½(M − Mᵀ)."""
    half = M / 2 - M.mT / 2
    return np.stack([half[..., 2, 1], half[..., 0, 2], half[..., 1, 0]], axis=-1)
