"""The project, stage 3: the interface of the centroidal momentum."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Exercise, Part, Property, Quantity
from ..layouts import CENTROIDAL_MAP, CONTACT_JACOBIAN, JOINT_SPACE, MASS_MATRIX, MOMENTUM, WRENCH
from ..robots import robot, small_robot
from ..text import Text
from ..workbook import mine
from ..wrong import after, swap
from .project_momentum import MAP, RATE

__all__ = ["EXERCISE", "get_dynamics", "rate_and_wrench"]


def rate_and_wrench(model: Any, q: Any, v: Any, tau: Any, forces: Any) -> Any:
    """Rate of the momentum out of the motion, and the wrench of what acts from outside."""
    acceleration, rate = mine("accelerated"), mine("momentum_rate")
    M, h, J_c = tw.crba(model, q), tw.nonlinear_effects(model, q, v), tw.contact_jacobian(model, q, model.feet)
    a = acceleration(M, h, tw.selection_matrix(model), J_c, tau, forces.ravel())
    feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])
    moment = np.cross(feet - tw.center_of_mass(model, q), forces).sum(0)
    return rate(model, q, v, a), np.concatenate([moment, forces.sum(0) + model.mass * model.gravity])


def get_dynamics(model: Any, q: Any, v: Any, feet: Any) -> Any:
    """M, h, J_c and A_G."""
    M, h = tw.crba(model, q), tw.nonlinear_effects(model, q, v)
    J_c = np.vstack([tw.frame_jacobian(model, q, foot, reference="local_world_aligned")[3:] for foot in feet])
    return M, h, J_c, tw.centroidal_map(model, q)


def _accelerated(model: Any, q: Any, v: Any, tau: Any, forces: Any, h: Any = None) -> Any:
    h = tw.nonlinear_effects(model, q, v) if h is None else h
    given = np.concatenate([np.zeros(6), tau]) + tw.contact_jacobian(model, q, model.feet).mT @ forces.ravel() - h
    return np.linalg.solve(tw.crba(model, q), given)


def _wrench(model: Any, q: Any, forces: Any, point: Any = None, weight: float = 1.0) -> Any:
    point = tw.center_of_mass(model, q) if point is None else point
    feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet])
    moment = np.cross(feet - point, forces).sum(0)
    return np.concatenate([moment, forces.sum(0) + weight * model.mass * model.gravity])


def _rate(change: Any) -> Any:
    """Find the rate otherwise, and the wrench as it is."""
    return lambda model, q, v, tau, forces: (change(model, q, v, tau, forces), _wrench(model, q, forces))


def _law(change: Any) -> Any:
    """Find the wrench otherwise, and the rate as it is."""

    def wrong(model: Any, q: Any, v: Any, tau: Any, forces: Any) -> Any:
        rate = tw.centroidal_momentum_rate(model, q, v, _accelerated(model, q, v, tau, forces))
        return rate, change(model, q, forces)

    return wrong


def _of(acceleration: Any) -> Any:
    """Find the rate from another acceleration."""
    return _rate(
        lambda model, q, v, tau, forces: tw.centroidal_momentum_rate(
            model, q, v, acceleration(model, q, v, tau, forces)
        )
    )


def _uncarried(model: Any, q: Any, v: Any, tau: Any, forces: Any) -> Any:
    return tw.centroidal_map(model, q) @ _accelerated(model, q, v, tau, forces)


def _weighed(model: Any, q: Any, v: Any, tau: Any, forces: Any) -> Any:
    rate = tw.centroidal_momentum_rate(model, q, v, _accelerated(model, q, v, tau, forces))
    return rate - np.concatenate([np.zeros(3), model.mass * model.gravity])


def _falls(rng: Any) -> Any:
    model = robot("go2")
    return [
        (model, model.random_configuration(rng=rng), rng.standard_normal(18), *rng.normal(scale=10, size=(2, 12)))
        for _ in range(2)
    ]


LAW = Part(
    solution=rate_and_wrench,
    doc=Text(
        """Return ḣ_G twice: from the motion that torques and contact forces make, and as the wrench
        from outside.

        model: Go2. q: array (19,). v: array (18,). tau: array (12,), N m.
        forces: array (4, 3), N, of the ground on each of `model.feet`, in the axes of the world.
        Returns: array (6,), ḣ_G = (k̇, l̇) of that motion; array (6,), the wrench (τ, f) of the
        ground's forces and the weight. Both about the centre of mass, in the axes of the world, N m
        and N.""",
        """用两种方法返回 ḣ_G：由力矩和接触力产生的运动计算；作为外力的合 wrench 计算。

        model：Go2。q：数组 (19,)。v：数组 (18,)。tau：数组 (12,)，N m。
        forces：数组 (4, 3)，N，地面对 `model.feet` 各脚的力，用世界坐标轴。
        返回：数组 (6,)，该运动的 ḣ_G = (k̇, l̇)；数组 (6,)，地面力与重力的 wrench (τ, f)。
        两者都对质心取矩，用世界坐标轴，N m 与 N。""",
    ),
    given="""
        acceleration = mine("accelerated")  # of M, h, S, J_c, tau, forces: the accelerations
        rate = mine("momentum_rate")  # rate(model, q, v, a) is ḣ_G
