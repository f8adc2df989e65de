"""Articulated-body inertias, which depend on the posture alone: pass 2 of the ABA without its forces (49.7)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..errors import SingularError
from ..model import Model, Tree, cast, check_state, tree_terms
from ..spatial.formulas import inverse, symmetric
from .singular import refuse_singular, refuse_weightless
from .terms import ArticulatedTerms

__all__ = ["articulated_inertia", "articulated_inertias", "find_inertias"]


def articulated_inertias(tree: Tree) -> ArticulatedTerms:
    """Go from the tips to the root (RBDA section 7.2.2): what a free joint gives way to, does not reach its parent."""
    parent, S, X = tree.parent, tree.S, tree.X
    U, D, D_inv = tree.zeros(3)
    IA = [*tree.I]
    for i in tree.inward:
        p = parent[i]
        U[i] = IA[i] @ S[i]
        D[i] = S[i].mT @ U[i] + tree.rotor[i]
        D_inv[i] = inverse(D[i])
        left = symmetric(IA[i] - U[i] @ D_inv[i] @ U[i].mT)
        IA[p] = IA[p] + X[i].mT @ left @ X[i]  # 49.7 IA_alone
    return ArticulatedTerms(IA, U, D, D_inv)


def find_inertias(model: Model, tree: Tree) -> ArticulatedTerms:
    """Return the articulated-body inertias; raise SingularError with the name of a joint that moves no inertia."""
    try:
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # D singular: `refuse_singular`
            terms = articulated_inertias(tree)
    except ZeroDivisionError:  # fractions raise where floats are infinite
        refuse_weightless(model, tree)
        raise SingularError("a joint moves no inertia with its outboard joints free: M is singular") from None
    refuse_singular(model, tree, terms)
    return terms


def articulated_inertia(model: Model, q: ArrayLike, frame: str) -> Array:
    """Return the articulated-body inertia of a named body: what it takes to accelerate it, its outboard joints free.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    frame : str
        A link or a joint, also one that is welded: then of the body that carries it.

    Returns
    -------
    ndarray, shape (..., 6, 6)
        At the frame's origin in the frame's axes, rows and columns (angular, linear): kg m², kg m, kg. It is the
        body's apparent inertia if it were cut off its parent.

    Raises
    ------
    SingularError
        If a joint moves no inertia, to rounding. Names the joints.
    NameNotFound
        If the model has no such frame.
    ShapeError, ValueError
        As `Model.state`.

    Notes
    -----
    Section 49.7; Featherstone, RBDA section 7.1.

    Examples
    --------
    The trunk of a Go2 is lifted as if it had 13.4 kg of the robot's 16.1: its legs need not follow.

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> tw.articulated_inertia(model, model.standing(), "base")[5, 5].round(1)
    np.float64(13.4)
    """
    (q,) = check_state(model, q)
    at = model.frame(frame)
    X = cast(at.placement, q.dtype).motion_transform()
    IA: Array = X.mT @ find_inertias(model, tree_terms(model, q)).IA[at.body] @ X
    return np.broadcast_to(IA, (*q.shape[:-1], 6, 6))
