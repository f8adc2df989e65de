"""An edit of a function, and those that leave its text alone: another argument goes in, or another result comes out."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...arrays import Array
from ...bridge.spatial import from_pinocchio_motion
from .containers import exchanges

__all__ = ["Edit", "of_arguments", "of_order"]

Function = Callable[..., Any]

ARGUMENTS: dict[str, Function] = {
    "-{}": lambda x: -x,
    "0 * {}": lambda x: [0 * y for y in x] if isinstance(x, list) else 0 * x,
    "{}.T": lambda x: x.mT,
    "np.eye(len({}))": lambda x: np.eye(len(x)) if x.shape == (len(x), len(x)) else None,
    "np.linalg.inv({})": np.linalg.inv,
    "{}[::-1]": lambda x: x[::-1],
    "np.abs({})": np.abs,
    "np.roll({}, len({}) // 2, 0)": lambda x: np.roll(x, len(x) // 2, 0),
    "np.triu({})": np.triu,
    "np.triu({}) + np.triu({}).T": lambda x: np.triu(x) + np.triu(x).mT,
    "np.r_[{}[4:7], {}[:4], {}[7:]]": lambda x: np.r_[x[4:7], x[:4], x[7:]] if _has_quaternion(x) else None,
    "{} + {}.T": lambda x: x + x.mT,
    "{}.T.reshape({}.shape)": lambda x: x.mT.reshape(x.shape),
}
"""What can be done to an argument on the way in."""

RESULTS = {
    key: change
    for key, change in ARGUMENTS.items()
    if key not in ("0 * {}", "np.eye(len({}))", "{}.T.reshape({}.shape)")
} | {
    "np.r_[{}[3:6], {}[:3], {}[6:]]": lambda x: np.r_[from_pinocchio_motion(x[:6]), x[6:]] if x.ndim == 1 else None,
    "np.roll({}, len({}.T) // 2, 1)": lambda x: np.roll(x, len(x.mT) // 2, 1),
    "{}[:3]": lambda x: x[:3],
    "{}[3:]": lambda x: x[3:],
    "{}[6:]": lambda x: x[6:],
    "{}[0]": lambda x: x[0],
    "{}.sum(0)": lambda x: x.sum(0),
    "{}.ravel()": lambda x: x.ravel(),
    "np.concatenate({})": np.concatenate,
}
"""What can be done to a result."""


def _has_quaternion(x: Array) -> bool:
    """Whether a vector begins with a unit quaternion, or with a point and one."""
    return x.ndim == 1 and any(abs(np.linalg.norm(part) - 1) < 1e-6 for part in (x[:4], x[3:7]))


@dataclass(frozen=True)
class Edit:
    """A right function with one small change.

    Attributes
    ----------
    kind : str
        One of `KINDS`.
    right, wrong : str
        What stands in the right function, and what in this one; of what is left out or has the other sign, the term.
    within : callable
        The function whose text is changed, the reference or a listing that it calls.
    function : callable
        With the arguments of the reference.
    everywhere : int
        In how many places it is made at once; 0 for one by itself.
    statement : str
        The one in which it is made, where that gives something a name.
    first : tuple of str, optional
        Kind, right, wrong and line of another edit that is made as well.
    line : int
        Of the text in which it is made; 0 for an argument or a result.
    places : tuple
        Where it is made in the syntax tree; empty for an argument or a result.
    around : tuple of str
        What stands around it in each of two places, where there are more.
    became : tuple of str
        What stands around it after it.
    """

    kind: str
    right: str
    wrong: str
    within: Function
    function: Function
    everywhere: int = 0
    statement: str = ""
    first: tuple[str, str, str, int] | None = None
    line: int = 0
    places: tuple[Any, ...] = ()
    around: tuple[str, ...] = ()
    became: tuple[str, ...] = ()

    @property
    def inside(self) -> Any:
        """The node of the syntax tree in which it is made; None for an argument or a result."""
        return self.places[0][0][-1] if self.places else None

    @property
    def by_one(self) -> bool:
        """Whether it puts a whole number in place of the next one or of the one before."""
        first, second = (getattr(x, "value", None) for x in self.places[0][2:]) if self.places else (None, None)
        return type(first) is int and type(second) is int and abs(first - second) == 1


def of_arguments(solution: Function) -> Iterator[Edit]:
    """Yield the function with a change to one of its arguments, or to its result."""
    names = [*inspect.signature(solution).parameters]
    for k, name in enumerate(names):
        for wrong, change in ARGUMENTS.items():

            def function(*given: Any, k: int = k, change: Function = change) -> Any:
                return solution(*(change(x) if j == k else x for j, x in enumerate(given)))

            yield Edit("argument", name, wrong.replace("{}", name), solution, function, 1)
    for wrong, change in RESULTS.items():

        def result(*given: Any, change: Function = change) -> Any:
            answer = solution(*given)
            if isinstance(answer, tuple):
                return tuple(map(change, answer))
            return change(answer if isinstance(answer, list) and change is np.concatenate else np.asarray(answer))

        yield Edit("result", "x", wrong.replace("{}", "x"), solution, result)


def of_order(solution: Function) -> Iterator[Edit]:
    """Yield the function with two of its arguments exchanged."""
    names = [*inspect.signature(solution).parameters]
    for order in exchanges([*range(len(names))]):

        def exchanged(*given: Any, order: list[int] = order) -> Any:
            return solution(*(given[k] for k in order))

        right, wrong = ", ".join(names), ", ".join(names[k] for k in order)
        yield Edit("argument", right, wrong, solution, exchanged, 1)
