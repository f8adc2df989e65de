"""A wrong answer as evidence: which of its results are wrong, in which cases, and whether something explains them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

import numpy as np

from .calls import call_or_none, cheapest_case, keeps_arguments
from .compare import Array, agree, close, differing, values
from .exercise import Part

__all__ = ["Evidence"]

Function = Callable[..., Any]
Arguments = tuple[Any, ...]

FEW_NUMBERS = 6  # of an answer without arguments: a change of a number meets so few by chance
MANY_TRUTHS = 64  # cases that tell one condition from another


class Evidence:
    """The answers of a function in some cases, and the right ones.

    Parameters
    ----------
    part : Part
    function : callable
        The student's.
    answers : sequence
        What it returned in each case, None where it raised an error.
    cases : sequence of tuple
        Its arguments.
    special_cases : callable
        Returns further cases, in which a change that is right must be right as well.
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
        self.right = [part.value(part.solution, arguments) for arguments in cases]
        self.compared = [self.same(*three) for three in zip(answers, self.right, cases)]
        self.wrong_cases = [k for k, same in enumerate(self.compared) if not all(same)]
        self.first = cheapest_case({k: cases[k] for k in self.wrong_cases or range(len(cases))})
        self._special_cases = special_cases

    @property
    def is_split(self) -> bool:
        """Whether several things are returned, each of which is compared by itself."""
        return len(self.part.returns) > 1 and self.part.canonical is None

    @property
    def results(self) -> range:
        """The numbers of the things that are compared."""
        return range(len(self.part.returns) if self.is_split else 1)

    @cached_property
    def wrong(self) -> frozenset[int]:
        """Which of them are wrong in some case."""
        return frozenset(j for j in self.results if not all(same[j] for same in self.compared))

    def same(self, first: Any, second: Any, arguments: Arguments) -> list[bool]:
        """Return, result by result, whether two answers are the same."""
        if not self.is_split:
            return [first is not None and agree(self.part, first, second, arguments)]
        a, b = values(first, self.part.returns), values(second, self.part.returns)
        return [bool(a and b) and close(a[j], b[j], self.part.rtol) for j in self.results]  # type: ignore[index]

    def call(self, function: Function, k: int) -> Any:
        """Return what a function gives in a case; None where it raises an error or does not end."""
        return call_or_none(self.part, function, self.cases[k])

    def explained(self, function: Function, wanted: Sequence[Any]) -> tuple[list[Any], frozenset[int]]:
        """Return what a function gives, and which results are then as wanted in all cases."""
        found = [self.call(function, k) for k in range(len(self.cases))]
        same = [self.same(*three) for three in zip(found, wanted, self.cases)]
        return found, frozenset(j for j in self.results if all(x[j] for x in same))

    @cached_property
    def _special(self) -> list[tuple[Arguments, Any]]:
        cases = self._special_cases() if self.cases[0] else ()
        return [(arguments, self.part.value(self.part.solution, arguments)) for arguments in cases]

    def holds_everywhere(self, function: Function) -> bool:
        """Whether a changed function is right in the special cases as well."""
        return all(agree(self.part, call_or_none(self.part, function, c), x, c) for c, x in self._special)

    def leaves_arguments(self, function: Function) -> bool:
        """Whether a changed function changes no argument, unless the student's does."""
        return self._changes_arguments or keeps_arguments(self.part, function, self.cases[self.first])

    @cached_property
    def _changes_arguments(self) -> bool:
        return not keeps_arguments(self.part, self.function, self.cases[self.first])

    def wrong_entries(self, answer: Any, wanted: Any) -> Array | None:
        """Return which numbers of an answer are not as wanted; None where they cannot be compared one by one."""
        pairs = [*zip(values(answer, self.part.returns) or (), values(wanted, self.part.returns) or ())]
        if self.part.canonical is not None or not pairs:
            return None
        found = []
        for a, b in pairs:
            if a.array is None or b.array is None or a.array.shape != b.array.shape:
                return None
            if a.array.dtype.kind != "f" or b.array.dtype.kind != "f":
                return None
            found.append(differing(a.array, b.array, self.part.rtol).ravel())
        return np.concatenate(found)

    @cached_property
    def is_typed(self) -> bool:
        """Whether only a few whole numbers are asked for: they are met by chance."""
        right = values(self.right[0], self.part.returns) or []
        whole = all(x.array is not None and np.array_equal(x.array, np.trunc(x.array)) for x in right)
        return self._is_short and whole

    @property
    def _is_short(self) -> bool:
        right = values(self.right[0], self.part.returns) or []
        return not self.cases[0] and sum(np.size(x.raw) for x in right) <= FEW_NUMBERS

    @cached_property
    def chance_rules(self) -> tuple[str, ...]:
        """The rules whose edits meet the right answer by chance."""
        truths = any(
            x.array is not None and x.array.dtype.kind == "b" for x in values(self.right[0], self.part.returns) or []
        )
        if self._is_short:
            return ("number", "operator")
        return ("index", "number", "operator") if truths and len(self.cases) < MANY_TRUTHS else ()
