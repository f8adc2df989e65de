"""The mass matrix by the composite-rigid-body algorithm (49.8)."""

from __future__ import annotations

from numpy.typing import ArrayLike

from ..arrays import Array
from ..model import Model, Tree, check_state, tree_terms
from ..spatial.formulas import symmetric
from ._mimic import also_of_mimics
from .terms import CrbaTerms

__all__ = ["composite_rigid_body", "crba", "crba_terms"]


def composite_rigid_body(tree: Tree) -> CrbaTerms:
    """Run the CRBA (RBDA table 6.2): composite inertias inward, and from each joint its wrench on to the base.

    IC[i] is in frame i, F[j, i] in frame j; M[i, j] is the block of joints i and j. Inertias and wrenches go inward by
    X[i]ᵀ, where the chapter writes X*.
    """
    parent, S, I, X, rotor = tree.parent, tree.S, tree.I, tree.X, tree.rotor
    F: dict[tuple[int, int], Array] = {}
    M: dict[tuple[int, int], Array] = {}

    IC = [*I]  # 49.8 IC: at first the body's own
    for i in tree.inward:
        p = parent[i]
        IC[p] = IC[p] + symmetric(X[i].mT @ IC[i] @ X[i])  # 49.8 IC_p
        F[i, i] = IC[i] @ S[i]  # 49.8 F: wrench for a unit acceleration of joint i
        M[i, i] = symmetric(S[i].mT @ F[i, i]) + rotor[i]  # 49.8 M_ii
        j = i
        while parent[j] > 0:  # on the way to the base
            F[parent[j], i] = X[j].mT @ F[j, i]  # 49.8 F_j
            j = parent[j]
            M[j, i] = S[j].mT @ F[j, i]  # 49.8 M_ji
            M[i, j] = M[j, i].mT  # 49.8 M_ij
    return CrbaTerms.of(tree.batch, IC, F, M, tree.nv)  # 49.8 CRBA


@also_of_mimics
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
    Section 49.8; Featherstone, RBDA table 6.2. O(N d) for a tree of depth d. The loops are in `composite_rigid_body`;
    `twistwrench.crba_terms` returns what they compute. `twistwrench.ltdl` factors M and keeps its zeros.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> M = tw.crba(model, model.standing())
    >>> M.shape, M[3:6, 3:6].diagonal().round(3)  # the linear block is the whole mass
    ((18, 18), array([16.085, 16.085, 16.085]))
    """
    return crba_terms(model, q).M


def crba_terms(model: Model, q: ArrayLike) -> CrbaTerms:
    """Return what the CRBA computes on its way: composite inertias, wrenches of unit accelerations, and M.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    CrbaTerms
        IC for each body, F by pairs of bodies, and M.

    Raises
    ------
    ShapeError, ValueError
        As `crba`.

    Examples
    --------
    The first link of a double pendulum carries both balls of 1 kg when the joints are locked:

    >>> import twistwrench as tw
    >>> tw.crba_terms(tw.load("double_pendulum"), [0.0, 0.0]).IC[1][3, 3]
    np.float64(2.0)
    """
    (q,) = check_state(model, q)
    return composite_rigid_body(tree_terms(model, q))
