"""How wrong results differ from right ones: type, shape, sign, transpose, factor, triangle, places, digits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .compare import FLOOR, Array, Value, pieces, values
from .exercise import Part
from .messages import message
from .text import Text

__all__ = ["REPORTED_FACTORS", "differences", "structure"]

REPORTED_FACTORS = (2, 3, 4, 6, 8, 10, 12, 100, 1000, 180 / np.pi, np.pi, 2 * np.pi)
"""Factors that show the slip. Others are chance, and would give a number away."""

MAX_LISTED = 3
"""Wrong entries that are listed."""

NEARLY = 5e-3
"""Relative error of an answer of which some digits are right."""

SINGLE_ERROR = (5e-9, 2e-6)
"""Relative errors, of the largest entry, that single precision leaves."""


def structure(part: Part, answers: Sequence[Any], right: Sequence[Any]) -> Text | None:
    """Report what shows before any number is compared: nothing, another count, type or shape in every case."""
    given = [x for x in answers if x is not None]
    if not given:
        return message("none")
    if any(pieces(x, part.returns) is None for x in given):
        names = Text(", ".join(q.name for q in part.returns), "、".join(q.title.zh for q in part.returns))
        got = next(x for x in given if pieces(x, part.returns) is None)
        count = str(len(got)) if isinstance(got, tuple | list) else type(got).__name__
        return message("count", n=len(part.returns), names=names, got=count)
    if len(given) < len(answers):
        return message("none sometimes")
    split = [(values(a, part.returns) or [], values(b, part.returns) or []) for a, b in zip(answers, right)]
    for k, quantity in enumerate(part.returns):
        pairs = [(a[k], b[k]) for a, b in split if a and b]
        found = [_uncomparable(a, b) for a, b in pairs]
        shapes = {a.array.shape for a, _ in pairs if a.array is not None}
        if len(pairs) > 1 and len(shapes) == 1 < len({np.shape(b.raw) for _, b in pairs}):
            return message("fixed size", name=quantity.title, shape=shapes.pop())
        if found and all(found):
            return found[0]
        if len(pairs) > 1 and all(_is_cut_off(a, b) for a, b in pairs) and any(np.any(a.raw) for a, _ in pairs):
            return message("cut off", name=quantity.title)
    errors = [_relative_error(a, b) for x, y in split for a, b in zip(x, y)]
    known = [x for x in errors if x is not None]
    if known and len(known) == len(errors) and part.rtol < SINGLE_ERROR[0] < max(known) < SINGLE_ERROR[1]:
        return message("single precision")
    return None


def _uncomparable(got: Value, right: Value) -> Text | None:
    """Report another type or another shape, or numbers that are not finite."""
    name = got.quantity.title
    if right.array is None:
        return None if isinstance(got.raw, str) else message("type", name=name, what=message("string"), got=_type(got))
    truths = right.array.dtype.kind == "b"
    if got.array is None or (got.array.dtype.kind == "b") != truths:
        return message("type", name=name, what=message("truths" if truths else "numbers"), got=_type(got))
    if got.array.shape != right.array.shape:
        return message("shape", name=name, got=got.array.shape, expected=right.array.shape)
    if got.array.dtype.kind in "fc" and not np.isfinite(got.array).all() and np.isfinite(right.array).all():
        return message("not finite", name=name)
    return None


def _type(got: Value) -> str:
    return "None" if got.raw is None else type(got.raw).__name__


def _is_cut_off(got: Value, right: Value) -> bool:
    a, b = got.array, right.array
    if a is None or b is None or a.shape != b.shape or not b.ndim or b.dtype.kind != "f":
        return False
    return bool(np.array_equal(a, np.trunc(b)) and not np.array_equal(a, b))


def _relative_error(got: Value, right: Value) -> float | None:
    a, b = got.array, right.array
    if (
        a is None
        or b is None
        or a.shape != b.shape
        or not a.size
        or a.dtype.kind not in "fc"
        or b.dtype.kind not in "fc"
    ):
        return None
    if not (np.isfinite(a).all() and np.isfinite(b).all()):
        return None
    return float(np.abs(a - b).max() / np.abs(b).max(initial=FLOOR))


def differences(part: Part, answer: Any, right: Any) -> tuple[list[Text], bool]:
    """Describe how an answer differs from the right one, result by result; and whether that shows what is wrong."""
    lines: list[Text] = []
    telling = False
    for got, wanted in zip(values(answer, part.returns) or [], values(right, part.returns) or []):
        said, tells = _of_value(got, wanted, part.rtol)
        lines += said
        telling = telling or tells
    return lines, telling


def _of_value(got: Value, right: Value, rtol: float) -> tuple[list[Text], bool]:
    problem = _uncomparable(got, right)
    if problem is not None:
        return [problem], True
    name, a, b = got.quantity.title, got.array, right.array
    if a is None or b is None:
        said, wanted = str(got.raw).strip(), str(right.raw).strip()
        key = "error differs" if wanted.endswith("Error") and wanted.isidentifier() else "text differs"
        relation = message(key, got=said, right=wanted)
        return ([] if said == wanted else [message("is", what=name, relation=relation)]), False
    if b.dtype.kind == "b":
        wrong = [(bool(x), bool(y)) for x, y in zip(a.flat, b.flat) if x != y][:1]
        return [message("is", what=name, relation=message("truth", got=x, right=y)) for x, y in wrong], False
    within = rtol * np.abs(b[np.isfinite(b)]).max(initial=FLOOR)
    if _same(a, b, within):
        return [], False
    whole, tells = _relation(a, b, within)
    lines, some_right = [], False
    for block, index in got.quantity.layout.blocks(b.shape) if not tells else ():
        if _same(a[index], b[index], within):
            some_right = True
        else:
            relation, of_block = _relation(a[index], b[index], within, tuple(p.start for p in index[1:]))
            tells = tells or of_block
            lines.append(message("is", what=message("block", name=name, block=block), relation=relation))
    if not lines:
        return [message("is", what=name, relation=whole)], tells
    return lines + [message("rest right", name=name)] * some_right, tells or some_right


def _same(a: Array, b: Array, within: Any) -> bool:
    with np.errstate(invalid="ignore"):
        return a.shape == b.shape and bool(((np.abs(a - b) <= within) | (a == b) | (np.isnan(a) & np.isnan(b))).all())


def _relation(a: Array, b: Array, within: Any, origin: tuple[int, ...] = ()) -> tuple[Text, bool]:
    """Describe an array beside the right one; and whether that is more than how many entries are wrong."""
    if np.isnan(b).any() and np.isfinite(a).all():
        return message("nan expected"), True
    if _same(b, 0 * b, within):
        return message("must be zero"), False
    if _same(a, 0 * a, within):
        return message("is zero"), True
    if _same(a, -b, within):
        return message("sign"), True
    if a.ndim > 1 and _same(a, b.mT, within):
        return message("transposed"), True
    if a.ndim > 1 and _same(a, -b.mT, within):
        return message("transposed and sign"), True
    for factor in REPORTED_FACTORS:
        for sign in (1, -1):
            if _same(a, sign * factor * b, factor * within):
                return message("too large" if sign > 0 else "too large and sign", factor=factor), True
            if _same(factor * a, sign * b, within):
                return message("too small" if sign > 0 else "too small and sign", factor=factor), True
    return _triangle(a, b, within) or _places(a, b, within, origin)


def _triangle(a: Array, b: Array, within: Any) -> tuple[Text, bool] | None:
    if a.ndim != 2 or a.shape[0] != a.shape[1] or a.shape[0] < 3 or not _same(b, b.mT, within):
        return None
    wrong, upper = np.abs(a - b) > within, np.triu(np.ones(a.shape, bool))
    one, diagonal = np.abs(b) > within, np.eye(len(a), dtype=bool)
    for key, side in (("diagonal only", diagonal), ("upper only", upper), ("lower only", upper.mT)):
        if not wrong[side].any() and wrong[~side & one].all() and wrong.any():
            return message(key), True
    return None


def _places(a: Array, b: Array, within: Any, origin: tuple[int, ...]) -> tuple[Text, bool]:
    """Describe which entries are wrong, or in the wrong place, or how many digits are right."""
    if a.size > 1 and _same(np.abs(a), np.abs(b), within):
        return message("signs"), True
    if a.size > 1 and _same(np.sort(a.ravel()), np.sort(b.ravel()), within):
        return message("permuted"), True
    with np.errstate(invalid="ignore"):
        wrong = ~(np.abs(a - b) <= within)
    error = float(np.abs(a - b).max() / np.abs(b).max(initial=FLOOR))
    if error < NEARLY:
        return message("digits", n=int(-np.log10(error))), True
    if wrong.sum() <= MAX_LISTED and wrong.sum() < a.size:
        shift = np.array([*(0,) * (a.ndim - len(origin)), *origin], int)
        where = ", ".join(str([int(k) for k in at]) for at in np.argwhere(wrong) + shift)
        return message("entries", where=where), True
    if wrong.sum() < a.size:
        return message("some", wrong=int(wrong.sum()), all=a.size), False
    return message("different"), False
