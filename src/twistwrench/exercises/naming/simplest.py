"""What wrong answers share: the simplest arguments that give one, an edge on which they all lie, an entry that is 0."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from ...arrays import Array
from ..calls import tried
from ..compare import FLOOR, agree, values
from ..exercise import Part
from ..slips import SLIPS
from ..words.phrases import say
from ..words.text import Text
from .relations import TELLING, plain
from .sizes import digits, same, too_large

__all__ = ["of_words", "shared"]

SHOWN = 3
"""Of the simplest arguments."""

FEW = 3
"""Cases in which a number has to be wrong, for what is said of them all."""

EXACT, NEAR = 2.0**-50, 2e-6
"""Parts of a number by which it is changed: who is on an edge, or near it, is then not any more."""

Case = tuple[Any, ...]


def of_words(part: Part, again: Callable[[Case], Any], cases: Sequence[Case]) -> list[Text]:
    """Report for which single words, or pairs of them, of a list of words a whole number is wrong, and by how much."""
    lists = [c[0] for c in cases if len(c) == 1 and isinstance(c[0], list | tuple)]
    if len(lists) < len(cases) or not all(isinstance(x, str) for words in lists for x in words) or not any(lists):
        return []
    words = sorted({x for c in cases for x in c[0]})
    lines: list[Text] = []
    for given in ([[x] for x in words], [[x, y] for x in words for y in words]):
        for one in given:
            lines += _apart(part, again, one) if len(lines) < SHOWN else []
        if lines:
            break
    return lines


def _apart(part: Part, again: Callable[[Case], Any], given: list[str]) -> Iterator[Text]:
    name = part.arguments.partition("=")[0]
    got, right = values(again((given,)), part.returns), values(tried(part, part.solution, (given,)), part.returns)
    for a, b in zip(got or (), right or ()):
        if a.array is not None and b.array is not None and a.array.shape == b.array.shape == () and a.array != b.array:
            a_number, b_number = f"{float(a.array):g}", f"{float(b.array):g}"
            yield say("simplest", name=name, given=given, what=a.quantity.title, got=a_number, right=b_number)


def shared(part: Part, answers: Sequence[Any], right: Sequence[Any], cases: Sequence[Case]) -> list[Text]:
    """Report what all wrong answers share; of those that are True or False, what no right one has."""
    if not all(isinstance(x, bool | np.bool_) for pair in zip(answers, right) for x in pair):
        zero = _of_zeros(part, answers, right, cases)
        return [*_of_sizes(part, answers, right), *_lost_nan(part, answers, right), *zero]
    wrong = [c for a, b, c in zip(answers, right, cases) if bool(a) is not bool(b)]
    fine = [c for a, b, c in zip(answers, right, cases) if bool(a) is bool(b)]
    if len(wrong) < 2:
        return []
    lines = []
    if all(_on_edge(part, c, EXACT) for c in wrong):
        lines.append(say("on edge"))
    elif all(_on_edge(part, c, NEAR) for c in wrong):
        lines.append(say("near edge"))
    names = [name.partition("=")[0] for name in part.arguments.split(", ")]
    every = set[str].intersection(*(_zeros(names, c) for c in wrong))
    if every and not any(every <= _zeros(names, c) for c in fine):
        lines.append(say("all zero", what=" = ".join(sorted(every))))
    return lines


def _of_zeros(part: Part, answers: Sequence[Any], right: Sequence[Any], cases: Sequence[Case]) -> Iterator[Text]:
    """Report an argument that is zero in all wrong cases and few right ones, and joints that are in all right ones."""
    names = [name.partition("=")[0] for name in part.arguments.split(", ")]
    zeros = [{name for name, x in _numbers(names, c) if not x.any()} for c in cases]
    good = [agree(part, a, b, c) for a, b, c in zip(answers, right, cases)]
    wrong, fine = ([x for x, yes in zip(zeros, good) if yes is chosen] for chosen in (False, True))
    for name in sorted(set[str].intersection(*wrong) if wrong else ()):
        if 2 * sum(name in x for x in fine) < len(fine):
            yield say("zero wrong", what=name)
    if fine and all("q[7:]" in x for x in fine) and not any("q[7:]" in x for x in wrong):
        yield say("zero right", what="q[7:]")


def _numbers(names: Sequence[str], arguments: Case) -> Iterator[tuple[str, Array]]:
    """Yield the arguments that are numbers, and of a configuration the joints', with the names of them."""
    for name, x in zip(names, arguments):
        if isinstance(x, float | np.ndarray):
            x = np.asarray(x)
            yield ("q[7:]", x[7:]) if name == "q" and x.ndim == 1 and x.size > 7 else (name, x)


