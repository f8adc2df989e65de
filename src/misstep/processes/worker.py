"""The program of the process that runs the student's code. It stops itself where a call takes too long.

`faulthandler` watches from a thread of its own, which does not need Python's lock, and writes down the student's line.
"""

from __future__ import annotations

import base64
import faulthandler
import os
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import IO, Any

from ..calls import shown
from ..exercise import Exercise, Part
from ..folder.workbook import Workbook
from ..judge import Verdict, judge
from ..messages import message
from ..text import Text
from .limits import contained
from .messages import as_json, from_json
from .transfer import received

__all__ = ["NOT_RECEIVED", "main", "not_judged"]

NOT_RECEIVED = "not received"
"""The answer on a function that cannot be made again here."""

NOT_JUDGED = Text("It could not be judged: {why}", "无法评判：{why}")


def not_judged(exercise: Exercise, part: Part, why: str) -> Verdict:
    """Return the verdict on a function that the check itself fails on."""
    return Verdict("wrong", (message("head", id=exercise.id, name=part.name), NOT_JUDGED.fill(why=why)))


class _Watched(Workbook):
    """A folder that tells what it is running, under a time limit."""

    def __init__(self, replies: int, word: str, limit: float, trace: IO[Any], task: dict[str, Any]) -> None:
        files = {section: Path(path) for section, path in task["files"]}
        course = import_module(task["course"]).COURSE
        super().__init__(course, task["folder"], seed=task["seed"], files=files)
        self._replies, self._word, self._limit, self._trace = replies, word, limit, trace
        self._depth, self.watch = 0, self._watch
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
        self._set(self._depth + 1)
        try:
            yield
        finally:
            self._set(self._depth - 1)
            self.tell("end")

    def _set(self, depth: int) -> None:
        self._depth = depth
        if depth:
            faulthandler.dump_traceback_later(self._limit, exit=True, file=self._trace)
        else:
            faulthandler.cancel_dump_traceback_later()

    def answer(self, what: str, name: str, *function: str) -> Any:
        """Return the answer to a question."""
        if what == "words":
            return self.words(self.course.exercise(name))
        exercise, part = self.course.find_part(name)
        for search in (
            (False,) if what == "plain verdict" else (None, False)
        ):  # the search may fail where judging does not
            self.search = search
            try:
                return self._function(exercise, part, *function) if function else self.verdict(exercise, part)
            except BaseException as error:
                why = shown(error)
        return not_judged(exercise, part, why)

    def _function(self, exercise: Exercise, part: Part, text: str) -> Verdict | str:
        """Judge a function that was sent."""
        try:
            function = received(base64.b64decode(text))
        except Exception:  # it names something that is only where it comes from
            return NOT_RECEIVED
        search = True if self.search is None else self.search
        return judge(exercise, part, function, seed=self.seed, watch=lambda: self.watch(part.name), search=search)


def main() -> None:
    """Answer the questions on stdin, on stdout; what the student's code prints goes to stderr."""
    questions, replies = os.fdopen(os.dup(0), "rb"), os.dup(1)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(2, 1)
    word, limit, path, task = from_json(questions.readline())
    with open(path, "wb") as trace, contained():
        faulthandler.enable(trace)
        book = _Watched(replies, word, limit, trace, dict(task))
        while question := questions.readline():
            answer = book.answer(*from_json(question))
            book.tell("answer", [answer, sorted(book.borrowed)])
