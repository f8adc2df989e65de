"""Exercise 49.5.3: about the centre of mass, turning and moving do not mix."""

from typing import Any

import numpy as np

from ...rotation import exp3
from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import INERTIA
from ..text import Text
from ..workbook import mine
from ..wrong import swapped
from .ex_49_3_2 import plucker
from .ex_49_5_1 import random_body, spatial_inertia

__all__ = ["EXERCISE", "about_center_of_mass", "moved_inertia"]


def moved_inertia(I: Any, R: Any, p: Any) -> Any:
    """Inertia in another frame."""
    _, X_star = plucker(R, p)
    X_inverse = X_star.mT
    return X_star @ I @ X_inverse


def about_center_of_mass(m: Any, c: Any, I_c: Any) -> Any:
    """Inertia in a frame at the centre of mass."""
    build, moved = mine("spatial_inertia"), mine("moved_inertia")
    return moved(build(m, c, I_c), np.eye(3), -c)


def _skew(x: Any) -> Any:
    return np.cross(np.eye(3), x).mT


def _steiner(I: Any, R: Any, p: Any) -> Any:
    """Add m (|p|² 1 − p pᵀ) to an inertia that is not about the centre of mass."""
    moved = moved_inertia(I, R, p)
    moved[:3, :3] = R @ I[:3, :3] @ R.mT - I[5, 5] * _skew(p) @ _skew(p)
    return moved


def _cases(rng: Any) -> Any:
    return [
        (spatial_inertia(*random_body(rng)), exp3(rng.standard_normal(3)), rng.standard_normal(3)) for _ in range(4)
    ]


MOVED = Part(
    solution=moved_inertia,
    doc=Text(
        """Return the spatial inertia of a body in frame A, given in B: the parallel-axis theorem.

        I: array (6, 6), in the order (ω, v), in frame B.
        R: array (3, 3), takes coordinates in B to A. p: array (3,), m, the origin of B in A.
        `plucker(R, p)` gives X and X*, from B to A.
        Returns: array (6, 6).""",
        """已知刚体在 B 中的空间惯量，返回它在 A 中的空间惯量（平行轴定理）。

        I：数组 (6, 6)，顺序 (ω, v)，在 B 中表达。
        R：数组 (3, 3)，把 B 中坐标变到 A。p：数组 (3,)，单位 m，B 的原点在 A 中的位置。
        `plucker(R, p)` 给出从 B 到 A 的 X 和 X*。
        返回：数组 (6, 6)。""",
    ),
    returns=(Quantity("I_A", INERTIA),),
    cases=_cases,
    slips={
        "inertia-half-rotated": lambda I, R, p: plucker(R, p)[1] @ I,
        "inertia-like-motion": lambda I, R, p: plucker(R, p)[0] @ I @ np.linalg.inv(plucker(R, p)[0]),
        "inverse-transform": lambda I, R, p: plucker(R, p)[0].mT @ I @ plucker(R, p)[0],
        "transpose-for-inverse": lambda I, R, p: plucker(R, p)[1] @ I @ plucker(R, p)[0].mT,
        "motion-for-force": lambda I, R, p: plucker(R, p)[0] @ I @ plucker(R, p)[0].mT,
        "rotation-transposed": lambda I, R, p: moved_inertia(I, R.mT, p),
        "steiner-from-any-point": _steiner,
        "untransformed": lambda I, R, p: I,
    },
    properties=(
        Property(Text("the matrix is symmetric", "矩阵对称"), lambda answer, I, R, p: answer - answer.mT),
        Property(
            Text(
                "the kinetic energy is the same in both frames: XᵀI_A X = I_B",
                "两个坐标系中动能相同：XᵀI_A X = I_B",
            ),
            lambda answer, I, R, p: plucker(R, p)[0].mT @ answer @ plucker(R, p)[0] - I,
        ),
    ),
)

