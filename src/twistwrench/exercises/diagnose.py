"""From a wrong answer to what went wrong: first the slips by name, then what the comparison shows."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from .compare import Value, agree, close, pieces, values
from .exercise import Exercise, Part
from .phrases import say
from .relations import describe
from .repairs import Repair, repairs, written
from .search import Found, exchanged_results, found_edits, right_where
from .slips import SLIPS, Slip
from .steps import first_wrong
from .text import Text
from .wrong import swap

__all__ = ["after_error", "explain", "matching_slips"]

Answers = Sequence[Any]
Cases = Sequence[tuple[Any, ...]]

NOTICEABLE = 1e-6
"""The least residual of a property that counts, for answers of the size of 1."""

SHARES = {"mended": 1.2, "edited": 2.2, "twice": 3.0}
"""Seconds until which each search may go on, of the processor: a busy machine finds the same."""

FEW = 3
"""Lines, or wrong entries, that are taken in at a glance."""

MISHAPS = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, np.linalg.LinAlgError)

TRACES = {"transpose": (".T", ".mT", "transpose", "swapaxes"), "inverse": ("inv", "solve", "inverse")}
"""By what a slip that has the word in its name is recognised in a program."""

TWISTS: dict[str, Callable[[Any], Any]] = {
    "swapped-halves": swap,
    "transposed-answer": lambda x: np.asarray(x).mT,
    "degrees": lambda x: np.asarray(x) * 180 / np.pi,
    "thousand": lambda x: np.asarray(x) * 1000,
}
"""Slips that can be made on top of any other: by these, two slips at once are recognised."""


def matching_slips(part: Part, answers: Answers, cases: Cases) -> list[str]:
    """Return the slips that give these very answers on all cases."""
    return [slip for slip, wrong in part.slips.items() if _matches(part, wrong, answers, cases)]


def _borne_out(found: list[str], function: Callable[..., Any]) -> list[str]:
    """Return of several slips those for which the student's source speaks most: it transposes, it inverts."""
    source = written(function)
    if len(found) < 2 or source is None:
        return found

    def speaks(slip: str) -> int:
        words = [word for key, traces in TRACES.items() if key in slip for word in traces]
        return 1 if not words else 2 * any(word in source[0] for word in words)

    return [slip for slip in found if speaks(slip) == max(map(speaks, found))]


def _matches(part: Part, wrong: Callable[..., Any], answers: Answers, cases: Cases) -> bool:
    for answer, arguments in zip(answers, cases):
        slipped = _slipped(part, wrong, [arguments])
        if slipped is None or not agree(part, answer, slipped[0], arguments):
            return False
    return True


def _slipped(part: Part, wrong: Callable[..., Any], cases: Cases) -> list[Any] | None:
    """Return the answers of a wrong implementation on all cases; None where it raises an error."""
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            return [part.value(wrong, arguments) for arguments in cases]
    except MISHAPS:
        return None


def slips_by_piece(part: Part, answers: Answers, cases: Cases) -> dict[str, list[str]] | None:
    """Return the slips in each of several things returned, where every wrong one is explained by some slip."""
    if len(part.returns) == 1 or part.canonical is not None:
        return None
    split = [values(answer, part.returns) for answer in answers]
    right = [values(part.value(part.solution, arguments), part.returns) for arguments in cases]
    tried = {slip: _slipped(part, wrong, cases) for slip, wrong in part.slips.items()}
    made = {slip: [values(answer, part.returns) for answer in found] for slip, found in tried.items() if found}

    def same(first: list[list[Value] | None], second: list[list[Value] | None], k: int) -> bool:
        return all(a and b and close(a[k], b[k], part.rtol) for a, b in zip(first, second))

    every = range(len(part.returns))
    wrong = {k for k in every if not same(split, right, k)}
    touched = {slip: {k for k in every if not same(other, right, k)} for slip, other in made.items()}
    found = {}
    for k in sorted(wrong):
        fitting = [slip for slip, other in made.items() if k in touched[slip] and same(split, other, k)]
        # a slip that would spoil a right part is less likely than one that would not
        found[part.returns[k].name] = [slip for slip in fitting if touched[slip] <= wrong] or fitting
    return found if all(found.values()) else None


def two_slips(part: Part, answers: Answers, cases: Cases) -> tuple[str, str] | None:
    """Return two slips that together give these answers on all cases."""
    for second, twist in TWISTS.items():
        for first, wrong in part.slips.items():

            def both(*arguments: Any, wrong: Any = wrong, twist: Any = twist) -> Any:
                answer = wrong(*arguments)
                return tuple(map(twist, answer)) if isinstance(answer, tuple) else twist(answer)

            if first != second and _matches(part, both, answers, cases):
                return first, second
    return None


