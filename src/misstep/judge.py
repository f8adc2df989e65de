"""Judge one function of the student: to do, done or wrong, with a message."""

from __future__ import annotations

import copy
import inspect
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, is_dataclass
from importlib.util import find_spec
from typing import Any, Literal, NamedTuple

import numpy as np

from .calls import copied, shown
from .cases import cases, every_case, further_cases, special_cases
from .compare import agree, copied_results, is_one_array, plain, to_do, unchanged
from .diagnose import Diagnosis, How, diagnose
from .exercise import Exercise, Part
from .failing import Case, failing_case
from .messages import message
from .rules import broken_rules, is_ours
from .state import at_line, changing_line, kept_in_module
from .text import Text, hanging

__all__ = ["State", "Verdict", "judge"]

Watch = Callable[[], AbstractContextManager[object]]
State = Literal["to do", "done", "wrong"]


@dataclass(frozen=True)
class Verdict:
    """The judgement of an answer, with its message.

    Attributes
    ----------
    state : {"to do", "done", "wrong"}
    lines : tuple of Text
        The message, line by line; empty for what is done.
    slips : tuple of str
        The slips that give the same answer, keys of the slips of the field.
    case : Case, optional
        The first case in which the answer is wrong.
    how : {"slip", "line", "reference", "structure", "located", "numbers"}
        By what it was found what is wrong, as in `diagnose`: "structure" also where no number is; empty unless wrong.
    """

    state: State
    lines: tuple[Text, ...] = ()
    slips: tuple[str, ...] = ()
    case: Case | None = None
    how: How | Literal[""] = ""

    def __post_init__(self) -> None:
        if self.state == "wrong" and not self.how:
            object.__setattr__(self, "how", "structure")

    def message(self, language: Literal["en", "zh"]) -> str:
        """Return the message in one language."""
        return "\n".join(piece for line in self.lines for piece in hanging(line.of(language)))

    def report(self, language: Literal["en", "zh"]) -> str:
        """Return the message, and below it the failing case with its numbers."""
        shown = "" if self.case is None else self.case.text(language)
        return self.message(language) + ("\n\n" + shown if shown else "")


class _Stop(Exception):
    """The student's function did not give an answer."""


class _Raised(_Stop):
    """It raised an error."""


def judge(
    exercise: Exercise,
    part: Part,
    function: Callable[..., Any],
    *,
    seed: int = 0,
    watch: Watch = nullcontext,
    search: bool | None = None,
) -> Verdict:
    """Compare a function with the reference on random cases.

    Parameters
    ----------
    exercise : Exercise
    part : Part
        Of the exercise.
    function : callable
        The student's.
    seed : int
        Of the random cases. The same seed gives the same verdict.
    watch : callable
        Gives a context for each call of the function, as to stop it after some time.
    search : bool, optional
        Look for the small change that explains a wrong answer. Another package may end the process at such a change:
        unless given, none is looked for where the exercise needs one.

    Returns
    -------
    Verdict
    """
    if exercise.needs and find_spec(exercise.needs) is None:
        return Verdict("to do", (message("needs", name=exercise.needs),))
    broken, so_far, changes = (
        broken_rules(exercise.course.rules, part, function),
        _Compared([], [], [], []),
        list[Text](),
    )
    search = not exercise.needs if search is None else search
    changed_in = 0  # the first case in which an argument is changed
    for arguments in _trials(exercise, part, seed, so_far):
        kept = _copied_but_frozen(arguments)  # an answer may change a model that it is given
        try:
            with watch():
                answer, changed = _run(part, function, arguments)
        except NotImplementedError:
            return Verdict("to do")
        except _Stop as stop:
            if changes or not all(so_far.right):
                break  # what is wrong without an error comes first
            case = failing_case(exercise, part, len(so_far.tried), seed, arguments)
            cure = _cure_of_error(exercise, part, function, seed) if search and isinstance(stop, _Raised) else None
            lines = (_head(exercise, part), *stop.args, *(cure.lines if cure else ()))
            return Verdict("wrong", lines, case=case, how="line" if cure else "located")
        if to_do(answer):
            return Verdict("to do")
        if changed and not changes:
            changes, changed_in = [changed], len(so_far.tried)
        known = part.value(part.solution, kept)
        so_far.add(arguments, answer, known, agree(part, answer, known, arguments))
        if not so_far.right[-1] and not agree(part, part.value(part.solution, arguments), known, arguments):
            model = _head(exercise, part), message("changed", name=part.arguments.partition(",")[0])  # it comes first
            return Verdict("wrong", model, case=failing_case(exercise, part, len(so_far.tried) - 1, seed, arguments))
    state = _keeps(part, function, so_far, watch)
    if changes:
        changes += changing_line(part, function, so_far.tried[changed_in], is_ours)
    if not all(so_far.right) or state is not None:
        return _wrong(exercise, part, function, so_far, seed, state, search, changes)
    remarks = changes or broken or [message(key) for key in _made_one(so_far)][:1]
    if not remarks:
        return Verdict("done")
    shown = failing_case(exercise, part, changed_in, seed, so_far.tried[changed_in]) if changes else None
    return Verdict("wrong", (_head(exercise, part), *remarks), case=shown)


