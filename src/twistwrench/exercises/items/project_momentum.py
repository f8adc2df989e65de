"""The project, stage 3: A_G and ḣ_G of one's own, and how they go wrong."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Part, Property, Quantity
from ..layouts import CENTROIDAL_MAP, MOMENTUM
from ..robots import robot, small_robot
from ..text import Text
from ..wrong import faulty, swapped

__all__ = ["MAP", "RATE", "momentum_rate", "own_centroidal_map"]


def own_centroidal_map(model: Any, q: Any) -> Any:
    """A_G, as the sum of the momenta of all bodies."""
    p_G, placement = tw.center_of_mass(model, q), tw.forward_kinematics(model, q).placement
    A_G = np.zeros((6, model.nv))
    for i in range(1, model.nbodies):
        J = tw.frame_jacobian(model, q, model.joint_names[i], reference="local")
        R, p = placement[i].rotation, placement[i].translation
        A_G = A_G + tw.force_transform(R, p - p_G) @ model.inertia[i].matrix() @ J
    return A_G


def momentum_rate(model: Any, q: Any, v: Any, a: Any) -> Any:
    """Rate of the centroidal momentum in a given motion."""
    p_G = tw.center_of_mass(model, q)
    placement, twists, accelerations = tw.forward_kinematics(model, q, v, a)
    rate = np.zeros(6)
    for body, T, V, A in zip(model.inertia, placement, np.array(twists), np.array(accelerations)):
        I = body.matrix()
        F = I @ A + tw.cross_force(V) @ I @ V
        rate = rate + tw.force_transform(T.rotation, T.translation - p_G) @ F
    return rate


def _at_mean(model: Any, q: Any) -> Any:
    """Return the plain mean of the bodies' centres of mass."""
    placement = tw.forward_kinematics(model, q).placement
    return np.mean([T.act(body.com) for body, T in zip(model.inertia[1:], placement[1:])], axis=0)


def _at_frames(model: Any, q: Any) -> Any:
    """Return the mean of the bodies' origins, weighted by the masses."""
    placement = tw.forward_kinematics(model, q).placement
    return sum(body.mass * T.translation for body, T in zip(model.inertia, placement)) / model.mass


def _spin(body: Any) -> Any:
    """Return the inertia of a body that has no mass: only its spin is left."""
    I = body.matrix()
    I[:3, 3:], I[3:, :3], I[:3, :3] = 0, 0, body.inertia_at_com
    return I


def _rows(model: Any, q: Any) -> Any:
    """Exchange the rows of A_G alone."""
    A_G = tw.centroidal_map(model, q)
    return np.concatenate([A_G[k : k + 3] for k in (3, 0)])


def _postures(rng: Any) -> Any:
    models = (robot("go2"), small_robot(rng), small_robot(rng))
    return [(model, model.random_configuration(rng=rng)) for model in models]


def _motions(rng: Any) -> Any:
    return [(model, q, *rng.standard_normal((2, model.nv))) for model, q in _postures(rng)]


