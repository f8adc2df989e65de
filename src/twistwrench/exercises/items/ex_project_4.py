"""The project, stage 4: does it all hold together, and how long does it take."""

from collections.abc import Callable
from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..robots import robot, small_robot
from ..text import Text
from ..wrong import times
from .project_timing import TIME

__all__ = ["EXERCISE", "consistency_error", "vertical_loads"]


def vertical_loads(p_G: Any, feet: Any, weight: Any) -> Any:
    """Vertical forces on the feet that hold a weight, those of least norm."""
    levers = np.array([np.ones(len(feet)), feet[:, 0] - p_G[0], feet[:, 1] - p_G[1]])
    return np.linalg.lstsq(levers, np.array([weight, 0, 0]))[0]


def consistency_error(forward: Any, inverse: Any, model: Any, q: Any, v: Any, tau: Any) -> Any:
    """Largest error of the forces that come back, relative to the largest force."""
    back = inverse(model, q, v, forward(model, q, v, tau))
    return np.abs(back - tau).max() / np.abs(tau).max()


# ---------------------------------------------------------------- loads


def _standings(rng: Any) -> Any:
    """Return centres of mass over three to five feet."""

    def stand(n: int) -> Any:
        angles = np.sort(rng.uniform(0, 2 * np.pi, n))
        feet = np.column_stack([0.3 * np.cos(angles), 0.2 * np.sin(angles), np.zeros(n)]) + rng.uniform(-1, 1, 3)
        p_G = rng.dirichlet(np.ones(n)) @ feet + [0, 0, 0.3]
        return p_G, feet, float(rng.uniform(100, 300))

    return [stand(n) for n in (4, 4, 3, 5)]


def _solved(levers: Any) -> Any:
    """Balance other moments, given by the rows of a matrix."""

    def wrong(p_G: Any, feet: Any, weight: Any) -> Any:
        rows = levers(p_G, feet)
        return np.linalg.lstsq(rows, np.eye(len(rows))[0] * weight)[0]

    return wrong


def _one_side(p_G: Any, feet: Any, k: int) -> Any:
    return np.array([np.ones(len(feet)), feet[:, k] - p_G[k]])


LOADS = Part(
    solution=vertical_loads,
    doc=Text(
        """Return the vertical force on each foot of a robot at rest on level ground. Of all that
        balance: least norm.

        p_G: array (3,), m, the centre of mass. feet: array (k, 3), m, the feet, all at one height.
        Both in the world.
        weight: number, N.
        Returns: array (k,), N, positive upward.""",
        """返回静止在水平地面上的机器人每只脚的竖直力；满足平衡的解中取范数最小者。

        p_G：数组 (3,)，单位 m，质心。feet：数组 (k, 3)，单位 m，各脚，高度相同。均在世界中表达。
        weight：数，N，重力的大小。
        返回：数组 (k,)，N，向上为正。""",
    ),
    returns=(Quantity("f_z", unit="N"),),
    cases=_standings,
    slips={
        "equal-shares": lambda p_G, feet, weight: np.full(len(feet), weight / len(feet)),
        "moment-about-origin": _solved(lambda p_G, feet: np.array([np.ones(len(feet)), feet[:, 0], feet[:, 1]])),
        "moment-of-one-axis": _solved(lambda p_G, feet: _one_side(p_G, feet, 0)),
        "force-sign": times(vertical_loads, -1),
        "mass-for-weight": times(vertical_loads, 1 / 9.81),
        "not-shared": lambda p_G, feet, weight: np.full(len(feet), weight),
    },
    properties=(
        Property(
            Text("the forces add up to the weight", "各力之和等于重力"),
            lambda answer, p_G, feet, weight: answer.sum() - weight,
        ),
        Property(
            Text("their mean place is below the centre of mass", "合力作用点在质心正下方"),
            lambda answer, p_G, feet, weight: (answer @ feet / weight - p_G)[:2],
        ),
    ),
)

# ---------------------------------------------------------------- consistency


class Variant:
    """Forward dynamics with something wrong in it."""

    def __init__(self, name: Text, function: Callable[..., Any]) -> None:
        self.name, self._function = name, function

    def __call__(self, *arguments: Any) -> Any:
        """Compute it."""
        return self._function(*arguments)


RIGHT = Variant(Text("right", "正确"), tw.aba)
INVERSE = Variant(Text("right", "正确"), tw.rnea)
FLOATING = Variant(
    Text("no gravity", "无重力"), lambda model, q, v, tau: tw.aba(model, q, v, tau + tw.gravity(model, q))
)
STILL = Variant(Text("no velocity terms", "无速度项"), lambda model, q, v, tau: tw.aba(model, q, 0 * v, tau))


def _held(model: Any, q: Any, v: Any, tau: Any) -> Any:
    """Hold the base."""
    force = (tau - tw.nonlinear_effects(model, q, v))[6:]
    return np.concatenate([np.zeros(6), np.linalg.solve(tw.crba(model, q)[6:, 6:], force)])


HELD = Variant(Text("base held", "基座固定"), _held)


def _states(rng: Any) -> Any:
    """Return states, with a forward dynamics that is right or has one of three faults."""
    cases = []
    for forward, model in zip(
        (RIGHT, FLOATING, STILL, HELD), (robot("go2"), robot("go2"), small_robot(rng), small_robot(rng))
    ):
        tau = np.concatenate([np.zeros(6), 10 * rng.standard_normal(model.nv - 6)])
        cases.append((forward, INVERSE, model, model.random_configuration(rng=rng), rng.standard_normal(model.nv), tau))
    return cases


