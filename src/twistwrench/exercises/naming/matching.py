"""The slips of the list that give the student's numbers."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from itertools import combinations
from typing import Any

import numpy as np

from ..changes.written import text_written
from ..compare import Value, agree, close, values
from ..exercise import Part
from ..wrong import both, swap
from .own import traced

__all__ = ["MISHAPS", "matching_slips", "slips_by_piece", "two_slips"]

Answers = Sequence[Any]
Cases = Sequence[tuple[Any, ...]]

MISHAPS = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, np.linalg.LinAlgError)

COMPUTED = ("tw.", "mine(", "pin.", "for ", "while ")
"""What stands in a program that computes its numbers: in others each is typed in, and wrong by itself."""

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


def _matches(part: Part, wrong: Callable[..., Any], answers: Answers, cases: Cases) -> bool:
    for answer, arguments in zip(answers, cases):
        slipped = _slipped(part, wrong, [arguments])
        if slipped is None:
            return False
        if not agree(part, answer, slipped[0], arguments) and not _loses_nan(part, answer, slipped[0], arguments):
            return False
    return True


def _loses_nan(part: Part, answer: Any, slipped: Any, arguments: tuple[Any, ...]) -> bool:
    """Whether a slip gives numbers where nan is expected: which numbers, and whether always, is a matter of how."""
    three = [values(x, part.returns) or [] for x in (answer, slipped, part.value(part.solution, arguments))]
    lost = False
    for a, b, right in zip(*three):
        if right.array is None or right.array.dtype.kind != "f":
            return False
        nan = np.isnan(right.array)
        if any(x.array is None or x.array.shape != nan.shape for x in (a, b)) or np.isnan(b.array[nan]).any():
            return False
        lost = lost or bool(nan.any())
        rest, slipped_rest = (x._replace(array=np.where(nan, 0, x.array)) for x in (a, b))
        if not close(rest, slipped_rest, part.rtol):
            return False
    return lost


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
    found, source = {}, text_written(function)
    typed = not cases[0] and not any(word in source for word in COMPUTED)
    words = {k for k, x in enumerate(right[first] or []) if x.array is None}
    for k in sorted(wrong):
        fitting = [slip for slip, other in made.items() if k in touched[slip] and same(split, other, k)]
        alone = [slip for slip in fitting if touched[slip] <= wrong]  # it spoils nothing else
        alone = [slip for slip in alone if all(same(split, made[slip], j) for j in touched[slip])] or alone
        often = [slip for slip in fitting if 2 * len(touched[slip] & wrong) >= len(touched[slip])]
        fitting = alone or (often if typed else fitting if k in words else [])  # some numbers, or one error of several
        found[part.returns[k].name] = [slip for slip in fitting if traced(slip, source)]
    return found if all(found.values()) else None


def two_slips(part: Part, answers: Answers, cases: Cases) -> tuple[str, str] | None:
    """Return two slips that together give these answers on all cases."""
    for (first, one), (second, other) in combinations(part.slips.items(), 2):
        together = both(one, other)
        if together is not None and _matches(part, together, answers, cases):
            return first, second
    for second, twist in TWISTS.items():
        if second == "half-missing" and second not in part.slips:
            continue  # there is no half to be missed
        for first, wrong in part.slips.items():

            def twisted(*arguments: Any, wrong: Any = wrong, twist: Any = twist) -> Any:
                answer = wrong(*arguments)
                return tuple(map(twist, answer)) if isinstance(answer, tuple) else twist(answer)

            if first != second and _matches(part, twisted, answers, cases):
                return first, second
    return None
