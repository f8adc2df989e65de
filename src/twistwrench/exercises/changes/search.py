"""The search for the small edit of the right function that gives the student's own numbers."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

import twistwrench

from ..calls import copied, local_values, smallest, tried
from ..cases import special_cases, special_name
from ..compare import ROUNDING, agree, close, values
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text
from .edits import edits
from .places import changed_around
from .planets import on_earth
from .whole import Edit

__all__ = [
    "Found",
    "Remembering",
    "by_chance",
    "exchanged",
    "exchanged_results",
    "found_edits",
    "of_whole_numbers",
    "of_words",
    "right_where",
    "said_where",
    "same",
]

MANY = 6
"""Numbers in an answer that are not met by chance."""

Answers = Sequence[Any]
Cases = Sequence[tuple[Any, ...]]


SURE = 64
"""Times that yes or no is not right by chance."""


class Found(NamedTuple):
    """An edit that gives the student's numbers, and in which of the things returned: None for all of them."""

    edit: Edit
    piece: int | None

    def title(self) -> Text:
        """Report what is done in place of what."""
        title = say(f"edit {self.edit.kind}", right=self.edit.right, wrong=self.edit.wrong)
        if self.edit.statement and self.edit.statement.partition("= ")[2] != self.edit.right:
            title = say("in line", title=title, statement=self.edit.statement)
        if self.edit.first is not None:
            kind, right, wrong, _ = self.edit.first
            return say("both edits", first=say(f"edit {kind}", right=right, wrong=wrong), second=title)
        return said_where(self.edit, title)


def said_where(edit: Edit, title: Text) -> Text:
    """Add to a title in how many places an edit is made."""
    if not edit.everywhere:
        around = changed_around(edit.places[0], edit.right)[0] if edit.places else ""
        return say("in place", title=title, around=around) if around else title
    if edit.everywhere == 2 and len({*edit.around}) == 2:
        return say("both places", title=title, first=edit.around[0], second=edit.around[1])
    return say("twice" if edit.everywhere == 2 else "everywhere", title=title)


def found_edits(part: Part, answers: Answers, cases: Cases, *, until: float) -> list[Found]:
    """Return the likeliest edit that gives all of an answer, or one for each wrong thing of several returned.

    The search ends when `time.process_time` is `until`.
    """
    right = [part.value(part.solution, copied(arguments)) for arguments in cases]
    wrong = [not agree(part, a, b, arguments) for a, b, arguments in zip(answers, right, cases)]
    first = smallest({k: cases[k] for k, bad in enumerate(wrong) if bad})
    several = len(part.returns) > 1 and part.canonical is None
    bad = [k for k in range(len(part.returns)) if not same(part, answers, right, k)] if several else []
    if len(part.returns) == 1 and _is_zero(part, answers, 0):
        return []  # which anything may be
    bad = [k for k in bad if not _is_zero(part, answers, k)]
    found: dict[int, Edit] = {}
    for edit in candidates(part, cases[first], until=until, every=len(cases)):
        answer = tried(part, edit.function, cases[first])
        alone = (
            [] if edit.kind in ("number", "index") and not cases[first] else bad
        )  # one of few numbers is met by chance
        here = [k for k in alone if k not in found and same(part, [answers[first]], [answer], k)]
        if not here and not agree(part, answers[first], answer, cases[first]):
            continue
        others = [tried(part, edit.function, arguments) for arguments in cases]
        if all(agree(part, a, b, c) for a, b, c in zip(answers, others, cases)):
            return [Found(edit, None)]
        found.update((k, edit) for k in here if same(part, answers, others, k))
    return [Found(found[k], k) for k in bad if k in found]


def candidates(part: Part, arguments: tuple[Any, ...], *, until: float = np.inf, every: int = 1) -> Iterator[Edit]:
    """Yield the edits of all right ways, for as long as a search may take."""
    chance = by_chance(part, arguments, every)
    names = {"tw": Remembering(twistwrench)}
    for way in (part.solution, *part.ways):
        listings = part.beside if way is part.solution else ()
        call = _calling(part, way)
        shown = local_values(call, (way, *listings), copied(arguments))
        for edit in edits(way, listings, shown=shown, names=names):
            if time.process_time() > until:
                return
            if edit.kind not in chance:
                yield edit


