"""The project, stage 2: the whole-body dynamics."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import JOINT_SPACE
from ..robots import robot, small_robot
from ..text import Text
from .project_aba import ABA
from .project_crba import CRBA
from .project_rnea import ENERGY, RNEA

__all__ = ["EXERCISE", "accelerated", "rows_of_foot"]


def rows_of_foot(J: Any, R: Any, r: Any) -> Any:
    """Contact rows of a foot, out of the Jacobian of the body that carries it."""
    return R @ (J[3:] - tw.skew(r) @ J[:3])


def accelerated(M: Any, h: Any, S: Any, J_c: Any, tau: Any, forces: Any) -> Any:
    """Accelerations under torques and contact forces."""
    return np.linalg.solve(M, S.mT @ tau + J_c.mT @ forces - h)


def _feet(rng: Any) -> Any:
    model, cases = robot("go2"), []
    for foot in ("FL_foot", "RR_foot"):
        q, frame = model.random_configuration(rng=rng), model.frame(foot)
        T = tw.forward_kinematics(model, q).placement[frame.body]
        J = tw.frame_jacobian(model, q, model.joint_names[frame.body])
        cases.append((J, T.rotation, np.array(frame.placement.translation)))
    other = small_robot(rng)
    q = other.random_configuration(rng=rng)
    R = tw.forward_kinematics(other, q).placement[3].rotation
    return [*cases, (tw.frame_jacobian(other, q, other.joint_names[3]), R, rng.standard_normal(3))]


def _equations(rng: Any) -> Any:
    model, cases = robot("go2"), []
    for _ in range(2):
        q, v = model.random_configuration(rng=rng), rng.standard_normal(18)
        M, h, J_c = tw.crba(model, q), tw.nonlinear_effects(model, q, v), tw.contact_jacobian(model, q, model.feet)
        S, loads = tw.selection_matrix(model), rng.normal(scale=10, size=(2, 12))
        cases.append((M, h, S, J_c, *loads))
    return cases


BASE = np.arange(18) < 6


def _force(change: Any) -> Any:
    """Solve for another sum of Sᵀτ, J_cᵀλ and h."""
    return lambda M, h, S, J_c, tau, forces: np.linalg.solve(M, change(S.mT @ tau, J_c.mT @ forces, h))


def _matrix(change: Any) -> Any:
    """Solve with another matrix."""
    return lambda M, *rest: accelerated(change(M), *rest)


FOOT = Part(
    solution=rows_of_foot,
    doc=Text(
        """Return the rows of J_c for a foot, out of the Jacobian of the body that carries it.

        J: array (6, nv), body Jacobian of the link: its body twist is J v, rows (ω, v).
        R: array (3, 3), from the link's axes to the world's. r: array (3,), m, the foot in the
        link's frame.
        Returns: array (3, nv): times v it is the velocity of the foot, m/s, in the axes of the world.""",
        """由承载脚的连杆的雅可比返回该脚在 J_c 中的三行。

        J：数组 (6, nv)，连杆的 body 雅可比：J v 是它的 body twist，行 (ω, v)。
        R：数组 (3, 3)，从连杆坐标轴到世界坐标轴。r：数组 (3,)，单位 m，脚在连杆坐标系中的位置。
        返回：数组 (3, nv)，乘以 v 得到脚的速度，m/s，用世界坐标轴。""",
    ),
    returns=(Quantity("rows of J_c"),),
    cases=_feet,
    slips={
        "angular-for-linear": lambda J, R, r: R @ J[:3],
        "joint-for-frame": lambda J, R, r: R @ J[3:],
        "cross-order": lambda J, R, r: R @ (J[3:] + tw.skew(r) @ J[:3]),
        "local-for-aligned": lambda J, R, r: J[3:] - tw.skew(r) @ J[:3],
        "rotation-transposed": lambda J, R, r: R.mT @ (J[3:] - tw.skew(r) @ J[:3]),
        "coupling-unrotated": lambda J, R, r: R @ J[3:] - tw.skew(r) @ J[:3],
    },
    reasons={
        "angular-for-linear": Text(
            "J[:3] is how ω depends on v. The foot's velocity is that of the link's origin, J[3:], and ω × r.",
            "J[:3] 给出的是 ω；脚的速度是连杆原点速度 J[3:] 加上 ω × r。",
        ),
        "joint-for-frame": Text(
            "J[3:] is the velocity of the link's origin. The foot is r away: add ω × r = −[r]× ω.",
            "J[3:] 是连杆原点的速度；脚在 r 处，要加上 ω × r = −[r]× ω。",
        ),
        "local-for-aligned": Text(
            "The velocity is along the link's axes still: turn it by R.", "速度仍用连杆坐标轴：要乘 R。"
        ),
        "coupling-unrotated": Text(
            "[r]× J[:3] is along the link's axes as well: R stands before all of it.",
            "[r]× J[:3] 也用连杆坐标轴：R 要乘整个括号。",
        ),
    },
)

EQUATION = Part(
    solution=accelerated,
    doc=Text(
        """Return the accelerations of M q̈ + h = Sᵀτ + J_cᵀλ.

        M: array (18, 18). h: array (18,). S: array (12, 18). J_c: array (12, 18). tau: array (12,),
        N m.
        forces: array (12,), N, λ: the ground's forces on the feet.
        Returns: array (18,), rad/s² and m/s².""",
        """由 M q̈ + h = Sᵀτ + J_cᵀλ 返回加速度。

        M：数组 (18, 18)。h：数组 (18,)。S：数组 (12, 18)。J_c：数组 (12, 18)。tau：数组 (12,)，N m。
        forces：数组 (12,)，N，λ：地面对脚的力。
        返回：数组 (18,)，rad/s² 与 m/s²。""",
    ),
    returns=(Quantity("q̈", JOINT_SPACE),),
    cases=_equations,
    slips={
        "contact-missing": _force(lambda motors, feet, h: motors - h),
        "force-sign": _force(lambda motors, feet, h: motors - feet - h),
        "torques-missing": _force(lambda motors, feet, h: feet - h),
        "bias-for-zero": _force(lambda motors, feet, h: motors + feet),
        "bias-sign": _force(lambda motors, feet, h: motors + feet + h),
        "selection-first": _force(lambda motors, feet, h: np.roll(motors, -6) + feet - h),
        "joints-missing": _matrix(lambda M: M * (BASE[:, None] == BASE)),
        "one-triangle": _matrix(np.triu),
        "doubled-off-diagonal": _matrix(lambda M: 2 * M - np.diag(np.diag(M))),
    },
    properties=(
        Property(
            Text("M q̈ + h − Sᵀτ − J_cᵀλ = 0", "M q̈ + h − Sᵀτ − J_cᵀλ = 0"),
            lambda answer, M, h, S, J_c, tau, forces: M @ answer + h - S.mT @ tau - J_c.mT @ forces,
        ),
    ),
)

EXERCISE = Exercise(
    id="project.2",
    kind="code",
    title=Text("Stage 2: the whole-body dynamics", "阶段 2：全身动力学计算管线"),
    text=Text(
        """The chapter has you call RNEA, ABA and CRBA; here you write them, on any tree, from four lists: parent, S,
        I and X. They are tried on Go2 and on random trees with joints of one, three and six degrees of freedom, with
        fixed and floating bases. Add the energy, which checks M; the contact rows of a foot; and the equation of motion
        M q̈ + h = Sᵀτ + J_cᵀλ itself. (h is your RNEA at q̈ = 0.)

        Do not copy the pseudocode of 49.6 to 49.8: its backward pass throws away what the children have added, and
        its X* leads outward. With X from the parent to link i, wrenches come inward by Xᵀ and inertias by XᵀI X.""",
        """本章让你调用 RNEA、ABA、CRBA；这里要你自己写，适用于任意树，输入只有四个列表：parent、S、I、X。
        检验对象是 Go2 和随机树，含一、三、六自由度的关节，固定和浮动基座都有。再写出动能（用来检验 M）、
        一只脚的接触行，以及运动方程 M q̈ + h = Sᵀτ + J_cᵀλ 本身。（h 就是 q̈ = 0 时你的 RNEA。）

        不要照抄 49.6–49.8 的伪代码：它的反向传递丢掉了子连杆加上来的力，它的 X* 也方向相反。
        X 从父连杆到连杆 i 时，wrench 用 Xᵀ 向内传，惯量用 XᵀI X。""",
    ),
    parts=(RNEA, ENERGY, CRBA, ABA, FOOT, EQUATION),
    hints=(
        Text(
            "Go outward with `for i in range(1, n)` and inward with `for i in range(n - 1, 0, -1)`: no body comes "
            "before its parent. S[i] @ qd[i] works for joints with any number of degrees of freedom.",
            "向外用 `for i in range(1, n)`，向内用 `for i in range(n - 1, 0, -1)`：父物体总在前面。"
            "S[i] @ qd[i] 对任意自由度的关节都成立。",
        ),
        Text(
            "Do not change the lists: `IC = list(I)` is a copy, and `IC[p] = IC[p] + ...` leaves the arrays alone, "
            "which `IC[p] += ...` does not.",
            "不要改动输入列表：`IC = list(I)` 是副本；`IC[p] = IC[p] + ...` 不动原数组，而 `IC[p] += ...` 会改动。",
        ),
        Text(
            "ABA inward: U = I^A S, D = Sᵀ U, u = τ − Sᵀ p, I^a = I^A − U D⁻¹ Uᵀ, p^a = p + I^a c + U D⁻¹ u. D is a "
            "matrix for joints of several degrees of freedom.",
            "ABA 向内：U = I^A S，D = Sᵀ U，u = τ − Sᵀ p，I^a = I^A − U D⁻¹ Uᵀ，p^a = p + I^a c + U D⁻¹ u。"
            "多自由度关节的 D 是矩阵。",
        ),
    ),
)
