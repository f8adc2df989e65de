"""How a wrong array differs from the right one: sign, transpose, factor, zero, places."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import shorten
from typing import Any

import numpy as np

from ...arrays import Array
from ..compare import FLOOR, Value, pieces, values
from ..exercise import Part
from ..layouts import Layout
from ..words.phrases import say
from ..words.text import Text
from .sizes import by_how_much, digits, same

__all__ = ["TELLING", "describe", "of_numbers", "of_structure", "of_truths", "plain"]

TELLING = (2, 3, 4, 6, 8, 9.81, 10, 12, 100, 1000, 180 / np.pi, np.pi, 2 * np.pi)
"""Factors that are reported: they show the slip. Others are chance, and would give a number away."""


ZERO = 1e-10
"""What is left of a number that is zero but for rounding."""


def of_numbers(part: Part, answers: Sequence[Any], right: Sequence[Any]) -> Text | None:
    """Report what shows in all cases together: sizes of one robot, or whole numbers in place of numbers."""
    pairs = [(values(a, part.returns), values(b, part.returns)) for a, b in zip(answers, right)]
    for k in range(len(part.returns)):
        arrays = [(a[k].array, b[k].array) for a, b in pairs if a and b]
        both = [(a, b) for a, b in arrays if a is not None and b is not None]
        if len(both) < 2 or len(both) < len(pairs):
            continue
        name, got, wanted = part.returns[k].title, {a.shape for a, _ in both}, {b.shape for _, b in both}
        if len(got) == 1 < len(wanted) and {len(x) for x in got} == {len(x) for x in wanted}:
            return say("fixed size", name=name, shape=got.pop())
        whole = all(b.dtype.kind == "f" and b.ndim and np.array_equal(a, np.trunc(b)) for a, b in both)
        if whole and any(a.any() for a, _ in both):
            return say("cut off", name=name)
    return None


def of_structure(part: Part, answers: Sequence[Any]) -> Text | None:
    """Report that nothing was returned, or the wrong number of values."""
    if all(answer is None for answer in answers):
        return say("none")
    for answer in answers:
        if answer is not None and pieces(answer, part.returns) is None:
            names = Text(", ".join(q.name for q in part.returns), "、".join(q.title.zh for q in part.returns))
            return say("pieces", n=len(part.returns), names=names, got=_count(answer))
    return None


def _count(answer: Any) -> str:
    return str(len(answer)) if isinstance(answer, tuple | list) else type(answer).__name__


def describe(got: Value, right: Value, rtol: float, *, factors: Sequence[float] = TELLING) -> list[Text]:
    """Explain what is wrong with one value; empty where it is right. Factors are looked for among those given."""
    name = got.quantity.label
    problem = _not_comparable(got, right)
    if problem is not None:
        return [problem]
    if got.array is None or right.array is None:
        text = str(got.raw).strip()
        return [] if text == str(right.raw).strip() else [_is(name, _text(text, str(right.raw).strip()))]
    if right.array.dtype.kind == "b":
        return _truths(name, got.array, right.array)
    if np.isnan(right.array).any() and np.isfinite(got.array).all():
        return [_is(name, say("nan expected"))]
    tolerance = rtol * np.abs(right.array).max(initial=FLOOR)
    relation = plain(got.array, right.array, tolerance, factors)
    relation = relation or _triangle(got.array, right.array, tolerance) or _moved(got.array, right.array, tolerance)
    if relation == say("right"):
        return []
    if relation is not None:
        return [_is(name, relation)]
    lines = _blocks(name, got.quantity.layout, got.array, right.array, tolerance, factors)
    falls = _rises(right.array, tolerance) and not _rises(got.array, tolerance)
    return lines + [_is(name, say("falls"))] * (falls and _is(name, say("unsorted")) not in lines)


def _text(got: str, right: str) -> Text:
    """Report that a text is another one; which error is expected is said."""
    if right.endswith("Error") and right.isidentifier():
        return say("error differs", got=shorten(got, 60) or say("nothing"), right=right)
    return say("text differs", got=shorten(got, 60))


def _truths(name: Text, got: Array, right: Array) -> list[Text]:
    wrong = [(bool(x), bool(y)) for x, y in zip(got.flat, right.flat) if x != y]
    return [_is(name, say("false", got=wrong[0][0], right=wrong[0][1]))] if wrong else []


def of_truths(pairs: Sequence[tuple[Any, Any]]) -> Text | None:
    """Report in which direction answers are wrong that are True or False; None where they are something else."""
    if not all(isinstance(x, bool | np.bool_) for pair in pairs for x in pair):
        return None
    strict, loose = (sum(bool(a) is not truth and bool(b) is truth for a, b in pairs) for truth in (True, False))
    phrase = "too strict" if not loose else "too loose" if not strict else "both ways"
    return say(phrase, strict=strict, loose=loose)


def _is(what: Text, relation: Text) -> Text:
    return say("is", what=what, relation=relation)


def _not_comparable(got: Value, right: Value) -> Text | None:
    """Explain why an answer cannot be compared: its type, its shape, its NaN."""
    name = got.quantity.title
    if right.array is None:
        return None if isinstance(got.raw, str) else _type(got, "words")
    truths = right.array.dtype.kind == "b"
    if got.array is None or (got.array.dtype.kind == "b") != truths:
        return _type(got, "truth values" if truths else "numbers")
    if got.array.shape != right.array.shape:
        return say("shape", name=name, got=got.array.shape, expected=right.array.shape)
    bad = np.argwhere(~np.isfinite(got.array)) if not truths else np.empty((0, 0))
    if len(bad) and np.isfinite(right.array).all():
        return say("nan", name=name, where=_places(bad)) if got.array.ndim else _is(name, say("no number"))
    return None


def _type(got: Value, expected: str) -> Text:
    name, raw = got.quantity.title, got.raw
    if isinstance(raw, str) and raw.endswith("Error"):  # it stands for a result that there is none of
        return say("raises", name=name, error=raw, what=say(expected))
    return say("not numbers", name=name, what=say(expected), got=type(raw).__name__)


def _blocks(name: Text, layout: Layout, a: Array, b: Array, tolerance: float, factors: Sequence[float]) -> list[Text]:
    """Explain what is wrong with each block, where the whole shows no pattern."""
    lines, some_right = [], False
    for block, index in layout.blocks(b.shape):
        origin = [0] * (b.ndim - len(index) + 1) + [part.start for part in index[1:]]
        relation = _relation(a[index], b[index], tolerance, origin, factors)
        if relation == say("right"):
            some_right = True
        else:
            lines.append(_is(say("block", name=name, block=block), relation))
    if not lines:
        return [_is(name, _relation(a, b, tolerance, [0] * b.ndim, factors))]
    return lines + [say("others right", name=name)] * some_right


def _relation(a: Array, b: Array, tolerance: float, origin: list[int], factors: Sequence[float]) -> Text:
    """Return how one array is related to the other, or where or by how much they differ.

    `origin` is where the block begins, so that entries are numbered as in the whole.
    """
    simple = plain(a, b, tolerance, factors)
    if simple is not None:
        return simple
    relation = _exchanged(a, b, tolerance, origin)
    for find in (_triangle, _diagonal, _shuffled):
        relation = relation or find(a, b, tolerance)
    return relation or _entries(a, b, tolerance, origin)


def _square(b: Array) -> bool:
    return b.ndim >= 2 and b.shape[-1] == b.shape[-2] > 1


def plain(a: Array, b: Array, tolerance: float, factors: Sequence[float]) -> Text | None:
    """Return whether an array is right, zero, of the wrong sign, transposed or off by a factor."""
    disguises = {"right": b, "sign": -b}
    if _square(b):
        disguises |= {"transposed": b.mT, "transposed sign": -b.mT}
    if same(b, np.zeros_like(b), tolerance):
        return say("right" if same(a, b, tolerance) else "not zero")
    if same(a, np.zeros_like(b), ZERO * min(np.abs(b).max(), 1)):
        return say("zero")
    for phrase, disguise in disguises.items():
        if same(a, disguise, tolerance):
            return say(phrase)
    return _factor(a, b, tolerance, factors)


def _factor(a: Array, b: Array, tolerance: float, factors: Sequence[float]) -> Text | None:
    """Return the factor, of those reported, by which an array is too large or too small."""
    for factor in factors:
        for sign, said in ((1, ""), (-1, "opposite ")):
            if (np.abs(a - sign * factor * b) <= factor * tolerance).all():
                return say(f"{said}factor", factor=factor)
            if (np.abs(sign * factor * a - b) <= tolerance).all():
                return say(f"{said}divisor", factor=factor)
    return None


def _triangle(a: Array, b: Array, tolerance: float) -> Text | None:
    """Return which triangle of a symmetric matrix is right, where all of the other is wrong."""
    if not _square(b) or not same(b, b.mT, tolerance):
        return None
    upper = np.triu(np.ones(b.shape[-2:], dtype=bool))
    for phrase, side in (("upper", upper), ("lower", upper.mT)):
        if _only(a, b, side, tolerance):
            return say(phrase)
    return None


def _only(a: Array, b: Array, part: Array, tolerance: float) -> bool:
    """Whether a part of a matrix is right, and of the numbers beside it none but zeros."""
    wrong = np.abs(a - b) > tolerance
    beside = ~part & (np.abs(b) > tolerance)
    return not (wrong & part).any() and bool((wrong & ~part).any() and wrong[beside].all())


def _diagonal(a: Array, b: Array, tolerance: float) -> Text | None:
    """Return whether the diagonal of a square matrix is right, or only the rest."""
    if not _square(b):
        return None
    on = np.eye(b.shape[-1], dtype=bool)
    if _only(a, b, ~on, tolerance):
        return say("off diagonal")
    right = _only(a, b, on, tolerance) and not same(b * on, np.zeros_like(b), tolerance)
    return say("diagonal") if right and (np.abs(a - b) > tolerance).sum() > 3 else None


def _exchanged(a: Array, b: Array, tolerance: float, origin: list[int]) -> Text | None:
    """Return which two entries, rows or columns are exchanged, where all others are right."""
    for axis, phrase in ((-2, "rows exchanged"), (-1, "columns exchanged")) if b.ndim == 2 else ():
        wrong = np.flatnonzero((np.abs(a - b) > tolerance).any(axis=-1 if axis == -2 else -2))
        if len(wrong) == 2 and same(np.take(a, wrong[::-1], axis), np.take(b, wrong, axis), tolerance):
            first, second = (int(k) + origin[axis] for k in wrong)
            return say(phrase, first=first, second=second)
    where = np.argwhere(np.abs(a - b) > tolerance)
    if len(where) != 2 or not b.ndim or same(np.abs(a), np.abs(b), tolerance):
        return None
    (x, y), (x_right, y_right) = ([array[*place] for place in where] for array in (a, b))
    if np.abs(x - y_right) > tolerance or np.abs(y - x_right) > tolerance:
        return None
    one, other = (_places(place[None]) for place in where + origin)
    return say("entries exchanged", first=one, second=other)


def _moved(a: Array, b: Array, tolerance: float) -> Text | None:
    """Return whether the numbers of a vector stand one place too early, or too late."""
    if b.ndim != 1 or len({*np.round(b / tolerance)}) < 4:
        return None
    early = same(a[:-1], b[1:], tolerance)
    return say("early" if early else "late") if early or same(a[1:], b[:-1], tolerance) else None


def _shuffled(a: Array, b: Array, tolerance: float) -> Text | None:
    """Return whether the numbers are right, and only signs or places wrong."""
    if b.size < 2:
        return None
    if (np.abs(np.abs(a) - np.abs(b)) <= tolerance).all():
        wrong = np.abs(a - b) > tolerance
        return say("signs") if wrong.sum() > 3 or b.ndim == 0 else None
    if (np.abs(np.sort(a.real.ravel()) - np.sort(b.real.ravel())) <= tolerance).all():
        return say("unsorted" if _rises(b, tolerance) else "permuted")
    return None


def _rises(x: Array, tolerance: float) -> bool:
    """Whether the entries of a vector are in ascending order, and more than happens to be."""
    return x.ndim == 1 and x.size > 5 and bool((np.diff(x.real) >= -tolerance).all())


def _entries(a: Array, b: Array, tolerance: float, origin: list[int]) -> Text:
    """Return where two arrays differ, or by how much, where there is no simpler relation."""
    wrong = np.abs(a - b) > tolerance
    if b.size > 1 and digits(a, b):
        return say("inexact", digits=digits(a, b))
    if 0 < wrong.sum() <= 3 and wrong.sum() < b.size:
        where = np.argwhere(wrong) + origin
        signs = (np.abs(a + b)[wrong] <= tolerance).all()
        text = say("entries", entries=_places(where))
        nothing = not a[wrong].any() and np.abs(b[wrong]).min() > tolerance
        return say("is", what=text, relation=say("sign" if signs else "zero")) if signs or nothing else text
    return _lines(wrong, origin) or by_how_much(a, b, wrong, tolerance)


def _lines(wrong: Array, origin: list[int]) -> Text | None:
    """Return in which rows an array is wrong, or in which columns, where it is not in all."""
    for axis, phrase in ((0, "rows"), (-1, "columns")) if wrong.size > 3 else ():
        bad = wrong.any(axis=tuple(k for k in range(wrong.ndim) if k != axis % wrong.ndim))
        if not bad.all():
            return say(phrase, lines=_runs(np.flatnonzero(bad) + origin[axis]))
    return None


def _runs(numbers: Array) -> Text:
    """Write whole numbers that rise, three or more in a row as the first and the last."""
    runs = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
    english, chinese = (
        ", ".join(f"{run[0]}{to}{run[-1]}" if len(run) > 2 else ", ".join(map(str, run)) for run in runs)
        for to in (" to ", "–")
    )
    return Text(english, chinese)


def _places(where: Array) -> str:
    """Write indices as they are written in Python."""
    shown = ", ".join("[" + ", ".join(str(int(k)) for k in place) + "]" for place in where[:3])
    return shown + (", ..." if len(where) > 3 else "")
