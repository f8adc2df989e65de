"""The pytest plugin of a course: the module that a student's folder names in its pytest.ini imports its hooks.

Each function that an exercise asks for is a test, and so is each answer in words. What still is ``...``
is skipped as "to do". A test has the name of its exercise, ``49_3_1-...``, and the mark of its
section, ``s49_3``.
"""

from __future__ import annotations

import io
import re
import sys
from collections.abc import Iterable
from contextlib import ExitStack, suppress
from typing import Any, NoReturn

import pytest

from .checked import WORDS
from .commands import at_least
from .course import Course
from .exercise import Exercise
from .isolation import TIME_LIMIT_S, opened
from .progress import survey
from .text import Text, say, wrapped
from .verdict import LEVELS, Unread, Verdict
from .workbook import Workbook

__all__ = [
    *("SectionFile", "configure", "pytest_addoption", "pytest_collect_file"),
    *("pytest_pycollect_makemodule", "pytest_terminal_summary", "pytest_unconfigure"),
]

COMPARE = Text(
    "{id}: your functions are right. To compare with your own words, the model answer:",
    "{id}：函数都正确。请把你的回答与参考答案对照：",
)
UNREAD = Text("None of its answers can be checked until it can be read.", "文件能读取之后，才能检查其中的答案。")
SEED = Text(
    "The same random cases again: python -m pytest --seed {seed}", "再用同一批随机数据：python -m pytest --seed {seed}"
)

BOOKS = pytest.StashKey[dict[str, Workbook]]()
OPEN = pytest.StashKey[ExitStack]()
COURSE = pytest.StashKey[Course]()


def mark_of(section: str) -> str:
    """Return the mark of a section."""
    return "s" + section.replace(".", "_") if section[:1].isdigit() else section


def configure(config: pytest.Config, course: Course) -> None:
    """Announce the marks, and let ``-k 49_1`` mean section 49.1 and not 49.10 as well."""
    config.stash[COURSE], config.stash[BOOKS], config.stash[OPEN] = course, {}, ExitStack()
    if isinstance(sys.stdout, io.TextIOWrapper):  # as in `cli`; else pytest escapes a message, its line ends as well
        sys.stdout.reconfigure(errors="backslashreplace")
    for section, title in course.sections.items():
        config.addinivalue_line("markers", f"{mark_of(section)}: {title.en}")
    if config.option.keyword:
        config.option.keyword = re.sub(r"\b(\d+)_(\d+)\b", r"\1_\2_", config.option.keyword)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the time limit, the seed, and how much is told."""
    limit = "seconds for one call of an answer; 0 for none, as `breakpoint()` needs it (10)"
    parser.addoption("--time-limit", type=float, default=TIME_LIMIT_S, metavar="S", help=limit)
    seed = "of the random cases; drawn anew each time unless given"
    parser.addoption("--seed", type=at_least(0), metavar="N", help=seed)
    level = "how much is told of a wrong answer: 1 where and what kind (1), 2 which slip, 3 the cure; counted as hints"
    parser.addoption("--level", type=int, choices=LEVELS, default=1, help=level)


def pytest_unconfigure(config: pytest.Config) -> None:
    """End the processes that ran the answers."""
    config.stash[OPEN].close()


def pytest_collect_file(file_path: Any, parent: pytest.Collector) -> pytest.Collector | None:
    """Collect the files of the exercises."""
    course, books = parent.config.stash[COURSE], parent.config.stash[BOOKS]
    if file_path.name not in course.files:
        return None
    folder = str(file_path.parent)
    if folder not in books:
        how = {name: parent.config.getoption(name) for name in ("seed", "time_limit")}
        books[folder] = parent.config.stash[OPEN].enter_context(opened(course, folder, **how))
    made: SectionFile = SectionFile.from_parent(parent, path=file_path)
    made.section, made.book = course.files[file_path.name], books[folder]
    return made


def pytest_pycollect_makemodule(module_path: Any, parent: pytest.Collector) -> pytest.Collector | None:
    """Keep pytest from importing a student's file that is named: one that cannot be read would give a traceback."""
    is_students = module_path.name in parent.config.stash[COURSE].files
    return Nothing.from_parent(parent, path=module_path) if is_students else None


