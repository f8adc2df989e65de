"""A wrong answer, and what is found about it: each thing is looked for once, when it is first asked for."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from itertools import combinations
from typing import Any

import numpy as np

from ...arrays import Array
from ..calls import tried
from ..changes.chosen import Lines
from ..changes.nearer import Nearer
from ..changes.repair import Repair
from ..changes.repairs import repairs, two_repairs
from ..changes.search import Found, exchanged, exchanged_results, found_edits, of_whole_numbers, same
from ..compare import agree, close, only_zero_is_missed, values
from ..exercise import Exercise, Part
from ..slips import SLIPS, Slip
from ..statements.records import arrays, tells
from ..statements.stepwise import Stepwise
from ..words.phrases import say
from ..words.text import Text
from .matching import matching_slips

__all__ = ["SHARES", "WrongAnswer", "changes_after_error"]

SHARES = {"mended": 2.0, "stepped": 3.8, "known": 4.2, "edited": 4.8, "after": 5.3, "both": 6.6, "twice": 7.1}
"""Seconds until which each search may go on, of the processor: a busy machine finds the same."""


class WrongAnswer:
    """The answers of a student's function, of which at least one is wrong.

    Parameters
    ----------
    exercise : Exercise
    part : Part
    function : callable
        The student's.
    answers : sequence
        What it returned, in each case.
    cases : sequence of tuple
        Its arguments.
    again : callable or None
        Calls it with other arguments; None: nothing more is called.
    share : float
        Of the time that a search may take.
    """

    def __init__(
        self,
        exercise: Exercise,
        part: Part,
        function: Callable[..., Any],
        answers: Sequence[Any],
        cases: Sequence[tuple[Any, ...]],
        again: Callable[[tuple[Any, ...]], Any] | None,
        share: float = 1,
    ) -> None:
        self.exercise, self.part, self.function = exercise, part, function
        self.answers, self.cases, self.again = answers, cases, again
        self.right = right_values(part, cases)
        self.until = deadlines(share)
        self.nearer = Nearer(part, self.right, answers, cases)
        self.whole: WrongAnswer | None = None

    @property
    def given(self) -> tuple[Callable[..., Any], Sequence[Any], Sequence[Any], Sequence[tuple[Any, ...]]]:
        """The function, the right values, the answers, the cases: what a search starts from."""
        return self.function, self.right, self.answers, self.cases

    @property
    def wrong_cases(self) -> list[tuple[Any, ...]]:
        """The cases in which the answer is wrong."""
        return [c for a, b, c in zip(self.answers, self.right, self.cases) if not agree(self.part, a, b, c)]

    @cached_property
    def wrong_results(self) -> list[int]:
        """Which of several things returned are wrong."""
        several = len(self.part.returns) > 1 and self.part.canonical is None
        every = range(len(self.part.returns)) if several else ()
        return [k for k in every if not same(self.part, self.answers, self.right, k)]

    def of_result(self, k: int, share: float) -> WrongAnswer:
        """Return what is wrong in one of several things returned, as if it were all that is asked for."""
        answers = [alone(answer, k, len(self.part.returns)) for answer in self.answers]
        part = _Result(**{x.name: getattr(self.part, x.name) for x in fields(self.part)})
        part = replace(part, returns=self.part.returns[k : k + 1], residuals=(), k=k, of=len(self.part.returns))
        again = self.again
        once = (lambda given: alone(again(given), k, len(self.part.returns))) if again else None
        found = WrongAnswer(self.exercise, part, self.function, answers, self.cases, once, share)
        found.whole = self
        return found

    def _spoils_another(self, found: Repair) -> bool:
        """Whether a change that makes this result right makes another one wrong that was right."""
        if self.whole is None:
            return False
        whole = self.whole
        answers = [tried(whole.part, found.edit.function, arguments) for arguments in self.cases]
        right = {*range(len(whole.part.returns))} - {*whole.wrong_results}
        return not all(same(whole.part, answers, whole.right, k) for k in right)

    @property
    def is_typed(self) -> bool:
        """Whether a few whole numbers are asked for, without arguments: they are met by chance."""
        return not self.cases[0] and of_whole_numbers(self.part, self.right[0])

    @cached_property
    def returned_elsewhere(self) -> list[tuple[int, int]]:
        """Which of several things returned are what another one of them must be: the two numbers of each."""
        pairs = zip(self.answers, self.right)
        split = [[values(x, self.part.returns) or [] for x in pair] for pair in pairs]
        others = [(k, j) for k in self.wrong_results for j in range(len(self.part.returns)) if j != k]
        telling = [(k, j) for k, j in others if any(map(tells, arrays(split[0][1][j].array)))]
        return [(k, j) for k, j in telling if all(a and close(a[k], b[j], self.part.rtol) for a, b in split)]

    def transpose_of(self, k: int) -> Text | None:
        """Return the name of another wrong result of which one is the transpose, where the right ones are not."""
        split = [[values(x, self.part.returns) or [] for x in pair] for pair in zip(self.answers, self.right)]
        for j in self.wrong_results:
            both = [[(x[k].array, x[j].array) if x else (None, None) for x in pair] for pair in split]
            if j != k and all(_turned(*own) for own, _ in both) and not all(_turned(*right) for _, right in both):
                return self.part.returns[j].title
        return None

    def other_orders(self) -> Iterator[tuple[Text, list[Any], list[Any]]]:
        """Yield the results with two wrong ones exchanged: how that is called, the answers, and the right values."""
        titles = [x.title for x in self.part.returns]
        for j, k in combinations(self.wrong_results, 2):
            name = say("results exchanged", first=titles[j], second=titles[k])
            given, right = ([exchanged(x, j, k) for x in many] for many in (self.answers, self.right))
            yield name, given, right

    def same_as(self, k: int) -> Text | None:
        """Return which of the results before the k-th has its numbers in all cases, and must have others."""
        split = [[values(x, self.part.returns) or [] for x in pair] for pair in zip(self.answers, self.right)]
        for j in range(k):
            if all(a and close(a[k], a[j], 0) for a, _ in split) and not all(close(b[k], b[j], 1e-6) for _, b in split):
                return self.part.returns[j].title
        return None

    @cached_property
    def alike(self) -> list[str]:
        """The slips of the list that give these very numbers."""
        return matching_slips(self.part, self.answers, self.cases)

    @cached_property
    def exchanged(self) -> Text | None:
        """Which two of the results are exchanged, if that is all that is wrong."""
        return exchanged_results(self.part, self.answers, self.cases)

    @cached_property
    def changes(self) -> list[Repair]:
        """The changes of the student's own lines, one at a time, that make them right."""
        if not self.again:
            return []
        lines = Lines(lambda line: self.steps.right_line(line), lambda line: self.steps.blameless(line))  # when needed
        found = repairs(self.part, *self.given, until=self.until["mended"], nearer=self.nearer, lines=lines)
        return [x for x in found if not self._spoils_another(x)]

    @property
    def whole_changes(self) -> list[Repair]:
        """Those that make right all that is returned."""
        return [x for x in self.changes if x.piece is None]

    @cached_property
    def steps(self) -> Stepwise:
        """The student's statements, one after the other."""
        return Stepwise(self.part, *self.given)

    @cached_property
    def first_statement(self) -> list[Repair]:
        """What must stand in place of the first statement that is wrong."""
        found = self.steps.one(self.until["stepped"], every=time.process_time() > self.until["mended"])
        return [x for x in found if not self._spoils_another(x)]

    @cached_property
    def edits(self) -> list[Found]:
        """The change of a right solution that gives these numbers, or one for each wrong thing of several."""
        return found_edits(self.part, self.answers, self.cases, until=self.until["edited"])

    @cached_property
    def by_chance(self) -> bool:
        """Whether two changes may be right by chance: a single number of few digits, or a term that must be zero."""
        few = self.part.canonical is not None and len(self.part.returns) == 1 and np.ndim(self.right[0]) == 0
        wrong = [(a, b) for a, b, c in zip(self.answers, self.right, self.cases) if not agree(self.part, a, b, c)]
        return (
            few
            or len({*map(repr, self.answers)}) == 1 < len(self.cases)
            or all(only_zero_is_missed(self.part, a, b) for a, b in wrong)
        )

    def two_changes(self) -> list[Repair]:
        """Return two changes of the student's own lines that together make them right, each of them a part."""
        if self.by_chance:
            return []
        nearer = two_repairs(self.part, self.function, self.nearer, self.cases[0], self.until["after"])
        return nearer or self.steps.two(self.until["both"], self.nearer.spoils)

    def slip(self, name: str) -> Slip:
        """Return a slip with the name and the reason that this part has for it, if it has its own."""
        slip, titles, reasons = SLIPS[name], self.part.titles, self.part.reasons
        own = name in reasons or name not in self.part.slips
        section = self.exercise.section if own else slip.section
        return Slip(titles.get(name, slip.title), reasons.get(name, slip.why), section)


