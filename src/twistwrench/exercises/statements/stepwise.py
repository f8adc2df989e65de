"""The search from one wrong statement of a student's function to the next, by the values that they compute."""

from __future__ import annotations

import ast
import copy
import inspect
import io
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import redirect_stderr, redirect_stdout
from itertools import chain, zip_longest
from typing import Any, NamedTuple

import twistwrench

from ..calls import smallest, tried
from ..changes.alternatives import KINDS
from ..changes.edits import Source
from ..changes.excerpts import text_of
from ..changes.plausible import plausible, turns_the_rest
from ..changes.repair import Repair
from ..changes.repairs import PAIRED, source_of
from ..changes.search import Remembering, by_chance
from ..changes.sound import Sound
from ..changes.whole import Edit
from ..changes.written import text_written
from ..compare import agree, copied_results, only_zero_is_missed
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text
from .donors import given
from .mixups import mixups
from .outputs import Output, feeds, outputs, suspects
from .records import Event, arrays, known_values, numbers_of, recorded, tells

__all__ = ["Stepwise"]

FEW = 3
"""Wrong statements that are looked at."""

MOST = 8
"""First changes after which a second one is looked for."""

LIKELY = (*KINDS[: KINDS.index("instead") + 1], "missing")
"""Kinds of changes that may be the first of two."""


Spoils = Callable[[Callable[..., Any]], bool]
"""Whether a changed function gives wrong numbers where the student's are right."""


class Traced(NamedTuple):
    """A student's function, what it computes in one case, and the statements that are wrong first.

    In `sure` are those after all that may be another way, in `wrong` those that come first anyhow as well.
    """

    source: Source
    events: list[Event]
    found: list[Output]
    wrong: list[Output]
    sure: list[Output]
    right: int
    unknown: int


