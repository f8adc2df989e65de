"""Vectors, Jacobians and matrices over v between our order and Pinocchio's: reordering, nothing else.

The six entries of every free-flyer, also inside the tree, are (ω, v) here and (v, ω) there; those of all
other joints are the same. Batch axes and number types are kept, as in `spatial`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array
from ..errors import ShapeError
from ..model import FreeFlyer, Joint, Model, check_model
from .spatial import HALVES

__all__ = [
    "from_pinocchio_contact_jacobian",
    "from_pinocchio_jacobian",
    "from_pinocchio_matrix",
    "from_pinocchio_tangent",
    "to_pinocchio_contact_jacobian",
    "to_pinocchio_jacobian",
    "to_pinocchio_matrix",
    "to_pinocchio_tangent",
]


def tangent_order(joints: Sequence[Joint | None]) -> Array:
    """Return where each of the nv entries comes from: swapped in every free-flyer, also inside the tree."""
    order = np.zeros(0, int)
    for joint in joints:
        if joint is not None:
            order = np.append(order, order.size + (HALVES if isinstance(joint, FreeFlyer) else np.arange(joint.nv)))
    return order


def to_pinocchio_tangent(model: Model, v: ArrayLike) -> Array:
    """Turn v, a, τ, h or g into Pinocchio's: the halves of every free-flyer are swapped, all else stays.

    Parameters
    ----------
    model : Model
    v : array_like, shape (..., nv)
        Free-flyers as (ω, v), or (τ, f).

    Returns
    -------
    ndarray, shape (..., nv)
        Free-flyers as (v, ω), or (f, τ).

    Raises
    ------
    ShapeError
        If the last axis is not nv long.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> to_pinocchio_tangent(model, np.arange(18))[:8]
    array([3., 4., 5., 0., 1., 2., 6., 7.])
    """
    check_model(model)
    return as_array(v, "v", model.nv)[..., tangent_order(model.joints)]


def from_pinocchio_tangent(model: Model, v: ArrayLike) -> Array:
    """Turn Pinocchio's v, a, τ, h or g into ours: the inverse of `to_pinocchio_tangent`.

    Parameters
    ----------
    model : Model
    v : array_like, shape (..., nv)
        Free-flyers as (v, ω), or (f, τ).

    Returns
    -------
    ndarray, shape (..., nv)
        Free-flyers as (ω, v), or (τ, f).

    Raises
    ------
    ShapeError
        If the last axis is not nv long.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> from_pinocchio_tangent(model, [1, 2, 3, 4, 5, 6, *range(7, 19)])[:8]
    array([4., 5., 6., 1., 2., 3., 7., 8.])
    """
    check_model(model)
    return as_array(v, "v", model.nv)[..., tangent_order(model.joints)]


def to_pinocchio_jacobian(model: Model, J: ArrayLike) -> Array:
    """Turn a frame Jacobian, or the centroidal map A_G, into Pinocchio's: rows and columns.

    Parameters
    ----------
    model : Model
    J : array_like, shape (..., 6, nv)
        Rows (angular, linear).

    Returns
    -------
    ndarray, shape (..., 6, nv)
        Rows (linear, angular), columns as `to_pinocchio_tangent`.

    Raises
    ------
    ShapeError
        If the last axes are not (6, nv).

    Examples
    --------
    >>> import twistwrench as tw
    >>> arm = tw.load("planar_arm")
    >>> J = tw.frame_jacobian(arm, arm.neutral(), "tool")
    >>> bool((to_pinocchio_jacobian(arm, J)[:3] == J[3:]).all())  # the linear rows come first
    True
    """
    check_model(model)
    return as_array(J, "J", 6, model.nv)[..., HALVES, :][..., tangent_order(model.joints)]


def from_pinocchio_jacobian(model: Model, J: ArrayLike) -> Array:
    """Turn Pinocchio's frame Jacobian, or ``data.Ag``, into ours: the inverse of `to_pinocchio_jacobian`.

    Parameters
    ----------
    model : Model
    J : array_like, shape (..., 6, nv)
        Rows (linear, angular). Of a robot with one degree of freedom also (..., 6), as Pinocchio's Python has it.

    Returns
    -------
    ndarray, shape (..., 6, nv)
        Rows (angular, linear), columns as `from_pinocchio_tangent`.

    Raises
    ------
    ShapeError
        If the last axes are not (6, nv).

    Examples
    --------
    >>> import twistwrench as tw
    >>> arm = tw.load("planar_arm")
    >>> from_pinocchio_jacobian(arm, np.arange(18).reshape(6, 3))[:, 0]
    array([ 9., 12., 15.,  0.,  3.,  6.])
    """
    check_model(model)
    J = as_array(_with_column(J, "J", model.nv), "J", 6, model.nv)
    return J[..., HALVES, :][..., tangent_order(model.joints)]


def to_pinocchio_contact_jacobian(model: Model, J_c: ArrayLike) -> Array:
    """Turn a matrix whose columns alone belong to v into Pinocchio's: J_c of point contacts, S.

    Its rows are not spatial vectors (three linear rows to a contact, one to an actuated joint) and stay.

    Parameters
    ----------
    model : Model
    J_c : array_like, shape (..., k, nv)

    Returns
    -------
    ndarray, shape (..., k, nv)
        Columns as `to_pinocchio_tangent`.

    Raises
    ------
    ShapeError
        If the last axis is not nv long, or there is only one axis.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> J_c = tw.contact_jacobian(model, model.standing(), model.feet)
    >>> to_pinocchio_contact_jacobian(model, J_c)[0, :3].round(12) + 0.0  # how the base's v moves a foot along x
    array([1., 0., 0.])
    """
    check_model(model)
    return _with_rows(J_c, model.nv)[..., tangent_order(model.joints)]


def from_pinocchio_contact_jacobian(model: Model, J_c: ArrayLike) -> Array:
    """Turn Pinocchio's J_c into ours: the inverse of `to_pinocchio_contact_jacobian`.

    Parameters
    ----------
    model : Model
    J_c : array_like, shape (..., k, nv)
        Of a robot with one degree of freedom also (..., k), as Pinocchio's Python has it.

    Returns
    -------
    ndarray, shape (..., k, nv)
        Columns as `from_pinocchio_tangent`.

    Raises
    ------
    ShapeError
        If the last axis is not nv long, or there is only one axis.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> from_pinocchio_contact_jacobian(model, np.arange(18)[None])[0, :8]
    array([3., 4., 5., 0., 1., 2., 6., 7.])
    """
    check_model(model)
    return _with_rows(_with_column(J_c, "J_c", model.nv), model.nv)[..., tangent_order(model.joints)]


def _with_column(J: ArrayLike, name: str, nv: int) -> Array:
    """Return a matrix over v with the axis of length 1 that Pinocchio's Python drops where nv is 1."""
    x = as_array(J, name)
    return x[..., None] if nv == 1 and x.ndim and (x.ndim == 1 or x.shape[-1] != 1) else x


