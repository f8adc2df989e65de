"""The Coriolis matrix (49.6, 49.9)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..model import Model, Tree, check_state, columns, tree_terms
from ..spatial.formulas import cross_force, cross_motion
from ..spatial.plucker import blocks
from ..spatial.rotation import cross_matrix
from ._mimic import also_of_mimics

__all__ = ["christoffel", "coriolis_matrix"]


def christoffel(tree: Tree, qd: list[Array]) -> Array:
    """Add up C = Σ Jᵢᵀ (Iᵢ J̇ᵢ + Bᵢ Jᵢ); J[i] has the columns of the joints on the way to the base, and no others."""
    parent, S, I, X, end = tree.parent, tree.S, tree.I, tree.X, np.cumsum(tree.nv)
    V, J, dJ = tree.zeros(3)
    J[0] = dJ[0] = V[0][..., :0]
    dofs = [np.arange(0)] * len(parent)
    C = np.zeros((*tree.batch, end[-1], end[-1]), V[0].dtype)
    for i in tree.outward:
        p, own = parent[i], np.broadcast_to(S[i], (*tree.batch, *S[i].shape))
        V[i] = X[i] @ V[p] + S[i] @ qd[i]
        J[i] = np.concatenate([X[i] @ J[p], own], axis=-1)
        dJ[i] = np.concatenate([X[i] @ dJ[p], cross_motion(V[i]) @ own], axis=-1)
        dofs[i] = np.concatenate([dofs[p], np.arange(end[i - 1], end[i])])
        B = (cross_force(V[i]) @ I[i] - I[i] @ cross_motion(V[i]) + _cross_bar(I[i] @ V[i])) / 2  # 49.6 B
        C[..., dofs[i][:, None], dofs[i]] += J[i].mT @ (I[i] @ dJ[i] + B @ J[i])  # 49.6 C
    return C


@also_of_mimics
def coriolis_matrix(model: Model, q: ArrayLike, v: ArrayLike) -> Array:
    """Return a C(q, v) with C v = h − g and Ṁ − 2C skew-symmetric.

    Many matrices give the same C v. This is the one that Christoffel's symbols give, and Pinocchio's
    ``computeCoriolisMatrix``.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)

    Returns
    -------
    ndarray, shape (..., nv, nv)

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`.

    Notes
    -----
    C = Σ Jᵢᵀ (Iᵢ J̇ᵢ + Bᵢ Jᵢ), where Bᵢ = ½ (V×* I − I V× + (I V)×̄*) and h×̄* x = x ×* h; S. Echeandia
    and P. M. Wensing, Numerical methods to compute the Coriolis matrix and Christoffel symbols for
    rigid-body systems, 2021. The columns of Jᵢ and J̇ᵢ are those of the parent, moved to frame i,
    and the joint's own S and V × S. O(N d²) for a tree of depth d.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("double_pendulum")
    >>> q, v = np.array([0.3, 0.5]), np.array([1.0, -2.0])
    >>> C = tw.coriolis_matrix(model, q, v)
    >>> np.allclose(C @ v, tw.nonlinear_effects(model, q, v) - tw.gravity(model, q), rtol=0, atol=1e-15)
    True
    """
    q, v = check_state(model, q, v=v)
    return christoffel(tree_terms(model, q), columns(model, v))


def _cross_bar(h: Array) -> Array:
    """Return h×̄* = −[[τ]×, [f]×; [f]×, 0], shape (..., 6, 6): the matrix that takes a twist x to x ×* h."""
    moment, force = cross_matrix(h[..., :3, 0]), cross_matrix(h[..., 3:, 0])
    return -blocks(moment, force, force, np.zeros_like(force))
