"""From a wrong answer to what went wrong: the explanations that are tried, one after the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ..changes.likeness import blames
from ..changes.planets import earthbound, on_earth
from ..changes.repair import Repair
from ..changes.sound import has_whole
from ..changes.written import text_written
from ..compare import values
from ..exercise import Exercise, Part
from ..words.phrases import say
from ..words.text import Text
from .aliases import missing_copies
from .matching import matching_slips, slips_by_piece, two_slips
from .messages import compared, comparison, cures, edited, indented, mended, named, named_by_piece, where
from .neighbours import Neighbours
from .own import borne_out, by_piece_borne_out, in_other_roles
from .properties import few_entries
from .relations import of_numbers, of_structure
from .wrong_answer import WrongAnswer, changes_after_error

__all__ = ["after_error", "explain"]

Explained = tuple[list[str], list[Text]]
"""The slips of the list that give exactly this answer, and the message."""

OF_RESULTS = 0.7
"""Of the time of a search, for all of several results that are looked at by themselves."""

Explanation = Callable[[WrongAnswer], Explained | None]


def explain(
    exercise: Exercise,
    part: Part,
    function: Callable[..., Any],
    answers: Sequence[Any],
    cases: Sequence[tuple[Any, ...]],
    again: Callable[[tuple[Any, ...]], Any] | None,
) -> Explained:
    """Explain the wrong answers of a function; `again` calls it with other arguments, None: nothing more is called.

    Returns
    -------
    slips : list of str
        Those that give exactly the same answer.
    lines : list of Text
        The message.
    """
    wrong = WrongAnswer(exercise, part, function, answers, cases, again)
    for explanation in (*EXPLANATIONS, *(OF_CODE if again else ())):
        found = explanation(wrong)
        if found is not None:
            return found
    return [], compared(wrong, wrong.steps.line() if again else None)


def after_error(part: Part, function: Callable[..., Any], cases: Sequence[tuple[Any, ...]]) -> list[Text]:
    """Report which change makes a function right that raises an error; nothing where none is found."""
    found = changes_after_error(part, function, cases)
    return cures(part, found, len(cases)) if found else []


def _two_names_of_one_array(wrong: WrongAnswer) -> Explained | None:
    copies = missing_copies(wrong.part, wrong.function, wrong.right, wrong.cases) if wrong.again else []
    return ([], [*copies, where(wrong)]) if copies else None


def _whole_numbers(wrong: WrongAnswer) -> Explained | None:
    """Report that it is wrong where arguments are whole numbers, and only there."""
    if all(map(has_whole, wrong.cases)) or not all(map(has_whole, wrong.wrong_cases)):
        return None
    return [], [say("whole numbers"), where(wrong)]


def _gravity_of_the_earth(wrong: WrongAnswer) -> Explained | None:
    """Report that gravity is 9.81 m/s², whatever the robot's is, where nothing else is wrong."""
    if not wrong.again or any(on_earth(c) is None for c in wrong.wrong_cases):
        return None
    found = earthbound(wrong.part, wrong.function, wrong.part.solution)
    return ([], [say("earthbound"), where(wrong)]) if found else None


def _either_order(wrong: WrongAnswer) -> Explained | None:
    """Report two results exchanged, or the line above them that has the same numbers the other way round."""
    if wrong.exchanged is None:
        return None
    written = text_written(wrong.function).split("\n")
    above = [x for x in wrong.whole_changes if not written[x.edit.line - 1].strip().startswith("return")]
    if not above:
        return None
    order = say("other order") if len(wrong.part.returns) == 2 else say("order of these", which=wrong.exchanged)
    either, every, here = [order, *(x.title() for x in above)], len(wrong.cases), say("numbers are")
    return [], [
        say("either"),
        *map(indented, either),
        say("either way", all=every, what=here) if every > 1 else say("either once", what=here),
        say("perhaps"),
        where(wrong),
    ]


