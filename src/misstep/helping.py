"""Hints one at a time, and solutions on request."""

from __future__ import annotations

from contextlib import suppress
from os import PathLike

from .course import Course
from .isolation import opened
from .skeletons import solution_sources
from .text import Language, Text, say, wrapped
from .workbook import Workbook

__all__ = ["hint", "solution"]

LAST = Text(
    "That was the last one. The solution: {command} solution {id}",
    "提示已全部给出。查看解答：{command} solution {id}",
)
FORGOTTEN = Text(
    "Asked in the folder of your answers (or with --dir), the next one comes the next time; --all shows all.",
    "在答案目录中运行（或用 --dir 指定该目录），下次就给出下一条；--all 显示全部提示。",
)
LATER = Text(
    "The model answer is shown once yours is written: fill in {name}.",
    "写下你自己的回答（填写 {name}）之后才显示参考答案。",
)


class Shown(str):
    """A text that a cell or a shell of Python shows as it is, with its lines, without ``print``."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def hint(
    course: Course,
    name: str,
    folder: str | PathLike[str] = ".",
    *,
    again: bool = False,
    every: bool = False,
    language: Language | None = None,
) -> str:
    """Return the next hint for an exercise, or the last one again. How many were given is remembered in the folder."""
    exercise, book = course.asked_for(name), Workbook(course, folder, language=language)
    number, language, n = exercise.id, book.language, len(exercise.hints)
    shown = int(book.state["hints"].get(number, 0))
    last = n if every else min(max(shown, 1) if again else shown + 1, n)
    is_remembered = _remember(book, exercise.section, hints={**book.state["hints"], number: max(shown, last)})
    lines: list[str] = []
    for k in range(1 if every else last, last + 1):
        title = say(
            "{id} {title}: hint {k} of {n}", "{id} {title}：提示 {k}/{n}", id=number, title=exercise.title, k=k, n=n
        )
        lines += [title.of(language), "", *wrapped(exercise.hints[k - 1].of(language)), ""]
    if last == n:
        lines.append(LAST.fill(id=number, command=course.command).of(language))
    elif not is_remembered:
        lines.append(FORGOTTEN.of(language))
    return Shown("\n".join(lines).rstrip("\n"))


def _has_file(book: Workbook, section: str) -> bool:
    return (book.folder / book.course.file_name(section)).exists()


def _remember(book: Workbook, section: str, **news: object) -> bool:
    """Write down what was shown, in a folder with the exercise that may be written to; return whether it is."""
    with suppress(OSError):
        if _has_file(book, section):
            book.remember(**news)
            return True
    return False


def solution(course: Course, name: str, folder: str | PathLike[str] = ".", *, language: Language | None = None) -> str:
    """Return a solution of an exercise, as it could stand in the student's file; that it was shown is remembered.

    It includes the model answer to a question in words once the student has answered it.
    """
    exercise, book = course.asked_for(name), Workbook(course, folder, language=language)
    number, language = exercise.id, book.language
    _remember(book, exercise.section, solutions=sorted({*book.state["solutions"], number}))
    head = say("{id} {title}: a solution", "{id} {title}：参考解答", id=number, title=exercise.title)
    lines = [head.of(language), *("\n" + source.rstrip() for source in solution_sources(exercise, language))]
    if exercise.answer is not None:
        has_words = False
        if _has_file(book, exercise.section):
            with opened(course, book.folder) as other:  # the file is read in a process of its own
                has_words = other.words(exercise) is not None
        line = Text("The model answer:", "参考答案：") if has_words else LATER.fill(name=exercise.answer_name)
        lines += ["", line.of(language), *(wrapped(exercise.answer.of(language)) if has_words else [])]
    return Shown("\n".join(lines))
