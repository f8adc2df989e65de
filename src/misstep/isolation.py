"""The student's code in a process of its own: an endless loop is stopped, and its line is reported."""

from __future__ import annotations

import re
import secrets
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib.util import decode_source
from os import PathLike
from pathlib import Path
from typing import IO, Any

from .cases import cases
from .course import Course
from .errors import CourseError
from .exercise import Exercise, Part
from .judge import ENDLESS, at_line, more
from .process import Died, Process
from .rules import is_ours
from .text import Language, Text, say
from .verdict import Verdict, failing_case, headed
from .workbook import Workbook, content

__all__ = ["TIME_LIMIT_S", "checked_limit", "drawn", "not_judged", "opened"]

TIME_LIMIT_S = 10.0  # for one call of a function, and for reading a file; the longest of the references takes 0.1 s

ENDED = Text("It ended the whole Python process.", "它使整个 Python 进程终止了。")


def drawn(seed: int | None) -> int:
    """Return a seed for the random cases: a new one each time unless it is given."""
    if seed is not None and seed < 0:
        raise CourseError(f"seed: expected a whole number, 0 or more, got {seed}")
    return secrets.randbelow(10**6) if seed is None else seed


def checked_limit(time_limit: float) -> float:
    """Return a time limit that is none or some seconds."""
    if not time_limit >= 0:
        raise CourseError(f"time_limit: expected seconds, 0 or more, got {time_limit}")
    return time_limit


def not_judged(exercise: Exercise, part: Part, why: object) -> Verdict:
    """Return the verdict on a function that the check itself fails on."""
    return headed(exercise, part, say("It could not be judged: {why}", "无法评判：{why}", why=why))


@contextmanager
def opened(
    course: Course,
    folder: str | PathLike[str],
    *,
    language: Language | None = None,
    seed: int | None = None,
    time_limit: float = TIME_LIMIT_S,
    printed: IO[Any] | None = sys.__stderr__,
    files: Mapping[str, Path] | None = None,
) -> Iterator[Workbook]:
    """Open a folder that was started before, and close it again.

    A time limit of 0 is none, and no other process: a debugger needs that. What the other process prints goes to
    `printed`, or nowhere. The other arguments are those of `Workbook`; the seed is drawn unless given.
    """
    has_none = not sys.executable or sys.platform == "emscripten"  # a browser has no other process
    if not checked_limit(time_limit) or has_none:
        yield Workbook(course, folder, language=language, seed=drawn(seed), files=files)
        return
    book = _Isolated(course, folder, language=language, seed=drawn(seed), files=files)
    book.time_limit, book.printed = time_limit, printed
    try:
        yield book
    finally:
        book.close()


class _Isolated(Workbook):
    """A folder whose files are read and judged in another process; the arguments are those of `Workbook`."""

    time_limit = TIME_LIMIT_S
    printed: IO[Any] | None = None
    is_closed = False
    _process: Process | None = None

    def words(self, exercise: Exercise) -> str | None:
        """Return the student's answer in words, None if it is not written yet."""
        found = self._ask("words", exercise.id)
        return found if isinstance(found, str) else None

    def _judge(self, exercise: Exercise, part: Part) -> Verdict:
        why = None
        for what in ("verdict", "plain verdict"):  # at a change that the search tries, a library may end the process
            found = self._ask(what, part.name)
            if isinstance(found, Verdict):
                return found
            why = found or why
        return not_judged(exercise, part, why or ENDED.en)

    def close(self) -> None:
        """End the other process, and start no new one."""
        self.is_closed, process = True, self._process
        if process is not None:
            process.close()

    def _started(self) -> Process:
        files = [[section, str(path)] for section, path in self.files.items()]
        states = [[known, verdict.state] for known, verdict in self._verdicts.items()]
        task = {"course": self.course.module, "folder": str(self.folder), "seed": self.seed, "files": files}
        task |= {"states": states, "unreadable": [[k, x] for k, x in self._modules.items() if isinstance(x, Text)]}
        return Process(task, self.time_limit, self.printed)

    def _ask(self, what: str, name: str) -> Any:
        """Return the answer of the other process. Where it had to stop, note at what, and start a new one."""
        while not self.is_closed:
            self._process = self._process or self._started()
            try:
                answer, borrowed = self._process.ask(what, name)
            except Died as died:
                self._process = None
                if died.at is None or (what == "verdict" and died.at == name and not died.late):
                    return None  # the search may have ended it
                lines = self._explained(died)
                if sections := [section for section in self.course.sections if self.path(section).name == died.at]:
                    text = Text(*("\n".join(line.of(k) for line in lines) for k in ("en", "zh")))
                    self._modules[sections[0]] = text
                else:
                    self._verdicts[died.at] = self._verdict_on(died, lines)
                if died.at == name:
                    return self._verdicts[name]
            else:
                self.borrowed |= {*borrowed}
                return answer
        return None

    def _verdict_on(self, died: Died, lines: list[Text]) -> Verdict:
        """Return the verdict on a function that did not give an answer, with the case that it was called with."""
        exercise, part = self.course.find_part(str(died.at))
        tried = cases(part, self.seed)
        k = min(max(died.call, 0), len(tried) - 1)  # further calls look for what is wrong
        return headed(
            exercise, part, *lines, case=failing_case(exercise, part, k, self.seed, tried[k]), more=more(exercise, part)
        )

    def _explained(self, died: Died) -> list[Text]:
        """Return why the process ended, and at which line of the student's."""
        lines = [ENDLESS.fill(s=self.time_limit) if died.late else ENDED]
        for path, number in re.findall(r'File "(.+)", line (\d+) in', died.trace):
            if not is_ours(path) and (line := _line(path, int(number))):
                return [*lines, *at_line(path, number, line)]
        return lines


def _line(path: str, number: int) -> str:
    """Return a line of a student's file; empty where there is none."""
    try:
        source = decode_source(content(Path(path)))
    except (OSError, SyntaxError, UnicodeError, ValueError):
        return ""
    return "".join(source.splitlines()[number - 1 : number]).strip()
