"""The process that runs the student's code, and stops itself where that takes too long.

`faulthandler` watches from a thread of its own, which needs neither Python's lock nor a living parent.
"""

from __future__ import annotations

import faulthandler
import os
import pickle
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, BinaryIO

from .. import catalogue
from ..folder.workbook import Workbook
from ..words.text import Text
from .limits import contained

__all__ = ["main"]


class _Watched(Workbook):
    """A folder that reports what it is running, under a time limit."""

    def __init__(self, folder: str, seed: int, limit: float, trace: BinaryIO, replies: BinaryIO) -> None:
        super().__init__(folder, seed=seed)
        self._limit, self._trace, self._replies = limit, trace, replies
        self._depth, self.watch = 0, self._watch

    def tell(self, kind: str, said: Any) -> None:
        """Write a message to the parent."""
        pickle.dump((kind, said), self._replies)
        self._replies.flush()

    @contextmanager
    def _watch(self, name: str) -> Iterator[None]:
        """Set the clock for a call, and set it again for the caller's afterwards."""
        self.tell("begin", name)
        self._set(self._depth + 1)
        try:
            yield
        finally:
            self._set(self._depth - 1)
            self.tell("end", name)

    def _set(self, depth: int) -> None:
        self._depth = depth
        if depth:
            faulthandler.dump_traceback_later(self._limit, exit=True, file=self._trace)
        else:
            faulthandler.cancel_dump_traceback_later()

    def know(self, verdicts: Any, unreadable: dict[str, Text]) -> None:
        """Take over what was found before the last process had to stop."""
        self._verdicts.update(verdicts)
        files = {catalogue.file_name(section): section for section in catalogue.SECTIONS}
        self._modules.update({files[file]: text for file, text in unreadable.items()})


def main() -> None:
    """Answer the requests on stdin, on stdout; what the student's code prints goes to stderr."""
    requests, replies = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(2, 1)
    folder, seed, limit, path, verdicts, unreadable = pickle.load(requests)
    with open(path, "wb") as trace, contained():
        faulthandler.enable(trace)
        book = _Watched(folder, seed, limit, trace, replies)
        book.know(verdicts, unreadable)
        while True:
            try:
                what, name = pickle.load(requests)
            except EOFError:
                return
            try:
                book.tell("answer", (_answer(book, what, name), book.borrowed))
            except Exception:
                book.tell("failed", traceback.format_exc())


def _answer(book: Workbook, what: str, name: str) -> Any:
    if what == "words":
        return book.words(catalogue.exercise(name))
    book.search = what != "plain verdict"
    return book.verdict(*catalogue.find_part(name))
