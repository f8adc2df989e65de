"""Exercise 49.5.2: the inertia of Go2's base."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import INERTIA
from ..robots import robot
from ..text import Text
from ..workbook import mine
from ..wrong import swapped
from .ex_49_5_1 import random_body, spatial_inertia

__all__ = ["EXERCISE", "base_inertia", "chapter_order"]


def chapter_order(I: Any) -> Any:
    """From (v, ω) to (ω, v)."""
    order = np.r_[3:6, 0:3]
    return I[np.ix_(order, order)]


def base_inertia(model: Any) -> Any:
    """Mass of the base, and its inertia by hand."""
    build = mine("spatial_inertia")
    base = model.inertia[1]
    return base.mass, build(base.mass, base.com, base.inertia_at_com)


EXCHANGE = np.kron([[0, 1], [1, 0]], np.eye(3))
"""Exchanges the halves of a vector."""

LINK_BASE = (
    6.921,
    np.array([0.021112, 0, -0.005366]),
    np.array([[0.02448, 0.00012166, 0.0014849], [0.00012166, 0.098077, -3.12e-05], [0.0014849, -3.12e-05, 0.107]]),
)
"""Mass, centre of mass and inertia of the link `base` alone, as its URDF has them."""


def _numbers(model: Any, body: int = 1) -> Any:
    return model.inertia[body].mass, model.inertia[body].com, model.inertia[body].inertia_at_com


def _changed(change: Any) -> Any:
    """Change mass, centre of mass and inertia before the matrix is built."""

    def wrong(model: Any) -> Any:
        m, c, I_c = change(*_numbers(model))
        return _numbers(model)[0], spatial_inertia(m, c, I_c)

    return wrong


def _whole(model: Any) -> Any:
    """Return mass and inertia of the whole robot in its neutral posture, in the base's frame."""
    locked = tw.SpatialInertia.from_matrix(tw.crba(model, model.neutral())[:6, :6])
    return locked.mass, locked.matrix()


def _inertia_at_origin(model: Any) -> Any:
    m, c, I_c = _numbers(model)
    I6 = spatial_inertia(m, c, I_c)
    I6[:3, :3] = I_c
    return m, I6


def _parallel_axis_sign(model: Any) -> Any:
    m, c, I_c = _numbers(model)
    I6 = spatial_inertia(m, c, I_c)
    I6[:3, :3] = 2 * I_c - I6[:3, :3]
    return m, I6


def _linear_first(rng: Any) -> Any:
    """Return inertias of random bodies in the order (v, ω)."""
    return [(swapped(spatial_inertia)(*random_body(rng)),) for _ in range(4)]


REORDERED = Part(
    solution=chapter_order,
    doc=Text(
        """Return a spatial inertia in the chapter's order (ω, v).

        I: array (6, 6), as `pin.Inertia.matrix()` gives it: rows and columns in the order (v, ω).
        Returns: array (6, 6).""",
        """返回按本章顺序 (ω, v) 排列的空间惯量矩阵。

        I：数组 (6, 6)，由 `pin.Inertia.matrix()` 得到：行和列的顺序都是 (v, ω)。
        返回：数组 (6, 6)。""",
    ),
    returns=(Quantity("I", INERTIA),),
    cases=_linear_first,
    slips={
        "swapped-halves": lambda I: I,
        "rows-only": lambda I: EXCHANGE @ I,
        "columns-only": lambda I: I @ EXCHANGE,
        "reversed": lambda I: I[::-1, ::-1],
    },
    properties=(
        Property(
            Text("the block of rows and columns v is m 1", "v 行 v 列的块是 m 1"),
            lambda answer, I: answer[3:, 3:] - I[0, 0] * np.eye(3),
        ),
    ),
)

