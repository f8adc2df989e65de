"""Exercise 49.10.2: the linear momentum, in both orders."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..robots import robot, small_robot
from ..text import Text

__all__ = ["EXERCISE", "linear_momentum", "momentum_of_links", "pinocchio_linear_momentum"]


def linear_momentum(A_G: Any, v: Any) -> Any:
    """Linear momentum out of A_G, in the order (ω, v)."""
    return A_G[3:] @ v


def pinocchio_linear_momentum(A_G: Any, v: Any) -> Any:
    """Linear momentum out of Pinocchio's A_G, in its order (v, ω)."""
    return A_G[:3] @ v


def momentum_of_links(model: Any, q: Any, v: Any) -> Any:
    """Sum of m_i times the velocity of link i's centre of mass."""
    motion = tw.forward_kinematics(model, q, v)
    total = np.zeros(3)
    for body, T, V in zip(model.inertia, motion.placement, np.array(motion.twist)):
        velocity = V[3:] + np.cross(V[:3], body.com)
        total = total + body.mass * T.rotation @ velocity
    return total


def _bodies(of_body: Any) -> Any:
    """Sum over the bodies something of mass, centre, rotation, ω and v."""

    def wrong(model: Any, q: Any, v: Any) -> Any:
        motion = tw.forward_kinematics(model, q, v)
        bodies = list(zip(model.inertia, motion.placement, np.array(motion.twist)))[1:]
        return sum(of_body(float(body.mass), body.com, T.rotation, V[:3], V[3:]) for body, T, V in bodies)

    return wrong


MASSLESS = _bodies(lambda m, c, R, w, u: R @ (u + np.cross(w, c)))


def _unweighted(model: Any, q: Any, v: Any) -> Any:
    return model.mass / (model.nbodies - 1) * MASSLESS(model, q, v)


def _base(model: Any, q: Any, v: Any) -> Any:
    """Return the whole mass times the velocity of the base."""
    return model.mass * tw.forward_kinematics(model, q).placement[1].rotation @ v[3:6]


def _maps(rng: Any) -> Any:
    cases = []
    for model in (robot("go2"), small_robot(rng), small_robot(rng)):
        q, v = model.random_configuration(rng=rng), rng.standard_normal(model.nv)
        cases.append((tw.centroidal_map(model, q), v))
    return cases


def _in_pinocchio_order(rng: Any) -> Any:
    """Return A_G and v as Pinocchio has them: all the halves exchanged, no joint touched."""
    cases = []
    for A_G, v in _maps(rng):
        order = [k + 3 if k < 3 else k - 3 if k < 6 else k for k in range(len(v))]
        cases.append((A_G[order[:6]][:, order], v[order]))
    return cases


def _other_order(v: Any) -> Any:
    return np.concatenate([v[:6].reshape(2, 3)[::-1].ravel(), v[6:]])


OURS = Part(
    solution=linear_momentum,
    doc=Text(
        """Return the linear momentum l_G, from the centroidal momentum matrix of twistwrench.

        A_G: array (6, nv), as `tw.centroidal_map` gives it: rows (k, l), the base's columns (ω, v).
        v: array (nv,).
        Returns: array (3,), kg m/s, in the axes of the world.""",
        """由 twistwrench 的质心动量矩阵返回线动量 l_G。

        A_G：数组 (6, nv)，即 `tw.centroidal_map` 的结果：行 (k, l)，基座的列 (ω, v)。v：数组 (nv,)。
        返回：数组 (3,)，kg m/s，用世界坐标轴。""",
    ),
    returns=(Quantity("l_G", unit="kg m/s"),),
    cases=_maps,
    slips={
        "angular-for-linear": lambda A_G, v: A_G[:3] @ v,
        "joints-left-out": lambda A_G, v: A_G[3:, :6] @ v[:6],
        "pinocchio-velocity": lambda A_G, v: A_G[3:] @ _other_order(v),
    },
    reasons={
        "pinocchio-velocity": Text(
            "The columns of this A_G and v have one order, (ω, v): take v as it is.",
            "这里 A_G 的列与 v 的顺序相同，都是 (ω, v)：v 不需要调换。",
        ),
    },
)

THEIRS = Part(
    solution=pinocchio_linear_momentum,
    doc=Text(
        """Return the linear momentum l_G, from the centroidal momentum matrix of Pinocchio.

        A_G: array (6, nv), as `pin.computeCentroidalMap` gives it: rows (l, k), the base's columns
        (v, ω).
        v: array (nv,), Pinocchio's: the base's entries are (v, ω).
        Returns: array (3,), kg m/s, in the axes of the world.""",
        """由 Pinocchio 的质心动量矩阵返回线动量 l_G。

        A_G：数组 (6, nv)，即 `pin.computeCentroidalMap` 的结果：行 (l, k)，基座的列 (v, ω)。
        v：数组 (nv,)，Pinocchio 的，基座分量为 (v, ω)。
        返回：数组 (3,)，kg m/s，用世界坐标轴。""",
    ),
    returns=(Quantity("l_G", unit="kg m/s"),),
    cases=_in_pinocchio_order,
    slips={
        "angular-for-linear": lambda A_G, v: A_G[3:] @ v,
        "joints-left-out": lambda A_G, v: A_G[:3, :6] @ v[:6],
        "pinocchio-velocity": lambda A_G, v: A_G[:3] @ _other_order(v),
    },
    reasons={
        "pinocchio-velocity": Text(
            "The columns of this A_G and v have one order, Pinocchio's (v, ω): take v as it is.",
            "这里 A_G 的列与 v 的顺序相同，都是 Pinocchio 的 (v, ω)：v 不需要调换。",
        ),
    },
)

