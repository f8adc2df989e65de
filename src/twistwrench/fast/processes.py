"""Several processes for many states.

Threads were tried first: two of them are no faster than one. NumPy does let go of the interpreter's lock while it
computes, but takes it back after every call, and with calls of some ten microseconds the two mostly wait for one
another. Processes share nothing but the arrays: these lie in memory that each of them maps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from multiprocessing.shared_memory import SharedMemory
from typing import Any, NamedTuple

import numpy as np

from ..checks import Array

__all__ = ["Shared", "executor", "spread"]

TASKS = 32
"""Parts that the states are cut into at most: so many that no process waits long for the last one."""


class Named(NamedTuple):
    """By which another process finds a `Shared` array."""

    name: str
    shape: tuple[int, ...]
    dtype: np.dtype[Any]


class Shared:
    """An array that other processes can open. Its memory goes when the last array on it goes.

    Parameters
    ----------
    shape : tuple of int
    dtype : data type

    Attributes
    ----------
    array : ndarray
    named : Named
    """

    def __init__(self, shape: tuple[int, ...], dtype: np.dtype[Any]) -> None:
        memory = SharedMemory(create=True, size=max(1, math.prod(shape) * dtype.itemsize))
        self.named = Named(memory.name, shape, dtype)
        self.array = np.asarray(_Owner(memory, self.named))
        self._memory = memory

    def unlink(self) -> None:
        """Let no other process open it any more."""
        self._memory.unlink()


class _Owner:
    """Keeps the memory while an array refers to it. A buffer would not do: it may not outlive its `SharedMemory`."""

    def __init__(self, memory: SharedMemory, named: Named) -> None:
        self._memory = memory
        start = np.ndarray((), np.uint8, buffer=memory.buf).ctypes.data
        self.__array_interface__ = {
            "version": 3,
            "data": (start, False),
            "shape": named.shape,
            "typestr": named.dtype.str,
        }


@contextmanager
def executor(workers: int | Executor) -> Iterator[Executor]:
    """Yield what runs the tasks: the caller's, or new processes for this one call.

    They are spawned, not forked: a fork copies locks of other threads in whatever state they are.
    """
    if isinstance(workers, Executor):
        yield workers
    else:
        with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
            yield pool


def spread(
    pool: Executor,
    work: Callable[[list[Array], list[Array]], None],
    states: Sequence[Array],
    shapes: Sequence[tuple[int, ...]],
    size: int,
    advance: Callable[[int], object],
) -> list[Array]:
    """Return results of these shapes, filled by ``work(states, results)`` in the processes of a pool.

    The states have shape (count, ...), the results (..., count); each task gets
    `size` of them, or more.
    """
    count, dtype = len(states[0]), states[0].dtype
    inputs, outputs = [Shared(x.shape, dtype) for x in states], [Shared(shape, dtype) for shape in shapes]
    for shared, x in zip(inputs, states):
        shared.array[...] = x
    edges = range(0, count, max(size, math.ceil(count / TASKS)))
    spans = [slice(start, min(start + edges.step, count)) for start in edges]
    named = [shared.named for shared in inputs], [shared.named for shared in outputs]
    futures = [pool.submit(_task, work, *named, span) for span in spans]
    try:
        for future in futures:
            advance(future.result())
    finally:
        for future in futures:
            future.cancel()
        for shared in (*inputs, *outputs):
            shared.unlink()
    return [shared.array for shared in outputs]


def _task(
    work: Callable[[list[Array], list[Array]], None], inputs: list[Named], outputs: list[Named], span: slice
) -> int:
    """Do one part, in another process."""
    arrays = [[np.asarray(_Owner(SharedMemory(x.name), x)) for x in named] for named in (inputs, outputs)]
    work([x[span] for x in arrays[0]], [x[..., span] for x in arrays[1]])
    done: int = span.stop - span.start
    return done
