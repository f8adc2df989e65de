"""Whether a wrong result, or a block of it, is another quantity with a name: what a neighbouring function returns."""

from __future__ import annotations

import inspect
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

import twistwrench as tw

from ...arrays import Array
from .. import catalogue
from ..calls import copied
from ..compare import FLOOR, ROUNDING, values
from ..exercise import Part
from ..words.phrases import say
from ..words.text import Text
from .known import KNOWN, Known

__all__ = ["Neighbours"]

FEWEST = 6
"""Different numbers that are not met by chance, in all cases together; half of them in one, unless that is a number."""

LARGEST = 2000
"""Entries of what is compared."""

Answers = Sequence[Any]
Cases = Sequence[tuple[Any, ...]]
Index = tuple[Any, ...]


def _six(x: Array) -> Array:
    """Return an array with the angular and the linear half exchanged: of a matrix 6 × 6 its rows and its columns."""
    if len(x) < 6 or (x.ndim == 2 and len(x) != 6):
        raise ValueError("six rows are expected")
    order = [3, 4, 5, 0, 1, 2, *range(6, len(x))]
    return x[np.ix_(order, order)] if x.shape == (6, 6) else x[order]


FORMS: dict[str, Callable[[Array], Array]] = {
    "{title}": lambda x: x,
    "turned sign": lambda x: -x,
    "transposed form": lambda x: x.mT,
    "inverse form": np.linalg.inv,
    "halves form": _six,
    "first six form": lambda x: x[:6],
    "first three form": lambda x: x[:3],
    "next three form": lambda x: x[3:6],
    "joints form": lambda x: x[6:],
    "first columns form": lambda x: x[:, :6],
}
"""What may be done to a quantity, or taken of it."""

TURNED = ("turned sign", "transposed form")
"""What a block of the right result may have become: it is said before another quantity is thought of."""


