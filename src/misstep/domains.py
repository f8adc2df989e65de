"""What an argument may be: how it varies at the limits of a formula, and which simple values it has."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from .compare import Array

__all__ = ["Domain", "Matrix", "Rotation", "Vector", "rotation"]


class Domain:
    """An argument that is left as it is drawn. Each method returns the value itself where there is nothing to vary."""

    def turned(self, value: Any, turn: Array) -> Any:
        """Return the argument with another orientation, a quaternion (x, y, z, w)."""
        return value

    def scaled(self, value: Any, factor: float) -> Any:
        """Return the argument with another size."""
        return value

    def simple(self, value: Any) -> Iterator[Any]:
        """Yield simple values of this argument, for cases in which the others are as they are drawn."""
        yield from ()

    def whole(self, value: Any, largest: int) -> Any:
        """Return the argument in whole numbers."""
        return value


class Vector(Domain):
    """A number, a vector, an array of vectors or a list of them, of any size."""

    def scaled(self, value: Any, factor: float) -> Any:
        """Multiply it."""
        return [factor * x for x in value] if isinstance(value, list) else factor * value

    def simple(self, value: Any) -> Iterator[Any]:
        """Yield it with zeros in every other place, with a half of six numbers zero, and zero."""
        if isinstance(value, np.ndarray) and value.ndim and value.dtype.kind == "f":
            for part in (slice(1, None, 2), *((slice(0, 3), slice(3, 6)) if value.shape == (6,) else ())):
                new = value.copy()
                new[part] = 0
                yield new
        elif isinstance(value, list) and len(value) > 2:
            yield [0 * x if k % 2 else x for k, x in enumerate(value)]
        yield self.scaled(value, 0.0)

    def whole(self, value: Any, largest: int) -> Any:
        """Round it, the largest entry to a given number."""
        if isinstance(value, list):
            new = [self.whole(x, largest) for x in value]
            return new if any(a is not b for a, b in zip(new, value)) else value
        if isinstance(value, float):
            return round(value) or 1
        return rounded(value, largest)


class Matrix(Domain):
    """A matrix whose size is not varied, but whose entries may be whole numbers."""

    def whole(self, value: Any, largest: int) -> Any:
        """Round it, the largest entry to a given number."""
        return rounded(value, largest)


class Rotation(Domain):
    """A rotation matrix, 3 × 3."""

    def turned(self, value: Any, turn: Array) -> Any:
        """Return the rotation of a quaternion."""
        return rotation(turn) if getattr(value, "shape", ()) == (3, 3) else value

    def simple(self, value: Any) -> Iterator[Any]:
        """Yield the one that turns nothing."""
        yield self.turned(value, np.array([0.0, 0, 0, 1]))

    def whole(self, value: Any, largest: int) -> Any:
        """Return a quarter turn."""
        quarter = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
        return quarter if getattr(value, "shape", ()) == (3, 3) else value


def rounded(value: Any, largest: int) -> Any:
    """Return an array of floats in whole numbers, the largest of them given; anything else as it is."""
    if not isinstance(value, np.ndarray) or value.dtype.kind != "f" or not value.any():
        return value
    return np.rint(largest * value / np.abs(value).max()).astype(int)


def rotation(turn: Any) -> Array:
    """Return the rotation matrix of a quaternion (x, y, z, w).

    Examples
    --------
    >>> rotation([0, 0, 1, 0])
    array([[-1.,  0.,  0.],
           [ 0., -1.,  0.],
           [ 0.,  0.,  1.]])
    """
    (x, y, z), w = turn[:3], turn[3]
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]], float)
    found: Array = np.eye(3) + 2 * w * cross + 2 * cross @ cross
    return found
