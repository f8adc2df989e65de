"""From a wrong answer to what went wrong: several things are looked for, the likeliest first, and one is reported."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import ModuleType
from typing import Any, Literal

import numpy as np

from .calls import muted
from .compare import values
from .differences import differences, structure
from .evidence import Arguments, Evidence
from .exercise import Part, Slip
from .grammar import Edit, Habits
from .messages import message
from .program import MemoizedPackage, Program, source_with_helpers
from .search import Found, Hypothesis, mutants, search, second_edits, slips
from .text import Text
from .tracing import first_wrong_line

__all__ = ["Diagnosis", "Field", "How", "diagnose"]

How = Literal["slip", "line", "reference", "structure", "located", "numbers"]

MAX_CPU_S = {"slip": 4.0, "own": 2.2, "own of slip": 1.2, "reference": 1.0, "second": 2.0}
"""Seconds of CPU time that each search may take, beside its number of trials."""

MAX_NAMED = 3
"""Slips or changes that one message names."""

MAX_LINES = 4
"""Lines about how the results differ."""

MAX_ADDED_CHARS = 12
"""Of an edit that is shown as the place of a slip."""

NOTICEABLE = 1e-6
"""The least residual of a property that counts, for answers of the size of 1."""

NO_HABITS = Habits()

PROPERTY_ERRORS = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, np.linalg.LinAlgError)


@dataclass(frozen=True)
class Field:
    """What a diagnosis knows of the field that the functions are from.

    Attributes
    ----------
    slips : mapping
        The slips that have a name.
    habits : Habits
        What is taken for each other there.
    package : module, optional
        The package that the functions use.
    """

    slips: Mapping[str, Slip]
    habits: Habits = NO_HABITS
    package: ModuleType | None = None


@dataclass(frozen=True)
class Diagnosis:
    """What is wrong with an answer.

    Attributes
    ----------
    how : {"slip", "line", "reference", "structure", "located", "numbers"}
        By what it was found: a slip of the list; an edit of the student's own code that makes it right; an edit of
        a right solution that gives the same numbers; the type or the shape of what is returned;
        else by where or how the numbers differ, or only by that they do.
    lines : tuple of Text
    slips : tuple of str
        The slips that give the same numbers.
    """

    how: How
    lines: tuple[Text, ...]
    slips: tuple[str, ...] = ()


def diagnose(
    part: Part,
    function: Callable[..., Any],
    answers: Sequence[Any],
    cases: Sequence[Arguments],
    field: Field,
    *,
    special_cases: Callable[[], Sequence[Arguments]] = tuple,
    search_code: bool = True,
) -> Diagnosis:
    """Return what is wrong with a function.

    Parameters
    ----------
    part : Part
        What it was to be: a right function, and the slips of the list.
    function : callable
        The student's.
    answers : sequence
        What it returned in each case; None where it raised an error.
    cases : sequence of tuple
        Its arguments.
    field : Field
    special_cases : callable
        Returns further cases in which a change must be right.
    search_code : bool
        Whether changed programs are run.
    """
    with muted(), np.errstate(over="ignore"):
        evidence = Evidence(part, function, answers, cases, special_cases)
        return _Diagnoser(evidence, field, search_code).best()


class _Diagnoser:
    """Looks for explanations, each when it is first asked for."""

    def __init__(self, evidence: Evidence, field: Field, search_code: bool) -> None:
        self.evidence, self.part, self.field, self.search_code = evidence, evidence.part, field, search_code
        self.package = None if field.package is None else MemoizedPackage(field.package)

    def best(self) -> Diagnosis:
        """Return the first explanation in the order in which they are likely."""
        producers = (self._of_slips, self._of_order, self._of_results, self._of_own_code, self._of_reference)
        for producer in (*producers, self._of_two_edits, self._of_structure):
            found = producer()
            if found is not None:
                return found
        return self._located()

    # ---------------------------------------------------------------- the three searches, each made once

    @cached_property
    def listed(self) -> Found:
        """The slips of the list that give the student's numbers."""
        evidence = self.evidence
        return search(evidence, slips(evidence), evidence.answers, evidence.right, max_cpu_s=MAX_CPU_S["slip"])

    @cached_property
    def program(self) -> Program | None:
        """The student's function, traced in the first wrong case; None where its source cannot be run by itself."""
        function, evidence = self.evidence.function, self.evidence
        source = source_with_helpers(function) if self.search_code and not evidence.is_typed else None
        if source is None:
            return None
        names = [x.partition("=")[0] for x in self.part.arguments.split(", ")]
        given = dict(zip(names, evidence.cases[evidence.first]))
        try:
            program = Program(function, source=source, package=self.package, given=given)
            return program.trace(lambda f: evidence.call(f, evidence.first))
        except Exception:  # it does not run again as it did
            return None

    @cached_property
    def own(self) -> Found:
        """The edits of the student's code that make it right."""
        if self.program is None:
            return Found()
        evidence = self.evidence
        seconds = MAX_CPU_S["own of slip" if self.listed.whole else "own"]
        edits = mutants(self.program, "own", self.field.habits, evidence.chance_rules)
        return search(evidence, edits, evidence.right, evidence.answers, max_cpu_s=seconds, is_cure=True)

    @cached_property
    def solutions(self) -> list[Program]:
        """The right solutions, traced in the first wrong case, and what they call."""
        found = []
        for way in (self.part.solution, *self.part.ways):
            for listing in (way, *(self.part.beside if way is self.part.solution else ())):
                if not inspect.isclass(listing):
                    caller = None if listing is way else way
                    program = Program(listing, caller=caller, package=self.package)
                    found.append(program.trace(lambda f: self.evidence.call(f, self.evidence.first)))
        return found

    @cached_property
    def reference(self) -> Found:
        """The edits of right solutions that give the student's numbers."""
        found, evidence = Found(), self.evidence
        results = [x.array for answer in evidence.answers for x in values(answer, self.part.returns) or []]
        finite = all(x is None or x.dtype.kind not in "fc" or np.isfinite(x).all() for x in results)
        raised = any(x is None for x in evidence.answers)
        if not self.search_code or evidence.is_typed or raised or not finite:
            return found
        for program in self.solutions:
            edits = mutants(program, "reference", self.field.habits, evidence.chance_rules)
            seconds = MAX_CPU_S["reference"]
            one = search(evidence, edits, evidence.answers, evidence.right, max_cpu_s=seconds)
            if one.whole:
                return one
            found.of_result = {**one.of_result, **found.of_result}
        return found

    # ---------------------------------------------------------------- what may be reported

    def _of_structure(self) -> Diagnosis | None:
        found = structure(self.part, self.evidence.answers, self.evidence.right)
        return None if found is None else Diagnosis("structure", (found,))

    def _of_order(self) -> Diagnosis | None:
        """Two results exchanged."""
        evidence = self.evidence
        wrong = sorted(evidence.wrong) if evidence.is_split else []
        for i in wrong:
            for j in (j for j in wrong if j > i):
                turned = [_exchanged(answer, i, j) for answer in evidence.answers]
                if all(all(evidence.same(*three)) for three in zip(turned, evidence.right, evidence.cases)):
                    first, second = (self.part.returns[k].title for k in (i, j))
                    return Diagnosis("structure", (message("exchanged", first=first, second=second),))
        return None

    def _of_slips(self) -> Diagnosis | None:
        names = [x.slip for x in self.listed.whole]
        if not names:
            return None
        lines = [message("slip", **self._slip(names[0]))]
        if len(names) > 1:
            each = [message("one of the slips", **self._slip(name)) for name in names[:MAX_NAMED]]
            lines = [message("slips"), *each]
        edit = next((x.edit for x in self.own.whole if x.edit and _is_plain(x.edit)), None)
        if edit is not None:
            lines.append(message("own of slip", line=edit.line, edit=edit_text(edit)))
        return Diagnosis("slip", tuple(lines), tuple(names))

    def _of_results(self) -> Diagnosis | None:
        """Explain each wrong result by itself, by slips alone or by slips and edits."""
        evidence = self.evidence
        if not evidence.is_split:
            return None
        found = dict(self.listed.of_result)
        if not evidence.wrong <= found.keys():
            if self.own.whole or self.reference.whole:
                return None
            found = {**self.reference.of_result, **self.own.of_result, **found}
        if not evidence.wrong or not evidence.wrong <= found.keys():
            return None
        each = {j: found[j][0] for j in sorted(evidence.wrong)}
        lines = [
            message("in result", name=self.part.returns[j].title, finding=self._of_result(hypothesis))
            for j, hypothesis in each.items()
        ]
        names = tuple(dict.fromkeys(x.slip for x in each.values() if x.slip))
        how: How = "slip" if names else "line" if any(x.origin == "own" for x in each.values()) else "reference"
        return Diagnosis(how, tuple(lines), names)

    def _of_result(self, hypothesis: Hypothesis) -> Text:
        if hypothesis.edit is None:
            return message("slip of result", **self._slip(hypothesis.slip))
        edit = hypothesis.edit
        return message(f"{hypothesis.origin} of result", line=edit.line, edit=edit_text(edit))

    def _of_own_code(self) -> Diagnosis | None:
        edits = [x.edit for x in self.own.whole if x.edit]
        if not edits:
            return None
        each = [{"line": x.line, "edit": edit_text(x)} for x in edits[:MAX_NAMED]]
        lines = [message("own", cases=self._cases, **each[0])]
        if len(each) > 1:
            lines = [message("own any", cases=self._cases), *(message("own one", **x) for x in each)]
        raised = self.evidence.answers[self.evidence.first] is None
        shown = None if raised else structure(self.part, self.evidence.answers, self.evidence.right)
        return Diagnosis("line", (*([shown] if shown else []), *lines))

    def _of_reference(self) -> Diagnosis | None:
        edit = next((x.edit for x in self.reference.whole if x.edit), None)
        return None if edit is None else Diagnosis("reference", (message("reference", edit=edit_text(edit)),))

    def _of_two_edits(self) -> Diagnosis | None:
        """Two edits of the student's code that together make it right."""
        evidence = self.evidence
        often = 2 * len(evidence.wrong_cases) >= len(evidence.cases)
        if self.program is None or not self.own.partial or evidence.chance_rules or not often:
            return None
        found = second_edits(evidence, self.program, self.own, self.field.habits, MAX_CPU_S["second"])
        for first, second in ((x.after, x.edit) for x in found):
            if first and second:
                given = {"a": first.line, "first": edit_text(first), "b": second.line, "second": edit_text(second)}
                return Diagnosis("line", (message("own both", cases=self._cases, **given),))
        return None

    def _located(self) -> Diagnosis:
        """Where it goes wrong, and how the numbers differ."""
        evidence = self.evidence
        first = evidence.first
        line = None
        if self.program is not None:
            line = first_wrong_line(self.program, evidence.cases[first], self.solutions)
        property_ = next(self._broken_properties(), None)
        shown, telling = differences(self.part, evidence.answers[first], evidence.right[first])
        lines = [x for x in (line, property_) if x is not None]
        how: How = "located" if lines or telling else "numbers"
        return Diagnosis(how, (*lines, *shown[:MAX_LINES]))

    def _broken_properties(self) -> Iterator[Text]:
        """Yield the properties of right answers that the first wrong one lacks."""
        answer, right = (x[self.evidence.first] for x in (self.evidence.answers, self.evidence.right))
        arguments = self.evidence.cases[self.evidence.first]
        shapes = [[np.shape(x.raw) for x in values(y, self.part.returns) or []] for y in (answer, right)]
        for item in self.part.properties if shapes[0] == shapes[1] else ():
            try:
                own, of_right = (np.abs(np.asarray(item.residual(x, *arguments), complex)) for x in (answer, right))
            except PROPERTY_ERRORS:
                return
            if np.isfinite(own).all() and (own > NOTICEABLE).any() and (of_right <= NOTICEABLE).all():
                yield message("broken", text=item.text)

    def _slip(self, name: str) -> dict[str, Text]:
        """Return the title and the reason of a slip, those of the part where it has its own."""
        slip = self.field.slips[name]
        return {"title": self.part.titles.get(name, slip.title), "why": self.part.reasons.get(name, slip.why)}

    @property
    def _cases(self) -> Text:
        n = len(self.evidence.cases)
        return message("in all", n=n) if n > 1 else message("in one")


def _exchanged(answer: Any, i: int, j: int) -> Any:
    if not isinstance(answer, tuple | list) or len(answer) <= max(i, j):
        return answer
    return tuple(answer[j if k == i else i if k == j else k] for k in range(len(answer)))


def _is_plain(edit: Edit) -> bool:
    """Whether an edit can be shown as the place of a slip: it adds little to the line."""
    return edit.rule != "flow" and len(edit.after) <= len(edit.before) + MAX_ADDED_CHARS


def edit_text(edit: Edit) -> Text:
    """Describe an edit: what is put in place of what."""
    n = len(edit.changes)
    key = f"edit {edit.how}" if n == 1 else "edit replace all"
    return message(key, before=edit.before, after=edit.after, n=n)
