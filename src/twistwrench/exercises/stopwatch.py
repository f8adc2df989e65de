"""A machine whose clock is known beforehand: to check how the student measures, without measuring."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

import numpy as np

from misstep.text import Text

__all__ = ["UP", "Machine", "Task", "draw_interruptions", "measure", "seconds"]


UP = 2.0**16
"""Seconds since which a machine runs: its clock does not begin at zero, as no real one does."""


GOLDEN = (5**0.5 - 1) / 2
"""Its multiples, without their whole parts, are spread evenly."""


class Machine:
    """A clock on a machine that has one of the faults of real ones, the same each time.

    Calling it reads the clock, like ``time.perf_counter``. Its faults begin with the first reading: what is called
    before, to warm up, counts for no more than that.

    Parameters
    ----------
    name : Text
        Its fault.
    start : float
        What the first call of each task takes on top, s.
    pause : float
        For how long the machine does something else in the middle of some calls, s.
    paused_at : collection of int
        At which calls, counted from 0 over all tasks, from the first reading on.
    slow_from : int, optional
        From which call on everything takes three times as long.
    drift : float
        By which part of the first call's time each call takes longer than the one before.
    wobble : float
        By which part of their time calls differ at most.

    Examples
    --------
    >>> machine = Machine(Text("steady", "稳定"))
    >>> work = Task(machine, 0.002)
    >>> before = machine()
    >>> work()
    >>> round(machine() - before, 6)
    0.002
    """

    def __init__(
        self,
        name: Text,
        *,
        start: float = 0,
        pause: float = 0,
        paused_at: Collection[int] = (),
        slow_from: int | None = None,
        drift: float = 0,
        wobble: float = 0,
    ) -> None:
        self.name, self._drift, self._wobble = name, drift, wobble
        self._start, self._pause, self._paused_at, self._slow_from = start, pause, paused_at, slow_from
        self.reset()

    def reset(self) -> None:
        """Start again."""
        self._now, self.readings, self.calls, self._before = UP, 0, 0, 0
        self._met: set[Task] = set()

    def __call__(self) -> float:
        """Read the clock."""
        self._before = self._before if self.readings else self.calls
        self.readings += 1
        return self._now

    def work(self, task: Task) -> None:
        """Let the time of a task pass."""
        k = self.calls - self._before if self.readings else 0
        late = self._slow_from is not None and k >= self._slow_from
        longer = self._drift * k + self._wobble * (k * GOLDEN % 1)
        self._now += (3 if late else 1) * (1 + longer) * task.seconds
        self._now += 0 if task in self._met else self._start
        self._now += self._pause if self.readings and k in self._paused_at else 0
        self._met.add(task)
        self.calls += 1


class Task:
    """Something that takes a known time on a machine.

    Parameters
    ----------
    machine : Machine
    seconds : float
    """

    def __init__(self, machine: Machine, seconds: float) -> None:
        self._machine, self.seconds = machine, seconds
        self.name = f"{1000 * seconds:.3g} ms"

    def __call__(self) -> None:
        """Do it."""
        self._machine.work(self)


def draw_interruptions(rng: np.random.Generator, calls: int) -> set[int]:
    """Return the calls at which a machine is interrupted that is so at one of five, warmed up or not.

    Examples
    --------
    >>> sorted(draw_interruptions(np.random.default_rng(1), 10))
    [2, 7, 13]
    """
    return {5 * k + int(rng.integers(5)) for k in range(calls // 5 + 1)}


def measure(function: Callable[..., Any], *arguments: Any) -> Any:
    """Reset the machine, the last argument, and return nan for a measurement that has not read its clock.

    One that has called the tasks less often than was asked for, the last argument but one, is minus infinity, which no
    quotient of times is.
    """
    clock = arguments[-1]
    clock.reset()
    answer = function(*arguments)
    if not isinstance(answer, int | float | np.number):
        return answer
    enough = clock.calls >= len(arguments[:-2]) * arguments[-2]
    return np.nan if not clock.readings else answer if enough else -np.inf


def seconds(task: Callable[[], object], calls: int, clock: Machine) -> list[float]:
    """Time each of many calls."""
    times = []
    for _ in range(calls):
        start = clock()
        task()
        times.append(clock() - start)
    return times
