"""What an exercise is: the functions that the student writes; its texts are in the data file beside it."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import product
from typing import Any, Literal, NamedTuple

import numpy as np

from .text import Text, as_text, read

__all__ = ["PLAIN", "Exercise", "Kind", "Layout", "Output", "Part", "Property", "Slip"]

Kind = Literal["code", "number", "explain", "prove"]
Cases = Callable[[np.random.Generator], Sequence[tuple[Any, ...]]]
Parts = tuple[tuple[Text, slice], ...]


@dataclass(frozen=True)
class Layout:
    """Names for the parts of the last axes of an array.

    `axes` holds, for each of the last axes, its parts: a name and the slice of indices it stands for.
    """

    axes: tuple[Parts, ...] = ()

    def blocks(self, shape: tuple[int, ...]) -> Iterator[tuple[Text, tuple[Any, ...]]]:
        """Yield name and index of every block of an array of that shape that is not empty."""
        if not self.axes or len(shape) < len(self.axes):
            return
        sizes = shape[len(shape) - len(self.axes) :]
        for parts in product(*self.axes):
            if all(part.start < size for (_, part), size in zip(parts, sizes)):
                names = [name for name, _ in parts]
                yield _joined(names, len(shape)), (..., *(part for _, part in parts))


def _joined(names: list[Text], axes: int) -> Text:
    """Name a block: rows of a vector, columns of several that are rows, or rows and columns of a matrix."""
    if len(names) == 1:
        lines, zh = ("rows", "行") if axes == 1 else ("columns", "列")
        english = f"the {lines} {names[0].en}" if names[0].en.startswith("of ") else f"the {names[0].en} {lines}"
        return Text(english, f"{names[0].zh} 各{zh}")
    rows, columns = names
    column = "column" if columns.en.startswith("3 ") else "columns"
    return Text(
        f"the block of rows {rows.en}, {column} {columns.en}",
        f"{_lines_zh(rows.zh, '行')}、{_lines_zh(columns.zh, '列')}的块",
    )


def _lines_zh(name: str, line: str) -> str:
    """Name rows or columns in Chinese: numbers are counted, and a name in brackets comes last."""
    number, bracket, rest = name.partition("（")
    return f"第 {number} {line}{bracket}{rest}" if number[:1].isdigit() else f"{name} {line}"


PLAIN = Layout()


@dataclass(frozen=True)
class Output:
    """One thing that a function returns: its symbol, how its numbers are arranged, its unit, its name in Chinese."""

    name: str
    layout: Layout = PLAIN
    unit: str = ""
    zh: str = ""

    @property
    def title(self) -> Text:
        """The name in both languages: a symbol is the same in both."""
        return Text(self.name, self.zh or self.name)

    @property
    def label(self) -> Text:
        """The name and the unit."""
        unit = f" [{self.unit}]" if self.unit else ""
        return Text(self.name + unit, self.title.zh + unit)


class Slip(NamedTuple):
    """A mistake that many have made before: its name, what is true instead, where the course has it, its kind."""

    title: Text
    why: Text
    section: str
    kind: Text


class Property(NamedTuple):
    """A property of every right answer: ``residual(answer, *arguments)`` is zero, entry by entry."""

    text: Text
    residual: Callable[..., Any]


class _Written:
    """What has its texts in a data file: in the package and with the content that a class names."""

    _package: str
    _prose: Mapping[str, Any]

    def _text(self, entry: Mapping[str, str]) -> Text:
        return as_text(entry, self._package)

    def _texts(self, key: str) -> dict[str, Text]:
        return {name: self._text(entry) for name, entry in self._prose.get(key, {}).items()}


@dataclass(frozen=True, kw_only=True)
class Part(_Written):
    """One function that the student writes.

    Attributes
    ----------
    solution : callable
        The reference. Its name and its signature are those of the student's function; its source is the solution.
    beside : tuple of callable
        What the solution calls and is shown with it: the listing of an algorithm, and what prepares its arguments.
    returns : tuple of Output
        What it returns; a tuple of several where there are several.
    cases : callable
        From a random generator to a list of argument tuples. Numbers that need none: ``[()]``.
    edges : callable
        As `cases`: further arguments, tried of an answer that is right in all others. Degenerate ones: a single
        foot, a point of mass, a singular matrix.
    slips : mapping
        Key of a slip of the course to a wrong implementation with the same signature.
    alike : tuple
        Groups of those names that cannot be distinguished here: the message then names all of a group.
    ways : tuple of callable
        Other right functions, written as a student might who goes another way: a wrong answer is explained by a small
        edit of any of them.
    residuals : tuple of callable
        Of the properties, in the order of their texts in the data file: ``residual(answer, *arguments)`` is zero, entry
        by entry, for every right answer, however it was computed. They explain a wrong answer that is not a known slip.
    canonical : callable, optional
        ``canonical(answer, *arguments)``: what is compared where more than one answer is right.
    call : callable, optional
        ``call(function, *arguments)``: how the function is used, where a plain call would not do (a class).
    given : str
        Lines of the body that the skeleton already has, before ``return ...``.
    rtol : float
        How near the answer must come, relative to its largest entry.
    """

    solution: Callable[..., Any]
    returns: tuple[Output, ...]
    cases: Cases
    slips: Mapping[str, Callable[..., Any]]
    beside: tuple[Callable[..., Any], ...] = ()
    alike: tuple[frozenset[str], ...] = ()
    edges: Cases = lambda rng: ()
    ways: tuple[Callable[..., Any], ...] = ()
    residuals: tuple[Callable[..., Any], ...] = ()
    canonical: Callable[..., Any] | None = None
    call: Callable[..., Any] | None = None
    given: str = ""
    rtol: float = 1e-9

    @property
    def name(self) -> str:
        """The name of the student's function."""
        return self.solution.__name__

    @property
    def _package(self) -> str:  # type: ignore[override]
        return self.solution.__module__.rpartition(".")[0]

    @cached_property
    def _prose(self) -> Mapping[str, Any]:  # type: ignore[override]
        found: Mapping[str, Any] = read(self._package, self.solution.__module__.split(".")[-1]).get(self.name, {})
        return found

    @cached_property
    def doc(self) -> Text:
        """The docstring of the skeleton: shape, unit and frame of every argument and of what is returned."""
        return self._text(self._prose["doc"])

    @cached_property
    def hints(self) -> tuple[Text, ...]:
        """From a nudge to nearly the answer."""
        return tuple(map(self._text, self._prose.get("hints", [])))

    @cached_property
    def reasons(self) -> Mapping[str, Text]:
        """The reasons of slips whose general reason does not fit here."""
        return self._texts("reasons")

    @cached_property
    def titles(self) -> Mapping[str, Text]:
        """The names of slips whose general name does not fit here."""
        return self._texts("titles")

    @cached_property
    def properties(self) -> tuple[Property, ...]:
        """The properties of a right answer."""
        texts = map(self._text, self._prose.get("properties", []))
        return tuple(Property(text, residual) for text, residual in zip(texts, self.residuals, strict=True))

    @property
    def arguments(self) -> str:
        """The arguments, as in a signature without types; of a class, those that `call` uses it with."""
        if inspect.isclass(self.solution):
            return ", ".join([*inspect.signature(self.call).parameters][1:]) if self.call else ""
        parameters = inspect.signature(self.solution).parameters.values()
        return ", ".join(p.name if p.default is p.empty else f"{p.name}={p.default!r}" for p in parameters)

    @property
    def names(self) -> list[str]:
        """The names of the arguments."""
        return [name.partition("=")[0] for name in self.arguments.split(", ")]

    def value(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        """Call a function as this part calls it."""
        return function(*arguments) if self.call is None else self.call(function, *arguments)


@dataclass(frozen=True, kw_only=True)
class Exercise(_Written):
    """An exercise of the chapter. Its texts and its model answer are in the data file beside its module.

    Attributes
    ----------
    id : str
        The chapter's number, as "49.3.1"; the project's stages are "project.1" to "project.4".
    kind : {"code", "number", "explain", "prove"}
    parts : tuple of Part
    uses : tuple of str
        Functions of earlier exercises that the skeleton offers through `mine`.
    taught : str
        The section that teaches what it asks for, where that is not its own.
    needs : str
        A package without which it cannot be done, and stays to do; empty for none.
    course : Course
        The course that has it.
    """

    id: str
    kind: Kind
    parts: tuple[Part, ...]
    uses: tuple[str, ...] = field(default=())
    taught: str = ""
    needs: str = ""
    course: Any = None

    @cached_property
    def _prose(self) -> Mapping[str, Any]:  # type: ignore[override]
        return read(self._package, f"ex_{self.id.replace('.', '_')}")

    @property
    def _package(self) -> str:  # type: ignore[override]
        return self.parts[0].solution.__module__.rpartition(".")[0]

    @property
    def title(self) -> Text:
        """The title."""
        return self._text(self._prose["title"])

    @property
    def text(self) -> Text:
        """The question, in our own words, with the chapter's numbers. It names the chapter's errors."""
        return self._text(self._prose["text"])

    def part(self, name: str) -> Part:
        """Return one of its functions."""
        return next(part for part in self.parts if part.name == name)

    @property
    def answer(self) -> Text | None:
        """The model answer, where the student writes one in words; shown after the attempt."""
        return self._text(self._prose["answer"]) if "answer" in self._prose else None

    @property
    def section(self) -> str:
        """The section, as "49.3", or "project"."""
        return self.id.rpartition(".")[0]

    @property
    def answer_name(self) -> str:
        """The name that the student's answer in words has in the file."""
        return "answer_" + self.id.replace(".", "_")
