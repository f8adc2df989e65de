"""The project, stage 4, continued: the time of one call, and how it is measured wrong."""

from typing import Any

import numpy as np

from misstep.exercise import Output, Part
from misstep.text import Text

from ..stopwatch import Machine, Task, draw_interruptions, measure, seconds

__all__ = ["TIME", "time_per_call"]


def time_per_call(task: Any, calls: Any, clock: Any) -> Any:
    """Median time of a call, the first one left out."""
    task()
    seconds = []
    for _ in range(calls):
        start = clock()
        task()
        seconds.append(clock() - start)
    return np.median(seconds)


def _machines(rng: Any) -> Any:
    """Return a task on machines with different faults."""
    calls = 100
    machines = [
        Machine(Text("steady", "稳定")),
        Machine(Text("slow at the first call", "首次调用较慢"), start=0.1),
        Machine(Text("interrupted once", "被打断一次"), pause=3.0, paused_at=[int(rng.integers(20, 80))]),
        Machine(Text("interrupted at the end", "末尾被打断"), pause=0.01, paused_at=range(calls - 1, calls + 10)),
        *(
            Machine(Text("interrupted often", "常被打断"), pause=0.01, paused_at=draw_interruptions(rng, 20 * calls))
            for _ in range(3)
        ),
    ]
    return [(Task(machine, float(rng.uniform(1e-5, 1e-3))), calls, machine) for machine in machines]


def _unsteady(rng: Any) -> Any:
    """Return a task of which each call takes up to 1 % longer, on a machine that is interrupted often, or never.

    The last machine is interrupted for less time than a call takes.
    """
    often_too = Text(
        "slow at first, each call up to 1 % longer, interrupted often", "首次较慢，各次相差不到 1 %，常被打断"
    )
    machines = [
        Machine(Text("each call up to 1 % longer", "每次调用长短相差不到 1 %"), wobble=0.01),
        Machine(often_too, start=0.1, pause=0.01, paused_at=draw_interruptions(rng, 2000), wobble=0.01),
    ]
    short = Text("often interrupted for a short time", "常被短暂打断")
    shortly = Machine(short, pause=6e-4, paused_at=draw_interruptions(rng, 2000))
    times = [(machine, float(rng.uniform(1e-5, 1e-3))) for machine in machines]
    return [(Task(machine, seconds), 100, machine) for machine, seconds in (*times, (shortly, 1e-3))]


def _block(task: Any, calls: Any, clock: Any) -> Any:
    """Time all calls at once."""
    start = clock()
    for _ in range(calls):
        task()
    return clock() - start


def _warmed(task: Any, calls: Any, clock: Any) -> Any:
    task()
    return np.mean(seconds(task, calls, clock))


def _trimmed(task: Any, calls: Any, clock: Any, first: int) -> Any:
    """Leave out a tenth of the times at the end, and from the first on."""
    task()
    return np.mean(sorted(seconds(task, calls, clock))[first : calls - calls // 10])


def _within_three_sigma(task: Any, calls: Any, clock: Any) -> Any:
    """Leave out what is far from the mean."""
    task()
    times = np.array(seconds(task, calls, clock))
    return times[abs(times - times.mean()) <= 3 * times.std()].mean()


def _near(answer: Any, task: Any) -> Any:
    """Return 1 for about the right time: the median and the shortest are both right."""
    ratio = float(answer) / task.seconds
    return 1.0 if abs(ratio - 1) < 0.02 else ratio


TIME = Part(
    solution=time_per_call,
    returns=(Output("time", unit="s", zh="时间"),),
    cases=_machines,
    edges=_unsteady,
    call=measure,
    canonical=lambda answer, task, calls, clock: _near(answer, task),
    slips={
        "single-call": lambda task, calls, clock: seconds(task, 1, clock)[0],
        "mean-of-times": lambda task, calls, clock: np.mean(seconds(task, calls, clock)),
        "mean-after-warm-up": _warmed,
        "slowest-tenth": lambda task, calls, clock: _trimmed(task, calls, clock, 0),
        "tenth-at-each-end": lambda task, calls, clock: _trimmed(task, calls, clock, calls // 10),
        "beyond-three-sigma": _within_three_sigma,
        "blocks-compared": lambda task, calls, clock: (
            min(_block(task, calls // 10, clock) for _ in range(10)) / (calls // 10)
        ),
        "mean-of-blocks": lambda task, calls, clock: _block(task, calls, clock) / calls,
        "not-per-call": _block,
        "thousand": lambda task, calls, clock: 1000 * time_per_call(task, calls, clock),
    },
    alike=(
        frozenset({"mean-of-times", "mean-of-blocks"}),
        frozenset({"beyond-three-sigma", "blocks-compared"}),  # what is interrupted often stays in
    ),
)
