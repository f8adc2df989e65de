"""States to MuJoCo and back: quaternions with the scalar first, free joints with (v in the world, ω in the body).

All other entries are the same, in the order of the joints, which `from_mujoco_model` keeps.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array
from ..errors import ModelError
from ..model import FreeFlyer, Model, Prismatic, Revolute, Spherical, check_model
from .spatial import HALVES

__all__ = [
    "SCALAR_LAST",
    "from_mujoco_acceleration",
    "from_mujoco_configuration",
    "from_mujoco_tangent",
    "to_mujoco_acceleration",
    "to_mujoco_configuration",
    "to_mujoco_tangent",
]

SCALAR_LAST = [1, 2, 3, 0]
"""Where each entry of a quaternion stands in MuJoCo's."""


def from_mujoco_configuration(model: Model, qpos: ArrayLike) -> Array:
    """Turn MuJoCo's ``qpos`` into our q: the quaternions of free and ball joints have their scalar last here.

    Parameters
    ----------
    model : Model
        From `from_mujoco_model`.
    qpos : array_like, shape (..., nq)

    Returns
    -------
    ndarray, shape (..., nq)

    Raises
    ------
    ShapeError
        If the last axis is not nq long.
    ModelError
        If MuJoCo has no such joint.

    Examples
    --------
    >>> import twistwrench as tw
    >>> from_mujoco_configuration(tw.load("go2"), [1, 2, 3, 1, 0, 0, 0, *range(12)])[:7]
    array([1., 2., 3., 0., 0., 0., 1.])
    """
    return as_array(qpos, "qpos", _nq(model))[..., _order(model)]


def to_mujoco_configuration(model: Model, q: ArrayLike) -> Array:
    """Turn our q into MuJoCo's ``qpos``: the inverse of `from_mujoco_configuration`, with the same errors.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    ndarray, shape (..., nq)

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> to_mujoco_configuration(model, model.neutral())[3:7]
    array([1., 0., 0., 0.])
    """
    return as_array(q, "q", _nq(model))[..., np.argsort(_order(model))]


def _nq(model: Model) -> int:
    """Return nq of what must be a model."""
    check_model(model)
    return model.nq


def _order(model: Model) -> Array:
    """Return where each entry of q stands in qpos."""
    order = np.arange(model.nq)
    for name, joint, s in zip(model.joint_names, model.joints, model.q_slice):
        if isinstance(joint, FreeFlyer | Spherical):
            order[s.stop - 4 : s.stop] = s.stop - 4 + np.array(SCALAR_LAST)
        elif joint is not None and not isinstance(joint, Revolute | Prismatic):
            raise ModelError(f"joint {name!r}: MuJoCo has no {joint.kind} joint, but free, ball, hinge and slide")
    return order


def from_mujoco_tangent(model: Model, q: ArrayLike, v: ArrayLike) -> Array:
    """Turn MuJoCo's ``qvel``, or a force over v such as ``qfrc_applied``, into ours: (ω, Rᵀv) of each free joint.

    Both change alike, since the map is orthogonal. An acceleration is not one of them: see
    `from_mujoco_acceleration`. Nor is ``qfrc_bias`` then `nonlinear_effects`, where the base turns and moves: it is
    the force at ``qacc = 0``, `rnea` with ``from_mujoco_acceleration(model, q, v, np.zeros(model.nv))``.

    Parameters
    ----------
    model : Model
        From `from_mujoco_model`.
    q : array_like, shape (..., nq)
        Ours, with the scalar last.
    v : array_like, shape (..., nv)
        MuJoCo's: (v in the world, ω in the body) of a free joint.

    Returns
    -------
    ndarray, shape (..., nv)

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`.
    ModelError
        If MuJoCo has no such joint.

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> from_mujoco_tangent(model, model.neutral(), range(18))[:8]
    array([3., 4., 5., 0., 1., 2., 6., 7.])
    """
    return _tangent(model, q, v, to=False)


