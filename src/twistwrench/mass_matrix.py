"""The mass matrix by the composite-rigid-body algorithm (49.8)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import Array
from .door import state_of
from .model import Model
from .tree import composite_inertias, walk

__all__ = ["crba"]


def crba(model: Model, q: ArrayLike) -> Array:
    """Return the mass matrix M(q), full and symmetric.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    ndarray, shape (..., nv, nv)
        kg m², kg m and kg. The rows and columns of a floating base are (ω, v).

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`.

    Notes
    -----
    Section 49.8; Featherstone, RBDA table 6.2. A unit acceleration of joint i alone moves its subtree
    as one rigid body, hence the composite inertia; the wrench for it is felt by joint i and by the
    joints on the way to the base, and by no other. O(N d) for a tree of depth d: O(N²) for a chain.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> M = tw.crba(model, model.standing())
    >>> M.shape, M[3:6, 3:6].diagonal().round(3)  # the linear block is the whole mass
    ((18, 18), array([16.085, 16.085, 16.085]))
    """
    (q,) = state_of(model, q)
    tree, at = walk(model, q), model.v_slice
    IC = composite_inertias(tree)
    M = np.zeros((*q.shape[:-1], model.nv, model.nv), q.dtype)
    for i in tree.outward:
        F = IC[i] @ tree.S[i]  # wrench for a unit acceleration of joint i, in frame i
        own = tree.S[i].mT @ F
        M[..., at[i], at[i]] = (own + own.mT) / 2  # symmetric to the last bit, whatever rounding left
        j = i
        while tree.parent[j] > 0:  # on the way to the base
            F = tree.X[j].mT @ F
            j = tree.parent[j]
            M[..., at[j], at[i]] = tree.S[j].mT @ F
            M[..., at[i], at[j]] = M[..., at[j], at[i]].mT
    k = np.arange(model.nv)
    M[..., k, k] += model.constants(q.dtype).armature
    return M
