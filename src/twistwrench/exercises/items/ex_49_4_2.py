"""Exercise 49.4.2: a point contact, seen from the world."""

from typing import Any

import numpy as np

import twistwrench as tw

from ...rotation import exp3
from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import WRENCH
from ..text import Text
from ..wrong import swapped
from .ex_49_3_2 import plucker

__all__ = ["EXERCISE", "contact_wrench"]


def contact_wrench(R: Any, p: Any, f_c: Any) -> Any:
    """Wrench of a point contact in the world, by vectors and by X*."""
    f = R @ f_c
    by_vectors = np.concatenate([np.cross(p, f), f])
    _, X_star = plucker(R, p)
    by_matrix = X_star @ np.concatenate([np.zeros(3), f_c])
    return by_vectors, by_matrix


def _vectors(moment: Any, force: Any, R: Any, p: Any, f_c: Any) -> Any:
    """Put other vectors into the first answer."""
    return np.concatenate([moment, force]), contact_wrench(R, p, f_c)[1]


def _matrix(X: Any, R: Any, p: Any, f_c: Any) -> Any:
    """Use another matrix for the second answer."""
    return contact_wrench(R, p, f_c)[0], X @ np.concatenate([np.zeros(3), f_c])


def _cases(rng: Any) -> Any:
    return [(exp3(rng.standard_normal(3)), *rng.standard_normal((2, 3))) for _ in range(5)]


def _power(answer: Any, R: Any, p: Any, f_c: Any) -> Any:
    """Return by how much the power on some twists differs between the frames."""
    V_contact = np.arange(36.0).reshape(6, 6) % 7 - 3
    V_world = V_contact @ tw.motion_transform(R, p).mT
    return answer[0] @ V_world.mT - f_c @ V_contact[:, 3:].mT


WRENCH_OF_CONTACT = Part(
    solution=contact_wrench,
    doc=Text(
        """Return the wrench of a point contact in the world frame, computed in two ways.

        R: array (3, 3), takes coordinates in the contact frame to the world.
        p: array (3,), m, the contact point in the world.
        f_c: array (3,), N, the force in the contact frame, which has no moment about the contact.
        Returns: two arrays (6,), (τ, f), N m and N. First by vectors, with a cross product; then as
        X* times the wrench (0, f_c). `plucker(R, p)` gives X and X*.""",
        """用两种方法返回点接触的 wrench 在世界坐标系中的表达。

        R：数组 (3, 3)，把接触坐标系中的坐标变到世界。
        p：数组 (3,)，单位 m，接触点在世界中的位置。
        f_c：数组 (3,)，N，接触坐标系中的力；对接触点没有力矩。
        返回：两个数组 (6,)，(τ, f)，N m 与 N。第一个用向量和叉积写出；
        第二个用 X* 乘以 wrench (0, f_c)。`plucker(R, p)` 给出 X 和 X*。""",
    ),
    returns=(Quantity("F by vectors", WRENCH), Quantity("F by X*", WRENCH)),
    cases=_cases,
    slips={
        "coupling-dropped": lambda R, p, f_c: _vectors(np.zeros(3), R @ f_c, R, p, f_c),
        "cross-order": lambda R, p, f_c: _vectors(np.cross(R @ f_c, p), R @ f_c, R, p, f_c),
        "coupling-order": lambda R, p, f_c: _vectors(R @ np.cross(p, f_c), R @ f_c, R, p, f_c),
        "coupling-unrotated": lambda R, p, f_c: _vectors(np.cross(p, f_c), R @ f_c, R, p, f_c),
        "rotation-transposed": lambda R, p, f_c: contact_wrench(R.mT, p, f_c),
        "untransformed": lambda R, p, f_c: (np.concatenate([np.zeros(3), f_c]),) * 2,
        "swapped-halves": swapped(contact_wrench),
        "motion-for-force": lambda R, p, f_c: _matrix(plucker(R, p)[0], R, p, f_c),
        "transpose-for-dual": lambda R, p, f_c: _matrix(plucker(R, p)[0].mT, R, p, f_c),
        "inverse-transform": lambda R, p, f_c: contact_wrench(R.mT, -R.mT @ p, f_c),
        "inverse-unrotated": lambda R, p, f_c: contact_wrench(R.mT, -p, f_c),
    },
    properties=(
        Property(
            Text("both ways give the same wrench", "两种方法结果相同"),
            lambda answer, R, p, f_c: answer[0] - answer[1],
        ),
        Property(
            Text(
                "the moment is at right angles to the force: a pure force has a screw without pitch",
                "力矩垂直于力：纯力的螺距为零",
            ),
            lambda answer, R, p, f_c: answer[0][:3] @ answer[0][3:],
        ),
        Property(
            Text("the moment about the contact point is zero: τ − p × f = 0", "对接触点的力矩为零：τ − p × f = 0"),
            lambda answer, R, p, f_c: answer[1][:3] - np.cross(p, answer[1][3:]),
        ),
        Property(Text("the power FᵀV is the same in both frames", "功率 FᵀV 在两个坐标系中相同"), _power),
    ),
)

