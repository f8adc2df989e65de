"""Several processes for very many states.

Threads were tried first: two of them are hardly faster than one. NumPy does let go of the interpreter's lock while it
computes, but takes it back after every call, and with calls of some ten microseconds the two mostly wait for one
another. Processes share nothing but a few slots of memory, each with room for a chunk of states and of results:

    this process  ── states ──▶  slot  ──▶  a worker computes  ──▶  slot  ── results ──▶  this process

The slots are used again and again. To let the workers write into the results themselves was slower: the first use of
a page of shared memory costs as much as what is computed into it.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from functools import lru_cache
from multiprocessing import get_context
from multiprocessing.shared_memory import SharedMemory
from typing import Any, NamedTuple

import numpy as np

from ..checks import Array

__all__ = ["executor", "spread"]

REMEMBERED = 16
"""Slots that a worker keeps open."""

Work = Callable[[list[Array], list[Array]], None]


class Layout(NamedTuple):
    """What a slot holds, one array after the other.

    Attributes
    ----------
    states, results : list of tuple of int
        Shapes (size, ...) and (..., size).
    dtype : data type
    """

    states: list[tuple[int, ...]]
    results: list[tuple[int, ...]]
    dtype: np.dtype[Any]

    @property
    def nbytes(self) -> int:
        """What a slot needs, with at least something."""
        return max(1, sum(math.prod(shape) for shape in (*self.states, *self.results)) * self.dtype.itemsize)

    def arrays(self, memory: SharedMemory) -> tuple[list[Array], list[Array]]:
        """Return the arrays in a slot, states and results."""
        flat, start, out = np.asarray(_Memory(memory, self)), 0, []
        for shape in (*self.states, *self.results):
            out.append(flat[start : start + math.prod(shape)].reshape(shape))
            start += math.prod(shape)
        return out[: len(self.states)], out[len(self.states) :]


class _Memory:
    """Keeps shared memory while an array refers to it: as a mere buffer it would have to be closed after the array."""

    def __init__(self, memory: SharedMemory, layout: Layout) -> None:
        self._memory = memory
        self.__array_interface__ = {
            "version": 3,
            "data": (np.ndarray((), np.uint8, buffer=memory.buf).ctypes.data, False),
            "shape": (layout.nbytes // layout.dtype.itemsize,),
            "typestr": layout.dtype.str,
        }


@contextmanager
def executor(workers: int | Executor) -> Iterator[Executor]:
    """Yield what runs the tasks: the caller's, or processes for this one call.

    They are spawned, not forked: a fork copies locks of other threads in whatever state they are.
    """
    if isinstance(workers, Executor):
        yield workers
    else:
        with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
            yield pool


def spread(
    pool: Executor,
    work: Work,
    states: Sequence[Array],
    results: Sequence[Array],
    size: int,
    advance: Callable[[int], object],
) -> None:
    """Fill results, shape (..., count), with ``work(states, results)`` on parts of the states, shape (count, ...).

    `size` is that of a chunk.
    """
    count = len(states[0])
    starts = range(0, count, size)
    layout = Layout([(size, *x.shape[1:]) for x in states], [(*x.shape[:-1], size) for x in results], states[0].dtype)
    workers = getattr(pool, "_max_workers", None) or os.cpu_count() or 1
    slots = [SharedMemory(create=True, size=layout.nbytes) for _ in range(min(2 * workers, len(starts)))]
    arrays = {slot.name: layout.arrays(slot) for slot in slots}
    free, running = list(arrays), dict[Future[None], tuple[str, slice]]()
    try:
        for start in starts:
            if not free:
                _collect(running, free, arrays, results, advance)
            name, span = free.pop(), slice(start, min(start + size, count))
            for slot, x in zip(arrays[name][0], states):
                slot[: span.stop - start] = x[span]
            running[pool.submit(_task, work, name, layout, span.stop - start)] = name, span
        while running:
            _collect(running, free, arrays, results, advance)
    finally:
        for future in running:
            future.cancel()
        wait(running)
        for memory in slots:
            memory.unlink()


def _collect(
    running: dict[Future[None], tuple[str, slice]],
    free: list[str],
    arrays: dict[str, tuple[list[Array], list[Array]]],
    results: Sequence[Array],
    advance: Callable[[int], object],
) -> None:
    """Take over the results of what is done, and free its slots."""
    for future in wait(running, return_when=FIRST_COMPLETED).done:
        future.result()
        name, span = running.pop(future)
        for result, slot in zip(results, arrays[name][1]):
            result[..., span] = slot[..., : span.stop - span.start]
        free.append(name)
        advance(span.stop - span.start)


def _task(work: Work, name: str, layout: Layout, count: int) -> None:
    """Do the first states of a slot, in a worker."""
    memory = _opened(name)
    states, results = layout.arrays(memory)
    work([x[:count] for x in states], [x[..., :count] for x in results])


@lru_cache(maxsize=REMEMBERED)
def _opened(name: str) -> SharedMemory:
    """Open a slot, or remember it: to open it again would cost the use of every page of it."""
    return SharedMemory(name=name)
