"""The project, stage 2: ABA on a tree, and how it goes wrong."""

from typing import Any

import numpy as np

import twistwrench as tw

from ..exercise import Part, Quantity
from ..wrong import faulty
from .project_rnea import tree_rnea
from .project_trees import pieces, previous, trees

__all__ = ["ABA", "tree_aba"]


def tree_aba(parent: Any, S: Any, I: Any, X: Any, qd: Any, tau: Any, a0: Any) -> Any:
    """Accelerations under joint forces."""
    n = len(parent)
    V, A, c, p, U, D, u, qdd = ([np.zeros(6)] * n for _ in range(8))
    IA, A[0] = list(I), a0
    for i in range(1, n):
        V[i] = X[i] @ V[parent[i]] + S[i] @ qd[i]
        c[i] = tw.cross_motion(V[i]) @ S[i] @ qd[i]
        p[i] = tw.cross_force(V[i]) @ I[i] @ V[i]
    for i in range(n - 1, 0, -1):
        U[i], u[i] = IA[i] @ S[i], tau[i] - S[i].mT @ p[i]
        D[i] = np.linalg.inv(S[i].mT @ U[i])
        Ia = IA[i] - U[i] @ D[i] @ U[i].mT
        pa = p[i] + Ia @ c[i] + U[i] @ D[i] @ u[i]
        IA[parent[i]] = IA[parent[i]] + X[i].mT @ Ia @ X[i]
        p[parent[i]] = p[parent[i]] + X[i].mT @ pa
    for i in range(1, n):
        A[i] = X[i] @ A[parent[i]] + c[i]
        qdd[i] = D[i] @ (u[i] - U[i].mT @ A[i])
        A[i] = A[i] + S[i] @ qdd[i]
    return np.concatenate(qdd[1:])


def _loads(rng: Any) -> Any:
    return [
        (*lists, pieces(model, rng), pieces(model, rng), np.concatenate([np.zeros(3), -model.gravity]))
        for model, *lists in trees(rng)
    ]


def _back(answer: Any, parent: Any, S: Any, I: Any, X: Any, qd: Any, tau: Any, a0: Any) -> Any:
    """Return RNEA of the answer less the torques, over the largest acceleration."""
    qdd = np.split(answer, np.cumsum([s.shape[1] for s in S])[:-1])
    wanted = np.concatenate(tau[1:])
    return (tree_rnea(parent, S, I, X, qd, qdd, a0) - wanted) / np.abs(answer).max()


ABA = Part(
    solution=tree_aba,
    rtol=1e-8,
    returns=(Quantity("q̈"),),
    cases=_loads,
    slips={
        "gravity-missing": faulty(tree_aba, ("list(I), a0", "list(I), 0 * a0")),
        "gravity-sign": faulty(tree_aba, ("list(I), a0", "list(I), -a0")),
        "coriolis-missing": faulty(tree_aba, ("c[i] = tw", "c[i] = 0 * tw")),
        "coriolis-sign": faulty(tree_aba, ("c[i] = tw", "c[i] = -tw")),
        "gyroscopic-missing": faulty(tree_aba, ("p[i] = tw", "p[i] = 0 * tw")),
        "gyroscopic-sign": faulty(tree_aba, ("p[i] = tw", "p[i] = -tw")),
        "bias-sign": faulty(tree_aba, ("tau[i] - S[i].mT @ p[i]", "tau[i] + S[i].mT @ p[i]")),
        "composite-for-articulated": faulty(tree_aba, ("IA[i] - U[i] @ D[i] @ U[i].mT", "IA[i]")),
        "articulated-bias": faulty(tree_aba, (" + Ia @ c[i]", "")),
        "joint-force-not-passed": faulty(tree_aba, (" + U[i] @ D[i] @ u[i]", "")),
        "children-dropped": faulty(tree_aba, (" + X[i].mT @ Ia @ X[i]", ""), (" + X[i].mT @ pa", "")),
        "acceleration-not-carried": faulty(tree_aba, ("X[i] @ A[parent[i]] + c[i]", "c[i]")),
        "own-acceleration-missing": faulty(tree_aba, (" + S[i] @ qdd[i]", "")),
        "force-outward": faulty(tree_aba, ("X[i].mT @ pa", "np.linalg.inv(X[i]).mT @ pa")),
        "inertia-half-rotated": faulty(tree_aba, ("X[i].mT @ Ia @ X[i]", "X[i].mT @ Ia")),
        "untransposed": faulty(tree_aba, ("X[i].mT @ pa", "X[i] @ pa")),
        "carried-motion-missing": faulty(tree_aba, ("u[i] - U[i].mT @ A[i]", "u[i]")),
        "torques-missing": faulty(tree_aba, ("tau[i] - S[i].mT", "-S[i].mT")),
        "chain-for-tree": lambda parent, *rest: tree_aba(previous(parent), *rest),
    },
    residuals=(_back,),
)