def _trials(exercise: Exercise, part: Part, seed: int, so_far: _Compared) -> Iterator[tuple[Any, ...]]:
    """Yield the cases: those that are drawn first, further ones, and special ones unless one of these was wrong."""
    yield from cases(part, seed)
    yield from further_cases(exercise.course, part, seed)
    if all(so_far.right):
        yield from special_cases(exercise.course, part, seed)


class _Compared(NamedTuple):
    """The cases that were tried, and of each the student's answer, the right one, and whether they agree."""

    tried: list[tuple[Any, ...]]
    answers: list[Any]
    expected: list[Any]
    right: list[bool]

    def add(self, arguments: tuple[Any, ...], answer: Any, known: Any, agrees: bool) -> None:
        """Add a case."""
        self.tried.append(arguments)
        self.answers.append(answer)
        self.expected.append(known)
        self.right.append(agrees)

    @property
    def first_wrong(self) -> int:
        """The first case that is wrong, or the first of all."""
        return 0 if all(self.right) else self.right.index(False)


def _wrong(
    exercise: Exercise,
    part: Part,
    function: Callable[..., Any],
    found: _Compared,
    seed: int,
    state: Text | None,
    search: bool,
    changes: list[Text],
) -> Verdict:
    """Return what is wrong, with the first case that shows it."""
    k, head = found.first_wrong, _head(exercise, part)
    if state is not None:
        case = failing_case(exercise, part, k, seed, found.tried[k])
        return Verdict("wrong", (head, *changes, state), case=case)
    diagnosis = diagnose(
        part,
        function,
        found.answers,
        found.tried,
        exercise.course.field,
        special_cases=lambda: special_cases(exercise.course, part, seed),
        search_code=search,
    )
    if changes and inspect.isclass(part.solution) and not diagnosis.slips:  # what is wrong comes of it
        case = failing_case(exercise, part, k, seed, found.tried[k])
        return Verdict("wrong", (head, *changes), case=case)
    case = failing_case(exercise, part, k, seed, found.tried[k], (found.expected[k], found.answers[k]))
    count = [message("cases", wrong=found.right.count(False), all=len(found.right))] if found.tried[k] else []
    lines = (head, *changes, *count, *diagnosis.lines, _where(exercise, diagnosis.slips))
    return Verdict("wrong", lines, diagnosis.slips, case, diagnosis.how)


def _cure_of_error(exercise: Exercise, part: Part, function: Callable[..., Any], seed: int) -> Diagnosis | None:
    """Return the change after which a function that raises an error is right."""
    every = every_case(exercise.course, part, seed)
    found = diagnose(part, function, [None] * len(every), every, exercise.course.field)
    return found if found.how == "line" else None


