"""The ten numbers of a body, and the forms in which they are written (section 49.5).

Each form is linear in the body: those of two bodies in one frame add up to those of both. Mass, centre of mass and
inertia about it are not, but lose no digits far from the origin: they are what is kept.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_number_array, as_number_arrays, check_overflow, judged, tolerance
from ..errors import ModelError, ShapeError
from ._elementary import at_first_index, atan2, largest
from ._physical import check_numbers
from .orthonormal import nearest_rotation
from .plucker import SE3
from .rotation import cross_matrix, exp3

__all__ = ["TenNumbers"]

UPPER = ([0, 0, 1, 0, 1, 2], [0, 1, 1, 2, 2, 2])
"""Rows and columns of the six different entries of a symmetric matrix, in Pinocchio's order: xx, xy, yy, xz, yz, zz."""

SWEEPS = 8
"""Of Jacobi's rotations; their number of right digits doubles with each, after about three."""


@dataclass(frozen=True, slots=True, eq=False, init=False)
class TenNumbers:
    """The numbers of a `SpatialInertia`, which documents them."""

    mass: Array
    com: Array
    inertia_at_com: Array

    def __init__(self, mass: ArrayLike, com: ArrayLike, inertia_at_com: ArrayLike) -> None:
        m, c, I_c = as_number_arrays(mass=(mass, ()), com=(com, (3,)), inertia_at_com=(inertia_at_com, (3, 3)))
        try:
            batch = np.broadcast_shapes(m.shape, c.shape[:-1], I_c.shape[:-2])
        except ValueError:
            axes = f"batch axes {m.shape}, {c.shape[:-1]} and {I_c.shape[:-2]} do not broadcast"
            raise ShapeError(f"mass, com and inertia_at_com: {axes}") from None
        check_numbers(m, I_c)
        self._set(
            np.array(np.broadcast_to(m, batch)),
            np.array(np.broadcast_to(c, (*batch, 3))),
            np.array(np.broadcast_to(I_c / 2 + I_c.mT / 2, (*batch, 3, 3))),
        )

    def _set(self, mass: Array, com: Array, inertia_at_com: Array) -> None:
        for name, x in (("mass", mass), ("com", com), ("inertia_at_com", inertia_at_com)):
            x.setflags(write=False)
            object.__setattr__(self, name, x)

    @classmethod
    def _trusted(cls, mass: Array, com: Array, inertia_at_com: Array) -> Self:
        """Make an inertia from valid arrays, without checks: they become read-only."""
        (body := object.__new__(cls))._set(np.asarray(mass), com, inertia_at_com)
        return body

    @classmethod
    def zero(cls) -> Self:
        """Return the zero inertia, which changes no sum.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.zero().mass
        array(0.)
        """
        return cls._trusted(np.zeros(()), np.zeros(3), np.zeros((3, 3)))

    def parameters(self) -> Array:
        """Return the ten numbers in which the dynamics is linear: m, m c and the inertia about the origin.

        In Pinocchio's order (``toDynamicParameters``): m, m cx, m cy, m cz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz. A joint's
        force is linear in them, so that they can be estimated from measured motion by least squares.

        Returns
        -------
        ndarray, shape (..., 10)
            kg, kg m, kg m².

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia(2.0, [0, 0, 1], np.diag([1, 2, 3])).parameters()
        array([2., 0., 0., 2., 3., 0., 4., 0., 0., 3.])
        """
        m, C = self.mass[..., None], cross_matrix(self.com)
        about_origin = self.inertia_at_com - m[..., None] * (C @ C)
        return np.concatenate([m, m * self.com, about_origin[(..., *UPPER)]], axis=-1)

    @classmethod
    def from_parameters(cls, p: ArrayLike) -> Self:
        """Make an inertia from the ten numbers of `parameters`.

        Parameters
        ----------
        p : array_like, shape (..., 10)
            m, m c, and Ixx, Ixy, Iyy, Ixz, Iyz, Izz about the origin; kg, kg m, kg m².

        Returns
        -------
        SpatialInertia

        Raises
        ------
        ShapeError
            If the last axis is not 10 long.
        ModelError
            If the mass is negative, or zero where m c is not.
        ValueError
            If products of the numbers overflow.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.from_parameters([2, 0, 0, 2, 3, 0, 4, 0, 0, 3]).com
        array([0., 0., 1.])
        """
        p = as_number_array(p, "p", 10)
        com, about_origin = _center(p[..., 0], p[..., 1:4], "p"), np.zeros((*p.shape[:-1], 3, 3), p.dtype)
        about_origin[(..., *UPPER)] = about_origin[(..., *UPPER[::-1])] = p[..., 4:]
        C = cross_matrix(com)
        with np.errstate(over="ignore", invalid="ignore"):
            about_com = about_origin + p[..., 0, None, None] * (C @ C)
        check_overflow(about_com, "p")
        return cls(p[..., 0], com, about_com)

    def pseudo_inertia(self) -> Array:
        """Return the pseudo-inertia [Σ, m c; (m c)ᵀ, m] with Σ = ∫ x xᵀ dm = ½ tr(I) 1 − I about the origin.

        It is ∫ (x, 1)(x, 1)ᵀ dm: positive definite exactly where a body of this mass, centre and inertia can exist that
        is not flat (a plate, a rod and a point mass are limits). A placement moves it by T P Tᵀ, T 4 × 4.

        Returns
        -------
        ndarray, shape (..., 4, 4)
            kg m², kg m and kg.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.from_box(12.0, [1, 2, 3]).pseudo_inertia()
        array([[ 1.,  0.,  0.,  0.],
               [ 0.,  4.,  0.,  0.],
               [ 0.,  0.,  9.,  0.],
               [ 0.,  0.,  0., 12.]])
        """
        m, c = self.mass[..., None], self.com
        P = np.empty((*c.shape[:-1], 4, 4), c.dtype)
        P[..., :3, :3] = _second_moments(self.inertia_at_com) + (m * c)[..., :, None] * c[..., None, :]
        P[..., :3, 3] = P[..., 3, :3] = m * c
        P[..., 3, 3] = self.mass
        return P

    @classmethod
    def from_pseudo_inertia(cls, P: ArrayLike) -> Self:
        """Make an inertia from its pseudo-inertia: the inverse of `pseudo_inertia`.

        Parameters
        ----------
        P : array_like, shape (..., 4, 4)
            [Σ, m c; (m c)ᵀ, m], symmetric; of A Aᵀ, with any A, a body can exist.

        Returns
        -------
        SpatialInertia

        Raises
        ------
        ShapeError
            If the last axes are not 4 by 4.
        ModelError
            If the matrix is not symmetric, or the mass negative, or zero where m c is not.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.from_pseudo_inertia(np.diag([1, 4, 9, 12])).inertia_at_com.diagonal()
        array([13., 10.,  5.])
        """
        P = as_number_array(P, "P", 4, 4)
        off = largest(judged(P - P.mT), 2)
        wrong = off > tolerance(P.dtype) * largest(judged(P), 2)
        if wrong.any():
            raise ModelError(
                f"P: expected a symmetric matrix, got |P − Pᵀ| = {off[wrong][0]:.3g}{at_first_index(wrong)}"
            )
        mass, com = P[..., 3, 3], _center(P[..., 3, 3], P[..., :3, 3], "P")
        about_com = P[..., :3, :3] - P[..., :3, 3, None] * com[..., None, :]
        return cls(mass, com, _trace(about_com) * np.eye(3, dtype=P.dtype) - about_com)

    def principal_axes(self) -> tuple[Array, SE3]:
        """Return the principal moments, and the frame at the centre of mass in which the inertia is diagonal.

        By Jacobi's rotations, in any floating-point type. Equal moments leave their axes open: any will do.

        Returns
        -------
        moments : ndarray, shape (..., 3)
            kg m², ascending.
        T : SE3
            The principal frame, right-handed, placed in the body's frame; of x and y the largest entry is positive.

        Raises
        ------
        ValueError
            If the numbers are complex: where two moments are equal, the axes have no derivative.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> moments, T = SpatialInertia(1.0, [0, 0, 0.5], [[2, 1, 0], [1, 2, 0], [0, 0, 2]]).principal_axes()
        >>> moments.round(12), T.rotation[:, 2].round(3)
        (array([1., 2., 3.]), array([-0.707, -0.707,  0.   ]))
        """
        I_c = self.inertia_at_com
        if I_c.dtype.kind != "f":
            raise ValueError(f"principal_axes: expected real floating-point numbers, got {I_c.dtype}")
        R, axes, A = np.broadcast_to(np.eye(3, dtype=I_c.dtype), I_c.shape), np.eye(3, dtype=I_c.dtype), I_c
        for _ in range(SWEEPS):
            for k, i, j in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
                across, along = 2 * A[..., i, j], A[..., i, i] - A[..., j, j]
                angle = atan2(np.where(along < 0, -across, across), np.abs(along)) / 2  # at most an eighth of a turn
                turn = exp3(angle[..., None] * axes[k])
                R, A = R @ turn, turn.mT @ A @ turn
        moments = np.diagonal(A, axis1=-2, axis2=-1)
        order = np.argsort(moments, axis=-1)
        x, y, _ = np.moveaxis(np.take_along_axis(nearest_rotation(R), order[..., None, :], axis=-1), -1, 0)
        x, y = _largest_positive(x), _largest_positive(y)
        R = np.stack([x, y, np.cross(x, y)], axis=-1)
        return np.take_along_axis(moments, order, axis=-1), SE3(R, self.com)


def _second_moments(inertia: Array) -> Array:
    """Return ½ tr(I) 1 − I, which is ∫ x xᵀ dm."""
    return np.asarray(_trace(inertia) / 2 * np.eye(3, dtype=inertia.dtype) - inertia)


def _trace(A: Array) -> Array:
    """Return the trace, shape (..., 1, 1)."""
    return np.asarray(np.diagonal(A, axis1=-2, axis2=-1).sum(-1, keepdims=True)[..., None])


def _largest_positive(x: Array) -> Array:
    """Return x or −x, of which the largest entry is positive."""
    largest = np.take_along_axis(x, np.abs(x).argmax(-1, keepdims=True), axis=-1)
    return np.asarray(np.where(largest < 0, -x, x))


def _center(mass: Array, first: Array, name: str) -> Array:
    """Return the centre of mass, 0 for no mass; raise where there is a first moment without a mass."""
    wrong = np.asarray((judged(mass) == 0) & (judged(first) != 0).any(-1))
    if wrong.any():
        raise ModelError(f"{name}: m c is not zero, and the mass is{at_first_index(wrong)}")
    return np.asarray(first / np.where(mass == 0, 1, mass)[..., None])
