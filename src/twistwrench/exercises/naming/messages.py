"""The messages about a wrong answer: slips with a name, changes, and what the comparison shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..changes.planets import earthbound, earthly_results
from ..changes.repair import Repair
from ..changes.search import Found, right_where
from ..changes.written import text_written
from ..compare import Value, agree, values
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text
from .finer import better_with_finer_steps
from .independence import not_used
from .own import own_lines
from .properties import FEW, broken_property
from .relations import describe, of_truths
from .simplest import of_words, shared
from .small import right_when_small
from .steps import first_wrong
from .wrong_answer import WrongAnswer

__all__ = [
    "compared",
    "comparison",
    "cures",
    "edited",
    "indented",
    "mended",
    "named",
    "named_by_piece",
    "where",
]


ROUGH = 1e-5
"""Part of the largest number to which a factor is looked for where numbers are not exact."""


def where(wrong: WrongAnswer, section: str | None = None) -> Text:
    """Report where it is read: the chapter's section, and the exercise."""
    section = section or wrong.exercise.section
    return say("where", section=say("project") if section == "project" else section, id=wrong.exercise.id)


def named(wrong: WrongAnswer, found: list[str]) -> list[Text]:
    """Name the slip, or those that it may be, and the line of the student's where it is."""
    part, own = wrong.part, own_lines(wrong.changes, found)
    if len(own) == 1 or not wrong.cases[0]:  # a number alone is met by chance
        own.append(say("perhaps"))
    slips = [wrong.slip(name) for name in found]
    if len(slips) == 1:
        made = part.slips.get(found[0])  # None where the student's line tells it from a slip with the same numbers
        within = getattr(made, "within", None)
        step = None
        if made and within in part.beside:
            step = first_wrong(part, made, within, wrong.cases[0], text_written(wrong.function))
        title, why = slips[0].title, slips[0].why
        like = say("like slip" if wrong.cases[0] else "like number", title=title, why=why)
        unsaid = wrong.again and not any(x.only == "earthbound" for x in wrong.changes)
        too = [say("earthbound too")] if unsaid and made and earthbound(part, wrong.function, made) else []
        lines = [like, *too, *own, *([step] if step else [])]
    else:
        each = [say("slip of several", title=x.title, why=x.why) for x in slips]
        lines = [say("slips"), *each, *own]
    return [*lines, where(wrong, slips[0].section)]


def named_by_piece(wrong: WrongAnswer, found: Mapping[str, list[str]]) -> list[Text]:
    """Name the slip in each thing that was returned; each reason once."""
    lines: list[Text] = []
    given, last = set[str](), wrong.exercise.section
    for name, slips in found.items():
        each = [wrong.slip(slip).title for slip in slips]
        k = [q.name for q in wrong.part.returns].index(name)
        other = wrong.transpose_of(k)
        if other is not None and lines:  # it comes from the one before
            lines.append(say("transposed as well", name=wrong.part.returns[k].title, other=other))
            continue
        title = Text(", or ".join(t.en for t in each), "，或 ".join(t.zh for t in each))
        quantity = next(q for q in wrong.part.returns if q.name == name)
        lines.append(say("like slip in", name=quantity.title, title=title))
        lines += [indented(wrong.slip(slip).why) for slip in slips if slip not in given]
        given.update(slips)
        last = wrong.slip(slips[0]).section
    return [*lines, *_earthly(wrong), where(wrong, last)]


def _earthly(wrong: WrongAnswer) -> list[Text]:
    """Report each thing returned that is right on the earth, and on other planets the same."""
    found = earthly_results(wrong.part, wrong.function) if wrong.again else []
    return [say("earthbound in", name=wrong.part.returns[k].title) for k in found]


def mended(wrong: WrongAnswer, found: list[Repair]) -> list[Text]:
    """Report which change makes the student's own function right, or each wrong thing that it returns."""
    lines = cures(wrong.part, found, len(wrong.cases), of_one=wrong.whole is not None)
    return [*lines, *_shortly(wrong), where(wrong)]


def edited(wrong: WrongAnswer) -> list[Text]:
    """Report which change of a right solution gives the answer, or each wrong thing of it."""
    found, part, every = wrong.edits, wrong.part, len(wrong.cases)
    lines = _each(part, found, "equal")
    lines += [say("equal cases", all=every)] if every > 1 else []
    step = first_wrong(part, found[0].edit.function, found[0].edit.within, wrong.cases[0])
    return [*lines, *_shortly(wrong), *([step] if step else []), where(wrong)]


