"""Exercise 49.6.2: gravity as an acceleration, and as forces."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import JOINT_SPACE, WRENCH
from ..robots import robot, small_robot, weightless
from ..text import Text
from ..workbook import mine
from ..wrong import negated, swap, swapped

__all__ = ["EXERCISE", "gravity_two_ways", "weight_wrenches"]


def weight_wrenches(model: Any, q: Any) -> Any:
    """Weight of each body as a wrench in its own frame."""
    placement = tw.forward_kinematics(model, q).placement
    W = np.zeros((model.nbodies, 6))
    for i in range(1, model.nbodies):
        body = model.inertia[i]
        force = body.mass * placement[i].rotation.mT @ model.gravity
        W[i] = np.concatenate([np.cross(body.com, force), force])
    return W


def gravity_two_ways(model: Any, weightless: Any, q: Any, v: Any, a: Any) -> Any:
    """Joint forces with the world rising, and with a weight on each body."""
    W = mine("weight_wrenches")
    return tw.rnea(model, q, v, a), tw.rnea(weightless, q, v, a, f_ext=W(model, q))


def _weights(model: Any, q: Any, wrench: Any) -> Any:
    """Make the row of each body out of mass, centre of mass, R and g."""
    placement = tw.forward_kinematics(model, q).placement
    rows = [wrench(body.mass, body.com, T.rotation, model.gravity) for body, T in zip(model.inertia[1:], placement[1:])]
    return np.array([np.zeros(6), *(np.concatenate(row) for row in rows)])


def _about_world(model: Any, q: Any) -> Any:
    """Take each wrench to the world frame."""
    placement = tw.forward_kinematics(model, q).placement
    return np.array([T.force_transform() @ F for T, F in zip(placement, weight_wrenches(model, q))])


def _without_base(model: Any, q: Any) -> Any:
    W = weight_wrenches(model, q)
    W[1] = 0
    return W


def _postures(rng: Any) -> Any:
    return [(model, model.random_configuration(rng=rng)) for model in (robot("go2"), small_robot(rng))]


def _motions(rng: Any) -> Any:
    return [
        (model, weightless(model), model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv)))
        for model in (small_robot(rng), small_robot(rng))
    ]


def _second(f_ext: Any) -> Any:
    """Use other outside wrenches in the second way."""

    def wrong(model: Any, weightless: Any, q: Any, v: Any, a: Any) -> Any:
        return tw.rnea(model, q, v, a), tw.rnea(weightless, q, v, a, f_ext=f_ext(model, q))

    return wrong


WEIGHTS = Part(
    solution=weight_wrenches,
    doc=Text(
        """Return the weight of each body as a wrench in the body's own frame.

        model: a robot. q: array (nq,). `model.inertia[i]` has `.mass` and `.com` (in frame i),
        `model.gravity` is (0, 0, -9.81) m/s² in the world, and
        `tw.forward_kinematics(model, q).placement[i]` places frame i in the world: `.rotation`.
        Returns: array (nbodies, 6), (τ, f), N m and N, about the origin of frame i. Row 0, the
        world's, is zero.""",
        """返回每个刚体的重力，写成该刚体自身坐标系中的 wrench。

        model：机器人。q：数组 (nq,)。`model.inertia[i]` 含 `.mass` 与 `.com`（在坐标系 i 中），
        `model.gravity` 是世界中的 (0, 0, -9.81) m/s²，
        `tw.forward_kinematics(model, q).placement[i]` 是坐标系 i 在世界中的位姿，含 `.rotation`。
        返回：数组 (nbodies, 6)，(τ, f)，N m 与 N，对坐标系 i 的原点取矩。第 0 行（世界）为零。""",
    ),
    returns=(Quantity("W", WRENCH),),
    cases=_postures,
    slips={
        "moment-dropped": lambda model, q: _weights(model, q, lambda m, c, R, g: (np.zeros(3), m * R.mT @ g)),
        "untransformed": lambda model, q: _weights(model, q, lambda m, c, R, g: (np.cross(c, m * g), m * g)),
        "aligned-for-local": lambda model, q: _weights(model, q, lambda m, c, R, g: (np.cross(R @ c, m * g), m * g)),
        "rotation-forward": lambda model, q: _weights(model, q, lambda m, c, R, g: (np.cross(c, m * R @ g), m * R @ g)),
        "cross-order": lambda model, q: _weights(
            model, q, lambda m, c, R, g: (np.cross(m * R.mT @ g, c), m * R.mT @ g)
        ),
        "mass-dropped": lambda model, q: _weights(model, q, lambda m, c, R, g: (np.cross(c, R.mT @ g), R.mT @ g)),
        "wrench-about-world": _about_world,
        "weight-upward": negated(weight_wrenches),
        "swapped-halves": lambda model, q: np.array([swap(F) for F in weight_wrenches(model, q)]),
        "base-weightless": _without_base,
    },
    properties=(
        Property(
            Text("the weight acts at the centre of mass: no moment about it", "重力作用在质心：对质心没有力矩"),
            lambda answer, model, q: [F[:3] - np.cross(body.com, F[3:]) for body, F in zip(model.inertia, answer)],
        ),
        Property(
            Text("in the axes of the world all weights add up to m g", "在世界坐标轴中所有重力之和为 m g"),
            lambda answer, model, q: (
                sum(T.rotation @ F[3:] for T, F in zip(tw.forward_kinematics(model, q).placement, answer))
                - sum(body.mass for body in model.inertia) * model.gravity
            ),
        ),
    ),
)

