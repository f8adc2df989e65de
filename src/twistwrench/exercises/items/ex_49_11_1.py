"""Exercise 49.11.1: the seven tests of the chapter's listing, mended."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import CONTACT_JACOBIAN, JOINT_SPACE
from ..robots import robot
from ..text import Text
from ..wrong import after, swap
from .pinocchio_order import ACTION, INERTIA_MATRIX

__all__ = [
    "EXERCISE",
    "by_mass_matrix",
    "com_velocity",
    "contact_rows",
    "finite_limits",
]


def finite_limits(lower: Any, upper: Any) -> Any:
    """Limits to draw a configuration from."""
    return np.where(np.isfinite(lower), lower, -1.0), np.where(np.isfinite(upper), upper, 1.0)


def by_mass_matrix(M: Any, h: Any, a: Any, tau: Any) -> Any:
    """M a + h and M⁻¹ (τ − h) (tests 1 and 2)."""
    return M @ a + h, np.linalg.solve(M, tau - h)


def com_velocity(h_G: Any, m: Any) -> Any:
    """Velocity of the centre of mass (test 6)."""
    return h_G[:3] / m


def contact_rows(J: Any) -> Any:
    """Contact Jacobian of four feet (test 7)."""
    return np.vstack([J_foot[:3] for J_foot in J])


def _limits(rng: Any) -> Any:
    """Return limits as Pinocchio has them: of a free-flyer, of joints, and of another free-flyer further back."""
    free = np.array([np.inf] * 3 + [1.01] * 4)
    joints = rng.uniform(0.5, 3, (3, 12))
    tails = [joints[0], np.concatenate([joints[1, :4], free]), joints[2]]
    return [
        (-np.concatenate([free, tail]), np.concatenate([free, tail * rng.uniform(0.2, 1, len(tail))])) for tail in tails
    ]


def _dynamics(rng: Any) -> Any:
    """Return M, h, a and τ of Go2, in Pinocchio's order."""
    model, cases = robot("go2"), []
    for _ in range(2):
        q, (v, a, tau) = model.random_configuration(rng=rng), rng.standard_normal((3, 18))
        cases.append((swap(tw.crba(model, q)), swap(tw.nonlinear_effects(model, q, v)), swap(a), swap(tau)))
    return cases


def _jacobians(rng: Any) -> Any:
    model = robot("go2")
    postures = [model.random_configuration(rng=rng) for _ in range(2)]
    return [
        (np.array([swap(tw.frame_jacobian(model, q, foot, "local_world_aligned")) for foot in model.feet]),)
        for q in postures
    ]


RANDOM = Part(
    solution=finite_limits,
    doc=Text(
        """Return limits from which a finite configuration can be drawn.

        lower, upper: arrays (nq,), a model's limits in Pinocchio: infinite for the position of a
        free base.
        Returns: arrays (nq,), with −1 where `lower` and +1 where `upper` is not finite, and
        unchanged elsewhere; for `pin.randomConfiguration(model, lower, upper)`.""",
        """返回可以抽取有限位形的限位。

        lower、upper：数组 (nq,)，Pinocchio 模型的限位；自由基座的位置限位是无穷。
        返回：数组 (nq,)，`lower` 非有限处为 −1，`upper` 非有限处为 +1，其余不变；
        用于 `pin.randomConfiguration(model, lower, upper)`。""",
    ),
    returns=(Quantity("lower"), Quantity("upper")),
    cases=_limits,
    slips={
        "limits-all": lambda lower, upper: (
            0 * finite_limits(lower, upper)[0] - 1,
            0 * finite_limits(lower, upper)[1] + 1,
        ),
        "limits-position-only": lambda lower, upper: (
            np.concatenate([-np.ones(3), lower[3:]]),
            np.concatenate([np.ones(3), upper[3:]]),
        ),
        "one-sided": lambda lower, upper: (lower, finite_limits(lower, upper)[1]),
    },
    reasons={
        "one-sided": Text("The lower limits of a free base are infinite, too.", "自由基座的下限同样是无穷。"),
    },
)

MATRIX = Part(
    solution=by_mass_matrix,
    doc=Text(
        """Return what rnea and aba must give, computed from M and h (tests 1 and 2).

        M: array (18, 18), as `pin.crba(model, data, q)` returns it in Python. h: array (18,),
        `pin.rnea` at a = 0.
        a, tau: arrays (18,). All in Pinocchio's order; it does not matter here.
        Returns: arrays (18,) and (18,): M a + h and M⁻¹ (τ − h).""",
        """由 M 和 h 返回 rnea 与 aba 应给出的结果（测试 1 和 2）。

        M：数组 (18, 18)，即 Python 中 `pin.crba(model, data, q)` 的返回值。h：数组 (18,)，a = 0 时的
        `pin.rnea`。
        a、tau：数组 (18,)。均按 Pinocchio 的顺序，此处无关紧要。
        返回：两个数组 (18,)：M a + h 与 M⁻¹ (τ − h)。""",
    ),
    returns=(Quantity("τ", JOINT_SPACE), Quantity("q̈", JOINT_SPACE)),
    cases=_dynamics,
    slips={
        "doubled-off-diagonal": lambda M, h, a, tau: by_mass_matrix(2 * M - np.diag(np.diag(M)), h, a, tau),
        "one-triangle": lambda M, h, a, tau: by_mass_matrix(np.triu(M), h, a, tau),
        "bias-for-zero": lambda M, h, a, tau: by_mass_matrix(M, 0 * h, a, tau),
        "bias-sign": lambda M, h, a, tau: by_mass_matrix(M, -h, a, tau),
        "column-vector": after(by_mass_matrix, lambda x: x[:, None]),
    },
    properties=(
        Property(
            Text("what a motion asks for makes that motion", "由运动求出的力再代回去得到同一运动"),
            lambda answer, M, h, a, tau: M @ answer[1] + h - tau,
        ),
    ),
)

