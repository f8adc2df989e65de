"""M, h, J_c and A_G of a scene: what is wanted, from one placement of the links."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.whole_body import Dynamics
from ..arrays import Array
from ..contact import Contact
from ..fast import dynamics
from ..fast.frames import frames_of
from ..fast.plan import plan_of
from ..model import Model

__all__ = ["angular_rows", "scene_dynamics"]


def scene_dynamics(
    model: Model,
    contacts: Sequence[Contact],
    wrenches: Mapping[str, Array],
    q: ArrayLike,
    v: ArrayLike,
    want: Collection[str],
) -> Dynamics:
    """See `Scene.dynamics`. The linear rows of contacts and of wrenches come from one call of `fast`."""
    touched = [contact.frame for contact in contacts] if "J_c" in want else []
    pushed = list(wrenches) if "h" in want else []
    d = dynamics(model, q, v, contacts=touched + pushed, want={*want, "J_c"} if pushed else set(want))
    if d.J_c is None or not (pushed or any(contact.rows.start < 3 for contact in contacts)):
        return d
    (q,) = model.state(q)
    linear = d.J_c.reshape(*q.shape[:-1], len(touched) + len(pushed), 3, model.nv)
    ours, others = linear[..., : len(touched), :, :], linear[..., len(touched) :, :, :]
    J_c = contact_rows(model, contacts, q, ours) if "J_c" in want else None
    return replace(d, J_c=J_c, h=without(model, wrenches, q, d.h, others) if d.h is not None else None)


def contact_rows(model: Model, contacts: Sequence[Contact], q: Array, linear: Array) -> Array:
    """Return J_c from the linear rows of its contacts, shape (..., k, 3, nv): of each the rows that it holds."""
    turning = [k for k, contact in enumerate(contacts) if contact.rows.start < 3]
    angular = dict(zip(turning, np.moveaxis(angular_rows(model, q, [contacts[k].frame for k in turning]), -3, 0)))
    rows = [np.zeros((*q.shape[:-1], 0, model.nv), q.dtype)]
    for k, contact in enumerate(contacts):
        moves = linear[..., k, :, :]
        six = np.concatenate([angular.get(k, moves), moves], axis=-2)  # where nothing turns, its rows are not taken
        rows.append(six[..., contact.rows, :])
    return np.concatenate(rows, axis=-2)


def without(model: Model, wrenches: Mapping[str, Array], q: Array, h: Array, linear: Array) -> Array:
    """Return h less Σ Jᵀ (τ, f) of the wrenches; linear holds the rows of their frames, (..., k, 3, nv)."""
    moments = {frame: wrench[:3] for frame, wrench in wrenches.items() if wrench[:3].any()}
    angular = angular_rows(model, q, list(moments))
    for k, wrench in enumerate(wrenches.values()):
        h = h - np.matvec(linear[..., k, :, :].mT, wrench[3:].astype(q.dtype))
    for k, moment in enumerate(moments.values()):
        h = h - np.matvec(angular[..., k, :, :].mT, moment.astype(q.dtype))
    return h


def angular_rows(model: Model, q: Array, frames: Sequence[str]) -> Array:
    """Return for each frame the map from v to its angular velocity in the axes of the world.

    The column of a joint that turns is its axis; that of one that slides, or is not on the way to the frame, is zero.

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
    W = np.zeros((*q.shape[:-1], len(frames), 3, model.nv), q.dtype)
    if not frames:
        return W
    plan = plan_of(model, q.real.dtype)
    placed = frames_of(plan, q.reshape(-1, model.nq).mT, in_world=True)
    carriers = {body: link for link, body, _ in plan.bodies}
    for k, name in enumerate(frames):
        body = model.frame(name).body
        way = plan.support(carriers.get(body, 0))
        W[..., k, :, plan.entry[way]] = placed.spin[:, way].transpose(1, 2, 0).reshape(len(way), *q.shape[:-1], 3)
        if placed.base is not None and body > 0:
            W[..., k, :, :3] = placed.base.transpose(2, 0, 1).reshape(*q.shape[:-1], 3, 3)
    return W