class Stepwise:
    """What a student's function computes in one case, statement by statement, beside what right solutions do.

    Parameters
    ----------
    part : Part
    function : callable
        The student's.
    right, answers : sequence
        What is expected and what the function returned, in each case.
    cases : sequence of tuple
    """

    def __init__(
        self,
        part: Part,
        function: Callable[..., Any],
        right: Sequence[Any],
        answers: Sequence[Any],
        cases: Sequence[tuple[Any, ...]],
    ) -> None:
        self.part, self.right, self.answers, self.cases = part, right, answers, cases
        self.sound, self.text = Sound(part, function), text_written(function)
        wrong = [k for k, given in enumerate(zip(answers, right, cases)) if not agree(part, *given)]
        self.seldom = 2 * len(wrong) < len(cases)
        self.surplus = all(only_zero_is_missed(part, answers[k], right[k]) for k in wrong)
        self.first = smallest({k: cases[k] for k in wrong})
        self.start: Traced | None = None
        arguments = cases[self.first]
        if inspect.isclass(function) or not arguments:
            return
        self.names = {"tw": Remembering(twistwrench)}
        self.given = dict(zip(part.arguments.split(", "), arguments))
        source = source_of(part, function, arguments)
        if source is not None:
            with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
                self.ways = self._ways(source, wrong)
                self.known, self.record = known_values(part, arguments, self.names)
                self.start = self._traced(source)

    def one(self, until: float, *, every: bool) -> list[Repair]:
        """Return the change of one of the first wrong statements that makes all right.

        Unless of `every` kind, it is one of those that are not tried on the whole function.
        """
        with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
            for edit in self._edits(self.start, until, every=every) if self.start else ():
                if self._mends(edit):
                    return [Repair(edit)]
        return []

    def two(self, until: float, spoils: Spoils) -> list[Repair]:
        """Return two changes, the first of which makes more of the function right, and the second the rest.

        The first one must not give wrong numbers where they are right: it `spoils` something then.
        """
        if self.start is None or self.seldom:
            return []
        with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
            return self._after(self.start, until, spoils) or self._both(self.start, until, spoils)

    def _after(self, start: Traced, until: float, spoils: Spoils) -> list[Repair]:
        """Return two changes, the first of them one that makes more of what is computed known."""
        better: dict[bytes, tuple[Edit, Traced]] = {}
        begin = time.process_time()
        for edit in self._edits(start, begin + 0.5 * (until - begin)):
            if edit.kind in LIKELY and edit.places:
                after = self._traced(start.source.after(edit))
                more = after.events and after.unknown < start.unknown and after.right > start.right
                if more and not spoils(edit.function):
                    better.setdefault(
                        numbers_of(after.events[-1].value), (edit, after)
                    )  # of those with the same effect the first
        for edit, after in sorted(better.values(), key=lambda pair: pair[1].unknown)[:MOST]:
            now = time.process_time()
            for other in self._edits(after, now + 0.4 * (until - now)):  # the likeliest may take longest
                made_of_one = _rewritten({edit.kind, other.kind}) or turns_the_rest(edit, other)
                if not made_of_one and self._mends(other):
                    return [Repair(other, first=edit)]
        return []

    def _both(self, start: Traced, until: float, spoils: Spoils) -> list[Repair]:
        """Return two changes of the first wrong statement, of the likeliest kinds."""
        for edit in self._edits(start, until):
            if edit.kind in PAIRED and edit.places and not spoils(edit.function):
                source = start.source.after(edit)
                source.places = [x for x in source.places if x[2].lineno == edit.line]
                for other in (other for kind in PAIRED for other in source.edits(kind)):
                    if time.process_time() > until:
                        return []
                    likely = plausible(other, self.text, self.part) and not turns_the_rest(edit, other)
                    if likely and self._mends(other):
                        return [Repair(other, first=edit)]
        return []

    def line(self) -> Text | None:
        """Report the first statement that is wrong, if what it is computed from is right."""
        if self.start is None or not self.start.sure:
            return None
        first, every = self.start.sure[0], {id(x.statement) for x in self.start.found}
        alone = len({id(x.statement) for x in self.start.sure}) == 1
        if not alone or _is_taken(first.node) or len(every) < 3:
            return None
        case, answer, right = (x[self.first] for x in (self.cases, self.answers, self.right))
        with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
            if not feeds(self.part, self.start.source, first.statement, case, answer, right):
                return None
        return say("first line", line=first.statement.lineno, text=text_of(first.statement))

    def blameless(self, line: int | None) -> bool:
        """Whether what a line of the function computes is not what goes wrong first."""
        start = self.start
        computed = {x.statement.lineno for x in start.found} if start else set()
        first = {x.statement.lineno for x in start.wrong} if start else set()
        return line in computed and bool(first) and line not in first

    def right_line(self, line: int) -> bool:
        """Whether a right solution has all that a line of the function computes, with its sign."""
        start, set_there = self.start, ast.Assign | ast.AugAssign
        every = [x for x in start.found if x.statement.lineno == line] if start else []
        here = [x for x in every if isinstance(x.statement, set_there)]
        whole = {id(x.statement.value if isinstance(x.statement, ast.Assign) else x.node) for x in here}
        kept = [event.value for event in start.events if id(event.node) in whole] if start else []
        telling = [x for value in kept for x in arrays(value) if tells(x)]
        both_signs = all(self.known.has_with_sign(-x) for x in telling)  # then it may be either
        return not both_signs and all(map(self.known.has_with_sign, telling))

    def _ways(self, source: Source, wrong: Sequence[int]) -> set[tuple[int, int]]:
        """Return the places where another way is gone: no right solution has what is computed and read there.

        It is so in a right case. What nothing reads, as the sum at the world, may be anything in it.
        """
        fine = next((c for k, c in enumerate(self.cases) if k not in wrong), None)
        if fine is None:
            return set()
        known, _ = known_values(self.part, fine, self.names)
        found = outputs(source, recorded(self.part, [source], fine), known)
        read = {key for x in found for v in x.values for _, key in v.read}
        return {x.place for x in found if any(not v.known and v.key in read for v in x.values)}

    def _traced(self, source: Source) -> Traced:
        events = recorded(self.part, [source], self.cases[self.first])
        found = outputs(source, events, self.known)
        telling = [event.value for event in events if any(tells(x) for x in arrays(event.value))]
        right = sum(map(self.known.has, telling))
        sure, more = suspects(found, self.ways)[:FEW], suspects(found)[:FEW]
        in_turn = chain.from_iterable(zip_longest(sure, more))  # a right case may be right by chance
        wrong = [*{id(x): x for x in in_turn if x is not None}.values()]
        return Traced(source, events, found, wrong, sure, right, len(telling) - right)

    def _edits(self, traced: Traced, until: float, *, every: bool = True) -> Iterator[Edit]:
        """Yield the changes of the statements that are wrong first, and what may be missing in them."""
        chance = by_chance(self.part, self.cases[self.first], len(self.cases))
        for edit in self._streams(traced, every, until):
            if time.process_time() > until:
                return
            if edit.kind not in chance and plausible(edit, self.text, self.part):
                yield edit

    def _streams(self, traced: Traced, every: bool, until: float) -> Iterator[Edit]:
        yield from mixups(traced.source)
        if not traced.wrong:  # all numbers are there, but for their signs, places and factors
            yield from traced.source.edits("sign")
        looked_at = traced.wrong or traced.found[-1:]
        for k, output in enumerate(looked_at):
            more = given(
                *(traced.source, output, traced.events, traced.found),
                *(self.record, self.given, self.known, self.right[self.first]),
            )
            more = iter(()) if self.surplus else more
            now = time.process_time()
            share = now + (until - now) / (len(looked_at) - k)
            for edit in _all(_within(traced.source, output), more) if every else more:
                yield edit
                if time.process_time() > share:
                    break

    def _mends(self, edit: Edit) -> bool:
        given: list[Any] = []
        for k in (self.first, *range(len(self.cases))):
            given.append(tried(self.part, edit.function, self.cases[k]))
            if not agree(self.part, given[-1], self.right[k], self.cases[k]):
                return False
        good = self.sound.good(edit.function, self.cases[self.first]) and self.sound.everywhere(edit.function)
        return good and not copied_results(given[1:], self.right, self.answers)


def _rewritten(kinds: set[str]) -> bool:
    """Whether one of two changes takes something out and the other puts something in: that is not a slip."""
    return "left out" in kinds and not kinds.isdisjoint(("missing", "inserted", "instead"))


def _within(source: Source, output: Output) -> Source:
    """Return the source, of which only one statement is changed, and what a sum in a loop begins with and runs over."""
    found, near = copy.copy(source), [output.statement]
    for parents, _, node in source.places:
        if node is output.statement:
            near += [
                x.iter if isinstance(x, ast.For) else x.test for x in parents if isinstance(x, ast.For | ast.While)
            ]
        if isinstance(node, ast.Assign) and len(near) < FEW and output.writes & _names_of(node.targets):
            near.append(node)
    found.places = [x for x in source.places if any(y is z for y in (*x[0], x[2]) for z in near)]
    return found


def _names_of(targets: Sequence[ast.expr]) -> set[str]:
    return {x.id for x in targets if isinstance(x, ast.Name)}


def _all(within: Source, more: Iterator[Edit]) -> Iterator[Edit]:
    for kind in KINDS:
        yield from within.edits(kind)
        if kind == "left out":
            yield from more


def _is_taken(node: Any) -> bool:
    """Whether a value is only taken out of something, and nothing is computed."""
    while isinstance(node, ast.Subscript | ast.Attribute):
        node = node.value
    return isinstance(node, ast.Name)
