"""Changes that make a part of a wrong answer right: one after the other they mend a function with two slips."""

from __future__ import annotations

import ast
import re
import time
from collections.abc import Callable, Iterator, Sequence
from operator import ne
from typing import Any

import numpy as np

from ...arrays import Array
from ..calls import switches_off, tried
from ..compare import FLOOR, Value, agree, copied_results, values
from ..exercise import Part
from ..slips import SLIPS
from .edits import Source
from .likeness import alike
from .plausible import turns_the_rest
from .sound import Sound
from .whole import Edit

__all__ = ["Nearer"]

MOST = 10
"""First changes after which a second one is looked for."""

FEW = 2
"""Numbers in an answer of which a part says nothing: the cases that are right are counted instead."""

QUICK = 0.004
"""Seconds that a case may take where all of them are tried with each change."""

TURNS = ("sign", "transposed", "halves", "exchanged")
"""Kinds of changes that take nothing out."""

TWICE = ("swapped-halves", "transposed-answer")
"""Slips that turn all numbers round: with a change on the way in they are the same on the way out."""

Chosen = Callable[[Source], Iterator[Edit]]


class Nearer:
    """The changes of a student's function after which less is wrong, and nothing that was right.

    In `slips` are those after which it has the numbers of a slip of the list in one case, with the slip's name.

    Parameters
    ----------
    part : Part
    right, answers : sequence
        What is expected and what the student's function returned, in each case.
    cases : sequence of tuple
    """

    def __init__(
        self, part: Part, right: Sequence[Any], answers: Sequence[Any], cases: Sequence[tuple[Any, ...]]
    ) -> None:
        self.part, self.right, self.answers, self.cases = part, right, answers, cases
        self.found: dict[bytes, tuple[int, Edit]] = {}
        self.slips: list[tuple[Edit, str]] = []
        self.source: Source | None = None
        self.sound: Sound | None = None
        self.pieces: dict[int, Edit] = {}
        self.wrong: Array | None = None
        self.bad: set[int] = set()

    def begin(self, source: Source, first: int, seconds: float) -> None:
        """Compare with the answers in one case, or in all of them where an answer is only a number or two."""
        self.source, self.sound, self.found = source, Sound(self.part, source.solution), {}
        wrong = self._wrong([self.answers[first]], [first])
        few = wrong is not None and wrong.size <= FEW and seconds < QUICK
        self.tried = [*range(len(self.cases))] if few else [first]
        self.tried.remove(first)
        self.tried.insert(0, first)
        self.wrong = self._wrong([self.answers[k] for k in self.tried], self.tried)
        self.own = self._flat(self.answers[first])
        self.slipped = dict(self._slipped(first))

    def _slipped(self, k: int) -> Iterator[tuple[str, Array]]:
        """Yield the numbers of each slip of the list in a case, if what is wrong then is wrong in the answer, too."""
        own, right = self._flat(self.answers[k]), self._flat(self.right[k])
        if own is None or right is None:
            return
        within = 1e-9 * np.abs(right).max(initial=FLOOR)
        for name in (name for name in self.part.slips if name not in TWICE):
            numbers = self._flat(tried(self.part, self.part.slips[name], self.cases[k]))
            if numbers is not None and numbers.shape == own.shape == right.shape:
                fine = np.abs(own - right) <= within
                if (np.abs(numbers - right)[fine] <= within).all():
                    yield name, numbers

    def note(self, edit: Edit, answer: Any) -> None:
        """Keep a change, if less is wrong with it than without it, or if what is wrong then is a slip of the list."""
        numbers = self._flat(answer) if edit.places and _leaves_the_rest(edit) else None
        for name, slipped in self.slipped.items():
            if numbers is not None and _near(numbers, slipped):
                self.slips += [] if _near(numbers, self.own) else [(edit, name)]  # it must change something
        if self.wrong is None or self.wrong.sum() < 2 or not edit.places:
            return
        given = [answer, *(tried(self.part, edit.function, self.cases[k]) for k in self.tried[1:])]
        wrong = self._wrong(given, self.tried)
        if wrong is None or wrong.shape != self.wrong.shape or (wrong & ~self.wrong).any():
            return
        gained = self.wrong & ~wrong
        if gained.any() and (len(self.tried) > 1 or self._numbers(self.tried[0])[gained].any()):
            self.found.setdefault(self._key(given), (int(wrong.sum()), edit))  # of those with the same effect the first

    def second(self, chosen: Chosen, until: float) -> tuple[Edit, list[Edit]] | None:
        """Return a change and those of the likeliest kind of which each, made after it, makes all right."""
        best = sorted(self.found.values(), key=lambda pair: pair[0])[:MOST]
        for k, (_, edit) in enumerate(best):
            now = time.process_time()
            share = now + (until - now) / (len(best) - k)
            source = self.source.after(edit) if self.source else None
            others: list[Edit] = []
            for other in chosen(source) if source else ():
                if time.process_time() > share or (others and other.kind != others[0].kind):
                    break
                if other.kind == "transposed" and edit.wrong in other.right:
                    continue  # of a product that was turned already: its factors exchanged are the shorter way
                if turns_the_rest(edit, other):
                    continue
                if not any(alike(other, x) for x in others) and self._mends(other):
                    others.append(other)
            if others and self.source is not None and source is not None:
                return self._written(self.source, edit), [self._written(source, x) for x in others]
        return None

    def _written(self, source: Source, edit: Edit) -> Edit:
        """Return an edit with `.mT` in its text where `.T` would not do the same."""
        k = self.tried[0]
        same = tried(self.part, edit.function, self.cases[k])
        return source.as_written(
            edit, lambda f: agree(self.part, tried(self.part, f, self.cases[k]), same, self.cases[k])
        )

    def _mends(self, edit: Edit) -> bool:
        given: list[Any] = []
        for k in [self.tried[0], *range(len(self.cases))] if self.tried else ():
            given.append(tried(self.part, edit.function, self.cases[k]))
            if not agree(self.part, given[-1], self.right[k], self.cases[k]):
                return False
        once = bool(given) and not copied_results(given[1:], self.right, self.answers)
        if not once or self.sound is None:
            return False
        return self.sound.good(edit.function, self.cases[0]) and self.sound.everywhere(edit.function)

    def spoils(self, function: Callable[..., Any]) -> bool:
        """Whether a changed function gives wrong numbers where the answer has right ones."""
        if self.wrong is None:
            return False
        wrong = self._wrong([tried(self.part, function, self.cases[k]) for k in self.tried], self.tried)
        return wrong is None or wrong.shape != self.wrong.shape or bool((wrong & ~self.wrong).any())

    def change_and_slip(self) -> tuple[Edit, str] | None:
        """Return a change after which it has the numbers of a slip of the list in all cases, and the slip's name."""
        for edit, name in self.slips[:MOST]:
            slip = self.part.slips[name]
            lacks = SLIPS[name]._replace(title=self.part.titles.get(name, SLIPS[name].title)).lacks
            if lacks and edit.kind not in TURNS and not _is_of_rounds(edit):
                continue  # the change may have taken it out
            if self.source is None or switches_off(self.part, self.source.compiled(), edit.function, self.cases[0]):
                continue  # what is missing then was there before
            if all(
                agree(self.part, tried(self.part, edit.function, c), tried(self.part, slip, c), c) for c in self.cases
            ):
                return self._written(self.source, edit), name
        return None

    def _flat(self, answer: Any) -> Array | None:
        """Return the numbers of an answer, one after the other; None where it has not as many as the right one."""
        split = values(answer, self.part.returns) if self.part.canonical is None else None
        arrays = [x.array for x in split or [] if x.array is not None and x.array.dtype.kind == "f"]
        if not arrays or len(arrays) < len(self.part.returns):
            return None
        found = np.concatenate([np.ravel(x) for x in arrays])
        return found if found.size > FEW and np.isfinite(found).all() else None

    def _key(self, answers: Sequence[Any]) -> bytes:
        """Return by which the same numbers are recognised."""
        split = (x for answer in answers for x in values(answer, self.part.returns) or [])
        return b"".join(x.array.tobytes() for x in split if x.array is not None)

    def _numbers(self, k: int) -> Array:
        split = values(self.right[k], self.part.returns) or []
        return np.concatenate([np.ravel(x.array) for x in split if x.array is not None])

    def _wrong(self, answers: Sequence[Any], cases: Sequence[int]) -> Array | None:
        """Return which numbers are wrong, in some cases; None where they cannot be compared."""
        found = []
        for answer, k in zip(answers, cases):
            a, b = values(answer, self.part.returns), values(self.right[k], self.part.returns)
            for x, y in zip(a or [], b or []):
                bad = _differ(x, y)
                if bad is None:
                    return None
                found.append(bad.ravel())
            if not a or not b:
                return None
        return np.concatenate(found) if found and self.part.canonical is None else None