EXERCISE = Exercise(
    id="49.4.2",
    kind="prove",
    uses=("plucker",),
    title=Text("Where does the moment come from?", "力矩从哪里来"),
    text=Text(
        """A point contact has no moment about the contact point: in the frame of the contact its wrench is (0, f_c).
        In the frame of the world the moment is not zero any more. Compute it, once with vectors and once with X*.
        Then derive τ_W = p × (R f_c) in words and formulas, and say why there is a moment now although nobody has
        added one.""",
        """点接触对接触点没有力矩：在接触坐标系中它的 wrench 是 (0, f_c)。变到世界坐标系后，力矩一般不再为零。
        用向量算一次，再用 X* 算一次。
        然后用文字加公式推导 τ_W = p × (R f_c)，并说明：没有人施加力矩，为什么现在有了力矩？""",
    ),
    parts=(WRENCH_OF_CONTACT,),
    hints=(
        Text(
            "A moment is always about a point. Which point is it before, and which afterwards?",
            "力矩总是对某一点而言的。变换前是哪一点？变换后是哪一点？",
        ),
        Text(
            "Turn the force into the axes of the world first: f = R f_c. Then take its moment about the origin, p × f.",
            "先把力变到世界坐标轴：f = R f_c；再对原点取矩：p × f。",
        ),
        Text(
            "X* = [[R, [p]× R], [0, R]]. Multiply it by (0, f_c), block by block.",
            "X* = [[R, [p]× R], [0, R]]。按块乘以 (0, f_c)。",
        ),
    ),
    answer=Text(
        """X* (0, f_c) = ([p]× R f_c, R f_c), so that f_W = R f_c and τ_W = R·0 + p × (R f_c).

        The moment in a wrench is the moment about the origin of its frame. In the contact frame that is the contact
        point, through which the force passes: no lever arm, no moment. In the world it is the world's origin, and p
        is the lever arm from there to the line of the force. The wrench is the same one, the push on the body too;
        what has changed is the point about which the moment is counted. Seen the other way round: a pure force has
        τ_W at right angles to f_W, and its moment vanishes about every point of its line. A wrench with τ·f ≠ 0 has
        no such line: it has a pitch.""",
        """X* (0, f_c) = ([p]× R f_c, R f_c)，即 f_W = R f_c，τ_W = R·0 + p × (R f_c)。

        wrench 中的力矩是对所在坐标系原点的力矩。在接触坐标系中，原点就是接触点，力通过它，没有力臂，也就没有力矩；
        在世界坐标系中，参考点移到了世界原点，p 就是从那里到力作用线的力臂。wrench 还是同一个，对刚体的作用也相同，
        变的只是取矩的点。反过来看：纯力满足 τ_W ⊥ f_W，对其作用线上任意一点力矩都为零；若 τ·f ≠ 0，
        就不存在这样的直线，此时螺距不为零。""",
    ),
)