AT_COM = Part(
    solution=about_center_of_mass,
    doc=Text(
        """Return the inertia of a body in a frame at its centre of mass, with the same axes.

        Build it about the origin first, then move it: the result must come out, not be put in.
        m: number, kg. c: array (3,), m. I_c: array (3, 3), kg m², about the centre of mass.
        build(m, c, I_c) is your `spatial_inertia`, moved(I, R, p) your `moved_inertia`.
        Returns: array (6, 6), in the order (ω, v).""",
        """返回刚体在质心坐标系（坐标轴方向不变）中的空间惯量。

        先构造关于原点的惯量，再移到质心：结果应当算出来，而不是直接写出来。
        m：数，kg。c：数组 (3,)，单位 m。I_c：数组 (3, 3)，kg m²，关于质心。
        build(m, c, I_c) 是你的 `spatial_inertia`，moved(I, R, p) 是你的 `moved_inertia`。
        返回：数组 (6, 6)，顺序 (ω, v)。""",
    ),
    given='build, moved = mine("spatial_inertia"), mine("moved_inertia")',
    returns=(Quantity("I", INERTIA),),
    cases=lambda rng: [random_body(rng) for _ in range(4)],
    slips={
        "translation-sign": lambda m, c, I_c: moved_inertia(spatial_inertia(m, c, I_c), np.eye(3), c),
        "untransformed": spatial_inertia,
        "steiner-from-any-point": lambda m, c, I_c: spatial_inertia(m, 0 * c, I_c - 2 * m * _skew(c) @ _skew(c)),
        "parallel-axis-dropped": lambda m, c, I_c: spatial_inertia(m, 0 * c, I_c - m * _skew(c) @ _skew(c)),
        "mass-dropped": lambda m, c, I_c: spatial_inertia(1.0, 0 * c, I_c),
        "swapped-halves": lambda m, c, I_c: swapped(spatial_inertia)(m, 0 * c, I_c),
    },
    reasons={
        "translation-sign": Text(
            "p is the origin of the old frame as the new one sees it: from the centre of mass that is −c.",
            "p 是旧坐标系原点在新坐标系中的位置：从质心看是 −c。",
        ),
        "parallel-axis-dropped": Text(
            "About the centre of mass the parallel-axis term is gone again: what is left is I_c.",
            "关于质心时平行轴项又消去：剩下的是 I_c。",
        ),
    },
    properties=(
        Property(
            Text("the blocks off the diagonal are zero", "非对角块为零"),
            lambda answer, m, c, I_c: (answer[:3, 3:], answer[3:, :3]),
        ),
    ),
)

EXERCISE = Exercise(
    id="49.5.3",
    kind="prove",
    uses=("plucker",),
    title=Text("The frame in which turning and moving do not mix", "转动与平动解耦的坐标系"),
    text=Text(
        """Prove that the spatial inertia is blkdiag(I_c, m 1) when the origin of the frame is the centre of mass.

        See it happen first: write the change of frame of an inertia, I_A = X* I_B X⁻¹, and take bodies whose centre
        of mass is elsewhere to a frame where it is in the origin. Then write the proof, and say what it
        means that the two are decoupled.""",
        """证明：当坐标系原点在质心时，空间惯量矩阵是 blkdiag(I_c, m 1)。

        先做数值实验：写出惯量的坐标变换 I_A = X* I_B X⁻¹，把质心不在原点的刚体变到原点在质心的坐标系。
        然后写出证明，并说明“解耦”意味着什么。""",
    ),
    parts=(MOVED, AT_COM),
    hints=(
        Text(
            "X⁻¹ need not be computed by a solver: X* = X⁻ᵀ, so X⁻¹ is the transpose of X*.",
            "X⁻¹ 不必用求逆函数：X* = X⁻ᵀ，所以 X⁻¹ 就是 X* 的转置。",
        ),
        Text(
            "Frame A has its origin at c. Seen from there, the old origin is at −c.",
            "A 的原点在 c 处。从那里看，旧原点位于 −c。",
        ),
        Text(
            "For the proof put c = 0 into the block matrix. For what it means, write the momentum I V half by half.",
            "证明：在分块矩阵中令 c = 0。含义：把动量 I V 按上下两半写出来。",
        ),
    ),
    answer=Text(
        """In any frame I = [[I_c − m [c]×², m [c]×], [−m [c]×, m 1]]. With the origin in the centre of mass c = 0, so
        [c]× = 0, and what is left is blkdiag(I_c, m 1). The same comes out by moving: with p = −c, X* I X⁻¹ takes the
        block top right to m [c]× − m [c]× = 0, and the one top left to I_c − m [c]×² + m [c]×² = I_c.

        The momentum is then (I_c ω, m v): the angular half depends on ω only, the linear half on v only, and the
        kinetic energy falls into ½ ωᵀI_c ω + ½ m v², without a term that has both. Anywhere else a body that only
        turns has a linear momentum as well, since its centre of mass moves. The equations of motion split the same
        way, into Euler's and Newton's: ω × m v is left, but that comes from the turning axes, not from the inertia.""",
        """任意坐标系中 I = [[I_c − m [c]×², m [c]×], [−m [c]×, m 1]]。原点取在质心时 c = 0，[c]× = 0，剩下
        blkdiag(I_c, m 1)。也可由变换得到：取 p = −c，X* I X⁻¹ 的右上块为 m [c]× − m [c]× = 0，
        左上块为 I_c − m [c]×² + m [c]×² = I_c。

        此时动量是 (I_c ω, m v)：角动量只与 ω 有关，线动量只与 v 有关；动能分成 ½ ωᵀI_c ω + ½ m v²，没有交叉项。
        换成别的参考点，只转动的刚体也有线动量，因为它的质心在动。运动方程同样分成欧拉方程和牛顿方程；
        剩下的 ω × m v 来自转动的坐标轴，而不是来自惯量。""",
    ),
)
