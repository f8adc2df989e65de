"""The project, stage 2: RNEA on a tree, the energy of its motion, and how the recursion goes wrong."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw

from ..exercise import Part, Property, Quantity
from ..text import Text
from .project_trees import described, pieces, previous, trees

__all__ = ["ENERGY", "RNEA", "tree_energy", "tree_rnea"]


def tree_rnea(parent: Any, S: Any, I: Any, X: Any, qd: Any, qdd: Any, a0: Any) -> Any:
    """Joint forces of a motion."""
    n = len(parent)
    V, A, F, tau = ([np.zeros(6)] * n for _ in range(4))
    A[0] = a0
    for i in range(1, n):
        p = parent[i]
        V[i] = X[i] @ V[p] + S[i] @ qd[i]
        A[i] = X[i] @ A[p] + S[i] @ qdd[i] + tw.cross_motion(V[i]) @ S[i] @ qd[i]
        F[i] = I[i] @ A[i] + tw.cross_force(V[i]) @ I[i] @ V[i]
    for i in range(n - 1, 0, -1):
        tau[i] = S[i].mT @ F[i]
        F[parent[i]] = F[parent[i]] + X[i].mT @ F[i]
    return np.concatenate(tau[1:])


def tree_energy(parent: Any, S: Any, I: Any, X: Any, qd: Any) -> Any:
    """Kinetic energy, body by body."""
    V, energy = [np.zeros(6)], 0.0
    for i in range(1, len(parent)):
        V.append(X[i] @ V[parent[i]] + S[i] @ qd[i])
        energy += V[i] @ I[i] @ V[i] / 2
    return energy


class Ways(NamedTuple):
    """Ways to write RNEA, all of them right by default: factors before its terms, and what is done on the way in."""

    gravity: float = 1
    carried: float = 1
    own: float = 1
    coriolis: float = 1
    classical: float = 0
    gyroscopic: Callable[[Any], Any] = tw.cross_force
    inward: Callable[[Any], Any] = lambda X: X.mT
    passed: float = 1
    kept: float = 1
    outward: bool = False


def _written(ways: Ways) -> Any:
    """Write RNEA in one of those ways."""

    def wrong(parent: Any, S: Any, I: Any, X: Any, qd: Any, qdd: Any, a0: Any) -> Any:
        bodies = range(1, len(parent))
        V, A, need, F, tau = ([np.zeros(6)] * len(parent) for _ in range(5))
        A[0] = ways.gravity * a0
        for i in bodies:
            V[i] = X[i] @ V[parent[i]] + S[i] @ qd[i]
            bias = ways.coriolis * tw.cross_motion(V[i]) @ S[i] @ qd[i]
            A[i] = ways.carried * X[i] @ A[parent[i]] + ways.own * S[i] @ qdd[i] + bias
            classical = ways.classical * np.concatenate([np.zeros(3), np.cross(V[i][:3], V[i][3:])])
            need[i] = I[i] @ (A[i] + classical) + ways.gyroscopic(V[i]) @ I[i] @ V[i]
        for i in bodies if ways.outward else reversed(bodies):
            F[i] = ways.kept * F[i] + need[i]
            tau[i] = S[i].mT @ F[i]
            F[parent[i]] = F[parent[i]] + ways.passed * ways.inward(X[i]) @ F[i]
        return np.concatenate(tau[1:])

    return wrong


def _motions(rng: Any) -> Any:
    return [
        (*lists, pieces(model, rng), pieces(model, rng), np.concatenate([np.zeros(3), -model.gravity]))
        for model, *lists in trees(rng)
    ]


def _power(answer: Any, parent: Any, S: Any, I: Any, X: Any, qd: Any, qdd: Any, a0: Any) -> Any:
    """Return the power of the joint forces less that of what the bodies need: V·(I A), as V × V is zero."""
    V, A, power = [np.zeros(6)], [a0], 0.0
    for i in range(1, len(parent)):
        V.append(X[i] @ V[parent[i]] + S[i] @ qd[i])
        A.append(X[i] @ A[parent[i]] + S[i] @ qdd[i] + tw.cross_motion(V[i]) @ S[i] @ qd[i])
        power += V[i] @ I[i] @ A[i]
    return answer @ np.concatenate(qd[1:]) - power


RNEA = Part(
    solution=tree_rnea,
    doc=described(
        Text(
            "Return the joint forces that make a motion happen, by RNEA.",
            "用 RNEA 返回产生给定运动所需的关节力。",
        ),
        Text(
            """qd, qdd: lists of n arrays (k,), rad/s and rad/s² or m/s and m/s².
            a0: array (6,), −g as a spatial acceleration of the world: (0, 0, 0, 0, 0, 9.81).
            Returns: array (nv,), N m and N, the joints one after the other: `np.concatenate(tau[1:])`.""",
            """qd、qdd：n 个数组 (k,) 的列表，rad/s 与 rad/s²，或 m/s 与 m/s²。
            a0：数组 (6,)，把 −g 作为世界的空间加速度：(0, 0, 0, 0, 0, 9.81)。
            返回：数组 (nv,)，N m 与 N，按关节顺序排列：`np.concatenate(tau[1:])`。""",
        ),
    ),
    returns=(Quantity("τ"),),
    cases=_motions,
    slips={
        "gravity-missing": _written(Ways(gravity=0)),
        "gravity-sign": _written(Ways(gravity=-1)),
        "acceleration-not-carried": _written(Ways(carried=0)),
        "own-acceleration-missing": _written(Ways(own=0)),
        "coriolis-missing": _written(Ways(coriolis=0)),
        "coriolis-sign": _written(Ways(coriolis=-1)),
        "classical-acceleration": _written(Ways(classical=1)),
        "gyroscopic-missing": _written(Ways(gyroscopic=lambda V: np.zeros((6, 6)))),
        "gyroscopic-sign": _written(Ways(gyroscopic=lambda V: -tw.cross_force(V))),
        "motion-cross-for-force": _written(Ways(gyroscopic=tw.cross_motion)),
        "force-outward": _written(Ways(inward=lambda X: np.linalg.inv(X).mT)),
        "motion-for-force": _written(Ways(inward=np.linalg.inv)),
        "children-overwritten": _written(Ways(kept=0)),
        "children-dropped": _written(Ways(passed=0)),
        "force-sign": _written(Ways(passed=-1)),
        "visited-outward": _written(Ways(outward=True)),
        "chain-for-tree": lambda parent, *rest: tree_rnea(previous(parent), *rest),
        "velocity-terms-missing": lambda parent, S, I, X, qd, qdd, a0: tree_rnea(
            parent, S, I, X, [0 * rate for rate in qd], qdd, a0
        ),
    },
    reasons={
        "gravity-sign": Text(
            "a0 is −g already, and points up: begin with it as it is.", "a0 已经是 −g，方向向上：直接用它作为初值。"
        ),
        "gravity-missing": Text("Begin with A[0] = a0, which is −g.", "从 A[0] = a0 开始，它就是 −g。"),
        "force-sign": Text(
            "What the child needs the parent must give in addition: add.", "子物体所需的，父物体要额外提供：应当相加。"
        ),
        "velocity-terms-missing": Text(
            "Without qd the terms V × S q̇ and V ×* I V vanish.", "不用 qd，V × S q̇ 和 V ×* I V 就都没有了。"
        ),
        "motion-for-force": Text(
            "A wrench comes inward by X[i]ᵀ; X[i]⁻¹ is for twists.", "wrench 用 X[i]ᵀ 向内传；X[i]⁻¹ 是用于 twist 的。"
        ),
    },
    alike=(frozenset({"children-overwritten", "children-dropped", "visited-outward"}),),  # lost in any case
    properties=(
        Property(
            Text(
                "the power of the joints is what the bodies take: τ·q̇ = Σ Vᵀ I A",
                "关节功率等于各刚体所需：τ·q̇ = Σ Vᵀ I A",
            ),
            _power,
        ),
    ),
)

ENERGY = Part(
    solution=tree_energy,
    doc=described(
        Text(
            "Return the kinetic energy, body by body. It is ½ q̇ᵀM q̇, and so it checks M.",
            "逐个刚体返回动能：它等于 ½ q̇ᵀM q̇，可用来检验用别的方法得到的 M。",
        ),
        Text(
            "qd: list of n arrays (k,), rad/s or m/s.\nReturns: a number, J.",
            "qd：n 个数组 (k,) 的列表，rad/s 或 m/s。\n返回：一个数，J。",
        ),
    ),
    returns=(Quantity("T", unit="J"),),
    cases=lambda rng: [(*lists, pieces(model, rng)) for model, *lists in trees(rng)],
    slips={
        "half-missing": lambda *lists: 2 * tree_energy(*lists),
        "twist-not-carried": lambda parent, S, I, X, qd: sum(
            (S[i] @ qd[i]) @ I[i] @ (S[i] @ qd[i]) / 2 for i in range(1, len(parent))
        ),
        "untransformed": lambda parent, S, I, X, qd: tree_energy(parent, S, I, [np.eye(6)] * len(X), qd),
        "inverse-transform": lambda parent, S, I, X, qd: tree_energy(parent, S, I, [*map(np.linalg.inv, X)], qd),
        "force-for-motion": lambda parent, S, I, X, qd: tree_energy(parent, S, I, [np.linalg.inv(x).mT for x in X], qd),
        "chain-for-tree": lambda parent, *rest: tree_energy(previous(parent), *rest),
    },
    reasons={
        "untransformed": Text(
            "V of the parent is in the parent's frame: X[i] brings it into frame i.",
            "父物体的 V 在父坐标系中：用 X[i] 变到坐标系 i。",
        ),
        "inverse-transform": Text(
            "X[i] already leads from the parent's frame to frame i.", "X[i] 本来就是从父坐标系到坐标系 i。"
        ),
    },
)
