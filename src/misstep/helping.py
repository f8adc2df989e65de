"""Hints one at a time, and solutions on request."""

from __future__ import annotations

from os import PathLike

from .checked import ladder
from .course import Course, Session
from .isolation import opened
from .skeletons import solution_sources
from .text import Language, Text, say, wrapped
from .verdict import Verdict
from .workbook import Workbook, checksum

__all__ = ["hint", "solution"]

LAST = Text(
    "That was the last one. The solution: {call}",
    "提示已全部给出。查看解答：{call}",
)
FORGOTTEN = Text(
    "Asked in the folder of your answers (or with --dir), the next one comes the next time; --all shows all.",
    "在答案目录中运行（或用 --dir 指定该目录），下次就给出下一条；--all 显示全部提示。",
)
LATER = Text(
    "The model answer is shown once yours is written: fill in {name}.",
    "写下你自己的回答（填写 {name}）之后才显示参考答案。",
)


TO_DO, HERE = Verdict("to do"), "."


class Shown(str):
    """A text that a cell or a shell of Python shows as it is, with its lines, without ``print``."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def _session(course: Course, folder: str | PathLike[str]) -> Session:
    """Return what was checked in this process; nothing where a folder is asked for."""
    return course.session if str(folder) == HERE else Session()


def hint(
    course: Course,
    name: str,
    folder: str | PathLike[str] = HERE,
    *,
    again: bool = False,
    every: bool = False,
    language: Language | None = None,
) -> str:
    """Return the next hint for a function, or the last one again. Which were given is remembered in the folder.

    Of a wrong answer the first says which slip it is, and the last what to write instead. An exercise stands for the
    first of its functions that is wrong, or else is not right yet. What is not wrong in the folder may be so where it
    was checked last, as in a notebook.
    """
    exercise, session = course.asked_for(name), _session(course, folder)
    with opened(course, folder, language=language or session.language) as book:
        parts = [part for part in exercise.parts if part.name == name] or exercise.parts
        found = []
        for part in parts:
            verdict = book.verdict(exercise, part) if book.is_started else TO_DO
            found.append((part, verdict if verdict.state == "wrong" else session.verdicts.get(part.name, verdict)))
        states = [verdict.state for _, verdict in found]
        part, verdict = found[next((states.index(x) for x in ("wrong", "to do") if x in states), 0)]
        texts, language = ladder(part, verdict, book.max_level), book.language
        was_checked = part.name in session.verdicts
        shown = [*book.state["hints"].get(part.name, ()), *session.hints.get(part.name, ())]
        given = [k for k, text in enumerate(texts) if checksum(text) in shown]
        others = [k for k in range(len(texts)) if k not in given]
        following = given[-1:] if again and given else others[:1] or given[-1:]
        chosen = range(len(texts)) if every else following
        is_remembered = book.remember_hints(exercise, part, [texts[k] for k in chosen]) or was_checked
        if was_checked:
            session.hints.setdefault(part.name, []).extend(checksum(texts[k]) for k in chosen)
    lines: list[str] = []
    for k in chosen:
        title = say(
            "{id} {name}: hint {k} of {n}",
            "{id} {name}：提示 {k}/{n}",
            id=exercise.id,
            name=part.name,
            k=k + 1,
            n=len(texts),
        )
        lines += [title.of(language), "", *wrapped(texts[k].of(language)), ""]
    if not chosen or chosen[-1] == len(texts) - 1:
        in_python, in_shell = f'{course.call}.solution("{exercise.id}")', f"{course.command} solution {exercise.id}"
        lines.append(LAST.fill(call=in_python if was_checked else in_shell).of(language))
    elif not is_remembered:
        lines.append(FORGOTTEN.of(language))
    return Shown("\n".join(lines).rstrip("\n"))


def solution(course: Course, name: str, folder: str | PathLike[str] = HERE, *, language: Language | None = None) -> str:
    """Return a solution of an exercise, as it could stand in the student's file; that it was shown is remembered.

    It includes the model answer to a question in words once the student has answered it.
    """
    exercise = course.asked_for(name)
    book = Workbook(course, folder, language=language or _session(course, folder).language)
    number, language = exercise.id, book.language
    book.remember_shown(exercise.section, solutions=sorted({*book.state["solutions"], number}))
    head = say("{id} {title}: a solution", "{id} {title}：参考解答", id=number, title=exercise.title)
    lines = [head.of(language), *("\n" + source.rstrip() for source in solution_sources(exercise, language))]
    if exercise.answer is not None:
        has_words = False
        if book.path(exercise.section).exists():
            with opened(course, book.folder) as other:  # the file is read in a process of its own
                has_words = other.words(exercise) is not None
        line = Text("The model answer:", "参考答案：") if has_words else LATER.fill(name=exercise.answer_name)
        lines += ["", line.of(language), *(wrapped(exercise.answer.of(language)) if has_words else [])]
    return Shown("\n".join(lines))
