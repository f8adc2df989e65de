"""Many states: cut into chunks that stay in the cache, with the states last in memory, on one core or several."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import DTypeLike

from ..checks import Array
from ..errors import ShapeError
from .plan import Plan

__all__ = ["empty", "fill", "given_or_empty"]

CACHED = 2**21
"""Bytes of the largest arrays in a chunk: a 3 × 3 matrix for every link and state. See benchmarks/README.md."""

KEPT = 2**25 - 2**16
"""Bytes, less than the 32 MiB up to which glibc learns; see `_keep_memory`."""

FEWEST = 256
"""States in a chunk at least: with fewer, the calls cost more than the arithmetic."""


def empty(batch: tuple[int, ...], tail: tuple[int, ...], dtype: DTypeLike) -> Array:
    """Return a new array of shape (*batch, *tail) in whose memory the states come last."""
    states_last = np.empty((*tail, *batch), dtype)
    return states_last.transpose(*range(len(tail), states_last.ndim), *range(len(tail)))


def given_or_empty(
    name: str, out: Array | None, batch: tuple[int, ...], tail: tuple[int, ...], dtype: np.dtype[Any]
) -> Array:
    """Return the array that the caller gives for a result, or a new one."""
    if out is None:
        return empty(batch, tail, dtype)
    if not isinstance(out, np.ndarray) or out.shape != (*batch, *tail) or out.dtype != dtype:
        came = f"{out.dtype} of shape {out.shape}" if isinstance(out, np.ndarray) else type(out).__name__
        raise ShapeError(f"{name}: expected an array of {dtype} of shape {(*batch, *tail)}, got {came}")
    return out


def fill(
    kernel: Callable[..., None],
    states: Sequence[Array],
    results: Sequence[Array],
    *,
    plan: Plan,
    workers: int,
    progress: bool,
) -> None:
    """Call ``kernel(*states, *results)`` for one chunk of states after the other, and fill the results.

    Parameters
    ----------
    kernel : callable
        Gets the arrays with the states as their last axis: those of the states contiguous, of the results views.
    states, results : sequence of ndarray
        With the batch axes first. The first of the states is q.
    plan : Plan
        Says what a state weighs.
    workers : int
        Number of threads. NumPy lets go of the interpreter's lock while it computes.
    progress : bool
        Show a bar on stderr.
    """
    if workers < 1:
        raise ValueError(f"workers: expected 1 or more, got {workers}")
    batch = states[0].shape[:-1]
    count = math.prod(batch)
    inputs = [_states_last(x.reshape(count, *x.shape[len(batch) :])) for x in states]
    flat = [_flat(x, batch, count) for x in results]
    outputs = [_states_last(x) for x in flat]
    size = max(FEWEST, CACHED // (9 * (1 + plan.n) * states[0].itemsize))

    def chunk(start: int) -> int:
        span = slice(start, min(start + size, count))
        kernel(*(np.ascontiguousarray(x[..., span]) for x in inputs), *(x[..., span] for x in outputs))
        return span.stop - start

    _keep_memory()
    starts = range(0, count, size)
    with _bar(count, progress) as advance:
        if min(workers, len(starts)) < 2:
            for start in starts:
                advance(chunk(start))
        else:
            with ThreadPoolExecutor(workers) as pool:
                for done in pool.map(chunk, starts):
                    advance(done)
    for x, result in zip(flat, results):
        if not np.may_share_memory(x, result):
            result[...] = x.reshape(result.shape)


def _keep_memory() -> None:
    """Have the C library keep the memory of arrays that are gone, and not hand it back to the kernel.

    glibc hands back what is above a limit, at first 128 KiB, and every page of it that is used again then costs a
    page fault: two thirds of all the time for 1000 states. The limit follows the largest block that was ever
    freed. So a block of the largest size that counts is taken and freed, without being touched. Elsewhere it has
    no effect.
    """
    np.empty(KEPT, np.uint8)


def _states_last(x: Array) -> Array:
    return x.transpose(*range(1, x.ndim), 0)


def _flat(x: Array, batch: tuple[int, ...], count: int) -> Array:
    """Return x with one batch axis: a view, or where there is none of that shape a new array."""
    tail = x.shape[len(batch) :]
    try:
        return np.reshape(x, (count, *tail), copy=False)
    except ValueError:
        return empty((count,), tail, x.dtype)


@contextmanager
def _bar(count: int, show: bool) -> Iterator[Callable[[int], object]]:
    if not show:
        yield lambda done: None
        return
    from tqdm import tqdm

    with tqdm(total=count, unit=" states") as bar:
        yield bar.update
