"""Timing two ways of doing the same in turns, on a machine that may have other things to do."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

UNDISTURBED = 0.93
"""Part of the time on the wall that must have been time on the processor, else a round does not count."""


class Race(NamedTuple):
    """Seconds for one state, ours and theirs, round by round; and how many rounds had to be thrown away."""

    ours: np.ndarray
    theirs: np.ndarray
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
    ours: tuple[Callable[[], object], int],
    theirs: tuple[Callable[[], object], int] | None,
    *,
    rounds: int = 9,
    least: float = 0.02,
    one_thread: bool = True,
) -> Race:
    """Time two calls in turns, or one alone. Each comes with the number of states that it does.

    Each round calls either for at least `least` seconds. A round in which this process had to wait for the
    processor is thrown away and done again, up to four times as many in all; then it is counted all the same.
    """
    racers = [ours] if theirs is None else [ours, theirs]
    for call, _ in racers:
        call()  # what is made once is made now
    repeats = [_repeats(call, least) for call, _ in racers]
    kept, spare, disturbed = [], [], 0
    while len(kept) < rounds and len(kept) + len(spare) < 4 * rounds:
        times, quiet = [], True
        for (call, states), repeat in zip(racers, repeats, strict=True):
            wall, busy = time.perf_counter(), time.thread_time()
            for _ in range(repeat):
                call()
            wall, busy = time.perf_counter() - wall, time.thread_time() - busy
            times.append(wall / repeat / states)
            quiet &= not one_thread or busy > UNDISTURBED * wall
        (kept if quiet else spare).append(times)
        disturbed += not quiet
    times = np.array((kept + spare)[:rounds])
    return Race(times[:, 0], times[:, 1] if theirs else np.full(len(times), np.nan), disturbed)


def _repeats(call: Callable[[], object], least: float) -> int:
    start = time.perf_counter()
    call()
    return max(1, round(least / (time.perf_counter() - start)))
