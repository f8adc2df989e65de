"""The small change of the student's own function that makes it right."""

from __future__ import annotations

import ast
import inspect
import io
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import replace
from typing import Any

import twistwrench

from ..calls import copied, local_values, smallest, tried
from ..compare import agree, copied_results
from ..exercise import Part
from .alternatives import KINDS
from .chosen import Chosen, Lines
from .edits import Source
from .meanings import meaning
from .nearer import Nearer
from .plausible import plausible
from .repair import Repair
from .search import Remembering, by_chance, of_whole_numbers, of_words, same
from .sound import Sound
from .whole import Edit, of_arguments, of_order
from .written import text_written, written

__all__ = [
    "guarded",
    "repairs",
    "source_of",
    "two_repairs",
]

PAIRED = ("sign", "transposed", "exchanged", "left out", "name")
"""The kinds of changes of which two are tried at once."""

FURTHER = ("index", "instead")
"""Those that are tried with one of these, or with each other, after them."""

Function = Callable[..., Any]
Cases = Sequence[tuple[Any, ...]]


def guarded(function: Function) -> Function:
    """Return a student's function with loops that cannot be endless; itself where its source is not at hand."""
    text = written(function)
    if text is None or inspect.isclass(function):
        return function
    return Source(function, function, {}, {}, text).compiled()


def repairs(
    part: Part,
    function: Function,
    right: Sequence[Any],
    answers: Sequence[Any],
    cases: Cases,
    *,
    until: float,
    pairs: bool = False,
    nearer: Nearer | None = None,
    lines: Lines | None = None,
) -> list[Repair]:
    """Return the likeliest change that makes a student's function right, or one for each wrong thing of several.

    Where another change makes it right as well, and may be meant, both are returned.

    Parameters
    ----------
    part : Part
    function : callable
        The student's.
    right, answers : sequence
        What is expected and what it returned, in each case.
    cases : sequence of tuple
    until : float
        When the search ends, as `time.process_time` has it: a busy machine finds the same.
    pairs : bool
        Try two changes at once.
    nearer : Nearer, optional
        Is given the changes that make only a part of the answer right.
    lines : Lines, optional
        What is known of the lines of the function.
    """
    wrong = [not agree(part, a, b, c) for a, b, c in zip(answers, right, cases)]
    rare = 2 * sum(wrong) < len(wrong)
    first = smallest({k: cases[k] for k, bad in enumerate(wrong) if bad})
    every = range(len(part.returns)) if len(part.returns) > 1 and part.canonical is None else ()
    if not cases[first] and (part.canonical is not None or of_whole_numbers(part, right[first])):
        return []  # they are met by chance
    bad, words = {k for k in every if not same(part, answers, right, k)}, of_words(part, right[first])
    if words and len(words) == len(part.returns):
        return []
    found: dict[int, Repair] = {}
    chosen, sound = Chosen(lines, few=not cases[first]), Sound(part, function)
    source = source_of(part, function, cases[first])
    if source is None or (pairs and rare):  # two slips that make up for each other in most cases are not made
        return []
    if nearer is not None:
        nearer.begin(source, first, _seconds(part, function, cases[first]))
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        for edit in _changes(part, function, source, cases[first], until, pairs, rare, len(cases)):
            if (chosen.sure and pairs) or chosen.ended(edit.kind):
                break
            answer = tried(part, edit.function, cases[first])
            here = {k for k in bad - words - {*found} if same(part, [answer], [right[first]], k)}
            if not here and not agree(part, answer, right[first], cases[first]):
                if nearer is not None:
                    nearer.note(edit, answer)
                continue
            others = [tried(part, edit.function, arguments) for arguments in cases]
            if all(agree(part, a, b, c) for a, b, c in zip(others, right, cases)):
                if copied_results(others, right, answers) or not sound.good(edit.function, cases[first]):
                    continue  # what is asked for in two ways is not computed in one
                edit = source.as_written(edit, lambda f: _right(part, f, right[first], cases[first]))
                repair = Repair(edit, meaning=meaning(source, edit, part, right, cases))
                chosen.add(_marked(repair, sound))
                continue
            if edit.kind == "result" or all(
                same(part, others, answers, k) or same(part, others, right, k) for k in {*every} - here
            ):
                found.update((k, chosen.judged(Repair(edit, k))) for k in here if same(part, others, right, k))
            elif nearer is not None:
                nearer.note(edit, answer)
                if all(same(part, others, right, k) for k in {*every} - bad):
                    nearer.pieces |= {k: edit for k in here - {*nearer.pieces} if same(part, others, right, k)}
    if nearer is not None:
        nearer.pieces, nearer.bad = nearer.pieces | {k: repair.edit for k, repair in found.items()}, bad
    return chosen.reported or ([found[k] for k in sorted(found)] if found.keys() == bad else [])


