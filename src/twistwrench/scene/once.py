"""M, h, J_c and A_G of a scene: what is wanted, from one placement of the links."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..checks import Array
from ..contact import Contact
from ..fast import dynamics
from ..model import Model
from ..whole_body import Dynamics

__all__ = ["angular_rows", "scene_dynamics"]


def scene_dynamics(
    model: Model,
    contacts: Sequence[Contact],
    wrenches: Mapping[str, Array],
    q: ArrayLike,
    v: ArrayLike,
    want: Collection[str],
) -> Dynamics:
    """Return what `Scene.dynamics` does. The linear rows of contacts and of wrenches come from one call of `fast`."""
    touched = [contact.frame for contact in contacts] if "J_c" in want else []
    pushed = list(wrenches) if "h" in want else []
    d = dynamics(model, q, v, contacts=touched + pushed, want={*want, "J_c"} if pushed else set(want))
    if d.J_c is None:
        return d
    (q,) = model.state(q)
    linear = d.J_c.reshape(*q.shape[:-1], len(touched) + len(pushed), 3, model.nv)
    ours, others = linear[..., : len(touched), :, :], linear[..., len(touched) :, :, :]
    J_c = contact_rows(model, contacts, q, ours) if "J_c" in want else None
    return replace(d, J_c=J_c, h=without(model, wrenches, q, d.h, others) if d.h is not None else None)


def contact_rows(model: Model, contacts: Sequence[Contact], q: Array, linear: Array) -> Array:
    """Return J_c from the linear rows of its contacts, shape (..., k, 3, nv): of each the rows that it holds."""
    six = np.concatenate([np.zeros_like(linear), linear], axis=-2)
    turning = [k for k, contact in enumerate(contacts) if contact.rows.start < 3]
    six[..., turning, :3, :] = angular_rows(model, q, [contacts[k].frame for k in turning])
    rows = [six[..., k, contact.rows, :] for k, contact in enumerate(contacts)]
    return np.concatenate([np.zeros((*q.shape[:-1], 0, model.nv), q.dtype), *rows], axis=-2)


def without(model: Model, wrenches: Mapping[str, Array], q: Array, h: Array, linear: Array) -> Array:
    """Return h less what the wrenches do, Σ Jᵀ (τ, f); linear holds the rows of their frames, (..., k, 3, nv)."""
    moments = {frame: wrench[:3] for frame, wrench in wrenches.items() if wrench[:3].any()}
    angular = angular_rows(model, q, list(moments))
    for k, wrench in enumerate(wrenches.values()):
        h = h - np.matvec(linear[..., k, :, :].mT, wrench[3:].astype(q.dtype))
    for k, moment in enumerate(moments.values()):
        h = h - np.matvec(angular[..., k, :, :].mT, moment.astype(q.dtype))
    return h


def angular_rows(model: Model, q: Array, frames: Sequence[str]) -> Array:
    """Return for each frame the map from v to its angular velocity in the axes of the world.

    Only rotations are needed, and only of the joints on the way to these frames; each of them once.

    Parameters
    ----------
    model : Model
    q : ndarray, shape (..., nq)
        Checked by `Model.state`.
    frames : sequence of str

    Returns
    -------
    ndarray, shape (..., k, 3, nv)
    """
    constants = model.constants(q.dtype)
    supports = [model.support(model.frame(name).body) for name in frames]
    turned = {0: np.eye(3, dtype=q.dtype)}
    W = np.zeros((*q.shape[:-1], len(frames), 3, model.nv), q.dtype)
    for i in sorted({i for support in supports for i in support}):  # the carrier comes before what it carries
        joint = model.joints[i]
        moved = joint.transform(q[..., model.q_slice[i]]).rotation  # type: ignore[union-attr]
        turned[i] = turned[model.parent[i]] @ constants.placement[i].rotation @ moved
        for k, support in enumerate(supports):
            if i in support:
                W[..., k, :, model.v_slice[i]] = turned[i] @ constants.S[i][:3]
    return W
