"""How a command is stopped: Ctrl-C, SIGTERM, a terminal that is closed, and a reader who has seen enough."""

from __future__ import annotations

import os
import signal
import stat
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

__all__ = ["INTERRUPTED", "UNREAD", "Stopped", "heeded", "without_interrupts"]

INTERRUPTED, UNREAD = 130, 141
"""Exit statuses, as a shell reports them: 128 and the number of the signal, SIGINT or SIGPIPE."""

SIGNALS = ("SIGTERM", "SIGHUP")
POLL_MS = 300


class Stopped(KeyboardInterrupt):
    """The command is to end, as by Ctrl-C.

    Parameters
    ----------
    status : int
        The exit status.
    """

    def __init__(self, status: int) -> None:
        super().__init__()
        self.status = status


@contextmanager
def heeded() -> Iterator[None]:
    """Let SIGTERM, SIGHUP and a closed pipe behind stdout end the work by raising `Stopped`, so that it is tidied up.

    Does nothing outside the main thread, and leaves a signal alone that somebody else has a use for.
    """
    unread, done = threading.Event(), threading.Event()

    def stop(*received: Any) -> None:
        raise Stopped(UNREAD if unread.is_set() else 128 + received[0])

    ours: list[int] = []
    if threading.current_thread() is threading.main_thread():
        ours = [number for name in SIGNALS if (number := getattr(signal, name, None)) is not None]
        ours = [number for number in ours if signal.getsignal(number) is signal.SIG_DFL]
    for number in ours:
        signal.signal(number, stop)
    if signal.SIGTERM in ours and _is_pipe(sys.stdout):
        threading.Thread(target=_watch, args=(sys.stdout.fileno(), unread, done), daemon=True).start()
    try:
        yield
    finally:
        done.set()
        for number in ours:
            signal.signal(number, signal.SIG_DFL)


def _is_pipe(stream: Any) -> bool:
    """Whether a stream is a pipe whose reader can be seen to leave."""
    try:
        return hasattr(signal, "pthread_kill") and stat.S_ISFIFO(os.fstat(stream.fileno()).st_mode)
    except (AttributeError, OSError, ValueError):
        return False


def _watch(fd: int, unread: threading.Event, done: threading.Event) -> None:
    """Stop the main thread when the reader of a pipe has gone, even while nothing is being printed."""
    import select

    waiting = select.poll()
    waiting.register(fd, 0)
    while not done.is_set():
        if any(event & (select.POLLERR | select.POLLHUP | select.POLLNVAL) for _, event in waiting.poll(POLL_MS)):
            if not done.is_set():
                unread.set()
                signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGTERM)
            return


@contextmanager
def without_interrupts() -> Iterator[None]:
    """Hold Ctrl-C back for a moment. Processes that are started meanwhile never get it: their parent stops them."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        with suppress(ValueError):
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
