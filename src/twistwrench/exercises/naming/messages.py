"""The messages about a wrong answer: slips with a name, changes, and what the comparison shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..changes.likeness import by_detour
from ..changes.repair import Repair
from ..changes.repairs import text_written
from ..changes.search import Found, right_where
from ..compare import agree, values
from ..exercise import Part
from ..slips import SLIPS
from ..words.phrases import say
from ..words.text import Text
from .independence import not_used
from .own import own_lines, shown_in
from .properties import FEW, broken_property
from .relations import describe, of_truths
from .simplest import of_words, shared
from .small import right_when_small
from .steps import first_wrong
from .wrong_answer import WrongAnswer

__all__ = [
    "compared",
    "comparison",
    "edited",
    "indented",
    "mended",
    "named",
    "named_by_piece",
    "nearer",
    "titles",
    "where",
]


def where(wrong: WrongAnswer, section: str | None = None) -> Text:
    """Report where it is read: the chapter's section, and the exercise."""
    section = section or wrong.exercise.section
    return say("where", section=say("project") if section == "project" else section, id=wrong.exercise.id)


def named(wrong: WrongAnswer, found: list[str]) -> list[Text]:
    """Name the slip, or those that it may be, and the line of the student's where it is."""
    part, own = wrong.part, own_lines(wrong.changes, found)
    slips = [wrong.slip(name) for name in found]
    if len(slips) == 1:
        made = part.slips.get(found[0])  # None where the student's line tells it from a slip with the same numbers
        within = getattr(made, "within", None)
        step = first_wrong(part, made, within, wrong.cases[0]) if made and within in part.beside else None
        title, why = slips[0].title, slips[0].why
        head = [say("slip", title=title), why] if own else [say("like slip", title=title, why=why)]
        lines = [*head, *own, *([step] if step else [])]
    else:
        each = [say("slip of several", title=x.title, why=x.why) for x in slips]
        lines = [say("slips"), *each, *own]
    return [*lines, where(wrong, slips[0].section)]


def named_by_piece(wrong: WrongAnswer, found: Mapping[str, list[str]]) -> list[Text]:
    """Name the slip in each thing that was returned; each reason once."""
    lines, given, last = [], set(), wrong.exercise.section
    for name, slips in found.items():
        each = [SLIPS[slip].title for slip in slips]
        title = Text(", or ".join(t.en for t in each), "，或 ".join(t.zh for t in each))
        quantity = next(q for q in wrong.part.returns if q.name == name)
        lines.append(say("slip in", name=quantity.title, title=title))
        lines += [indented(wrong.slip(slip).why) for slip in slips if slip not in given]
        given.update(slips)
        last = wrong.slip(slips[0]).section
    return [*lines, where(wrong, last)]


def mended(wrong: WrongAnswer, found: list[Repair]) -> list[Text]:
    """Report which change makes the student's own function right, or each wrong thing that it returns."""
    return [*titles(wrong.part, found, "mended", len(wrong.cases)), *_shortly(wrong), where(wrong)]


def edited(wrong: WrongAnswer) -> list[Text]:
    """Report which change of a right solution gives the answer, or each wrong thing of it."""
    found, part, cases = wrong.edits, wrong.part, wrong.cases
    own = all(shown_in(text_written(wrong.function), change.edit) for change in found)
    step = first_wrong(part, found[0].edit.function, found[0].edit.within, cases[0])
    lines = titles(part, found, "edited" if own else "equal", len(cases))
    return [*lines, *_shortly(wrong), *([step] if step else []), where(wrong)]


def titles(part: Part, found: Sequence[Found | Repair], how: str, every: int) -> list[Text]:
    """Report each change, of all that is returned or of one piece, and in how many cases it was tried: in `every`."""
    if len(found) > 1 and not any(change.piece is not None for change in found):
        both = isinstance(found[0], Repair) and found[0].first is not None
        each = say("either both" if both else "either way", all=every) if every > 1 else say("either once")
        lines = [say("either"), *(indented(change.title()) for change in found), each]
        return [*lines, say("perhaps")] if all(by_detour(change.edit) for change in found) else lines
    lines, unsure = [], False
    for change in found:
        cure = isinstance(change, Repair) and (change.roundabout or change.doubted)
        begun, unsure = "equal" if how == "equal" else "cure" if cure else "slip", unsure or cure
        if change.piece is None:
            lines.append(say(begun, title=change.title()))
        else:
            lines.append(say(f"{begun} in", name=part.returns[change.piece].title, title=change.title()))
    if how == "equal":
        return [*lines, say("equal cases", all=every)] if every > 1 else lines
    both = any(isinstance(change, Repair) and change.first is not None and not change.one_piece for change in found)
    whole = "mended both" if both else "mended each" if how == "mended" and len(found) > 1 else how
    lines.append(say(whole, all=every) if every > 1 else say(f"{how} once"))
    return [*lines, say("perhaps")] if unsure else lines


def nearer(wrong: WrongAnswer, near: Repair) -> list[Text]:
    """Report which change makes some blocks right, and what is wrong in the others."""
    lines = [say("slip in", name=name, title=near.title()) for name in near.blocks]
    return [*lines, say("not all"), say("it shows"), *map(indented, comparison(wrong)), where(wrong)]


def compared(wrong: WrongAnswer, place: Text | None = None) -> list[Text]:
    """Report what the comparison shows, from which place on, and on which arguments the answer depends wrongly."""
    part, right, cases, again = wrong.part, wrong.right, wrong.cases, wrong.again
    lines = [say("no slip"), *map(indented, comparison(wrong))]
    lines += filter(None, [of_truths([*zip(wrong.answers, right)]), place])
    lines += shared(part, wrong.answers, right, cases)
    if again:
        lines += map(indented, of_words(part, again, cases))
        lines += map(indented, not_used(part, again, wrong.answers, right, cases))
        lines += filter(None, [right_where(part, again, wrong.wrong_cases)])
        lines += right_when_small(part, again, wrong.wrong_cases)
    broken = broken_property(part, wrong.answers, cases)
    if broken is not None:
        lines.append(say("broken", text=broken))
    return [*lines, where(wrong)]


def comparison(wrong: WrongAnswer) -> list[Text]:
    """Report what is wrong, piece by piece, in the first case; a factor only where it is the same in all."""
    part, lines = wrong.part, []
    bad = [(a, b) for a, b, c in zip(wrong.answers, wrong.right, wrong.cases) if not agree(part, a, b, c)]
    pairs = [(values(a, part.returns) or [], values(b, part.returns) or []) for a, b in bad]
    for got, right, *others in zip(*(x for pair in pairs for x in pair)):
        shown = describe(got, right, part.rtol)
        elsewhere = [describe(a, b, part.rtol) for a, b in zip(others[::2], others[1::2])]
        lines += shown if _same_factors(shown, elsewhere) else describe(got, right, part.rtol, factors=())
    return lines


def _shortly(wrong: WrongAnswer) -> list[Text]:
    """Report what the comparison shows, where that is short and telling."""
    shown = comparison(wrong)
    if len(shown) > FEW or all(line.en.endswith(say("other").en) for line in shown):
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
