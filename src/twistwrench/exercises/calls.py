"""Calls of functions that may be wrong: of copies of their arguments, never endless, and what they computed."""

from __future__ import annotations

import copy
import os
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from typing import Any

import numpy as np

from .compare import plain, unchanged
from .exercise import Part

__all__ = [
    "CHANGED",
    "LONGEST",
    "TooLong",
    "begin",
    "copied",
    "count",
    "keeps_arguments",
    "limited",
    "local_values",
    "shown",
    "silent",
    "smallest",
    "switches_off",
    "traced",
    "tried",
]

Function = Callable[..., Any]

CHANGED = "<changed>"
"""Stands in place of a file in what is compiled here and by `wrong.faulty`."""

MOST_ROUNDS = 1000

LONGEST = 1.0
"""Seconds of CPU time that one call of a changed function may take."""

_rounds = [0, MOST_ROUNDS]


def begin(arguments: tuple[Any, ...]) -> None:
    """Count the rounds of loops from nought, and allow two loops, one in the other, over the longest argument."""
    _rounds[:] = 0, max([MOST_ROUNDS, *(len(x) ** 2 for x in arguments if isinstance(x, tuple | list))])


def count() -> None:
    """Stop a loop that an edit has made endless."""
    _rounds[0] += 1
    if _rounds[0] > _rounds[1]:
        raise RuntimeError("an endless loop")


class TooLong(BaseException):
    """Raised in a call that does not end; no `except Exception` of a student holds it."""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise in a block that takes longer; counted in CPU seconds of this process, where the system counts them.

    `count` stops the loops of a changed function; a change may also send a function that it calls round for ever.
    """
    if not hasattr(signal, "setitimer") or threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(*given: object) -> None:
        raise TooLong(*given)

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds, seconds)  # again, should something hold the first
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def tried(part: Part, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
    """Return what a function that may be faulty gives; None where it raises an error or does not end."""
    begin(arguments)
    try:
        with limited(LONGEST), warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            return plain(part.value(function, copied(arguments)))
    except (Exception, SystemExit, TooLong):  # whatever an edit leads to
        return None


def switches_off(part: Part, before: Function, after: Function, arguments: tuple[Any, ...]) -> bool:
    """Whether a change makes lines that ran run no longer, or makes zero what was not, by its name."""
    ran, runs = (_lines_run(part, f, arguments) for f in (before, after))
    were, are = (
        next(iter(local_values(partial(tried, part, f), (f,), (arguments,)).values()), {}) for f in (before, after)
    )
    return runs < ran or any(_counts(x) and _is_zero(are.get(name)) for name, x in were.items())


def _counts(x: Any) -> bool:
    return isinstance(x, np.ndarray) and x.dtype.kind == "f" and bool(x.any())


def _is_zero(x: Any) -> bool:
    return isinstance(x, np.ndarray) and x.size > 0 and not x.any()


def _lines_run(part: Part, function: Function, arguments: tuple[Any, ...]) -> set[int]:
    """Return which lines of a changed function run, its loops and branches among them."""
    found = set[int]()

    def note(*traced: Any) -> Any:
        frame, _, _ = traced
        if frame.f_code.co_filename != CHANGED:
            return None
        found.add(frame.f_lineno)
        return note

    with traced(note):
        tried(part, function, arguments)
    return found


@contextmanager
def traced(note: Callable[..., Any]) -> Iterator[None]:
    """Call a function at each line that runs, as Python traces it."""
    before = sys.gettrace()
    sys.settrace(note)
    try:
        yield
    finally:
        sys.settrace(before)


@contextmanager
def silent() -> Iterator[None]:
    """Drop what libraries print past Python: a small change may give them numbers that they complain about."""
    if os.name != "posix":
        yield
        return
    sys.stdout.flush()
    sys.stderr.flush()
    kept, nothing = [os.dup(1), os.dup(2)], os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    os.dup2(nothing, 2)
    try:
        yield
    finally:
        sys.stdout.flush()
        for stream, number in zip(kept, (1, 2)):
            os.dup2(stream, number)
        for number in (*kept, nothing):
            os.close(number)


def shown(error: BaseException) -> str:
    """Return an error as a message shows it; one of a student's own class may raise another where it is printed."""
    try:
        return f"{type(error).__name__}: {getattr(error, 'msg', error)}".removesuffix(": ")
    except Exception:
        return type(error).__name__


def copied(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the arguments with copies of the arrays and lists."""
    return tuple(copy.deepcopy(x) if isinstance(x, np.ndarray | list) else x for x in arguments)


def keeps_arguments(part: Part, function: Callable[..., Any], arguments: tuple[Any, ...]) -> bool:
    """Whether a function leaves its arguments as they are; yes where a part calls it in its own way."""
    if part.call is not None:
        return True
    given: list[Any] = []

    def noted(*taken: Any) -> Any:
        given.extend(taken)
        return function(*taken)

    tried(part, noted, arguments)
    return all(map(unchanged, arguments, given))


def local_values(function: Function, within: Iterable[Any], arguments: tuple[Any, ...]) -> dict[str, dict[str, Any]]:
    """Return the values of the names in some functions, by their names, when one that calls them is called.

    Those that stand in their place and were changed count as well.
    """
    codes = [f.__code__ for f in within if hasattr(f, "__code__")]
    files = {code.co_name: (code.co_filename, CHANGED) for code in codes}
    found: dict[str, dict[str, Any]] = {code.co_name: {} for code in codes}

    def note(*given: Any) -> None:
        frame, event, _ = given
        name = frame.f_code.co_name
        if event == "return" and frame.f_code.co_filename in files.get(name, ()):
            found[name].update(frame.f_locals)

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        function(*arguments)
    except (Exception, SystemExit):  # what it computed until then is known
        pass
    finally:
        sys.setprofile(before)
    return found


def smallest(cases: Mapping[int, tuple[Any, ...]]) -> int:
    """Return the case with the fewest numbers in it: it takes least time, and is the same in each run."""
    return min(cases, key=lambda k: _numbers(cases[k]))


def _numbers(x: Any) -> int:
    """Return how many numbers something holds; a model, as many as it has bodies."""
    if isinstance(x, list | tuple):
        return sum(map(_numbers, x))
    return int(getattr(x, "nbodies", np.size(x)))
