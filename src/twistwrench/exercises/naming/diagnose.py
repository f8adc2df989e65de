"""From a wrong answer to what went wrong: first the slips by name, then what the comparison shows."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from ..changes.nearer import Nearer
from ..changes.repairs import Repair, repair_of_blocks, repairs, text_written, two_repairs
from ..changes.search import Found, exchanged_results, found_edits, right_where
from ..compare import agree, values
from ..exercise import Exercise, Part
from ..slips import SLIPS, Slip
from ..statements.stepwise import Stepwise
from ..words.phrases import say
from ..words.text import Text
from .aliases import missing_copies
from .independence import not_used
from .matching import matching_slips, slips_by_piece, two_slips
from .neighbours import Neighbours
from .own import borne_out, by_piece_borne_out, own_lines, shown_in
from .properties import FEW, broken_property, few_entries
from .relations import describe, of_numbers, of_structure, of_truths
from .simplest import of_words, shared
from .steps import first_wrong

__all__ = ["after_error", "explain"]

Answers = Sequence[Any]
Cases = Sequence[tuple[Any, ...]]

SHARES = {"mended": 1.6, "stepped": 2.2, "known": 2.6, "edited": 3.2, "after": 3.7, "both": 4.8, "twice": 5.3}
"""Seconds until which each search may go on, of the processor: a busy machine finds the same."""


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
    nearer = Nearer(part, right, answers, cases)

    @cache
    def searched() -> list[Repair]:
        return repairs(part, function, right, answers, cases, until=until["mended"], nearer=nearer) if again else []

    if again and (copies := missing_copies(part, function, right, cases)):
        return [], [*copies, _where(exercise, exercise.section)]
    exchanged, alike = exchanged_results(part, answers, cases), matching_slips(part, answers, cases)
    found = borne_out(alike, function, [x for x in searched() if x.piece is None]) if alike else []
    if exchanged is not None:
        lines = text_written(function).split("\n")
        others = (x for x in searched() if x.piece is None and not lines[x.edit.line - 1].strip().startswith("return"))
        own = [x.title() for x in others]
        if own:  # his results are right in the other order, too
            either = [say("either"), *map(_indented, [say("other order"), *own]), say("either way", all=len(cases))]
            return [], [*either, _where(exercise, exercise.section)]
        found = [slip for slip in found if slip != "swapped-halves" or not searched()]
    if found:
        return found, _named(exercise, part, found, cases, searched())
    if exchanged is not None:
        return [], [say("slip", title=exchanged), say("exchanged"), _where(exercise, exercise.section)]
    if alike and not searched():
        slips = [_slip(exercise, part, name) for name in alike]
        return alike, [*(say("like slip", title=x.title, why=x.why) for x in slips), _where(exercise, slips[0].section)]
    pieces_found = None if alike else slips_by_piece(part, function, answers, cases)
    if pieces_found and by_piece_borne_out(part, pieces_found, function, searched()):
        names = list(dict.fromkeys(name for found in pieces_found.values() for name in found))
        return names, _named_by_piece(exercise, part, pieces_found)
    structure = of_structure(part, answers) or of_numbers(part, answers, right)
    if structure is not None:
        return [], [structure, _where(exercise, exercise.section)]
    if searched():
        return [], _mended(exercise, part, searched(), answers, cases)
    return _further(exercise, part, function, nearer, until, again)


def _further(
    exercise: Exercise,
    part: Part,
    function: Callable[..., Any],
    nearer: Nearer,
    until: dict[str, float],
    again: Callable[[tuple[Any, ...]], Any] | None,
) -> tuple[list[str], list[Text]]:
    """Explain what no slip of the list and no single change of the student's lines does."""
    given = function, nearer.right, nearer.answers, nearer.cases
    _, right, answers, cases = given
    steps = Stepwise(part, *given) if again else None
    mended = steps.one(until["stepped"], every=time.process_time() > until["mended"]) if steps else []
    if not mended and (known := Neighbours(part, right, cases, until["known"]).lines(answers)):
        return [], [*known, _where(exercise, exercise.section)]
    if again is None or steps is None:
        return [], _unexplained(exercise, part, answers, cases, right, None)
    edited = [] if mended else found_edits(part, answers, cases, until=until["edited"])
    if edited and not edited[0].edit.first:
        return [], _edited(exercise, part, function, edited, answers, cases)
    mended = (
        mended
        or two_repairs(part, function, nearer, cases[0], until["after"])
        or steps.two(until["both"])
        or repairs(part, *given, until=until["twice"], pairs=True)
    )
    if mended:
        return [], _mended(exercise, part, mended, answers, cases)
    pair = None if few_entries(part, answers, cases) else two_slips(part, answers, cases)
    if pair is not None:
        first, second = (_slip(exercise, part, name) for name in pair)
        line = say("two slips", first=first.title, second=second.title)
        return list(pair), [line, first.why, second.why, _where(exercise, first.section)]
    if edited:
        return [], _edited(exercise, part, function, edited, answers, cases)
    near = repair_of_blocks(nearer)
    if near is not None:
        return [], _nearer(exercise, part, near, answers, cases)
    return [], _unexplained(exercise, part, answers, cases, right, again, steps.line())


