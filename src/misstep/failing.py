"""The failing case: the arguments, what is expected and what was returned, and how to have it again."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from .compare import FLOOR, Array, Value, values
from .exercise import Exercise, Part, Quantity
from .text import Language, Text

__all__ = ["Block", "Case", "Compared", "failing_case", "whole"]

SAY = {
    "inputs": Text("The case:", "这组数据："),
    "compared": Text(
        "{name}: what is expected, and yours; [..] marks what differs", "{name}：应为，你的；[..] 标出不同之处"
    ),
    "expected": Text("expected", "应为"),
    "yours": Text("yours", "你的"),
    "no case": Text("{name} has no arguments: there is only one case.", "{name} 没有参数：只有一组数据。"),
    "more": Text("... and {n} more entries differ", "……另有 {n} 个元素不同"),
    "shell": Text("In a shell:  {line}", "在终端中：  {line}"),
    "cell": Text("In a cell:   {line}", "在单元格中：{line}"),
}

DIGITS = (4, 7, 10, 16)
"""Of a number: as few as tell it from the right one."""

FULL = 36
"""Entries of an array that is shown whole."""

NOISE = 1e-12
"""Numbers below this are shown as zero."""

LISTED = 6
"""Entries that are listed of a block that is too large to show."""


BLOCKS = 2
"""Blocks that are shown in numbers; of others only whether they are right is reported."""


@dataclass(frozen=True)
class Block:
    """A part of an answer beside the right one: its name, the index it starts at, and where it differs."""

    name: Text | None
    origin: tuple[int, ...]
    expected: Array
    got: Array
    wrong: Array

    def rows(self) -> Iterator[tuple[list[str], list[str]]]:
        """Yield the rows, expected and got, each number as text; where they differ, it is in brackets."""
        shape = (-1, self.expected.shape[-1] if self.expected.ndim else 1)
        for a, b, bad in zip(*(x.reshape(shape) for x in (self.expected, self.got, self.wrong))):
            differ = [(x, y) for x, y, no in zip(a, b, bad) if no]
            digits = next((d for d in DIGITS if all(_number(x, d) != _number(y, d) for x, y in differ)), DIGITS[-1])
            write = partial(_number, digits=digits)
            yield [f" {write(x)} " for x in a], [f"[{write(y)}]" if no else f" {write(y)} " for y, no in zip(b, bad)]

    @property
    def places(self) -> list[tuple[int, ...]]:
        """The indices, in the whole answer, of what differs."""
        return [tuple(int(k) + o for k, o in zip(at, self.origin)) for at in np.argwhere(self.wrong)]


@dataclass(frozen=True)
class Compared:
    """One thing that was returned beside the right one, block by block."""

    quantity: Quantity
    blocks: tuple[Block, ...]

    @property
    def is_right(self) -> bool:
        """Whether nothing differs."""
        return not any(block.wrong.any() for block in self.blocks)


@dataclass(frozen=True)
class Case:
    """A case in which an answer is wrong. It can be made again: the same number and seed give the same arguments.

    Attributes
    ----------
    name : str
        Of the function.
    number, seed : int
        Which case, counted from 0, and the seed of the random numbers.
    inputs : tuple of (str, array or Text)
        Name and value of each argument; a text stands for other things than arrays.
    compared : tuple of Compared
        Expected and got; empty where they cannot be compared, or where the right numbers would be the solution.
    command, call : str
        What shows it again in a shell, and in Python.
    """

    name: str
    number: int
    seed: int
    inputs: tuple[tuple[str, Any], ...]
    compared: tuple[Compared, ...] = ()
    command: str = ""
    call: str = ""

    @property
    def shell(self) -> str:
        """The line that shows the case again in a shell."""
        return f"{self.command} case {self.name} {self.number} --seed {self.seed}"

    @property
    def cell(self) -> str:
        """The line that gives the arguments again in Python."""
        names = ", ".join(name for name, _ in self.inputs) if len(self.inputs) > 1 else f"({self.inputs[0][0]},)"
        return f"{names} = {self.call}.case({self.name!r}, {self.number}, seed={self.seed})"

    def text(self, language: Language) -> str:
        """Return the case in words and numbers."""
        if not self.inputs:
            return ""
        lines = [SAY["inputs"].of(language)]
        for name, value in self.inputs:
            lines += _assigned(name, value.of(language) if isinstance(value, Text) else value)
        for compared in self.compared:
            if not compared.is_right:
                lines += _beside(compared, language)
        again = {"shell": self.shell, "cell": self.cell}
        return "\n".join(lines + [SAY[where].fill(line=line).of(language) for where, line in again.items()])


def whole(part: Part, arguments: tuple[Any, ...], language: Language) -> str:
    """Return the arguments of a case and the right answer with all their numbers; of a number by hand, nothing."""
    if not arguments:
        return SAY["no case"].fill(name=part.name).of(language)
    names = [name.partition("=")[0] for name in part.arguments.split(", ")]
    right = values(part.value(part.solution, arguments), part.returns) or []
    with np.printoptions(floatmode="unique", threshold=10**6, linewidth=120):
        lines = [f"{name} = {value!r}" for name, value in zip(names, arguments)]
        lines += ["", SAY["expected"].of(language) + ":"]
        lines += [f"{value.quantity.title.of(language)} = {value.raw!r}" for value in right]
    return "\n".join(lines)


def failing_case(
    exercise: Exercise, part: Part, number: int, seed: int, arguments: tuple[Any, ...], answers: Sequence[Any] = ()
) -> Case:
    """Return a case with its arguments, and with the right answer and the student's where both are given."""
    names = [name.partition("=")[0] for name in part.arguments.split(", ")]
    inputs = tuple((name, _plain(value)) for name, value in zip(names, arguments))
    compared: list[Compared] = []
    if arguments and answers:
        right, got = (values(answer, part.returns) for answer in answers)
        compared = [_compared(a, b, part) for a, b in zip(right or [], got or []) if _comparable(a, b, part)]
    course = exercise.course
    return Case(part.name, number, seed, inputs, tuple(compared), course.command, course.call)


