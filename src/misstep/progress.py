"""A student's progress: a row for each section, and the next exercise."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from os import PathLike
from typing import Literal

from .course import Course
from .folder.workbook import Unread, Workbook
from .judge import State
from .processes.isolation import TIME_LIMIT, opened
from .text import Language, Text, columns

__all__ = ["Row", "Status", "status"]

WIDTH = 12

SAY = {
    "to do": Text("to do", "未做"),
    "done": Text("done", "完成"),
    "wrong": Text("wrong", "有误"),
    "total": Text("total", "合计"),
    "next": Text("Next: {id} {title}, in {file}", "下一题：{id} {title}（{file}）"),
    "rest": Text("{next}: {names} is still missing", "{next}：还缺 {names}"),
    "fix": Text("To mend: {ids}", "待改正：{ids}"),
    "read": Text("To mend first, since it cannot be read: {files}", "无法读取，先改好：{files}"),
    "borrowed": Text("On the reference until yours is right: {names}", "你的实现正确之前使用参考实现：{names}"),
    "comma": Text(", ", "、"),
    "finished": Text("All done.", "全部完成。"),
}


@dataclass(frozen=True)
class Row:
    """The progress in one section: the state of each of its exercises."""

    section: str
    states: dict[str, State]

    def count(self, state: State) -> int:
        """Return how many exercises are in a state."""
        return list(self.states.values()).count(state)


@dataclass(frozen=True)
class Status:
    """The progress in all sections; prints as a table.

    Attributes
    ----------
    course : Course
    rows : tuple of Row
        One for each section.
    borrowed : tuple of str
        Functions that later exercises took from the reference.
    rest : dict
        Of an exercise that is begun, by its number: the names of what is not yet written.
    unread : tuple of str
        Sections whose files cannot be read.
    """

    course: Course
    rows: tuple[Row, ...]
    language: Language
    borrowed: tuple[str, ...] = ()
    rest: dict[str, tuple[str, ...]] = field(default_factory=dict)
    unread: tuple[str, ...] = ()

    @property
    def done(self) -> int:
        """Return how many exercises are done."""
        return sum(row.count("done") for row in self.rows)

    @property
    def total(self) -> int:
        """Return how many exercises there are."""
        return sum(len(row.states) for row in self.rows)

    def __str__(self) -> str:
        lines = [self._line(row.section, self.course.sections[row.section].of(self.language), row) for row in self.rows]
        every = Row("", {number: state for row in self.rows for number, state in row.states.items()})
        lines += ["", self._line("", self._say("total"), every) + f"  {100 * self.done // max(self.total, 1)} %"]
        return "\n".join([*lines, "", *self._advice(every)])

    def _say(self, phrase: str, **values: object) -> str:
        return SAY[phrase].fill(**values).of(self.language)

    def _line(self, section: str, title: str, row: Row) -> str:
        counts = {state: row.count(state) for state in row.states.values()}
        size = max(len(row.states), 1)
        full = round(WIDTH * counts.get("done", 0) / size)
        bar = "█" * full + "·" * (WIDTH - full)
        kinds: tuple[Literal["done", "wrong", "to do"], ...] = ("done", "wrong", "to do")
        said = self._say("comma").join(f"{counts[kind]} {self._say(kind)}" for kind in kinds if kind in counts)
        return f"{section:8}{title}{' ' * (28 - columns(title))}{bar}  {said}"

    def _advice(self, every: Row) -> list[str]:
        comma = self._say("comma")
        unread = [
            number for section in self.unread for row in self.rows if row.section == section for number in row.states
        ]
        wrong = [number for number, state in every.states.items() if state == "wrong" and number not in unread]
        waiting = [number for number, state in every.states.items() if state == "to do"]
        lines = [self._say("read", files=comma.join(map(self.course.file_name, self.unread)))] if self.unread else []
        lines += [self._say("fix", ids=comma.join(wrong))] if wrong else []
        if waiting and not unread:
            exercise = self.course.exercise(waiting[0])
            file = self.course.file_name(exercise.section)
            following = self._say("next", id=exercise.id, title=exercise.title, file=file)
            rest = comma.join(self.rest.get(exercise.id, ()))
            lines.append(self._say("rest", next=following, names=rest) if rest else following)
        if self.borrowed:
            lines.append(self._say("borrowed", names=comma.join(self.borrowed)))
        return lines or [self._say("finished")]


def status(
    course: Course,
    folder: str | PathLike[str] = ".",
    *,
    language: Language | None = None,
    seed: int | None = None,
    time_limit: float = TIME_LIMIT,
) -> Status:
    """Check every exercise of a folder and return the progress.

    Parameters
    ----------
    course : Course
    folder : str or path
        One that `start` has filled.
    language : {"en", "zh"}, optional
        Of the table; that of the folder unless given.
    seed : int, optional
        Of the random cases; drawn anew unless given.
    time_limit : float
        Seconds for one call of a function; 0 for none. The answers run in a process of their own, which is ended where
        they take longer; without a limit they run in this one.

    Returns
    -------
    Status

    Raises
    ------
    CourseError
        If nothing was started there.
    """
    Workbook.existing(course, folder)
    with opened(course, folder, language=language, seed=seed, time_limit=time_limit) as book:
        return survey(book)


def survey(book: Workbook) -> Status:
    """Return the status of a folder that is open."""
    rows: list[Row] = []
    rest: dict[str, tuple[str, ...]] = {}
    unread: list[str] = []
    for section in book.course.sections:
        found = {exercise.id: book.verdicts(exercise) for exercise in book.course.of_section(section)}
        rows.append(
            Row(section, {number: check_state(v.state for v in each.values()) for number, each in found.items()})
        )
        for number, each in found.items():
            names = tuple(name for name, verdict in each.items() if verdict.state == "to do")
            rest |= {number: names} if 0 < len(names) < len(each) else {}
        if any(isinstance(verdict, Unread) for each in found.values() for verdict in each.values()):
            unread.append(section)
    return Status(book.course, tuple(rows), book.language, tuple(sorted(book.borrowed)), rest, tuple(unread))


def check_state(states: Iterable[State]) -> State:
    """Return the state of an exercise with several parts: wrong if one is, done if all are."""
    found = set(states)
    if "wrong" in found:
        return "wrong"
    return "to do" if "to do" in found else "done"