TWO_WAYS = Part(
    solution=gravity_two_ways,
    doc=Text(
        """Return the joint forces of a motion in two ways: gravity as an acceleration, and as forces.

        model: a robot. weightless: the same robot where there is no gravity.
        q: array (nq,). v, a: arrays (nv,). W(model, q) is your `weight_wrenches`.
        `tw.rnea(model, q, v, a, f_ext=...)` takes outside wrenches on the bodies, shape (nbodies, 6).
        Returns: two arrays (nv,). First RNEA as it is, which starts from a₀ = −g; then RNEA of the
        weightless robot with its weights as outside wrenches.""",
        """用两种方法返回给定运动的关节力：把重力当作加速度，以及当作外力。

        model：机器人。weightless：同一个机器人，但没有重力。
        q：数组 (nq,)。v、a：数组 (nv,)。W(model, q) 就是你的 `weight_wrenches`。
        `tw.rnea(model, q, v, a, f_ext=...)` 接受作用在各刚体上的外部 wrench，形状 (nbodies, 6)。
        返回：两个数组 (nv,)。第一个是 RNEA 本来的做法（从 a₀ = −g 开始）；
        第二个是没有重力的机器人，把各刚体的重力作为外部 wrench。""",
    ),
    given='W = mine("weight_wrenches")',
    returns=(Quantity("τ with a₀ = −g", JOINT_SPACE), Quantity("τ with weights", JOINT_SPACE)),
    cases=_motions,
    slips={
        "gravity-missing": _second(lambda model, q: np.zeros((model.nbodies, 6))),
        "external-sign": _second(lambda model, q: -weight_wrenches(model, q)),
        "gravity-twice": lambda model, weightless, q, v, a: gravity_two_ways(model, model, q, v, a),
        "base-weightless": _second(_without_base),
        "swapped-halves": swapped(gravity_two_ways),
    },
    properties=(
        Property(
            Text("both ways give the same", "两种方法结果相同"),
            lambda answer, model, weightless, q, v, a: answer[0] - answer[1],
        ),
    ),
)

