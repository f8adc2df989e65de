"""The apparent inertia at a contact or a hand: Λ⁻¹ = J M⁻¹ Jᵀ, by the zeros of the tree (49.8, 49.9)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_number_arrays, check_size, resolution
from ..errors import ShapeError, SingularError
from ..model import Model, Tree, check_model, check_state, tree_terms
from ..spatial._elementary import at_first_index
from ..spatial.formulas import inverse, symmetric
from .factorization import factorize_mass_matrix, solve_inward
from .singular import ROUNDINGS

__all__ = ["delassus", "delassus_matrix", "operational_space_inertia"]

DEPENDENT = "J: its rows depend on each other{}, and J M⁻¹ Jᵀ has no inverse; expected full rank"


def delassus(L: Array, D: Array, inboard: list[list[int]], J: Array) -> Array:
    """Return J M⁻¹ Jᵀ = Yᵀ D⁻¹ Y with Y = L⁻ᵀ Jᵀ: half a solve.

    A row of J has entries for the joints that carry its frame; its column of Y has no others. So two feet meet
    only in the joints that carry both.
    """
    Y = solve_inward(L, inboard, J.mT)
    return symmetric(Y.mT @ (Y / D[..., None]))  # 49.9 Delassus


def delassus_matrix(model: Model, q: ArrayLike, J: ArrayLike) -> Array:
    """Return Λ⁻¹ = J M⁻¹ Jᵀ: the accelerations J q̈ that unit forces along the rows of J cause.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    J : array_like, shape (..., m, nv)
        Any Jacobian at q: of a frame, of its linear rows, of all contacts.

    Returns
    -------
    ndarray, shape (..., m, m)
        Symmetric; of linear rows 1/kg. Singular where rows of J depend on each other.

    Raises
    ------
    SingularError
        If M is singular, to rounding. Names the joint.
    ShapeError, ValueError
        As `Model.state`.

    Notes
    -----
    Sections 49.8 and 49.9; R. Featherstone, Exploiting sparsity in operational-space dynamics, 2010. The inverse is
    `twistwrench.operational_space_inertia`.

    Examples
    --------
    A push at one foot of a Go2 moves the other feet, since it moves the base:

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> J_c = tw.contact_jacobian(model, model.standing(), model.feet)
    >>> tw.delassus_matrix(model, model.standing(), J_c).shape
    (12, 12)
    """
    tree, J = _checked(model, q, J)
    return _delassus(model, tree, J)


def _checked(model: Model, q: ArrayLike, J: ArrayLike) -> tuple[Tree, Array]:
    """Bring q and J to one number type."""
    check_model(model)
    q, J = as_number_arrays(q=(q, (model.nq,)), J=(J, (model.nv,)))
    if J.ndim < 2:
        raise ShapeError(f"J: expected shape (..., m, {model.nv}), got {J.shape}; one row is J[None]")
    if J.dtype != object:
        check_size(J, "J")
    (q,) = check_state(model, q)
    try:
        np.broadcast_shapes(q.shape[:-1], J.shape[:-2])
    except ValueError:
        raise ShapeError(f"batch axes do not broadcast: q {q.shape[:-1]}, J {J.shape[:-2]}") from None
    return tree_terms(model, q), J


def _delassus(model: Model, tree: Tree, J: Array) -> Array:
    batch = np.broadcast_shapes(tree.batch, J.shape[:-2])
    return delassus(*factorize_mass_matrix(model, tree), np.broadcast_to(J, (*batch, *J.shape[-2:])))


def operational_space_inertia(model: Model, q: ArrayLike, J: ArrayLike) -> Array:
    """Return Λ = (J M⁻¹ Jᵀ)⁻¹, the apparent inertia along the rows of J: F = Λ J q̈ for a robot at rest.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    J : array_like, shape (..., m, nv)
        A Jacobian at q whose rows are independent.

    Returns
    -------
    ndarray, shape (..., m, m)
        Symmetric, positive definite; of linear rows in kg.

    Raises
    ------
    SingularError
        If M is singular, or rows of J depend on each other, as at a stretched knee.
    ShapeError, ValueError
        As `Model.state`.

    Notes
    -----
    Section 49.9; O. Khatib, 1987 (the operational space formulation). All joints are free.

    Examples
    --------
    Pushed up at one foot, a Go2 of 16.1 kg has an apparent mass of 0.15 kg: the leg gives way.

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> J = tw.contact_jacobian(model, model.standing(), ["FL_foot"])
    >>> tw.operational_space_inertia(model, model.standing(), J[2:]).round(3)
    array([[0.153]])
    """
    tree, J = _checked(model, q, J)
    mobility = _delassus(model, tree, J)
    _refuse_dependent(mobility)
    try:
        return symmetric(inverse(mobility))  # 49.9 Lambda
    except ZeroDivisionError:
        raise SingularError(DEPENDENT.format("")) from None


def _refuse_dependent(mobility: Array) -> None:
    """Raise SingularError where rows of J depend on each other, to rounding."""
    if mobility.dtype == object or not mobility.shape[-1]:
        return
    size = np.diagonal(mobility.real, axis1=-2, axis2=-1)
    unit = np.sqrt(np.where(size > 0, size, 1))
    scaled = (mobility.real / unit[..., :, None] / unit[..., None, :]).astype(np.float64)
    lost = np.asarray(np.linalg.eigvalsh(scaled).min(axis=-1) < ROUNDINGS * resolution(mobility.dtype))
    if lost.any():
        raise SingularError(DEPENDENT.format(at_first_index(lost)))
