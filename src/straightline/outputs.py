"""Arrays of the caller to be filled: their validation, and the case that they share memory with an input.

As with NumPy's own functions, each result is as if all inputs were read before the first number is written: where an
array of the caller shares memory with an input, a new array is filled and copied at the end.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from math import prod
from typing import Any

import numpy as np

from .number import Array

__all__ = ["Tail", "check_outputs", "finish", "separate", "targets"]

WORK = 10_000  # effort of the search for a common byte of two arrays; after that they count as sharing memory

Tail = tuple[int, ...]


def check_outputs(
    given: Mapping[str, Any],
    batch: Tail,
    tails: Mapping[str, Tail],
    dtype: np.dtype[Any],
    misfit: type[ValueError] = ValueError,
) -> None:
    """Raise ValueError for arrays of the caller that are read-only or have overlapping entries, `misfit` for others.

    Those have another shape or number type than the result.
    """
    for name, out in given.items():
        shape = (*batch, *tails[name])
        if not (isinstance(out, np.ndarray) and out.shape == shape and out.dtype == dtype):
            got = f"{out.dtype} of shape {out.shape}" if isinstance(out, np.ndarray) else type(out).__name__
            raise misfit(f"out: expected for {name} an array of {dtype} of shape {shape}, got {got}")
        if not out.flags.writeable:
            raise ValueError(f"out: expected for {name} an array that can be written to, got a read-only one")
        if _overlaps_itself(out):
            said = f"got strides {out.strides} for shape {out.shape}"
            raise ValueError(f"out: expected for {name} an array with memory of its own for each entry, {said}")
    for (one, x), (other, y) in combinations(given.items(), 2):
        if _share(x, y):
            raise ValueError(f"out: expected separate arrays for {one} and {other}, got two that share memory")


def targets(
    given: Mapping[str, Array], states: Sequence[Array], count: int, tails: Mapping[str, Tail], dtype: np.dtype[Any]
) -> dict[str, Array]:
    """Return arrays of shape (count, entries) to be filled: the caller's where they can be, else new ones.

    They cannot where a state shares memory with them, or where the entries of a row do not lie next to each other.
    """
    filled = {}
    for name, tail in tails.items():
        own = _rows(given[name], count, prod(tail)) if name in given else None
        if own is None or any(_share(own, state) for state in states):
            own = np.empty((count, prod(tail)), dtype)
        filled[name] = own
    return filled


def finish(given: Mapping[str, Array], filled: Mapping[str, Array]) -> dict[str, Array]:
    """Return the results, in the caller's arrays where there are any."""
    for name, out in given.items():
        if not np.may_share_memory(out, filled[name]):
            out[...] = filled[name]
    return {**filled, **given}


def separate(arrays: Sequence[Array]) -> bool:
    """Return whether no two of these arrays may share memory, as far as is seen at once."""
    if all(x.flags.owndata for x in arrays):
        return len({*map(id, arrays)}) == len(arrays)
    return not any(np.may_share_memory(x, y) for x, y in combinations(arrays, 2))


def _rows(x: Array, count: int, size: int) -> Array | None:
    """Return a view of shape (count, size), the entries of each row next to each other; None if there is none."""
    try:
        rows = np.reshape(x, (count, size), copy=False)
    except ValueError:
        return None
    return rows if rows.strides[1] == rows.itemsize and rows.flags.aligned else None


def _share(x: Array, y: Array) -> bool:
    """Whether two arrays have a byte in common, or may have one and it takes long to find out."""
    try:
        return bool(np.shares_memory(x, y, max_work=WORK))  # type: ignore[arg-type]  # the stubs know no limit
    except np.exceptions.TooHardError:
        return True


def _overlaps_itself(x: Array) -> bool:
    """Whether an axis does not step over the extent of those with smaller steps: entries may share a byte then."""
    extent = x.itemsize
    for step, n in sorted((abs(step), n) for step, n in zip(x.strides, x.shape) if n > 1):
        if step < extent:
            return x.size > 0
        extent += step * (n - 1)
    return False
