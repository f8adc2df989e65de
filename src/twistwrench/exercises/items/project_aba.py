"""The project, stage 2: ABA on a tree, and how it goes wrong."""

from functools import partial
from typing import Any

import numpy as np

from misstep.exercise import Output, Part

from ...algorithms.aba import articulated_body
from ..wrong import faulty
from .project_rnea import tree_rnea
from .project_trees import columns, motions, previous, tree_of

__all__ = ["ABA", "tree_aba"]


def tree_aba(parent: Any, S: Any, I: Any, X: Any, qd: Any, tau: Any, a0: Any) -> Any:
    """Accelerations under joint forces."""
    no_wrench = [np.zeros((6, 1))] * len(parent)
    return articulated_body(tree_of(parent, S, I, X, a0), columns(qd), columns(tau), no_wrench).qdd


def _back(answer: Any, parent: Any, S: Any, I: Any, X: Any, qd: Any, tau: Any, a0: Any) -> Any:
    """Return RNEA of the answer less the torques, over the largest acceleration."""
    qdd = np.split(answer, np.cumsum([s.shape[1] for s in S])[:-1])
    wanted = np.concatenate(tau[1:])
    return (tree_rnea(parent, S, I, X, qd, qdd, a0) - wanted) / np.abs(answer).max()


_changed = partial(faulty, tree_aba, of=articulated_body)

ABA = Part(
    solution=tree_aba,
    beside=(tree_of, columns, articulated_body),
    rtol=1e-8,
    returns=(Output("q̈"),),
    cases=motions,
    slips={
        "gravity-missing": _changed(("-tree.gravity", "0 * tree.gravity")),
        "gravity-sign": _changed(("-tree.gravity", "tree.gravity")),
        "gravity-untransformed": _changed(("X[i] @ A[parent[i]]", "(X[i] @ A[parent[i]] if parent[i] else A[0])")),
        "gravity-of-first": _changed(("X[i] @ A[parent[i]]", "(i == 1 or parent[i] > 0) * X[i] @ A[parent[i]]")),
        "coriolis-missing": _changed(("c[i] = cross", "c[i] = 0 * cross")),
        "coriolis-sign": _changed(("c[i] = cross", "c[i] = -cross")),
        "coriolis-of-parent": _changed(("cross_motion(V[i])", "cross_motion(V[parent[i]])")),
        "coriolis-inward-only": _changed(("A[parent[i]] + c[i]", "A[parent[i]]")),
        "coriolis-late": _changed(("u[i] - U[i].mT @ a", "u[i] - U[i].mT @ (a - c[i])")),
        "gyroscopic-missing": _changed(("bias_wrench", "0 * bias_wrench")),
        "gyroscopic-sign": _changed(("bias_wrench", "-bias_wrench")),
        "gyroscopic-of-rotation": _changed(
            ("bias_wrench(I[i], V[i])", "cross_motion(V[i] * ([[1]] * 3 + [[0]] * 3)) @ I[i] @ V[i]")
        ),
        "bias-sign": _changed(("tau[i] - S[i].mT @ pA[i]", "tau[i] + S[i].mT @ pA[i]")),
        "composite-for-articulated": _changed(("IA[i] - U[i] @ D_inv[i] @ U[i].mT", "IA[i]")),
        "articulated-bias": _changed((" + Ia[i] @ c[i]", "")),
        "apparent-before-joint": _changed(("Ia[i] @ c[i]", "IA[i] @ c[i]")),
        "diagonal-of-d": _changed(("inverse(D[i])", "np.diag(1 / np.diag(D[i]))")),
        "joint-force-not-passed": _changed((" + U[i] @ D_inv[i] @ u[i]", "")),
        "children-dropped": _changed((" + symmetric(X[i].mT @ Ia[i] @ X[i])", ""), (" + X[i].mT @ pa[i]", "")),
        "acceleration-not-carried": _changed(("X[i] @ A[parent[i]] + c[i]", "c[i]")),
        "own-acceleration-missing": _changed((" + S[i] @ qdd[i]", "")),
        "force-outward": _changed(("X[i].mT @ pa[i]", "np.linalg.inv(X[i]).mT @ pa[i]")),
        "inertia-half-rotated": _changed(
            ("symmetric(X[i].mT @ Ia[i] @ X[i])", "X[i].mT @ Ia[i]"), ("symmetric(IA", "(IA")
        ),
        "untransposed": _changed(("X[i].mT @ pa[i]", "X[i] @ pa[i]")),
        "carried-motion-missing": _changed(("u[i] - U[i].mT @ a", "u[i]")),
        "torques-missing": _changed(("tau[i] - S[i].mT", "-S[i].mT")),
        "chain-for-tree": lambda parent, *rest: tree_aba(previous(parent), *rest),
    },
    residuals=(_back,),
)
