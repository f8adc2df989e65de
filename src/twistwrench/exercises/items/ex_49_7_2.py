"""Exercise 49.7.2: ABA against CRBA and a solver, by the clock."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import JOINT_SPACE
from ..robots import robot, small_robot
from ..stopwatch import Machine, Task
from ..text import Text
from ..wrong import swap, swapped

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


# ---------------------------------------------------------------- wrong ways to compute


def _solved(change: Any) -> Any:
    """Change M and τ − h before the system is solved."""

    def wrong(model: Any, q: Any, v: Any, tau: Any) -> Any:
        M, h, g = tw.crba(model, q), tw.nonlinear_effects(model, q, v), tw.gravity(model, q)
        M, force = change(M, tau, h, g)
        return tw.aba(model, q, v, tau), np.linalg.solve(M, force)

    return wrong


def _held(model: Any, q: Any, v: Any, tau: Any) -> Any:
    """Solve the joints' block alone."""
    force = (tau - tw.nonlinear_effects(model, q, v))[6:]
    held = np.concatenate([np.zeros(6), np.linalg.solve(tw.crba(model, q)[6:, 6:], force)])
    return tw.aba(model, q, v, tau), held


def _product(model: Any, q: Any, v: Any, tau: Any) -> Any:
    return tw.aba(model, q, v, tau), tw.crba(model, q) @ (tau - tw.nonlinear_effects(model, q, v))


# ---------------------------------------------------------------- wrong ways to measure


def _seconds(function: Any, calls: Any, clock: Any) -> Any:
    """Time each of many calls of one function."""
    times = []
    for _ in range(calls):
        start = clock()
        function()
        times.append(clock() - start)
    return times


def _in_blocks(of_times: Any) -> Any:
    """Measure one function after the other."""
    return lambda first, second, calls, clock: np.divide(
        *[of_times(_seconds(function, calls, clock)) for function in (first, second)][::-1]
    )


def _mean_in_turn(first: Any, second: Any, calls: Any, clock: Any) -> Any:
    times = [(_seconds(first, 1, clock)[0], _seconds(second, 1, clock)[0]) for _ in range(calls)]
    return np.mean([b for _, b in times]) / np.mean([a for a, _ in times])


def _timed(function: Any, first: Any, second: Any, calls: Any, clock: Any) -> Any:
    """Let a machine begin anew, and give nan for a measurement that has not looked at its clock."""
    clock.reset()
    answer = function(first, second, calls, clock)
    return answer if answer is ... or clock.readings else np.nan


def _verdict(answer: Any, right: float) -> float:
    """Return 0 for about the right ratio, and other numbers for its inverse, too large, too small and no clock."""
    ratio = float(answer)
    if np.isnan(ratio):
        return 4.0
    if abs(ratio / right - 1) < 0.15:
        return 0.0
    return 1.0 if abs(ratio * right - 1) < 0.15 else 2.0 if ratio > right else 3.0


def _machines(rng: Any) -> Any:
    """Return two tasks on machines with different faults."""
    calls = 100
    machines = [
        Machine(Text("steady", "稳定")),
        Machine(Text("slow at the first call", "首次调用较慢"), start=0.01),
        Machine(Text("slows down half-way", "中途变慢"), slow_from=calls),
        Machine(Text("interrupted once", "被打断一次"), pause=3.0, paused_at=2 * int(rng.integers(10, 40)) + 1),
    ]
    short = rng.uniform(0.001, 0.002, 4)
    long = short * rng.uniform(2.5, 4, 4)
    return [(Task(m, a), Task(m, b), calls, m) for m, a, b in zip(machines, short, long)]


def _plausible(answer: Any) -> Any:
    """Return 1 for a ratio within an order of magnitude of any that we saw, 0 for what must be seconds."""
    ratio = float(answer)
    return 1.0 if 0.2 <= ratio <= 10 else 0.0 if 0 <= ratio < 0.2 else ratio


