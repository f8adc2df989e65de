"""Exercise 49.8.1: the base's block of the mass matrix."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import INERTIA
from ..robots import robot
from ..text import Text
from ..wrong import after, before, swap, swapped

__all__ = ["EXERCISE", "base_block", "whole_robot"]


def base_block(model: Any, q: Any) -> Any:
    """Inertia of all bodies together, about the base's origin."""
    placement = tw.forward_kinematics(model, q).placement
    base = placement[1].inverse()
    block = np.zeros((6, 6))
    for body, T in zip(model.inertia, placement):
        block = block + body.transform(base @ T).matrix()
    return block


def whole_robot(block: Any) -> Any:
    """Mass, centre of mass and inertia about it, out of a spatial inertia."""
    m = block[3, 3]
    c = tw.unskew(block[:3, 3:]) / m
    return m, c, block[:3, :3] + m * tw.skew(c) @ tw.skew(c)


def _summed(moved: Any) -> Any:
    """Sum over the bodies what becomes of a body's inertia, given its placement in the base and in the world."""

    def wrong(model: Any, q: Any) -> Any:
        placement = tw.forward_kinematics(model, q).placement
        bodies = zip(model.inertia[1:], placement[1:])
        return sum(moved(body, placement[1].inverse() @ T, T, placement[1]) for body, T in bodies)

    return wrong


def _about_the_origin(T: Any, base: Any) -> Any:
    """Return a placement seen from a frame at the base with the axes of the world."""
    return tw.SE3(T.rotation, T.translation - base.translation)


def _parts(change: Any) -> Any:
    """Rebuild the block from its four quarters: I, the coupling m [c]×, its negative, m·1."""

    def wrong(model: Any, q: Any) -> Any:
        block = base_block(model, q)
        return np.block(change(block[:3, :3], block[:3, 3:], block[3:, 3:]))

    return wrong


def _moved(I_c: Any) -> Any:
    """Return whole_robot with another inertia about the centre of mass."""

    def wrong(block: Any) -> Any:
        m, c, _ = whole_robot(block)
        return m, c, I_c(block[:3, :3], m, c)

    return wrong


def _cases(rng: Any) -> Any:
    model, tree = robot("go2"), tw.random_tree(5, rng=rng, base="floating")
    return [
        (model, model.neutral()),
        (model, model.random_configuration(rng=rng)),
        (tree, tree.random_configuration(rng=rng)),
    ]


