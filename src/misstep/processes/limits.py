"""Limits of the process with the student's code: its memory, what it prints, the processes that it starts."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TextIO

__all__ = ["MEMORY", "contained"]

MEMORY = 4 << 30
"""Bytes that an answer may use on top; the largest of the references uses 0.1 GB."""

LARGEST_FILE = 100_000_000
"""Bytes of a file that an answer writes, where the system can limit them."""

PRINTED = 10_000
"""Characters that the answers of a folder may print, a line counted as 80 at least; an endless loop prints more."""


@contextmanager
def contained() -> Iterator[None]:
    """Limit the memory of this process and what it prints, and let a process that it forks end at once."""
    if hasattr(os, "register_at_fork"):
        os.register_at_fork(after_in_child=lambda: os._exit(0))
    _limit_memory_and_files()
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = (_Short(stream) for stream in before)
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before


def _limit_memory_and_files() -> None:
    """Let an array or a file that is too large raise an error in the student's line, where the system can do that."""
    if os.name != "posix":
        return
    import resource

    _, most = resource.getrlimit(resource.RLIMIT_FSIZE)
    wanted = LARGEST_FILE if most == resource.RLIM_INFINITY else min(LARGEST_FILE, most)
    resource.setrlimit(resource.RLIMIT_FSIZE, (wanted, most))
    if sys.platform != "linux":
        return
    with open("/proc/self/statm", encoding="ascii") as file:
        used = int(file.read().split()[0]) * resource.getpagesize()
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    wanted = used + MEMORY
    resource.setrlimit(resource.RLIMIT_AS, (wanted if most == resource.RLIM_INFINITY else min(wanted, most), most))


class _Short:
    """A stream that drops what is too much."""

    def __init__(self, stream: TextIO) -> None:
        self._stream, self._left = stream, PRINTED

    def write(self, text: str) -> int:
        """Write it, as far as there is room."""
        before, self._left = self._left, self._left - len(text) - 80 * text.count("\n")
        if before > 0:
            self._stream.write(text[:before])
            if self._left <= 0:
                self._stream.write("\n[...]\n")
        return len(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)
