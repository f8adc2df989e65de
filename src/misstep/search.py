"""One search for what explains a wrong answer, used three times.

A slip of the list and an edit of a right solution explain it where they give its numbers; an edit of the student's own
code where the numbers become right. Each is a `Hypothesis`: tried in one case first, then in all of them.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple

from .compare import Array, copied_results
from .evidence import Evidence
from .grammar import RULES, Edit, Habits, edits
from .program import Program

__all__ = ["Found", "Hypothesis", "Origin", "mutants", "search", "second_edits", "slips"]

Function = Callable[..., Any]
Origin = Literal["slip", "own", "reference"]

MAX_TRIALS = 4_000
"""Hypotheses that one search tries."""

MAX_PAIRED = 6
"""Edits that make most of the numbers right, after each of which a second one is looked for."""


class Hypothesis(NamedTuple):
    """What may be wrong: a slip of the list, an edit of the student's own code, or one of a right solution."""

    origin: Origin
    function: Function
    slip: str = ""
    edit: Edit | None = None
    after: Edit | None = None

    @property
    def rank(self) -> tuple[int, int, int, int]:
        """The order of those that explain the same: by rule, number of places, length of what is added, last line."""
        if self.edit is None:
            return 0, 0, 0, 0
        added = max(0, len(self.edit.after) - len(self.edit.before))
        return RULES.index(self.edit.rule), len(self.edit.changes), added // 8, -self.edit.line


@dataclass
class Found:
    """What a search found: explanations of all that is wrong, of single results, and edits that make less wrong."""

    whole: list[Hypothesis] = field(default_factory=list)
    of_result: dict[int, list[Hypothesis]] = field(default_factory=dict)
    partial: list[tuple[int, Hypothesis]] = field(default_factory=list)


def slips(evidence: Evidence) -> Iterator[Hypothesis]:
    """Yield the slips of the list."""
    for name, function in evidence.part.slips.items():
        yield Hypothesis("slip", function, slip=name)


def mutants(
    program: Program, origin: Origin, habits: Habits, without: Sequence[str] = (), after: Edit | None = None
) -> Iterator[Hypothesis]:
    """Yield the edits of a program that compile; after the edits of a rule, nothing of `without`."""
    for edit in edits(program, habits):
        if edit.rule not in without and (function := program.mutant(edit.changes)) is not None:
            yield Hypothesis(origin, function, edit=edit, after=after)


def search(
    evidence: Evidence,
    hypotheses: Iterable[Hypothesis],
    wanted: Sequence[Any],
    present: Sequence[Any],
    *,
    max_cpu_s: float,
    is_cure: bool = False,
) -> Found:
    """Return which hypotheses explain a wrong answer.

    Parameters
    ----------
    evidence : Evidence
    hypotheses : iterable of Hypothesis
        The likeliest first. Edits of further rules are not tried once those of one rule explain everything.
    wanted : sequence
        What a hypothesis must give in each case: the right answers, or the student's.
    present : sequence
        What is given without it.
    max_cpu_s : float
        A limit beside the number of trials.
    is_cure : bool
        Whether the function is right then: it must be so in the special cases, too.
    """
    found, unsure = Found(), list[Hypothesis]()
    until, first, tried = time.process_time() + max_cpu_s, evidence.first, 0
    before = evidence.wrong_entries(present[first], wanted[first])
    for hypothesis in hypotheses:
        tried += 1
        rule = hypothesis.edit.rule if hypothesis.edit else ""
        later = found.whole and found.whole[-1].edit and found.whole[-1].edit.rule != rule
        if tried > MAX_TRIALS or time.process_time() > until or later:
            break
        answer = evidence.call(hypothesis.function, first)
        if answer is None:
            continue
        same = evidence.same(answer, wanted[first], evidence.cases[first])
        if any(same[j] for j in evidence.wrong):
            answers, explained = evidence.explained(hypothesis.function, wanted)
            if explained == frozenset(evidence.results):
                if hypothesis.origin != "slip" and copied_results(answers, evidence.right, evidence.answers):
                    continue  # what is asked for in two ways is not computed in one
                if is_cure and not evidence.leaves_arguments(hypothesis.function):
                    continue
                good = not is_cure or evidence.holds_everywhere(hypothesis.function)
                (found.whole if good else unsure).append(hypothesis)
                continue
            if all(_is_right(evidence, answers, j) for j in evidence.results if j not in evidence.wrong):
                for j in explained & evidence.wrong:
                    found.of_result.setdefault(j, []).append(hypothesis)
        wrong = evidence.wrong_entries(answer, wanted[first])
        if is_cure and wrong is not None and _is_part(before, wrong):
            found.partial.append((int(wrong.sum()), hypothesis))
    found.whole = _distinct(found.whole or unsure[:1])
    return found


def _is_right(evidence: Evidence, answers: Sequence[Any], j: int) -> bool:
    """Whether one result is right in all cases."""
    return all(evidence.same(a, b, c)[j] for a, b, c in zip(answers, evidence.right, evidence.cases))


def _is_part(before: Array | None, wrong: Array) -> bool:
    """Whether fewer numbers are wrong than before, and no others."""
    if before is None or wrong.shape != before.shape:
        return False
    return bool(0 < wrong.sum() < before.sum() and not (wrong & ~before).any())


def _distinct(found: list[Hypothesis]) -> list[Hypothesis]:
    """Sort explanations by rank, and keep one edit of an expression."""
    kept: list[Hypothesis] = []
    for one in sorted(found, key=lambda x: x.rank):
        if not any(one.edit and x.edit and (x.edit.touches(one.edit) or one.edit.touches(x.edit)) for x in kept):
            kept.append(one)
    return kept


def second_edits(
    evidence: Evidence, program: Program, first: Found, habits: Habits, max_cpu_s: float
) -> list[Hypothesis]:
    """Return edits that make an answer right after one that makes less of it wrong."""
    best = sorted(first.partial, key=lambda x: x[0])[:MAX_PAIRED]
    for _, hypothesis in best:
        edit = hypothesis.edit
        if edit is None:
            continue
        changed = program.after(edit.changes).trace(lambda f: evidence.call(f, evidence.first))
        others = mutants(changed, "own", habits, (*evidence.chance_rules, "flow"), after=edit)
        share = max_cpu_s / len(best)
        found = search(evidence, others, evidence.right, evidence.answers, max_cpu_s=share, is_cure=True)
        if found.whole:
            return found.whole[:1]
    return []
