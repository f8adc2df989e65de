"""Exercise 49.11.2: how the cost grows with the robot."""

from typing import Any

import numpy as np

from ...trees import chain
from ..exercise import Exercise, Part, Property, Quantity
from ..robots import robot, small_robot
from ..text import Text

__all__ = ["EXERCISE", "count_transforms", "growth"]


def count_transforms(parent: Any) -> Any:
    """Six-vectors that RNEA and CRBA carry from frame to frame."""
    depth = [0] * len(parent)
    for i in range(1, len(parent)):
        depth[i] = depth[parent[i]] + 1
    bodies = len(parent) - 1
    return 3 * bodies, sum(depth) - bodies


def growth(sizes: Any, seconds: Any) -> Any:
    """Exponent k of t = c Nᵏ."""
    slope, _ = np.polyfit(np.log(sizes), np.log(seconds), 1)
    return slope


def _trees(rng: Any) -> Any:
    star = (-1, 0, *[1] * int(rng.integers(3, 8)))
    random = (-1, 0, *(int(rng.integers(0, i)) for i in range(2, 12)))
    return [
        (robot("go2").parent,),
        (chain(int(rng.integers(5, 15))).parent,),
        (small_robot(rng).parent,),
        (star,),
        (random,),
    ]


def _times(rng: Any) -> Any:
    """Return times that grow with a power of N, and are off by some per cent as measured ones are."""
    sizes = np.array([10.0, 20, 40, 80, 160])
    powers = rng.uniform([0.8, 1.8, 2.6], [1.2, 2.2, 3.2])
    return [(sizes, rng.uniform(1e-6, 1e-5) * sizes**k * rng.uniform(0.9, 1.1, 5)) for k in powers]


