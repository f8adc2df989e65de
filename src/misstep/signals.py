"""Work that nothing stops."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager, suppress

__all__ = ["without_interrupts"]

SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP", "SIGALRM")


@contextmanager
def without_interrupts() -> Iterator[None]:
    """Within: nothing stops the work, and processes that are started get no signal but SIGKILL, from their parent.

    A terminal sends Ctrl-C to all. And a process whose parent is stopped while it starts finds nothing to read.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {getattr(signal, name) for name in SIGNALS})
    try:
        yield
    finally:
        with suppress(ValueError):
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