def _of_sizes(part: Part, answers: Sequence[Any], right: Sequence[Any]) -> list[Text]:
    """Report of each result what holds in all cases in which it is wrong.

    Of a number: that it is too large, too small or of the other sign; of all: that it is nearly right.
    """
    lines = []
    split = [(values(a, part.returns) or [], values(b, part.returns) or []) for a, b in zip(answers, right)]
    for pairs in zip(*([*zip(*pair)] for pair in split)):
        arrays = [(a.array, b.array) for a, b in pairs]
        if not all(a is not None and b is not None and _comparable(a, b) for a, b in arrays):
            continue
        three = [(a, b, part.rtol * np.abs(b).max(initial=FLOOR)) for a, b in arrays]
        wrong = [(a, b, within) for a, b, within in three if not same(a, b, within)]
        relation = _of_all(wrong) if wrong else None
        if relation is not None:
            lines.append(say("is", what=pairs[0][0].quantity.label, relation=relation))
    return lines


def _comparable(a: Array, b: Array) -> bool:
    return a.shape == b.shape and a.dtype.kind == b.dtype.kind == "f" and bool(np.isfinite([a, b]).all())


def _of_all(wrong: Sequence[tuple[Array, Array, float]]) -> Text | None:
    """Return what holds of all wrong numbers or arrays, beside the right ones and with what counts as the same."""
    if all(digits(a, b) for a, b, _ in wrong):
        return say("approximation")
    simple = {plain(*three, TELLING) for three in wrong}
    if len(wrong) < FEW or wrong[0][0].ndim or (len(simple) == 1 and simple != {None}):  # which is said of each
        return None
    relation = too_large([(a, b) for a, b, _ in wrong])
    return say("in all wrong", relation=relation) if relation is not None else None


def _lost_nan(part: Part, answers: Sequence[Any], right: Sequence[Any]) -> Iterator[Text]:
    """Report of each result that it has a number somewhere where nan is expected."""
    pairs = [zip(values(a, part.returns) or (), values(b, part.returns) or ()) for a, b in zip(answers, right)]
    lost = [a.quantity.title for pair in pairs for a, b in pair if _finite_for_nan(a.array, b.array)]
    for title in dict.fromkeys(lost):
        yield say("nan lost", name=title)
        yield SLIPS["nan-lost"].why


def _finite_for_nan(a: Array | None, b: Array | None) -> bool:
    if a is None or b is None or a.shape != b.shape or not a.dtype.kind == b.dtype.kind == "f":
        return False
    return bool(np.isfinite(a[np.isnan(b)]).any())


def _zeros(names: Sequence[str], arguments: Case) -> set[str]:
    """Return the entries of the arguments that are zero."""
    arrays = [(name, np.ravel(x)) for name, x in zip(names, arguments) if isinstance(x, np.ndarray)]
    return {f"{name}[{k}]" for name, x in arrays for k in range(x.size) if x[k] == 0}


def _on_edge(part: Part, arguments: Case, share: float) -> bool:
    """Whether the right answer changes where a number changes by a very small share of it."""
    known = tried(part, part.solution, arguments)
    for k, x in enumerate(arguments):
        if not isinstance(x, float | np.ndarray) or np.asarray(x).dtype.kind != "f":
            continue
        for entry in range(np.size(x)):
            for factor in (1 - share, 1 + share):
                y = np.array(x)
                y.flat[entry] *= factor
                other = (*arguments[:k], y if isinstance(x, np.ndarray) else float(y), *arguments[k + 1 :])
                if not agree(part, tried(part, part.solution, other), known, other):
                    return True
    return False
