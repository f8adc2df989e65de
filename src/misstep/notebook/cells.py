"""Check an answer where it is written: in a notebook's cell, a script, or a shell of Python."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..course import Course
from ..errors import CourseError, check_known
from ..exercise import Exercise, Part
from ..folder.formulas import judge_formula
from ..folder.workbook import Workbook, verdict_on_words
from ..judge import State, Verdict
from ..processes.isolation import TIME_LIMIT, drawn, judged
from ..text import Language, Text, wrapped

__all__ = ["Checked", "check", "checked"]

SAY = {
    "done": Text("{id}  {name}: right.", "{id}  {name}：正确。"),
    "to do": Text("{id}  {name}: to do.", "{id}  {name}：未做。"),
    "words": Text("{id}  Your words, to compare with the model answer:", "{id}  请把你的回答与参考答案对照："),
    "progress": Text("Section {section}: {bar}  {done} of {all} exercises", "{section} 节：{bar}  {done}/{all} 题"),
}

_STATES: dict[str, dict[str, State]] = {}
"""What has been checked in this process: by exercise, the state of each of its functions. For the progress only."""

_ASKED: dict[str, Language] = {}
"""The language that was asked for last in this process."""


@dataclass(frozen=True, repr=False)
class Checked:
    """The verdicts on an exercise. A notebook shows them with the numbers side by side, and the hints one at a time.

    Attributes
    ----------
    exercise : Exercise
    verdicts : dict
        From the name of each function, and ``"words"``, to its verdict.
    words : str, optional
        The answer in words.
    language : {"en", "zh"}
    """

    exercise: Exercise
    verdicts: dict[str, Verdict]
    words: str | None
    language: Language

    @property
    def right(self) -> bool:
        """Whether everything that was checked is right."""
        return all(verdict.state == "done" for verdict in self.verdicts.values())

    @property
    def points(self) -> float:
        """The part of the exercise's functions that is right, from 0 to 1."""
        return sum(self.verdicts[name].state == "done" for name in self._names) / len(self.exercise.parts)

    @property
    def how(self) -> str:
        """By what it was found what is wrong, as in `misstep.diagnose`; empty where nothing is."""
        return next((verdict.how for verdict in self.verdicts.values() if verdict.state == "wrong"), "")

    @property
    def _names(self) -> list[str]:
        return [part.name for part in self.exercise.parts if part.name in self.verdicts]

    @property
    def progress(self) -> str:
        """How much of the section has been checked and is right, as a line."""
        section = self.exercise.course.of_section(self.exercise.section)
        done = [_is_done(exercise) for exercise in section]
        bar = "".join("●" if yes else "○" for yes in done)
        filled = SAY["progress"].fill(section=self.exercise.section, bar=bar, done=sum(done), all=len(done))
        return filled.of(self.language)

    def line(self, name: str) -> str:
        """Return the state of one function as a line."""
        verdict = self.verdicts[name]
        said = SAY[verdict.state if verdict.state != "wrong" else "done"].fill(id=self.exercise.id, name=name)
        return "  ".join(line.of(self.language) for line in (said, *verdict.lines))

    def __repr__(self) -> str:
        lines: list[str] = []
        for name, verdict in self.verdicts.items():
            lines += [verdict.report(self.language) if verdict.state == "wrong" else self.line(name), ""]
        if self.words and self.exercise.answer is not None:
            head = SAY["words"].fill(id=self.exercise.id).of(self.language)
            lines += [head, *wrapped(self.exercise.answer.of(self.language)), ""]
        return "\n".join([*lines, self.progress])

    def _repr_html_(self) -> str:
        from .markup import checked_html

        return checked_html(self)


def _is_done(exercise: Exercise) -> bool:
    known = _STATES.get(exercise.id, {})
    return all(known.get(part.name) == "done" for part in exercise.parts)


def check(
    course: Course,
    number: str,
    *functions: Callable[..., Any],
    words: str | None = None,
    language: Language | None = None,
    seed: int | None = None,
    time_limit: float = TIME_LIMIT,
    caller: Mapping[str, Any] | None = None,
    formulas: Mapping[str, str] | None = None,
) -> Checked:
    """Check an exercise where it is written: in a notebook, a script or a shell.

    Parameters
    ----------
    course : Course
    number : str
        Of the exercise.
    functions : callable
        The answers, in any order, matched by their names. Without any: those of the exercise that `caller` has.
    words : str, optional
        The answer in words, where the exercise asks for one; the model answer is then shown beside it.
    language : {"en", "zh"}, optional
        The one asked for last unless given; at first that of the folder or of the environment.
    seed : int, optional
        Of the random cases; drawn anew unless given.
    time_limit : float
        Seconds for one call; 0 for none.
    caller : mapping, optional
        The names where it is called.
    formulas : mapping, optional
        Answers typed as formulas, by the names of the functions.

    Returns
    -------
    Checked

    Raises
    ------
    UnknownName
        If there is no such exercise, or it has no function of that name.
    CourseError
        If there is nothing to check.
    """
    exercise = course.exercise(number)
    given = functions or (() if formulas or words else _of_caller(exercise, caller or {}))
    if not given and not formulas and words is None:
        names = ", ".join(part.name for part in exercise.parts)
        raise CourseError(f"check: expected a function of {number} ({names}), got none, and none is defined here")
    spoken, seed = _spoken(course, language), drawn(seed)
    verdicts = {}
    for function in given:
        part = _part(exercise, function, alone=len(functions) == 1)
        verdicts[part.name] = judged(exercise, part, function, seed=seed, time_limit=time_limit)
    for name, formula in (formulas or {}).items():
        check_known(f"function of {number}", name, [part.name for part in exercise.parts])
        verdicts[name] = judge_formula(exercise, course.find_part(name)[1], formula, seed=seed)
    _STATES.setdefault(number, {}).update({name: verdict.state for name, verdict in verdicts.items()})
    if words is not None:
        verdicts["words"] = verdict_on_words(exercise, words)
    return Checked(exercise, verdicts, words, spoken)


def _spoken(course: Course, asked: Language | None) -> Language:
    """Return the language asked for, and remember it; else the one asked for before."""
    if asked is not None:
        _ASKED["language"] = asked
    return _ASKED.get("language") or Workbook(course, ".").language


def checked(book: Workbook, exercise: Exercise) -> Checked:
    """Check an exercise as it stands in a student's folder."""
    verdicts = book.verdicts(exercise)
    _STATES.setdefault(exercise.id, {}).update({part.name: verdicts[part.name].state for part in exercise.parts})
    found = {"words" if name == exercise.answer_name else name: verdict for name, verdict in verdicts.items()}
    return Checked(exercise, found, book.words(exercise), book.language)


def _of_caller(exercise: Exercise, names: Mapping[str, Any]) -> Sequence[Callable[..., Any]]:
    """Return the functions of an exercise that are defined where it is checked."""
    return [names[part.name] for part in exercise.parts if callable(names.get(part.name))]


def _part(exercise: Exercise, function: Callable[..., Any], *, alone: bool) -> Part:
    """Return the part of an exercise that a function answers: by its name, or the only one."""
    if not callable(function):
        expected = f"expected the function itself, as in check({exercise.id!r}, {exercise.parts[0].name})"
        raise TypeError(f"check: {expected}, got {type(function).__name__}")
    known = {part.name: part for part in exercise.parts}
    name = getattr(function, "__name__", "")
    if name not in known and alone and len(known) == 1:
        return exercise.parts[0]
    check_known(f"function of {exercise.id}", name, tuple(known))
    return known[name]