OF_BASE = Part(
    solution=base_inertia,
    doc=Text(
        """Return the mass of the base and its spatial inertia, built by hand from ten numbers.

        model: Go2, as `tw.load("go2")` gives it, or another robot with a floating base.
        `model.inertia` has one entry for each body: `.mass`, kg, `.com`, m, `.inertia_at_com`, kg m².
        build(m, c, I_c) is your `spatial_inertia`.
        Returns: a number, kg, and an array (6, 6), in the order (ω, v).""",
        """返回基座的质量，以及由十个参数手动构造的空间惯量矩阵。

        model：`tw.load("go2")` 得到的 Go2，或其他浮动基座机器人。
        `model.inertia` 中每个刚体有一项：`.mass`(kg)、`.com`(m)、`.inertia_at_com`(kg m²)。
        build(m, c, I_c) 就是你的 `spatial_inertia`。
        返回：一个数（kg），一个数组 (6, 6)，顺序 (ω, v)。""",
    ),
    given='build = mine("spatial_inertia")',
    returns=(Quantity("m", unit="kg"), Quantity("I", INERTIA)),
    cases=lambda rng: [(robot("go2"),), (robot("humanoid"),)],
    slips={
        "universe-for-base": lambda model: (0.0, np.zeros((6, 6))),
        "welded-left-out": lambda model: (
            (LINK_BASE[0], spatial_inertia(*LINK_BASE)) if model.name == "go2" else base_inertia(model)
        ),
        "whole-for-base": _whole,
        "swapped-halves": lambda model: (_numbers(model)[0], swapped(spatial_inertia)(*_numbers(model))),
        "com-dropped": _changed(lambda m, c, I_c: (m, 0 * c, I_c)),
        "com-sign": _changed(lambda m, c, I_c: (m, -c, I_c)),
        "mass-dropped": _changed(lambda m, c, I_c: (1.0, c, I_c)),
        "products-dropped": _changed(lambda m, c, I_c: (m, c, np.diag(I_c.diagonal()))),
        "products-sign": _changed(lambda m, c, I_c: (m, c, 2 * np.diag(I_c.diagonal()) - I_c)),
        "inertia-at-origin": _inertia_at_origin,
        "parallel-axis-sign": _parallel_axis_sign,
    },
    properties=(
        Property(
            Text(
                "it agrees with `model.inertia[1].matrix()`, entry by entry",
                "与 `model.inertia[1].matrix()` 逐元素相同",
            ),
            lambda answer, model: answer[1] - model.inertia[1].matrix(),
        ),
    ),
)

EXERCISE = Exercise(
    id="49.5.2",
    kind="explain",
    title=Text("The inertia of the base", "基座的空间惯量"),
    text=Text(
        """Take the spatial inertia of Go2's base, and compare it entry by entry with the one that you build by hand
        from (m, c, I_c).

        The chapter takes body 0 of Pinocchio's model. That is the universe, all zeros; the base is body 1. And
        `pin.Inertia.matrix()` is in the order (v, ω), so that it must be reordered before it can be compared. With
        twistwrench no reordering is needed. Give the mass as well: it is more than the 6.921 kg that the URDF has for
        the link `base`. Say why, and what would go wrong with the 6.921 kg.""",
        """取出 Go2 基座的空间惯量矩阵，与由 (m, c, I_c) 手动构造的结果逐元素比较。

        本章取的是 Pinocchio 模型的 body 0，但那是 universe，全为零；基座是 body 1。
        而且 `pin.Inertia.matrix()` 的顺序是 (v, ω)，比较之前要先重排；用 twistwrench 则不必。
        同时给出基座的质量：它比 URDF 中连杆 `base` 的 6.921 kg 大。请说明原因，以及若用 6.921 kg 会出什么错。""",
    ),
    parts=(REORDERED, OF_BASE),
    hints=(
        Text(
            "An inertia takes a twist to a momentum. If both are reordered, rows and columns of the matrix are.",
            "惯量把 twist 变成动量。两者都重排，矩阵的行和列也都要重排。",
        ),
        Text(
            "`I[np.ix_(order, order)]` picks rows and columns at once; order is 3, 4, 5, 0, 1, 2.",
            "`I[np.ix_(order, order)]` 同时选取行和列，order 为 3, 4, 5, 0, 1, 2。",
        ),
        Text(
            "The four hip rotors are joined to the base by fixed joints, 0.089 kg each. What is welded on belongs to "
            "the body that carries it.",
            "四个髋关节转子（各 0.089 kg）用固定关节装在基座上。焊接在上面的连杆属于承载它的刚体。",
        ),
    ),
    answer=Text(
        """Four rotors of 0.089 kg each, those of the hip motors, hang on the base by fixed joints. A fixed joint has no
        degree of freedom, so they move as one body with the base, and Pinocchio and twistwrench add their inertias to
        its own: 6.921 kg + 4 × 0.089 kg = 7.277 kg. The centre of mass and the inertia about it shift with them.
        With the link's own numbers the matrix still looks right: symmetric, positive definite. But RNEA would find a
        weight that is 3.5 N too small. What belongs to a body is whatever moves with it, not one tag of the file.""",
        """四个髋关节电机的转子（各 0.089 kg）用固定关节装在基座上。固定关节没有自由度，它们与基座作为一个刚体运动，
        所以 Pinocchio 和 twistwrench 把它们的惯量并入基座：6.921 kg + 4 × 0.089 kg = 7.277 kg，质心和关于质心的惯量也
        随之改变。若只用该连杆自己的数，矩阵看上去仍然对称正定，但 RNEA 得到的重力会少 3.5 N。
        属于一个刚体的是随它一起运动的全部，而不是文件中的某一个标签。""",
    ),
)
