"""Arrays of the caller to be filled: their validation, and the case that they share memory with an input.

As NumPy's own functions do, each result is what it would be if all inputs were read before the first number is
written. Where an array of the caller shares memory with an input, a new array is filled and copied at the end.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

import numpy as np

from ..arrays import Array
from ..errors import ShapeError

__all__ = ["Tail", "check_outputs", "finish", "targets"]

WORK = 10_000
"""Effort of the search for a common byte of two arrays; after that they count as sharing memory."""

Tail = tuple[int, ...]


def check_outputs(given: Mapping[str, Any], batch: Tail, tails: Mapping[str, Tail], dtype: np.dtype[Any]) -> None:
    """Raise ValueError for arrays of the caller that do not fit, are read-only, or have overlapping entries."""
    for name, out in given.items():
        shape = (*batch, *tails[name])
        if not (isinstance(out, np.ndarray) and out.shape == shape and out.dtype == dtype):
            got = f"{out.dtype} of shape {out.shape}" if isinstance(out, np.ndarray) else type(out).__name__
            raise ShapeError(f"out: expected for {name} an array of {dtype} of shape {shape}, got {got}")
        if not out.flags.writeable:
            raise ValueError(f"out: expected for {name} an array that can be written to, got a read-only one")
        if _overlaps_itself(out):
            said = f"got strides {out.strides} for shape {out.shape}"
            raise ValueError(f"out: expected for {name} an array with memory of its own for each entry, {said}")
    for (one, x), (other, y) in combinations(given.items(), 2):
        if _share(x, y):
            raise ValueError(f"out: expected separate arrays for {one} and {other}, got two that share memory")


def targets(
    given: Mapping[str, Array], states: Sequence[Array], batch: Tail, tails: Mapping[str, Tail], dtype: np.dtype[Any]
) -> dict[str, Array]:
    """Return the arrays to be filled: the caller's where no state shares memory with it, else new ones."""
    own = {name: x for name, x in given.items() if not any(_share(x, state) for state in states)}
    return {name: own[name] if name in own else np.empty((*batch, *tail), dtype) for name, tail in tails.items()}


def finish(given: Mapping[str, Array], filled: Mapping[str, Array]) -> dict[str, Array]:
    """Return the results, in the caller's arrays where there are any."""
    for name, out in given.items():
        if out is not filled[name]:
            out[...] = filled[name]
    return {**filled, **given}


def _share(x: Array, y: Array) -> bool:
    """Whether two arrays have a byte in common, or may have one and it takes long to find out."""
    try:
        return bool(np.shares_memory(x, y, max_work=WORK))  # type: ignore[arg-type]  # the stubs know no limit
    except np.exceptions.TooHardError:
        return True


def _overlaps_itself(x: Array) -> bool:
    """Whether two entries of an array share a byte, as in a view with a stride of 0."""
    steps = sorted((abs(step), n) for step, n in zip(x.strides, x.shape) if n > 1)
    if x.size == 0 or _nested(steps, x.itemsize):
        return False
    first = np.zeros(1, np.intp)  # byte of each entry
    for step, n in steps:
        first = (first[:, None] + step * np.arange(n)).reshape(-1)
    return bool((np.diff(np.sort(first)) < x.itemsize).any())


def _nested(steps: Sequence[tuple[int, int]], size: int) -> bool:
    """Whether each axis steps over the extent of all axes with smaller steps: then no entries overlap."""
    for step, n in steps:
        if step < size:
            return False
        size += step * (n - 1)
    return True