def of_whole_numbers(part: Part, answer: Any) -> bool:
    """Whether an answer has only whole numbers in it."""
    arrays = [x.array for x in values(answer, part.returns) or []]
    return all(x is not None and bool((x == np.trunc(x)).all()) for x in arrays)


def of_words(part: Part, answer: Any) -> set[int]:
    """Return which of several things in an answer are words, as the name of an error: any slip may raise it."""
    return {k for k, x in enumerate(values(answer, part.returns) or []) if x.array is None}


def by_chance(part: Part, arguments: tuple[Any, ...], cases: int = 1) -> tuple[str, ...]:
    """Return the kinds of edits that say nothing here: one number, or yes and no in few cases, is met by chance."""
    right = values(part.value(part.solution, copied(arguments)), part.returns) or []
    truths = any(x.array is not None and x.array.dtype.kind == "b" for x in right)
    few = not arguments and sum(np.size(x.raw) for x in right) <= MANY
    return ("index", "number", "inserted") if truths and cases < SURE else ("number", "inserted") if few else ()


PROBES: dict[str, Callable[[Any], Any]] = {
    "diagonal": lambda x: [*map(_diagonal, x)] if isinstance(x, list) else _diagonal(x),
    "0": lambda x: [0 * y for y in x] if isinstance(x, list) else 0 * x[...],
    "1": lambda x: [*map(_one, x)] if isinstance(x, list) else _one(x),
    "unturned": lambda x: [*map(_unturned, x)] if isinstance(x, list) else _unturned(x),
}
"""Simple values of an argument, on which a wrong function may be right."""

SHAPES = {"diagonal": "diagonal only", "unturned": "unturned only"}
"""What is said of those that are no number."""


def _matrices(x: Sequence[Any]) -> bool:
    """Whether there are matrices, and not rows of vectors: little is left to compute where they are zero."""
    arrays = [np.asarray(z) for y in x for z in (y if isinstance(y, list) else [y])]
    square = all(y.ndim > 1 and y.shape[-1] == y.shape[-2] for y in arrays)
    return square or any(y.ndim > 1 and y.shape[-1] > 3 for y in arrays)


def _diagonal(x: Any) -> Any:
    if not isinstance(x, np.ndarray) or x.ndim != 2 or len({*x.shape}) != 1 or np.allclose(x @ x.mT, np.eye(len(x))):
        raise TypeError("a square matrix is expected that is not a rotation")
    return np.diag(np.diag(x))


def _unturned(x: Any) -> Any:
    if not isinstance(x, np.ndarray) or x.shape[-2:] != (4, 4) or not (x[..., 3, :] == (0, 0, 0, 1)).all():
        raise TypeError("placements are expected")
    other = x.copy()
    other[..., :3, :3] = np.eye(3)
    return other


def _one(x: Any) -> Any:
    if not isinstance(x, np.ndarray) or x.ndim < 2 or x.shape[-1] != x.shape[-2]:
        raise TypeError("a matrix is expected")
    return np.broadcast_to(np.eye(x.shape[-1]), x.shape).copy()


def right_where(part: Part, again: Callable[[tuple[Any, ...]], Any], cases: Cases) -> Text | None:
    """Report for which argument a simple value makes the student's function right, if there is one."""
    names, special = part.arguments.split(", "), special_cases(part, 0)
    if any(map(callable, cases[0])):
        return None  # what these do is not seen in a few cases
    for k, name in enumerate(names):
        for value, simple in PROBES.items():
            if value in ("0", "1") and (len(names) == 1 or name == "q"):
                continue  # little is left to compute, or it is not a configuration
            if value == "0" and _matrices([c[k] for c in cases]):
                continue
            try:
                tests, rare = ([(*c[:k], simple(c[k]), *c[k + 1 :]) for c in some] for some in (cases, special))
            except (IndexError, TypeError):  # no such value
                continue
            pairs = [(test, right) for test in tests if _telling(right := tried(part, part.solution, test))]
            if pairs and all(agree(part, again(test), right, test) for test, right in pairs):
                found = say(SHAPES.get(value, "only where"), name=name, value=value)
                return _but_for(part, again, rare, found)
    return None


