"""How a command is stopped: Ctrl-C, SIGTERM, a terminal that is closed, and a pipe whose reader has closed it."""

from __future__ import annotations

import os
import signal
import stat
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from misstep.signals import without_interrupts

__all__ = ["EXIT_SIGINT", "EXIT_SIGPIPE", "Stopped", "handle_signals", "without_interrupts"]

EXIT_SIGINT, EXIT_SIGPIPE = 130, 141
"""Exit statuses, as a shell reports them: 128 and the number of the signal, SIGINT or SIGPIPE."""

SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")
DEFAULT_HANDLERS = (signal.SIG_DFL, signal.default_int_handler)
POLL_MS = 300
RERAISE_S = 0.4
"""Seconds until an exception that was swallowed is raised again."""


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
def handle_signals() -> Iterator[None]:
    """Let Ctrl-C, SIGTERM, SIGHUP and a closed pipe on stdout end the work, with its cleanup, by raising `Stopped`.

    The exception is raised wherever the main thread is, and libraries may swallow it there: C code that calls Python
    for a number, a bare ``except``. It is raised again until it gets through. Does nothing outside the main thread, nor
    for a signal that has another handler.
    """
    unread, done = threading.Event(), threading.Event()
    timer = hasattr(signal, "setitimer")

    def stop(*received: Any) -> None:
        if unread.is_set() and _is_tidied():
            return  # printing has failed on the closed pipe, too
        stopped = Stopped(EXIT_SIGPIPE if unread.is_set() else 128 + received[0])
        if timer and signal.getsignal(signal.SIGALRM) is signal.SIG_DFL:
            before[signal.SIGALRM] = signal.signal(signal.SIGALRM, lambda *_: _again(stopped))
            signal.setitimer(signal.ITIMER_REAL, RERAISE_S, RERAISE_S)
        raise stopped

    before: dict[int, Any] = {}
    if threading.current_thread() is threading.main_thread():
        known = [number for name in SIGNALS if (number := getattr(signal, name, None)) is not None]
        before = {number: signal.getsignal(number) for number in known if signal.getsignal(number) in DEFAULT_HANDLERS}
    for number in list(before):
        signal.signal(number, stop)
    if signal.SIGTERM in before and _is_pipe(sys.stdout):
        threading.Thread(target=_watch, args=(sys.stdout.fileno(), unread, done), daemon=True).start()
    try:
        yield
    finally:
        done.set()
        if timer and signal.SIGALRM in before:
            signal.setitimer(signal.ITIMER_REAL, 0)
        for number, handler in before.items():
            signal.signal(number, handler)


def _again(stopped: Stopped) -> None:
    """Raise an exception again that has been swallowed; not while its cleanup runs."""
    if not _is_tidied():
        raise stopped


def _is_tidied() -> bool:
    """Whether the main thread is in the cleanup of an exception, in a ``finally`` or the like."""
    return isinstance(sys.exc_info()[1], KeyboardInterrupt | BrokenPipeError | GeneratorExit)


def _is_pipe(stream: Any) -> bool:
    """Whether a stream is a pipe on which a closed reading end can be detected."""
    try:
        return hasattr(signal, "pthread_kill") and stat.S_ISFIFO(os.fstat(stream.fileno()).st_mode)
    except (AttributeError, OSError, ValueError):
        return False


def _watch(fd: int, unread: threading.Event, done: threading.Event) -> None:
    """Stop the main thread when the reading end of a pipe is closed, even while nothing is being printed."""
    import select

    waiting = select.poll()
    waiting.register(fd, 0)
    while not done.is_set():
        if any(event & (select.POLLERR | select.POLLHUP | select.POLLNVAL) for _, event in waiting.poll(POLL_MS)):
            if not done.is_set():
                unread.set()
                signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGTERM)
            return
