"""A student's progress: a row for each section, and the next exercise."""

from __future__ import annotations

from dataclasses import dataclass, field
from os import PathLike

from .checked import STATES, WORDS
from .course import Course
from .isolation import TIME_LIMIT_S, opened
from .text import Language, Text, columns, say
from .verdict import State, Unread
from .workbook import Workbook

__all__ = ["Row", "Status", "status", "survey"]

WIDTH = 12  # of the bar of a section
COMMA = Text(", ", "、")
READ = Text("To mend first, since it cannot be read: {files}", "无法读取，先改好：{files}")
BORROWED = Text("On the reference until yours is right: {names}", "你的实现正确之前使用参考实现：{names}")
NEXT, REST = Text("Next: {id} {title}, in {file}", "下一题：{id} {title}（{file}）"), Text("is still missing", "还缺")


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
        lines = [self._line(row, self.course.sections[row.section]) for row in self.rows]
        every = Row("", {number: state for row in self.rows for number, state in row.states.items()})
        lines += ["", self._line(every, Text("total", "合计")) + f"  {100 * self.done // max(self.total, 1)} %"]
        return "\n".join([*lines, "", *(line.of(self.language) for line in self._advice(every))])

    def _line(self, row: Row, title: Text) -> str:
        full, name = round(WIDTH * row.count("done") / max(len(row.states), 1)), title.of(self.language)
        counts = [f"{n} {text.of(self.language)}" for state, text in STATES.items() if (n := row.count(state))]
        bar = "█" * full + "·" * (WIDTH - full)
        return f"{row.section:8}{name}{' ' * (28 - columns(name))}{bar}  {COMMA.of(self.language).join(counts)}"

    def _advice(self, every: Row) -> list[Text]:
        comma, lines = COMMA.of(self.language), list[Text]()
        unread = {number for row in self.rows if row.section in self.unread for number in row.states}
        wrong = [number for number, state in every.states.items() if state == "wrong" and number not in unread]
        waiting = [number for number, state in every.states.items() if state == "to do"]
        if self.unread:
            lines.append(READ.fill(files=comma.join(map(self.course.file_name, self.unread))))
        if wrong:
            lines.append(say("To mend: {ids}", "待改正：{ids}", ids=comma.join(wrong)))
        if waiting and not unread:
            exercise = self.course.exercise(waiting[0])
            line = NEXT.fill(id=exercise.id, title=exercise.title, file=self.course.file_name(exercise.section))
            if rest := comma.join(self.rest.get(exercise.id, ())):
                line = Text(f"{line.en}: {rest} {REST.en}", f"{line.zh}：{REST.zh} {rest}")
            lines.append(line)
        if self.borrowed:
            lines.append(BORROWED.fill(names=comma.join(self.borrowed)))
        return lines or [Text("All done.", "全部完成。")]


def status(
    course: Course,
    folder: str | PathLike[str] = ".",
    *,
    language: Language | None = None,
    seed: int | None = None,
    time_limit: float = TIME_LIMIT_S,
) -> Status:
    """Check every exercise of a folder that was started, in another process, and return the progress."""
    with opened(course, folder, language=language, seed=seed, time_limit=time_limit) as book:
        book.must_be_started()
        return survey(book)


def survey(book: Workbook) -> Status:
    """Return the status of a folder that is open."""
    rows: list[Row] = []
    rest: dict[str, tuple[str, ...]] = {}
    unread: list[str] = []
    for section in book.course.sections:
        found = [book.checked(exercise) for exercise in book.course.of_section(section)]
        rows.append(Row(section, {one.exercise.id: one.state for one in found}))
        for one in found:
            missing = [name for name, verdict in one.verdicts.items() if verdict.state == "to do"]
            if 0 < len(missing) < len(one.verdicts):
                names = {WORDS: one.exercise.answer_name}
                rest[one.exercise.id] = tuple(names.get(name, name) for name in missing)
        if any(isinstance(verdict, Unread) for one in found for verdict in one.verdicts.values()):
            unread.append(section)
    return Status(book.course, tuple(rows), book.language, tuple(sorted(book.borrowed)), rest, tuple(unread))