""",
    returns=(Quantity("ḣ_G", MOMENTUM), Quantity("wrench from outside", WRENCH)),
    cases=lambda rng: [(model, q, v, tau, forces.reshape(4, 3)) for model, q, v, tau, forces in _falls(rng)],
    slips={
        "contact-missing": _of(lambda model, q, v, tau, forces: _accelerated(model, q, v, tau, 0 * forces)),
        "force-sign": _of(lambda model, q, v, tau, forces: _accelerated(model, q, v, tau, -forces)),
        "bias-for-zero": _of(lambda model, q, v, tau, forces: _accelerated(model, q, v, tau, forces, np.zeros(18))),
        "velocity-terms-missing": _of(
            lambda model, q, v, tau, forces: _accelerated(model, q, v, tau, forces, tw.gravity(model, q))
        ),
        "rate-bias-missing": _rate(_uncarried),
        "gravity-in-rate": _rate(_weighed),
        "gravity-missing": _law(lambda model, q, forces: _wrench(model, q, forces, weight=0)),
        "weight-upward": _law(lambda model, q, forces: _wrench(model, q, forces, weight=-1)),
        "moment-about-origin": _law(lambda model, q, forces: _wrench(model, q, forces, np.zeros(3))),
        "base-for-com": _law(lambda model, q, forces: _wrench(model, q, forces, q[:3])),
        "lever-reversed": _law(lambda model, q, forces: _wrench(model, q, forces) * np.repeat([-1, 1], 3)),
        "swapped-halves": after(rate_and_wrench, swap),
    },
    reasons={
        "gravity-missing": Text(
            "The weight acts from outside as well: m g, at the centre of mass.", "重力也是外力：m g，作用在质心。"
        ),
        "base-for-com": Text(
            "q[:3] is the base's origin. The moments are about the centre of mass, `tw.center_of_mass`.",
            "q[:3] 是基座原点；力矩是对质心取的，用 `tw.center_of_mass`。",
        ),
    },
    properties=(
        Property(
            Text("the two are equal: Newton's and Euler's law for the whole robot", "两者相等：整机的牛顿–欧拉定律"),
            lambda answer, model, q, v, tau, forces: answer[0] - answer[1],
        ),
    ),
)


def _replaced(k: int, by: Any) -> Any:
    """Replace one of the four things."""

    def wrong(model: Any, q: Any, v: Any, feet: Any) -> Any:
        answer = list(get_dynamics(model, q, v, feet))
        answer[k] = by(model, q, v, feet, answer[k])
        return tuple(answer)

    return wrong


def _jacobians(rows: Any = slice(3, 6), reference: Any = "local_world_aligned") -> Any:
    """Stack other rows of other Jacobians."""
    return _replaced(
        2,
        lambda model, q, v, feet, J_c: np.vstack(
            [tw.frame_jacobian(model, q, foot, reference=reference)[rows] for foot in feet]
        ),
    )


def _about(point: Any) -> Any:
    """Take the angular momentum about another point: it gains (p_G − point) × l."""
    return _replaced(
        3,
        lambda model, q, v, feet, A_G: np.concatenate(
            [A_G[:3] + tw.skew(tw.center_of_mass(model, q) - point(q)) @ A_G[3:], A_G[3:]]
        ),
    )


def _in_pinocchio_order(model: Any, q: Any, v: Any, feet: Any) -> Any:
    M, h, J_c, A_G = get_dynamics(model, q, v, feet)
    return swap(M), swap(h), np.array([swap(row) for row in J_c]), swap(A_G)


def _states(rng: Any) -> Any:
    """Return states of Go2 on all feet and on two, and of a smaller robot."""
    feet = (robot("go2").feet, ("FR_foot", "RL_foot"))
    other = small_robot(rng)
    return [
        *((model, q, v, names) for (model, q, v, _, _), names in zip(_falls(rng), feet)),
        (other, other.random_configuration(rng=rng), rng.standard_normal(other.nv), tuple(other.joint_names[2:4])),
    ]


INTERFACE = Part(
    solution=get_dynamics,
    doc=Text(
        """Return M, h, J_c and A_G: what the later chapters' controllers ask for.

        model: with a floating base. q: array (nq,). v: array (nv,). feet: tuple of k names of frames.
        Use twistwrench, or your own of stage 2.
        Returns: arrays (nv, nv), full; (nv,), with gravity and velocity terms; (3 k, nv), linear
        rows in the axes of the world; (6, nv), rows (k, l). The base's entries are (ω, v).""",
        """返回 M、h、J_c 和 A_G：后续各章控制器所需的全部量。

        model：浮动基座模型。q：数组 (nq,)。v：数组 (nv,)。feet：k 个 frame 名的元组。
        用 twistwrench，或用你在阶段 2 写的。
        返回：数组 (nv, nv)，完整矩阵；(nv,)，含重力与速度项；(3 k, nv)，线速度行，用世界坐标轴；(6,
        nv)，行（k, l）。
        基座分量为 (ω, v)。""",
    ),
    returns=(
        Quantity("M", MASS_MATRIX),
        Quantity("h", JOINT_SPACE),
        Quantity("J_c", CONTACT_JACOBIAN),
        Quantity("A_G", CENTROIDAL_MAP),
    ),
    cases=_states,
    slips={
        "doubled-off-diagonal": _replaced(0, lambda model, q, v, feet, M: 2 * M - np.diag(np.diag(M))),
        "one-triangle": _replaced(0, lambda model, q, v, feet, M: np.triu(M)),
        "velocity-terms-missing": _replaced(1, lambda model, q, v, feet, h: tw.gravity(model, q)),
        "gravity-missing": _replaced(1, lambda model, q, v, feet, h: h - tw.gravity(model, q)),
        "base-missing": _replaced(1, lambda model, q, v, feet, h: h[6:]),
        "angular-for-linear": _jacobians(slice(0, 3)),
        "contact-rows-all": _jacobians(slice(0, 6)),
        "local-for-aligned": _jacobians(reference="local"),
        "world-for-aligned": _jacobians(reference="world"),
        "momentum-at-origin": _about(lambda q: np.zeros(3)),
        "momentum-at-base": _about(lambda q: q[:3]),
        "swapped-halves": _in_pinocchio_order,
    },
    reasons={
        "gravity-missing": Text("h = C v + g: gravity belongs to it.", "h = C v + g：包含重力。"),
        "base-missing": Text("h has nv rows, those of the base first.", "h 有 nv 行，基座在前。"),
    },
    properties=(
        Property(
            Text(
                "A_G is M's base rows seen from the centre of mass: A_G = X* M_b",
                "A_G 是从质心看的 M 的基座行：A_G = X* M_b",
            ),
            lambda answer, model, q, v, feet: answer[3] - _from_base(model, q) @ answer[0][:6],
        ),
    ),
)


