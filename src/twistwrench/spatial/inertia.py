"""Spatial inertia, momentum and kinetic energy of one body; with the cross products of `cross` (section 49.5)."""

from __future__ import annotations

from html import escape
from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, as_number_arrays, check_overflow, judged, tolerance, without_overflow
from ..errors import ModelError
from ._elementary import at_first_index, largest
from ._physical import check_physical
from ._shapes import Shapes
from ._vector import SpatialVector, aligned, as_spatial
from .cross import cross_force, cross_motion
from .ellipsoid import views
from .plucker import SE3, blocks, placed_point
from .rotation import cross_matrix, skew_part
from .twist import Twist, check_placement
from .wrench import Wrench

__all__ = ["SpatialInertia", "cross_force", "cross_motion"]


class SpatialInertia(Shapes):
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

    __slots__ = ()
    __array_ufunc__ = None  # NumPy arrays leave the operators to this class

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
        C, about_origin = cross_matrix(com), M[..., :3, :3] / 2 + M[..., :3, :3].mT / 2
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
        turned = T.rotation @ self.inertia_at_com @ T.rotation.mT
        com = placed_point(T.rotation, T.translation, self.com)
        mass = np.broadcast_to(self.mass.astype(com.dtype), com.shape[:-1])
        return SpatialInertia._trusted(mass, com, (turned + turned.mT) / 2)

    def __eq__(self, other: object) -> bool:  # by value; like an array, without a hash
        if not isinstance(other, SpatialInertia):
            return NotImplemented
        return all(np.array_equal(getattr(self, x), getattr(other, x)) for x in ("mass", "com", "inertia_at_com"))

    def __add__(self, other: SpatialInertia) -> SpatialInertia:
        if not isinstance(other, SpatialInertia):
            raise TypeError(f"SpatialInertia + {type(other).__name__}: only inertias add, once they are in one frame")
        m1, m2, m = self.mass, other.mass, self.mass + other.mass
        nonzero = np.where(m == 0, 1, m)
        com = np.asarray(m1 / nonzero)[..., None] * self.com + np.asarray(m2 / nonzero)[..., None] * other.com
        # Parallel axes from each centre of mass to the common one add up to m₁m₂/m times the square of their distance.
        D, reduced = cross_matrix(other.com - self.com), np.asarray(m1 * m2 / nonzero)[..., None, None]
        return SpatialInertia._trusted(m, com, self.inertia_at_com + other.inertia_at_com - reduced * (D @ D))

    def __radd__(self, other: object) -> SpatialInertia:
        if type(other) is int and other == 0:  # where Python's sum starts
            return self
        raise TypeError(f"{type(other).__name__} + SpatialInertia: only inertias add, once they are in one frame")

    def __sub__(self, other: SpatialInertia) -> SpatialInertia:
        """Take a part away: (a + b) − b is a."""
        if not isinstance(other, SpatialInertia):
            raise TypeError(f"SpatialInertia - {type(other).__name__}: only inertias subtract, in one frame")
        m1, m2, apart = self.mass, other.mass, self.com - other.com
        m, nothing = np.asarray(m1 - m2), np.asarray(judged(m1) == judged(m2))
        wrong = np.asarray((judged(m) < 0) | (nothing & (judged(m1) > 0) & (judged(apart) != 0).any(-1)))
        if wrong.any():
            masses = (
                f"{judged(m1 + 0 * m)[wrong][0]:.6g} kg − {judged(m2 + 0 * m)[wrong][0]:.6g} kg{at_first_index(wrong)}"
            )
            raise ModelError(f"SpatialInertia - SpatialInertia: expected a part of the first, got {masses}")
        ratio = np.asarray(m2 / np.where(nothing, 1, m))  # both masses zero, or at one point: nothing is left but I_c
        com = np.where(nothing[..., None], 0, self.com + ratio[..., None] * apart)
        D = cross_matrix(apart)
        return SpatialInertia._trusted(
            m, com, self.inertia_at_com - other.inertia_at_com + np.asarray(m1 * ratio)[..., None, None] * (D @ D)
        )

    def __mul__(self, scale: ArrayLike) -> SpatialInertia:
        """Scale a body: the same shape of a material as many times as dense."""
        if isinstance(scale, SpatialInertia | SpatialVector):
            use = "I @ V is the momentum" if isinstance(scale, SpatialVector) else "only inertias and numbers multiply"
            raise TypeError(f"SpatialInertia * {type(scale).__name__}: expected a number; {use}")
        a, m, c, I_c = self._with_scale(scale)
        with np.errstate(over="ignore"):
            return self._scaled(a * m, c, a[..., None, None] * I_c)

    __rmul__ = __mul__

    def __truediv__(self, scale: ArrayLike) -> SpatialInertia:
        if isinstance(scale, SpatialInertia | SpatialVector):
            return NotImplemented
        a, m, c, I_c = self._with_scale(scale)
        if (judged(a) == 0).any():
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
        negative = np.asarray(judged(a) < 0)
        if negative.any():
            raise ModelError(
                f"scale: expected a number that is not negative, got {judged(a)[negative][0]:.6g}"
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

    def __repr__(self) -> str:
        if self.mass.ndim:
            return f"<SpatialInertia: a batch, shape {self.mass.shape}>"
        com, I_c = aligned("    com=", self.com), aligned("    inertia_at_com=", self.inertia_at_com)
        return f"SpatialInertia(mass={self.mass},\n{com},\n{I_c})"

    def _repr_html_(self) -> str:
        if self.mass.ndim:
            return f"<pre>{escape(repr(self))}</pre>"
        com, I_c = (np.array2string(x, precision=4) for x in (self.com, self.inertia_at_com))
        text = f"<pre>{self.mass:.4g} kg, centre of mass at {com} m, about it\n{I_c} kg m²</pre>"
        return text + views(self.mass, self.com, self.inertia_at_com) if self.mass else text
