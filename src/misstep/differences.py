"""How wrong results differ from right ones: type, shape, sign, transpose, factor, places, digits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from .compare import FLOOR, Array, Value, pieces, values
from .exercise import Part
from .text import Text, say

__all__ = ["differences", "structure"]

REPORTED_FACTORS = (2, 3, 4, 6, 8, 10, 12, 100, 1000, 180 / np.pi, np.pi, 2 * np.pi)
"""Factors that show the slip. Others are chance, and would give a number away."""

MAX_LISTED = 3  # wrong entries that are listed
NEARLY = 5e-3  # relative error of an answer of which some digits are right
SINGLE_ERROR = (5e-9, 2e-6)  # relative errors, of the largest entry, that single precision leaves

NOT_FINITE = Text("{name} has entries that are not finite numbers.", "{name} 含有不是有限数的元素。")
NO_RETURN = Text("It returned None. Is the `return` missing?", "返回了 None。是不是漏了 `return`？")
SOMETIMES_NONE = Text(
    "In some cases it returned None: a way through the function that ends without `return`?",
    "在某些情形中返回了 None：函数中是不是有的路径没有 `return`？",
)
SINGLE_PRECISION = Text(
    "It is right to about 7 digits only: that is single precision, `float32`.",
    "只有约 7 位正确：这是单精度 `float32`。",
)
WRONG_COUNT = Text(
    "It must return {n} things, in this order: {names}. It returned {got}.",
    "应按顺序返回 {n} 个量：{names}。实际返回 {got}。",
)
FIXED_SIZE = Text(
    "{name} has the shape {shape} in all cases: the sizes of one of them are written into the function.",
    "在所有情形中 {name} 的形状都是 {shape}：函数里写死了其中一种尺寸。",
)
CUT_OFF = Text(
    "{name} has lost the digits after the point: make the array that it is written into one of floats, `np.zeros(n)`.",
    "{name} 的小数部分丢失了：请把它写进浮点数组，例如 `np.zeros(n)`。",
)


def structure(part: Part, answers: Sequence[Any], right: Sequence[Any]) -> Text | None:
    """Report what shows before any number is compared: nothing, another count, type or shape in every case."""
    given = [x for x in answers if x is not None]
    if not given:
        return NO_RETURN
    for x in given:
        if pieces(x, part.returns) is None:
            names = Text(", ".join(q.name for q in part.returns), "、".join(q.title.zh for q in part.returns))
            got = len(x) if isinstance(x, tuple | list) else type(x).__name__
            return WRONG_COUNT.fill(n=len(part.returns), names=names, got=got)
    if len(given) < len(answers):
        return SOMETIMES_NONE
    split = [(values(a, part.returns) or [], values(b, part.returns) or []) for a, b in zip(answers, right)]
    for k, quantity in enumerate(part.returns):
        pairs = [(a[k], b[k]) for a, b in split if a and b]
        found = [_uncomparable(a, b) for a, b in pairs]
        shapes = {a.array.shape for a, _ in pairs if a.array is not None}
        if len(pairs) > 1 and len(shapes) == 1 < len({np.shape(b.raw) for _, b in pairs}):
            return FIXED_SIZE.fill(name=quantity.title, shape=shapes.pop())
        if found and all(found):
            return found[0]
        if len(pairs) > 1 and all(_is_cut_off(a, b) for a, b in pairs) and any(np.any(a.raw) for a, _ in pairs):
            return CUT_OFF.fill(name=quantity.title)
    errors = [_relative_error(a, b) for x, y in split for a, b in zip(x, y)]
    known = [x for x in errors if x is not None]
    is_single = known and len(known) == len(errors) and part.rtol < SINGLE_ERROR[0] < max(known) < SINGLE_ERROR[1]
    return SINGLE_PRECISION if is_single else None


def _uncomparable(got: Value, right: Value) -> Text | None:
    """Report another type or another shape, or numbers that are not finite."""
    name, a, b = got.quantity.title, got.array, right.array
    wanted = Text("a string", "字符串") if b is None else Text("numbers", "数值")
    if b is not None and b.dtype.kind == "b":
        wanted = Text("True or False", "True 或 False")
    if not (
        isinstance(got.raw, str) if b is None else a is not None and (a.dtype.kind == "b") == (b.dtype.kind == "b")
    ):
        kind = "None" if got.raw is None else type(got.raw).__name__
        return say(
            "{name} must be {what}, not {got}.", "{name} 应为{what}，而不是 {got}。", name=name, what=wanted, got=kind
        )
    if a is None or b is None:
        return None
    if a.shape != b.shape:
        text = "{name} has the shape {got}; it must be {expected}.", "{name} 的形状是 {got}，应为 {expected}。"
        return say(*text, name=name, got=a.shape, expected=b.shape)
    return NOT_FINITE.fill(name=name) if np.isfinite(b).all() and not np.isfinite(a).all() else None


def _is_cut_off(got: Value, right: Value) -> bool:
    a, b = got.array, right.array
    if a is None or b is None or a.shape != b.shape or not b.ndim or b.dtype.kind != "f":
        return False
    return bool(np.array_equal(a, np.trunc(b)) and not np.array_equal(a, b))


def _relative_error(got: Value, right: Value) -> float | None:
    a, b = got.array, right.array
    if a is None or b is None or a.shape != b.shape or not a.size or "b" in a.dtype.kind + b.dtype.kind:
        return None
    if not (np.isfinite(a).all() and np.isfinite(b).all()):
        return None
    return float(np.abs(a - b).max() / np.abs(b).max(initial=FLOOR))


def differences(part: Part, answer: Any, right: Any) -> tuple[list[Text], bool]:
    """Describe how an answer differs from the right one, result by result; and whether that shows what is wrong."""
    pairs = zip(values(answer, part.returns) or [], values(right, part.returns) or [])
    found = [_of_value(got, wanted, part.rtol) for got, wanted in pairs]
    return [line for lines, _ in found for line in lines], any(tells for _, tells in found)


def _of_value(got: Value, right: Value, rtol: float) -> tuple[list[Text], bool]:
    problem = _uncomparable(got, right)
    if problem is not None:
        return [problem], True
    name, a, b = got.quantity.title, got.array, right.array
    if a is None or b is None:
        x, y = str(got.raw).strip(), str(right.raw).strip()
        text = Text("{x}, where a different text is expected", "得到 {x}，应为另一段文字")
        if y.endswith("Error") and y.isidentifier():
            text = Text("{x}, and {y} is expected", "{x}，应为 {y}")
        return ([] if x == y else [_line(name, text.fill(x=x, y=y))]), False
    if b.dtype.kind == "b":
        pairs = [(bool(x), bool(y)) for x, y in zip(a.flat, b.flat) if x != y][:1]
        return [Text(f"{name.en}: is {x}, and must be {y}", f"{name.zh}：是 {x}，应为 {y}") for x, y in pairs], False
    within = rtol * np.abs(b[np.isfinite(b)]).max(initial=FLOOR)
    if _same(a, b, within):
        return [], False
    relation, tells = _relation(a, b, within)
    lines, some_right = [], False
    for block, index in got.quantity.layout.blocks(b.shape) if not tells else ():
        if _same(a[index], b[index], within):
            some_right = True
        else:
            of_block, of_block_tells = _relation(a[index], b[index], within, tuple(p.start for p in index[1:]))
            tells = tells or of_block_tells
            lines.append(_line(Text(f"{name.en}, {block.en}", f"{name.zh}，{block.zh}"), of_block))
    if not lines:
        return [_line(name, relation)], tells
    rest = say("the rest of {name} is right", "{name} 的其余部分正确", name=name)
    return lines + [rest] * some_right, tells or some_right


def _line(what: Text, relation: Text) -> Text:
    return Text(f"{what.en}: {relation.en}", f"{what.zh}：{relation.zh}")


def _same(a: Array, b: Array, within: Any) -> bool:
    with np.errstate(invalid="ignore"):
        return a.shape == b.shape and bool(((np.abs(a - b) <= within) | (a == b) | (np.isnan(a) & np.isnan(b))).all())


def _relation(a: Array, b: Array, within: Any, origin: tuple[int, ...] = ()) -> tuple[Text, bool]:
    """Describe an array beside the right one; and whether that is more than how many entries are wrong."""
    if np.isnan(b).any() and np.isfinite(a).all():
        return Text("a number, where nan is expected", "给出了一个数，而应为 nan"), True
    if _same(b, 0 * b, within):
        return Text("must be zero", "应为零"), False
    for text, other, factor in _likenesses(b):
        if _same(a, other, factor * within):
            return text, True
    return _places(a, b, within, origin)


def _likenesses(b: Array) -> Iterator[tuple[Text, Array, float]]:
    """Yield what somebody may return in place of an array, with the factor of its tolerance."""
    yield Text("zero, and must not be", "为零，不应为零"), 0 * b, 1
    yield Text("the sign is wrong", "符号相反"), -b, 1
    if b.ndim > 1:
        yield Text("transposed", "被转置"), b.mT, 1
        yield Text("transposed, and the sign is wrong", "被转置且符号相反"), -b.mT, 1
    for n in REPORTED_FACTORS:
        for sign, en, zh in ((1, "", ""), (-1, ", and of the other sign", "，且符号相反")):
            large = say("too large by a factor of {n:.4g}" + en, "是正确值的 {n:.4g} 倍" + zh, n=n)
            small = say("too small by a factor of {n:.4g}" + en, "只有正确值的 1/{n:.4g}" + zh, n=n)
            yield large, sign * n * b, n
            yield small, sign * b / n, 1 / n


def _places(a: Array, b: Array, within: Any, origin: tuple[int, ...]) -> tuple[Text, bool]:
    """Describe which entries are wrong, or in the wrong place, or how many digits are right."""
    if a.size > 1 and _same(np.abs(a), np.abs(b), within):
        return Text("the right numbers, some with the wrong sign", "数值正确，部分符号错误"), True
    if a.size > 1 and _same(np.sort(a.ravel()), np.sort(b.ravel()), within):
        return Text("the right numbers, in the wrong places", "数值正确，位置不对"), True
    with np.errstate(invalid="ignore"):
        wrong = ~(np.abs(a - b) <= within)
    error = float(np.abs(a - b).max() / np.abs(b).max(initial=FLOOR))
    if error < NEARLY:
        return say("right to {n} digits only", "只有 {n} 位正确", n=int(-np.log10(error))), True
    n = int(wrong.sum())
    if n <= MAX_LISTED and n < a.size:
        shift = np.array([*(0,) * (a.ndim - len(origin)), *origin], int)
        where = ", ".join(str([int(k) for k in at]) for at in np.argwhere(wrong) + shift)
        return say("wrong in {where}, right elsewhere", "错在 {where}，其余正确", where=where), True
    if n < a.size:
        return say("{n} of {all} numbers are wrong", "{all} 个数中有 {n} 个错误", n=n, all=a.size), False
    return Text("different numbers", "数值不同"), False