def explain(
    exercise: Exercise,
    part: Part,
    function: Callable[..., Any],
    answers: Answers,
    cases: Cases,
    again: Callable[[tuple[Any, ...]], Any] | None,
) -> tuple[list[str], list[Text]]:
    """Explain the wrong answers of a function; `again` calls it with other arguments, None: nothing more is called.

    Returns
    -------
    slips : list of str
        Those that give exactly the same answer.
    lines : list of Text
        The message.
    """
    right = [part.value(part.solution, arguments) for arguments in cases]
    start = time.process_time()
    until = {how: start + seconds for how, seconds in SHARES.items()}
    found = _borne_out(matching_slips(part, answers, cases), function)
    if found:
        mended = repairs(part, function, right, answers, cases, until=until["mended"]) if again else []
        return found, _named(exercise, part, found, cases, [x for x in mended if x.edit.line])
    exchanged = exchanged_results(part, answers, cases)
    if exchanged is not None:
        return [], [say("slip", title=exchanged), say("exchanged"), _where(exercise, exercise.section)]
    pieces_found = slips_by_piece(part, answers, cases)
    if pieces_found:
        names = list(dict.fromkeys(name for found in pieces_found.values() for name in found))
        return names, _named_by_piece(exercise, part, pieces_found)
    structure = _structure(part, answers)
    if structure is not None:
        return [], [structure, _where(exercise, exercise.section)]
    mended = repairs(part, function, right, answers, cases, until=until["mended"]) if again else []
    if mended:
        return [], _mended(exercise, part, mended, answers, cases)
    edited = found_edits(part, answers, cases, until=until["edited"]) if again else []
    if edited and not edited[0].edit.first:
        return [], _edited(exercise, part, edited, answers, cases)
    mended = repairs(part, function, right, answers, cases, until=until["twice"], pairs=True) if again else []
    if mended:
        return [], _mended(exercise, part, mended, answers, cases)
    pair = None if _few_entries(part, answers, cases) else two_slips(part, answers, cases)
    if pair is not None:
        first, second = (_slip(exercise, part, name) for name in pair)
        line = say("two slips", first=first.title, second=second.title)
        return list(pair), [line, first.why, second.why, _where(exercise, first.section)]
    if edited:
        return [], _edited(exercise, part, edited, answers, cases)
    lines = [say("no slip"), *(_indented(line) for line in _comparison(part, answers, cases))]
    where = right_where(part, again, cases) if again else None
    if where is not None:
        lines.append(where)
    broken = _broken_property(part, answers, cases)
    if broken is not None:
        lines.append(say("broken", text=broken))
    return [], [*lines, _where(exercise, exercise.section)]


def _edited(exercise: Exercise, part: Part, found: list[Found], answers: Answers, cases: Cases) -> list[Text]:
    """Report which change of a right solution gives the answer, or each wrong thing of it."""
    lines = [*_changes(part, found, cases, "edited"), *_shortly(part, answers, cases)]
    step = first_wrong(part, found[0].edit.function, found[0].edit.within, cases[0])
    return [*lines, *([step] if step else []), _where(exercise, exercise.section)]


def _mended(exercise: Exercise, part: Part, found: list[Repair], answers: Answers, cases: Cases) -> list[Text]:
    """Report which change makes the student's own function right, or each wrong thing that it returns."""
    lines = [*_changes(part, found, cases, "mended"), *_shortly(part, answers, cases)]
    return [*lines, _where(exercise, exercise.section)]


def _changes(part: Part, found: Sequence[Found | Repair], cases: Cases, how: str) -> list[Text]:
    """Report each change, of all that is returned or of one piece, and in how many cases it was tried."""
    lines = []
    for change in found:
        if change.piece is None:
            lines.append(say("slip", title=change.title()))
        else:
            lines.append(say("slip in", name=part.returns[change.piece].title, title=change.title()))
    return [*lines, say(how, all=len(cases)) if len(cases) > 1 else say(f"{how} once")]


def after_error(part: Part, function: Callable[..., Any], cases: Cases) -> list[Text]:
    """Report which change makes a function right that raises an error; nothing where none is found."""
    right = [part.value(part.solution, arguments) for arguments in cases]
    given, start = (part, function, right, [None] * len(cases), cases), time.process_time()
    found = repairs(*given, until=start + SHARES["mended"]) or repairs(*given, until=start + SHARES["twice"], pairs=True)
    return _changes(part, found, cases, "mended") if found else []