def _leaves_the_rest(edit: Edit) -> bool:
    """Whether a change leaves all other terms as they are: a slip of the list that shows then was there before."""
    words = [re.findall(r"\w+", text) for text in (edit.right, edit.wrong)]
    twin = edit.kind == "instead" and len(words[0]) == len(words[1]) and sum(map(ne, *words)) == 1
    twin = twin and not any(x != y and (y + x).isdigit() for x, y in zip(*words))
    twin = twin and not any(word.endswith(("max", "min", "imum")) for word in words[1])  # another one is chosen
    turned = edit.kind in TURNS and not _of_an_index(edit) and not _of_names(edit) and not _of_an_argument(edit)
    return not edit.everywhere and (turned or twin or _is_of_rounds(edit))


def _of_an_index(edit: Edit) -> bool:
    """Whether a change exchanges the entries of an index: a row read for a column may be zero, so a term is gone."""
    return edit.kind == "exchanged" and isinstance(edit.inside, ast.Subscript)


def _of_an_argument(edit: Edit) -> bool:
    """Whether a change turns the sign of what is given to a function: a student's wrong sign is that of a term."""
    return edit.kind == "sign" and isinstance(edit.inside, ast.Call)


def _of_names(edit: Edit) -> bool:
    """Whether a change exchanges two names in an expression, or two results, and not its two terms or factors."""
    node, other = edit.places[0][2:]
    if isinstance(node, ast.Tuple):
        return edit.kind == "exchanged"
    if edit.kind != "exchanged" or type(node) is not type(other):
        return False
    if isinstance(node, ast.Call):  # the factors of a cross product
        return not ast.unparse(node.func).endswith("cross") or ast.unparse(node.func) != ast.unparse(other.func)
    return isinstance(node, ast.BinOp) and ast.unparse(node.left) != ast.unparse(other.right)


def _is_of_rounds(edit: Edit) -> bool:
    """Whether a change lets a loop begin earlier, or a downward one end later: fewer rounds would make a slip."""
    ends = [re.fullmatch(r"range\((\d+), .*\)|range\(.*, (\d+), -1\)", x) for x in (edit.right, edit.wrong)]
    before, after = (int(x[1] or x[2]) if x else 0 for x in ends)
    return edit.kind in ("number", "index", "instead") and after < before and None not in ends


def _near(x: Array, y: Array | None) -> bool:
    if y is None or x.shape != y.shape:
        return False
    return bool(np.abs(x - y).max(initial=0) <= 1e-9 * np.abs(y).max(initial=FLOOR))


def _differ(a: Value, b: Value) -> Array | None:
    """Return which entries of two values differ; None where their shapes do."""
    if a.array is None or b.array is None or a.array.shape != b.array.shape:
        return None
    if b.array.dtype.kind == "b" or a.array.dtype.kind == "b":
        return np.asarray(a.array != b.array)
    tolerance = 1e-9 * np.abs(b.array[np.isfinite(b.array)]).max(initial=FLOOR)
    with np.errstate(invalid="ignore"):
        return ~np.asarray(np.abs(a.array - b.array) <= tolerance)
