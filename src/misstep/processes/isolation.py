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

from ..cases import cases
from ..course import Course
from ..errors import CourseError
from ..exercise import Exercise, Part
from ..failing import Case, failing_case
from ..folder.workbook import Workbook, content
from ..judge import Verdict, judge
from ..messages import message
from ..rules import is_ours, is_reference, reference
from ..state import at_line
from ..text import Language, Text
from .process import Died, Process
from .transfer import sent
from .worker import NOT_RECEIVED, not_judged

__all__ = ["TIME_LIMIT", "IsolatedWorkbook", "drawn", "judged", "opened"]

TIME_LIMIT = 10.0
"""Seconds for one call of a function, and for reading a file. The longest of the references takes 0.1 s."""


def drawn(seed: int | None) -> int:
    """Return a seed for the random cases: a new one each time unless it is given.

    Raises
    ------
    CourseError
        If it is negative.
    """
    if seed is not None and seed < 0:
        raise CourseError(f"seed: expected a whole number, 0 or more, got {seed}")
    return secrets.randbelow(10**6) if seed is None else seed


def _is_possible(time_limit: float) -> bool:
    """Whether there is another process; a browser has none."""
    if not time_limit >= 0:
        raise CourseError(f"time_limit: expected seconds, 0 or more, got {time_limit}")
    return bool(time_limit and sys.executable) and sys.platform != "emscripten"


@contextmanager
def opened(
    course: Course,
    folder: str | PathLike[str],
    *,
    language: Language | None = None,
    seed: int | None = None,
    time_limit: float = TIME_LIMIT,
    quiet: bool = False,
    files: Mapping[str, Path] | None = None,
) -> Iterator[Workbook]:
    """Open a folder that was started before, and close it again.

    Parameters
    ----------
    course : Course
    folder : str or path
    language : {"en", "zh"}, optional
        Of the messages.
    seed : int, optional
        Of the random cases; drawn anew unless given.
    time_limit : float
        Seconds for one call of a student's function; 0 for none, and no other process, as a debugger needs it.
    quiet : bool
        Drop what the other process prints.
    files : mapping, optional
        The files that have another name than `start` has given them, by section.

    Yields
    ------
    Workbook
    """
    if not _is_possible(time_limit):
        yield Workbook(course, folder, language=language, seed=drawn(seed), files=files)
        return
    book = IsolatedWorkbook(course, folder, language=language, seed=drawn(seed), files=files)
    book.time_limit, book.printed = time_limit, None if quiet else sys.__stderr__
    try:
        yield book
    finally:
        book.close()


def judged(exercise: Exercise, part: Part, function: Callable[..., Any], *, seed: int, time_limit: float) -> Verdict:
    """Judge a function of a notebook, a script or a shell in another process, and print what it prints.

    It is judged here where there is no other process, and where it holds what cannot be sent to one.

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
    if is_reference(part, function):
        return Verdict("wrong", (message("head", id=exercise.id, name=part.name), reference(part)))
    data = sent(function) if _is_possible(time_limit) else None
    if data is None:
        return judge(exercise, part, function, seed=seed)
    book = IsolatedWorkbook(exercise.course, ".", seed=seed)
    book.time_limit, book.function = time_limit, (base64.b64encode(data).decode(),)
    with tempfile.TemporaryFile() as printed:
        book.printed = printed
        try:
            return book.verdict(exercise, part)
        except _NotReceived:
            return judge(exercise, part, function, seed=seed)
        finally:
            book.close()
            printed.seek(0)
            sys.stdout.write(printed.read().decode(errors="replace"))


class _NotReceived(Exception):
    """The other process cannot make a function again."""


class IsolatedWorkbook(Workbook):
    """A folder whose files are read and judged in another process; the arguments are those of `Workbook`."""

    time_limit = TIME_LIMIT
    """Seconds for one call of a student's function."""

    printed: IO[Any] | None = None
    """Where what the other process prints goes; nowhere unless given."""

    function: tuple[str, ...] = ()
    """A function that is sent to be judged, in place of one of a file."""

    is_closed = False
    _process: Process | None = None

    def words(self, exercise: Exercise) -> str | None:
        """Return the student's answer in words, None if it is not written yet."""
        found = self._ask("words", exercise.id)
        return found if isinstance(found, str) else None

    def _judge(self, exercise: Exercise, part: Part) -> Verdict:
        for what in ("verdict", "plain verdict"):  # at a change that the search tries, a library may end the process
            found = self._ask(what, part.name, *self.function)
            if isinstance(found, Verdict):
                return found
            if found == NOT_RECEIVED:
                raise _NotReceived
        return not_judged(exercise, part, message("ended").en)

    def close(self) -> None:
        """End the other process, and start no new one."""
        self.is_closed = True
        self._end()

    def _end(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.close()

    def _ask(self, what: str, name: str, *function: str) -> Any:
        """Return the answer of the other process. Where it had to stop, note at what, and start a new one."""
        unreadable: dict[str, Text] = {k: x for k, x in self._modules.items() if isinstance(x, Text)}
        while not self.is_closed:
            if self._process is None:
                task = {"course": self.course.module, "folder": str(self.folder), "seed": self.seed}
                files = [[section, str(path)] for section, path in self.files.items()]
                states = [[known, verdict.state] for known, verdict in self._verdicts.items()]
                task |= {"files": files, "states": states, "unreadable": [*map(list, unreadable.items())]}
                self._process = Process(task, self.time_limit, self.printed)
            try:
                answer, borrowed = self._process.ask(what, name, *function)
            except Died as died:
                self._end()
                if died.at is None or (what == "verdict" and died.at == name and not died.late):
                    return None  # the search may have ended it
                lines = self._explained(died)
                if sections := [section for section in self.course.sections if self.path(section).name == died.at]:
                    text = Text(*("\n".join(line.of(k) for line in lines) for k in ("en", "zh")))
                    self._modules[sections[0]] = unreadable[sections[0]] = text
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
        if exercise.needs and not died.late:
            lines.insert(1, message("ended in", name=exercise.needs.title()))
        tried = cases(part, self.seed)
        k = min(max(died.call, 0), len(tried) - 1)  # further calls look for what is wrong
        case: Case = failing_case(exercise, part, k, self.seed, tried[k])
        return Verdict("wrong", (message("head", id=exercise.id, name=part.name), *lines), (), case)

    def _explained(self, died: Died) -> list[Text]:
        """Return why the process ended, and at which line of the student's."""
        lines = [message("endless", seconds=f"{self.time_limit:g}") if died.late else message("ended")]
        for path, number in re.findall(r'File "(.+)", line (\d+) in', died.trace):
            if not is_ours(path) and (line := _line(path, int(number))):
                lines += [*at_line(path, number), Text("    " + line, "    " + line)]
                break
        return lines


def _line(path: str, number: int) -> str:
    """Return a line of a student's file, or of a cell; empty where there is none."""
    try:
        source = decode_source(content(Path(path)))
    except (OSError, SyntaxError, UnicodeError, ValueError):
        source = "".join(linecache.getlines(path)) if path in linecache.cache else ""  # a cell
    return "".join(source.splitlines()[number - 1 : number]).strip()
