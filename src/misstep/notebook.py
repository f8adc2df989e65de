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
from .text import Language, say
from .verdict import LEVELS, State
from .workbook import Workbook, verdict_on_words

__all__ = ["check", "checked"]

_STATES: dict[str, State] = {}
"""What has been checked in this process, by the name of the function. For the progress only."""

_ASKED: dict[str, Language] = {}  # the language that was asked for last in this process


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
    if level not in LEVELS:
        raise CourseError(f"level: expected one of {LEVELS}, got {level!r}")
    known = {part.name: part for part in exercise.parts}
    given = functions
    if not functions and words is None:
        given = tuple(caller[name] for name in known if callable(caller.get(name))) if caller else ()
        if not given:
            expected = f"expected a function of {number} ({', '.join(known)})"
            raise CourseError(f"check: {expected}, got none, and none is defined here")
    _ASKED.update({} if language is None else {"language": language})
    book = Workbook(course, ".", language=_ASKED.get("language"), seed=drawn(seed))
    limit = checked_limit(time_limit)
    book.watch = lambda name: interrupted(limit)
    verdicts = {}
    for function in given:
        part = _part(exercise, known, function, alone=len(functions) == 1)
        verdicts[part.name] = book.judge_function(exercise, part, function)
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
    """Add a line about the section."""
    _STATES.update({name: verdict.state for name, verdict in found.functions.items()})
    section = found.exercise.section
    every = found.exercise.course.of_section(section)
    done = [all(_STATES.get(part.name) == "done" for part in exercise.parts) for exercise in every]
    text = "Section {section}: {bar}  {done} of {all} exercises", "{section} 节：{bar}  {done}/{all} 题"
    line = say(*text, section=section, bar="".join("○●"[x] for x in done), done=sum(done), all=len(done))
    return replace(found, progress=line.of(found.language))


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
