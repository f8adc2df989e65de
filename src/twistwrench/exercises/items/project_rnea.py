"""The project, stage 2: RNEA on a tree, the energy of its motion, and how the recursion goes wrong."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Part, Quantity
from ..wrong import faulty
from .project_trees import pieces, previous, trees

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
    returns=(Quantity("τ"),),
    cases=_motions,
    slips={
        "gravity-missing": faulty(tree_rnea, ("A[0] = a0", "A[0] = 0 * a0")),
        "gravity-sign": faulty(tree_rnea, ("A[0] = a0", "A[0] = -a0")),
        "acceleration-not-carried": faulty(tree_rnea, ("X[i] @ A[p] + S[i]", "S[i]")),
        "own-acceleration-missing": faulty(tree_rnea, (" + S[i] @ qdd[i]", "")),
        "coriolis-missing": faulty(tree_rnea, (" + tw.cross_motion(V[i]) @ S[i] @ qd[i]", "")),
        "coriolis-sign": faulty(tree_rnea, ("+ tw.cross_motion", "- tw.cross_motion")),
        "classical-acceleration": faulty(
            tree_rnea, ("I[i] @ A[i]", "I[i] @ (A[i] + np.concatenate([np.zeros(3), np.cross(V[i][:3], V[i][3:])]))")
        ),
        "gyroscopic-missing": faulty(tree_rnea, (" + tw.cross_force(V[i]) @ I[i] @ V[i]", "")),
        "gyroscopic-sign": faulty(tree_rnea, ("+ tw.cross_force", "- tw.cross_force")),
        "motion-cross-for-force": faulty(tree_rnea, ("tw.cross_force", "tw.cross_motion")),
        "force-outward": faulty(tree_rnea, ("X[i].mT @ F[i]", "np.linalg.inv(X[i]).mT @ F[i]")),
        "motion-for-force": faulty(tree_rnea, ("X[i].mT @ F[i]", "np.linalg.inv(X[i]) @ F[i]")),
        "children-overwritten": faulty(
            tree_rnea, ("tau[i] = S", "F[i] = I[i] @ A[i] + tw.cross_force(V[i]) @ I[i] @ V[i]; tau[i] = S")
        ),
        "children-dropped": faulty(tree_rnea, (" + X[i].mT @ F[i]", "")),
        "force-sign": faulty(tree_rnea, ("+ X[i].mT @ F[i]", "- X[i].mT @ F[i]")),
        "untransposed": faulty(tree_rnea, ("X[i].mT @ F[i]", "X[i] @ F[i]")),
        "own-overwritten": faulty(tree_rnea, ("F[parent[i]] + X[i].mT", "X[i].mT")),
        "twist-not-carried": faulty(tree_rnea, ("X[i] @ V[p] + S[i]", "S[i]")),
        "visited-outward": faulty(tree_rnea, ("range(n - 1, 0, -1)", "range(1, n)")),
        "chain-for-tree": lambda parent, *rest: tree_rnea(previous(parent), *rest),
        "velocity-terms-missing": lambda parent, S, I, X, qd, qdd, a0: tree_rnea(
            parent, S, I, X, [0 * rate for rate in qd], qdd, a0
        ),
    },
    alike=(frozenset({"children-overwritten", "children-dropped", "visited-outward"}),),  # lost in any case
    residuals=(_power,),
)

ENERGY = Part(
    solution=tree_energy,
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
)
