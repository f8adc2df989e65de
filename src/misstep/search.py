"""One search for what explains a wrong answer, used three times.

A slip of the list and an edit of a right solution explain it where they give its numbers; an edit of the student's own
code where the numbers become right. Each is a `Hypothesis`: tried in one case first, then in all of them.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal, NamedTuple

import numpy as np

from .calls import call_or_none, cheapest_case, keeps_arguments, value_of_reference
from .compare import agree, close, copied_results, values
from .exercise import Part
from .grammar import RULES, Edit, Habits, edits
from .listing import Listing

__all__ = ["Arguments", "Evidence", "Found", "Hypothesis", "mutants", "search", "slips"]

Function = Callable[..., Any]
Arguments = tuple[Any, ...]
Origin = Literal["slip", "own", "reference"]

MAX_TRIALS = 4_000  # hypotheses that one search tries
FEW_NUMBERS = 6  # of an answer without arguments: a change of a number meets so few by chance
MANY_TRUTHS = 64  # cases that tell one condition from another


class Evidence:
    """The answers of a function in some cases, None where it raised an error, and the right ones.

    `special_cases` returns further cases, in which a change that is right must be right as well.
    """

    def __init__(
        self,
        part: Part,
        function: Function,
        answers: Sequence[Any],
        cases: Sequence[Arguments],
        special_cases: Callable[[], Sequence[Arguments]] = tuple,
    ) -> None:
        self.part, self.function, self.answers, self.cases = part, function, answers, cases
        self.right = [value_of_reference(part, arguments) for arguments in cases]
        self.is_split = len(part.returns) > 1 and part.canonical is None  # each result is compared by itself
        self.results = range(len(part.returns) if self.is_split else 1)
        compared = [self.same(*three) for three in zip(answers, self.right, cases)]
        self.wrong = frozenset(j for j in self.results if not all(same[j] for same in compared))
        wrong_cases = [k for k, same in enumerate(compared) if not all(same)]
        self.first = cheapest_case({k: cases[k] for k in wrong_cases or range(len(cases))})
        self.shown = min(wrong_cases, default=0)
        """The case that a message shows: the first wrong one."""
        self._special_cases = special_cases

    def same(self, first: Any, second: Any, arguments: Arguments) -> list[bool]:
        """Return, result by result, whether two answers are the same."""
        if not self.is_split:
            return [first is not None and agree(self.part, first, second, arguments)]
        a, b = values(first, self.part.returns), values(second, self.part.returns)
        return [bool(a and b) and close(a[j], b[j], self.part.rtol) for j in self.results]  # type: ignore[index]

    def call(self, function: Function, k: int) -> Any:
        """Return what a function gives in a case; None where it raises an error or does not end."""
        return call_or_none(self.part, function, self.cases[k])

    def same_in_all(self, answers: Sequence[Any], wanted: Sequence[Any]) -> frozenset[int]:
        """Return which results are as wanted in all cases."""
        same = [self.same(*three) for three in zip(answers, wanted, self.cases)]
        return frozenset(j for j in self.results if all(x[j] for x in same))

    @cached_property
    def _special(self) -> list[tuple[Arguments, Any]]:
        cases = self._special_cases() if self.cases[0] else ()
        return [(arguments, value_of_reference(self.part, arguments)) for arguments in cases]

    def is_cured_by(self, function: Function) -> bool:
        """Whether a changed function is right in the special cases as well."""
        return all(agree(self.part, call_or_none(self.part, function, c), x, c) for c, x in self._special)

    def leaves_arguments(self, function: Function) -> bool:
        """Whether a changed function changes no argument, unless the student's does."""
        return self._changes_arguments or keeps_arguments(self.part, function, self.cases[self.first])

    @cached_property
    def _changes_arguments(self) -> bool:
        return not keeps_arguments(self.part, self.function, self.cases[self.first])

    @cached_property
    def is_typed(self) -> bool:
        """Whether only a few whole numbers are asked for: they are met by chance."""
        right = values(self.right[0], self.part.returns) or []
        return self._is_short and all(x.array is not None and np.array_equal(x.array, np.trunc(x.array)) for x in right)

    @property
    def _is_short(self) -> bool:
        right = values(self.right[0], self.part.returns) or []
        return not self.cases[0] and sum(np.size(x.raw) for x in right) <= FEW_NUMBERS

    @cached_property
    def chance_rules(self) -> tuple[str, ...]:
        """The rules whose edits meet the right answer by chance."""
        right = values(self.right[0], self.part.returns) or []
        if self._is_short:
            return ("number", "operator")
        has_truths = any(x.array is not None and x.array.dtype.kind == "b" for x in right)
        return ("index", "number", "operator") if has_truths and len(self.cases) < MANY_TRUTHS else ()


