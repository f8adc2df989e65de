"""Timing several functions in turns, on a machine that may be busy with other work."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from .arrays import Array

__all__ = ["Lap", "Race", "duration", "race", "round_robin"]

Call = Callable[[], object]

MIN_CPU_SHARE = 0.93
"""The least share of wall time that must have been processor time for a stretch to count."""

MAX_TRIES_PER_LAP = 4
"""At most this many times the wanted number of stretches are tried; then disturbed ones count all the same."""


class Race(NamedTuple):
    """Seconds for one state, ours and theirs, round by round; and how many rounds had to be thrown away."""

    ours: Array
    theirs: Array
    disturbed: int

    def row(self) -> dict[str, float]:
        """Return medians and quartiles, µs, and of the ratio."""
        ratio = self.ours / self.theirs
        row = {}
        for name, x in (("us", self.ours * 1e6), ("reference_us", self.theirs * 1e6), ("ratio", ratio)):
            row[name] = float(np.median(x))
            row[f"{name}_q1"], row[f"{name}_q3"] = (float(y) for y in np.quantile(x, [0.25, 0.75]))
        return row | {"rounds": len(ratio), "disturbed": self.disturbed}


def race(
    ours: tuple[Call, int],
    theirs: tuple[Call, int] | None,
    *,
    rounds: int = 9,
    least: float = 0.02,
    one_thread: bool = True,
) -> Race:
    """Time two calls in turns, or one alone. Each is given with its number of states.

    Each round calls either for at least `least` seconds. A round in which this process had to wait for the
    processor is thrown away and done again, up to four times as many in all; then it is counted all the same.
    """
    racers = [ours] if theirs is None else [ours, theirs]
    for call, _ in racers:
        call()  # warm up: what is made once is made now
    repeats = [_repeats(call, least) for call, _ in racers]
    kept: list[list[float]] = []
    spare: list[list[float]] = []
    while len(kept) < rounds and len(kept) + len(spare) < MAX_TRIES_PER_LAP * rounds:
        stretches = [_stretch(call, repeat) for (call, _), repeat in zip(racers, repeats, strict=True)]
        quiet = not one_thread or all(_undisturbed(*stretch) for stretch in stretches)
        (kept if quiet else spare).append([t / states for (t, _), (_, states) in zip(stretches, racers, strict=True)])
    times = np.array((kept + spare)[:rounds])
    return Race(times[:, 0], times[:, 1] if theirs else np.full(len(times), np.nan), len(spare))


@dataclass
class Lap:
    """The result of one of the calls of `round_robin`: seconds for a call, stretch by stretch."""

    call: Call
    repeat: int = 1
    kept: list[float] = field(default_factory=list)
    spare: list[float] = field(default_factory=list)
    spent: float = 0.0

    @property
    def seconds(self) -> Array:
        """The undisturbed stretches; without any, the processor time of the disturbed ones."""
        return np.array(self.kept or self.spare)

    def run(self) -> None:
        """Time one stretch."""
        wall, busy = _stretch(self.call, self.repeat)
        if _undisturbed(wall, busy):
            self.kept.append(wall)
        else:
            self.spare.append(busy)
        self.spent += wall * self.repeat

    def wants_more(self, rounds: int, most: float) -> bool:
        """Whether there are too few good stretches yet, and time to spend."""
        tried = len(self.kept) + len(self.spare)
        return len(self.kept) < rounds and tried < MAX_TRIES_PER_LAP * rounds and (self.spent < most or tried == 0)


def round_robin(
    calls: Sequence[Call],
    *,
    rounds: int = 5,
    least: float = 0.01,
    most: float = 1.0,
    after_round: Callable[[], object] = lambda: None,
) -> list[Lap]:
    """Time any number of calls in turns, so that a slow minute of the machine slows all of them.

    Parameters
    ----------
    calls : sequence of callable
    rounds : int
        Good stretches wanted of each call: of those in which this process did not wait for the processor.
    least : float
        A stretch repeats its call for about so long, s.
    most : float
        A call that has used so much time gets no more stretches, s.
    after_round : callable
        Called once for each of the wanted rounds, for a progress bar.

    Returns
    -------
    list of Lap

    Examples
    --------
    >>> fast, slow = round_robin([lambda: sum(range(10)), lambda: sum(range(10_000))], rounds=3, least=1e-3)
    >>> bool(np.median(fast.seconds) < np.median(slow.seconds))
    True
    """
    laps = [Lap(call, _repeats(call, least)) for call in calls]
    for turn in range(MAX_TRIES_PER_LAP * rounds):
        for lap in laps:
            if lap.wants_more(rounds, most):
                lap.run()
        if turn < rounds:
            after_round()
    return laps


def _stretch(call: Call, repeat: int) -> tuple[float, float]:
    """Return seconds per call: on the wall, and on the processor."""
    busy_time = getattr(time, "thread_time", time.process_time)  # a browser has only the second
    wall = time.perf_counter()
    busy = busy_time()
    for _ in range(repeat):
        call()
    wall = time.perf_counter() - wall
    busy = busy_time() - busy
    return wall / repeat, busy / repeat


def _undisturbed(wall: float, busy: float) -> bool:
    return busy > MIN_CPU_SHARE * wall


def _repeats(call: Call, least: float) -> int:
    """Return how many calls take about so long. The quickest of a few counts: the first may compile a program."""
    times: list[float] = []
    while len(times) < 2 or (len(times) < 10 and sum(times) < 20 * least):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return max(1, round(least / min(times)))


def duration(seconds: float) -> str:
    """Write a time in three digits.

    Examples
    --------
    >>> duration(1.234e-6), duration(0.05), duration(2.5)
    ('1.23 µs', '50 ms', '2.5 s')
    """
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"