TWO_WAYS = Part(
    solution=forward_dynamics_two_ways,
    doc=Text(
        """Return the acceleration under given forces: by ABA, and with the mass matrix.

        model: a robot with a floating base. q: array (nq,). v, tau: arrays (nv,).
        `tw.aba(model, q, v, tau)`, `tw.crba(model, q)`, `tw.nonlinear_effects(model, q, v)` is h.
        Returns: two arrays (nv,), the base's rates of ω and v, then the joints'.""",
        """返回给定力作用下的加速度：用 ABA，以及用质量矩阵求解。

        model：浮动基座机器人。q：数组 (nq,)。v、tau：数组 (nv,)。
        `tw.aba(model, q, v, tau)`、`tw.crba(model, q)`；`tw.nonlinear_effects(model, q, v)` 就是 h。
        返回：两个数组 (nv,)，先是基座 ω、v 的变化率，然后是各关节的。""",
    ),
    returns=(Quantity("q̈ by ABA", JOINT_SPACE), Quantity("q̈ by CRBA", JOINT_SPACE)),
    rtol=1e-7,
    cases=lambda rng: [
        (model, model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv)))
        for model in (robot("go2"), small_robot(rng))
    ],
    slips={
        "bias-for-zero": _solved(lambda M, tau, h, g: (M, tau)),
        "bias-sign": _solved(lambda M, tau, h, g: (M, tau + h)),
        "velocity-terms-missing": _solved(lambda M, tau, h, g: (M, tau - g)),
        "gravity-missing": _solved(lambda M, tau, h, g: (M, tau - h + g)),
        "gravity-twice": _solved(lambda M, tau, h, g: (M, tau - h - g)),
        "one-triangle": _solved(lambda M, tau, h, g: (np.triu(M), tau - h)),
        "doubled-off-diagonal": _solved(lambda M, tau, h, g: (2 * M - np.diag(M.diagonal()), tau - h)),
        "orders-mixed": _solved(lambda M, tau, h, g: (swap(M), tau - h)),
        "inverse-missing": _product,
        "base-held": _held,
        "swapped-halves": swapped(forward_dynamics_two_ways),
    },
    properties=(
        Property(
            Text("RNEA undoes it: it gives τ back", "逆动力学是其逆：RNEA 应还原 τ"),
            lambda answer, model, q, v, tau: tw.rnea(model, q, v, answer[1]) - tau,
        ),
    ),
)

RATIO = Part(
    solution=time_ratio,
    doc=Text(
        """Measure how many times as long the second function takes as the first.

        first, second: functions without arguments. calls: how often to call each, 100 or so.
        clock: function without arguments that returns the time in s, as `time.perf_counter` does.
        Read this clock and no other: the check hands in clocks of machines that start slowly, slow
        down or are interrupted, and your ratio must come out right on each of them.
        Returns: number, time of the second over time of the first.""",
        """测量第二个函数的耗时是第一个的多少倍。

        first、second：不带参数的函数。calls：各调用多少次，例如 100。
        clock：不带参数、返回当前时间（s）的函数，如 `time.perf_counter`。
        只能用这个时钟：检验时会传入几台机器的时钟，它们起步慢、中途变慢或被打断，
        你的比值在每台机器上都应正确。
        返回：数，第二个的时间除以第一个的时间。""",
    ),
    returns=(Quantity("ratio"),),
    cases=_machines,
    call=_timed,
    canonical=lambda answer, first, second, calls, clock: _verdict(answer, second.seconds / first.seconds),
    slips={
        "ratio-inverted": lambda first, second, calls, clock: 1 / time_ratio(first, second, calls, clock),
        "single-call": lambda first, second, calls, clock: time_ratio(first, second, 1, clock),
        "blocks-in-turn": _in_blocks(np.median),
        "mean-of-times": _mean_in_turn,
        "mean-of-blocks": _in_blocks(np.mean),
        "time-for-ratio": lambda first, second, calls, clock: np.median(_seconds(second, calls, clock)),
        "other-clock": lambda first, second, calls, clock: 1.0,
    },
)

