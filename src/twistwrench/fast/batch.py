"""Many states: cut into chunks that stay in the cache, with the states last in memory."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import cache

import numpy as np

from ..arrays import Array
from .outputs import Tail, batch_first, check_outputs, finish, targets
from .plan import Plan

__all__ = ["fill"]

CACHED = 2**21
"""Bytes of the largest arrays in a chunk: a 3 × 3 matrix for every link and state. See benchmarks/README.md."""

FEWEST = 256
"""States in a chunk at least: with fewer, the calls cost more than the arithmetic."""

KEPT = 2**25 - 2**16
"""Bytes, a little less than the 32 MiB up to which glibc learns: see `keep_memory`."""


def fill(
    kernel: Callable[..., None],
    states: Sequence[Array],
    tails: Mapping[str, Tail],
    plan: Plan,
    given: Mapping[str, Array],
) -> dict[str, Array]:
    """Call ``kernel(*states, *results)`` for one chunk of states after the other; return the results by name.

    Parameters
    ----------
    kernel : callable
        Gets the arrays with the states as their last axis: those of the states contiguous, of the results views.
    states : sequence of ndarray
        With the batch axes first. The first of them is q.
    tails : mapping of str to tuple of int
        The last axes of each result.
    plan : Plan
        Gives the memory that a state takes.
    given : mapping of str to ndarray
        Arrays of the caller for some of the results.
    """
    batch, dtype = states[0].shape[:-1], states[0].dtype
    given = {name: x for name, x in given.items() if name in tails}
    check_outputs(given, batch, tails, dtype)
    count, filled = math.prod(batch), targets(given, states, tails, dtype)
    size = max(FEWEST, CACHED // (9 * (1 + plan.n) * dtype.itemsize))
    flat = [x.reshape(count, *x.shape[len(batch) :]) for x in states]
    columns = [_columns(filled[name], tail, count) for name, tail in tails.items()]
    keep_memory()
    for start in range(0, count, size):
        span = slice(start, min(start + size, count))
        chunk = [np.ascontiguousarray(_states_last(x[span])) for x in flat]
        kernel(*chunk, *(x[..., span] for x in columns))
    for (name, tail), column in zip(tails.items(), columns):
        if not np.may_share_memory(column, filled[name]):
            filled[name][...] = batch_first(column.reshape(*tail, *batch), len(tail))
    return finish(given, filled)


def _columns(x: Array, tail: Tail, count: int) -> Array:
    """Return an array of shape (*tail, count) to be filled: a view of x where there is one, else a new one."""
    try:
        return _states_last(np.reshape(x, (count, *tail), copy=False))
    except ValueError:  # no view of that shape
        return np.empty((*tail, count), x.dtype)


def _states_last(x: Array) -> Array:
    return x.transpose(*range(1, x.ndim), 0)


@cache
def keep_memory() -> None:
    """Let the C library keep the memory of freed arrays instead of returning it to the kernel.

    glibc returns blocks above a limit, at first 128 KiB, and every page of it that is used again then costs a
    page fault: two thirds of the time of 1000 states. The limit follows the largest block that was ever freed. So
    a block of the largest relevant size is allocated and freed, untouched; once, as the limit never falls. Elsewhere
    this does nothing.
    """
    np.empty(KEPT, np.uint8)
