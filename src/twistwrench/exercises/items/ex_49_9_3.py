"""Exercise 49.9.3: the base's rows as a constraint."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import JOINT_SPACE, WRENCH
from ..robots import robot
from ..text import Text
from ..wrong import swapped

__all__ = ["EXERCISE", "base_rows", "complete_motion"]


def base_rows(M: Any, h: Any, J_c: Any, qdd: Any, forces: Any) -> Any:
    """By how much a motion and contact forces miss the base's rows."""
    return M[:6] @ qdd + h[:6] - J_c[:, :6].mT @ forces


def complete_motion(M: Any, h: Any, J_c: Any, qdd_joints: Any, forces: Any) -> Any:
    """Accelerations and torques that go with the joints' accelerations and the contact forces."""
    given = J_c[:, :6].mT @ forces - h[:6] - M[:6, 6:] @ qdd_joints
    qdd = np.concatenate([np.linalg.solve(M[:6, :6], given), qdd_joints])
    tau = M[6:] @ qdd + h[6:] - J_c[:, 6:].mT @ forces
    return qdd, tau


def _cases(rng: Any) -> Any:
    model, cases = robot("go2"), []
    for _ in range(3):
        q, v = model.random_configuration(rng=rng), rng.standard_normal(18)
        J_c = tw.contact_jacobian(model, q, model.feet)
        h = tw.nonlinear_effects(model, q, v)
        cases.append((tw.crba(model, q), h, J_c, rng.standard_normal(18), rng.normal(scale=40, size=12)))
    return cases


def _joints_only(rng: Any) -> Any:
    return [(M, h, J_c, qdd[6:], forces) for M, h, J_c, qdd, forces in _cases(rng)]


def _uncoupled(M: Any) -> Any:
    """Return M without what couples base and joints."""
    M = M.copy()
    M[:6, 6:], M[6:, :6] = 0, 0
    return M


def _held(M: Any, h: Any, J_c: Any, qdd_joints: Any, forces: Any) -> Any:
    """Keep the base from accelerating."""
    qdd = np.concatenate([np.zeros(6), qdd_joints])
    return qdd, (M @ qdd + h - J_c.mT @ forces)[6:]


def _rowless(M: Any, h: Any, J_c: Any, qdd_joints: Any, forces: Any) -> Any:
    """Leave the base's acceleration out of the joint rows."""
    qdd, _ = complete_motion(M, h, J_c, qdd_joints, forces)
    return qdd, M[6:, 6:] @ qdd_joints + h[6:] - J_c[:, 6:].mT @ forces


def _uncoupled_above(M: Any, h: Any, J_c: Any, qdd_joints: Any, forces: Any) -> Any:
    """Leave the joints' acceleration out of the base's rows."""
    qdd = np.concatenate([np.linalg.solve(M[:6, :6], J_c[:, :6].mT @ forces - h[:6]), qdd_joints])
    return qdd, (M @ qdd + h - J_c.mT @ forces)[6:]


def _forceless(M: Any, h: Any, J_c: Any, qdd_joints: Any, forces: Any) -> Any:
    """Leave the contact forces out of the torques."""
    qdd, tau = complete_motion(M, h, J_c, qdd_joints, forces)
    return qdd, tau + J_c[:, 6:].mT @ forces


ROWS = Part(
    solution=base_rows,
    doc=Text(
        """Return by how much a motion and contact forces miss the base's rows: M_b q̈ + h_b − J_cbᵀλ.

        M: array (18, 18). h: array (18,). J_c: array (12, 18), linear rows of four feet. All of Go2,
        base first.
        qdd: array (18,), accelerations. forces: array (12,), N, λ: the ground's forces on the feet.
        Returns: array (6,), (τ, f), N m and N. It is zero for what can happen.""",
        """返回给定运动和接触力在基座行中的剩余量：M_b q̈ + h_b − J_cbᵀλ。

        M：数组 (18, 18)。h：数组 (18,)。J_c：数组 (12, 18)，四只脚的线速度行。均为 Go2 的，基座在前。
        qdd：数组 (18,)，加速度。forces：数组 (12,)，N，λ：地面对脚的力。
        返回：数组 (6,)，(τ, f)，N m 与 N；可能发生的运动为零。""",
    ),
    returns=(Quantity("M_b q̈ + h_b − J_cbᵀλ", WRENCH),),
    cases=_cases,
    slips={
        "joints-missing": lambda M, h, J_c, qdd, forces: base_rows(_uncoupled(M), h, J_c, qdd, forces),
        "bias-for-zero": lambda M, h, J_c, qdd, forces: base_rows(M, 0 * h, J_c, qdd, forces),
        "bias-sign": lambda M, h, J_c, qdd, forces: base_rows(M, -h, J_c, qdd, forces),
        "contact-missing": lambda M, h, J_c, qdd, forces: base_rows(M, h, J_c, qdd, 0 * forces),
        "external-sign": lambda M, h, J_c, qdd, forces: base_rows(M, h, J_c, qdd, -forces),
        "base-missing": lambda M, h, J_c, qdd, forces: (M @ qdd + h - J_c.mT @ forces)[6:],
        "one-triangle": lambda M, h, J_c, qdd, forces: base_rows(np.tril(M), h, J_c, qdd, forces),
        "doubled-off-diagonal": lambda M, h, J_c, qdd, forces: base_rows(
            2 * M - np.diag(np.diag(M)), h, J_c, qdd, forces
        ),
        "swapped-halves": swapped(base_rows),
    },
)

