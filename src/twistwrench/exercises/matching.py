"""The slips of the list that give the student's numbers, and which of them his own source bears out."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from .compare import Value, agree, close, values
from .exercise import Part
from .repairs import Repair, written
from .slips import SLIPS
from .wrong import swap

__all__ = ["MISHAPS", "borne_out", "by_own_line", "contradicted", "matching_slips", "slips_by_piece", "two_slips"]

Answers = Sequence[Any]
Cases = Sequence[tuple[Any, ...]]

SIGNS = ("cross-order", "lever-reversed")
"""Slips that give the same numbers: the sign of a cross product."""

MISHAPS = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, np.linalg.LinAlgError)

TRACES = {"transpose": (".T", ".mT", "transpose", "swapaxes"), "inverse": ("inv", "solve", "inverse")}
"""By what a slip that has the word in its name is recognised in a program."""

TWISTS: dict[str, Callable[[Any], Any]] = {
    "swapped-halves": swap,
    "transposed-answer": lambda x: np.asarray(x).mT,
    "degrees": lambda x: np.asarray(x) * 180 / np.pi,
    "thousand": lambda x: np.asarray(x) * 1000,
    "half-missing": lambda x: np.asarray(x) * 2,
}
"""Slips that can be made on top of any other: by these, two slips at once are recognised."""


def matching_slips(part: Part, answers: Answers, cases: Cases) -> list[str]:
    """Return the slips that give these very answers on all cases."""
    return [slip for slip, wrong in part.slips.items() if _matches(part, wrong, answers, cases)]


def borne_out(found: list[str], function: Callable[..., Any]) -> list[str]:
    """Return of several slips those for which the student's source speaks most: it transposes, it inverts."""
    source = written(function)
    if len(found) < 2 or source is None:
        return found

    def speaks(slip: str) -> int:
        words = [word for key, traces in TRACES.items() if key in slip for word in traces]
        return 1 if not words else 2 * any(word in source[0] for word in words)

    return [slip for slip in found if speaks(slip) == max(map(speaks, found))]


def by_own_line(found: list[str], mended: list[Repair]) -> list[str]:
    """Return of a cross product and its lever arm, which give one sign, that which the student's line has reversed."""
    edit = mended[0].edit if mended else None
    if edit is None or not {*found} & {*SIGNS} or edit.kind != "exchanged":
        return found
    if "cross(" in edit.right:
        return [*dict.fromkeys("cross-order" if slip in SIGNS else slip for slip in found)]
    if " - " in edit.right:
        return [*dict.fromkeys("lever-reversed" if slip in SIGNS else slip for slip in found)]
    return found


def contradicted(found: list[str], mended: list[Repair], exchanged: bool) -> bool:
    """Whether the student's own line shows another slip with the same numbers than the only one of the list.

    `exchanged`: all is right with two of the things that are returned exchanged.
    """
    edit = mended[0].edit if mended else None
    if edit is None or len(found) > 1:
        return False
    if found[0] == "visited-outward":
        return not any(word in edit.right + edit.wrong for word in ("range", "reversed", "[::-1]"))
    return found[0] == "swapped-halves" and edit.kind == "exchanged" and exchanged


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


def slips_by_piece(
    part: Part, function: Callable[..., Any], answers: Answers, cases: Cases
) -> dict[str, list[str]] | None:
    """Return the slips in each of several things returned, where every wrong one is explained by some slip.

    What the student's source does not have cannot have that slip.
    """
    if len(part.returns) == 1 or part.canonical is not None:
        return None
    split = [values(answer, part.returns) for answer in answers]
    right = [values(part.value(part.solution, arguments), part.returns) for arguments in cases]

    def same(first: list[list[Value] | None], second: list[list[Value] | None], k: int) -> bool:
        return all(a and b and close(a[k], b[k], part.rtol) for a, b in zip(first, second))

    every = range(len(part.returns))
    wrong = {k for k in every if not same(split, right, k)}
    first = next((n for n, (a, b) in enumerate(zip(split, right)) if not all(same([a], [b], k) for k in every)), 0)
    made = {}
    for slip, other in part.slips.items():
        once = _slipped(part, other, cases[first : first + 1])  # most are seen not to fit in one case
        if once and any(same(split[first : first + 1], [values(once[0], part.returns)], k) for k in wrong):
            made[slip] = [values(answer, part.returns) for answer in _slipped(part, other, cases) or []]
    made = {slip: found for slip, found in made.items() if found}
    touched = {slip: {k for k in every if not same(other, right, k)} for slip, other in made.items()}
    found, source = {}, written(function)
    for k in sorted(wrong):
        fitting = [slip for slip, other in made.items() if k in touched[slip] and same(split, other, k)]
        typed = not cases[0]  # numbers one by one
        fitting = [slip for slip in fitting if typed or touched[slip] <= wrong]  # it spoils nothing else
        found[part.returns[k].name] = [slip for slip in fitting if source is None or _traced(slip, source[0])]
    return found if all(found.values()) else None


def _traced(slip: str, source: str) -> bool:
    """Whether a slip in an inverse can be one of this source: it inverts, or returns what it names an inverse."""
    return "in the inverse" not in SLIPS[slip].title.en or any(word in source for word in TRACES["inverse"])


def two_slips(part: Part, answers: Answers, cases: Cases) -> tuple[str, str] | None:
    """Return two slips that together give these answers on all cases."""
    for second, twist in TWISTS.items():
        if second == "half-missing" and second not in part.slips:
            continue  # there is no half to be missed
        for first, wrong in part.slips.items():

            def both(*arguments: Any, wrong: Any = wrong, twist: Any = twist) -> Any:
                answer = wrong(*arguments)
                return tuple(map(twist, answer)) if isinstance(answer, tuple) else twist(answer)

            if first != second and _matches(part, both, answers, cases):
                return first, second
    return None