VELOCITY = Part(
    solution=com_velocity,
    doc=Text(
        """Return the velocity of the centre of mass from Pinocchio's centroidal momentum (test 6).

        h_G: array (6,), `pin.computeCentroidalMomentum(model, data, q, v).vector`. m: number, kg, of
        the robot.
        Returns: array (3,), m/s.""",
        """由 Pinocchio 的质心动量返回质心速度（测试 6）。

        h_G：数组 (6,)，`pin.computeCentroidalMomentum(model, data, q, v).vector`。m：数，kg，整机质
        量。
        返回：数组 (3,)，m/s。""",
    ),
    returns=(Quantity("v_G", unit="m/s"),),
    cases=lambda rng: [(rng.standard_normal(6), float(rng.uniform(5, 80))) for _ in range(3)],
    slips={
        "angular-for-linear": lambda h_G, m: h_G[3:] / m,
        "mass-dropped": lambda h_G, m: h_G[:3],
    },
    reasons={
        "mass-dropped": Text("A momentum over a mass is a velocity.", "动量除以质量才是速度。"),
    },
)

CONTACTS = Part(
    solution=contact_rows,
    doc=Text(
        """Return the contact Jacobian of four point contacts from Pinocchio's frame Jacobians (test 7).

        J: array (4, 6, 18), for each foot `pin.getFrameJacobian(model, data, foot,
        pin.LOCAL_WORLD_ALIGNED)`.
        Returns: array (12, 18), m/s per unit of v.""",
        """由 Pinocchio 的 frame 雅可比返回四个点接触的接触雅可比（测试 7）。

        J：数组 (4, 6, 18)，每只脚的 `pin.getFrameJacobian(model, data, foot,
        pin.LOCAL_WORLD_ALIGNED)`。
        返回：数组 (12, 18)。""",
    ),
    returns=(Quantity("J_c", CONTACT_JACOBIAN),),
    cases=_jacobians,
    slips={
        "angular-for-linear": lambda J: np.vstack([J_foot[3:] for J_foot in J]),
        "transposed-answer": lambda J: contact_rows(J).mT,
        "contact-rows-all": lambda J: J.reshape(24, -1),
    },
)

EXERCISE = Exercise(
    id="49.11.1",
    kind="explain",
    title=Text("The seven tests, mended", "修正后的七个测试"),
    text=Text(
        """The chapter asks you to run its listing and see that all seven tests have errors of the order of 1e-10. They
        have not, and neither the URDF's path nor the version of Pinocchio is to blame: only test 5 passes. Mend the
        others, each in one or two lines, and say which line was wrong and how the mistake showed itself.

        Pinocchio need not be installed: what it would return comes as an argument, in its own order (v, ω), (l, k).""",
        """本章要求运行完整代码，确认七个测试的误差都在 1e-10 量级。实际并非如此，原因也不是 URDF 路径或 Pinocchio
        版本：只有测试 5 通过。请逐个修正其余测试（每个只需一两行），并说明原来哪一行错了、错误怎样表现出来。

        不需要安装 Pinocchio：它的返回值作为参数给出，按它自己的顺序 (v, ω)、(l, k)。""",
    ),
    parts=(RANDOM, MATRIX, INERTIA_MATRIX, ACTION, VELOCITY, CONTACTS),
    hints=(
        Text(
            "Print before you compare: q, M − Mᵀ, the upper left 3 × 3 block of each 6 × 6 matrix, the rank of J_c.",
            "比较之前先打印：q、M − Mᵀ、每个 6 × 6 矩阵左上角的 3 × 3 块、J_c 的秩。",
        ),
        Text(
            "Whatever has six rows in Pinocchio has the linear ones first. And M is complete already.",
            "Pinocchio 中凡是六行的量都是线分量在前；而 M 已经是完整的。",
        ),
        Text(
            "Take the (ω, v) matrices of 49.3 and 49.5 and exchange the halves of rows and columns.",
            "把 49.3、49.5 中 (ω, v) 的矩阵的行、列两半都交换。",
        ),
    ),
    answer=Text(
        """Before all tests: randomConfiguration draws from infinite limits, the position is inf, and tests 1, 2, 4, 5
        and 6 print nan. With a finite q: tests 1 and 2 double the off-diagonal entries of M, since the Python binding
        has already filled both triangles. Tests 3 and 4 compare the (ω, v) layout with Pinocchio's (v, ω): m·1 stands
        top left in its inertia, [p]× R top right in its action. Test 5 passes at 1e-14, as both sides have the same
        order. Test 6 takes h_G[3:], the angular momentum, for m v_G, which is h_G[:3]. Test 7 has no error to look at;
        it takes the angular rows, and its rank of 9 in place of 12 would have told. Mended, all errors are below
        1e-12.""",
        """测试之前：randomConfiguration 从无穷限位中抽样，位置是 inf，测试 1、2、4、5、6 都打印 nan。q 有限之后：
        测试 1、2 把 M 的非对角元素加倍，因为 Python 绑定已填好两个三角；测试 3、4 拿 (ω, v) 的排列与 Pinocchio 的
        (v, ω) 比较：它的惯量左上角是 m·1，action 右上角是 [p]× R；测试 5 两边顺序相同，误差 1e-14，通过；
        测试 6 把角动量 h_G[3:] 当成 m v_G，应为 h_G[:3]；测试 7 没有比较误差，它取了角速度行，秩是 9 而不是 12，
        本可由此发现。修正后误差都小于 1e-12。""",
    ),
)
