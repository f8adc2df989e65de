"""Calls of functions that may be wrong: on copies of their arguments, never endless, without a word."""

from __future__ import annotations

import copy
import io
import os
import signal
import sys
import threading
from _thread import interrupt_main
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from types import FrameType
from typing import Any

import numpy as np

from .compare import plain, unchanged, unwarned
from .exercise import Part

__all__ = [
    *("TooLong", "call_or_none", "cheapest_case", "copied", "interrupted", "keeps_arguments", "muted", "shown"),
    "value_of_reference",
]

Function = Callable[..., Any]

MAX_CPU_S = 1.0  # seconds of CPU time that one call of a changed function may take


class TooLong(BaseException):
    """Raised in a call that does not end; no `except Exception` of a student holds it."""

    def __init__(self, seconds: float = MAX_CPU_S) -> None:
        super().__init__()
        self.seconds = seconds


@contextmanager
def interrupted(seconds: float) -> Iterator[None]:
    """Interrupt a block that takes longer, as Ctrl-C does, in the main thread where there are others; 0 for never."""
    if not seconds or sys.platform == "emscripten" or threading.current_thread() is not threading.main_thread():
        yield
        return
    is_late, has_ended = threading.Event(), threading.Event()

    def watch() -> None:
        while not has_ended.wait(seconds):
            is_late.set()
            interrupt_main()

    ignored = signal.getsignal(signal.SIGINT) == signal.SIG_IGN  # so a shell starts what runs in the background
    if ignored:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Thread(target=watch, daemon=True).start()
    try:
        yield
    except KeyboardInterrupt as error:
        if is_late.is_set():
            raise TooLong(seconds).with_traceback(error.__traceback__) from None
        raise
    finally:
        has_ended.set()
        if ignored:
            signal.signal(signal.SIGINT, signal.SIG_IGN)


@contextmanager
def _limited(seconds: float) -> Iterator[None]:
    """Raise in a block that takes longer, in CPU seconds of this process, where the system counts them.

    Elsewhere only the rounds of loops are counted (`listing`); outside stands the process that runs the answers.
    """
    if not hasattr(signal, "setitimer") or threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(number: int, frame: FrameType | None) -> None:
        raise TooLong

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds, seconds)  # again, should something hold the first
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def call_or_none(part: Part, function: Function, arguments: tuple[Any, ...]) -> Any:
    """Return what a function that may be faulty gives; None where it raises an error or does not end."""
    return _called(part, function, copied(arguments))


def _called(part: Part, function: Function, given: tuple[Any, ...]) -> Any:
    try:
        with _limited(MAX_CPU_S), unwarned():
            return plain(part.value(function, given))
    except (Exception, SystemExit, TooLong):  # whatever a change leads to
        return None


def value_of_reference(part: Part, arguments: tuple[Any, ...]) -> Any:
    """Return the right answer, without a warning: that would show a line of the solution."""
    with unwarned():
        return part.value(part.solution, arguments)


def keeps_arguments(part: Part, function: Function, arguments: tuple[Any, ...]) -> bool:
    """Whether a function leaves its arguments as they are; yes where a part calls it in its own way."""
    given = copied(arguments)
    _called(part, function, given)
    return part.call is not None or all(map(unchanged, arguments, given))


def shown(error: BaseException) -> str:
    """Return an error as a message shows it; one of a student's own class may raise another where it is printed."""
    try:
        return f"{type(error).__name__}: {getattr(error, 'msg', error)}".removesuffix(": ")
    except Exception:
        return type(error).__name__


def copied(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the arguments with copies of the arrays and lists."""
    return tuple(copy.deepcopy(x) if isinstance(x, np.ndarray | list) else x for x in arguments)


def cheapest_case(cases: Mapping[int, tuple[Any, ...]]) -> int:
    """Return the case with the fewest numbers in it: it takes least time, and is the same in each run."""
    return min(cases, key=lambda k: _size(cases[k]))


def _size(x: Any) -> int:
    """Return how many numbers something holds; a model, as many as it has bodies."""
    if isinstance(x, list | tuple):
        return sum(map(_size, x))
    return int(getattr(x, "nbodies", np.size(x)))


@contextmanager
def muted() -> Iterator[None]:
    """Drop what functions print, and libraries past Python: a small change may give them what they complain about."""
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()), open(os.devnull, "w") as nothing:
        for stream in filter(None, (sys.__stdout__, sys.__stderr__)):
            stream.flush()
        kept = [(number, os.dup(number)) for number in (1, 2) if os.name == "posix"]
        for number, _ in kept:
            os.dup2(nothing.fileno(), number)
        try:
            yield
        finally:
            for number, copy_of_it in kept:
                os.dup2(copy_of_it, number)
                os.close(copy_of_it)
