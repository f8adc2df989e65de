"""The record of a judged function: right or not, the message, and the failing case with its numbers; also as JSON."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from functools import partial
from json import dumps, loads  # by themselves: a student's file may change the module
from typing import Any, Literal

import numpy as np

from .calls import value_of_reference
from .compare import Array, differing, values
from .exercise import Exercise, Part
from .text import Language, Text, hanging, say

__all__ = [
    *("EXPECTED", "LEVELS", "YOURS", "Case", "Compared", "How", "State", "Unread", "Verdict"),
    *("as_json", "failing_case", "from_json", "headed", "whole"),
]

State = Literal["to do", "done", "wrong"]
How = Literal["slip", "line", "reference", "structure", "located", "numbers"]

DIGITS = (4, 7, 10, 16)  # of a number: as few as tell it from the right one
FULL = 36  # entries of an array that is shown whole
MAX_COLUMNS = 6  # of an array that is shown whole
MAX_LISTED = 6  # entries that are listed of an array that is not
NOISE = 1e-12  # numbers below this are shown as zero
LEVELS = (1, 2, 3)
"""Of a message: where it is wrong and what kind of slip it is; which slip; the cure."""


EXPECTED, YOURS = Text("expected", "应为"), Text("yours", "你的")
DIFFERS = Text("{name}: expected, and yours; [..] marks what differs", "{name}：应为，你的；[..] 标出不同之处")


@dataclass(frozen=True)
class Compared:
    """One thing that was returned beside the right one: its name, both as arrays, and where they differ."""

    label: Text
    expected: Array
    got: Array
    wrong: Array

    @property
    def is_right(self) -> bool:
        """Whether nothing differs."""
        return not self.wrong.any()

    @property
    def is_small(self) -> bool:
        """Whether all of its numbers are shown."""
        return self.expected.size <= FULL and self.expected.ndim <= 2 and self._columns <= MAX_COLUMNS

    @property
    def _columns(self) -> int:
        return self.expected.shape[-1] if self.expected.ndim else 1

    def rows(self) -> Iterator[tuple[list[str], list[str]]]:
        """Yield the rows, expected and got, each number as text; where they differ, it is in brackets."""
        for a, b, bad in zip(*(x.reshape(-1, self._columns) for x in (self.expected, self.got, self.wrong))):
            differ = [(x, y) for x, y, no in zip(a, b, bad) if no]
            write = partial(_number, digits=_digits(differ))
            yield [f" {write(x)} " for x in a], [f"[{write(y)}]" if no else f" {write(y)} " for y, no in zip(b, bad)]

    def lines(self, language: Language) -> list[str]:
        """Return it in numbers: side by side where it is small, else the first entries that differ."""
        head, expected, yours = (x.of(language) for x in (DIFFERS.fill(name=self.label), EXPECTED, YOURS))
        if not self.is_small:
            found = [*zip(np.argwhere(self.wrong).tolist(), self.expected[self.wrong], self.got[self.wrong])]
            more = say("... and {n} more entries differ", "……另有 {n} 个元素不同", n=len(found) - MAX_LISTED)
            digits = _digits([(x, y) for _, x, y in found[:MAX_LISTED]])
            listed = [f"    {at}  {_number(x, digits)}  [{_number(y, digits)}]" for at, x, y in found[:MAX_LISTED]]
            return [head, *listed, *["    " + more.of(language)] * (len(found) > MAX_LISTED)]
        rows = [("".join(a), "".join(b)) for a, b in self.rows()]
        if len(rows) == 1:
            return [head, f"    {expected:10}{rows[0][0]}", f"    {yours:10}{rows[0][1]}"]
        if self._columns <= 4:
            return [head, *(f"    {a}    |  {b}" for a, b in rows)]
        above, below = ([f"    {row[k]}" for row in rows] for k in (0, 1))
        return [head, f"    {expected}:", *above, f"    {yours}:", *below]


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

    def given(self, language: Language) -> list[str]:
        """Return the arguments, a line each, or several for an array."""
        values = {name: x.of(language) if isinstance(x, Text) else x for name, x in self.inputs}
        return [line for name, value in values.items() for line in _assigned(name, value)]

    def text(self, language: Language) -> str:
        """Return the case in words and numbers."""
        if not self.inputs:
            return ""
        lines = [Text("The case:", "这组数据：").of(language), *(f"    {line}" for line in self.given(language))]
        for compared in self.compared:
            lines += [] if compared.is_right else compared.lines(language)
        again = say("In a shell:  {line}", "在终端中：  {line}", line=self.shell)
        in_cell = say("In a cell:   {line}", "在单元格中：{line}", line=self.cell)
        return "\n".join([*lines, again.of(language), in_cell.of(language)])


@dataclass(frozen=True)
class Verdict:
    """The judgement of an answer, with its message.

    Attributes
    ----------
    state : {"to do", "done", "wrong"}
    lines : tuple of Text
        Where it is wrong, and what kind of slip it is, line by line; empty for what is done.
    slips : tuple of str
        The slips that give the same answer, keys of the slips of the field.
    case : Case, optional
        The first case in which the answer is wrong.
    how : {"slip", "line", "reference", "structure", "located", "numbers"}
        By what it was found what is wrong: a slip of the list; an edit of the student's own code that makes it right;
        an edit of a right solution that gives the same numbers; what shows without numbers, as a type or a shape; else
        by where or how the numbers differ, or only by that they do. Empty unless wrong.
    help, cure : tuple of Text
        What is shown on request: the slip and its reason, or the line to look at; and what to write instead.
    more : tuple of Text
        Where to read on, and how to ask for more in a shell.
    """

    state: State
    lines: tuple[Text, ...] = ()
    slips: tuple[str, ...] = ()
    case: Case | None = None
    how: How | Literal[""] = ""
    help: tuple[Text, ...] = ()
    cure: tuple[Text, ...] = ()
    more: tuple[Text, ...] = ()

    def __post_init__(self) -> None:
        if self.state == "wrong" and not self.how:
            object.__setattr__(self, "how", "structure")

    def message(self, language: Language, level: int = 1, *, in_shell: bool = True) -> str:
        """Return the message: at level 1 where it is wrong and the kind of slip, at 2 the slip, at 3 the cure."""
        lines = (*self.lines, *self.help * (level > 1), *self.cure * (level > 2), *self.more[: None if in_shell else 1])
        return "\n".join(piece for line in lines for piece in hanging(line.of(language)))

    def report(self, language: Language, level: int = 1) -> str:
        """Return the message, and below it the failing case with its numbers."""
        shown = "" if self.case is None else self.case.text(language)
        return self.message(language, level) + ("\n\n" + shown if shown else "")

    def stages(self, level: int = LEVELS[-1]) -> tuple[Text, ...]:
        """Return what is told on request up to a level: the help and the cure, where there are any."""
        each = (self.help * (level > 1), self.cure * (level > 2))
        return tuple(Text(*("\n".join(x.of(k) for x in lines) for k in ("en", "zh"))) for lines in each if lines)


class Unread(Verdict):
    """The verdict on each function of a file that cannot be read."""


def headed(exercise: Exercise, part: Part, *lines: Text, **more: Any) -> Verdict:
    """Return the verdict on a function that is wrong, under its name."""
    head = say("{id}  {name}: not yet right.", "{id}  {name}：还不对。", id=exercise.id, name=part.name)
    return Verdict("wrong", (head, *lines), **more)


def failing_case(
    exercise: Exercise, part: Part, number: int, seed: int, arguments: tuple[Any, ...], answers: Sequence[Any] = ()
) -> Case:
    """Return a case with its arguments, and with the right answer and the student's where both are given."""
    inputs = tuple((name, _as_input(value)) for name, value in zip(part.names, arguments))
    compared: list[Compared] = []
    if arguments and answers:
        right, got = (values(answer, part.returns) for answer in answers)
        is_measured = part.call is not None and part.canonical is not None  # nan stands for a lack of measurements
        for a, b in zip(right or [], got or []):
            x, y = a.array, b.array
            if x is not None and y is not None and x.shape == y.shape and (not is_measured or np.isfinite(y).all()):
                compared.append(Compared(a.output.label, x, y, differing(y, x, part.rtol)))
    course = exercise.course
    return Case(part.name, number, seed, inputs, tuple(compared), course.command, course.call)