def _but_for(part: Part, again: Callable[[tuple[Any, ...]], Any], rare: Cases, found: Text) -> Text:
    """Add to when a function is right the special cases in which it is then wrong."""
    expected = [tried(part, part.solution, test) for test in rare]
    pairs = enumerate(zip(rare, expected))
    bad = [k for k, (test, x) in pairs if x is not None and not agree(part, again(test), x, test)]
    if bad and all(on_earth(rare[k]) is not None for k in bad):
        return say("but elsewhere", found=found)
    return say("but for", found=found, case=special_name(part, bad[0])) if bad else found


def _telling(answer: Any) -> bool:
    """Whether a right answer has only finite numbers, and not only zeros."""
    arrays = [np.asarray(x) for x in (answer if isinstance(answer, tuple) else [answer])]
    return all(x.dtype.kind == "f" and np.isfinite(x).all() for x in arrays) and any(x.any() for x in arrays)


def _calling(part: Part, way: Callable[..., Any]) -> Callable[..., Any]:
    return lambda *arguments: part.value(way, arguments)


def same(part: Part, first: Answers, second: Answers, k: int) -> bool:
    """Whether two answers have the same k-th thing in all cases."""
    for a, b in zip(first, second):
        x, y = values(a, part.returns), values(b, part.returns)
        if x is None or y is None or not close(x[k], y[k], part.rtol):
            return False
    return True


def _is_zero(part: Part, answers: Answers, k: int) -> bool:
    """Whether the k-th thing in all answers is zero, but for rounding."""
    arrays = [x[k].array for answer in answers if (x := values(answer, part.returns))]
    zeros = (x is not None and x.dtype.kind == "f" and not (np.abs(x) > ROUNDING).any() for x in arrays)
    return bool(arrays) and all(zeros)


def exchanged_results(part: Part, answers: Answers, cases: Cases) -> Text | None:
    """Report which two of the things returned are exchanged, if that is all that is wrong."""
    for i in range(len(part.returns)) if part.canonical is None else ():
        for j in range(i):
            if all(
                agree(part, exchanged(a, i, j), part.value(part.solution, copied(c)), c) for a, c in zip(answers, cases)
            ):
                return say("results exchanged", first=part.returns[j].title, second=part.returns[i].title)
    return None


def exchanged(answer: Any, i: int, j: int) -> Any:
    """Return an answer with two of its things exchanged; None where it has not as many."""
    if not isinstance(answer, tuple | list) or len(answer) <= max(i, j):
        return None
    return tuple(answer[j if k == i else i if k == j else k] for k in range(len(answer)))


class Remembering:
    """The package, whose functions compute nothing twice: most edits leave most calls as they are."""

    def __init__(self, package: ModuleType) -> None:
        self._package, self._known = package, dict[Any, Any]()

    def __getattr__(self, name: str) -> Any:
        function = getattr(self._package, name)
        if not callable(function) or isinstance(function, type):
            return function

        def remembered(*arguments: Any, **named: Any) -> Any:
            given = (*arguments, *named.values())
            key = (name, *named, *((x.shape, x.tobytes()) if isinstance(x, np.ndarray) else _key(x) for x in given))
            if key not in self._known:
                self._known[key] = function(*arguments, **named), given
            return _fresh(self._known[key][0])

        return remembered


def _fresh(x: Any) -> Any:
    """Return a copy of the arrays of a result, as a wrong function may write into them."""
    if isinstance(x, np.ndarray):
        return x.copy()
    if isinstance(x, list | tuple):
        entries = [_fresh(y) for y in x]
        return entries if isinstance(x, list) else type(x)(*entries) if hasattr(x, "_fields") else tuple(entries)
    return x


def _key(x: Any) -> Any:
    return x if isinstance(x, int | float | str) else repr(x) if isinstance(x, list | tuple) else id(x)