def _slip_of_the_list(wrong: WrongAnswer) -> Explained | None:
    found = borne_out(wrong.part, wrong.alike, wrong.function, wrong.whole_changes) if wrong.alike else []
    if wrong.exchanged is not None and wrong.changes:
        found = [slip for slip in found if slip != "swapped-halves"]
    return (found, named(wrong, found)) if found else None


def _other_order(wrong: WrongAnswer) -> Explained | None:
    if wrong.exchanged is None:
        return None
    right = values(wrong.right[0], wrong.part.returns) or []
    halves = any(n >= 6 for x in right for n in getattr(x.array, "shape", ()))
    if "swapped-halves" not in wrong.alike or not halves:  # of results without halves it is the same
        same = [slip for slip in wrong.alike if slip == "swapped-halves"]
        return same, [say("like slip", title=wrong.exchanged, why=say("exchanged")), where(wrong)]
    slip, order = wrong.slip("swapped-halves"), say("exchanged")
    each = [
        say("slip of several", title=wrong.exchanged, why=order),
        say("slip of several", title=slip.title, why=slip.why),
    ]
    return ["swapped-halves"], [say("slips"), *each, where(wrong)]


def _exchanged_and_slip(wrong: WrongAnswer) -> Explained | None:
    """Report two results exchanged, and a slip of the list that gives them all in the other order."""
    for exchange, answers, right in wrong.other_orders() if not wrong.alike else ():
        if matching_slips(wrong.part, right, wrong.cases):
            continue  # the exchange is another slip as well
        for name in matching_slips(wrong.part, answers, wrong.cases):
            slip = wrong.slip(name)
            line = say("two slips", first=exchange, second=slip.title)
            return [name], [line, slip.why, say("perhaps"), where(wrong, slip.section)]
    return None


def _slip_in_each_result(wrong: WrongAnswer) -> Explained | None:
    if wrong.alike:
        return None
    found = slips_by_piece(wrong.part, wrong.function, wrong.answers, wrong.cases)
    if not found or not by_piece_borne_out(wrong.part, found, wrong.function, wrong.changes):
        return None
    *lines, read = named_by_piece(wrong, found)
    unsure = [say("perhaps")] if wrong.is_typed else []
    return list(dict.fromkeys(name for names in found.values() for name in names)), [*lines, *unsure, read]


def _structure(wrong: WrongAnswer) -> Explained | None:
    line = of_structure(wrong.part, wrong.answers) or of_numbers(wrong.part, wrong.answers, wrong.right)
    return ([], [line, where(wrong)]) if line is not None else None


def _change_of_a_line(wrong: WrongAnswer) -> Explained | None:
    if any(x.piece is not None for x in wrong.changes) and wrong.returned_elsewhere:
        return None
    return ([], mended(wrong, wrong.changes)) if wrong.changes else None


def _first_statement(wrong: WrongAnswer) -> Explained | None:
    found = wrong.first_statement if wrong.again else []
    return ([], mended(wrong, found)) if found else None


def _none_in_some(wrong: WrongAnswer) -> Explained | None:
    return ([], [say("none in some"), where(wrong)]) if any(answer is None for answer in wrong.answers) else None


def _another_quantity(wrong: WrongAnswer) -> Explained | None:
    known = Neighbours(wrong.part, wrong.right, wrong.cases, wrong.until["known"]).lines(wrong.answers)
    return ([], [*known, where(wrong)]) if known else None


def _one_triangle(wrong: WrongAnswer) -> Explained | None:
    """Report that only one triangle of a symmetric matrix is right, where all that is wrong is one."""
    lines, part = comparison(wrong), wrong.part
    half = [say("is", what=x.label, relation=say(side)) for x in part.returns for side in ("upper", "lower")]
    return ([], [*lines, where(wrong)]) if lines and all(line in half for line in lines) else None


