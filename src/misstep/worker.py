"""The program of the process that runs the student's code. It stops itself where a call takes too long.

`faulthandler` watches from a thread of its own, which does not need Python's lock, and writes down the student's line.
"""

from __future__ import annotations

import faulthandler
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import IO, Any, TextIO

from .calls import shown
from .verdict import Verdict, as_json, from_json
from .workbook import Workbook

__all__ = ["main"]

MAX_ADDED_BYTES = 4 << 30  # of memory that an answer uses; the largest of the references uses 0.1 GB
MAX_FILE_BYTES = 100_000_000  # of a file that an answer writes, where the system can limit them
MAX_PRINTED = 10_000  # characters that the answers of a folder print, a line counted as 80 at least


def main() -> None:
    """Answer the questions on stdin, on stdout; what the student's code prints goes to stderr."""
    questions, replies = os.fdopen(os.dup(0), "rb"), os.dup(1)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(2, 1)
    word, limit, path, task = from_json(questions.readline())
    with open(path, "wb") as trace:
        if hasattr(os, "register_at_fork"):
            os.register_at_fork(after_in_child=lambda: os._exit(0))
        _limit_memory_and_files()
        sys.stdout, sys.stderr = (_Short(stream) for stream in (sys.stdout, sys.stderr))
        faulthandler.enable(trace)
        book = _Watched(replies, word, limit, trace, dict(task))
        while question := questions.readline():
            answer = book.answer(*from_json(question))
            book.tell("answer", [answer, sorted(book.borrowed)])


class _Watched(Workbook):
    """A folder that tells what it is running, under a time limit."""

    def __init__(self, replies: int, word: str, limit: float, trace: IO[Any], task: dict[str, Any]) -> None:
        files = {section: Path(path) for section, path in task["files"]}
        super().__init__(import_module(task["course"]).COURSE, task["folder"], seed=task["seed"], files=files)
        self._replies, self._word, self._limit, self._trace, self._depth = replies, word, limit, trace, 0
        self.watch = self._watch
        self._verdicts.update({name: Verdict(state) for name, state in task["states"]})
        self._modules.update(dict(task["unreadable"]))

    def tell(self, *message: Any) -> None:
        """Write a message; begin a line, as the student's code may have written to this file, too."""
        text = f"\n{self._word}{as_json(message)}\n".encode()
        try:
            while text:
                text = text[os.write(self._replies, text) :]
        except OSError:  # closed by the student's code, or the other process has ended
            os._exit(1)

    @contextmanager
    def _watch(self, name: str) -> Iterator[None]:
        """Set the clock for a call, and set it again for the caller's afterwards."""
        self.tell("begin", name)
        self._set_clock(self._depth + 1)
        try:
            yield
        finally:
            self._set_clock(self._depth - 1)
            self.tell("end")

    def _set_clock(self, depth: int) -> None:
        self._depth = depth
        if depth:
            faulthandler.dump_traceback_later(self._limit, exit=True, file=self._trace)
        else:
            faulthandler.cancel_dump_traceback_later()

    def answer(self, what: str, name: str) -> Any:
        """Return the words or the verdict that are asked for; the reason as a text where it cannot be judged."""
        if what == "words":
            return self.words(self.course.exercise(name))
        exercise, part = self.course.find_part(name)
        self.search = False if what == "plain verdict" else None
        try:
            return self.verdict(exercise, part)
        except BaseException as error:
            return shown(error)


def _limit_memory_and_files() -> None:
    """Let an array or a file that is too large raise an error in the student's line, where the system can do that."""
    if os.name != "posix":
        return
    import resource

    limits = {resource.RLIMIT_FSIZE: MAX_FILE_BYTES}
    if sys.platform == "linux":
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
        limits[resource.RLIMIT_AS] = pages * resource.getpagesize() + MAX_ADDED_BYTES
    for kind, wanted in limits.items():
        _, most = resource.getrlimit(kind)
        resource.setrlimit(kind, (wanted if most == resource.RLIM_INFINITY else min(wanted, most), most))


class _Short:
    """A stream that drops what is too much: an endless loop may print."""

    def __init__(self, stream: TextIO) -> None:
        self._stream, self._left = stream, MAX_PRINTED

    def write(self, text: str) -> int:
        """Write it, as far as there is room."""
        before, self._left = self._left, self._left - len(text) - 80 * text.count("\n")
        if before > 0:
            self._stream.write(text[:before] + ("\n[...]\n" if self._left <= 0 else ""))
        return len(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)
