"""Memory that a program computes in: of one state at known addresses, and the rows of a caller's arrays."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from ..arrays import Array
from .line import Line
from .llvm import MachineCode, table_of

__all__ = ["OneState", "Results", "rows"]


class Results(SimpleNamespace):
    """Several quantities, as attributes by their symbols."""

    def __repr__(self) -> str:
        return f"Results({', '.join(f'{name}: {np.shape(x)}' for name, x in vars(self).items())})"


class OneState:
    """Memory for one state, whose addresses are known.

    Parameters
    ----------
    code : MachineCode
    line : Line
    dtype : dtype
    single : bool
    """

    def __init__(self, code: MachineCode, line: Line, dtype: np.dtype[Any], single: bool) -> None:
        inputs = [np.empty(shape, dtype) for shape in line.inputs.values()]
        *outputs, self.alarm = [np.empty(shape, dtype) for shape, _ in line.outputs.values()]
        self.inputs = [(x, x.shape) for x in inputs]
        copies = {name: x.copy for name, x in zip(line.outputs, outputs)}
        self.results = outputs[0].copy if single else lambda: Results(**{name: copy() for name, copy in copies.items()})
        self._table = table_of([*inputs, *outputs, self.alarm])
        self.code, self.call, self.where = code, code.hold, code.address_of(self._table)  # the code lives as long


def rows(x: Array, count: int, size: int) -> Array:
    """Return an array of shape (count, size) to be filled: a view of x where there is one, else a new one."""
    try:
        rows = np.reshape(x, (count, size), copy=False)
    except ValueError:
        return np.empty((count, size), x.dtype)
    contiguous = rows.strides[1] == rows.itemsize and rows.flags.aligned
    return rows if contiguous else np.empty((count, size), x.dtype)