def cures(part: Part, found: Sequence[Repair], every: int, *, of_one: bool = False) -> list[Text]:
    """Report changes that make all right that is returned, or each a piece of it, in all cases: in `every`.

    By their numbers the slip and what has the same effect cannot be distinguished: none is called the slip.
    `of_one`: of several things that are returned, only the one that is looked at.
    """
    both, pieces = any(change.is_two for change in found), {change.piece for change in found}
    (piece,) = pieces if len(pieces) == 1 else (None,)
    here = say("is then", name=part.returns[piece or 0].title) if of_one or piece is not None else say("numbers are")
    if len(found) > 1 and pieces == {None}:
        each = say("either both" if both else "either way", all=every, what=here)
        each = each if every > 1 else say("either once", what=here)
        return [say("either"), *(indented(change.title()) for change in found), each, say("perhaps")]
    lines = _each(part, found, "cure")
    whole = "mended both" if both else "mended each" if len(found) > 1 else "mended"
    once = "mended both once" if both else "mended once"
    remarks = [change.remark for change in found if change.remark is not None]
    last = remarks[0] if remarks else say("perhaps")
    return [*lines, say(whole, all=every, what=here) if every > 1 else say(once, what=here), last]


def _each(part: Part, found: Sequence[Found | Repair], phrase: str) -> list[Text]:
    """Report each change with a phrase, of all that is returned or of one piece of it."""
    return [
        say(phrase, title=x.title())
        if x.piece is None
        else say(f"{phrase} in", name=part.returns[x.piece].title, title=x.title())
        for x in found
    ]


def compared(wrong: WrongAnswer, place: Text | None = None) -> list[Text]:
    """Report what the comparison shows, from which place on, and on which arguments the answer depends wrongly."""
    part, right, cases, again = wrong.part, wrong.right, wrong.cases, wrong.again
    lines = [say("no slip"), *map(indented, comparison(wrong))]
    lines += filter(None, [of_truths([*zip(wrong.answers, right)])])
    telling: list[Text] = []
    if again:
        telling = [*map(indented, not_used(part, again, wrong.answers, right, cases))]
        telling += filter(None, [right_where(part, again, wrong.wrong_cases)])
        finer = better_with_finer_steps(part, wrong.function, wrong.wrong_cases[0])
        telling += finer or right_when_small(part, again, wrong.wrong_cases)
    lines += [place] if place is not None and not telling else []
    lines += shared(part, wrong.answers, right, cases)
    lines += map(indented, of_words(part, again, cases)) if again else []
    lines += telling
    broken = broken_property(part, wrong.answers, cases)
    return [*lines, *_earthly(wrong), *filter(None, [broken]), where(wrong)]


def comparison(wrong: WrongAnswer) -> list[Text]:
    """Report what is wrong, piece by piece, in the first case; a factor only where it is the same in all."""
    part, lines = wrong.part, []
    bad = [(a, b) for a, b, c in zip(wrong.answers, wrong.right, wrong.cases) if not agree(part, a, b, c)]
    pairs = [(values(a, part.returns) or [], values(b, part.returns) or []) for a, b in bad]
    for got, right, *others in zip(*(x for pair in pairs for x in pair)):
        beside = [*zip(others[::2], others[1::2])]
        shown = describe(got, right, part.rtol)
        elsewhere = [describe(a, b, part.rtol) for a, b in beside]
        if not _same_factors(shown, elsewhere):
            shown = describe(got, right, part.rtol, factors=())
        different = bool(shown) and all(x.en.endswith(say("different").en) for x in shown)
        lines += (_rough_factors([(got, right), *beside]) if different else []) or shown
    return lines


def _rough_factors(pairs: Sequence[tuple[Value, Value]]) -> list[Text]:
    """Report a factor that numbers are nearly off by, in most cases and the first, as differences of small steps are.

    Pairs have what a function returned and what is right.
    """
    nearly = [tuple(describe(a, b, ROUGH)) for a, b in pairs]
    factors = {x for x in nearly if any(" by a factor of " in line.en for line in x)}
    alone = len(factors) == 1 and all(" by a factor of " in line.en for line in nearly[0])
    return [say("nearly", found=x) for x in nearly[0]] if alone and 2 * nearly.count(nearly[0]) > len(nearly) else []


def _shortly(wrong: WrongAnswer) -> list[Text]:
    """Report what the comparison shows, where that is short and telling."""
    shown = comparison(wrong)
    if len(shown) > FEW or all(line.en.endswith(say("different").en) for line in shown):
        return []
    return [say("it shows"), *map(indented, shown)]


def indented(line: Text) -> Text:
    """Return a line two places to the right."""
    return Text("  " + line.en, "  " + line.zh)


def _same_factors(shown: list[Text], elsewhere: list[list[Text]]) -> bool:
    """Whether no other case says another thing of what is off by a factor; where it is zero, none is said."""
    about = {line: line.en.partition(": ")[0] for line in shown if " by a factor of " in line.en}
    zero = say("zero").en  # what small numbers, divided by a thousand, are taken for
    return all(
        line in said or not any(x.en.startswith(what) and not x.en.endswith(zero) for x in said)
        for said in elsewhere
        for line, what in about.items()
    )
