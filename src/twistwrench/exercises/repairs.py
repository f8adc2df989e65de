"""The small change of the student's own function that makes it right."""

from __future__ import annotations

import ast
import inspect
import io
import linecache
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from types import FunctionType
from typing import Any

import twistwrench

from .alternatives import KINDS
from .calls import copied, local_values, tried
from .compare import agree, close, values
from .edits import Source
from .exercise import Part
from .phrases import say
from .plausible import plausible, shuts
from .search import Remembering, by_chance, said_where
from .text import Text
from .whole import Edit, of_arguments, of_order

__all__ = ["Repair", "guarded", "repairs", "written"]

PAIRED = ("sign", "transposed", "exchanged", "left out", "name")
"""The kinds of changes of which two are tried at once."""

OF_RESULT = {
    "np.roll(x, len(x) // 2, 0)": "halves of result",
    "np.linalg.inv(x)": "inverse of result",
    "x[6:]": "first six of result",
}
"""What a change of the result says of the answer."""

Function = Callable[..., Any]
Cases = Sequence[tuple[Any, ...]]


@dataclass(frozen=True)
class Repair:
    """A change that makes a student's function right, or one of the things that it returns.

    Attributes
    ----------
    edit : Edit
    before : int
        Lines of the file before the function.
    piece : int, optional
        Which of the things is right by it; None for all.
    """

    edit: Edit
    before: int
    piece: int | None = None

    def title(self) -> Text:
        """Report what must stand where."""
        edit = self.edit
        title = say(f"repair {edit.kind}", right=edit.wrong, wrong=edit.right)
        if shuts(edit):
            title = say("branch", wrong=edit.right)
        if edit.kind == "result" and edit.wrong in OF_RESULT:
            return say(OF_RESULT[edit.wrong], title=title)
        if edit.line:
            title = said_where(edit, title)
            title = say("in own line", line=edit.line + self.before, title=title)
        if edit.first is not None:
            kind, wrong, right, line = edit.first
            other = say(f"repair {kind}", right=right, wrong=wrong)
            return say("both edits", first=say("in own line", line=line + self.before, title=other), second=title)
        return title


def guarded(function: Function) -> Function:
    """Return a student's function with loops that cannot be endless; itself where its source is not at hand."""
    found = written(function)
    if found is None or inspect.isclass(function):
        return function
    return Source(function, function, {}, {}, found[0]).compiled()


def repairs(
    part: Part,
    function: Function,
    right: Sequence[Any],
    answers: Sequence[Any],
    cases: Cases,
    *,
    until: float,
    pairs: bool = False,
) -> list[Repair]:
    """Return the likeliest change that makes a student's function right, or one for each wrong thing of several.

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
    """
    wrong = [not agree(part, a, b, c) for a, b, c in zip(answers, right, cases)]
    if pairs and 2 * sum(wrong) < len(wrong):
        return []  # two slips that make up for each other in most cases are not made
    first = min((k for k, bad in enumerate(wrong) if bad), key=lambda k: _seconds(part, function, cases[k]))
    several = len(part.returns) > 1 and part.canonical is None
    bad = {k for k in range(len(part.returns)) if several and not _same(part, answers, right, k)}
    fine = {k for k in range(len(part.returns)) if several} - bad
    found: dict[int, Repair] = {}
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        for edit, before in _changes(part, function, cases[first], until, pairs):
            answer = tried(part, edit.function, cases[first])
            here = {k for k in bad - {*found} if _same(part, [answer], [right[first]], k)}
            if not here and not agree(part, answer, right[first], cases[first]):
                continue
            others = [tried(part, edit.function, arguments) for arguments in cases]
            if all(agree(part, a, b, c) for a, b, c in zip(others, right, cases)):
                return [Repair(edit, before)]
            if edit.kind == "result" or all(_same(part, others, answers, k) for k in fine):
                found.update((k, Repair(edit, before, k)) for k in here if _same(part, others, right, k))
    return [found[k] for k in sorted(found)] if found.keys() == bad else []


def _changes(
    part: Part, function: Function, arguments: tuple[Any, ...], until: float, pairs: bool
) -> Iterator[tuple[Edit, int]]:
    """Yield the changes of a student's function and the lines before it, for as long as a search may take."""
    found = written(function)
    if found is None:
        return
    text, before = found

    def call(*given: Any) -> Any:
        return part.value(function, given)

    try:
        shown = local_values(call, function, copied(arguments))
        source = Source(function, function, shown, {"tw": Remembering(twistwrench)}, text)
    except Exception:  # it does not run again as it did
        return
    chance = by_chance(part, arguments)
    whole = bool(arguments) and not inspect.isclass(function)
    for edit in source.pairs(PAIRED) if pairs else _single(source, whole):
        if time.process_time() > until:
            return
        if edit.kind not in chance and plausible(edit, text, part.solution):
            yield edit, before


def _single(source: Source, arguments: bool) -> Iterator[Edit]:
    """Yield each change by itself; those of arguments and results after those of a sign or a term."""
    for kind in KINDS:
        yield from source.edits(kind)
        if kind == "left out" and arguments:
            yield from (edit for edit in of_arguments(source.compiled()) if not edit.wrong.startswith("0 *"))
        if kind == "index" and arguments:  # their order is given: it is seldom mistaken
            yield from of_order(source.compiled())


def written(function: Function) -> tuple[str, int] | None:
    """Return the source of a student's function or class, and how many lines are before it; None if it is unknown."""
    code = getattr(function, "__code__", None)
    if code is None and inspect.isclass(function):
        code = next((x.__code__ for x in vars(function).values() if isinstance(x, FunctionType)), None)
    if code is None or (not inspect.isclass(function) and code.co_name != function.__name__):
        return None  # it is wrapped
    if getattr(function, "__closure__", None):
        return None  # it cannot be compiled by itself
    linecache.checkcache(code.co_filename)
    lines = linecache.getlines(code.co_filename)
    try:
        nodes = ast.walk(ast.parse("".join(lines)))
    except SyntaxError:
        return None
    for node in nodes:
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name == function.__name__:
            first = min([node.lineno, *(x.lineno for x in node.decorator_list)])
            if first <= code.co_firstlineno <= (node.end_lineno or first):
                node.decorator_list = []
                return "".join(lines[node.lineno - 1 : node.end_lineno]), node.lineno - 1
    return None


def _seconds(part: Part, function: Function, arguments: tuple[Any, ...]) -> float:
    """Return how long an answer takes."""
    start = time.perf_counter()
    tried(part, function, arguments)
    return time.perf_counter() - start


def _same(part: Part, first: Sequence[Any], second: Sequence[Any], k: int) -> bool:
    """Whether two answers have the same k-th thing in all cases."""
    for a, b in zip(first, second):
        x, y = values(a, part.returns), values(b, part.returns)
        if x is None or y is None or not close(x[k], y[k], part.rtol):
            return False
    return True
