"""The student's code in a process of its own: an endless loop is stopped, and its line is reported."""

from __future__ import annotations

import base64
import linecache
import re
import secrets
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from importlib.util import decode_source
from os import PathLike
from pathlib import Path
from typing import IO, Any

from .cases import cases
from .course import Course
from .errors import CourseError
from .exercise import Exercise, Part
from .judge import at_line
from .process import Died, Process
from .rules import is_ours, is_reference
from .text import Language, Text, say
from .transfer import sent
from .verdict import Verdict, failing_case, headed
from .workbook import Workbook, content
from .worker import NOT_RECEIVED

__all__ = ["TIME_LIMIT_S", "drawn", "judged", "not_judged", "opened"]

TIME_LIMIT_S = 10.0  # for one call of a function, and for reading a file; the longest of the references takes 0.1 s

ENDLESS = Text("It did not finish in {s:g} s: a loop that never ends?", "{s:g} 秒内没有结束：是不是死循环？")
ENDED = Text("It ended the whole Python process.", "它使整个 Python 进程终止了。")


def drawn(seed: int | None) -> int:
    """Return a seed for the random cases: a new one each time unless it is given."""
    if seed is not None and seed < 0:
        raise CourseError(f"seed: expected a whole number, 0 or more, got {seed}")
    return secrets.randbelow(10**6) if seed is None else seed


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
    if not time_limit >= 0:
        raise CourseError(f"time_limit: expected seconds, 0 or more, got {time_limit}")
    if not time_limit or not sys.executable or sys.platform == "emscripten":  # a browser has no other process
        yield Workbook(course, folder, language=language, seed=drawn(seed), files=files)
        return
    book = _Isolated(course, folder, language=language, seed=drawn(seed), files=files)
    book.time_limit, book.printed = time_limit, printed
    try:
        yield book
    finally:
        book.close()


def judged(exercise: Exercise, part: Part, function: Callable[..., Any], *, seed: int, time_limit: float) -> Verdict:
    """Judge a function of a notebook, a script or a shell in another process, and print what it prints.

    It is judged here where there is no other process, and where it holds what cannot be sent to one.
    """
    with tempfile.TemporaryFile() as printed:
        try:
            with opened(exercise.course, ".", seed=seed, time_limit=time_limit, printed=printed) as book:
                return book.judge_function(exercise, part, function)
        finally:
            printed.seek(0)
            if text := printed.read().decode(errors="replace"):
                sys.stdout.write(text)


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

    def judge_function(self, exercise: Exercise, part: Part, function: Callable[..., Any]) -> Verdict:
        """Judge a function that is sent to the other process."""
        data = None if is_reference(part, function) else sent(function)
        found = None if data is None else self._judge(exercise, part, base64.b64encode(data).decode())
        return super().judge_function(exercise, part, function) if found is None else found

    def _judge(self, exercise: Exercise, part: Part, *function: str) -> Any:
        why = None
        for what in ("verdict", "plain verdict"):  # at a change that the search tries, a library may end the process
            found = self._ask(what, part.name, *function)
            if isinstance(found, Verdict) or found == NOT_RECEIVED:
                return found if isinstance(found, Verdict) else None
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

    def _ask(self, what: str, name: str, *function: str) -> Any:
        """Return the answer of the other process. Where it had to stop, note at what, and start a new one."""
        while not self.is_closed:
            self._process = self._process or self._started()
            try:
                answer, borrowed = self._process.ask(what, name, *function)
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
        return headed(exercise, part, *lines, case=failing_case(exercise, part, k, self.seed, tried[k]))

    def _explained(self, died: Died) -> list[Text]:
        """Return why the process ended, and at which line of the student's."""
        lines = [ENDLESS.fill(s=self.time_limit) if died.late else ENDED]
        for path, number in re.findall(r'File "(.+)", line (\d+) in', died.trace):
            if not is_ours(path) and (line := _line(path, int(number))):
                return [*lines, *at_line(path, number, line)]
        return lines


def _line(path: str, number: int) -> str:
    """Return a line of a student's file, or of a cell; empty where there is none."""
    try:
        source = decode_source(content(Path(path)))
    except (OSError, SyntaxError, UnicodeError, ValueError):
        source = "".join(linecache.getlines(path)) if path in linecache.cache else ""  # a cell
    return "".join(source.splitlines()[number - 1 : number]).strip()
