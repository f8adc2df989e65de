"""The project, stage 2: RNEA on a tree, the energy of its motion, and how the recursion goes wrong."""

from functools import partial
from typing import Any

import numpy as np

from misstep.exercise import Output, Part

from ...algorithms.kinematics import motion
from ...algorithms.rnea import newton_euler
from ..wrong import faulty
from .project_trees import columns, motions, pieces, previous, tree_of, trees, upward, with_massless_link

__all__ = ["ENERGY", "RNEA", "tree_energy", "tree_rnea"]


def tree_rnea(parent: Any, S: Any, I: Any, X: Any, qd: Any, qdd: Any, a0: Any) -> Any:
    """Joint forces of a motion."""
    no_wrench = [np.zeros((6, 1))] * len(parent)
    return newton_euler(tree_of(parent, S, I, X, a0), columns(qd), columns(qdd), no_wrench).tau


def tree_energy(parent: Any, S: Any, I: Any, X: Any, qd: Any) -> Any:
    """Kinetic energy, body by body."""
    rates = columns(qd)
    V, _ = motion(tree_of(parent, S, I, X, np.zeros(6)), rates, [0 * rate for rate in rates])
    return sum((Vi.mT @ Ii @ Vi).item() / 2 for Ii, Vi in zip(I, V))


def _steiner(I: Any, V: Any) -> Any:
    """Return the energy of a body's mass, put at its centre of mass, in the rotation alone."""
    mc_cross_w = I[:3, 3:] @ V[:3]
    return (mc_cross_w.mT @ mc_cross_w).item() / (2 * I[5, 5]) if I[5, 5] else 0.0


def _without_a_mass(rng: Any) -> Any:
    model, *lists = with_massless_link(rng)
    return [(*lists, pieces(model, rng), pieces(model, rng), upward(rng)[0])]


def _power(answer: Any, parent: Any, S: Any, I: Any, X: Any, qd: Any, qdd: Any, a0: Any) -> Any:
    """Return the power of the joint forces less that of what the bodies need: V·(I A), as V × V is zero."""
    no_wrench = [np.zeros((6, 1))] * len(parent)
    terms = newton_euler(tree_of(parent, S, I, X, a0), columns(qd), columns(qdd), no_wrench)
    power = sum(Vi @ Ii @ Ai for Ii, Vi, Ai in zip(I, terms.V, terms.A))
    return answer @ np.concatenate(qd[1:]) - power


def _backward(parent: Any, S: Any, *rest: Any) -> Any:
    """Put the joint forces together as the inward pass finds them."""
    starts = np.cumsum([s.shape[1] for s in S])[:-1]
    return np.concatenate(np.split(tree_rnea(parent, S, *rest), starts)[::-1])


_changed = partial(faulty, tree_rnea, of=newton_euler)

RNEA = Part(
    solution=tree_rnea,
    beside=(tree_of, columns, newton_euler),
    returns=(Output("τ"),),
    cases=motions,
    edges=_without_a_mass,
    slips={
        "gravity-missing": _changed(("-tree.gravity", "0 * tree.gravity")),
        "gravity-sign": _changed(("-tree.gravity", "tree.gravity")),
        "acceleration-not-carried": _changed(("X[i] @ A[p] + S[i]", "S[i]")),
        "own-acceleration-missing": _changed((" + S[i] @ qdd[i]", "")),
        "coriolis-missing": _changed((" + cross_motion(V[i]) @ vJ", "")),
        "coriolis-sign": _changed(("+ cross_motion", "- cross_motion")),
        "classical-acceleration": _changed(
            ("I[i] @ A[i]", "I[i] @ (A[i] + np.concatenate([np.zeros((3, 1)), np.cross(V[i][:3], V[i][3:], axis=0)]))")
        ),
        "gravity-untransformed": _changed(("X[i] @ A[p]", "(X[i] @ A[p] if p else A[p])")),
        "coriolis-of-parent": _changed(("cross_motion(V[i])", "cross_motion(V[p])")),
        "gyroscopic-missing": _changed((" + bias_wrench(I[i], V[i])", "")),
        "gyroscopic-sign": _changed(("+ bias_wrench", "- bias_wrench")),
        "gyroscopic-of-rotation": _changed(
            ("bias_wrench(I[i], V[i])", "cross_motion(V[i] * ([[1]] * 3 + [[0]] * 3)) @ I[i] @ V[i]")
        ),
        "motion-cross-for-force": _changed(("bias_wrench(I[i], V[i])", "cross_motion(V[i]) @ I[i] @ V[i]")),
        "force-outward": _changed(("X[i].mT @ F[i]", "np.linalg.inv(X[i]).mT @ F[i]")),
        "motion-for-force": _changed(("X[i].mT @ F[i]", "np.linalg.inv(X[i]) @ F[i]")),
        "children-lost": _changed((" + X[i].mT @ F[i]", "")),
        "force-sign": _changed(("+ X[i].mT @ F[i]", "- X[i].mT @ F[i]")),
        "untransposed": _changed(("X[i].mT @ F[i]", "X[i] @ F[i]")),
        "own-overwritten": _changed(("F[p] + X[i].mT", "X[i].mT")),
        "own-share-only": _changed(("F[p] + X[i].mT @ F[i]", "F[p] + X[i].mT @ B[i]")),
        "joints-backward": _backward,
        "twist-not-carried": _changed(("X[i] @ V[p] + vJ", "vJ")),
        "chain-for-tree": lambda parent, *rest: tree_rnea(previous(parent), *rest),
        "velocity-terms-missing": lambda parent, S, I, X, qd, qdd, a0: tree_rnea(
            parent, S, I, X, [0 * rate for rate in qd], qdd, a0
        ),
    },
    residuals=(_power,),
)

ENERGY = Part(
    solution=tree_energy,
    beside=(tree_of, columns, motion),
    returns=(Output("T", unit="J"),),
    cases=lambda rng: [(*lists, pieces(model, rng)) for model, *lists in trees(rng)],
    edges=lambda rng: [(*lists, pieces(model, rng)) for model, *lists in [with_massless_link(rng)]],
    slips={
        "half-missing": lambda *lists: 2 * tree_energy(*lists),
        "twist-not-carried": faulty(tree_energy, ("X[i] @ V[p] + vJ", "vJ"), of=motion),
        "parents-joint-only": faulty(tree_energy, ("X[i] @ V[p] + vJ", "X[i] @ S[p] @ qd[p] + vJ"), of=motion),
        "inertia-of-origin": faulty(tree_energy, ("for Ii", "+ _steiner(Ii, Vi) for Ii")),
        "com-dropped": faulty(
            tree_energy, ("Vi.mT @ Ii @ Vi", "Vi.mT @ (Ii * np.kron(np.eye(2), np.ones((3, 3)))) @ Vi")
        ),
        "couplings-missing": lambda parent, S, I, X, qd: sum(
            tree_energy(parent, S, I, X, [rate * (k == i) for k, rate in enumerate(qd)]) for i in range(1, len(qd))
        ),
        "untransformed": lambda parent, S, I, X, qd: tree_energy(parent, S, I, [np.eye(6)] * len(X), qd),
        "inverse-transform": lambda parent, S, I, X, qd: tree_energy(parent, S, I, [*map(np.linalg.inv, X)], qd),
        "force-for-motion": lambda parent, S, I, X, qd: tree_energy(parent, S, I, [np.linalg.inv(x).mT for x in X], qd),
        "chain-for-tree": lambda parent, *rest: tree_energy(previous(parent), *rest),
    },
)