def _unexplained(
    exercise: Exercise,
    part: Part,
    answers: Answers,
    cases: Cases,
    right: Answers,
    again: Callable[[tuple[Any, ...]], Any] | None,
    place: Text | None = None,
) -> list[Text]:
    """Report what the comparison shows, from which place on, and on which arguments the answer depends wrongly."""
    lines = [say("no slip"), *(_indented(line) for line in _comparison(part, answers, cases))]
    lines += filter(None, [of_truths([*zip(answers, right)]), place])
    lines += shared(part, answers, right, cases)
    if again:
        lines += map(_indented, of_words(part, again, cases))
        lines += map(_indented, not_used(part, again, answers, right, cases))
        wrong = [c for a, b, c in zip(answers, right, cases) if not agree(part, a, b, c)]
        lines += filter(None, [right_where(part, again, wrong)])
    broken = broken_property(part, answers, cases)
    if broken is not None:
        lines.append(say("broken", text=broken))
    return [*lines, _where(exercise, exercise.section)]


def _edited(
    exercise: Exercise,
    part: Part,
    function: Callable[..., Any],
    found: list[Found],
    answers: Answers,
    cases: Cases,
) -> list[Text]:
    """Report which change of a right solution gives the answer, or each wrong thing of it."""
    own = all(shown_in(text_written(function), change.edit) for change in found)
    lines = [*_changes(part, found, cases, "edited" if own else "equal"), *_shortly(part, answers, cases)]
    step = first_wrong(part, found[0].edit.function, found[0].edit.within, cases[0])
    return [*lines, *([step] if step else []), _where(exercise, exercise.section)]


def _mended(exercise: Exercise, part: Part, found: list[Repair], answers: Answers, cases: Cases) -> list[Text]:
    """Report which change makes the student's own function right, or each wrong thing that it returns."""
    lines = [*_changes(part, found, cases, "mended"), *_shortly(part, answers, cases)]
    return [*lines, _where(exercise, exercise.section)]


def _changes(part: Part, found: Sequence[Found | Repair], cases: Cases, how: str) -> list[Text]:
    """Report each change, of all that is returned or of one piece, and in how many cases it was tried."""
    lines = []
    if len(found) > 1 and not any(change.piece is not None for change in found):
        lines = [say("either"), *(_indented(change.title()) for change in found)]
        return [*lines, say("either way", all=len(cases))]
    for change in found:
        if change.piece is None:
            lines.append(say("slip" if how != "equal" else "equal", title=change.title()))
        else:
            name = part.returns[change.piece].title
            lines.append(say("slip in" if how != "equal" else "equal in", name=name, title=change.title()))
    if how == "equal":
        return [*lines, say("equal cases", all=len(cases))] if len(cases) > 1 else lines
    if any(isinstance(change, Repair) and change.first is not None for change in found):
        return [*lines, say("mended both", all=len(cases))]
    return [*lines, say(how, all=len(cases)) if len(cases) > 1 else say(f"{how} once")]


def _nearer(exercise: Exercise, part: Part, near: Repair, answers: Answers, cases: Cases) -> list[Text]:
    """Report which change makes some blocks right, and what is wrong in the others."""
    lines = [say("slip in", name=name, title=near.title()) for name in near.blocks]
    shown = [_indented(line) for line in _comparison(part, answers, cases)]
    return [*lines, say("not all"), say("it shows"), *shown, _where(exercise, exercise.section)]


def after_error(part: Part, function: Callable[..., Any], cases: Cases) -> list[Text]:
    """Report which change makes a function right that raises an error; nothing where none is found."""
    right = [part.value(part.solution, arguments) for arguments in cases]
    given, start = (part, function, right, [None] * len(cases), cases), time.process_time()
    found = repairs(*given, until=start + SHARES["mended"]) or repairs(
        *given, until=start + SHARES["twice"], pairs=True
    )
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
    own = own_lines(mended, found)
    slips = [_slip(exercise, part, name) for name in found]
    if len(slips) == 1:
        wrong = part.slips.get(found[0])  # None where the student's line tells it from a slip with the same numbers
        within = getattr(wrong, "within", None)
        step = first_wrong(part, wrong, within, cases[0]) if wrong and within in part.beside else None
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
    """Explain what is wrong, piece by piece, in the first case; a factor only where it is the same in all."""
    tried = ((answer, part.value(part.solution, arguments), arguments) for answer, arguments in zip(answers, cases))
    wrong = [case for case in tried if not agree(part, *case)]
    pairs = [(values(a, part.returns) or [], values(b, part.returns) or []) for a, b, _ in wrong]
    lines = []
    for got, right, *others in zip(*(x for pair in pairs for x in pair)):
        shown = describe(got, right, part.rtol)
        elsewhere = [describe(a, b, part.rtol) for a, b in zip(others[::2], others[1::2])]
        lines += shown if _same_factors(shown, elsewhere) else describe(got, right, part.rtol, factors=())
    return lines


def _same_factors(shown: list[Text], elsewhere: list[list[Text]]) -> bool:
    """Whether no other case says another thing of what is off by a factor; where it is zero, none is said."""
    about = {line: line.en.partition(": ")[0] for line in shown if " by a factor of " in line.en}
    zero = say("zero").en  # what small numbers, divided by a thousand, are taken for
    return all(
        line in said or not any(x.en.startswith(what) and not x.en.endswith(zero) for x in said)
        for said in elsewhere
        for line, what in about.items()
    )
