"""Calls of functions that may be wrong: on copies of their arguments, never endless, without a word."""

from __future__ import annotations

import copy
import io
import os
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from types import FrameType
from typing import Any

import numpy as np

from .compare import plain, unchanged
from .exercise import Part

__all__ = [
    "MAX_CPU_S",
    "TooLong",
    "call_or_none",
    "cheapest_case",
    "copied",
    "keeps_arguments",
    "limited",
    "muted",
    "shown",
]

Function = Callable[..., Any]

MAX_CPU_S = 1.0
"""Seconds of CPU time that one call of a changed function may take."""


class TooLong(BaseException):
    """Raised in a call that does not end; no `except Exception` of a student holds it."""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise in a block that takes longer, in CPU seconds of this process, where the system counts them.

    Elsewhere only the rounds of loops are counted (`program`); outside stands the process that runs the answers.
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
    try:
        with limited(MAX_CPU_S), warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            return plain(part.value(function, copied(arguments)))
    except (Exception, SystemExit, TooLong):  # whatever a change leads to
        return None


def shown(error: BaseException) -> str:
    """Return an error as a message shows it; one of a student's own class may raise another where it is printed."""
    try:
        return f"{type(error).__name__}: {getattr(error, 'msg', error)}".removesuffix(": ")
    except Exception:
        return type(error).__name__


def copied(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the arguments with copies of the arrays and lists."""
    return tuple(copy.deepcopy(x) if isinstance(x, np.ndarray | list) else x for x in arguments)


def keeps_arguments(part: Part, function: Function, arguments: tuple[Any, ...]) -> bool:
    """Whether a function leaves its arguments as they are; yes where a part calls it in its own way."""
    if part.call is not None:
        return True
    given: list[Any] = []

    def noted(*taken: Any) -> Any:
        given.extend(taken)
        return function(*taken)

    call_or_none(part, noted, arguments)
    return all(map(unchanged, arguments, given))


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
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        if os.name != "posix":
            yield
            return
        for stream in filter(None, (sys.__stdout__, sys.__stderr__)):
            stream.flush()
        kept, nothing = [os.dup(1), os.dup(2)], os.open(os.devnull, os.O_WRONLY)
        os.dup2(nothing, 1)
        os.dup2(nothing, 2)
        try:
            yield
        finally:
            for descriptor, number in zip(kept, (1, 2)):
                os.dup2(descriptor, number)
            for descriptor in (*kept, nothing):
                os.close(descriptor)
