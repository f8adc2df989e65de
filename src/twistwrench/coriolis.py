"""The Coriolis matrix (49.6, 49.9)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import Array
from .door import state_of
from .inertia import cross_force, cross_motion
from .model import Model
from .plucker import blocks
from .rotation import cross_matrix
from .tree import split, walk

__all__ = ["coriolis_matrix"]


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
    q, v = state_of(model, q, v=v)
    tree, qd = walk(model, q), split(model, v)
    V = [np.zeros(6, q.dtype)] * model.nbodies
    J = [np.zeros((6, 0), q.dtype)] * model.nbodies  # columns of the joints on the way to the base only
    dJ, dofs = [*J], [np.zeros(0, int)] * model.nbodies
    C = np.zeros((*q.shape[:-1], model.nv, model.nv), q.dtype)
    for i in tree.outward:
        p, I, own = tree.parent[i], tree.I[i], np.broadcast_to(tree.S[i], (*q.shape[:-1], *tree.S[i].shape))
        V[i] = np.matvec(tree.X[i], V[p]) + np.matvec(tree.S[i], qd[i])
        J[i] = np.concatenate([tree.X[i] @ J[p], own], axis=-1)
        dJ[i] = np.concatenate([tree.X[i] @ dJ[p], cross_motion(V[i]) @ own], axis=-1)
        dofs[i] = np.concatenate([dofs[p], np.arange(model.nv)[model.v_slice[i]]])
        B = (cross_force(V[i]) @ I - I @ cross_motion(V[i]) + _cross_bar(np.matvec(I, V[i]))) / 2
        C[..., dofs[i][:, None], dofs[i]] += J[i].mT @ (I @ dJ[i] + B @ J[i])
    return C


def _cross_bar(h: Array) -> Array:
    """Return h×̄* = −[[τ]×, [f]×; [f]×, 0], shape (..., 6, 6): the matrix that takes a twist x to x ×* h."""
    moment, force = cross_matrix(h[..., :3]), cross_matrix(h[..., 3:])
    return -blocks(moment, force, force, np.zeros_like(force))
