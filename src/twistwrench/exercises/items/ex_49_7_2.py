"""Exercise 49.7.2: ABA against CRBA and a solver, by the clock."""

from typing import Any

import numpy as np

import twistwrench as tw
from misstep.exercise import Exercise, Output, Part
from misstep.text import Text

from ..layouts import JOINT_SPACE
from ..robots import held_acceleration, states
from ..stopwatch import Machine, Task, measure, seconds
from ..wrong import faulty, swapped

__all__ = ["EXERCISE", "forward_dynamics_two_ways", "measured_ratio", "time_ratio"]


def forward_dynamics_two_ways(model: Any, q: Any, v: Any, tau: Any) -> Any:
    """Acceleration by ABA, and with the mass matrix."""
    h = tw.nonlinear_effects(model, q, v)
    return tw.aba(model, q, v, tau), np.linalg.solve(tw.crba(model, q), tau - h)


def time_ratio(first: Any, second: Any, calls: Any, clock: Any) -> Any:
    """Time of the second over that of the first, call by call in turn."""
    times = np.empty((calls, 2))
    for k in range(calls):
        start = clock()
        first()
        between = clock()
        second()
        times[k] = between - start, clock() - between
    of_first, of_second = np.median(times, axis=0)
    return of_second / of_first


def measured_ratio() -> Any:
    """Measured with twistwrench, on one machine."""
    return 1.1


# ---------------------------------------------------------------- wrong ways to solve, and to measure


def _lower_last(M: Any) -> Any:
    """Return what is inverted where M = L Lᵀ is taken for LᵀL."""
    L = np.linalg.cholesky(M)
    return L.mT @ L


def _lower_twice(M: Any) -> Any:
    """Return what is inverted where both systems are solved with L."""
    L = np.linalg.cholesky(M)
    return L @ L


def _unreduced(model: Any, q: Any, v: Any, tau: Any) -> Any:
    """Eliminate the joints from the base's rows of M alone, not from their right side."""
    M, r = tw.crba(model, q), tau - tw.nonlinear_effects(model, q, v)
    r[:6] += M[:6, 6:] @ np.linalg.solve(M[6:, 6:], r[6:])
    return tw.aba(model, q, v, tau), np.linalg.solve(M, r)


def _in_blocks(of_times: Any) -> Any:
    """Measure one function after the other."""
    return lambda first, second, calls, clock: np.divide(
        *[of_times(seconds(function, calls, clock)) for function in (first, second)][::-1]
    )


def _mean_in_turn(first: Any, second: Any, calls: Any, clock: Any) -> Any:
    times = [(seconds(first, 1, clock)[0], seconds(second, 1, clock)[0]) for _ in range(calls)]
    return np.mean([b for _, b in times]) / np.mean([a for a, _ in times])


def _verdict(answer: Any, right: float) -> float:
    """Return 0 for about the right ratio, and other numbers for others that are far from it and from each other."""
    ratio = float(answer) / right
    if not np.isfinite(ratio) or ratio <= 0:
        return ratio if np.isinf(ratio) else -1e3 if ratio <= 0 else 2e3
    if abs(float(answer) - right - 1) < 0.05 * right:
        return 0.5  # the time of both over that of the first
    return 0.0 if abs(ratio - 1) < 0.15 else float(np.sign(ratio - 1) + round(np.log10(ratio)))


def _machines(rng: Any) -> Any:
    """Return two tasks on machines with different faults."""
    calls = 100
    machines = [
        Machine(Text("steady", "稳定")),
        Machine(Text("slow at the first call", "首次调用较慢"), start=0.01),
        *(Machine(Text("slows down for good", "中途变慢，不再恢复"), slow_from=k) for k in (60, 90)),
        Machine(Text("slower with each call", "越来越慢"), drift=0.01),
        Machine(Text("interrupted once", "被打断一次"), pause=3.0, paused_at=[2 * int(rng.integers(10, 40)) + 1]),
        Machine(
            Text("interrupted at one call in fifty", "每五十次调用被打断一次"),
            pause=3.0,
            paused_at={2 * int(k) + 1 for k in rng.choice(np.arange(60, 95), 4, replace=False)},
        ),
    ]
    short = rng.uniform(0.001, 0.002, len(machines))
    long = short * rng.uniform(2.5, 4, len(machines))
    return [(Task(m, a), Task(m, b), calls, m) for m, a, b in zip(machines, short, long)]


def _at_both_ends(rng: Any) -> Any:
    """Return two tasks on a machine that is interrupted at the first and the last call of the second of them."""
    name = Text(
        "interrupted at one call in fifty, the first and the last among them", "每五十次调用被打断一次，首末两次在内"
    )
    machine = Machine(name, pause=3.0, paused_at=(1, 67, 133, 199))
    return [(Task(machine, 0.0015), Task(machine, float(rng.uniform(0.003, 0.006))), 100, machine)]