BLOCK = Part(
    solution=base_block,
    doc=Text(
        """Return the base's block of M(q), without M: the inertia of all bodies, moved into the base's
        frame.

        model: one with a floating base, as `tw.load("go2")`. q: array (nq,).
        `tw.forward_kinematics(model, q).placement` holds the placement of each body in the world;
        the base is body 1. `model.inertia` holds the inertia of each body in its own frame; both
        begin with the world's.
        Returns: array (6, 6), rows (k, l), columns (ω, v), about the base's origin, in its axes; SI
        units.""",
        """不经 M 返回 M(q) 的基座块：把所有刚体的惯量变到基座坐标系再相加。

        model：带浮动基座的模型，如 `tw.load("go2")`。q：数组 (nq,)。
        `tw.forward_kinematics(model, q).placement` 是各刚体在世界中的位姿，基座是第 1 个；
        `model.inertia` 是各刚体在自身坐标系中的惯量。两者的第 0 项都是世界。
        返回：数组 (6, 6)，行 (k, l)，列 (ω, v)，对基座原点、用基座坐标轴；国际单位。""",
    ),
    returns=(Quantity("M_bb", INERTIA),),
    cases=_cases,
    slips={
        "legs-left-out": lambda model, q: model.inertia[1].matrix(),
        "untransformed": _summed(lambda body, T, world, base: body.matrix()),
        "world-for-local": _summed(lambda body, T, world, base: body.transform(world).matrix()),
        "aligned-for-local": _summed(
            lambda body, T, world, base: body.transform(_about_the_origin(world, base)).matrix()
        ),
        "inverse-transform": _summed(lambda body, T, world, base: body.transform(T.inverse()).matrix()),
        "inertia-like-motion": _summed(
            lambda body, T, world, base: T.motion_transform() @ body.matrix() @ T.inverse().motion_transform()
        ),
        "inertia-half-rotated": _summed(lambda body, T, world, base: T.force_transform() @ body.matrix()),
        "parallel-axis-dropped": _parts(
            lambda I, mc, m: [[I + mc @ mc / m[0, 0], mc], [-mc, m]],
        ),
        "com-dropped": _parts(lambda I, mc, m: [[I, 0 * mc], [0 * mc, m]]),
        "com-sign": _parts(lambda I, mc, m: [[I, -mc], [mc, m]]),
        "inertia-asymmetric": _parts(lambda I, mc, m: [[I, mc], [mc, m]]),
        "swapped-halves": swapped(base_block),
        "one-triangle": after(base_block, np.triu),
        "doubled-off-diagonal": after(base_block, lambda M: M + M.mT - np.diag(np.diag(M))),
    },
    reasons={
        "untransformed": Text(
            "Inertias add up in one frame only: bring each into the base's frame by `body.transform`.",
            "只有同一坐标系中的惯量才能相加：先用 `body.transform` 变到基座坐标系。",
        ),
        "world-for-local": Text(
            "T places a body in the world, base @ T in the base. M_bb is seen from the base.",
            "T 是物体在世界中的位姿，base @ T 是在基座中的位姿；M_bb 是从基座看的。",
        ),
        "aligned-for-local": Text(
            "The point is right, the axes are not: place the bodies in the base, base @ T.",
            "参考点对，坐标轴不对：应取物体在基座中的位姿 base @ T。",
        ),
        "inverse-transform": Text(
            "base @ T places the body in the base; its inverse places the base in the body.",
            "base @ T 是物体在基座中的位姿；它的逆是基座在物体中的位姿。",
        ),
    },
    properties=(
        Property(Text("it is symmetric", "对称"), lambda answer, model, q: answer - answer.mT),
        Property(
            Text("the mass of all bodies stands in the linear block", "线性块是全部刚体的质量乘单位阵"),
            lambda answer, model, q: answer[3:, 3:] - model.mass * np.eye(3),
        ),
        Property(
            Text(
                "½ VᵀM_bb V is the energy of the robot moving as one rigid body",
                "½ VᵀM_bb V 是整机作为一个刚体运动时的动能",
            ),
            lambda answer, model, q: [
                V @ answer @ V / 2
                - tw.newton_euler_3d.kinetic_energy(model, q, np.concatenate([V, np.zeros(model.nv - 6)]))
                for V in np.random.default_rng(0).standard_normal((3, 6))
            ],
        ),
    ),
)

WHOLE = Part(
    solution=whole_robot,
    doc=Text(
        """Return the mass of the robot, its centre of mass, and its inertia about that, as one rigid
        body.

        block: array (6, 6), the base's block of M, rows (k, l), columns (ω, v).
        Returns: a number m, kg; an array c (3,), m, from the base's origin, in its axes; an array
        I_c (3, 3), kg m², about the centre of mass.""",
        """返回整机作为一个刚体的质量、质心和关于质心的惯量。

        block：数组 (6, 6)，M 的基座块，行 (k, l)，列 (ω, v)。
        返回：数 m，kg；数组 c (3,)，单位 m，从基座原点量起，用基座坐标轴；数组 I_c (3, 3)，kg m²，关
        于质心。""",
    ),
    returns=(Quantity("m", unit="kg"), Quantity("c", unit="m"), Quantity("I_c", unit="kg m²")),
    cases=lambda rng: [(base_block(*case),) for case in _cases(rng)],
    slips={
        "mass-dropped": lambda block: (block[3, 3], tw.unskew(block[:3, 3:]), whole_robot(block)[2]),
        "com-sign": lambda block: (block[3, 3], -whole_robot(block)[1], whole_robot(block)[2]),
        "parallel-axis-sign": _moved(lambda I, m, c: I - m * tw.skew(c) @ tw.skew(c)),
        "parallel-axis-dropped": _moved(lambda I, m, c: I),
        "parallel-axis-all": _moved(lambda I, m, c: I - m * (c @ c) * np.eye(3)),
        "parallel-axis-outer": _moved(lambda I, m, c: I - m * np.outer(c, c)),
        "swapped-halves": before(whole_robot, swap, which=0),
    },
    reasons={
        "mass-dropped": Text("The block holds m [c]×: divide by m.", "块中是 m [c]×：要除以 m。"),
        "com-sign": Text(
            "The block top right is +m [c]×, that bottom left −m [c]×.", "右上块是 +m [c]×，左下块是 −m [c]×。"
        ),
        "parallel-axis-sign": Text(
            "The block holds the inertia about the origin, I_O = I_c − m [c]×². Solved for I_c the sign is a plus: "
            "I_c = I_O + m [c]×², and [c]×² is negative, so I_c is the smaller one.",
            "块中是关于原点的惯量 I_O = I_c − m [c]×²。解出 I_c 时是加号：I_c = I_O + m [c]×²；"
            "[c]×² 是负半定的，所以 I_c 较小。",
        ),
        "parallel-axis-dropped": Text(
            "The block holds the inertia about the origin. About the centre of mass it is less: I_c = I_O + m [c]×².",
            "块中是关于原点的惯量；关于质心的较小：I_c = I_O + m [c]×²。",
        ),
        "parallel-axis-all": Text(
            "Turning about the line through both points moves no mass: take off m (|c|² 1 − c cᵀ), not m |c|² 1.",
            "绕两点连线转动时质量不移动：应减去 m (|c|² 1 − c cᵀ)，而不是 m |c|² 1。",
        ),
        "parallel-axis-outer": Text(
            "Taken off is m (|c|² 1 − c cᵀ): what counts is the distance from the axis.",
            "应减去 m (|c|² 1 − c cᵀ)：起作用的是到轴的距离。",
        ),
    },
    properties=(
        Property(
            Text("put together again they give the block", "重新组装应得到原来的块"),
            lambda answer, block: tw.SpatialInertia(*answer).matrix() - block,
        ),
    ),
)

