"""Spatial inertia, momentum and kinetic energy of one body; with the cross products of `cross` (section 49.5).

Kept are mass, centre of mass and the inertia about it: they lose no digits far from the origin. The 6 × 6 matrix, the
ten parameters and the pseudo-inertia are linear in the body: those of two bodies in one frame add up to those of both.

A shape of uniform density is known by the spread of its mass: the mean of x xᵀ about the centre, whose diagonal is the
mean of x², y² and z². Then I_c = m (tr(spread) 1 − spread): the moment about x adds up the mean of y² and that of z².
"""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from itertools import chain
from typing import NoReturn, Self

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import (
    Array,
    as_array,
    as_finite,
    as_number_array,
    as_number_arrays,
    as_real,
    check_batches,
    check_overflow,
    check_size,
    comparable,
    tolerance,
    without_overflow,
)
from ..errors import ModelError, ShapeError
from ._elementary import at_first_index, atan2, largest
from ._physical import check_numbers, check_physical
from ._vector import FramedVector, align_digits, as_spatial
from .cross import cross_force, cross_motion
from .ellipsoid import views
from .orthonormal import nearest_rotation
from .plucker import SE3, blocks, place_point
from .rotation import cross_matrix, exp3, skew_part
from .twist import Twist, check_placement
from .wrench import Wrench

__all__ = ["SpatialInertia", "cross_force", "cross_motion"]

UPPER = ([0, 0, 1, 0, 1, 2], [0, 1, 1, 2, 2, 2])
"""Rows and columns of the six different entries of a symmetric matrix, in Pinocchio's order: xx, xy, yy, xz, yz, zz."""

JACOBI_SWEEPS = 8
"""Their number of right digits doubles with each, after about three."""


