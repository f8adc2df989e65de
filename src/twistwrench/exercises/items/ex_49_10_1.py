"""Exercise 49.10.1: the blocks of the centroidal momentum matrix."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import CENTROIDAL_MAP, INERTIA
from ..robots import robot, small_robot
from ..text import Text
from ..wrong import swapped

__all__ = ["EXERCISE", "base_columns", "split_map"]


def split_map(model: Any, q: Any) -> Any:
    """Split A_G into its columns for the base and for the joints."""
    A_G = tw.centroidal_map(model, q)
    return A_G[:, :6], A_G[:, 6:]


def base_columns(R: Any, m: Any, c: Any, I_G: Any) -> Any:
    """A_G's columns for the base, from the robot as one rigid body."""
    return np.block([[R @ I_G, np.zeros((3, 3))], [-m * tw.skew(c) @ R, m * R]])


def _blocks(change: Any) -> Any:
    """Change A_G before it is split."""

    def wrong(model: Any, q: Any) -> Any:
        A_G = change(model, q, tw.centroidal_map(model, q))
        return A_G[:, :6], A_G[:, 6:]

    return wrong


def _about(point: Any) -> Any:
    """Take the angular momentum about another point: it gains (p_G − point) × l."""

    def change(model: Any, q: Any, A_G: Any) -> Any:
        arm = tw.skew(tw.center_of_mass(model, q) - point(q))
        return np.concatenate([A_G[:3] + arm @ A_G[3:], A_G[3:]])

    return _blocks(change)


def _at(places: Any) -> Any:
    """Cut A_G at other places."""

    def wrong(model: Any, q: Any) -> Any:
        A_G = tw.centroidal_map(model, q)
        base, joints = places
        return A_G[:, base], A_G[:, joints]

    return wrong


def _exchanged(*, rows: bool, columns: bool) -> Any:
    """Exchange the halves of the rows, of the base's columns, or of both."""
    order = [k + 3 if k < 3 else k - 3 for k in range(6)]

    def wrong(model: Any, q: Any) -> Any:
        base, joints = split_map(model, q)
        if rows:
            base, joints = base[order], joints[order]
        return (base[:, order] if columns else base), joints

    return wrong


def _quarters(change: Any) -> Any:
    """Put other things in the quarters, given R, m, [c]× and I_G."""
    return lambda R, m, c, I_G: np.block(change(R, m, tw.skew(c), I_G))


ZERO = np.zeros((3, 3))


def _bodies(rng: Any) -> Any:
    bodies = []
    for model in (robot("go2"), small_robot(rng), small_robot(rng)):
        q = model.random_configuration(rng=rng)
        T = tw.forward_kinematics(model, q).placement[1]
        whole = tw.SpatialInertia.from_matrix(tw.crba(model, q)[:6, :6])
        bodies.append((T.rotation, float(whole.mass), T.rotation @ whole.com, whole.inertia_at_com))
    return bodies


SPLIT = Part(
    solution=split_map,
    doc=Text(
        """Return the two parts of A_G: the columns of the base and those of the joints.

        model: one with a floating base. q: array (nq,). `tw.centroidal_map(model, q)` is A_G.
        (From Pinocchio: exchange the halves of the rows, and those of the base's columns.)
        Returns: arrays (6, 6) and (6, nv − 6), rows (k, l); the base's columns are (ω, v).""",
        """返回 A_G 的两部分：基座的列和关节的列。

        model：浮动基座模型。q：数组 (nq,)。`tw.centroidal_map(model, q)` 即 A_G。
        （若用 Pinocchio，需把行的两半、基座列的两半分别交换。）
        返回：数组 (6, 6) 和 (6, nv − 6)，行 (k, l)，基座的列为 (ω, v)。""",
    ),
    returns=(Quantity("A_Gb", INERTIA), Quantity("A_Gj", CENTROIDAL_MAP)),
    cases=lambda rng: [
        (model, model.random_configuration(rng=rng)) for model in (robot("go2"), small_robot(rng), small_robot(rng))
    ],
    slips={
        "swapped-halves": _exchanged(rows=True, columns=True),
        "rows-only": _exchanged(rows=True, columns=False),
        "columns-only": _exchanged(rows=False, columns=True),
        "momentum-at-origin": _about(lambda q: np.zeros(3)),
        "momentum-at-base": _about(lambda q: q[:3]),
        "nq-for-nv": _at((slice(0, 7), slice(7, None))),
        "base-last": _at((slice(-6, None), slice(0, -6))),
        "transposed-answer": lambda model, q: tuple(block.mT for block in split_map(model, q)),
    },
    properties=(
        Property(
            Text(
                "moving the base makes no angular momentum about the centre of mass", "平动基座不产生关于质心的角动量"
            ),
            lambda answer, model, q: answer[0][:3, 3:],
        ),
    ),
)