def _shortly(part: Part, answers: Answers, cases: Cases) -> list[Text]:
    """Report what the comparison shows, where that is short and telling."""
    shown = _comparison(part, answers, cases)
    if len(shown) > FEW or all(line.en.endswith(say("other").en) for line in shown):
        return []
    return [say("it shows"), *map(_indented, shown)]


def _slip(exercise: Exercise, part: Part, name: str) -> Slip:
    """Return a slip with the reason that this part gives for it, if it has one of its own."""
    if name not in part.reasons:
        return SLIPS[name]
    return Slip(SLIPS[name].title, part.reasons[name], exercise.section)


def _named(exercise: Exercise, part: Part, found: list[str], cases: Cases, mended: list[Repair]) -> list[Text]:
    """Name the slip, or those that it may be, and the line of the student's where it is."""
    own = [say("own code", title=change.title()) for change in mended if change.piece is None]
    slips = [_slip(exercise, part, name) for name in found]
    if len(slips) == 1:
        wrong = part.slips[found[0]]
        within = getattr(wrong, "within", None)
        step = first_wrong(part, wrong, within, cases[0]) if within in part.beside else None
        return [
            say("slip", title=slips[0].title),
            slips[0].why,
            *own,
            *([step] if step else []),
            _where(exercise, slips[0].section),
        ]
    each = [Text(f"  - {s.title.en}. {s.why.en}", f"  - {s.title.zh}。{s.why.zh}") for s in slips]
    return [say("slips"), *each, *own, _where(exercise, slips[0].section)]


def _named_by_piece(exercise: Exercise, part: Part, found: dict[str, list[str]]) -> list[Text]:
    """Name the slip in each thing that was returned; each reason once."""
    lines, given, last = [], set(), exercise.section
    for name, slips in found.items():
        titles = [SLIPS[slip].title for slip in slips]
        title = Text(", or ".join(t.en for t in titles), "，或 ".join(t.zh for t in titles))
        quantity = next(q for q in part.returns if q.name == name)
        lines.append(say("slip in", name=quantity.title, title=title))
        lines += [_indented(_slip(exercise, part, slip).why) for slip in slips if slip not in given]
        given.update(slips)
        last = _slip(exercise, part, slips[0]).section
    return [*lines, _where(exercise, last)]


def _where(exercise: Exercise, section: str) -> Text:
    return say("where", section=say("project") if section == "project" else section, id=exercise.id)


def _indented(line: Text) -> Text:
    return Text("  " + line.en, "  " + line.zh)


def _comparison(part: Part, answers: Answers, cases: Cases) -> list[Text]:
    """Explain what is wrong with the first wrong answer, piece by piece."""
    tried = ((answer, part.value(part.solution, arguments), arguments) for answer, arguments in zip(answers, cases))
    wrong, expected, _ = next(case for case in tried if not agree(part, *case))
    got, right = values(wrong, part.returns), values(expected, part.returns)
    return [line for a, b in zip(got or [], right or []) for line in describe(a, b, part.rtol)]


def _few_entries(part: Part, answers: Answers, cases: Cases) -> bool:
    """Whether only a few entries are wrong: then two slips of the whole are not the likeliest explanation."""
    for answer, arguments in zip(answers, cases):
        pairs = zip(
            values(answer, part.returns) or (), values(part.value(part.solution, arguments), part.returns) or ()
        )
        wrong = 0
        for a, b in pairs:
            if a.array is None or b.array is None or a.array.shape != b.array.shape:
                return False
            wrong += int((~np.isclose(a.array, b.array)).sum())
        if wrong > FEW:
            return False
    return True


def _structure(part: Part, answers: Answers) -> Text | None:
    """Report that nothing was returned, or the wrong number of values."""
    for answer in answers:
        if answer is None:
            return say("none")
        if pieces(answer, part.returns) is None:
            names = Text(", ".join(q.name for q in part.returns), "、".join(q.title.zh for q in part.returns))
            return say("pieces", n=len(part.returns), names=names, got=_count(answer))
    return None


def _count(answer: Any) -> str:
    return str(len(answer)) if isinstance(answer, tuple | list) else type(answer).__name__


def _broken_property(part: Part, answers: Answers, cases: Cases) -> Text | None:
    """Return the first property of right answers that one of these lacks."""
    for item in part.properties:
        for answer, arguments in zip(answers, cases):
            try:
                residual = np.abs(np.asarray(item.residual(answer, *arguments), complex))
            except MISHAPS:
                return None
            if not (residual <= NOTICEABLE).all():
                return item.text
    return None