def _with_rows(J_c: ArrayLike, nv: int) -> Array:
    """Check a matrix (..., k, nv) of any number of rows."""
    J_c = as_array(J_c, "J_c", nv)
    if J_c.ndim < 2:
        raise ShapeError(f"J_c: expected shape (..., k, {nv}), got {J_c.shape}")
    return J_c


def to_pinocchio_matrix(model: Model, M: ArrayLike) -> Array:
    """Turn M, C or M⁻¹ into Pinocchio's: rows and columns as in `to_pinocchio_tangent`.

    Parameters
    ----------
    model : Model
    M : array_like, shape (..., nv, nv)

    Returns
    -------
    ndarray, shape (..., nv, nv)

    Raises
    ------
    ShapeError
        If the last axes are not (nv, nv).

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> M = tw.crba(model, model.standing())
    >>> to_pinocchio_matrix(model, M)[0, 0].round(3)  # the mass, where ours has the inertia about x
    np.float64(16.085)
    """
    check_model(model)
    order = tangent_order(model.joints)
    return as_array(M, "M", model.nv, model.nv)[..., order, :][..., order]


def from_pinocchio_matrix(model: Model, M: ArrayLike) -> Array:
    """Turn Pinocchio's M, C or M⁻¹ into ours: the inverse of `to_pinocchio_matrix`.

    Parameters
    ----------
    model : Model
    M : array_like, shape (..., nv, nv)

    Returns
    -------
    ndarray, shape (..., nv, nv)

    Raises
    ------
    ShapeError
        If the last axes are not (nv, nv).

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> from_pinocchio_matrix(model, np.diag(np.arange(18))).diagonal()[:8]
    array([3., 4., 5., 0., 1., 2., 6., 7.])
    """
    check_model(model)
    order = tangent_order(model.joints)
    return as_array(M, "M", model.nv, model.nv)[..., order, :][..., order]