def _plausible(answer: Any) -> Any:
    """Return 1 for a ratio as a machine may have it, ½ for what may be the inverse, 0 for seconds in its place.

    What is too large for a ratio is 100, but 18 and 324, which are N and N².
    """
    if isinstance(answer, str):
        raise TypeError("a number is expected, not a text")
    ratio = float(answer)
    if 10 < ratio < np.inf and ratio not in (18, 324):
        return 100.0
    return 1.0 if 0.8 <= ratio <= 10 else 0.5 if 0.2 <= ratio < 0.8 else 0.0 if 0 <= ratio < 0.2 else ratio


TWO_WAYS = Part(
    solution=forward_dynamics_two_ways,
    returns=(
        Output("q̈ by ABA", JOINT_SPACE, zh="用 ABA 求得的 q̈"),
        Output("q̈ by CRBA", JOINT_SPACE, zh="用 CRBA 求得的 q̈"),
    ),
    rtol=1e-7,
    cases=lambda rng: [*states(rng, vectors=2, small=1)],
    slips={
        "bias-for-zero": faulty(forward_dynamics_two_ways, ("tau - h", "tau")),
        "bias-sign": faulty(forward_dynamics_two_ways, ("tau - h", "tau + h")),
        "velocity-terms-missing": faulty(forward_dynamics_two_ways, ("tau - h", "tau - tw.gravity(model, q)")),
        "gravity-missing": faulty(forward_dynamics_two_ways, ("tau - h", "tau - h + tw.gravity(model, q)")),
        "gravity-twice": faulty(forward_dynamics_two_ways, ("tau - h", "tau - h - tw.gravity(model, q)")),
        "one-triangle": faulty(forward_dynamics_two_ways, ("tw.crba(model, q)", "np.triu(tw.crba(model, q))")),
        "doubled-off-diagonal": faulty(forward_dynamics_two_ways, ("tw.crba(model, q)", "doubled(tw.crba(model, q))")),
        "orders-mixed": faulty(forward_dynamics_two_ways, ("tw.crba(model, q)", "swap(tw.crba(model, q))")),
        "bias-after": faulty(forward_dynamics_two_ways, ("tau - h)", "tau) - h")),
        "cholesky-reversed": faulty(forward_dynamics_two_ways, ("tw.crba(model, q)", "_lower_last(tw.crba(model, q))")),
        "cholesky-untransposed": faulty(
            forward_dynamics_two_ways, ("tw.crba(model, q)", "_lower_twice(tw.crba(model, q))")
        ),
        "right-side-unreduced": _unreduced,
        "base-forces-zero": faulty(forward_dynamics_two_ways, ("tau - h", "np.r_[np.zeros(6), tau[6:]] - h")),
        "inverse-missing": faulty(
            forward_dynamics_two_ways, ("np.linalg.solve(tw.crba(model, q), tau - h)", "tw.crba(model, q) @ (tau - h)")
        ),
        "base-held": lambda *state: (tw.aba(*state), held_acceleration(*state)),
        "swapped-halves": swapped(forward_dynamics_two_ways),
    },
    residuals=(lambda answer, model, q, v, tau: [tw.rnea(model, q, v, a) - tau for a in answer],),
)

RATIO = Part(
    solution=time_ratio,
    returns=(Output("ratio", zh="比值"),),
    cases=_machines,
    edges=_at_both_ends,
    call=measure,
    canonical=lambda answer, first, second, calls, clock: _verdict(answer, second.seconds / first.seconds),
    slips={
        "ratio-inverted": lambda first, second, calls, clock: 1 / time_ratio(first, second, calls, clock),
        "single-call": lambda first, second, calls, clock: time_ratio(first, second, 1, clock),
        "blocks-in-turn": _in_blocks(np.median),
        "blocks-reversed": lambda first, second, *more: 1 / _in_blocks(np.median)(second, first, *more),
        "first-in-second": lambda *arguments: time_ratio(*arguments) + 1,
        "mean-of-times": _mean_in_turn,
        "mean-of-blocks": _in_blocks(np.mean),
        "time-for-ratio": lambda first, second, calls, clock: np.median(seconds(second, 2 * calls, clock)),
        "other-clock": lambda first, second, calls, clock: 1.0,
    },
)

MEASURED = Part(
    solution=measured_ratio,
    returns=(Output("ratio", zh="比值"),),
    cases=lambda rng: [()],
    canonical=_plausible,
    slips={
        "order-for-time": lambda: 18.0,
        "orders-divided": lambda: 324.0,
        "time-for-ratio": lambda: 0.0018,
        "ratio-inverted": lambda: 1 / 2.3,
        "ratio-too-large": lambda: 165.0,
    },
)

EXERCISE = Exercise(id="49.7.2", kind="explain", parts=(TWO_WAYS, RATIO, MEASURED))