class Nothing(pytest.File):
    """A file without tests."""

    def collect(self) -> Iterable[pytest.Item]:
        """Yield no tests."""
        return []


class SectionFile(pytest.File):
    """The student's file of a section."""

    section: str
    book: Workbook
    is_reported = False
    """Whether it was reported that the file cannot be read."""

    def collect(self) -> Iterable[pytest.Item]:
        """Yield a test for each function and each answer in words."""
        for exercise in self.book.course.of_section(self.section):
            for name in [part.name for part in exercise.parts] + [WORDS] * (exercise.answer is not None):
                item: Answer = Answer.from_parent(self, name=f"{exercise.id.replace('.', '_')}-{name}")
                item.exercise, item.asked = exercise, name
                item.add_marker(mark_of(exercise.section))
                yield item


class Wrong(Exception):
    """A wrong answer; its argument is the message."""


class Answer(pytest.Item):
    """A function, or an answer in words, of an exercise."""

    parent: SectionFile
    exercise: Exercise
    asked: str

    def runtest(self) -> None:
        """Judge it."""
        language, verdict = self.parent.book.language, self._verdict()
        if isinstance(verdict, Unread):
            self._cannot_read(verdict)
        if verdict.state == "to do":
            name = self.exercise.answer_name if self.asked == WORDS else self.asked
            todo = say("to do: {id} {name}", "未做：{id} {name}", id=self.exercise.id, name=name)
            pytest.skip("  ".join(line.of(language) for line in (todo, *verdict.lines)))
        if verdict.state == "wrong":
            level = min(self.config.getoption("level"), self.parent.book.max_level)
            if self.asked != WORDS:
                part = self.exercise.part(self.asked)
                self.parent.book.remember_hints(self.exercise, part, verdict.stages(level))
            raise Wrong(verdict.report(language, level))

    def _cannot_read(self, verdict: Unread) -> NoReturn:
        """Report once why a file cannot be read, not again for each function in it."""
        why, none = (line.of(self.parent.book.language) for line in (verdict.lines[-1], UNREAD))
        if self.parent.is_reported:
            pytest.skip(why)
        self.parent.is_reported = True
        raise Wrong(f"{why}\n{none}")

    def _verdict(self) -> Verdict:
        book, exercise = self.parent.book, self.exercise
        if self.asked == WORDS:
            return book.verdict_in_words(exercise)
        return book.verdict(exercise, exercise.part(self.asked))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Show the message of a wrong answer as it is; of anything else the trace."""
        return str(excinfo.value) if isinstance(excinfo.value, Wrong) else super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Any, int | None, str]:
        """Return where the test is."""
        return self.path, None, self.name


def pytest_terminal_summary(terminalreporter: Any, exitstatus: int, config: pytest.Config) -> None:
    """Show model answers for comparison, each once, and how far the student is; nothing after an interrupt."""
    if exitstatus == pytest.ExitCode.INTERRUPTED:
        return
    for book in config.stash[BOOKS].values():
        for exercise in book.course.exercises:
            if exercise.answer is None or exercise.id in book.state["compared"] or not book.checked(exercise).right:
                continue
            terminalreporter.section(f"{exercise.id} {exercise.title.of(book.language)}")
            terminalreporter.write_line(COMPARE.fill(id=exercise.id).of(book.language))
            terminalreporter.write_line("\n" + "\n".join(wrapped(exercise.answer.of(book.language))))
            with suppress(OSError):  # a folder may be for reading only
                book.remember(compared=[*book.state["compared"], exercise.id])
        if not config.option.collectonly:
            terminalreporter.section(str(book.folder))
            terminalreporter.write_line(str(survey(book)))
            terminalreporter.write_line(SEED.fill(seed=book.seed).of(book.language))
