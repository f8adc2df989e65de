"""The Coriolis matrix (49.6)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..model import Model, Tree, check_state, columns, tree_terms
from ..spatial.rotation import cross_matrix
from ._mimic import also_of_mimics

__all__ = ["christoffel", "coriolis_matrix"]


def christoffel(tree: Tree, qd: list[Array]) -> Array:
    """Add up C = Σ Jᵢᵀ (Iᵢ J̇ᵢ + Bᵢ Jᵢ); J[i] has the columns of the joints on the way to the base, and no others.

    Both terms hold Iᵢ (0, v × Jω) for the velocity v of the body's origin, with opposite signs. It is left out of both:
    dJ[i] is J̇ᵢ − (0, v × Jω), and Bᵢ has only its part on the angular rows. So only the
    growth of v from body to body enters, and no rounding of m v² is left in C v.
    """
    parent, S, I, X, end = tree.parent, tree.S, tree.I, tree.X, np.cumsum(tree.nv)
    omega, J, dJ = tree.zeros(3)
    J[0] = dJ[0] = omega[0][..., :0]
    omega[0] = omega[0][..., :3, :]
    dofs = [np.arange(0)] * len(parent)
    C = np.zeros((*tree.batch, end[-1], end[-1]), omega[0].dtype)
    for i in tree.outward:
        p, own = parent[i], np.broadcast_to(S[i], (*tree.batch, *S[i].shape))
        omega[i] = X[i][..., :3, :3] @ omega[p] + S[i][..., :3, :] @ qd[i]
        growth = X[i][..., 3:, :3] @ omega[p] + S[i][..., 3:, :] @ qd[i]  # of v on the way from the parent's origin
        w, carried = cross_matrix(omega[i][..., 0]), X[i] @ J[p]
        J[i] = np.concatenate([carried, own], axis=-1)
        dJ[i] = np.concatenate([_moved(X[i] @ dJ[p], growth, carried), _turned(w, own)], axis=-1)
        dofs[i] = np.concatenate([dofs[p], np.arange(end[i - 1], end[i])])
        B = _turning(I[i], omega[i], w)  # 49.6 B
        C[..., dofs[i][:, None], dofs[i]] += J[i].mT @ (I[i] @ dJ[i] + B @ J[i][..., :3, :])  # 49.6 C
    return C


def _moved(dJ: Array, growth: Array, J: Array) -> Array:
    """Return dJ − (0, growth × Jω)."""
    linear = dJ[..., 3:, :] - cross_matrix(growth[..., 0]) @ J[..., :3, :]
    return np.concatenate([dJ[..., :3, :], linear], axis=-2)


def _turned(w: Array, S: Array) -> Array:
    """Return (ω × Sω, ω × Sv): what V × S is without v."""
    return np.concatenate([w @ S[..., :3, :], w @ S[..., 3:, :]], axis=-2)


def _turning(I: Array, omega: Array, w: Array) -> Array:
    """Return the angular columns of B without v, shape (..., 6, 3); of the linear columns nothing is left.

    With the momentum (k, l) of the turning alone and the rotational inertia J they are ½ (ω× J − J ω× − k×) and −l×.
    """
    J, momentum = I[..., :3, :3], I[..., :, :3] @ omega
    angular = (w @ J - J @ w - cross_matrix(momentum[..., :3, 0])) / 2
    return np.concatenate([angular, -cross_matrix(momentum[..., 3:, 0])], axis=-2)


@also_of_mimics
def coriolis_matrix(model: Model, q: ArrayLike, v: ArrayLike) -> Array:
    """Return the C(q, v) of Christoffel's symbols: C v = h − g, and Ṁ − 2C is skew-symmetric.

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
    and P. M. Wensing, 2021. The linear velocity of a floating base cancels, and is left out. O(N d²).

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
