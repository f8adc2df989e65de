"""Hints one at a time, and solutions on request."""

from __future__ import annotations

from os import PathLike

from .course import Course
from .exercise import Exercise
from .folder.sources import solution_sources
from .folder.workbook import Workbook
from .processes.isolation import opened
from .text import Language, Text, wrapped

__all__ = ["hint", "solution"]

SAY = {
    "hint": Text("{id} {title}: hint {k} of {n}", "{id} {title}：提示 {k}/{n}"),
    "last": Text(
        "That was the last one. The solution: {command} solution {id}",
        "提示已全部给出。查看解答：{command} solution {id}",
    ),
    "forgotten": Text(
        "Asked in the folder of your answers (or with --dir), the next one comes the next time; --all shows all.",
        "在答案目录中运行（或用 --dir 指定该目录），下次就给出下一条；--all 显示全部提示。",
    ),
    "solution": Text("{id} {title}: a solution", "{id} {title}：参考解答"),
    "model": Text("The model answer:", "参考答案："),
    "later": Text(
        "The model answer is shown once yours is written: fill in {name}.",
        "写下你自己的回答（填写 {name}）之后才显示参考答案。",
    ),
}


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
    """Return the next hint for an exercise. How many were given is remembered in the folder.

    Parameters
    ----------
    course : Course
    name : str
        The number of the exercise, as "49.3.1", or the name of one of its functions.
    folder : str or path
        One that `start` has filled. In any other, nothing is remembered, and each call returns the first hint.
    again : bool
        Repeat the last hint.
    every : bool
        All hints at once.
    language : {"en", "zh"}, optional
        That of the folder unless given.

    Returns
    -------
    str

    Raises
    ------
    UnknownName
        If there is no such exercise or function.
    """
    exercise, book = course.asked_for(name), Workbook(course, folder, language=language)
    number, spoken, n = exercise.id, book.language, len(exercise.hints)
    shown = int(book.state["hints"].get(number, 0))
    last = n if every else min(max(shown, 1) if again else shown + 1, n)
    remembered = _remember(book, exercise, hints={**book.state["hints"], number: max(shown, last)})
    lines: list[str] = []
    for k in range(1 if every else last, last + 1):
        title = SAY["hint"].fill(id=number, title=exercise.title, k=k, n=n).of(spoken)
        lines += [title, "", *wrapped(exercise.hints[k - 1].of(spoken)), ""]
    if last == n:
        return Shown("\n".join([*lines, SAY["last"].fill(id=number, command=course.command).of(spoken)]))
    return Shown("\n".join(lines[:-1] if remembered else [*lines, SAY["forgotten"].of(spoken)]))


def _remember(book: Workbook, exercise: Exercise, **news: object) -> bool:
    """Write down what was shown, in a folder with the exercise that may be written to; return whether it is."""
    if not (book.folder / book.course.file_name(exercise.section)).exists():
        return False
    try:
        book.remember(**news)
    except OSError:
        return False
    return True


def _has_words(book: Workbook, exercise: Exercise) -> bool:
    """Whether the student has answered in words; the file is read in a process of its own."""
    if not (book.folder / book.course.file_name(exercise.section)).exists():
        return False
    with opened(book.course, book.folder) as other:
        return other.words(exercise) is not None


def solution(course: Course, name: str, folder: str | PathLike[str] = ".", *, language: Language | None = None) -> str:
    """Return a solution of an exercise, as it could stand in the student's file.

    It includes the model answer to a question in words once the student has answered it. That it was shown is
    remembered in the folder.

    Parameters
    ----------
    course : Course
    name : str
        The number of the exercise, as "49.3.1", or the name of one of its functions.
    folder : str or path
        One that `start` has filled.
    language : {"en", "zh"}, optional
        That of the folder unless given.

    Returns
    -------
    str

    Raises
    ------
    UnknownName
        If there is no such exercise or function.
    """
    exercise, book = course.asked_for(name), Workbook(course, folder, language=language)
    number, spoken = exercise.id, book.language
    _remember(book, exercise, solutions=sorted({*book.state["solutions"], number}))
    lines = [SAY["solution"].fill(id=number, title=exercise.title).of(spoken)]
    lines += ["\n" + source.rstrip() for source in solution_sources(exercise, spoken)]
    if exercise.answer is not None:
        attempted = _has_words(book, exercise)
        said = SAY["model"] if attempted else SAY["later"].fill(name=exercise.answer_name)
        lines += ["", said.of(spoken), *(wrapped(exercise.answer.of(spoken)) if attempted else [])]
    return Shown("\n".join(lines))