EXERCISE = Exercise(
    id="49.6.2",
    kind="prove",
    title=Text("Gravity as an acceleration", "把重力当作加速度"),
    text=Text(
        """RNEA does not put the weight of each link in as a force. It lets the world rise with a₀ = −g instead. Show
        that both are the same: first in numbers, with the weight of each body as an outside wrench on a robot without
        gravity; then derive it by hand, and say why RNEA does it its way.""",
        """RNEA 并不把每个连杆的重力作为外力加进去，而是令世界以 a₀ = −g 向上加速。说明两种做法等价：
        先用数值实验，对没有重力的机器人，把每个刚体的重力作为外部 wrench；
        然后手动推导，并说明 RNEA 为什么这样做。""",
    ),
    parts=(WEIGHTS, TWO_WAYS),
    hints=(
        Text(
            "The weight acts at the centre of mass, which is not the origin of the frame: it has a moment.",
            "重力作用在质心，而质心不在坐标系原点，所以有力矩。",
        ),
        Text(
            "m, c are known in frame i, g in the world. Bring g to frame i by Rᵀ, then F = (c × m g_i, m g_i).",
            "m、c 在坐标系 i 中已知，g 在世界中。用 Rᵀ 把 g 变到坐标系 i：F = (c × m g_i, m g_i)。",
        ),
        Text(
            "For the derivation: let a' = a − (0, g) in every frame. Does the forward pass carry the shift along? And "
            "what is I (0, g)?",
            "推导：在每个坐标系中令 a' = a − (0, g)。正向传递会原样带上这个偏移吗？I (0, g) 又等于什么？",
        ),
    ),
    answer=Text(
        """Write g_i = (0, Rᵢᵀ g) for the uniform field of gravity as a spatial acceleration in frame i. It is the same
        field everywhere, so X[i] g_λ(i) = g_i. The forward pass is linear in the accelerations:
        a_i = X[i] a_λ(i) + S q̈ + V × S q̇. Starting from −g in place of 0 therefore gives a'_i = a_i − g_i at every
        link, and nothing else changes.

        Newton–Euler then has I_i a'_i + V ×* I V = I_i a_i + V ×* I V − I_i g_i. Now
        I_i g_i = (m c × Rᵀ g, m Rᵀ g): with ω = 0 only the right blocks of I count. That is exactly the weight, acting
        at the centre of mass. So a'_i gives the same as a_i with the weight subtracted as an outside wrench, and that
        is its place: F_i = I a + V ×* I V − F_ext. The backward pass sees the same F_i either way, and so does τ.

        RNEA does it that way since one line before the loops does the work of a rotation, a cross product and a
        subtraction for each link. It is the principle of equivalence: no experiment inside tells a field of gravity
        from a rising floor. The price: the a_i of RNEA are no accelerations any more, but a_i − g_i.""",
        """记 g_i = (0, Rᵢᵀ g) 为均匀重力场在坐标系 i 中的空间加速度。重力场处处相同，所以 X[i] g_λ(i) = g_i。
        正向传递对加速度是线性的：a_i = X[i] a_λ(i) + S q̈ + V × S q̇。因此从 −g 而不是 0 出发，
        每个连杆都得到 a'_i = a_i − g_i，其余不变。

        牛顿-欧拉方程变为 I_i a'_i + V ×* I V = I_i a_i + V ×* I V − I_i g_i。而 I_i g_i = (m c × Rᵀ g, m Rᵀ g)
        （ω = 0，只用到 I 的右侧两块），正是作用在质心的重力。所以用 a'_i 等于用 a_i 再把重力作为外部 wrench 减去，
        这正是外力的位置：F_i = I a + V ×* I V − F_ext。两种做法反向传递用的 F_i 相同，τ 也就相同。

        RNEA 这样做，是因为循环前的一行就代替了每个连杆的一次旋转、一次叉积和一次减法。这就是等效原理：
        在内部无法区分重力场与上升的地板。代价是 RNEA 中的 a_i 不再是真正的加速度，而是 a_i − g_i。""",
    ),
)