@dataclass(frozen=True, slots=True, eq=False, init=False)
class SpatialInertia:
    """Spatial inertia of a rigid body, kept as its mass, centre of mass and inertia about that: ten numbers (49.5).

    Parameters
    ----------
    mass : array_like, shape (...)
        In kg; zero or more.
    com : array_like, shape (..., 3)
        Centre of mass in the body's frame, m.
    inertia_at_com : array_like, shape (..., 3, 3)
        Inertia about the centre of mass, along the axes of the body's frame, kg m².

    Raises
    ------
    ShapeError
        If a shape is wrong or the batch axes do not broadcast.
    ModelError
        If the mass is negative, or if the inertia is not symmetric to the square root of the resolution of the dtype.

    Examples
    --------
    >>> body = SpatialInertia(2.0, [0, 0, 0.1], np.diag([0.01, 0.01, 0.005]))
    >>> body.matrix()[0, :5]
    array([ 0.03,  0.  ,  0.  ,  0.  , -0.2 ])
    >>> (1.5 * body).mass, (body + body).mass  # half as dense again, and two of them
    (array(3.), array(4.))
    """

    mass: Array
    com: Array
    inertia_at_com: Array

    __array_ufunc__ = None  # NumPy arrays leave the operators to this class

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

    # The forms in which a body is written: matrix, ten parameters, pseudo-inertia; its principal axes.

    @classmethod
    def from_matrix(cls, I6: ArrayLike) -> SpatialInertia:
        """Recover the ten numbers from the 6 × 6 matrix: the inverse of `matrix`.

        Far from the origin m[c]×² drowns I_c in the matrix, and the digits that rounding took are lost.

        Parameters
        ----------
        I6 : array_like, shape (..., 6, 6)
            In the order (ω, v).

        Returns
        -------
        SpatialInertia

        Raises
        ------
        ShapeError
            If the shape is wrong.
        ModelError
            If the matrix is not a spatial inertia.

        Examples
        --------
        >>> body = SpatialInertia(2.0, [0, 0, 0.1], np.diag([0.01, 0.01, 0.005]))
        >>> SpatialInertia.from_matrix(body.matrix()).com
        array([0. , 0. , 0.1])
        """
        M = as_array(I6, "I6", 6, 6)
        mass = M[..., 5, 5]
        com = skew_part(M[..., :3, 3:]) / np.where(mass == 0, 1, mass)[..., None]
        C = cross_matrix(com)
        about_origin = M[..., :3, :3] / 2 + M[..., :3, :3].mT / 2
        with np.errstate(over="ignore", invalid="ignore"):
            body = cls(mass, com, about_origin + mass[..., None, None] * (C @ C))
        off = largest((body.matrix() - M).real, 2)
        wrong = off > tolerance(M.dtype) * largest(M.real, 2)
        if wrong.any():
            raise ModelError(
                f"I6: expected [[I_c − m[c]×², m[c]×], [−m[c]×, m 1]], got a matrix {off[wrong][0]:.3g} away from it"
                + at_first_index(wrong)
            )
        return body

    def matrix(self) -> Array:
        """Return [[I_c − m[c]×², m[c]×], [−m[c]×, m 1]], shape (..., 6, 6), in the order (ω, v).

        Examples
        --------
        >>> SpatialInertia(2.0, [0, 0, 0], np.eye(3)).matrix().diagonal()
        array([1., 1., 1., 2., 2., 2.])
        """
        m, C = self.mass[..., None, None], cross_matrix(self.com)
        return blocks(self.inertia_at_com - m * (C @ C), m * C, -m * C, m * np.eye(3, dtype=m.dtype))

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
        com = _center(p[..., 0], p[..., 1:4], "p")
        about_origin = np.zeros((*p.shape[:-1], 3, 3), p.dtype)
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
        off = largest(comparable(P - P.mT), 2)
        wrong = off > tolerance(P.dtype) * largest(comparable(P), 2)
        if wrong.any():
            raise ModelError(
                f"P: expected a symmetric matrix, got |P − Pᵀ| = {off[wrong][0]:.3g}{at_first_index(wrong)}"
            )
        mass = P[..., 3, 3]
        com = _center(mass, P[..., :3, 3], "P")
        about_com = P[..., :3, :3] - P[..., :3, 3, None] * com[..., None, :]
        return cls(mass, com, _trace(about_com) * np.eye(3, dtype=P.dtype) - about_com)

    def transform(self, T: SE3) -> SpatialInertia:
        """Return the same body's inertia in another frame: I_A = X* I_B X⁻¹.

        Done on the ten numbers, c' = R c + p and I_c' = R I_c Rᵀ, so that nothing is lost far from the origin.

        Parameters
        ----------
        T : SE3
            T_AB: the present frame B, placed in A.

        Returns
        -------
        SpatialInertia

        Raises
        ------
        TypeError
            If `T` is not an SE3.

        Examples
        --------
        >>> SpatialInertia(2.0, [0, 0, 0], np.eye(3)).transform(SE3(np.eye(3), [1, 0, 0])).com
        array([1., 0., 0.])
        """
        check_placement(T)
        check_batches("SE3 and SpatialInertia", T.translation.shape[:-1], self.mass.shape)
        turned = T.rotation @ self.inertia_at_com @ T.rotation.mT
        com = place_point(T.rotation, T.translation, self.com)
        mass = np.broadcast_to(self.mass.astype(com.dtype), com.shape[:-1])
        return SpatialInertia._trusted(mass, com, (turned + turned.mT) / 2)

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
        axes = np.eye(3, dtype=I_c.dtype)
        R = np.broadcast_to(axes, I_c.shape)
        A = I_c
        for _ in range(JACOBI_SWEEPS):
            for k, i, j in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
                across = 2 * A[..., i, j]
                along = A[..., i, i] - A[..., j, j]
                angle = atan2(np.where(along < 0, -across, across), np.abs(along)) / 2  # at most an eighth of a turn
                turn = exp3(angle[..., None] * axes[k])
                R, A = R @ turn, turn.mT @ A @ turn
        moments = np.diagonal(A, axis1=-2, axis2=-1)
        order = np.argsort(moments, axis=-1)
        x, y, _ = np.moveaxis(np.take_along_axis(nearest_rotation(R), order[..., None, :], axis=-1), -1, 0)
        x = _largest_positive(x)
        y = _largest_positive(y)
        R = np.stack([x, y, np.cross(x, y)], axis=-1)
        return np.take_along_axis(moments, order, axis=-1), SE3(R, self.com)

    # Sums, differences, multiples; momentum and energy.

    def __eq__(self, other: object) -> bool:  # by value; like an array, without a hash
        if not isinstance(other, SpatialInertia):
            return NotImplemented
        return all(np.array_equal(getattr(self, x), getattr(other, x)) for x in ("mass", "com", "inertia_at_com"))

    def __add__(self, other: SpatialInertia) -> SpatialInertia:
        if not isinstance(other, SpatialInertia):
            raise TypeError(f"SpatialInertia + {type(other).__name__}: only inertias add, once they are in one frame")
        m1 = self.mass
        m2 = other.mass
        check_batches("SpatialInertia + SpatialInertia", m1.shape, m2.shape)
        m = self.mass + other.mass
        nonzero = np.where(m == 0, 1, m)
        com = np.asarray(m1 / nonzero)[..., None] * self.com + np.asarray(m2 / nonzero)[..., None] * other.com
        # Parallel axes from each centre of mass to the common one add up to m₁m₂/m times the square of their distance.
        D = cross_matrix(other.com - self.com)
        reduced = np.asarray(m1 * m2 / nonzero)[..., None, None]
        return SpatialInertia._trusted(m, com, self.inertia_at_com + other.inertia_at_com - reduced * (D @ D))

    def __radd__(self, other: object) -> SpatialInertia:
        if type(other) is int and other == 0:  # where Python's sum starts
            return self
        raise TypeError(f"{type(other).__name__} + SpatialInertia: only inertias add, once they are in one frame")

    def __sub__(self, other: SpatialInertia) -> SpatialInertia:
        """Take a part away: (a + b) − b is a."""
        if not isinstance(other, SpatialInertia):
            raise TypeError(f"SpatialInertia - {type(other).__name__}: only inertias subtract, in one frame")
        m1, m2 = self.mass, other.mass
        check_batches("SpatialInertia - SpatialInertia", m1.shape, m2.shape)
        apart = self.com - other.com
        m = np.asarray(m1 - m2)
        nothing = np.asarray(comparable(m1) == comparable(m2))
        wrong = np.asarray((comparable(m) < 0) | (nothing & (comparable(m1) > 0) & (comparable(apart) != 0).any(-1)))
        if wrong.any():
            first, second = (comparable(each + 0 * m)[wrong][0] for each in (m1, m2))
            masses = f"{first:.6g} kg − {second:.6g} kg{at_first_index(wrong)}"
            raise ModelError(f"SpatialInertia - SpatialInertia: expected a part of the first, got {masses}")
        ratio = np.asarray(m2 / np.where(nothing, 1, m))  # both masses zero, or at one point: nothing is left but I_c
        com = np.where(nothing[..., None], 0, self.com + ratio[..., None] * apart)
        D = cross_matrix(apart)
        return SpatialInertia._trusted(
            m, com, self.inertia_at_com - other.inertia_at_com + np.asarray(m1 * ratio)[..., None, None] * (D @ D)
        )

    def __mul__(self, scale: ArrayLike) -> SpatialInertia:
        """Scale a body: the same shape of a material as many times as dense."""
        if isinstance(scale, SpatialInertia | FramedVector):
            use = "I @ V is the momentum" if isinstance(scale, FramedVector) else "only inertias and numbers multiply"
            raise TypeError(f"SpatialInertia * {type(scale).__name__}: expected a number; {use}")
        a, m, c, I_c = self._with_scale(scale)
        with np.errstate(over="ignore"):
            return self._scaled(a * m, c, a[..., None, None] * I_c)

    __rmul__ = __mul__

    def __truediv__(self, scale: ArrayLike) -> SpatialInertia:
        if isinstance(scale, SpatialInertia | FramedVector):
            return NotImplemented
        a, m, c, I_c = self._with_scale(scale)
        if (comparable(a) == 0).any():
            raise ZeroDivisionError("SpatialInertia / 0")
        with np.errstate(over="ignore"):
            return self._scaled(m / a, c, I_c / a[..., None, None])

    def _with_scale(self, scale: ArrayLike) -> tuple[Array, Array, Array, Array]:
        """Return a number, or one for each item of a batch, and the ten numbers, all of one type."""
        # A Python number takes the type of the inertia: twice one of float32 is one of float32.
        if type(scale) in (int, float, complex):
            scale = np.asarray(scale, np.result_type(self.com, scale))
        a, m, c, I_c = as_number_arrays(
            scale=(scale, ()), mass=(self.mass, ()), com=(self.com, (3,)), inertia_at_com=(self.inertia_at_com, (3, 3))
        )
        check_batches("scale and SpatialInertia", a.shape, m.shape)
        negative = np.asarray(comparable(a) < 0)
        if negative.any():
            raise ModelError(
                f"scale: expected a number that is not negative, got {comparable(a)[negative][0]:.6g}"
                f"{at_first_index(negative)}: no mass is; I₁ − I₂ takes a part away, and I.parameters() are ten "
                "numbers that may have any sign"
            )
        return a, m, c, I_c

    @staticmethod
    def _scaled(mass: Array, com: Array, inertia_at_com: Array) -> SpatialInertia:
        """Return an inertia whose mass and moments were scaled, and did not overflow."""
        mass, inertia_at_com = np.asarray(mass), np.asarray(inertia_at_com)
        for x in (mass, inertia_at_com):
            check_overflow(x, "scale, mass, inertia_at_com")
        return SpatialInertia._trusted(mass, np.broadcast_to(com, (*mass.shape, 3)), inertia_at_com)

    def __neg__(self) -> SpatialInertia:
        return self * -1

    def __matmul__(self, V: Twist) -> Wrench:
        if not isinstance(V, Twist):
            use = "use I.momentum(V) of arrays, I.matrix() for other products, I.transform(T) for another frame"
            raise TypeError(f"SpatialInertia @ {type(V).__name__}: expected a Twist; {use}")
        return Wrench(self.momentum(V), frame=V.frame)

    def __rmatmul__(self, other: object) -> NoReturn:
        raise TypeError(f"{type(other).__name__} @ SpatialInertia: use I.matrix() for products of arrays")

    @without_overflow("V")
    def momentum(self, V: ArrayLike) -> Array:
        """Return the momentum I V: angular, about the origin of the frame, and linear.

        Parameters
        ----------
        V : Twist or array_like of shape (..., 6)
            (ω, v) in the frame of the inertia, rad/s and m/s.

        Returns
        -------
        ndarray, shape (..., 6)
            kg m²/s and kg m/s. It changes frame as a wrench does: of a Twist, ``I @ V`` is the momentum as a Wrench.

        Raises
        ------
        ShapeError, ValueError
            If the last axis is not 6 long, or products of the numbers overflow.
        TypeError
            If `V` is a Wrench.

        Examples
        --------
        >>> SpatialInertia(2.0, [0, 0, 0], np.eye(3)).momentum([0, 0, 1, 3, 0, 0])
        array([0., 0., 1., 6., 0., 0.])
        """
        w, v_c = self._velocity_of_com(V)
        p = self.mass[..., None] * v_c
        return np.concatenate([np.matvec(self.inertia_at_com, w) + np.cross(self.com, p), p], axis=-1)

    @without_overflow("V")
    def kinetic_energy(self, V: ArrayLike) -> Array:
        """Return the kinetic energy ½ VᵀI V, as ½ m v_c² + ½ ωᵀI_c ω.

        Parameters
        ----------
        V : Twist or array_like of shape (..., 6)
            (ω, v) in the frame of the inertia, rad/s and m/s.

        Returns
        -------
        ndarray, shape (...)
            J.

        Raises
        ------
        ShapeError, ValueError
            If the last axis is not 6 long, or products of the numbers overflow.
        TypeError
            If `V` is a Wrench.

        Examples
        --------
        >>> SpatialInertia(2.0, [0, 0, 0], np.eye(3)).kinetic_energy([0, 0, 1, 3, 0, 0])
        array(9.5)
        """
        w, v_c = self._velocity_of_com(V)
        return np.asarray((self.mass * (v_c * v_c).sum(-1) + (w * np.matvec(self.inertia_at_com, w)).sum(-1)) / 2)

    def _velocity_of_com(self, V: ArrayLike) -> tuple[Array, Array]:
        """Return ω and the velocity v + ω×c of the centre of mass, over the batch axes of both."""
        V = as_spatial(V, "V")
        check_batches("SpatialInertia and V", self.mass.shape, V.shape[:-1])
        v_c = V[..., 3:] + np.cross(V[..., :3], self.com)
        return np.broadcast_to(V[..., :3], v_c.shape), v_c

    def check_physical(self, link: str) -> None:
        """Raise ModelError unless a body with this inertia can exist.

        The mass is positive; no principal moment is negative; the largest is at most the sum of the other two. Each to
        a relative 1e-9, and to the rounding of m|c|²: point masses, thin rods and plates are limits, and pass.

        Parameters
        ----------
        link : str
            The link's name, for the error.

        Raises
        ------
        ModelError
            Names the link, the condition that fails and its numbers.

        Examples
        --------
        >>> SpatialInertia(1.0, [0, 0, 0], np.diag([1, 1, 10])).check_physical("calf")
        Traceback (most recent call last):
        twistwrench.errors.ModelError: link 'calf': the largest principal moment must not exceed ...
        """
        check_physical(link, self.mass, self.com, self.inertia_at_com)

    def nearest_physical(self) -> SpatialInertia:
        """Return the nearest inertia that a body can have: mass and centre of mass stay, so do the principal axes.

        Of the moments about the centre of mass (a ≤ b ≤ c) as little is changed as possible, in the root of the sum of
        squares of the whole matrix: a plate's where c > a + b, a rod's where even that has a negative moment.

        Returns
        -------
        SpatialInertia
            This one, to the last bit, where a body can have it.

        Raises
        ------
        ModelError
            If a mass is not positive.

        Examples
        --------
        >>> too_flat = SpatialInertia(1.0, [0, 0, 0.1], np.diag([1.0, 2.0, 3.3]))
        >>> too_flat.nearest_physical().inertia_at_com.diagonal()
        array([1.1, 2.1, 3.2])
        """
        if (comparable(self.mass) <= 0).any():
            raise ModelError(f"nearest_physical: expected a positive mass, got {comparable(self.mass).min():.6g} kg")
        moments, T = self.principal_axes()
        a, b, c = np.moveaxis(moments, -1, 0)
        excess = c - (a + b)
        plate = np.stack([a + excess / 3, b + excess / 3, c - excess / 3], axis=-1)
        side = np.maximum((b + c) / 2, 0)
        rod = np.stack([0 * side, side, side], axis=-1)
        nearest = np.where(plate[..., :1] < 0, rod, plate)
        R = T.rotation
        changed = (R * nearest[..., None, :]) @ R.mT
        within = (excess <= 0)[..., None, None]
        return SpatialInertia._trusted(self.mass, self.com, np.where(within, self.inertia_at_com, changed))

    # Bodies of uniform density. Every shape lies along the axes of its frame, a length along z, the centre at 0;
    # `transform` puts it elsewhere. Lengths may be zero: a plate is a box without height.

    @classmethod
    def from_box(cls, mass: ArrayLike, size: ArrayLike) -> Self:
        """Make a solid box.

        Parameters
        ----------
        mass : array_like, shape (...)
            kg.
        size : array_like, shape (..., 3)
            From face to face along x, y and z, m.

        Returns
        -------
        SpatialInertia

        Raises
        ------
        ShapeError, ModelError
            If a shape is wrong, or a number is negative.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.from_box(12.0, [1, 2, 3]).inertia_at_com.diagonal()
        array([13., 10.,  5.])
        """
        m, s = _positive(mass=(mass, ()), size=(size, (3,)))
        return cls._spread_along_axes(m, *np.moveaxis(s * s / 12, -1, 0))

    @classmethod
    def from_ellipsoid(cls, mass: ArrayLike, radii: ArrayLike) -> Self:
        """Make a solid ellipsoid; as `from_box`, with the half axes `radii`, shape (..., 3), m.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.from_ellipsoid(5.0, [1, 2, 3]).inertia_at_com.diagonal()
        array([13., 10.,  5.])
        """
        m, r = _positive(mass=(mass, ()), radii=(radii, (3,)))
        return cls._spread_along_axes(m, *np.moveaxis(r * r / 5, -1, 0))

    @classmethod
    def from_sphere(cls, mass: ArrayLike, radius: ArrayLike) -> Self:
        """Make a solid sphere; as `from_cylinder`, without a length.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.from_sphere(5.0, 2).inertia_at_com.diagonal()  # 2/5 m r²
        array([8., 8., 8.])
        """
        m, r = _positive(mass=(mass, ()), radius=(radius, ()))
        return cls._spread_along_axes(m, r * r / 5, r * r / 5, r * r / 5)

    @classmethod
    def from_shell(cls, mass: ArrayLike, radius: ArrayLike) -> Self:
        """Make a thin hollow sphere; as `from_sphere`.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.from_shell(3.0, 2).inertia_at_com.diagonal()  # 2/3 m r²
        array([8., 8., 8.])
        """
        m, r = _positive(mass=(mass, ()), radius=(radius, ()))
        return cls._spread_along_axes(m, r * r / 3, r * r / 3, r * r / 3)

    @classmethod
    def from_cylinder(cls, mass: ArrayLike, radius: ArrayLike, length: ArrayLike) -> Self:
        """Make a solid cylinder along z.

        Parameters
        ----------
        mass : array_like, shape (...)
            kg.
        radius, length : array_like, shape (...)
            m.

        Returns
        -------
        SpatialInertia

        Raises
        ------
        ShapeError, ModelError
            If the batch axes do not broadcast, or a number is negative.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.from_cylinder(12.0, 1, 2).inertia_at_com.diagonal()  # m (3r² + l²)/12, and ½ m r²
        array([7., 7., 6.])
        """
        m, r, h = _positive(mass=(mass, ()), radius=(radius, ()), length=(length, ()))
        return cls._spread_along_axes(m, r * r / 4, r * r / 4, h * h / 12)

    @classmethod
    def from_capsule(cls, mass: ArrayLike, radius: ArrayLike, length: ArrayLike) -> Self:
        """Make a solid capsule along z: a cylinder of that length between two half spheres; as `from_cylinder`.

        The length is that of the cylinder, as in Pinocchio, MuJoCo and Drake; the whole is longer by two radii.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.from_capsule(2.0, 0.3, 0.8).inertia_at_com[2, 2].round(12)
        np.float64(0.084)
        """
        m, r, h = _positive(mass=(mass, ()), radius=(radius, ()), length=(length, ()))
        volumes = 3 * h + 4 * r  # of the whole, in units of π r²/3: the cylinder's 3 h, the balls' 4 r
        middle = 3 * h / np.where(volumes == 0, 1, volumes)
        across = middle * r * r / 4 + (1 - middle) * r * r / 5
        along = middle * h * h / 12 + (1 - middle) * (h * h / 4 + 3 * h * r / 8 + r * r / 5)
        return cls._spread_along_axes(m, across, across, along)

    @classmethod
    def from_rod(cls, mass: ArrayLike, length: ArrayLike) -> Self:
        """Make a thin rod along z, with no moment about it; as `from_cylinder`, without a radius.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.from_rod(12.0, 2).inertia_at_com.diagonal()  # 1/12 m l²
        array([4., 4., 0.])
        """
        m, h = _positive(mass=(mass, ()), length=(length, ()))
        return cls._spread_along_axes(m, 0 * h, 0 * h, h * h / 12)

    @classmethod
    def from_point(cls, mass: ArrayLike, point: ArrayLike = (0, 0, 0)) -> Self:
        """Make a point mass: a body that is a limit, without moments, which no torque would turn at a finite rate.

        Parameters
        ----------
        mass : array_like, shape (...)
            kg.
        point : array_like, shape (..., 3)
            m.

        Returns
        -------
        SpatialInertia

        Raises
        ------
        ShapeError, ModelError
            If a shape is wrong, or the mass is negative.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> SpatialInertia.from_point(2.0, [0, 0, 1]).matrix().diagonal()
        array([2., 2., 0., 2., 2., 2.])
        """
        m, p = as_number_arrays(mass=(mass, ()), point=(point, (3,)))
        return cls(m, p, np.zeros((3, 3), p.dtype))

    @classmethod
    def from_mesh(cls, mass: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> Self:
        """Make the solid within a closed surface of triangles: the sum of the tetrahedra from its middle to each.

        Parameters
        ----------
        mass : float
            kg.
        vertices : array_like, shape (n, 3)
            m.
        faces : array_like of int, shape (k, 3)
            The corners of each triangle by their rows in `vertices`, anticlockwise as seen from outside. Of
            ``mesh = trimesh.load_mesh("calf.stl")`` they are ``mesh.vertices`` and ``mesh.faces``.

        Returns
        -------
        SpatialInertia

        Raises
        ------
        ShapeError
            If a shape is wrong or a face names a vertex that is not there.
        ModelError
            If the mass is negative, the surface is not closed, or holds no volume because it is inside out.

        Examples
        --------
        >>> from twistwrench import SpatialInertia
        >>> corner = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> SpatialInertia.from_mesh(1.0, corner, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]).com
        array([0.25, 0.25, 0.25])
        """
        m, x = as_finite(mass, "mass"), as_real(vertices, "vertices", 3)
        if x.ndim != 2:
            raise ShapeError(f"vertices: expected shape (n, 3), got {x.shape}")
        check_size(x, "vertices")
        triangles = _closed(faces, len(x))
        middle = x.mean(axis=0)
        corners = x[triangles] - middle
        volume = np.linalg.det(corners) / 6
        if not volume.sum() > 0:
            raise ModelError(
                f"vertices, faces: expected a volume above zero, got {volume.sum():.3g} m³: is it inside out?"
            )
        share = volume / volume.sum()
        total = corners.sum(axis=1)
        com = share @ total / 4
        about_middle = np.einsum("k,ki,kj->ij", share, total, total) + np.einsum(
            "k,kai,kaj->ij", share, corners, corners
        )
        spread = about_middle / 20 - com[:, None] * com
        return cls(m, middle + com, m * (np.trace(spread) * np.eye(3) - spread))

    @classmethod
    def _spread_along_axes(cls, mass: Array, x: Array, y: Array, z: Array) -> Self:
        """Make a body at the origin, with these means of x², y² and z²."""
        squares = np.stack(np.broadcast_arrays(x, y, z), axis=-1)
        moments = (mass[..., None] * (squares.sum(-1, keepdims=True) - squares))[..., None, :]
        return cls(mass, np.zeros(3, squares.dtype), np.eye(3, dtype=squares.dtype) * moments)

    def __repr__(self) -> str:
        if self.mass.ndim:
            return f"<SpatialInertia: a batch, shape {self.mass.shape}>"
        com, I_c = align_digits("    com=", self.com), align_digits("    inertia_at_com=", self.inertia_at_com)
        return f"SpatialInertia(mass={self.mass},\n{com},\n{I_c})"

    def _repr_html_(self) -> str:
        if self.mass.ndim:
            return f"<pre>{escape(repr(self))}</pre>"
        com, I_c = (np.array2string(x, precision=4) for x in (self.com, self.inertia_at_com))
        text = f"<pre>{self.mass:.4g} kg, centre of mass at {com} m, about it\n{I_c} kg m²</pre>"
        return text + views(self.mass, self.com, self.inertia_at_com) if self.mass else text


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
    wrong = np.asarray((comparable(mass) == 0) & (comparable(first) != 0).any(-1))
    if wrong.any():
        raise ModelError(f"{name}: m c is not zero, and the mass is{at_first_index(wrong)}")
    return np.asarray(first / np.where(mass == 0, 1, mass)[..., None])


def _positive(**named: tuple[ArrayLike, tuple[int, ...]]) -> tuple[Array, ...]:
    """Convert as `as_number_arrays`; raise ModelError where a number is negative."""
    arrays = as_number_arrays(**named)
    for name, x in zip(named, arrays):
        if x.dtype != object:
            check_size(x, name)
        wrong = comparable(x) < 0
        if wrong.any():
            raise ModelError(
                f"{name}: expected no negative number, got {comparable(x)[wrong][0]:.6g}{at_first_index(wrong)}"
            )
    try:
        np.broadcast_shapes(*(x.shape[: x.ndim - len(tail)] for x, (_, tail) in zip(arrays, named.values())))
    except ValueError:
        raise ShapeError(f"{', '.join(named)}: batch axes do not broadcast") from None
    return arrays


def _closed(faces: ArrayLike, count: int) -> Array:
    """Return the triangles; raise unless each edge belongs to two of them, once in each direction."""
    k = as_real(faces, "faces", 3)
    if k.ndim != 2 or not ((k >= 0) & (k < count) & (k == k.round())).all():
        raise ShapeError(f"faces: expected rows of vertices, 0 to {count - 1}, shape (k, 3), got shape {k.shape}")
    k = k.astype(np.intp)
    edges = set(chain.from_iterable(((a, b), (b, c), (c, a)) for a, b, c in k.tolist()))
    open_ = [(a, b) for a, b in edges if (b, a) not in edges]
    if open_ or len(edges) != 3 * len(k):
        where = f": the edge {open_[0]} has one side only" if open_ else ""
        raise ModelError(f"faces: expected a closed surface{where}; merge vertices that are the same point")
    return k
