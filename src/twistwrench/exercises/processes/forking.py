"""A function of a notebook judged in a copy of this process: a loop without end does not stop the notebook."""

from __future__ import annotations

import _thread
import faulthandler
import io
import linecache
import os
import pickle
import re
import signal
import sys
import tempfile
import threading
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout, suppress
from typing import Any, BinaryIO

from ..cases import cases
from ..exercise import Exercise, Part
from ..failing import failing_case
from ..judge import Verdict, judge
from ..rules import file_or_cell, is_ours
from ..words.phrases import say
from ..words.text import Text
from .isolation import CheckFailed
from .limits import contained

__all__ = ["judged"]

Function = Callable[..., Any]


def judged(exercise: Exercise, part: Part, function: Function, *, seed: int, time_limit: float) -> Verdict:
    """Judge a function under a time limit.

    Linux runs it in a copy of this process, which shares all that the notebook has defined. Elsewhere a copy is not
    safe beside threads: there it runs here, and a loop in Python is interrupted.

    Parameters
    ----------
    exercise : Exercise
    part : Part
        Of the exercise.
    function : callable
        The student's.
    seed : int
        Of the random cases.
    time_limit : float
        Seconds for one call; 0 for none.

    Returns
    -------
    Verdict
    """
    if not time_limit or sys.platform == "emscripten":  # a browser has no other process, nor a thread to interrupt
        return judge(exercise, part, function, seed=seed)
    how = _in_a_copy if sys.platform == "linux" else _interrupted
    calls, found, trace, printed = how(exercise, part, function, seed, time_limit, True)
    if found is None and not trace.startswith("Timeout"):  # a library may have ended it at a change that was tried
        calls, found, trace, printed = how(exercise, part, function, seed, time_limit, False)
    sys.stdout.write(printed)
    if found is not None:
        return found
    late = trace.startswith("Timeout")
    lines = [say("endless", seconds=f"{time_limit:g}") if late else say("ended"), *_where(trace)]
    lines += [say("ended in", name=exercise.needs.title())] if exercise.needs and not late else []
    tried = cases(part, seed)
    k = min(max(calls - 1, 0), len(tried) - 1)  # further calls look for what is wrong
    head = say("head", id=exercise.id, name=part.name)
    return Verdict("wrong", (head, *lines), (), failing_case(part, k, seed, tried[k]))


Outcome = tuple[int, Verdict | None, str, str]
"""How many calls were begun, the verdict, where it stopped without one, and what was printed."""


def _in_a_copy(exercise: Exercise, part: Part, function: Function, seed: int, limit: float, search: bool) -> Outcome:
    reading, writing = os.pipe()
    sys.stdout.flush()
    with tempfile.TemporaryFile() as trace:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # a notebook has threads; the copy does not use them
            pid = os.fork()
        if pid == 0:
            try:
                os.close(reading)
                _copy(exercise, part, function, seed, limit, search, trace, writing)
            finally:
                os._exit(0)
        os.close(writing)
        calls, found, printed = 0, None, ""
        try:
            with open(reading, "rb") as replies, suppress(EOFError, pickle.UnpicklingError):
                while True:
                    message = pickle.load(replies)
                    if message is None:
                        calls += 1
                    else:
                        found, printed = message
                        if found is None:
                            raise CheckFailed(printed)
        finally:
            with suppress(ProcessLookupError):
                os.killpg(pid, signal.SIGKILL)
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
            os.waitpid(pid, 0)
        trace.seek(0)
        return calls, found, trace.read().decode(errors="replace"), printed


def _copy(
    exercise: Exercise,
    part: Part,
    function: Function,
    seed: int,
    limit: float,
    search: bool,
    trace: Any,
    writing: int,
) -> None:
    """Judge in the copy, and report each call and the verdict."""
    os.setpgid(0, 0)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # an interrupt is for the notebook
    printed = io.StringIO()

    def tell(message: Any) -> None:
        pickle.dump(message, replies)
        replies.flush()

    @contextmanager
    def watch() -> Iterator[None]:
        tell(None)
        faulthandler.dump_traceback_later(limit, exit=True, file=trace)
        try:
            yield
        finally:
            faulthandler.cancel_dump_traceback_later()

    replies: BinaryIO
    with open(writing, "wb") as replies, redirect_stdout(printed), redirect_stderr(printed), contained():
        try:
            tell((judge(exercise, part, function, seed=seed, watch=watch, search=search), printed.getvalue()))
        except Exception:
            tell((None, traceback.format_exc()))


def _interrupted(exercise: Exercise, part: Part, function: Function, seed: int, limit: float, search: bool) -> Outcome:
    """Judge here, and interrupt a call that takes too long."""
    calls, stopped = 0, ""

    @contextmanager
    def watch() -> Iterator[None]:
        nonlocal calls, stopped
        calls += 1
        late = threading.Event()

        def interrupt() -> None:
            late.set()
            _thread.interrupt_main()

        timer = threading.Timer(limit, interrupt)
        timer.start()
        try:
            yield
        except KeyboardInterrupt as error:
            if late.is_set():
                stopped = _trace(error)
            raise
        finally:
            timer.cancel()

    heard = signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell may ignore it for a background job
    try:
        return calls, judge(exercise, part, function, seed=seed, watch=watch, search=None if search else False), "", ""
    except KeyboardInterrupt:
        if not stopped:
            raise
        return calls, None, stopped, ""
    finally:
        signal.signal(signal.SIGINT, heard)


def _trace(error: BaseException) -> str:
    """Write the places of an interrupt as `faulthandler` does, the last call first."""
    places, at = [], error.__traceback__
    while at is not None:
        places.append(f'File "{at.tb_frame.f_code.co_filename}", line {at.tb_lineno} in')
        at = at.tb_next
    return "\n".join(["Timeout", *reversed(places)])


def _where(trace: str) -> list[Text]:
    """Return the line of the student's at which the process stopped."""
    for path, number in re.findall(r'File "(.+)", line (\d+) in', trace):
        line = linecache.getline(path, int(number)).strip()
        if line and not is_ours(path) and path != sys.argv[0] and "/lib/python" not in path:
            return [say("at line", file=file_or_cell(path), line=number), Text("    " + line, "    " + line)]
    return []
