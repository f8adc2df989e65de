"""Bodies of uniform density: the constructors of `SpatialInertia` by shape (section 49.5).

A shape is known by the spread of its mass: the mean of x xᵀ about the centre, whose diagonal is the mean of x², y² and
z². Then I_c = m (tr(spread) 1 − spread): the moment about x adds up the mean of y² and that of z².
"""

from __future__ import annotations

from itertools import chain
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_finite, as_number_arrays, as_real, check_size, judged
from ..errors import ModelError, ShapeError
from ._elementary import at_first_index
from ._ten_numbers import TenNumbers

__all__ = ["Shapes"]


class Shapes(TenNumbers):
    """The constructors by shape. Every shape lies along the axes of its frame, a length along z, the centre at 0.

    `SpatialInertia.transform` puts it elsewhere. Lengths may be zero: a plate is a box without height.
    """

    __slots__ = ()

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
        share, total = volume / volume.sum(), corners.sum(axis=1)
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


def _positive(**named: tuple[ArrayLike, tuple[int, ...]]) -> tuple[Array, ...]:
    """Convert as `as_number_arrays`; raise ModelError where a number is negative."""
    arrays = as_number_arrays(**named)
    for name, x in zip(named, arrays):
        if x.dtype != object:
            check_size(x, name)
        wrong = judged(x) < 0
        if wrong.any():
            raise ModelError(
                f"{name}: expected no negative number, got {judged(x)[wrong][0]:.6g}{at_first_index(wrong)}"
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
