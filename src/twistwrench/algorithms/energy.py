"""Kinetic and potential energy (49.8; of one body, 49.5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, convert
from ..model import Model, check_state, columns, joint_placements, tree_terms
from ..spatial.plucker import place_point
from ._mimic import also_of_mimics
from .kinematics import motion, placements

__all__ = ["kinetic_energy", "potential_energy"]


@also_of_mimics
def kinetic_energy(model: Model, q: ArrayLike, v: ArrayLike) -> Array:
    """Return T = ½ Σ Vᵢᵀ Iᵢ Vᵢ, rotors included; equal to ½ vᵀ M v.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)
    v : array_like, shape (..., nv)

    Returns
    -------
    ndarray, shape (...)
        J.

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`.

    Examples
    --------
    A ball of 1 kg and 0.001 kg m² at the end of 1 m, at 2 rad/s:

    >>> import twistwrench as tw
    >>> tw.kinetic_energy(tw.load("pendulum"), [0.5], [2.0])
    np.float64(2.002)
    """
    q, v = check_state(model, q, v=v)
    constants = model.constants(q.dtype)
    V, _ = motion(tree_terms(model, q), columns(model, v), columns(model, np.zeros_like(v)))
    twice: Array = (constants.armature * v * v).sum(axis=-1)
    for I, Vi in zip(constants.I, V):
        twice = twice + (Vi * (I @ Vi)).sum(axis=(-2, -1))  # 49.8 T
    return twice / 2


@also_of_mimics
def potential_energy(model: Model, q: ArrayLike) -> Array:
    """Return U = −Σ mᵢ g · cᵢ, zero where the centre of mass is at the world's origin.

    Parameters
    ----------
    model : Model
    q : array_like, shape (..., nq)

    Returns
    -------
    ndarray, shape (...)
        J.

    Raises
    ------
    ShapeError, ValueError
        As `Model.state`.

    Examples
    --------
    >>> import twistwrench as tw
    >>> pendulum = tw.load("pendulum")
    >>> float(tw.potential_energy(pendulum, [np.pi]) - tw.potential_energy(pendulum, [0.0]))  # 2 m · 9.81 N
    19.62
    """
    (q,) = check_state(model, q)
    weight = -model.constants(q.dtype).gravity[3:]
    energy = np.zeros(q.shape[:-1], q.dtype)
    for T, inertia in zip(placements(model.parent, joint_placements(model, q)), model.inertia):
        com = place_point(T.rotation, T.translation, convert(inertia.com, q.dtype))
        energy = energy + convert(inertia.mass, q.dtype) * (com * weight).sum(axis=-1)  # 49.8 U
    return energy