COMPLETE = Part(
    solution=complete_motion,
    doc=Text(
        """Return what goes with chosen accelerations of the joints and chosen contact forces.

        M: array (18, 18). h: array (18,). J_c: array (12, 18), linear rows of four feet. All of Go2,
        base first.
        qdd_joints: array (12,), rad/s². forces: array (12,), N, λ: the ground's forces on the feet.
        Returns: array (18,), all accelerations: the base's are those that its six rows allow; array
        (12,), N m, the torques of the motors.""",
        """返回与选定的关节加速度和接触力相容的运动与力矩。

        M：数组 (18, 18)。h：数组 (18,)。J_c：数组 (12, 18)，四只脚的线速度行。均为 Go2 的，基座在前。
        qdd_joints：数组 (12,)，rad/s²。forces：数组 (12,)，N，λ：地面对脚的力。
        返回：数组 (18,)，全部加速度，其中基座的由基座六行决定；数组 (12,)，N m，电机力矩。""",
    ),
    returns=(Quantity("q̈", JOINT_SPACE), Quantity("τ", unit="N m")),
    cases=_joints_only,
    slips={
        "joints-missing": _uncoupled_above,
        "base-acceleration-missing": _rowless,
        "base-held": _held,
        "contact-missing": _forceless,
        "bias-for-zero": lambda M, h, J_c, qdd_joints, forces: complete_motion(M, 0 * h, J_c, qdd_joints, forces),
        "bias-sign": lambda M, h, J_c, qdd_joints, forces: complete_motion(M, -h, J_c, qdd_joints, forces),
        "external-sign": lambda M, h, J_c, qdd_joints, forces: complete_motion(M, h, J_c, qdd_joints, -forces),
        "one-triangle": lambda M, h, J_c, qdd_joints, forces: complete_motion(np.triu(M), h, J_c, qdd_joints, forces),
        "doubled-off-diagonal": lambda M, h, J_c, qdd_joints, forces: complete_motion(
            2 * M - np.diag(np.diag(M)), h, J_c, qdd_joints, forces
        ),
    },
    properties=(
        Property(
            Text("M q̈ + h = Sᵀτ + J_cᵀλ holds in all 18 rows", "M q̈ + h = Sᵀτ + J_cᵀλ 的 18 行全部成立"),
            lambda answer, M, h, J_c, qdd_joints, forces: (
                M @ answer[0] + h - np.concatenate([np.zeros(6), answer[1]]) - J_c.mT @ forces
            ),
        ),
        Property(
            Text("the joints accelerate as was asked", "关节加速度与要求一致"),
            lambda answer, M, h, J_c, qdd_joints, forces: answer[0][6:] - qdd_joints,
        ),
    ),
)

EXERCISE = Exercise(
    id="49.9.3",
    kind="explain",
    title=Text("The base's rows are a constraint", "基座行是约束"),
    text=Text(
        """The base's rows M_bb q̈_b + M_bj q̈_j + h_b = J_cbᵀλ are called the dynamics constraint in whole-body
        control: the controller must find (q̈, τ, λ) that satisfy them. Compute by how much a choice misses them. Then
        choose joint accelerations and contact forces at will, and find the base's acceleration and the torques that go
        with them. Explain what is free in such a choice, what is not, and why it is these six rows that are the
        constraint.""",
        """基座行 M_bb q̈_b + M_bj q̈_j + h_b = J_cbᵀλ 在 WBC 中称为动力学约束：控制器必须找到满足它的 (q̈, τ, λ)。
        先计算任意一组选择的剩余量；再任意选定关节加速度和接触力，求出与之相容的基座加速度和力矩。
        解释：这样的选择中什么是自由的，什么不是，为什么恰恰是这六行成为约束。""",
    ),
    parts=(ROWS, COMPLETE),
    hints=(
        Text(
            "The first six rows of M multiply all of q̈, not only the base's part.",
            "M 的前六行乘的是整个 q̈，而不只是基座部分。",
        ),
        Text(
            "Bring everything known to the right: M_bb q̈_b = J_cbᵀλ − h_b − M_bj q̈_j. M_bb can be inverted.",
            "把已知项移到右边：M_bb q̈_b = J_cbᵀλ − h_b − M_bj q̈_j；M_bb 可逆。",
        ),
        Text("With all of q̈ known, the other twelve rows give τ.", "q̈ 全部已知后，其余十二行给出 τ。"),
    ),
    answer=Text(
        """There are 18 equations. In the twelve of the joints each row has a torque of its own, so that whatever stands
        there, τ = M_jb q̈_b + M_jj q̈_j + h_j − J_cjᵀλ makes it true: these rows define τ, and restrict nothing but
        by the motors' limits. The six of the base have no τ. They tie accelerations and contact forces to each other,
        and no motor can make good what is missing there. Hence a controller may leave τ out of the search: it looks
        for (q̈, λ) under these six equations, friction and contact conditions, and computes τ afterwards. Of q̈ and λ
        all but six numbers may be chosen. The rows say what Newton and Euler say for the whole robot: the rate of its
        momentum is the wrench of weight and contacts.""",
        """共有 18 个方程。十二个关节行各有一个自己的力矩，无论其他量是什么，取 τ = M_jb q̈_b + M_jj q̈_j + h_j − J_cjᵀλ
        即可成立：这些行只是定义 τ，除电机限幅外不构成限制。基座的六行没有 τ，它们把加速度和接触力联系在一起，
        任何电机都无法弥补其中的差额。所以控制器可以先不求 τ：在这六个方程、摩擦与接触条件下求 (q̈, λ)，再算出 τ。
        q̈ 与 λ 中除六个数外都可任选。这六行就是整机的牛顿–欧拉方程：动量的变化率等于重力与接触力的合 wrench。""",
    ),
)