def to_mujoco_tangent(model: Model, q: ArrayLike, v: ArrayLike) -> Array:
    """Turn our v or τ into MuJoCo's: the inverse of `from_mujoco_tangent`, with the same errors.

    Of an acceleration `to_mujoco_acceleration` is the one that is right; of h see `from_mujoco_tangent`.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
        Ours, with the scalar last.
    v : array_like, shape (..., nv)

    Returns
    -------
    ndarray, shape (..., nv)

    Examples
    --------
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> to_mujoco_tangent(model, model.neutral(), [1, 2, 3, 4, 5, 6, *range(12)])[:6]
    array([4., 5., 6., 1., 2., 3.])
    """
    return _tangent(model, q, v, to=True)


def from_mujoco_acceleration(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Array:
    """Turn MuJoCo's ``qacc`` into our acceleration: (ω̇, Rᵀv̇ − ω × v) of each free joint.

    MuJoCo's linear part is the acceleration of a point, in the world; ours is the rate of the body twist.

    Parameters
    ----------
    model : Model
        From `from_mujoco_model`.
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)
        Both ours: `from_mujoco_configuration`, `from_mujoco_tangent`.
    a : array_like, shape (..., nv)
        MuJoCo's ``qacc``.

    Returns
    -------
    ndarray, shape (..., nv)
        For `rnea`; what `aba` returns.

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`.
    ModelError
        If MuJoCo has no such joint.

    Examples
    --------
    A robot that flies along x and turns about z does not accelerate, but its twist changes:

    >>> import twistwrench as tw
    >>> model, v = tw.load("go2"), [0, 0, 1, 2, *np.zeros(14)]
    >>> from_mujoco_acceleration(model, model.neutral(), v, np.zeros(18))[3:6] + 0.0
    array([ 0., -2.,  0.])
    """
    check_model(model)
    q, v, a = model.state(q, v=v, a=a)
    return _with_turning(model, v, from_mujoco_tangent(model, q, a), -1)


def to_mujoco_acceleration(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Array:
    """Turn our acceleration into MuJoCo's ``qacc``: the inverse of `from_mujoco_acceleration`, with the same errors.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v, a : array_like, shape (..., nv)
        All three ours.

    Returns
    -------
    ndarray, shape (..., nv)

    Examples
    --------
    >>> import twistwrench as tw
    >>> model, v = tw.load("go2"), [0, 0, 1, 2, *np.zeros(14)]
    >>> to_mujoco_acceleration(model, model.neutral(), v, np.zeros(18))[:3]
    array([0., 2., 0.])
    """
    check_model(model)
    q, v, a = model.state(q, v=v, a=a)
    return to_mujoco_tangent(model, q, _with_turning(model, v, a, 1))


def _with_turning(model: Model, v: Array, a: Array, sign: int) -> Array:
    """Add ω × v of each free joint, or take it away: a point's acceleration is the rate of the twist plus ω × v."""
    out = a.copy()
    for joint, s in zip(model.joints, model.v_slice):
        if isinstance(joint, FreeFlyer):
            V = v[..., s]
            out[..., s.start + 3 : s.stop] += sign * np.cross(V[..., :3], V[..., 3:])
    return out


def _tangent(model: Model, q: ArrayLike, v: ArrayLike, *, to: bool) -> Array:
    check_model(model)
    _order(model)  # raises for a joint that MuJoCo does not have
    q, v = model.state(q, v=v)
    out = v.copy()
    for joint, qs, vs in zip(model.joints, model.q_slice, model.v_slice):
        if isinstance(joint, FreeFlyer):
            R, halves = joint.transform(q[..., qs]).rotation, v[..., vs][..., HALVES]
            linear = np.matvec(R, halves[..., :3]) if to else np.matvec(R.mT, halves[..., 3:])
            out[..., vs] = np.concatenate([linear, halves[..., 3:]] if to else [halves[..., :3], linear], axis=-1)
    return out