def _change_of_the_solution(wrong: WrongAnswer) -> Explained | None:
    """Report it where it is one, and explains all that is wrong."""
    if wrong.is_typed or wrong.by_chance:
        return None  # one of a few whole numbers is another one by chance
    if not wrong.edits or wrong.edits[0].edit.first or any(in_other_roles(wrong.function, x.edit) for x in wrong.edits):
        return None
    if wrong.edits[0].piece is not None and len(wrong.edits) < len(wrong.wrong_results):
        return None
    return [], edited(wrong)


def _two_changes(wrong: WrongAnswer) -> Explained | None:
    found = wrong.two_changes()
    return ([], mended(wrong, found)) if found else None


def _change_and_slip(wrong: WrongAnswer) -> Explained | None:
    """Report a change of a line after which the numbers are those of a slip of the list."""
    if not wrong.again or (found := wrong.nearer.change_and_slip()) is None:
        return None
    edit, name = found
    if blames(edit) and wrong.steps.right_line(edit.line):
        return None  # it makes the slip that shows then
    slip = wrong.slip(name)
    line = say("two changes", first=Repair(edit).title(), second=slip.title)
    return [name], [line, slip.why, say("perhaps"), where(wrong, slip.section)]


def _two_slips_of_the_list(wrong: WrongAnswer) -> Explained | None:
    given = wrong.part, wrong.answers, wrong.cases
    if wrong.alike or wrong.by_chance or few_entries(*given) or (pair := two_slips(*given)) is None:
        return None
    first, second = map(wrong.slip, pair)
    line = say("two slips", first=first.title, second=second.title)
    return list(pair), [line, first.why, second.why, say("perhaps"), where(wrong, first.section)]


def _each_result(wrong: WrongAnswer) -> Explained | None:
    """Report what is wrong in each of several results, where something is found in one of them."""
    if len(wrong.wrong_results) < 2:
        return None
    lines, names, found = [], [], []
    for k in wrong.wrong_results:
        alone = wrong.of_result(k, OF_RESULTS / len(wrong.wrong_results))
        twin = wrong.same_as(k)
        if twin is not None:
            explained: Explained | None = [], [say("the same", other=twin), where(alone)]
        else:
            explained = next(filter(None, (explanation(alone) for explanation in OF_ONE_RESULT)), None)
        found.append(explained is not None)
        slips, shown = explained or ([], [say("it shows"), *map(indented, comparison(alone)), where(alone)])
        names += slips
        lines += [say("in result", name=wrong.part.returns[k].title), *map(indented, shown[:-1])]
    enough = all(found) if wrong.is_typed else any(found)  # one of two numbers alone is met by chance
    return ([*dict.fromkeys(names)], [*lines, where(wrong)]) if enough else None


def _rest_of_the_solution(wrong: WrongAnswer) -> Explained | None:
    """Report two changes of a right solution, or one that does not explain all."""
    if wrong.is_typed or wrong.by_chance:
        return None
    other = any(in_other_roles(wrong.function, x.edit) for x in wrong.edits)
    return ([], edited(wrong)) if wrong.edits and not other else None


EXPLANATIONS: tuple[Explanation, ...] = (
    _whole_numbers,
    _gravity_of_the_earth,
    _two_names_of_one_array,
    _either_order,
    _slip_of_the_list,
    _other_order,
    _exchanged_and_slip,
    _slip_in_each_result,
    _structure,
    _change_of_a_line,
    _first_statement,
    _none_in_some,
    _another_quantity,
    _one_triangle,
)
"""What a wrong answer may be, the likeliest first."""

OF_CODE: tuple[Explanation, ...] = (
    _change_of_the_solution,
    _two_changes,
    _change_and_slip,
    _two_slips_of_the_list,
    _each_result,
    _rest_of_the_solution,
)
"""What is tried where the student's function may be called again."""

OF_ONE_RESULT = [x for x in (*EXPLANATIONS, *OF_CODE) if x is not _two_changes]
"""What is tried for one of several results: two changes that make it right may spoil another."""