def whole(part: Part, arguments: tuple[Any, ...], language: Language) -> str:
    """Return the arguments of a case and the right answer with all their numbers; of a number by hand, nothing."""
    if not arguments:
        return Text(f"{part.name} has no arguments.", f"{part.name} 没有参数。").of(language)
    right = values(value_of_reference(part, arguments), part.returns) or []
    with np.printoptions(floatmode="unique", threshold=10**6, linewidth=120):
        lines = [f"{name} = {value!r}" for name, value in zip(part.names, arguments)]
        lines += ["", EXPECTED.of(language) + ":"]
        lines += [f"{value.output.title.of(language)} = {value.raw!r}" for value in right]
    return "\n".join(lines)


def _as_input(value: Any) -> Any:
    """Return an argument as what can be shown and sent to another process."""
    if isinstance(value, np.ndarray | float | int) and not isinstance(value, bool):
        return np.asarray(value)
    if isinstance(value, list | tuple) and any(isinstance(x, np.ndarray) for x in value):
        return Text(f"a list of {len(value)} arrays", f"{len(value)} 个数组的列表")
    name = getattr(value, "name", value)
    return name if isinstance(name, Text) else Text(*(" ".join(str(name).split()),) * 2)


def _digits(differ: Sequence[tuple[Any, Any]]) -> int:
    """Return with how many digits all pairs of numbers are seen to differ."""
    return next((d for d in DIGITS if all(_number(x, d) != _number(y, d) for x, y in differ)), DIGITS[-1])


