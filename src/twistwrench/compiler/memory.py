"""What a program returns, and the rows of a caller's arrays."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from ..arrays import Array

__all__ = ["Results", "rows"]


class Results(SimpleNamespace):
    """Several quantities, as attributes by their symbols."""

    def __repr__(self) -> str:
        return f"Results({', '.join(f'{name}: {np.shape(x)}' for name, x in vars(self).items())})"


def rows(x: Array, count: int, size: int) -> Array:
    """Return an array of shape (count, size) to be filled: a view of x where there is one, else a new one."""
    try:
        rows = np.reshape(x, (count, size), copy=False)
    except ValueError:
        return np.empty((count, size), x.dtype)
    contiguous = rows.strides[1] == rows.itemsize and rows.flags.aligned
    return rows if contiguous else np.empty((count, size), x.dtype)