MAP = Part(
    solution=own_centroidal_map,
    doc=Text(
        """Return the centroidal momentum matrix A_G, without `tw.centroidal_map`: the sum of the
        momenta of all bodies.

        model: with a floating base. q: array (nq,).
        `tw.frame_jacobian(model, q, model.joint_names[i], reference="local")` is the body Jacobian
        of body i, `model.inertia[i].matrix()` its inertia, `tw.forward_kinematics(model,
        q).placement[i]` its placement, and `tw.center_of_mass(model, q)` is p_G.
        Returns: array (6, nv), rows (k, l), about the centre of mass, in the axes of the world.""",
        """不用 `tw.centroidal_map`，返回质心动量矩阵 A_G：全部刚体动量之和。

        model：浮动基座模型。q：数组 (nq,)。
        `tw.frame_jacobian(model, q, model.joint_names[i], reference="local")` 是物体 i 的 body 雅可
        比，`model.inertia[i].matrix()` 是其惯量，`tw.forward_kinematics(model, q).placement[i]` 是其
        位姿，`tw.center_of_mass(model, q)` 是 p_G。
        返回：数组 (6, nv)，行 (k, l)，对质心取矩，用世界坐标轴。""",
    ),
    returns=(Quantity("A_G", CENTROIDAL_MAP),),
    cases=_postures,
    slips={
        "momentum-at-origin": faulty(own_centroidal_map, ("tw.center_of_mass(model, q)", "np.zeros(3)")),
        "momentum-at-base": faulty(own_centroidal_map, ("tw.center_of_mass(model, q)", "q[:3]")),
        "unweighted-mean": faulty(own_centroidal_map, ("tw.center_of_mass(model, q)", "_at_mean(model, q)")),
        "frame-for-com": faulty(own_centroidal_map, ("tw.center_of_mass(model, q)", "_at_frames(model, q)")),
        "motion-for-force": faulty(own_centroidal_map, ("tw.force_transform", "tw.motion_transform")),
        "untransformed": faulty(own_centroidal_map, ("tw.force_transform(R, p - p_G) @ ", "")),
        "local-for-world": faulty(own_centroidal_map, ("tw.force_transform(R", "tw.force_transform(np.eye(3)")),
        "inverse-transform": faulty(
            own_centroidal_map, ("tw.force_transform(R, p - p_G)", "np.linalg.inv(tw.force_transform(R, p - p_G))")
        ),
        "mixed-frames": faulty(
            own_centroidal_map,
            ("tw.force_transform(R, p - p_G) @ model.inertia[i]", "model.inertia[i].transform(tw.SE3(R, p - p_G))"),
        ),
        "orbital-missing": faulty(own_centroidal_map, ("model.inertia[i].matrix()", "_spin(model.inertia[i])")),
        "rows-only": _rows,
    },
    reasons={
        "untransformed": Text(
            "I_i J_i is in frame i: X* takes it to the centre of mass.", "I_i J_i 在坐标系 i 中：用 X* 变到质心。"
        ),
        "local-for-world": Text(
            "X* of (R_i, p_i − p_G): its R turns the momentum into the axes of the world.",
            "X* 用 (R_i, p_i − p_G)：其中的 R 把动量变到世界坐标轴。",
        ),
        "motion-for-force": Text(
            "Momenta transform like wrenches: X*, not X.", "动量按 wrench 的方式变换：用 X*，不是 X。"
        ),
        "inverse-transform": Text(
            "(R_i, p_i − p_G) places frame i at the centre of mass: its X* leads there, no inverse needed.",
            "(R_i, p_i − p_G) 是坐标系 i 在质心坐标系中的位姿，它的 X* 正好变到质心，不需要求逆。",
        ),
        "rows-only": Text(
            "The rows here are (k, l): angular first. Pinocchio has (l, k).",
            "这里的行是 (k, l)：角动量在前；Pinocchio 是 (l, k)。",
        ),
    },
    properties=(
        Property(
            Text("its linear rows are m times the Jacobian of the centre of mass", "其线动量行等于 m 乘质心的雅可比"),
            lambda answer, model, q: answer[3:] - tw.newton_euler_3d.centroidal_map(model, q)[3:],
        ),
    ),
)


RATE = Part(
    solution=momentum_rate,
    doc=Text(
        """Return ḣ_G, the rate of the centroidal momentum in a given motion: the sum of what all bodies
        need.

        model: with a floating base. q: array (nq,). v, a: arrays (nv,).
        `tw.forward_kinematics(model, q, v, a)` gives, for each body, placements in the world, body
        twists, and spatial accelerations without gravity.
        Returns: array (6,), (k̇, l̇), N m and N, about the centre of mass, in the axes of the world.""",
        """返回给定运动中质心动量的变化率 ḣ_G：全部刚体所需 wrench 之和。

        model：浮动基座模型。q：数组 (nq,)。v、a：数组 (nv,)。
        `tw.forward_kinematics(model, q, v, a)` 依次给出各物体在世界中的位姿、body twist 和空间加速度
        （不含重力）。
        返回：数组 (6,)，(k̇, l̇)，N m 与 N，对质心取矩，用世界坐标轴。""",
    ),
    returns=(Quantity("ḣ_G", MOMENTUM),),
    cases=_motions,
    slips={
        "gyroscopic-missing": faulty(momentum_rate, (" + tw.cross_force(V) @ I @ V", "")),
        "gyroscopic-sign": faulty(momentum_rate, ("+ tw.cross_force", "- tw.cross_force")),
        "motion-cross-for-force": faulty(momentum_rate, ("tw.cross_force", "tw.cross_motion")),
        "classical-acceleration": faulty(
            momentum_rate, ("I @ A +", "I @ (A + np.concatenate([np.zeros(3), np.cross(V[:3], V[3:])])) +")
        ),
        "swapped-halves": swapped(momentum_rate),
        "rate-bias-missing": lambda model, q, v, a: tw.centroidal_map(model, q) @ a,
        "velocity-for-acceleration": lambda model, q, v, a: tw.centroidal_map(model, q) @ v,
        "momentum-at-origin": faulty(momentum_rate, ("tw.center_of_mass(model, q)", "np.zeros(3)")),
        "momentum-at-base": faulty(momentum_rate, ("tw.center_of_mass(model, q)", "q[:3]")),
        "gravity-in-rate": lambda model, q, v, a: (
            tw.centroidal_momentum_rate(model, q, v, a) - np.concatenate([np.zeros(3), model.mass * model.gravity])
        ),
    },
    reasons={
        "velocity-for-acceleration": Text(
            "A_G v is the momentum itself; its rate is A_G a + Ȧ_G v.", "A_G v 是动量本身；其变化率是 A_G a + Ȧ_G v。"
        ),
    },
    properties=(
        Property(
            Text("its linear half is m times the acceleration of the centre of mass", "其线分量等于 m 乘质心加速度"),
            lambda answer, model, q, v, a: (answer - tw.newton_euler_3d.centroidal_momentum_rate(model, q, v, a))[3:],
        ),
    ),
)
