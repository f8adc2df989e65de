"""How wrong results differ from right ones, and the first line of a listing that goes wrong."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from .compare import FLOOR, Array, Value, values
from .exercise import Part
from .listing import Listing, equal, text_of
from .text import Text, say

__all__ = ["differences", "first_wrong_line", "structure"]

MAX_LISTED = 3  # wrong entries that are listed
NEARLY = 1e-4  # relative error of an answer that is right but for its digits; a term left out may be as small as 1e-3
NEARLY_ROUNDED, DECIMALS = 5e-3, 3  # the same of an answer that was rounded, and to how many decimals at most
TRACE_RTOL = 1e-9

NO_RETURN = Text("It returned None. Is the `return` missing?", "返回了 None。是不是漏了 `return`？")
SOMETIMES_NONE = Text(
    "In some cases it returned None: is a `return` missing?", "有时返回了 None：是不是漏了 `return`？"
)
COUNT = Text("It must return {n} things: {names}. It returned {got}.", "应返回 {n} 个量：{names}。实际返回 {got}。")
FIXED_SIZE = Text("{name} has the shape {shape} in all cases.", "在所有情形中 {name} 的形状都是 {shape}。")
TYPE = Text("{name} must be {what}, not {got}.", "{name} 应为{what}，而不是 {got}。")
NO_ARRAY = Text(
    "{name} must be an array, not a {got}: return `np.array(...)`, or `np.block(...)` where it is made of blocks.",
    "{name} 应为数组，而不是 {got}：请返回 `np.array(...)`；由分块组成的用 `np.block(...)`。",
)
SHAPE = Text("{name} has the shape {got}; it must be {right}.", "{name} 的形状是 {got}，应为 {right}。")
NOT_FINITE = Text("{name} has entries that are not finite numbers.", "{name} 含有不是有限数的元素。")
CUT_OFF = Text(
    "whole numbers, as an array of integers drops what stands after the point: make it with `dtype=float`",
    "只有整数部分：整数数组存不下小数，请用 `dtype=float` 创建数组",
)
FIRST_LINE = Text(
    "Look at line {line}, `{text}`: what it uses occurs in a right solution, what it computes does not.",
    "请看第 {line} 行 `{text}`：它用到的值在正确解法中都有，它算出的值却没有。",
)


def structure(part: Part, answers: Sequence[Any], right: Sequence[Any]) -> Text | None:
    """Report what shows before any number is compared: nothing, another count, type or shape in every case."""
    given = [x for x in answers if x is not None]
    if not given:
        return NO_RETURN
    for x in given:
        if values(x, part.returns) is None:
            names = Text(", ".join(q.name for q in part.returns), "、".join(q.title.zh for q in part.returns))
            got = len(x) if isinstance(x, tuple | list) else type(x).__name__
            return COUNT.fill(n=len(part.returns), names=names, got=got)
    if len(given) < len(answers):
        return SOMETIMES_NONE
    split = [(values(a, part.returns) or [], values(b, part.returns) or []) for a, b in zip(answers, right)]
    for k, output in enumerate(part.returns):
        pairs = [(a[k], b[k]) for a, b in split if a and b]
        found = [_uncomparable(a, b) for a, b in pairs]
        shapes = {a.array.shape for a, _ in pairs if a.array is not None}
        if len(pairs) > 1 and len(shapes) == 1 < len({np.shape(b.raw) for _, b in pairs}):
            return FIXED_SIZE.fill(name=output.title, shape=shapes.pop())
        if found and all(found):
            return found[0]
    return None


def _uncomparable(got: Value, right: Value) -> Text | None:
    """Report another type or another shape, or numbers that are not finite."""
    name, a, b = got.output.title, got.array, right.array
    if isinstance(got.raw, list | tuple) and b is not None and (a is None or a.ndim > b.ndim):
        return NO_ARRAY.fill(name=name, got=type(got.raw).__name__)
    kinds = ["s" if isinstance(x.raw, str) else "" if x.array is None else x.array.dtype.kind for x in (got, right)]
    wanted = {"s": Text("a string", "字符串"), "b": Text("True or False", "True 或 False")}
    if not kinds[0] or (kinds[0] != kinds[1] and {*kinds} & wanted.keys()):
        kind = "None" if got.raw is None else type(got.raw).__name__
        return TYPE.fill(name=name, what=wanted.get(kinds[1], Text("numbers", "数值")), got=kind)
    if a is None or b is None:
        return None
    if a.shape != b.shape:
        return SHAPE.fill(name=name, got=a.shape, right=b.shape)
    return NOT_FINITE.fill(name=name) if np.isfinite(b).all() and not np.isfinite(a).all() else None


def differences(part: Part, answer: Any, right: Any) -> tuple[list[Text], bool]:
    """Describe how an answer differs from the right one, result by result; and whether that shows what is wrong."""
    pairs = zip(values(answer, part.returns) or [], values(right, part.returns) or [])
    found = [_of_value(got, wanted, part.rtol) for got, wanted in pairs]
    return [line for lines, _ in found for line in lines], any(tells for _, tells in found)


def _of_value(got: Value, right: Value, rtol: float) -> tuple[list[Text], bool]:
    problem = _uncomparable(got, right)
    if problem is not None:
        return [problem], True
    name, a, b = got.output.title, got.array, right.array
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
    if isinstance(got.raw, np.ndarray) and got.raw.dtype.kind in "iu" and np.array_equal(a, np.trunc(b)):
        return [_line(name, CUT_OFF)], True
    relation, tells = _relation(a, b, within)
    lines, some_right = [], False
    for block, index in got.output.layout.blocks(b.shape) if not tells else ():
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
    for en, zh, other in (
        ("zero, and must not be", "为零，不应为零", 0 * b),
        ("the sign is wrong", "符号相反", -b),
        ("transposed", "被转置", np.swapaxes(b, -1, -2) if b.ndim > 1 else b),
        ("transposed, and the sign is wrong", "被转置且符号相反", -np.swapaxes(b, -1, -2) if b.ndim > 1 else b),
    ):
        if _same(a, other, within):
            return Text(en, zh), True
    with np.errstate(invalid="ignore"):
        wrong, error = ~(np.abs(a - b) <= within), float(np.abs(a - b).max() / np.abs(b).max(initial=FLOOR))
    if error < (NEARLY_ROUNDED if np.array_equal(a, np.round(a, DECIMALS)) else NEARLY):
        return say("right to {n} digits only", "只有 {n} 位正确", n=int(-np.log10(error))), True
    n = int(wrong.sum())
    if n <= MAX_LISTED and n < a.size:
        shift = np.array([*(0,) * (a.ndim - len(origin)), *origin], int)
        where = ", ".join(str([int(k) for k in at]) for at in np.argwhere(wrong) + shift)
        return say("wrong in {where}, right elsewhere", "错在 {where}，其余正确", where=where), True
    if n < a.size:
        return say("{n} of {all} numbers are wrong", "{all} 个数中有 {n} 个错误", n=n, all=a.size), False
    return Text("different numbers", "数值不同"), False


# ---------------------------------------------------------------- the first wrong line


def first_wrong_line(listing: Listing, arguments: Sequence[Any], solutions: Sequence[Listing]) -> Text | None:
    """Report the first statement of a traced listing that computes what no right solution has, from what one has.

    A value is known if an argument or an expression of a right solution has it, whatever its sign.
    """
    found: dict[tuple[int, ...], list[Array]] = {}
    for value in (*arguments, *(value for solution in solutions for _, value in solution.events)):
        for x in _arrays(value):
            found.setdefault(x.shape, []).append(x)
            if x.shape == (6,):
                found.setdefault((3,), []).extend((x[:3], x[3:]))
    stacked = {shape: np.array(arrays) for shape, arrays in found.items()}

    def is_known(value: Any) -> bool:
        return all(_occurs(x, stacked.get(x.shape)) or _occurs(-x, stacked.get(x.shape)) for x in _arrays(value))

    statements = [*_statements(listing)]
    for k, (node, value, used) in enumerate(statements):
        if not [*_arrays(value)] or is_known(value) or not all(map(is_known, used)):
            continue
        later = statements[k + 1 :]
        if not any(is_known(x) and any(equal(value, y) for y in uses) for _, x, uses in later):
            return FIRST_LINE.fill(line=node.lineno, text=text_of(node))  # else only another way to what is right
    return None


def _occurs(x: Array, every: Array | None) -> bool:
    if every is None:
        return False
    within = TRACE_RTOL * max(float(np.abs(x).max(initial=0)), FLOOR)
    return bool((np.abs(every - x) <= within).all(axis=tuple(range(1, every.ndim))).any())


def _statements(listing: Listing) -> Iterator[tuple[Any, Any, list[Any]]]:
    """Yield each assignment and return that has run, with its value and the values that it uses."""
    used, owner = list[Any](), listing.statements
    for node, value in listing.events:
        statement = owner[id(node)]
        if isinstance(statement, ast.Assign | ast.Return) and node is statement.value:
            yield statement, value, used
            used = []
        elif isinstance(node, ast.Name | ast.Subscript | ast.Attribute) and [*_arrays(value)]:
            used.append(value)


def _arrays(value: Any) -> Iterator[Array]:
    """Yield the arrays of a value that tell something: of finite numbers, not all of them whole."""
    if isinstance(value, np.ndarray | float | np.number):
        x = np.squeeze(np.asarray(value))
        if x.dtype.kind == "f" and np.isfinite(x).all() and (x != np.trunc(x)).any():
            yield x
    elif isinstance(value, list | tuple | Mapping):
        for entry in value.values() if isinstance(value, Mapping) else value:
            yield from _arrays(entry)
