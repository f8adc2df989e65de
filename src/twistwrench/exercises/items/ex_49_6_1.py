"""Exercise 49.6.1: RNEA against M a + h."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import JOINT_SPACE, MASS_MATRIX
from ..robots import robot, small_robot
from ..text import Text
from ..wrong import after, swap, swapped

__all__ = ["EXERCISE", "mass_matrix_by_rnea", "torques_two_ways"]


def torques_two_ways(model: Any, q: Any, v: Any, a: Any) -> Any:
    """Joint forces by RNEA, and as M a + h."""
    M = tw.crba(model, q)
    h = tw.rnea(model, q, v, np.zeros(model.nv))
    return tw.rnea(model, q, v, a), M @ a + h


def mass_matrix_by_rnea(model: Any, q: Any) -> Any:
    """Mass matrix, column by column."""
    rest = np.zeros(model.nv)
    gravity = tw.rnea(model, q, rest, rest)
    columns = [tw.rnea(model, q, rest, e) - gravity for e in np.eye(model.nv)]
    return np.array(columns).mT


def _second(model: Any, q: Any, v: Any, a: Any, tau: Any) -> Any:
    """Put something else in the place of M a + h."""
    return tw.rnea(model, q, v, a), tau


def _sum(M: Any, model: Any, q: Any, v: Any, a: Any) -> Any:
    """Use another matrix for M."""
    return _second(model, q, v, a, M @ a + tw.nonlinear_effects(model, q, v))


def _with(model: Any, q: Any, v: Any, a: Any, bias: Any) -> Any:
    """Use something else for h."""
    return _second(model, q, v, a, tw.crba(model, q) @ a + bias)


def _motions(rng: Any) -> Any:
    def motion(model: Any) -> Any:
        return model, model.random_configuration(rng=rng), *rng.standard_normal((2, model.nv))

    return [motion(robot("go2")), motion(small_robot(rng)), motion(small_robot(rng))]


def _postures(rng: Any) -> Any:
    return [(model, model.random_configuration(rng=rng)) for model in (small_robot(rng), small_robot(rng))]


TWO_WAYS = Part(
    solution=torques_two_ways,
    doc=Text(
        """Return the joint forces of a motion in two ways: by RNEA, and as M a + h.

        model: a robot with a floating base. q: array (nq,). v, a: arrays (nv,).
        M by CRBA; h = C v + g by RNEA, too, at zero acceleration. `tw.crba(model, q)` and
        `tw.rnea(model, q, v, a)`, or Pinocchio's with `tw.bridge` for the order.
        Returns: two arrays (nv,), the base's six first: N m, then N; then the joints'.""",
        """用两种方法返回给定运动所需的关节力：用 RNEA，以及用 M a + h。

        model：浮动基座机器人。q：数组 (nq,)。v、a：数组 (nv,)。
        M 由 CRBA 得到；h = C v + g 也由 RNEA 得到，取加速度为零。可用 `tw.crba(model, q)` 与
        `tw.rnea(model, q, v, a)`，或用 Pinocchio（用 `tw.bridge` 转换顺序）。
        返回：两个数组 (nv,)，先是基座的六个（N m、N），然后是各关节的。""",
    ),
    returns=(Quantity("τ by RNEA", JOINT_SPACE), Quantity("M a + h", JOINT_SPACE)),
    cases=_motions,
    slips={
        "bias-for-zero": lambda model, q, v, a: _with(model, q, v, a, 0),
        "bias-sign": lambda model, q, v, a: _with(model, q, v, a, -tw.nonlinear_effects(model, q, v)),
        "velocity-terms-missing": lambda model, q, v, a: _with(model, q, v, a, tw.gravity(model, q)),
        "gravity-missing": lambda model, q, v, a: _with(
            model, q, v, a, tw.nonlinear_effects(model, q, v) - tw.gravity(model, q)
        ),
        "gravity-twice": lambda model, q, v, a: _with(
            model, q, v, a, tw.nonlinear_effects(model, q, v) + tw.gravity(model, q)
        ),
        "acceleration-twice": lambda model, q, v, a: _with(model, q, v, a, tw.rnea(model, q, v, a)),
        "velocity-for-acceleration": lambda model, q, v, a: _second(
            model, q, v, a, tw.crba(model, q) @ v + tw.nonlinear_effects(model, q, v)
        ),
        "one-triangle": lambda model, q, v, a: _sum(np.triu(tw.crba(model, q)), model, q, v, a),
        "doubled-off-diagonal": lambda model, q, v, a: _sum(
            2 * tw.crba(model, q) - np.diag(tw.crba(model, q).diagonal()), model, q, v, a
        ),
        "orders-mixed": lambda model, q, v, a: _sum(swap(tw.crba(model, q)), model, q, v, a),
        "swapped-halves": swapped(torques_two_ways),
        "base-missing": after(torques_two_ways, lambda tau: tau[6:]),
    },
    properties=(
        Property(
            Text("both ways give the same", "两种方法结果相同"),
            lambda answer, model, q, v, a: answer[0] - answer[1],
        ),
        Property(
            Text("forward dynamics undoes it: ABA gives a back", "正向动力学是其逆：ABA 应还原 a"),
            lambda answer, model, q, v, a: tw.aba(model, q, v, answer[1]) - a,
        ),
    ),
)

COLUMNS = Part(
    solution=mass_matrix_by_rnea,
    doc=Text(
        """Return the mass matrix, found with RNEA alone.

        What RNEA says of a unit acceleration of one joint is nearly a column of M. Nearly.
        model: a robot with a floating base. q: array (nq,). `tw.rnea(model, q, v, a)` is RNEA.
        Returns: array (nv, nv), full, the base's six rows and columns first, (ω, v).""",
        """只用 RNEA 求出质量矩阵并返回。

        单个关节取单位加速度时，RNEA 给出的几乎就是 M 的一列。只是“几乎”。
        model：浮动基座机器人。q：数组 (nq,)。`tw.rnea(model, q, v, a)` 就是 RNEA。
        返回：数组 (nv, nv)，完整矩阵，前六行六列属于基座 (ω, v)。""",
    ),
    returns=(Quantity("M", MASS_MATRIX),),
    cases=_postures,
    slips={
        "gravity-left-in": lambda model, q: mass_matrix_by_rnea(model, q) + tw.gravity(model, q)[:, None],
        "swapped-halves": swapped(mass_matrix_by_rnea),
        "base-missing": lambda model, q: mass_matrix_by_rnea(model, q)[6:, 6:],
        "one-triangle": after(mass_matrix_by_rnea, np.triu),
        "doubled-off-diagonal": lambda model, q: (
            2 * mass_matrix_by_rnea(model, q) - np.diag(mass_matrix_by_rnea(model, q).diagonal())
        ),
    },
    properties=(
        Property(Text("M is symmetric", "M 对称"), lambda answer, model, q: answer - answer.mT),
        Property(
            Text("½ vᵀM v is the kinetic energy", "½ vᵀM v 等于动能"),
            lambda answer, model, q: [
                v @ answer @ v / 2 - tw.kinetic_energy(model, q, v) for v in np.tri(model.nv) / model.nv
            ],
        ),
        Property(Text("CRBA gives the same", "与 CRBA 结果相同"), lambda answer, model, q: answer - tw.crba(model, q)),
    ),
)