MEASURED = Part(
    solution=measured_ratio,
    doc=Text(
        """Return what you have measured for Go2: the time of CRBA, h and solve over that of ABA.

        Measure with `time_ratio` and `time.perf_counter`, with twistwrench or Pinocchio, and write
        the number down here. Machines and libraries differ: any plausible number will do.
        Returns: number.""",
        """返回你对 Go2 测得的比值：CRBA、h 加求解的时间除以 ABA 的时间。

        用 `time_ratio` 和 `time.perf_counter` 测量 twistwrench 或 Pinocchio，把数写在这里。
        机器和库各不相同：数量级合理即可。
        返回：数。""",
    ),
    returns=(Quantity("ratio"),),
    cases=lambda rng: [()],
    canonical=_plausible,
    slips={"order-for-time": lambda: 18.0, "time-for-ratio": lambda: 0.0018},
)

EXERCISE = Exercise(
    id="49.7.2",
    kind="explain",
    title=Text("ABA against CRBA and a solver", "ABA 与“先 CRBA 再求解”"),
    text=Text(
        """Forward dynamics can be had in O(N) by ABA, or by building M with CRBA and h with RNEA and solving
        M q̈ = τ − h, which is O(N³). Compare how long they take for Go2 with its 18 degrees of freedom, 100 calls each,
        and draw the times as bars if you like. How large is the difference?

        A time is easily measured wrong. So write the measurement as a function first. It is checked on machines
        whose clocks we know; your own machine's speed is not.""",
        """正向动力学可以用 ABA 在 O(N) 内得到，也可以用 CRBA 构造 M、用 RNEA 求 h，再解 M q̈ = τ − h，复杂度 O(N³)。
        对 18 自由度的 Go2 比较两者的耗时，各调用 100 次，可以画成柱状图。差异有多大？

        时间很容易测错。所以先把测量写成函数，用时钟已知的机器来检验它；不检验你自己机器的快慢。""",
    ),
    parts=(TWO_WAYS, RATIO, MEASURED),
    hints=(
        Text(
            "Whatever else a machine does only adds time. Which number out of 100 times is not moved by one that is "
            "far too long?",
            "机器的其他活动只会使时间变长。100 个时间中，哪个统计量不受一个过长值的影响？",
        ),
        Text(
            "Call the two in turn, reading the clock before and after each. A machine that slows down then slows both.",
            "轮流调用两者，每次前后都读时钟。这样机器变慢时两者一起变慢。",
        ),
        Text(
            "M q̈ + h = τ. `np.linalg.solve(M, tau - h)`, with all of M: it reads both triangles.",
            "M q̈ + h = τ。用 `np.linalg.solve(M, tau - h)`，要用完整的 M：它读取两个三角。",
        ),
    ),
    answer=Text(
        """Hardly any, at 18 degrees of freedom. Where this was written the way by CRBA took 1.1 times as long as ABA
        with twistwrench, 1.3 times with Pinocchio and its Cholesky, and 2.3 times with Pinocchio and
        `np.linalg.solve`, most of which is the price of calling NumPy. O(N³) against O(N) says how these times grow,
        not how long they are. The N³ has a small factor: solving for 18 unknowns is quick, and Go2's short legs leave
        M mostly zeros between them. ABA does more for each joint: it moves 6 × 6 inertias.

        With more joints the orders do show: for a chain of 100, Pinocchio's ABA was 5.6 times as fast. And speed is
        not all: on a long chain with heavy tips ABA keeps more digits than solving with M.""",
        """18 自由度时几乎没有差异。在写作本文的机器上，经由 CRBA 的做法与 ABA 的耗时之比：twistwrench 为 1.1，
        Pinocchio 配其 Cholesky 分解为 1.3，Pinocchio 配 `np.linalg.solve` 为 2.3（多出的大部分是调用 NumPy 的开销）。
        O(N³) 与 O(N) 说明的是时间怎样增长，而不是有多长。N³ 前的系数很小：解 18 个未知数很快，而 Go2 的腿短，
        M 中各腿之间都是零。ABA 对每个关节要做更多工作：变换 6 × 6 的惯量。

        关节更多时阶数才显现出来：100 个关节的链上，Pinocchio 的 ABA 快 5.6 倍。速度也不是全部：
        对末端很重的长链，ABA 比用 M 求解保留更多有效数字。""",
    ),
)
