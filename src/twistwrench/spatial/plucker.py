"""Change of frame: placements T in SE(3), and their 6 × 6 matrices X and X* (section 49.3).

T_AB places frame B in frame A. X takes twists from B to A, X* takes wrenches from B to A.
X* is the inverse transpose of X, not its transpose: that keeps the power FᵀV the same in both frames.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, as_number_array, as_number_arrays, check_batches, tolerance
from ..errors import ShapeError
from ._elementary import at_first_index, largest
from ._vector import align_digits, latex_matrix
from .orthonormal import check_rotation
from .rotation import cross_matrix

__all__ = ["SE3", "force_transform", "motion_transform"]


def motion_transform(R: ArrayLike, p: ArrayLike | None = None) -> Array:
    """Plücker transform of twists, X = [[R, 0], [[p]×R, R]] (section 49.3).

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)
        Rotation that takes coordinates in frame B to frame A.
    p : array_like, shape (..., 3)
        Origin of B in A, m.

    Returns
    -------
    ndarray, shape (..., 6, 6)
        X: V_A = X V_B, in the order (ω, v).

    Raises
    ------
    ShapeError
        If a shape is wrong or `R` is not a rotation.

    Examples
    --------
    >>> X = motion_transform(np.eye(3), [1, 0, 0])
    >>> X @ [0, 0, 1, 0, 0, 0]  # turning about z at (1, 0, 0): the origin of A moves along −y
    array([ 0.,  0.,  1.,  0., -1.,  0.])
    """
    return _placed(R, p, "motion_transform").motion_transform()


def _placed(R: ArrayLike, p: ArrayLike | None, name: str) -> SE3:
    """Return the placement; for an SE3 in the place of R, raise with the method that is meant."""
    if isinstance(R, SE3) or p is None:
        hint = f"; did you mean T.{name}()?" if isinstance(R, SE3) else ""
        raise TypeError(f"R, p: expected a rotation matrix and a point, got {type(R).__name__} and {p!r}{hint}")
    return SE3(R, p)


def force_transform(R: ArrayLike, p: ArrayLike | None = None) -> Array:
    """Plücker transform of wrenches, X* = X⁻ᵀ = [[R, [p]×R], [0, R]] (sections 49.3 and 49.4).

    Parameters
    ----------
    R : array_like, shape (..., 3, 3)
        Rotation that takes coordinates in frame B to frame A.
    p : array_like, shape (..., 3)
        Origin of B in A, m.

    Returns
    -------
    ndarray, shape (..., 6, 6)
        X*: F_A = X* F_B, in the order (τ, f).

    Raises
    ------
    ShapeError
        If a shape is wrong or `R` is not a rotation.

    Examples
    --------
    >>> Xf = force_transform(np.eye(3), [1, 0, 0])
    >>> Xf @ [0, 0, 0, 0, 0, 1]  # a unit force along z at (1, 0, 0) has the moment −1 about y
    array([ 0., -1.,  0.,  0.,  0.,  1.])
    """
    return _placed(R, p, "force_transform").force_transform()


@dataclass(frozen=True, slots=True, eq=False, init=False)
class SE3:
    """Placement T_AB of frame B in frame A: x_A = R x_B + p (section 49.3).

    Parameters
    ----------
    rotation : array_like, shape (..., 3, 3)
        R, which takes coordinates in B to coordinates in A.
    translation : array_like, shape (..., 3)
        p, the origin of B in A, m.

    Raises
    ------
    ShapeError
        If a shape is wrong, if the batch axes do not broadcast, or if `rotation` is not a rotation: RᵀR = 1 and
        det R = 1 must hold to the square root of the resolution of the dtype.

    Examples
    --------
    >>> T_AB = SE3(np.eye(3), [1, 0, 0])
    >>> T_BC = SE3(np.eye(3), [0, 2, 0])
    >>> (T_AB @ T_BC).translation
    array([1., 2., 0.])
    """

    rotation: Array
    translation: Array

    # NumPy arrays leave the operators to this class.
    __array_ufunc__ = None

    def __init__(self, rotation: ArrayLike, translation: ArrayLike) -> None:
        R, p = as_number_arrays(rotation=(rotation, (3, 3)), translation=(translation, (3,)))
        check_rotation(R, "rotation")
        try:
            batch = np.broadcast_shapes(R.shape[:-2], p.shape[:-1])
        except ValueError:
            raise ShapeError(
                f"rotation and translation: batch axes {R.shape[:-2]} and {p.shape[:-1]} do not broadcast"
            ) from None
        self._set(np.array(np.broadcast_to(R, (*batch, 3, 3))), np.array(np.broadcast_to(p, (*batch, 3))))

    def _set(self, rotation: Array, translation: Array) -> None:
        rotation.setflags(write=False)
        translation.setflags(write=False)
        object.__setattr__(self, "rotation", rotation)
        object.__setattr__(self, "translation", translation)

    @classmethod
    def _trusted(cls, rotation: Array, translation: Array) -> SE3:
        """Make a placement from valid arrays, without checks: they become read-only."""
        T = object.__new__(cls)
        T._set(rotation, translation)
        return T

    @classmethod
    def identity(cls) -> SE3:
        """Return the placement of a frame in itself.

        Examples
        --------
        >>> SE3.identity().translation
        array([0., 0., 0.])
        """
        return cls._trusted(np.eye(3), np.zeros(3))

    @classmethod
    def from_matrix(cls, T: ArrayLike) -> SE3:
        """Make a placement from its 4 × 4 homogeneous matrix.

        Parameters
        ----------
        T : array_like, shape (..., 4, 4)
            [[R, p], [0, 1]], p in m.

        Returns
        -------
        SE3

        Raises
        ------
        ShapeError
            If the shape is wrong, the last row is not (0, 0, 0, 1), or the rotation block is not a rotation matrix.

        Examples
        --------
        >>> SE3.from_matrix(np.eye(4)).translation
        array([0., 0., 0.])
        """
        M = as_array(T, "T", 4, 4)
        wrong = largest((M[..., 3, :] - [0, 0, 0, 1]).real, 1) > tolerance(M.dtype)
        if wrong.any():
            got = M[wrong][0, 3].tolist()
            raise ShapeError(f"T: expected (0, 0, 0, 1) as the last row, got {got}" + at_first_index(wrong))
        return cls(M[..., :3, :3], M[..., :3, 3])

    def matrix(self) -> Array:
        """Return the 4 × 4 homogeneous matrix [[R, p], [0, 1]], shape (..., 4, 4).

        Examples
        --------
        >>> SE3(np.eye(3), [1, 2, 3]).matrix()[:3, 3]
        array([1., 2., 3.])
        """
        M = np.zeros((*self.translation.shape[:-1], 4, 4), self.rotation.dtype)
        M[..., :3, :3], M[..., :3, 3], M[..., 3, 3] = self.rotation, self.translation, 1
        return M

    def __eq__(self, other: object) -> bool:  # by value; like an array, without a hash
        if not isinstance(other, SE3):
            return NotImplemented
        return np.array_equal(self.rotation, other.rotation) and np.array_equal(self.translation, other.translation)

    def __matmul__(self, other: SE3) -> SE3:
        if not isinstance(other, SE3):
            name = {"Twist": "V", "Wrench": "F", "SpatialInertia": "I"}.get(type(other).__name__)
            use = "T.act(x) for points, T.motion_transform() @ x for twists, T.force_transform() @ x for wrenches"
            use = use if name is None else f"{name}.transform(T)"
            raise TypeError(f"SE3 @ {type(other).__name__}: only placements are chained with @; use {use}")
        check_batches("SE3 @ SE3", self.translation.shape[:-1], other.translation.shape[:-1])
        p = place_point(self.rotation, self.translation, other.translation)
        return SE3._trusted(self.rotation @ other.rotation, p)

    def __rmatmul__(self, other: object) -> SE3:
        raise TypeError(
            f"{type(other).__name__} @ SE3: only placements are chained with @; use T.matrix() for the 4 × 4 matrix"
        )

    def inverse(self) -> SE3:
        """Return T_BA, the placement of A in B.

        Examples
        --------
        >>> SE3(np.eye(3), [1, 2, 3]).inverse().translation
        array([-1., -2., -3.])
        """
        return SE3._trusted(self.rotation.mT, -np.matvec(self.rotation.mT, self.translation))

    def act(self, point: ArrayLike) -> Array:
        """Return the coordinates in A of a point given in B, R x + p.

        Parameters
        ----------
        point : array_like, shape (..., 3)
            In frame B, m.

        Returns
        -------
        ndarray, shape (..., 3)
            In frame A, m.

        Raises
        ------
        ShapeError
            If the last axis is not 3 long, or the batch axes do not broadcast.

        Examples
        --------
        >>> SE3(np.eye(3), [1, 0, 0]).act([0, 2, 0])
        array([1., 2., 0.])
        """
        point = as_number_array(point, "point", 3)
        check_batches("SE3 and point", self.translation.shape[:-1], point.shape[:-1])
        return place_point(self.rotation, self.translation, point)

    def motion_transform(self) -> Array:
        """Return X, which takes twists from B to A, shape (..., 6, 6): see `motion_transform`.

        Examples
        --------
        >>> T = SE3(np.eye(3), [1, 0, 0])
        >>> bool((T.motion_transform() @ T.inverse().motion_transform() == np.eye(6)).all())
        True
        """
        R = self.rotation
        return blocks(R, np.zeros_like(R), cross_matrix(self.translation) @ R, R)

    def force_transform(self) -> Array:
        """Return X* = X⁻ᵀ, which takes wrenches from B to A, shape (..., 6, 6): see `force_transform`.

        Examples
        --------
        >>> T = SE3(np.eye(3), [1, 0, 0])
        >>> bool((T.force_transform() == T.inverse().motion_transform().mT).all())
        True
        """
        R = self.rotation
        return blocks(R, cross_matrix(self.translation) @ R, np.zeros_like(R), R)

    def __repr__(self) -> str:
        if self.translation.ndim > 1:
            return f"<SE3: a batch of placements, shape {self.translation.shape[:-1]}>"
        rotation = align_digits("SE3(rotation=", self.rotation)
        translation = align_digits("    translation=", self.translation)
        return f"{rotation},\n{translation})"

    def _repr_latex_(self) -> str | None:
        return None if self.translation.ndim > 1 else f"$T = {latex_matrix(self.matrix())}$"


def place_point(R: Array, p: Array, x: Array) -> Array:
    """Return R x + p, without checks and for any number type: the formula of `SE3.act`."""
    return np.asarray(np.matvec(R, x) + p)


def blocks(a: Array, b: Array, c: Array, d: Array) -> Array:
    """Assemble [[a, b], [c, d]] from 3 × 3 blocks of one batch shape and dtype."""
    M = np.empty((*a.shape[:-2], 6, 6), a.dtype)
    M[..., :3, :3], M[..., :3, 3:], M[..., 3:, :3], M[..., 3:, 3:] = a, b, c, d
    return M