EXERCISE = Exercise(
    id="49.8.1",
    kind="explain",
    title=Text("The base's block of M", "M 的基座块"),
    text=Text(
        """Look at the upper left 6 × 6 block of Go2's M(q) in the neutral posture, `tw.crba(model, q)[:6, :6]`.
        Build it from the inertias of the bodies, without M. Then read the robot's mass, its centre of mass and its
        inertia about that off the block, and explain why the block is not diagonal.

        The chapter gives the answer in its question: the base's inertia depends on the centre of mass. Two things to
        mend. It is not the inertia of the base, and the centre of mass is only one of two reasons. (Pinocchio's
        block has the order (v, ω): m·1 stands at the top left there.)""",
        """查看 Go2 零位形下 M(q) 左上角的 6 × 6 块 `tw.crba(model, q)[:6, :6]`。不经 M，由各刚体的惯量构造它；
        再从这个块读出整机的质量、质心和关于质心的惯量，并解释它为什么不是对角的。

        本章在题目中已给出答案：基座的惯量与质心位置有关。这里要更正两点：这不是基座的惯量；质心位置也只是两个原因之一。
        （Pinocchio 的块按 (v, ω) 排列：左上角是 m·1。）""",
    ),
    parts=(BLOCK, WHOLE),
    hints=(
        Text(
            "With all joints still, moving the base moves the robot as one rigid body. Which inertia has that body?",
            "关节都不动、只有基座运动时，整机像一个刚体。这个刚体的惯量是什么？",
        ),
        Text(
            """`base = placement[1].inverse()` takes the world to the base; `body.transform(base @ T)` is a body's
            inertia in the base's frame. Inertias in one frame add up.""",
            """`base = placement[1].inverse()` 把世界变到基座；`body.transform(base @ T)` 是该刚体在基座坐标系中的惯量。
            同一坐标系中的惯量直接相加。""",
        ),
        Text(
            "The four quarters are I_c − m [c]×², m [c]×, −m [c]× and m·1. `tw.unskew` reads c off.",
            "四个块是 I_c − m [c]×²、m [c]×、−m [c]× 和 m·1。用 `tw.unskew` 读出 c。",
        ),
    ),
    answer=Text(
        """Moving the base with still joints moves the whole robot as one rigid body. So the block is the spatial
        inertia of all 16.085 kg about the base's origin, the composite inertia I^C of body 1; the base alone has
        7.277 kg. It has two kinds of entries off the diagonal. First the coupling m [c]×: the robot's centre of mass
        is not at the base's origin, in the neutral posture c = (8, 0, −28) mm, so that turning the base gives the robot
        linear momentum. This would vanish with another origin. Second the products of inertia: the axes of the base are
        not the principal axes of the whole (0.0017 kg m² between x and z). They stay even where c = 0. The linear part,
        m·1, is diagonal in every posture.""",
        """关节不动时推动基座，整机像一个刚体一起运动。所以这个块是全部 16.085 kg 关于基座原点的空间惯量，
        即第 1 个物体的复合惯量 I^C；基座自身只有 7.277 kg。非对角元素有两类：其一是耦合项 m [c]×，
        因为整机质心不在基座原点（零位形下 c = (8, 0, −28) mm），转动基座会带来线动量，换一个原点它就消失；
        其二是惯性积：基座坐标轴不是整机的主轴（x、z 之间为 0.0017 kg m²），即使 c = 0 也不为零。
        线性部分 m·1 在任何位形下都是对角的。""",
    ),
)