class Hypothesis(NamedTuple):
    """What may be wrong: a slip of the list, an edit of the student's own code, or one of a right solution."""

    origin: Origin
    function: Function
    slip: str = ""
    edit: Edit | None = None

    @property
    def rank(self) -> tuple[int, int, int, int]:
        """The order of those that explain the same: by rule, number of places, length of what is added, last line."""
        if self.edit is None:
            return 0, 0, 0, 0
        added = max(0, len(self.edit.after) - len(self.edit.before))
        return RULES.index(self.edit.rule), len(self.edit.changes), added // 8, -self.edit.line


@dataclass
class Found:
    """What a search found: explanations of all that is wrong, and of single results."""

    whole: list[Hypothesis] = field(default_factory=list)
    of_result: dict[int, list[Hypothesis]] = field(default_factory=dict)


def slips(part: Part) -> Iterator[Hypothesis]:
    """Yield the slips of the list."""
    for name, function in part.slips.items():
        yield Hypothesis("slip", function, slip=name)


def mutants(listing: Listing, origin: Origin, habits: Habits, without: Sequence[str] = ()) -> Iterator[Hypothesis]:
    """Yield the edits of a listing that compile, but for those of some rules."""
    for edit in edits(listing, habits):
        if edit.rule not in without and (function := listing.mutant(edit.changes)) is not None:
            yield Hypothesis(origin, function, edit=edit)


def search(evidence: Evidence, hypotheses: Iterable[Hypothesis], wanted: Sequence[Any], *, max_cpu_s: float) -> Found:
    """Return which hypotheses, the likeliest first, give what is wanted in each case.

    Edits of further rules are not tried once those of one rule explain everything. An edit of the student's code must
    be right in the special cases, too.
    """
    found, unsure = Found(), list[Hypothesis]()
    until, first = time.process_time() + max_cpu_s, evidence.first
    for tried, hypothesis in enumerate(hypotheses):
        rule = hypothesis.edit.rule if hypothesis.edit else ""
        later = found.whole and found.whole[-1].edit and found.whole[-1].edit.rule != rule
        if tried >= MAX_TRIALS or time.process_time() > until or later:
            break
        answer = evidence.call(hypothesis.function, first)
        same = answer is not None and evidence.same(answer, wanted[first], evidence.cases[first])
        if not same or not any(same[j] for j in evidence.wrong):
            continue
        answers = [evidence.call(hypothesis.function, k) for k in range(len(evidence.cases))]
        explained = evidence.same_in_all(answers, wanted)
        if explained != frozenset(evidence.results):
            if evidence.same_in_all(answers, evidence.right) >= {*evidence.results} - evidence.wrong:
                for j in explained & evidence.wrong:
                    found.of_result.setdefault(j, []).append(hypothesis)
            continue
        if hypothesis.origin != "slip" and copied_results(answers, evidence.right, evidence.answers):
            continue  # what is asked for in two ways is not computed in one
        if hypothesis.origin != "own":
            found.whole.append(hypothesis)
        elif evidence.leaves_arguments(hypothesis.function):
            (found.whole if evidence.is_cured_by(hypothesis.function) else unsure).append(hypothesis)
    found.whole = _distinct(found.whole or unsure[:1])
    return found


def _distinct(found: list[Hypothesis]) -> list[Hypothesis]:
    """Sort explanations by rank, and keep one edit of an expression."""
    kept: list[Hypothesis] = []
    for one in sorted(found, key=lambda x: x.rank):
        if not any(one.edit and x.edit and (x.edit.touches(one.edit) or one.edit.touches(x.edit)) for x in kept):
            kept.append(one)
    return kept