class Neighbours:
    """The quantities that may be computed from the arguments of a function, in each case.

    Parameters
    ----------
    part : Part
    right : sequence
        What is expected, in each case.
    cases : sequence of tuple
    until : float
        When the search ends, as `time.process_time` has it.
    """

    def __init__(self, part: Part, right: Answers, cases: Cases, until: float) -> None:
        self.part, self.until = part, until
        self.right = [values(x, part.returns) or [] for x in right]
        self.names = [name.partition("=")[0] for name in part.arguments.split(", ")]
        self.cases = [tuple(map(_ours, c)) for c in cases]
        self._known: dict[tuple[int, int], Any] = {}
        self._candidates: list[Known] = []

    def lines(self, answers: Answers) -> list[Text]:
        """Report of each wrong thing that was returned what it is in all cases; nothing unless all are known."""
        part, given = self.part, [values(x, self.part.returns) for x in answers]
        if part.canonical is not None or part.call is not None or not self.cases[0] or not all(given):
            return []
        found = []
        for k, quantity in enumerate(part.returns):
            got: list[Any] = [x[k].array for x in given if x]
            right: list[Any] = [x[k].array for x in self.right]
            if not all(map(_telling, (*got, *right))):
                return []
            if not all(map(self._same, got, right)):
                lines = self._one(k, quantity.title, got, right)
                if not lines:
                    return []
                found += lines
                shapes = {(a.shape, b.shape) for a, b in zip(got, right) if a.shape != b.shape}
                found += [say("shape", name=quantity.title, got=a, expected=b) for a, b in [*shapes][:1]]
        return [say("another"), *(Text("  " + x.en, "  " + x.zh) for x in found)] if found else []

    def _one(self, k: int, name: Text, got: list[Any], right: list[Any]) -> list[Text]:
        """Return what one of the things returned is, or each of its blocks that are wrong."""
        whole = self._match(got, right)
        if whole is not None:
            return [say("known", name=name, title=whole)]
        lines = []
        if all(a.shape == b.shape for a, b in zip(got, right)):
            for block, index in self.part.returns[k].layout.blocks(right[0].shape):
                parts, wanted = [x[index] for x in got], [x[index] for x in right]
                if not all(map(self._same, parts, wanted)):
                    title = self._match(parts, wanted, index)
                    if title is None:
                        return []
                    lines.append(say("known", name=say("block", name=name, block=block), title=title))
        return lines

    def _match(self, got: list[Any], right: list[Any], index: Index | None = None) -> Text | None:
        """Return the first quantity, or form of one, that is the same in all cases, or the block of it at `index`."""
        wrong = [j for j, (a, b) in enumerate(zip(got, right)) if not self._same(a, b)]
        sizes = [{abs(float(f"{x:.6g}")) for x in np.ravel(got[j]) if abs(x) > ROUNDING} for j in wrong]
        if len(set[float].union(*sizes)) < FEWEST or (got[0].ndim and max(map(len, sizes)) < FEWEST // 2):
            return None
        order = sorted(range(len(got)), key=lambda j: j not in wrong)
        for form in TURNED if index is not None else ():
            if all(got[j].ndim > 1 and self._same(got[j], FORMS[form](right[j])) for j in order):
                return say(form, title=say("right block"))
        for form, change in FORMS.items():
            for number, known in enumerate(self._all()):
                for taken in (None,) if index is None else (None, index):
                    if time.process_time() > self.until:
                        return None
                    if all(self._is(number, known, change, j, got[j], taken) for j in order):
                        title = known.title if form == "{title}" else say(form, title=known.title)
                        return title if taken is None else say("entries of", entries=_written(taken), title=title)
        return None

    def _is(
        self, number: int, known: Known, change: Callable[[Array], Array], case: int, got: Array, index: Index | None
    ) -> bool:
        """Whether a form of a quantity, or the block of it at `index`, is what was returned in a case."""
        if (number, case) not in self._known:
            arguments = (*(self.cases[case][self.names.index(name)] for name in known.needs), case)
            self._known[number, case] = _array(known.value, arguments)
        value = self._known[number, case]
        if value is None:
            return False
        try:
            value = change(value)
            return self._same(got, value if index is None else value[index])
        except (IndexError, TypeError, ValueError):  # it has no such form
            return False

    def _all(self) -> list[Known]:
        """Return what is tried: what is to be returned, known quantities, the arguments, other exercises."""
        if not self._candidates:
            names = {*self.names}
            known = (x for x in KNOWN if {*x.needs} <= names)
            self._candidates = [
                *self._others(),
                *(Known(x.title, lambda *given, f=x.value: f(*given[:-1]), x.needs) for x in known),
                *self._arguments(),
                *self._exercises(names),
            ]
        return self._candidates

    def _others(self) -> Iterator[Known]:
        """Yield the right values of all that is to be returned."""
        for k, quantity in enumerate(self.part.returns):
            title = say("right one", name=quantity.title)
            yield Known(title, lambda case, k=k: self.right[case][k].array, ())

    def _arguments(self) -> Iterator[Known]:
        for name in self.names:
            title = say("argument itself", name=name)
            yield Known(title, lambda x, case: x if isinstance(x, np.ndarray) else None, (name,))

    def _exercises(self, names: set[str]) -> Iterator[Known]:
        """Yield what other functions of the exercises return, whose arguments have the same names."""
        for exercise in map(catalogue.exercise, catalogue.available()):
            for part in exercise.parts:
                if part.name == self.part.name or exercise.needs or inspect.isclass(part.solution) or part.call:
                    continue
                needs = tuple(inspect.signature(part.solution).parameters)
                for k, quantity in enumerate(part.returns if needs and {*needs} <= names else ()):
                    title = say("asked elsewhere", name=quantity.title, function=part.name, id=exercise.id)
                    yield Known(title, lambda *given, part=part, k=k: _piece(part, given[:-1], k), needs)

    def _same(self, a: Array, b: Array) -> bool:
        if np.shape(a) != np.shape(b):
            return False
        scale = np.abs(b).max(initial=FLOOR)
        return bool((np.abs(a - b) <= self.part.rtol * scale).all())


def _piece(part: Part, arguments: tuple[Any, ...], k: int) -> Any:
    return (values(part.solution(*arguments), part.returns) or [])[k].array


def _array(function: Callable[..., Any], arguments: tuple[Any, ...]) -> Array | None:
    """Return a quantity as an array; None where it cannot be computed, or is not an array of finite numbers."""
    try:
        with np.errstate(all="ignore"):
            x = np.asarray(function(*copied(arguments)))
    except Exception:  # arguments of the same names, and of another kind
        return None
    return x if _telling(x) else None


def _written(index: Index) -> str:
    """Write the place of a block as it is written in Python."""
    parts = (f"{part.start or ''}:{'' if part.stop is None else part.stop}" for part in index if part is not ...)
    return f"[{', '.join(parts)}]"


def _telling(x: Any) -> bool:
    return x is not None and x.dtype.kind == "f" and x.size <= LARGEST and bool(np.isfinite(x).all())


def _ours(x: Any) -> Any:
    """Return a model of Pinocchio as one of this package, anything else as it is."""
    foreign = type(x).__name__ == "Model" and not isinstance(x, tw.Model)
    return tw.bridge.from_pinocchio_model(x) if foreign else x
