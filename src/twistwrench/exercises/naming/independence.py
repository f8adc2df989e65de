"""What a wrong result does not depend on, and should: an argument, or an entry of one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from operator import is_
from typing import Any

import numpy as np

from ..calls import tried
from ..compare import Value, close, values
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text

__all__ = ["not_used"]

TRIED = 3
"""Cases in which the result must not change."""

FEW = 6
"""Entries of an argument that are changed one by one."""

Case = tuple[Any, ...]


def not_used(
    part: Part, again: Callable[[Case], Any], answers: Sequence[Any], right: Sequence[Any], cases: Sequence[Case]
) -> list[Text]:
    """Report each thing returned that does not change with an argument with which the right one does.

    Parameters
    ----------
    part : Part
    again : callable
        Calls the student's function with other arguments.
    answers, right : sequence
        What it returned, and what is expected, in each case.
    cases : sequence of tuple
    """
    wrong = [(a, b, c) for a, b, c in zip(answers, right, cases) if _changed(part, a, b)][:TRIED]
    good = [(a, c) for a, b, c in zip(answers, right, cases) if not _changed(part, a, b)][:TRIED]
    lines: list[Text] = []
    given = min((len(c) for _, _, c in wrong), default=0) if part.canonical is None else 0
    for k, name in enumerate([name.partition("=")[0] for name in part.arguments.split(", ")][:given]):
        for entry in (None, *range(FEW)):
            unmoved = [
                _unmoved(part, again, a, b, [(*c[:k], x, *c[k + 1 :]) for x in _others(c[k], entry, cases, k)])
                for a, b, c in wrong
            ]
            what = _differing(name, wrong[0][2][k], cases, k) if entry is None else f"{name}[{entry}]"
            common = sorted(set[int].intersection(*unmoved))
            for a, c in good if common else ():  # where it is right, it may come into it
                others = [(*c[:k], x, *c[k + 1 :]) for x in _others(c[k], entry, cases, k)]
                common = [j for j in common if not any(j in _changed(part, again(x), a) for x in others)]
            lines += [say("not used", name=part.returns[piece].title, what=what) for piece in common]
            if common and entry is None:
                break
    return lines


def _unmoved(part: Part, again: Callable[[Case], Any], answer: Any, right: Any, others: Sequence[Case]) -> set[int]:
    """Return the wrong things of an answer that stay as they are with other arguments, while the right ones change."""
    wrong, wanted, moved = _changed(part, answer, right), set[int](), set[int]()
    for other in others:
        expected = tried(part, part.solution, other)
        if wrong & _changed(part, expected, right):
            wanted |= _changed(part, expected, right)
            moved |= _changed(part, again(other), answer)
    return wrong & wanted - moved - {k for k, x in enumerate(values(right, part.returns) or []) if _truth(x)}


def _differing(name: str, x: Any, cases: Sequence[Case], k: int) -> str:
    """Return the name of an argument, and of its gravity where models differ in nothing else."""
    inertias = [getattr(c[k], "inertia", None) for c in cases]
    alike = all(x is not None and all(map(is_, x, inertias[0] or ())) for x in inertias)
    return f"{name}.gravity" if alike and hasattr(x, "gravity") else name


def _truth(x: Value) -> bool:
    """Whether a value is True or False: it stays as it is with most changes."""
    return x.array is None or x.array.dtype.kind == "b"


def _changed(part: Part, answer: Any, other: Any) -> set[int]:
    """Return which of the things returned differ; none where they cannot be compared."""
    first, second = values(answer, part.returns), values(other, part.returns)
    if first is None or second is None:
        return {*range(len(part.returns))} if first is None and second is not None and answer is None else set()
    return {k for k, (a, b) in enumerate(zip(first, second)) if not close(a, b, part.rtol)}


def _others(x: Any, entry: int | None, cases: Sequence[Case], k: int) -> Iterator[Any]:
    """Yield other values of an argument: of another case, or with one entry changed."""
    if entry is None:
        if isinstance(x, float):
            yield 1.25 * x + 0.1
        if isinstance(x, list | tuple) and x and all(isinstance(y, str) for y in x):
            yield x[::-1]
        words = isinstance(x, list) and all(isinstance(y, str) for y in x)  # of any number
        alike = [c[k] for c in cases if type(c[k]) is type(x) and (words or _sizes(c[k]) == _sizes(x))]
        yield from [other for other in alike if other is not x][:TRIED]
    elif isinstance(x, np.ndarray) and x.ndim == 1 and entry < x.size <= FEW and x.dtype.kind == "f":
        for scale in (1.25, 0):  # beyond a limit, and within it
            other = x.copy()
            other[entry] = 0.1 + scale * x[entry]
            yield other


def _sizes(x: Any) -> Any:
    """Return what two arguments must have in common to be put in each other's place."""
    return [getattr(y, "shape", ()) for y in x] if isinstance(x, list | tuple) else getattr(x, "shape", ())
