"""Many states: cut into chunks that stay in the cache, with the states last in memory, on one core or several."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import DTypeLike

from ..checks import Array
from ..errors import ShapeError
from .plan import Plan
from .processes import executor, spread

__all__ = ["Tail", "check_fits", "check_workers", "empty", "fill"]

CACHED = 2**21
"""Bytes of the largest arrays in a chunk: a 3 × 3 matrix for every link and state. See benchmarks/README.md."""

FEWEST = 256
"""States in a chunk at least: with fewer, the calls cost more than the arithmetic."""

KEPT = 2**25 - 2**16
"""Bytes, a little less than the 32 MiB up to which glibc learns: see `keep_memory`."""

Tail = tuple[int, ...]


def empty(batch: Tail, tail: Tail, dtype: DTypeLike) -> Array:
    """Return a new array of shape (*batch, *tail) in whose memory the states come last."""
    return _batch_first(np.empty((*tail, *batch), dtype), len(tail))


def fill(
    kernel: Callable[..., None],
    states: Sequence[Array],
    tails: Mapping[str, Tail],
    plan: Plan,
    given: Mapping[str, Array],
    workers: int | Executor,
    progress: bool,
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
        Says what a state weighs.
    given : mapping of str to ndarray
        Arrays of the caller for some of the results.
    workers : int or Executor
        Number of processes, or what runs them.
    progress : bool
        Show a bar on stderr.
    """
    batch, dtype = states[0].shape[:-1], states[0].dtype
    check_workers(workers)
    given = {name: x for name, x in given.items() if name in tails}
    check_fits(given, batch, tails, dtype)
    count = math.prod(batch)
    size = max(FEWEST, CACHED // (9 * (1 + plan.n) * dtype.itemsize))
    work = partial(_in_chunks, kernel, size)
    flat = [x.reshape(count, *x.shape[len(batch) :]) for x in states]
    with _bar(count, progress) as advance:
        columns = [_columns(given.get(name), tail, count, dtype) for name, tail in tails.items()]
        if workers == 1 or count < 2:
            work(flat, columns, advance)
        else:
            with executor(workers) as pool:
                spread(pool, work, flat, columns, size, advance)
    results = {}
    for (name, tail), column in zip(tails.items(), columns):
        results[name] = given.get(name, _batch_first(column.reshape(*tail, *batch), len(tail)))
        if name in given and not np.may_share_memory(column, given[name]):
            given[name][...] = _batch_first(column.reshape(*tail, *batch), len(tail))
    return results


def _in_chunks(
    kernel: Callable[..., None],
    size: int,
    states: Sequence[Array],
    results: Sequence[Array],
    advance: Callable[[int], object] = int,
) -> None:
    """Fill results of shape (..., count) from states of shape (count, ...)."""
    count = len(states[0])
    keep_memory()
    for start in range(0, count, size):
        span = slice(start, min(start + size, count))
        kernel(*(np.ascontiguousarray(_states_last(x[span])) for x in states), *(x[..., span] for x in results))
        advance(span.stop - start)


def _columns(given: Array | None, tail: Tail, count: int, dtype: np.dtype[Any]) -> Array:
    """Return an array of shape (*tail, count): a view of the caller's if there is one, else a new one."""
    if given is not None:
        try:
            return _states_last(np.reshape(given, (count, *tail), copy=False))
        except ValueError:  # no view of that shape
            pass
    return np.empty((*tail, count), dtype)


def _states_last(x: Array) -> Array:
    return x.transpose(*range(1, x.ndim), 0)


def _batch_first(x: Array, tail: int) -> Array:
    return x.transpose(*range(tail, x.ndim), *range(tail))


def check_workers(workers: int | Executor) -> None:
    """Refuse less than one."""
    if not isinstance(workers, Executor) and not (isinstance(workers, int | np.integer) and workers >= 1):
        raise ValueError(f"workers: expected 1 or more, or an Executor, got {workers!r}")


def check_fits(given: Mapping[str, object], batch: Tail, tails: Mapping[str, Tail], dtype: np.dtype[Any]) -> None:
    """Refuse arrays of the caller that are not what is to be filled."""
    for name, out in given.items():
        shape = (*batch, *tails[name]) if name in tails else None
        if shape is None or (isinstance(out, np.ndarray) and out.shape == shape and out.dtype == dtype):
            continue
        came = f"{out.dtype} of shape {out.shape}" if isinstance(out, np.ndarray) else type(out).__name__
        raise ShapeError(f"out: expected for {name} an array of {dtype} of shape {shape}, got {came}")


@cache
def keep_memory() -> None:
    """Have the C library keep the memory of arrays that are gone, and not hand it back to the kernel.

    glibc hands back what is above a limit, at first 128 KiB, and every page of it that is used again then costs a
    page fault: two thirds of the time of 1000 states. The limit follows the largest block that was ever freed. So
    a block of the largest size that counts is taken and freed, untouched; once, as the limit never falls. Elsewhere
    this does nothing.
    """
    np.empty(KEPT, np.uint8)


@contextmanager
def _bar(count: int, show: bool) -> Iterator[Callable[[int], object]]:
    if not show:
        yield int
        return
    from tqdm import tqdm

    with tqdm(total=count, unit=" states") as bar:
        yield bar.update