def two_repairs(
    part: Part, function: Function, nearer: Nearer, arguments: tuple[Any, ...], until: float
) -> list[Repair]:
    """Return two changes, one after the other, that make a student's function right, the first of them a part of it.

    Where there are no two, one for each of the things returned, though it spoils another that is wrong anyway.
    """
    chance, whole = by_chance(part, arguments, len(nearer.cases)), bool(arguments) and not inspect.isclass(function)
    text = text_written(function)

    def chosen(source: Source) -> Iterator[Edit]:
        edits = (edit for edit in _single(source, whole) if edit.kind not in chance)
        return (edit for edit in edits if plausible(edit, text, part))

    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        both = nearer.second(chosen, until)
    if both:
        return [Repair(other, first=both[0]) for other in both[1]]
    pieces = sorted(nearer.pieces) if nearer.bad and nearer.pieces.keys() == nearer.bad else []
    return [Repair(nearer.pieces[k], k) for k in pieces]


def source_of(part: Part, function: Function, arguments: tuple[Any, ...]) -> Source | None:
    """Return the syntax tree of a student's function and its helpers, None where it is not at hand."""
    text = written(function)
    if text is None:
        return None

    def call(*given: Any) -> Any:
        return part.value(function, given)

    try:
        helpers = [getattr(function, "__globals__", {}).get(getattr(x, "name", "")) for x in ast.parse(text).body]
        shown = local_values(call, (function, *helpers), copied(arguments))
        return Source(function, function, shown, {"tw": Remembering(twistwrench)}, text)
    except Exception:  # it does not run again as it did
        return None


def _changes(
    part: Part,
    function: Function,
    source: Source,
    arguments: tuple[Any, ...],
    until: float,
    pairs: bool,
    rare: bool,
    every: int,
) -> Iterator[Edit]:
    """Yield the changes of a student's function, for as long as a search may take."""
    chance, text = by_chance(part, arguments, every), text_written(function)
    whole = bool(arguments) and not inspect.isclass(function)
    for edit in _pairs(source) if pairs else _single(source, whole):
        if time.process_time() > until:
            return
        if rare and edit.kind == "inserted" and not edit.wrong.startswith("abs("):
            continue  # a factor that is missing spoils most cases
        if (edit.kind not in chance or _off_by_one(edit)) and plausible(edit, text, part):
            yield edit


def _off_by_one(edit: Edit) -> bool:
    """Whether an index or an argument is off by one: there are so few of these that none is right by chance."""
    return edit.by_one and isinstance(edit.inside, ast.Call | ast.Slice | ast.Subscript)


def _pairs(source: Source) -> Iterator[Edit]:
    """Yield two changes at once, those of the likeliest kinds first."""
    yield from source.pairs(PAIRED)
    for edit in source.pairs(PAIRED + FURTHER):
        if edit.kind in FURTHER or (edit.first and edit.first[0] in FURTHER):
            yield edit


def _single(source: Source, arguments: bool) -> Iterator[Edit]:
    """Yield each change by itself; those of arguments and results after those of a sign or a term."""
    for kind in KINDS:
        yield from source.edits(kind)
        if kind == "instead" and arguments:  # a line says more than what goes in or comes out
            yield from (edit for edit in of_arguments(source.compiled()) if not edit.wrong.startswith("0 *"))
        if kind == "index" and arguments:  # their order is given: it is seldom mistaken
            yield from of_order(source.compiled())


def _marked(repair: Repair, sound: Sound) -> Repair:
    """Return a change with the mark what is wrong after it in special cases."""
    narrow = sound.fails(repair.edit.function)
    only = sound.only(repair.edit.function) if narrow else ""
    if only == "whole" and "+= " in repair.edit.wrong and "+= " not in repair.edit.right:
        return repair  # it is the `+=` that is put there
    return replace(repair, narrow="" if only else narrow, only=only)


def _seconds(part: Part, function: Function, arguments: tuple[Any, ...]) -> float:
    """Return how long an answer takes."""
    start = time.perf_counter()
    tried(part, function, arguments)
    return time.perf_counter() - start


def _right(part: Part, function: Function, right: Any, arguments: tuple[Any, ...]) -> bool:
    """Whether a function gives the right answer in one case."""
    return agree(part, tried(part, function, arguments), right, arguments)
