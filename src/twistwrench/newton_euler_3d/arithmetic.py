"""The number type of a call, and the operations that depend on it (49.1).

The formulas of this package are sums and products, the same for every kind of number.
Four operations differ: a constant of the model must first *become* such a number, and sine, cosine and
square root belong to it. `Arithmetic` holds those four; nothing else here knows whether it computes
in double precision or in fifty digits.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, resolution
from ..errors import ModelError

__all__ = ["Arithmetic", "as_mpmath"]


def as_mpmath(x: ArrayLike) -> Array:
    """Turn doubles into mpmath numbers of the same value, exactly.

    Parameters
    ----------
    x : array_like
        Of any shape, finite.

    Returns
    -------
    ndarray of mpmath.mpf or mpmath.mpc
        Of the same shape. The number of digits of what is computed from it is ``mpmath.mp.dps``.

    Raises
    ------
    ValueError
        If an entry is not a finite number.

    Examples
    --------
    The double nearest to 0.1, exactly:

    >>> import mpmath
    >>> with mpmath.workdps(25):
    ...     print(as_mpmath([0.1])[0])
    0.1000000000000000055511151
    """
    from mpmath import mp

    try:
        given = np.asarray(x)
        return Arithmetic(np.dtype(object), mp).array(given if given.dtype == object else as_array(x, "x"))
    except (TypeError, ValueError) as error:
        said = str(error)
        raise ValueError(said if said.startswith("x: ") else f"x: expected numbers, got {x!r}") from None


@dataclass(frozen=True)
class Arithmetic:
    """One kind of number: NumPy's (`context` is None), or mpmath's with its `context`.

    An mpmath number carries its context with it, and the context carries the functions and the
    number of digits: so mpmath need not be imported to compute with it.
    """

    dtype: np.dtype[Any]
    context: Any = None
    exact: ClassVar[bool] = False

    @property
    def eps(self) -> Any:
        """Spacing of the numbers next to 1."""
        return resolution(self.dtype) if self.context is None else self.context.eps

    def array(self, values: ArrayLike) -> Array:
        """Turn constants into these numbers. Done first, so that no arithmetic is done in doubles."""
        if self.context is None:
            return np.array(values, self.dtype)
        return np.asarray(np.frompyfunc(self.context.convert, 1, 1)(values), object)

    def zeros(self, *shape: int) -> Array:
        """Return zeros."""
        return self.array(np.zeros(shape))

    def identity(self) -> Array:
        """Return the 3×3 unit matrix."""
        return self.array(np.eye(3))

    def cos(self, x: Any) -> Any:
        """Return the cosine of one number."""
        return np.cos(x) if self.context is None else self.context.cos(x)

    def sin(self, x: Any) -> Any:
        """Return the sine of one number."""
        return np.sin(x) if self.context is None else self.context.sin(x)

    def sqrt(self, x: Any) -> Any:
        """Return the square root of one number."""
        return np.sqrt(x) if self.context is None else self.context.sqrt(x)

    def unit(self, x: ArrayLike) -> Array:
        """Divide a vector by its length, so that it has length 1 to the last digit.

        Examples
        --------
        >>> Arithmetic(np.dtype(np.float64)).unit([3, 0, 4])
        array([0.6, 0. , 0.8])
        """
        given = self.array(x)
        scaled = given / abs(given).max()  # its square below neither overflows nor vanishes
        unit: Array = scaled / self.sqrt((scaled * scaled).sum())
        return unit

    def nothing(self, x: Any, least: Any) -> bool:
        """Return whether a number is zero to rounding."""
        return bool(abs(x) <= least)

    def quaternion(self, xyzw: Array) -> Array:
        """Return the turn by a quaternion of length 1."""
        x, y, z, w = xyzw
        return np.array(
            [
                [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
            ]
        )

    def rotation(self, R: ArrayLike, whose: str) -> Array:
        """Make a matrix that is a rotation to double precision one to the last digit.

        Newton's step R ← R (3·1 − RᵀR) / 2 doubles the number of digits to which RᵀR is 1. It is
        repeated until rounding leaves nothing to gain.

        Raises
        ------
        ModelError
            If `R` is not a rotation to start with.
        """
        rotation, one = self.array(R), self.identity()
        defect = abs(rotation.mT @ rotation - one).max()
        if not defect < 1e-3:
            raise ModelError(f"{whose}: its placement is not a rotation, RᵀR is off 1 by {float(defect):.3g}")
        while True:
            nearer = rotation @ (3 * one - rotation.mT @ rotation) / 2
            left = abs(nearer.mT @ nearer - one).max()
            if not left < defect:
                return rotation
            rotation, defect = nearer, left