LINKS = Part(
    solution=momentum_of_links,
    doc=Text(
        """Return m v_G without A_G: the sum of m_i times the velocity of the centre of mass of link i.

        model: with a floating base. q: array (nq,). v: array (nv,).
        `motion = tw.forward_kinematics(model, q, v)` has, for each body, `motion.placement[i]` in
        the world and `motion.twist[i]`, (ω, v) in the body's own frame; `model.inertia[i]` has
        `.mass` and `.com`.
        Returns: array (3,), kg m/s, in the axes of the world.""",
        """不用 A_G，返回 m v_G：各连杆质量乘其质心速度之和。

        model：浮动基座模型。q：数组 (nq,)。v：数组 (nv,)。
        `motion = tw.forward_kinematics(model, q, v)` 对每个刚体给出世界中的位姿
        `motion.placement[i]` 和`motion.twist[i]`，即自身坐标系中的 (ω, v)；`model.inertia[i]` 有
        `.mass` 和 `.com`。
        返回：数组 (3,)，kg m/s，用世界坐标轴。""",
    ),
    returns=(Quantity("m v_G", unit="kg m/s"),),
    cases=lambda rng: [
        (model, model.random_configuration(rng=rng), rng.standard_normal(model.nv))
        for model in (robot("go2"), small_robot(rng), small_robot(rng))
    ],
    slips={
        "frame-for-com": _bodies(lambda m, c, R, w, u: m * R @ u),
        "cross-order": _bodies(lambda m, c, R, w, u: m * R @ (u + np.cross(c, w))),
        "local-for-world": _bodies(lambda m, c, R, w, u: m * (u + np.cross(w, c))),
        "rotation-transposed": _bodies(lambda m, c, R, w, u: m * R.mT @ (u + np.cross(w, c))),
        "angular-for-linear": _bodies(lambda m, c, R, w, u: m * R @ w),
        "mass-dropped": MASSLESS,
        "unweighted-mean": _unweighted,
        "base-for-com": _base,
        "legs-left-out": lambda model, q, v: (
            model.inertia[1].mass / model.mass * _base(model, q, v)
            + model.inertia[1].mass
            * tw.forward_kinematics(model, q).placement[1].rotation
            @ np.cross(v[:3], model.inertia[1].com)
        ),
    },
    reasons={
        "base-for-com": Text(
            "The legs move against the base: m v_G is the sum of all m_i v_i.",
            "腿相对基座在运动：m v_G 是全部 m_i v_i 之和。",
        ),
        "legs-left-out": Text(
            "Every body has a momentum: sum over all of them.", "每个刚体都有动量：要对全部刚体求和。"
        ),
        "local-for-world": Text(
            "Each velocity is along the axes of its own body: turn it by R before it is added.",
            "各速度都用自身坐标轴：相加之前要先乘 R。",
        ),
        "mass-dropped": Text("Momentum is mass times velocity, body by body.", "动量是质量乘速度，逐个刚体计算。"),
        "unweighted-mean": Text("A heavy link counts more: Σ m_i v_i.", "重的连杆占的分量更大：Σ m_i v_i。"),
    },
    properties=(
        Property(
            Text("it is the derivative of Σ m_i c_i along the motion", "等于 Σ m_i c_i 沿运动的导数"),
            lambda answer, model, q, v: answer - model.mass * _rate_of_com(model, q, v),
        ),
    ),
)


def _rate_of_com(model: Any, q: Any, v: Any) -> Any:
    """Differentiate the centre of mass along the motion, by a central difference."""
    h = 1e-5
    ahead, behind = (tw.center_of_mass(model, model.integrate(q, s * v)) for s in (h, -h))
    return (ahead - behind) / (2 * h)


EXERCISE = Exercise(
    id="49.10.2",
    kind="code",
    title=Text("The linear momentum, in both orders", "两种顺序下的线动量"),
    text=Text(
        """Verify l_G = m v_G. Take the linear momentum out of the centroidal momentum matrix, once from
        twistwrench's A_G and once from Pinocchio's, and compute m v_G on its own, link by link.

        Mind the rows. Here, and in the chapter's formulas, the angular rows come first, so the linear ones are 3 to 5;
        in Pinocchio they are 0 to 2. The chapter says so in this exercise, but its own listing in 49.11 takes `h_G[3:]`
        from Pinocchio for the linear momentum: that is the angular one.""",
        """验证 l_G = m v_G。分别从 twistwrench 的 A_G 和 Pinocchio 的 A_G 中取出线动量，再逐个连杆独立计算 m v_G。

        注意行的顺序：这里（以及本章公式）角动量在前，线动量是第 3–5 行；Pinocchio 中是第 0–2 行。
        本章在这道题中说对了，但 49.11 的代码把 Pinocchio 的 `h_G[3:]` 当作线动量，那其实是角动量。""",
    ),
    parts=(OURS, THEIRS, LINKS),
    hints=(
        Text("h_G = A_G v, and half of it is the linear momentum.", "h_G = A_G v，其中一半是线动量。"),
        Text(
            "The v of a body twist belongs to the frame's origin. A point at c moves with v + ω × c, in the axes of "
            "the body; R takes that to the world.",
            "body twist 的 v 是坐标系原点的速度；c 处的点速度为 v + ω × c（本体坐标轴），再用 R 变到世界。",
        ),
    ),
)
