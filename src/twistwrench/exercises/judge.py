"""Judge one function of the student: to do, done or wrong, with a message."""

from __future__ import annotations

import copy
import inspect
import traceback
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, is_dataclass, replace
from importlib.util import find_spec
from typing import Any, Literal, NamedTuple

import numpy as np

from .calls import begin, copied, shown, silent
from .cases import cases, every_case, further_cases, special_cases
from .changes.repairs import guarded
from .compare import agree, copied_results, is_one_array, plain, to_do, unchanged
from .context import context_of
from .exercise import Exercise, Part
from .failing import Case, failing_case
from .naming.changing import changing_line
from .naming.diagnose import after_error, explain
from .naming.state import kept_in_module
from .rules import broken_rules, file_or_cell, is_ours
from .words.phrases import say
from .words.text import Text
from .words.wrapping import hanging

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
        The slips that give the same answer, keys of `slips.SLIPS`.
    case : Case, optional
        The first case in which the answer is wrong.
    """

    state: State
    lines: tuple[Text, ...] = ()
    slips: tuple[str, ...] = ()
    case: Case | None = None

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
        return Verdict("to do", (say("needs", name=exercise.needs),))
    broken, so_far, changes = broken_rules(part, function), _Compared([], [], [], []), dict[int, Text]()
    search = not exercise.needs if search is None else search
    for arguments in _trials(part, seed, so_far):
        kept = _copied_but_frozen(arguments)  # an answer may change a model that it is given
        try:
            with watch():
                answer, changed = _run(part, function, arguments)
        except NotImplementedError:
            return Verdict("to do")
        except _Stop as stop:
            if changes or not all(so_far.right):
                break  # what is wrong without an error comes first
            with silent():
                more = (
                    after_error(part, function, every_case(part, seed)) if search and isinstance(stop, _Raised) else []
                )
            case = failing_case(part, len(so_far.tried), seed, arguments)
            return Verdict("wrong", (_head(exercise, part), *stop.args, *more), (), case)
        if to_do(answer):
            return Verdict("to do")
        changes |= {len(so_far.tried): changed} if changed else {}
        known = part.value(part.solution, kept)
        so_far.add(arguments, answer, known, agree(part, answer, known, arguments))
        if not so_far.right[-1] and not agree(part, part.value(part.solution, arguments), known, arguments):
            model = _head(exercise, part), say("changed", name=part.arguments.partition(",")[0])  # it comes first
            return Verdict("wrong", model, (), failing_case(part, len(so_far.tried) - 1, seed, arguments))
    safe = guarded(function) if search else function
    again = (lambda given: _again(part, safe, given, watch)) if search else None
    state = _keeps(part, function, so_far, watch)
    noted = [*changes.values()][:1]
    for k in [*changes][:1]:
        noted += changing_line(part, function, so_far.tried[k])
    if all(so_far.right) and state is None:
        shown = [failing_case(part, k, seed, so_far.tried[k]) for k in changes][:1]
        lines = noted or broken or [say(phrase) for phrase in _made_one(so_far)][:1]
        return Verdict("wrong", (_head(exercise, part), *lines), (), *shown) if lines else Verdict("done")
    found = _wrong(exercise, part, function, so_far, seed, state, again)
    if noted and inspect.isclass(part.solution) and not found.slips:  # what is wrong comes of it
        k = so_far.first_wrong
        return Verdict("wrong", (*found.lines[:1], *noted), (), failing_case(part, k, seed, so_far.tried[k]))
    return replace(found, lines=(*found.lines[:1], *noted, *found.lines[1:]))


def _trials(part: Part, seed: int, so_far: _Compared) -> Iterator[tuple[Any, ...]]:
    """Yield the cases: those that are drawn first, further ones, and special ones unless one of these was wrong."""
    yield from cases(part, seed)
    yield from further_cases(part, seed)
    if all(so_far.right):
        yield from special_cases(part, seed)


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
    kept: Text | None,
    again: Callable[[tuple[Any, ...]], Any] | None,
) -> Verdict:
    """Return what is wrong, with the first case that shows it."""
    k = found.first_wrong
    if kept is not None:
        return Verdict("wrong", (_head(exercise, part), kept), (), failing_case(part, k, seed, found.tried[k]))
    with silent(), np.errstate(over="ignore"):  # a limit may be the largest number there is
        slips, lines = explain(exercise, part, function, found.answers, found.tried, again)
    case = failing_case(part, k, seed, found.tried[k], (found.expected[k], found.answers[k]))
    context = context_of(part, found.tried, found.right)
    return Verdict("wrong", (_head(exercise, part), *context, Text("", ""), *lines), tuple(slips), case)


def _keeps(part: Part, function: Callable[..., Any], found: _Compared, watch: Watch) -> Text | None:
    """Report that a function keeps something from one call to the next, if it does."""
    k, (tried, answers, expected, right) = found.first_wrong, found
    again = _again(part, function, tried[k], watch)
    if not agree(part, again, answers[k], tried[k]) and not _repeated(again, answers[k]):
        return say("kept")
    held = kept_in_module(part, function, [case for *case, good in zip(tried, expected, right) if not good])
    objects = [answer for answer, good in zip(answers, right) if good and isinstance(answer, np.ndarray | list)]
    if not right[k] and any(answers[k] is answer for answer in objects):
        return say("returned before")
    changed = all(right) and not all(map(agree, [part] * len(tried), answers, expected, tried))
    return say("returned before") if changed else held


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
    begin(arguments)
    try:
        answer = plain(part.value(function, given))
    except (KeyboardInterrupt, NotImplementedError):
        raise
    except BaseException as error:  # whatever the student's code raises becomes a message
        outside = isinstance(error, MemoryError | SystemExit)  # no slip of the mathematics
        raise (_Stop if outside else _Raised)(*_stopped(error)) from None
    for name, before, after in zip(part.arguments.split(", "), arguments, given):
        if not unchanged(before, after):
            changed = say("changed", name=name.partition("=")[0])
            return answer, say("changed term") if inspect.isclass(part.solution) else changed
    return answer, None


def _stopped(error: BaseException) -> list[Text]:
    """Report what was raised, and at which line of the student's file."""
    lines = [say("stopped", error=shown(error))]
    own = [f for f in traceback.extract_tb(error.__traceback__) if not is_ours(f.filename)]
    if own:
        frame = next((f for f in reversed(own) if f.line), own[-1])  # generated code has no line that can be shown
        lines.append(say("at line", file=file_or_cell(frame.filename), line=frame.lineno))
        lines.append(Text(f"    {frame.line}", f"    {frame.line}"))
    return lines


def _head(exercise: Exercise, part: Part) -> Text:
    return say("head", id=exercise.id, name=part.name)
