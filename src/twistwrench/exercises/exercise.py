"""What an exercise is: the functions that the student writes; its texts are in the data file beside it."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal

import numpy as np

from .layouts import PLAIN, Layout
from .prose import as_text, read
from .words.text import Text

__all__ = ["Exercise", "Kind", "Part", "Property", "Quantity"]

Kind = Literal["code", "number", "explain", "prove"]
Cases = Callable[[np.random.Generator], Sequence[tuple[Any, ...]]]


CHINESE = {
    "F by X*": "用 X* 求得的 F",
    "F by vectors": "用矢量求得的 F",
    "M (base held)": "M（基座固定）",
    "X of T_AB T_BC": "T_AB T_BC 的 X",
    "a of the base": "基座的 a",
    "a of the centre of mass": "质心的 a",
    "error": "误差",
    "f_z (12 kg)": "f_z（12 kg）",
    "f_z (model)": "f_z（模型）",
    "front": "前脚",
    "rear": "后脚",
    "holds": "能否支撑",
    "nq (Euler)": "nq（欧拉角）",
    "nq (quaternion)": "nq（四元数）",
    "nv (Euler)": "nv（欧拉角）",
    "nv (quaternion)": "nv（四元数）",
    "q̈ as expected": "预期的 q̈",
    "q̈ by ABA": "用 ABA 求得的 q̈",
    "q̈ by CRBA": "用 CRBA 求得的 q̈",
    "ratio": "比值",
    "rows (fixed)": "行数（固定基座）",
    "rows (floating)": "行数（浮动基座）",
    "rows of J_c": "J_c 的各行",
    "eigenvalues": "特征值",
    "the error of V ± F": "V ± F 的异常",
    "the error of V.power(W)": "V.power(W) 的异常",
    "time": "时间",
    "lower": "下限 lower",
    "upper": "上限 upper",
    "wrench from outside": "外部的 wrench",
    "τ by RNEA": "用 RNEA 求得的 τ",
    "τ with a₀ = −g": "取 a₀ = −g 时的 τ",
    "τ with weights": "把重力作为外力时的 τ",
}
"""Names of quantities that are not symbols alone."""


@dataclass(frozen=True)
class Quantity:
    """One thing that a function returns: its symbol, how its numbers are arranged, and its unit."""

    name: str
    layout: Layout = PLAIN
    unit: str = ""

    @property
    def title(self) -> Text:
        """The name in both languages: a symbol is the same in both."""
        return Text(self.name, CHINESE.get(self.name, self.name))

    @property
    def label(self) -> Text:
        """The name and the unit."""
        unit = f" [{self.unit}]" if self.unit else ""
        return Text(self.title.en + unit, self.title.zh + unit)


@dataclass(frozen=True)
class Property:
    """A property that every right answer has, however it was computed.

    ``residual(answer, *arguments)`` is zero, entry by entry, where the answer has it.
    """

    text: Text
    residual: Callable[..., Any]


@dataclass(frozen=True, kw_only=True)
class Part:
    """One function that the student writes.

    Attributes
    ----------
    solution : callable
        The reference. Its name and its signature are those of the student's function; its source is the solution.
    beside : tuple of callable
        What the solution calls and is shown with it: the listing of an algorithm, and what prepares its arguments.
    returns : tuple of Quantity
        What it returns; a tuple of several where there are several.
    cases : callable
        From a random generator to a list of argument tuples. Numbers that need none: ``[()]``.
    edges : callable
        As `cases`: further arguments, tried of an answer that is right in all others. Degenerate ones: a single
        foot, a point of mass, a singular matrix.
    slips : mapping
        Name of a slip of `slips.SLIPS` to a wrong implementation with the same signature.
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
    returns: tuple[Quantity, ...]
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

    @cached_property
    def _prose(self) -> Mapping[str, Any]:
        """The table of the function in the data file beside its module."""
        found: Mapping[str, Any] = read("items", self.solution.__module__.rpartition(".")[2])[self.name]
        return found

    @cached_property
    def doc(self) -> Text:
        """The docstring of the skeleton: shape, unit and frame of every argument and of what is returned."""
        return as_text(self._prose["doc"])

    @cached_property
    def reasons(self) -> Mapping[str, Text]:
        """The reasons of slips whose general reason does not fit here."""
        return {slip: as_text(entry) for slip, entry in self._prose.get("reasons", {}).items()}

    @cached_property
    def titles(self) -> Mapping[str, Text]:
        """The names of slips whose general name does not fit here."""
        return {slip: as_text(entry) for slip, entry in self._prose.get("titles", {}).items()}

    @cached_property
    def properties(self) -> tuple[Property, ...]:
        """The properties of a right answer."""
        entries = self._prose.get("properties", [])
        return tuple(
            Property(as_text(entry), residual) for entry, residual in zip(entries, self.residuals, strict=True)
        )

    @property
    def arguments(self) -> str:
        """The arguments, as in a signature without types; of a class, those that `call` uses it with."""
        if inspect.isclass(self.solution):
            return ", ".join([*inspect.signature(self.call).parameters][1:]) if self.call else ""
        parameters = inspect.signature(self.solution).parameters.values()
        return ", ".join(p.name if p.default is p.empty else f"{p.name}={p.default!r}" for p in parameters)

    def value(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        """Call a function as this part calls it."""
        return function(*arguments) if self.call is None else self.call(function, *arguments)


@dataclass(frozen=True, kw_only=True)
class Exercise:
    """An exercise of the chapter. Its texts, hints and model answer are in the data file beside its module.

    Attributes
    ----------
    id : str
        The chapter's number, as "49.3.1"; the project's stages are "project.1" to "project.4".
    kind : {"code", "number", "explain", "prove"}
    parts : tuple of Part
    uses : tuple of str
        Functions of earlier exercises that the skeleton offers through `mine`.
    needs : str
        A package without which it cannot be done, and stays to do; empty for none.
    """

    id: str
    kind: Kind
    parts: tuple[Part, ...]
    uses: tuple[str, ...] = field(default=())
    needs: str = ""

    @cached_property
    def _prose(self) -> Mapping[str, Any]:
        return read("items", f"ex_{self.id.replace('.', '_')}")

    @property
    def title(self) -> Text:
        """The title."""
        return as_text(self._prose["title"])

    @property
    def text(self) -> Text:
        """The question, in our own words, with the chapter's numbers. It names the chapter's errors."""
        return as_text(self._prose["text"])

    @property
    def hints(self) -> tuple[Text, ...]:
        """From a nudge to nearly the answer."""
        return tuple(map(as_text, self._prose["hints"]))

    @property
    def answer(self) -> Text | None:
        """The model answer, where the student writes one in words; shown after the attempt."""
        return as_text(self._prose["answer"]) if "answer" in self._prose else None

    @property
    def section(self) -> str:
        """The section, as "49.3", or "project"."""
        return self.id.rpartition(".")[0]

    @property
    def answer_name(self) -> str:
        """The name that the student's answer in words has in the file."""
        return "answer_" + self.id.replace(".", "_")
