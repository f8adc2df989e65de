"""Check an answer where it is written: in a notebook's cell, a script, or a shell of Python."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from .calls import interrupted
from .checked import WORDS, Checked
from .course import Course
from .errors import CourseError, check_known
from .exercise import Exercise, Part
from .isolation import TIME_LIMIT_S, checked_limit, drawn
from .judge import ASK
from .text import Language, Text, say
from .verdict import LEVELS
from .workbook import Workbook, verdict_on_words

__all__ = ["check", "checked"]


def check(
    course: Course,
    number: str,
    *functions: Callable[..., Any],
    words: str | None = None,
    language: Language | None = None,
    seed: int | None = None,
    time_limit: float = TIME_LIMIT_S,
    level: int = 1,
    caller: Mapping[str, Any] | None = None,
) -> Checked:
    """Check an exercise where it is written: the functions given, or those of it among the names of the caller.

    A course's own `check` explains the arguments.
    """
    exercise = course.exercise(number)
    number = exercise.id
    if level not in LEVELS:
        raise CourseError(f"level: expected one of {LEVELS}, got {level!r}")
    known = {part.name: part for part in exercise.parts}
    given = functions
    if not functions and words is None:
        given = tuple(caller[name] for name in known if callable(caller.get(name))) if caller else ()
        if not given:
            expected = f"expected a function of {number} ({', '.join(known)})"
            raise CourseError(f"check: {expected}, got none, and none is defined here")
    session = course.session
    session.language = language or session.language
    book = Workbook(course, ".", language=session.language, seed=drawn(seed))
    limit = checked_limit(time_limit)
    book.watch = lambda name: interrupted(limit)
    verdicts = {}
    for function in given:
        part = _part(exercise, known, function, alone=len(functions) == 1)
        verdict = book.judge_function(exercise, part, function)
        ask = ASK.fill(call=f'{course.call}.hint("{part.name}")')
        verdicts[part.name] = replace(verdict, more=(*verdict.more[:1], *[ask] * bool(verdict.more)))
    if words is not None:
        verdicts[WORDS] = verdict_on_words(exercise, words)
    level = min(level, book.max_level)
    for name in verdicts.keys() & known.keys():
        book.remember_hints(exercise, known[name], verdicts[name].stages(level))
    found = Checked(exercise, verdicts, words, book.language, level=level, max_level=book.max_level)
    return _with_progress(replace(found, hints=book.hints(exercise)))


def checked(book: Workbook, exercise: Exercise) -> Checked:
    """Check an exercise as it stands in a student's folder."""
    return _with_progress(book.checked(exercise))


def _with_progress(found: Checked) -> Checked:
    """Add a line about the section, and remember the verdicts."""
    course, section = found.exercise.course, found.exercise.section
    course.session.verdicts.update(found.functions)
    right = {name for name, verdict in course.session.verdicts.items() if verdict.state == "done"}
    missing = {x.id: [part.name for part in x.parts if part.name not in right] for x in course.of_section(section)}
    done = [not names for names in missing.values()]
    text = "Section {section}: {bar}  {done} of {all} exercises", "{section} 节：{bar}  {done}/{all} 题"
    line = say(*text, section=section, bar="".join("○●"[x] for x in done), done=sum(done), all=len(done))
    rest = missing[found.exercise.id]
    if 0 < len(rest) < len(found.exercise.parts):
        names = Text(", ".join(rest), "、".join(rest))
        text = "{line}; of {id} there is still to check: {names}", "{line}；{id} 还有待检查的函数：{names}"
        line = say(*text, line=line, id=found.exercise.id, names=names)
    return replace(found, progress=line.of(found.language), are_functions_right=not rest)


def _part(exercise: Exercise, known: dict[str, Part], function: Callable[..., Any], *, alone: bool) -> Part:
    """Return the part of an exercise that a function answers: by its name, or the only one."""
    if not callable(function):
        expected = f"expected the function itself, as in check({exercise.id!r}, {exercise.parts[0].name})"
        raise TypeError(f"check: {expected}, got {type(function).__name__}")
    name = getattr(function, "__name__", "")
    if name not in known and alone and len(known) == 1:
        return exercise.parts[0]
    check_known(f"function of {exercise.id}", name, known, exercise.course.unknown)
    return known[name]
