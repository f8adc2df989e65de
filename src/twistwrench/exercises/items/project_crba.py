"""The project, stage 2: CRBA on a tree, and how it goes wrong."""

from functools import partial
from typing import Any

import numpy as np

from misstep.exercise import Output, Part
from misstep.faults import after

from ...algorithms.crba import composite_rigid_body
from ...model import composite_inertias
from ..wrong import doubled, faulty
from .project_rnea import tree_energy
from .project_trees import previous, tree_of, trees, with_massless_link

__all__ = ["CRBA", "tree_crba"]


def tree_crba(parent: Any, S: Any, I: Any, X: Any) -> Any:
    """Mass matrix."""
    return composite_rigid_body(tree_of(parent, S, I, X, np.zeros(6))).M


def _energies(answer: Any, parent: Any, S: Any, I: Any, X: Any) -> Any:
    """Return ½ q̇ᵀM q̇ less the energy of the bodies, for some q̇."""
    rates = np.random.default_rng(0).standard_normal((3, len(answer)))
    cuts = np.cumsum([s.shape[1] for s in S])[:-1]
    return [qd @ answer @ qd / 2 - tree_energy(parent, S, I, X, np.split(qd, cuts)) for qd in rates]


def _summed_outward(parent: Any, S: Any, I: Any, X: Any) -> Any:
    """Finish all composite inertias first, from the base to the tips."""
    tree = tree_of(parent, S, I, X, np.zeros(6))
    sums = faulty(composite_inertias, ("tree.inward", "tree.outward"))(tree)
    return _changed((CARRIED, ""))(parent, S, sums, X)


def _blocks_doubled(parent: Any, S: Any, I: Any, X: Any) -> Any:
    """Mirror a matrix whose blocks on the diagonal are filled already."""
    M = tree_crba(parent, S, I, X)
    joint = np.repeat(np.arange(len(S)), [s.shape[1] for s in S])
    return np.where(joint[:, None] == joint, doubled(M), M)


_changed = partial(faulty, tree_crba, of=composite_rigid_body)

CARRIED = " + symmetric(X[i].mT @ IC[i] @ X[i])"
AS_IT_IS = ("symmetric(S", "(S")
"""Leave a block that a slip has made asymmetric as the student finds it."""

CRBA = Part(
    solution=tree_crba,
    beside=(tree_of, composite_rigid_body),
    returns=(Output("M"),),
    cases=lambda rng: [tuple(lists) for _, *lists in trees(rng)],
    edges=lambda rng: [with_massless_link(rng)[1:]],
    slips={
        "subtree-left-out": _changed((CARRIED, "")),
        "inertia-half-rotated": _changed((CARRIED, " + X[i].mT @ IC[i]"), AS_IT_IS),
        "inertia-like-motion": _changed((CARRIED, " + np.linalg.inv(X[i]) @ IC[i] @ X[i]"), AS_IT_IS),
        "inverse-transform": _changed(
            (CARRIED, " + np.linalg.inv(X[i]).mT @ IC[i] @ np.linalg.inv(X[i])"),
            ("X[j].mT @ F", "np.linalg.inv(X[j]).mT @ F"),
        ),
        "force-outward": _changed(("X[j].mT @ F", "np.linalg.inv(X[j]).mT @ F")),
        "motion-for-force": _changed(("X[j].mT @ F", "np.linalg.inv(X[j]) @ F")),
        "untransposed": _changed(("X[j].mT @ F", "X[j] @ F")),
        "congruence-reversed": _changed((CARRIED, " + X[i] @ IC[i] @ X[i].mT")),
        "own-share-only": _summed_outward,
        "transform-of-parent": _changed(("X[j].mT @ F", "X[parent[j]].mT @ F")),
        "transform-of-start": _changed(("X[j].mT @ F", "X[i].mT @ F")),
        "joints-missing": _changed(("parent[j] > 0", "parent[j] > 1")),
        "off-diagonal-missing": _changed(("while parent[j] > 0", "while False")),
        "one-for-each": _changed(("while parent[j] > 0", "while j == i and parent[j] > 0")),
        "blocks-doubled": _blocks_doubled,
        "chain-for-tree": lambda parent, *rest: tree_crba(previous(parent), *rest),
        "one-triangle": after(tree_crba, np.triu),
        "doubled-off-diagonal": after(tree_crba, doubled),
    },
    residuals=(
        lambda answer, *lists: answer - answer.mT,
        _energies,
    ),
)