def _number(x: Any, digits: int = DIGITS[0]) -> str:
    """Write a number in a fixed width, with so many digits."""
    if isinstance(x, bool | np.bool_):
        return f"{x!s:>9}"
    if isinstance(x, complex):
        return f"{x:.3g}"
    return f"{0.0 if abs(x) <= NOISE else x:>{digits + 5}.{digits}g}"  # nan stays nan


def _assigned(name: str, value: Any) -> list[str]:
    """Write an argument as Python would: an array that is not large with all its numbers."""
    if not isinstance(value, np.ndarray) or value.size > FULL:
        return [f"{name} = " + (f"array {value.shape}" if isinstance(value, np.ndarray) else str(value))]
    is_tiny = bool(((np.abs(value) < 1e-6) & (np.abs(value) > NOISE / 10)).any())  # more than rounding
    text = np.array2string(value, separator=", ", precision=6, suppress_small=not is_tiny, max_line_width=88)
    first, *others = text.split("\n")
    return [f"{name} = {first}", *(" " * (len(name) + 3) + line for line in others)]


# ---------------------------------------------------------------- as JSON: of a few classes, and of nothing else

CONTROLS = {k: f"\\x{k:02x}" for k in (*range(32), 127) if chr(k) not in "\t\n"}
"""Characters that a terminal or a table obeys. Others that no file can hold are written in the same way."""

CLASSES = {kind.__name__: kind for kind in (Verdict, Unread, Case, Compared, Text)}
FIELDS = {"Text": Text._fields} | {x.__name__: [f.name for f in fields(x)] for x in (Verdict, Unread, Case, Compared)}


def as_json(value: Any) -> str:
    """Return numbers, texts, arrays and verdicts as a line of JSON.

    >>> as_json(Text("right", "正确").en), as_json(np.eye(2, dtype=bool))
    ('"right"', '{"array": [[2, 2], "b", [1, 0, 0, 1]]}')
    """
    return dumps(_plain(value))


def _plain(x: Any) -> Any:
    name = type(x).__name__
    if x is None or isinstance(x, bool | int | float):
        return x
    if isinstance(x, str):
        return x.translate(CONTROLS).encode("utf-8", "backslashreplace").decode()
    if type(x) is CLASSES.get(name):
        return {name: [_plain(getattr(x, field)) for field in FIELDS[name]]}
    if isinstance(x, list | tuple):
        return [_plain(item) for item in x]
    if isinstance(x, np.ndarray | np.number | np.bool_):
        array = np.asarray(x)
        kind = "i" if array.dtype.kind == "u" else array.dtype.kind
        flat: Any = array.ravel().astype({"f": float, "i": int, "b": int, "c": complex}[kind])
        return {"array": [list(array.shape), kind, flat.view(float if kind == "c" else flat.dtype).tolist()]}
    raise TypeError(f"expected numbers, texts, arrays or a verdict, got {name}")


def from_json(text: str | bytes) -> Any:
    """Return the value that a line of JSON stands for, lists as tuples; a ValueError where it stands for none.

    >>> from_json(as_json(Verdict("wrong", (Text("no", "否"),)))).message("en")
    'no'
    """
    try:
        return _value(loads(text))
    except (KeyError, TypeError, ValueError, RecursionError) as error:
        raise ValueError(f"expected a message, got {text[:80]!r}: {error}") from None


def _value(x: Any) -> Any:
    if isinstance(x, list):
        return tuple(map(_value, x))
    if not isinstance(x, dict):
        return x
    ((name, held),) = x.items()
    if name == "array":
        shape, kind, numbers = held
        flat: Any = np.array(numbers, {"b": bool, "i": int}.get(kind, float))
        return (flat.view(complex) if kind == "c" else flat).reshape(shape)
    return CLASSES[name](*map(_value, held))