def _compared(measure: Any) -> Any:
    """Measure the difference otherwise, given it and τ."""

    def wrong(forward: Any, inverse: Any, model: Any, q: Any, v: Any, tau: Any) -> Any:
        return measure(inverse(model, q, v, forward(model, q, v, tau)) - tau, tau)

    return wrong


CONSISTENCY = Part(
    solution=consistency_error,
    doc=Text(
        """Return how far inverse dynamics is from undoing forward dynamics: the largest entry, by size,
        of what comes back less τ, divided by the largest entry of τ.

        forward: called as `tw.aba(model, q, v, tau)`. inverse: called as `tw.rnea(model, q, v, a)`.
        One may be faulty.
        model: with a floating base. q: array (nq,). v, tau: arrays (nv,); the base's entries of tau
        are zero.
        Returns: a number ≥ 0.""",
        """返回逆动力学还原正向动力学的误差：还原出的力减 τ 的最大分量（取绝对值），除以 τ 的最大分量。

        forward：按 `tw.aba(model, q, v, tau)` 调用。inverse：按 `tw.rnea(model, q, v, a)` 调用。其中
        之一可能有错。
        model：浮动基座模型。q：数组 (nq,)。v、tau：数组 (nv,)，tau 的基座分量为零。
        返回：一个数 ≥ 0。""",
    ),
    returns=(Quantity("error"),),
    cases=_states,
    rtol=1e-7,
    slips={
        "error-signed": _compared(lambda d, tau: d.max() / np.abs(tau).max()),
        "error-absolute": _compared(lambda d, tau: np.abs(d).max()),
        "error-averaged": _compared(lambda d, tau: np.abs(d).mean() / np.abs(tau).max()),
        "error-of-joints": _compared(lambda d, tau: np.abs(d[6:]).max() / np.abs(tau).max()),
        "assumed": lambda forward, inverse, model, q, v, tau: 0.0,
    },
)

EXERCISE = Exercise(
    id="project.4",
    kind="explain",
    title=Text("Stage 4: does it hold together, and how long does it take", "阶段 4：集成验证"),
    text=Text(
        """Three checks of the whole. Statics: find the load of each foot from levers alone, without any dynamics, and
        compare with your `standing_forces` of 49.11.3. Consistency: write a check that notices a faulty forward
        dynamics; it is tried on one that is right and on some that are not. Speed: measure the time of one call so that
        the answer does not depend on luck. Then time get_dynamics for Go2 and say what you found.

        The chapter wants each foot at about m g/4, from g = J_cᵀλ: that lacks Sᵀτ, see 49.11.3. It also wants all of it
        within 0.1 ms. That can be had, but not with every implementation: name yours, and the machine.""",
        """对整体做三项检验。静力：只用杠杆原理（不用动力学）求每只脚的负载，并与你在 49.11.3 写的 `standing_forces`
        比较。一致性：写一个能发现错误正向动力学的检验；它会用在一个正确的和几个有错的实现上。
        性能：测量一次调用的耗时，结果不应取决于运气。然后测量 Go2 的 get_dynamics，写下你的结果。

        本章由 g = J_cᵀλ 得每只脚约 m g/4，那漏了 Sᵀτ，见 49.11.3。本章还要求全部计算小于 0.1 ms：这可以做到，
        但不是任何实现都行；请说明你用的实现和机器。""",
    ),
    parts=(LOADS, CONSISTENCY, TIME),
    hints=(
        Text(
            "Three equations: the forces add up to the weight, and their moments about the centre of mass vanish, "
            "about x and about y. `np.linalg.lstsq` gives the solution of least norm.",
            "三个方程：各力之和等于重力；对质心绕 x、绕 y 的力矩为零。`np.linalg.lstsq` 给出最小范数解。",
        ),
        Text(
            "The error of a check must be large for every fault: look at all rows, take absolute values, and compare "
            "with the size of what you compare.",
            "检验误差应对任何错误都足够大：看全部行，取绝对值，并与被比较量的大小相比。",
        ),
        Text(
            "Whatever else the machine does only adds time. Warm up once, then take the median or the shortest.",
            "机器的其他活动只会使时间变长。先调用一次预热，再取中位数或最短时间。",
        ),
    ),
    answer=Text(
        """Statics: 39.10 N on each front foot and 39.80 N on each rear one, as in 49.11.3: two ways with nothing in
        common. Consistency: aba and rnea give τ back to about 1e-15 of its size; without gravity, without velocity
        terms or with a held base the error is of the order of 1 or more. Such a check does not see a fault that both
        share, in the inertias for instance. Speed, on the machine where this was written: M, h, J_c and A_G of Go2
        take 8.6 µs with Pinocchio, called from Python, and 9.5 ms with twistwrench's textbook functions, which are
        written to be read. So 0.1 ms is met eleven times over by the one and missed by a factor of 95 by the other,
        and both compute the same. A number like 0.1 ms means something only together with the implementation, the
        machine, and whether it is a median or a worst case: a controller at 1 kHz needs the latter.""",
        """静力：前脚各 39.10 N、后脚各 39.80 N，与 49.11.3 相同，而两种方法毫无共同之处。
        一致性：aba 与 rnea 还原 τ 的误差约为其大小的 1e-15；缺重力、缺速度项或固定基座时误差达到 1 的量级或更大。
        但这种检验看不出两者共有的错误，例如惯量参数错误。
        性能（编写时所用机器）：Go2 的 M、h、J_c、A_G，从 Python 调用 Pinocchio 共 8.6 µs；
        用 twistwrench 的教科书式实现为 9.5 ms，后者是写来读的。所以 0.1 ms 的要求，前者有 11 倍余量，后者差 95 倍，
        而两者结果相同。0.1 ms 这样的数字只有连同实现、机器、是中位数还是最坏情况一起说才有意义：
        1 kHz 的控制器要看的是最坏情况。""",
    ),
)