EXERCISE = Exercise(
    id="49.6.1",
    kind="code",
    title=Text("RNEA against M a + h", "RNEA 与 M a + h"),
    text=Text(
        """Compute the joint forces of a random motion (q, v, a) in two ways and compare them: by RNEA in one go, and as
        M a + h, with M from CRBA and h from RNEA at a = 0. The chapter uses Pinocchio; twistwrench will do as well.

        Then go one step further: RNEA says what any acceleration costs, so it must know M. Get M out of it, without
        CRBA.""",
        """对随机运动 (q, v, a) 用两种方法计算关节力并比较：用 RNEA 一次算出；用 M a + h，
        其中 M 由 CRBA 得到，h 由 RNEA 在 a = 0 时得到。本章用 Pinocchio，用 twistwrench 也可以。

        再进一步：RNEA 能算出任意加速度需要多大的力，所以它“知道” M。不用 CRBA，把 M 从 RNEA 中取出来。""",
    ),
    parts=(TWO_WAYS, COLUMNS),
    hints=(
        Text(
            "τ = M a + h holds for every a. Which a leaves only h?",
            "τ = M a + h 对任意 a 成立。取怎样的 a 时只剩下 h？",
        ),
        Text(
            "h keeps q and v: `tw.rnea(model, q, v, np.zeros(model.nv))`. It holds gravity, once.",
            "h 中保留 q 和 v：`tw.rnea(model, q, v, np.zeros(model.nv))`，其中已含一次重力。",
        ),
        Text(
            "With v = 0 and a = e_k, RNEA gives M e_k + g(q). Take g(q) off: that is RNEA with a = 0.",
            "取 v = 0、a = e_k，RNEA 给出 M e_k + g(q)。减去 g(q)，即 a = 0 时的 RNEA。",
        ),
    ),
)