COLUMNS = Part(
    solution=base_columns,
    doc=Text(
        """Return the base's columns of A_G, from the robot as one rigid body: with still joints it is
        one.

        R: array (3, 3), from the base's axes to the world's. m: number, kg, of the whole robot.
        c: array (3,), m, p_G − p_base, in the axes of the world.
        I_G: array (3, 3), kg m², of the whole robot about its centre of mass, in the axes of the
        base.
        Returns: array (6, 6), rows (k, l) along the world's axes, columns (ω, v) of the base along
        its own.""",
        """返回 A_G 中基座的列；关节不动时整机是一个刚体，由此构造。

        R：数组 (3, 3)，从基座坐标轴到世界坐标轴。m：数，kg，整机质量。
        c：数组 (3,)，单位 m，p_G − p_基座，用世界坐标轴。
        I_G：数组 (3, 3)，kg m²，整机关于质心的惯量，用基座坐标轴。
        返回：数组 (6, 6)，行 (k, l) 用世界坐标轴，列为基座的 (ω, v)，用基座自身坐标轴。""",
    ),
    returns=(Quantity("A_Gb", INERTIA),),
    cases=_bodies,
    slips={
        "com-dropped": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [ZERO, m * R]]),
        "com-sign": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [m * c @ R, m * R]]),
        "coupling-corner": _quarters(lambda R, m, c, I: [[R @ I, m * c @ R], [ZERO, m * R]]),
        "coupling-order": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [-m * R @ c, m * R]]),
        "coupling-unrotated": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [-m * c, m * R]]),
        "mass-dropped": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [-c @ R, R]]),
        "untransformed": _quarters(lambda R, m, c, I: [[I, ZERO], [-m * c, m * np.eye(3)]]),
        "half-rotated": _quarters(lambda R, m, c, I: [[R @ I, ZERO], [-m * c @ R, m * np.eye(3)]]),
        "rotation-transposed": _quarters(lambda R, m, c, I: [[R.mT @ I, ZERO], [-m * c @ R.mT, m * R.mT]]),
        "turned-twice": _quarters(lambda R, m, c, I: [[R @ I @ R.mT, ZERO], [-m * c @ R, m * R]]),
        "momentum-at-base": _quarters(lambda R, m, c, I: [[R @ I - m * c @ c @ R, m * c @ R], [-m * c @ R, m * R]]),
        "swapped-halves": swapped(base_columns),
    },
    properties=(
        Property(
            Text(
                "moving the base makes no angular momentum about the centre of mass", "平动基座不产生关于质心的角动量"
            ),
            lambda answer, R, m, c, I_G: answer[:3, 3:],
        ),
        Property(
            Text("l = m v_G, with v_G = R v + R ω × c", "l = m v_G，其中 v_G = R v + R ω × c"),
            lambda answer, R, m, c, I_G: [
                answer[3:] @ V - m * (R @ V[3:] + np.cross(R @ V[:3], c))
                for V in np.random.default_rng(0).standard_normal((3, 6))
            ],
        ),
    ),
)

EXERCISE = Exercise(
    id="49.10.1",
    kind="explain",
    title=Text("The blocks of A_G", "A_G 的分块"),
    text=Text(
        """Compute the centroidal momentum matrix A_G of Go2, check that it is 6 × 18, and split it into the columns
        of the base and those of the joints, A_G = (A_Gb, A_Gj). Build A_Gb once more from four things that are known
        of the robot as one rigid body. Which of its four quarters is zero in every posture, and why? What does it
        look like where Go2 stands level?""",
        """计算 Go2 的质心动量矩阵 A_G，确认它是 6 × 18，并按基座列和关节列分块：A_G = (A_Gb, A_Gj)。
        再由整机作为一个刚体的四个量重新构造 A_Gb。它的四个块中哪一块在任何位形下都为零，为什么？
        Go2 水平站立时它是什么样子？""",
    ),
    parts=(SPLIT, COLUMNS),
    hints=(
        Text("The base comes first in v: six columns.", "v 中基座在前：六列。"),
        Text(
            "Let the base turn with ω and move with v, both in its own axes. Write down the velocity of the centre of "
            "mass and the angular momentum about it, in the axes of the world.",
            "设基座以 ω 转动、以 v 平动（用自身坐标轴）。写出质心速度和关于质心的角动量，用世界坐标轴。",
        ),
        Text(
            "k = R I_G ω, and l = m (R v + R ω × c) = m R v − m [c]× R ω.",
            "k = R I_G ω；线动量 l = m (R v + R ω × c) = m R v − m [c]× R ω。",
        ),
    ),
    answer=Text(
        """With still joints the robot is one rigid body, so A_Gb = [R I_G, 0; −m [c]× R, m R]. The upper right
        quarter is zero in every posture: a body that only moves has no angular momentum about its own centre of
        mass. The lower right one is the mass times a rotation, the lower left one says that the centre of mass moves
        when the base turns about its own origin, and the upper left one is the inertia of the whole robot, about its
        centre of mass. Where Go2 stands level, R = 1: then l = 16.085 kg · v, the diagonal of I_G is (0.166, 0.501,
        0.562) kg m², and m [c]× is small, since c = (−2, 0, −18) mm. It is M_bb seen from the centre of mass: A_Gb =
        X* M_bb.""",
        """关节不动时整机是一个刚体，所以 A_Gb = [R I_G, 0; −m [c]× R, m R]。右上块在任何位形下都为零：
        只平动的刚体关于自身质心没有角动量。右下块是质量乘旋转；左下块表示基座绕自身原点转动时质心也在动；
        左上块是整机关于质心的惯量。Go2 水平站立时 R = 1：l = 16.085 kg · v，I_G 的对角线为
        (0.166, 0.501, 0.562) kg m²，c = (−2, 0, −18) mm，所以 m [c]× 很小。它就是从质心看的 M_bb：A_Gb = X* M_bb。""",
    ),
)
