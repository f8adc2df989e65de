"""M = Lᵀ D L along the tree: a factorisation that keeps the zeros of M, and solves with it (49.8).

Row k of M has entries in the columns of the degrees of freedom that carry k, inboard of it, and of those that k
carries. Elimination from the tips inward combines each row with rows inboard of it only, so that L has no entry where
M has none. Cholesky's usual order, from the root outward, fills the zeros in: once the base is eliminated, every leg is
coupled to every other.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, check_overflow, comparable, resolution
from ..errors import SingularError
from ..model import Model, Tree, check_state, joint_name_at, tree_terms
from ..spatial._elementary import at_first_index, sqrt
from .crba import composite_rigid_body
from .singular import ROUNDINGS

__all__ = [
    "factorize",
    "factorize_mass_matrix",
    "inboard_dofs",
    "ltdl",
    "ltl",
    "solve_inward",
    "solve_mass_matrix",
    "solve_outward",
]


def inboard_dofs(tree: Tree) -> list[list[int]]:
    """Return for each degree of freedom those inboard of it, from the root outward.

    Those of one joint stand in a row, as if massless links were between them: RBDA's expanded parent array, followed
    to its end.
    """
    of_body: list[list[int]] = [[]]
    of_dof: list[list[int]] = []
    for i in tree.outward:
        inboard = of_body[tree.parent[i]]
        for _ in range(tree.nv[i]):
            of_dof.append(inboard)
            inboard = [*inboard, len(of_dof) - 1]
        of_body.append(inboard)
    return of_dof


def factorize(M: Array, inboard: list[list[int]]) -> tuple[Array, Array]:
    """Return L, unit lower triangular, and the diagonal D, with M = Lᵀ D L (RBDA section 6.5, LTDL).

    Row k is final when all its outboard rows have been eliminated. It then changes the rows inboard of it, in the
    columns inboard of them, and those only.
    """
    L, n = M.copy(), M.shape[-1]
    for k in reversed(range(n)):
        try:
            scaled = L[..., k, inboard[k]] / L[..., k, k, None]  # 49.8 L
        except ZeroDivisionError:  # fractions raise where floats are infinite
            raise ZeroDivisionError(k) from None
        for place, i in enumerate(inboard[k]):
            j = inboard[k][: place + 1]  # those inboard of i, and i itself
            L[..., i, j] = L[..., i, j] - scaled[..., place, None] * L[..., k, j]  # 49.8 LTDL
        L[..., k, inboard[k]] = scaled
    D = np.diagonal(L, axis1=-2, axis2=-1).copy()
    return np.tril(L, -1) + np.eye(n, dtype=M.dtype), D


def solve_inward(L: Array, inboard: list[list[int]], B: Array) -> Array:
    """Return L⁻ᵀ B: each row passes its share inward. A column that is zero off a branch stays so."""
    Y = B.copy()
    for k in reversed(range(len(inboard))):
        Y[..., inboard[k], :] = Y[..., inboard[k], :] - L[..., k, inboard[k], None] * Y[..., k, None, :]  # 49.8 inward
    return Y


def solve_outward(L: Array, inboard: list[list[int]], B: Array) -> Array:
    """Return L⁻¹ B: each row takes what the rows inboard of it bring."""
    Y = B.copy()
    for k in range(len(inboard)):
        for i in inboard[k]:
            Y[..., k, :] = Y[..., k, :] - L[..., k, i, None] * Y[..., i, :]  # 49.8 outward
    return Y


def factorize_mass_matrix(model: Model, tree: Tree) -> tuple[Array, Array, list[list[int]]]:
    """Return L and D of the mass matrix and the inboard degrees of freedom; raise SingularError where D is lost."""

    def singular(k: int, where: str = "") -> SingularError:
        said = "with its outboard joints free it moves no inertia beyond rounding"
        return SingularError(f"M is singular at joint {joint_name_at(model, k)!r}: {said}{where}")

    M, inboard = composite_rigid_body(tree).M, inboard_dofs(tree)
    try:
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            L, D = factorize(M, inboard)
    except ZeroDivisionError as error:
        raise singular(*error.args) from None
    size, exact = comparable(np.diagonal(M, axis1=-2, axis2=-1)), D.dtype == object
    least = 0 * size if exact else np.maximum(size * ROUNDINGS * resolution(D.dtype), np.finfo(D.dtype).tiny)
    lost = comparable(D) <= least if exact else ~(D.real > least)  # a symbol has no value to check
    if lost.any():
        k = int(np.argwhere(lost)[:, -1].max())  # the first that was eliminated; those inboard of it are lost with it
        raise singular(k, at_first_index(np.asarray(lost[..., k])))
    return L, D, inboard


def ltdl(model: Model, q: ArrayLike) -> tuple[Array, Array]:
    """Return L and D with M(q) = Lᵀ diag(D) L, where L has its zeros where M has them.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    L : ndarray, shape (..., nv, nv)
        Lower triangular, with ones on the diagonal.
    D : ndarray, shape (..., nv)
        Each positive: the inertia of a degree of freedom with all outboard ones free, the D of the ABA.

    Raises
    ------
    SingularError
        If M is singular, to rounding. Names the joint.
    ShapeError, ValueError
        As `Model.state`.

    Notes
    -----
    Section 49.8; Featherstone, RBDA section 6.5. O(N d²) for a tree of depth d. The loops are in `factorize`;
    `twistwrench.solve_mass_matrix` solves with the factors, and `twistwrench.ltl` has square roots.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> L, D = tw.ltdl(model, model.standing())
    >>> np.allclose(L.mT @ (D[:, None] * L), tw.crba(model, model.standing()), rtol=0, atol=1e-14)
    True
    >>> bool(L[12:15, 6:9].any())  # between two legs: zero
    False
    """
    (q,) = check_state(model, q)
    L, D, _ = factorize_mass_matrix(model, tree_terms(model, q))
    return L, D


def ltl(model: Model, q: ArrayLike) -> Array:
    """Return the lower triangular L with M(q) = LᵀL, zero where M is zero.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    ndarray, shape (..., nv, nv)
        Its diagonal is positive.

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `ltdl`.

    Notes
    -----
    The rows of `ltdl` times √D. Cholesky's factor of `numpy.linalg.cholesky` is another one: M = L Lᵀ eliminates from
    the root outward and fills the zeros in.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> M, L = tw.crba(model, model.standing()), tw.ltl(model, model.standing())
    >>> legs = slice(12, 15), slice(6, 9)  # the coupling of two legs, nine entries
    >>> [int(np.count_nonzero(x[legs])) for x in (M, L, np.linalg.cholesky(M))]
    [0, 0, 9]
    """
    L, D = ltdl(model, q)
    return sqrt(D)[..., None] * L  # 49.8 LTL


def solve_mass_matrix(model: Model, q: ArrayLike, tau: ArrayLike) -> Array:
    """Return the x with M(q) x = τ, by LᵀDL along the tree.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    tau : array_like, shape (..., nv)
        Joint forces, N m or N; minus h, for the acceleration of a robot that moves.

    Returns
    -------
    ndarray, shape (..., nv)
        rad/s² or m/s².

    Raises
    ------
    SingularError, ShapeError, ValueError
        As `ltdl`.

    Notes
    -----
    Two passes, as in `rnea`, the other way round: L⁻ᵀ from the tips inward, D⁻¹, L⁻¹ outward. `aba` finds the same
    acceleration without M and keeps more digits where heavy bodies hang on light ones.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> q, rest, tau = model.standing(), np.zeros(model.nv), np.linspace(-1, 1, model.nv)
    >>> qdd = tw.solve_mass_matrix(model, q, tau - tw.nonlinear_effects(model, q, rest))
    >>> np.allclose(qdd, tw.aba(model, q, rest, tau), rtol=0, atol=1e-10)
    True
    """
    q, tau = check_state(model, q, tau=tau)
    L, D, inboard = factorize_mass_matrix(model, tree_terms(model, q))
    with np.errstate(over="ignore", invalid="ignore"):
        Y = solve_inward(L, inboard, tau[..., None]) / D[..., None]
        qdd = solve_outward(L, inboard, Y)[..., 0]
    check_overflow(qdd, "tau")
    return qdd
