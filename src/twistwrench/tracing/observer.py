"""Watch a function of the textbook at work. Nothing is computed here: the values are those of its own variables."""

from __future__ import annotations

import linecache
import sys
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from types import FrameType
from typing import Any

__all__ = ["Observation", "Step", "observe"]


@dataclass(frozen=True)
class Step:
    """A line that gave a variable a value.

    Attributes
    ----------
    function : str
        In which function the line stands.
    line : int
        Its number in the file.
    source : str
        The line.
    body : int or None
        The body whose turn it was, ``i`` in the source.
    name : str
        The variable.
    index : int or None
        Which entry of it, where it is a list with an entry for each body.
    value : object
    """

    function: str
    line: int
    source: str
    body: int | None
    name: str
    index: int | None
    value: Any


@dataclass(frozen=True)
class Observation:
    """What was seen.

    Attributes
    ----------
    result : object
        What the function returned.
    steps : list of Step
        In the order in which they were done.
    variables : dict
        All variables of each watched function when it returned, by the function's name.
    """

    result: Any
    steps: list[Step]
    variables: dict[str, dict[str, Any]]

    def of(self, name: str, body: int) -> list[Any]:
        """Return the values that a body's own entry of a list was given, one after the other."""
        return [step.value for step in self.steps if step.name == name and step.index == body]

    def during(self, name: str, body: int) -> list[Any]:
        """Return the values that a variable was given when it was the body's turn."""
        return [step.value for step in self.steps if (step.name, step.body, step.index) == (name, body, None)]


def observe(watched: Collection[Callable[..., Any]], call: Callable[[], Any]) -> Observation:
    """Run `call`, and take down what the watched functions do to their variables in it.

    Parameters
    ----------
    watched : collection of callable
        Functions of Python.
    call : callable
        Calls them.

    Returns
    -------
    Observation

    Examples
    --------
    >>> def double(n):
    ...     x = [0] * n
    ...     for i in range(n):
    ...         x[i] = 2 * i
    ...     return x
    >>> seen = observe([double], lambda: double(3))
    >>> [(step.body, step.name, step.index, step.value) for step in seen.steps if step.index is not None]
    [(1, 'x', 1, 2), (2, 'x', 2, 4)]
    """
    names = {function.__code__: function.__name__ for function in watched}
    steps: list[Step] = []
    variables: dict[str, dict[str, Any]] = {}

    def follow(frame: FrameType) -> _Watch | None:
        return _Watch(names[frame.f_code], frame, steps, variables) if frame.f_code in names else None

    kept = sys.gettrace()
    sys.settrace(lambda frame, event, arg: follow(frame))
    try:
        result = call()
    finally:
        sys.settrace(kept)
    return Observation(result, steps, variables)


class _Watch:
    """Follows one call of a function: Python calls it before each line, and at the end."""

    def __init__(self, name: str, frame: FrameType, steps: list[Step], variables: dict[str, dict[str, Any]]) -> None:
        self._name, self._steps, self._variables = name, steps, variables
        self._before = _look(frame)

    def __call__(self, frame: FrameType, event: str, arg: Any) -> _Watch:
        now = _look(frame)
        self._steps.extend(_changes(self._name, frame.f_code.co_filename, self._before, now))
        self._before = now
        if event == "return":
            self._variables[self._name] = now.variables
        return self


@dataclass(frozen=True)
class _Look:
    """The variables before a line is run; lists are copied, since the function goes on changing them."""

    line: int
    variables: dict[str, Any]


def _look(frame: FrameType) -> _Look:
    copied = {name: [*x] if isinstance(x, list) else x for name, x in frame.f_locals.items()}
    return _Look(frame.f_lineno, copied)


def _changes(function: str, file: str, before: _Look, now: _Look) -> Iterator[Step]:
    """Yield a step for every variable, and every entry of a list, that is another object than before."""
    source, body = linecache.getline(file, before.line).strip(), before.variables.get("i")
    for name, value in now.variables.items():
        old = before.variables.get(name)
        if isinstance(value, list) and isinstance(old, list):
            for k, (was, entry) in enumerate(zip(old, value)):
                if entry is not was:
                    yield Step(function, before.line, source, body, name, k, entry)
        elif value is not old and not isinstance(value, list):
            yield Step(function, before.line, source, body, name, None, value)
