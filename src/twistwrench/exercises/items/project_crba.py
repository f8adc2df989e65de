"""The project, stage 2: CRBA on a tree, and how it goes wrong."""

from typing import Any

import numpy as np

from ..exercise import Part, Quantity
from ..wrong import after, faulty
from .project_rnea import tree_energy
from .project_trees import previous, trees

__all__ = ["CRBA", "tree_crba"]


def tree_crba(parent: Any, S: Any, I: Any, X: Any) -> Any:
    """Mass matrix."""
    n, end = len(parent), np.cumsum([s.shape[1] for s in S])
    at = [slice(end[i] - S[i].shape[1], end[i]) for i in range(n)]
    IC = list(I)
    for i in range(n - 1, 0, -1):
        IC[parent[i]] = IC[parent[i]] + X[i].mT @ IC[i] @ X[i]
    M = np.zeros((end[-1], end[-1]))
    for i in range(1, n):
        F, j = IC[i] @ S[i], i
        M[at[i], at[i]] = S[i].mT @ F
        while parent[j] > 0:
            F, j = X[j].mT @ F, parent[j]
            M[at[j], at[i]] = S[j].mT @ F
            M[at[i], at[j]] = M[at[j], at[i]].mT
    return M


def _energies(answer: Any, parent: Any, S: Any, I: Any, X: Any) -> Any:
    """Return ½ q̇ᵀM q̇ less the energy of the bodies, for some q̇."""
    rates = np.random.default_rng(0).standard_normal((3, len(answer)))
    cuts = np.cumsum([s.shape[1] for s in S])[:-1]
    return [qd @ answer @ qd / 2 - tree_energy(parent, S, I, X, np.split(qd, cuts)) for qd in rates]


CRBA = Part(
    solution=tree_crba,
    returns=(Quantity("M"),),
    cases=lambda rng: [tuple(lists) for _, *lists in trees(rng)],
    slips={
        "subtree-left-out": faulty(tree_crba, (" + X[i].mT @ IC[i] @ X[i]", "")),
        "inertia-half-rotated": faulty(tree_crba, ("X[i].mT @ IC[i] @ X[i]", "X[i].mT @ IC[i]")),
        "inertia-like-motion": faulty(tree_crba, ("X[i].mT @ IC[i] @ X[i]", "np.linalg.inv(X[i]) @ IC[i] @ X[i]")),
        "inverse-transform": faulty(
            tree_crba,
            ("X[i].mT @ IC[i] @ X[i]", "np.linalg.inv(X[i]).mT @ IC[i] @ np.linalg.inv(X[i])"),
            ("X[j].mT @ F", "np.linalg.inv(X[j]).mT @ F"),
        ),
        "force-outward": faulty(tree_crba, ("X[j].mT @ F", "np.linalg.inv(X[j]).mT @ F")),
        "motion-for-force": faulty(tree_crba, ("X[j].mT @ F", "np.linalg.inv(X[j]) @ F")),
        "untransposed": faulty(tree_crba, ("X[j].mT @ F", "X[j] @ F")),
        "congruence-reversed": faulty(tree_crba, ("X[i].mT @ IC[i] @ X[i]", "X[i] @ IC[i] @ X[i].mT")),
        "visited-outward": faulty(tree_crba, ("range(n - 1, 0, -1)", "range(1, n)")),
        "joints-missing": faulty(tree_crba, ("parent[j] > 0", "parent[j] > 1")),
        "off-diagonal-missing": faulty(tree_crba, ("while parent[j] > 0", "while False")),
        "chain-for-tree": lambda parent, *rest: tree_crba(previous(parent), *rest),
        "one-triangle": after(tree_crba, np.triu),
        "doubled-off-diagonal": after(tree_crba, lambda M: M + M.mT - np.diag(np.diag(M))),
    },
    residuals=(
        lambda answer, *lists: answer - answer.mT,
        _energies,
    ),
)