def _keeps(part: Part, function: Callable[..., Any], found: _Compared, watch: Watch) -> Text | None:
    """Report that a function keeps something from one call to the next, if it does."""
    k, (tried, answers, expected, right) = found.first_wrong, found
    again = _again(part, function, tried[k], watch)
    if not agree(part, again, answers[k], tried[k]) and not _repeated(again, answers[k]):
        return message("kept")
    held = kept_in_module(part, function, [case for *case, good in zip(tried, expected, right) if not good])
    objects = [answer for answer, good in zip(answers, right) if good and isinstance(answer, np.ndarray | list)]
    if not right[k] and any(answers[k] is answer for answer in objects):
        return message("returned before")
    changed = all(right) and not all(map(agree, [part] * len(tried), answers, expected, tried))
    return message("returned before") if changed else held


def _made_one(found: _Compared) -> Iterator[str]:
    """Yield what is wrong where two of the things returned are one."""
    if is_one_array(found.answers[0]):
        yield "one array"
    if copied_results(found.answers, found.expected, found.expected):
        yield "one way"


def _repeated(first: Any, second: Any) -> bool:
    """Whether two answers are the same, as far as they are numbers."""
    if isinstance(first, tuple | list) and isinstance(second, tuple | list):
        return len(first) == len(second) and all(map(_repeated, first, second))
    try:
        return np.shape(first) == np.shape(second) and np.allclose(first, second, equal_nan=True)
    except (OverflowError, TypeError, ValueError):
        return True


def _copied_but_frozen(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return a copy of the arguments and of all that they hold, but for those that nothing can change."""
    return copy.deepcopy(arguments, {id(x): x for x in arguments if is_dataclass(x) and _is_frozen(x)})


def _is_frozen(x: Any) -> bool:
    return bool(x.__dataclass_params__.frozen)


def _again(part: Part, function: Callable[..., Any], arguments: tuple[Any, ...], watch: Watch) -> Any:
    """Call the student's function with other arguments; None where it stops."""
    try:
        with watch():
            return _run(part, function, arguments)[0]
    except (NotImplementedError, _Stop):
        return None


def _run(part: Part, function: Callable[..., Any], arguments: tuple[Any, ...]) -> tuple[Any, Text | None]:
    """Call the student's function on copies of the arguments; report whether it changes one, and where it stopped."""
    given = copied(arguments)
    try:
        answer = plain(part.value(function, given))
    except (KeyboardInterrupt, NotImplementedError):
        raise
    except BaseException as error:  # whatever the student's code raises becomes a message
        outside = isinstance(error, MemoryError | SystemExit)  # no slip of the mathematics
        raise (_Stop if outside else _Raised)(*_stopped(error)) from None
    for name, before, after in zip(part.arguments.split(", "), arguments, given):
        if not unchanged(before, after):
            changed = message("changed", name=name.partition("=")[0])
            return answer, message("changed term") if inspect.isclass(part.solution) else changed
    return answer, None


def _stopped(error: BaseException) -> list[Text]:
    """Report what was raised, and at which line of the student's file."""
    lines = [message("stopped", error=shown(error))]
    own = [f for f in traceback.extract_tb(error.__traceback__) if not is_ours(f.filename)]
    if own:
        frame = next((f for f in reversed(own) if f.line), own[-1])  # generated code has no line that can be shown
        lines += at_line(frame.filename, frame.lineno)
        lines.append(Text(f"    {frame.line}", f"    {frame.line}"))
    return lines


def _head(exercise: Exercise, part: Part) -> Text:
    return message("head", id=exercise.id, name=part.name)


def _where(exercise: Exercise, slips: Sequence[str]) -> Text:
    """Return where to read on."""
    section = exercise.course.field.slips[slips[0]].section if slips else exercise.section
    name = Text(f"§{section}", f" §{section}") if section[:1].isdigit() else message("project")
    return message("where", section=name, id=exercise.id, command=exercise.course.command)
