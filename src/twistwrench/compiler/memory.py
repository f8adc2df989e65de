"""What a program returns, memory that is used again, and no search for garbage."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from types import SimpleNamespace

import numpy as np

__all__ = ["Results", "keep_memory", "without_garbage"]

KEPT = 2**25 - 2**16
"""Bytes, a little less than the 32 MiB up to which glibc learns: see `keep_memory`."""


class Results(SimpleNamespace):
    """Several quantities, as attributes by their symbols."""

    def __repr__(self) -> str:
        return f"Results({', '.join(f'{name}: {np.shape(x)}' for name, x in vars(self).items())})"


@cache
def keep_memory() -> None:
    """Let the C library keep the memory of freed arrays instead of returning it to the kernel.

    glibc returns blocks above a limit, at first 128 KiB, and every page of it that is used again then costs a page
    fault: most of the time of 1000 states. The limit follows the largest block that was ever freed. So a large block is
    allocated and freed, untouched; once, as the limit never falls. Elsewhere this does nothing.
    """
    np.empty(KEPT, np.uint8)


@contextmanager
def without_garbage() -> Iterator[None]:
    """Let Python not look for garbage meanwhile: it looks through all operations again and again, a fifth of the time.

    Used where thousands of them are made, none of which is garbage.
    """
    before = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if before:
            gc.enable()