def _plain(value: Any) -> Any:
    """Return an argument as what can be shown and sent to another process."""
    if isinstance(value, np.ndarray | float | int) and not isinstance(value, bool):
        return np.asarray(value)
    if isinstance(value, list | tuple) and any(isinstance(x, np.ndarray) for x in value):
        return Text(f"a list of {len(value)} arrays", f"{len(value)} 个数组的列表")
    name = getattr(value, "name", value)
    return name if isinstance(name, Text) else Text(*(" ".join(str(name).split()),) * 2)


def _comparable(right: Value, got: Value, part: Part) -> bool:
    """Whether two values can be shown beside each other; not where the second stands for a lack of measurements."""
    if right.array is None or got.array is None or right.array.shape != got.array.shape:
        return False
    measured = part.call is not None and part.canonical is not None
    return not measured or bool(np.isfinite(got.array).all())


def _compared(right: Value, got: Value, part: Part) -> Compared:
    """Compare entry by entry, in the blocks that the quantity has."""
    a, b = np.asarray(right.array), np.asarray(got.array)
    if a.dtype.kind == "b" or b.dtype.kind == "b":
        wrong = a != b
    else:
        tolerance = part.rtol * np.abs(a[np.isfinite(a)]).max(initial=FLOOR)
        with np.errstate(invalid="ignore"):
            wrong = ~((np.abs(a - b) <= tolerance) | (a == b))
    blocks = []
    for name, index in right.quantity.layout.blocks(a.shape):
        origin = (0,) * (a.ndim - len(index) + 1) + tuple(piece.start for piece in index[1:])
        blocks.append(Block(name, origin, a[index], b[index], wrong[index]))
    whole = Block(None, (0,) * a.ndim, a, b, wrong)
    return Compared(right.quantity, tuple(blocks) if any(x.wrong.any() for x in blocks) else (whole,))


# ---------------------------------------------------------------- as text


def _number(x: Any, digits: int = DIGITS[0]) -> str:
    """Write a number in a fixed width, with so many digits."""
    if isinstance(x, bool | np.bool_):
        return f"{x!s:>9}"
    if isinstance(x, complex):
        return f"{x:.3g}"
    return f"{0.0 if abs(x) <= NOISE else x:>{digits + 5}.{digits}g}"  # nan stays nan


def _assigned(name: str, value: Any) -> list[str]:
    """Write an argument as Python would: an array that is not large with all its numbers."""
    if isinstance(value, np.ndarray) and value.size > FULL:
        return [f"    {name} = array {value.shape}"]
    if not isinstance(value, np.ndarray):
        return [f"    {name} = {value}"]
    shown = np.array2string(value, separator=", ", precision=6, suppress_small=not _tiny(value), max_line_width=88)
    first, *others = shown.split("\n")
    return [f"    {name} = {first}", *(" " * (len(name) + 7) + line for line in others)]


def _tiny(value: Any) -> bool:
    """Whether an array has a number that would be shown as zero, and is more than rounding."""
    return bool(((np.abs(value) < 1e-6) & (np.abs(value) > NOISE / 10)).any())


def _beside(compared: Compared, language: Language) -> list[str]:
    """Write expected and got, block by block: a block that is right in a word, one that is not in numbers."""
    name = compared.quantity.label.of(language)
    lines, shown = [SAY["compared"].fill(name=name).of(language)], 0
    for block in compared.blocks:
        bad = bool(block.wrong.any())
        if block.name is not None:
            lines.append(f"  {'✗' if bad else '✓'} {block.name.of(language)}")
        if bad and shown < BLOCKS:
            lines += _numbers(block, language)
        shown += bad
    return lines


def _numbers(block: Block, language: Language) -> list[str]:
    """Write a block in numbers: side by side where it is small, else the first entries that differ."""
    expected, yours = (SAY[key].of(language) for key in ("expected", "yours"))
    if block.expected.size > FULL or block.expected.ndim > 2 or (block.expected.shape or (1,))[-1] > 6:
        listed = [f"    {list(at)}  {_at(block, at)}" for at in block.places[:LISTED]]
        left = len(block.places) - len(listed)
        return listed + ["    " + SAY["more"].fill(n=left).of(language)] * (left > 0)
    rows = list(block.rows())
    if len(rows) == 1:
        return [f"    {expected:10}{''.join(rows[0][0])}", f"    {yours:10}{''.join(rows[0][1])}"]
    if len(rows[0][0]) <= 4:
        return ["    " + "".join(a) + "    |  " + "".join(b) for a, b in rows]
    above = [f"    {''.join(a)}" for a, _ in rows]
    return [f"    {expected}:", *above, f"    {yours}:", *(f"    {''.join(b)}" for _, b in rows)]


def _at(block: Block, place: tuple[int, ...]) -> str:
    """Write one entry, expected and got."""
    own = tuple(k - o for k, o in zip(place, block.origin))
    return f"{_number(block.expected[own])}  [{_number(block.got[own])}]"
