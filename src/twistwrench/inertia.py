"""Spatial inertia, the spatial cross products, momentum and kinetic energy of one body (section 49.5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .checks import Array, as_array, as_arrays, resolution
from .errors import ModelError, ShapeError
from .plucker import SE3, blocks
from .rotation import largest, skew

__all__ = ["SpatialInertia", "cross_force", "cross_motion"]


def cross_motion(V: ArrayLike) -> Array:
    """Matrix V× = [[ω]×, 0; [v]×, [ω]×]: the rate of a twist carried along by V (section 49.5).

    Parameters
    ----------
    V : array_like, shape (..., 6)
        Twist (ω, v), rad/s and m/s.

    Returns
    -------
    ndarray, shape (..., 6, 6)

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.

    Examples
    --------
    >>> cross_motion([0, 0, 1, 0, 0, 0]) @ [1, 0, 0, 0, 0, 0]
    array([0., 1., 0., 0., 0., 0.])
    """
    V = as_array(V, "V", 6)
    W = skew(V[..., :3])
    return blocks(W, np.zeros_like(W), skew(V[..., 3:]), W)


def cross_force(V: ArrayLike) -> Array:
    """Matrix V×* = −(V×)ᵀ = [[ω]×, [v]×; 0, [ω]×]: the rate of a wrench carried along by V (section 49.5).

    Parameters
    ----------
    V : array_like, shape (..., 6)
        Twist (ω, v), rad/s and m/s.

    Returns
    -------
    ndarray, shape (..., 6, 6)

    Raises
    ------
    ShapeError
        If the last axis is not 6 long.

    Examples
    --------
    >>> cross_force([0, 0, 0, 1, 0, 0]) @ [0, 0, 0, 0, 1, 0]
    array([0., 0., 1., 0., 0., 0.])
    """
    return -cross_motion(V).mT


@dataclass(frozen=True, slots=True, eq=False, init=False)
class SpatialInertia:
    """Mass, centre of mass and inertia about it: ten numbers, kept apart (section 49.5).

    Parameters
    ----------
    mass : array_like, shape (...)
        kg, not below zero.
    com : array_like, shape (..., 3)
        Centre of mass in the body's frame, m.
    inertia_at_com : array_like, shape (..., 3, 3)
        Inertia about the centre of mass, along the axes of the body's frame, kg m².

    Raises
    ------
    ShapeError
        If a shape is wrong or the batch axes do not broadcast.
    ModelError
        If the mass is negative or the inertia not symmetric.

    Examples
    --------
    >>> body = SpatialInertia(2.0, [0, 0, 0.1], np.diag([0.01, 0.01, 0.005]))
    >>> body.matrix()[0, :5]
    array([ 0.03,  0.  ,  0.  ,  0.  , -0.2 ])
    """

    mass: Array
    com: Array
    inertia_at_com: Array

    # NumPy arrays leave the operators to this class.
    __array_ufunc__ = None

    def __init__(self, mass: ArrayLike, com: ArrayLike, inertia_at_com: ArrayLike) -> None:
        m, c, I_c = as_arrays(mass=(mass, ()), com=(com, (3,)), inertia_at_com=(inertia_at_com, (3, 3)))
        try:
            batch = np.broadcast_shapes(m.shape, c.shape[:-1], I_c.shape[:-2])
        except ValueError:
            shapes = f"{m.shape}, {c.shape[:-1]} and {I_c.shape[:-2]}"
            raise ShapeError(f"mass, com and inertia_at_com: batch axes {shapes} do not broadcast") from None
        if (m.real < 0).any():
            raise ModelError(f"mass: expected no negative mass, got {m.real.min():.6g} kg")
        off = largest((I_c - I_c.mT).real, 2)
        if (off > resolution(I_c.dtype) ** 0.5 * largest(I_c.real, 2)).any():
            raise ModelError(f"inertia_at_com: expected a symmetric matrix, got |I − Iᵀ| up to {off.max():.3g} kg m²")
        self._set(
            np.array(np.broadcast_to(m, batch)),
            np.array(np.broadcast_to(c, (*batch, 3))),
            np.array(np.broadcast_to((I_c + I_c.mT) / 2, (*batch, 3, 3))),
        )

    def _set(self, mass: Array, com: Array, inertia_at_com: Array) -> None:
        for name, x in (("mass", mass), ("com", com), ("inertia_at_com", inertia_at_com)):
            x.flags.writeable = False
            object.__setattr__(self, name, x)

    @classmethod
    def _trusted(cls, mass: Array, com: Array, inertia_at_com: Array) -> SpatialInertia:
        """Make an inertia from arrays known to be right, without checks: they become read-only."""
        body = object.__new__(cls)
        body._set(np.asarray(mass), com, inertia_at_com)
        return body

    @classmethod
    def zero(cls) -> SpatialInertia:
        """Return the inertia of nothing.

        Examples
        --------
        >>> SpatialInertia.zero().mass
        array(0.)
        """
        return cls._trusted(np.zeros(()), np.zeros(3), np.zeros((3, 3)))

    @classmethod
    def from_matrix(cls, I6: ArrayLike) -> SpatialInertia:
        """Recover the ten numbers from the 6 × 6 matrix: the inverse of `matrix`.

        Parameters
        ----------
        I6 : array_like, shape (..., 6, 6)
            In the order (ω, v).

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
        H = (M[..., :3, 3:] - M[..., :3, 3:].mT) / 2
        first = np.stack([H[..., 2, 1], H[..., 0, 2], H[..., 1, 0]], axis=-1)
        massless = mass.real == 0
        com = np.where(massless[..., None], 0, first / np.where(massless, 1, mass)[..., None])
        body = cls(mass, com, M[..., :3, :3] + mass[..., None, None] * skew(com) @ skew(com))
        off = largest((body.matrix() - M).real, 2)
        if (off > resolution(M.dtype) ** 0.5 * largest(M.real, 2)).any():
            raise ModelError(
                f"I6: expected a spatial inertia in the order (ω, v), got one that is off by {off.max():.3g}"
            )
        return body

    def matrix(self) -> Array:
        """Return [[I_c − m[c]×², m[c]×], [−m[c]×, m 1]], shape (..., 6, 6), in the order (ω, v).

        Examples
        --------
        >>> SpatialInertia(2.0, [0, 0, 0], np.eye(3)).matrix().diagonal()
        array([1., 1., 1., 2., 2., 2.])
        """
        m, C = self.mass[..., None, None], skew(self.com)
        return blocks(self.inertia_at_com - m * C @ C, m * C, -m * C, m * np.eye(3, dtype=C.dtype))

    def transform(self, T: SE3) -> SpatialInertia:
        """Return the inertia in frame A, where T = T_AB places the present frame B in A: X* I X⁻¹.

        Done on the ten numbers: c' = R c + p, I_c' = R I_c Rᵀ. Nothing is lost far from the origin.

        Examples
        --------
        >>> SpatialInertia(2.0, [0, 0, 0], np.eye(3)).transform(SE3(np.eye(3), [1, 0, 0])).com
        array([1., 0., 0.])
        """
        R = T.rotation
        turned = R @ self.inertia_at_com @ R.mT
        com = T.act(self.com)
        mass = np.broadcast_to(self.mass.astype(com.dtype, copy=False), com.shape[:-1])
        return SpatialInertia._trusted(mass, com, (turned + turned.mT) / 2)

    def __add__(self, other: SpatialInertia) -> SpatialInertia:
        if not isinstance(other, SpatialInertia):
            raise TypeError(f"SpatialInertia + {type(other).__name__}: only inertias in one frame add")
        m1, m2 = self.mass, other.mass
        m = m1 + m2
        safe = np.where(m == 0, 1, m)
        com = (m1 / safe)[..., None] * self.com + (m2 / safe)[..., None] * other.com
        D = skew(other.com - self.com)
        reduced = (m1 * m2 / safe)[..., None, None]
        return SpatialInertia._trusted(m, com, self.inertia_at_com + other.inertia_at_com - reduced * (D @ D))

    def momentum(self, V: ArrayLike) -> Array:
        """Return the momentum I V about the origin of the frame: (L, p), kg m²/s and kg m/s.

        Parameters
        ----------
        V : Twist or array_like of shape (..., 6)
            (ω, v) in the frame of the inertia, rad/s and m/s.

        Returns
        -------
        ndarray, shape (..., 6)

        Raises
        ------
        ShapeError
            If the last axis is not 6 long.

        Examples
        --------
        >>> SpatialInertia(2.0, [0, 0, 0], np.eye(3)).momentum([0, 0, 1, 3, 0, 0])
        array([0., 0., 1., 6., 0., 0.])
        """
        V = as_array(V, "V", 6)
        w, v = V[..., :3], V[..., 3:]
        p = self.mass[..., None] * (v + np.cross(w, self.com))
        L = np.matvec(self.inertia_at_com, w) + np.cross(self.com, p)
        return np.concatenate([L, p], axis=-1)

    def kinetic_energy(self, V: ArrayLike) -> Array:
        """Return the kinetic energy ½ VᵀI V, J.

        Parameters
        ----------
        V : Twist or array_like of shape (..., 6)
            (ω, v) in the frame of the inertia, rad/s and m/s.

        Returns
        -------
        ndarray, shape (...)

        Raises
        ------
        ShapeError
            If the last axis is not 6 long.

        Examples
        --------
        >>> SpatialInertia(2.0, [0, 0, 0], np.eye(3)).kinetic_energy([0, 0, 1, 3, 0, 0])
        array(9.5)
        """
        V = as_array(V, "V", 6)
        w, v = V[..., :3], V[..., 3:]
        v_c = v + np.cross(w, self.com)
        spin = (w * np.matvec(self.inertia_at_com, w)).sum(-1)
        return np.asarray((self.mass * (v_c * v_c).sum(-1) + spin) / 2)

    def check_physical(self, link: str) -> None:
        """Raise ModelError unless a body with this inertia can exist.

        The mass is positive, no principal moment is negative, not all are zero, and the largest is not above the sum
        of the other two (each to a relative 1e-9: a thin rod and a thin plate lie on the edge, and pass).

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
        twistwrench.errors.ModelError: link 'calf': ...
        """
        mass = self.mass.real
        if (mass <= 0).any():
            raise ModelError(f"link {link!r}: the mass must be positive, got {mass.min():.6g} kg")
        # NumPy has eigenvalues in double precision only: enough to judge by.
        moments = np.linalg.eigvalsh(self.inertia_at_com.real.astype(np.float64)).reshape(-1, 3)
        a, b, c = moments.T
        not_positive = (a < -1e-9 * c) | (c <= 0)
        if not_positive.any():
            raise ModelError(
                f"link {link!r}: the inertia must be positive definite, got principal moments "
                f"{_numbers(moments[not_positive][0])} kg m²"
            )
        broken = c > (a + b) * (1 + 1e-9)
        if broken.any():
            a, b, c = moments[broken][0]
            raise ModelError(
                f"link {link!r}: the principal moments break the triangle inequality, {c:.6g} > {a:.6g} + {b:.6g} kg m²"
            )

    def __repr__(self) -> str:
        return (
            f"SpatialInertia(mass={self.mass.tolist()}, com={self.com.tolist()}, "
            f"inertia_at_com={self.inertia_at_com.tolist()})"
        )


def _numbers(x: Array) -> str:
    return ", ".join(f"{value:.6g}" for value in x)