def _turned(a: Array | None, b: Array | None) -> bool:
    """Whether a matrix is another one transposed."""
    if a is None or b is None or a.ndim != 2 or a.shape != b.shape[::-1]:
        return False
    return bool(np.allclose(a, b.mT, rtol=1e-9, atol=1e-9))


@dataclass(frozen=True, kw_only=True)
class _Result(Part):
    """A function of which one result is looked at, the k-th of several."""

    k: int = 0
    of: int = 1

    def value(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        """Call a function as its part does, and take the one result."""
        return alone(super().value(function, arguments), self.k, self.of)


def alone(answer: Any, k: int, several: int) -> Any:
    """Return one of several results; None where there are not as many."""
    return answer[k] if isinstance(answer, tuple | list) and len(answer) == several else None


def changes_after_error(part: Part, function: Callable[..., Any], cases: Sequence[tuple[Any, ...]]) -> list[Repair]:
    """Return the changes that make a function right that raises an error."""
    until, given = deadlines(), (part, function, right_values(part, cases), [None] * len(cases), cases)
    return repairs(*given, until=until["mended"]) or repairs(*given, until=until["twice"], pairs=True)


def right_values(part: Part, cases: Sequence[tuple[Any, ...]]) -> list[Any]:
    """Return what is expected in each case."""
    return [part.value(part.solution, arguments) for arguments in cases]


def deadlines(share: float = 1) -> dict[str, float]:
    """Return until when each search may go on, as `time.process_time` has it."""
    start = time.process_time()
    return {how: start + share * seconds for how, seconds in SHARES.items()}