COUNT = Part(
    solution=count_transforms,
    doc=Text(
        """Return how many six-vectors RNEA and CRBA carry between neighbouring frames.

        parent: tuple of whole numbers, `model.parent`: parent[i] is the body that carries body i, 0
        is the world, and parent[0] is −1. No body comes before its parent.
        Returns: two whole numbers. RNEA: the twist and the acceleration of each body come from its
        parent (the world counts), and its wrench goes there. CRBA: the wrench F of each body is
        carried along the bodies on its way to the base, as long as there is a joint to project it on;
        the composite inertias are not counted.""",
        """返回 RNEA 与 CRBA 在相邻坐标系之间变换六维向量的次数。

        parent：整数元组，即 `model.parent`：parent[i] 是承载物体 i 的物体，0 是世界，parent[0] 为
        −1；父物体总排在前面。
        返回：两个整数。RNEA：每个物体的 twist 和加速度来自父物体（世界也算），wrench 传回父物体。
        CRBA：每个物体的 wrench F 沿通往基座的路径逐个向上变换，直到没有关节可投影为止；
        复合惯量的变换不计。""",
    ),
    returns=(Quantity("RNEA"), Quantity("CRBA")),
    cases=_trees,
    slips={
        "transforms-two": lambda parent: (2 * (len(parent) - 1), count_transforms(parent)[1]),
        "world-as-body": lambda parent: (3 * len(parent), count_transforms(parent)[1]),
        "world-counted": lambda parent: (3 * (len(parent) - 1), sum(_depths(parent))),
        "quadratic-always": lambda parent: (3 * (len(parent) - 1), (len(parent) - 1) * (len(parent) - 2) // 2),
        "longest-branch": lambda parent: (
            3 * (len(parent) - 1),
            max(_depths(parent)) * (max(_depths(parent)) - 1) // 2,
        ),
    },
)


def _depths(parent: Any) -> Any:
    depth = [0] * len(parent)
    for i in range(1, len(parent)):
        depth[i] = depth[parent[i]] + 1
    return depth


GROWTH = Part(
    solution=growth,
    doc=Text(
        """Return the exponent k with which a time grows, t = c Nᵏ, by least squares on logarithmic axes.

        sizes: array (n,), N. seconds: array (n,), s, measured: a little off, each of them.
        Returns: a number. 1 is linear, 2 quadratic.""",
        """返回耗时增长的指数 k(t = c Nᵏ)：在双对数坐标下作最小二乘拟合。

        sizes：数组 (n,)，N。seconds：数组 (n,)，s，测量值，各有少许误差。
        返回：一个数；1 为线性，2 为平方。""",
    ),
    returns=(Quantity("k"),),
    cases=_times,
    slips={
        "two-points": lambda N, t: np.log(t[-1] / t[0]) / np.log(N[-1] / N[0]),
        "fit-unlogged": lambda N, t: np.polyfit(N, t, 1)[0],
        "fit-half-logged": lambda N, t: np.polyfit(N, np.log(t), 1)[0],
        "fit-through-origin": lambda N, t: np.log(N) @ np.log(t) / (np.log(N) @ np.log(N)),
        "fit-intercept": lambda N, t: np.polyfit(np.log(N), np.log(t), 1)[1],
        "fit-inverted": lambda N, t: np.polyfit(np.log(t), np.log(N), 1)[0],
    },
    properties=(
        Property(
            Text("in other units of time the exponent is the same", "换一个时间单位，指数不变"),
            lambda answer, sizes, seconds: answer - growth(sizes, 1e6 * seconds),
        ),
    ),
)

EXERCISE = Exercise(
    id="49.11.2",
    kind="explain",
    title=Text("How the cost grows", "耗时怎样增长"),
    text=Text(
        """The chapter compares the time of RNEA on Go2 with that on a humanoid of 30 degrees of freedom, and calls the
        growth linear. Two robots cannot show that: any curve runs through two points. Also, N counts bodies, and a
        free-flyer is one body with six degrees of freedom. So count first what the algorithms do on any tree. Then
        fit the exponent to times of a whole family of robots, such as `tw.chain(n)` for n from 20 to 320. Measure
        your own with any implementation, and explain what you see.""",
        """本章比较 Go2 与 30 自由度人形机器人上 RNEA 的耗时，并由此说增长是线性的。两台机器人说明不了问题：
        任何曲线都能过两点。而且 N 数的是刚体：自由飞行关节有六个自由度，却只是一个刚体。
        因此先数出算法在任意树上的运算次数，再对同一族机器人（如 `tw.chain(n)`，n 从 20 到 320）的耗时拟合指数。
        用任一实现自己测量，并解释结果。""",
    ),
    parts=(COUNT, GROWTH),
    hints=(
        Text(
            "For RNEA count what crosses one joint, and how many joints there are. For CRBA count how far each body is "
            "from the base.",
            "RNEA：数一个关节上传递几个量，有多少个关节。CRBA：数每个物体离基座有多远。",
        ),
        Text(
            "The depth of a body is that of its parent plus one. A body at depth d has d − 1 joints before it.",
            "物体的深度等于父物体深度加一；深度为 d 的物体前面还有 d − 1 个关节。",
        ),
        Text(
            "log t = k log N + log c is a straight line: `np.polyfit(np.log(sizes), np.log(seconds), 1)`.",
            "log t = k log N + log c 是直线：`np.polyfit(np.log(sizes), np.log(seconds), 1)`。",
        ),
    ),
    answer=Text(
        """RNEA carries three vectors over each joint: 3N, linear on every tree, 39 on Go2 with its 13 bodies. CRBA
        walks from each body to the base: the sum of the depths less N, which is N(N − 1)/2 on a chain and 24 on Go2,
        whose legs are short: on a chain of 13 it would be 78. So CRBA is quadratic at worst and almost linear on a
        robot with many short branches. Measured with Pinocchio on chains of 20 to 320 joints the exponents were 0.97
        for RNEA, 0.98 for ABA and 2.1 for CRBA. Go2 and a humanoid with 22 bodies and 27 degrees of freedom differed
        1.74 times, for 1.69 times the bodies and 1.5 times the degrees of freedom: it fits, and would have fitted a
        good deal else.""",
        """RNEA 在每个关节上传递三个向量：3N，对任何树都是线性的，Go2 有 13 个刚体，共 39 次。CRBA 从每个刚体走回基座：
        各深度之和减去 N，单链为 N(N − 1)/2；Go2 的腿很短，只有 24 次，同样 13 个刚体的单链要 78 次。
        所以 CRBA 最坏是平方的，对短分支多的机器人几乎是线性的。用 Pinocchio 在 20 到 320 个关节的单链上实测，
        指数为 RNEA 0.97、ABA 0.98、CRBA 2.1。Go2 与一台 22 个刚体、27 自由度的人形机器人相差 1.74 倍，
        而刚体数之比是 1.69，自由度之比是 1.5：符合线性，但也能符合许多别的规律。""",
    ),
)