def _from_base(model: Any, q: Any) -> Any:
    """Return the X* that takes a wrench from the base's frame to the centre of mass."""
    T = tw.forward_kinematics(model, q).placement[1]
    return tw.force_transform(T.rotation, T.translation - tw.center_of_mass(model, q))


EXERCISE = Exercise(
    id="project.3",
    kind="code",
    title=Text("Stage 3: the interface of the centroidal momentum", "阶段 3：Centroidal 动量接口"),
    text=Text(
        """Build A_G yourself, as the sum of the momenta of all bodies, and ḣ_G = A_G a + Ȧ_G v in the same way. Then
        see the law behind all simplified models: whatever the motors do, ḣ_G is the wrench of the contact forces and
        the weight. At last put all together into the interface of the later chapters, get_dynamics.

        Two corrections to the chapter. The inertia and the Jacobian in the sum for A_G must be in one frame: it is the
        momentum I_i J_i that X* takes to the centre of mass. And ḣ_G at rest with a = 0 is zero, not the weight: it is
        kinematics.""",
        """自己构造 A_G（全部刚体动量之和），并用同样方法求 ḣ_G = A_G a + Ȧ_G v。然后验证一切简化模型背后的定律：
        无论电机怎样出力，ḣ_G 都等于接触力与重力的合 wrench。最后把它们汇总成后续各章使用的接口 get_dynamics。

        对本章的两点更正：A_G 求和式中的惯量与雅可比必须在同一坐标系，X* 变换到质心的是动量 I_i J_i；
        静止且 a = 0 时 ḣ_G 为零，不是重力，因为它是运动学量。""",
    ),
    parts=(MAP, RATE, LAW, INTERFACE),
    hints=(
        Text(
            "I_i J_i v is the momentum of body i, in its own frame. Momenta transform like wrenches: by X* of the "
            "placement of frame i, seen from the centre of mass, (R_i, p_i − p_G).",
            "I_i J_i v 是物体 i 在自身坐标系中的动量。动量按 wrench 的方式变换：用从质心看的坐标系 i 的位姿 "
            "(R_i, p_i − p_G) 的 X*。",
        ),
        Text(
            "What a body needs is I A + V ×* I V, as in RNEA, but with the true acceleration: the world does not rise.",
            "每个物体所需的是 I A + V ×* I V，与 RNEA 相同，但用真实加速度：世界不上升。",
        ),
        Text(
            "The wrench from outside: Σ (p_k − p_G) × f_k, and Σ f_k + m g with g = (0, 0, −9.81).",
            "外力的合 wrench：Σ (p_k − p_G) × f_k，以及 Σ f_k + m g，其中 g = (0, 0, −9.81)。",
        ),
    ),
)
