"""M, h, J_c and A_G of a scene: a program of what is wanted, and of nothing else."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.kinematics import frame_jacobian
from ..algorithms.rnea import nonlinear_effects
from ..algorithms.whole_body import QUANTITIES, Dynamics
from ..arrays import Array, convert
from ..compiler.quantities import Quantity, quantities
from ..contact import Contact
from ..fast.programs import ASKED, remembered, states_of
from ..model import Model

__all__ = ["scene_dynamics"]


def scene_dynamics(
    model: Model,
    contacts: Sequence[Contact],
    wrenches: Mapping[str, Array],
    q: ArrayLike,
    v: ArrayLike,
    want: Collection[str],
) -> Dynamics:
    """See `Scene.dynamics`."""
    args, dtype = states_of(model, {"q": q, "v": v})
    want = tuple(name for name in QUANTITIES if name in want)
    held = tuple((c.frame, c.rows.start, c.rows.stop) for c in contacts) if "J_c" in want else ()
    pushed = tuple((frame, wrench.tobytes()) for frame, wrench in wrenches.items()) if "h" in want else ()

    def asked() -> list[Quantity]:
        known = quantities(model, dtype)
        known["J_c"] = Quantity("J_c", ("q",), lambda q: (contact_rows(model, contacts, q), []))
        known["h"] = Quantity("h", ("q", "v"), lambda q, v: (without(model, wrenches, q, v), []))
        return [*(known[name] for name in want), ASKED]

    found = remembered(model, ("scene", want, dtype, held, pushed), dtype, asked)(*args)
    return Dynamics(**{name: getattr(found, name) for name in want})


def contact_rows(model: Model, contacts: Sequence[Contact], q: Array) -> Array:
    """Return J_c, shape (..., m, nv): of each contact the rows that it holds, in the axes of the world."""
    none = np.zeros((*q.shape[:-1], 0, model.nv), q.dtype)
    six = [frame_jacobian(model, q, contact.frame, "local_world_aligned") for contact in contacts]
    return np.concatenate([none, *(J[..., c.rows, :] for c, J in zip(contacts, six))], axis=-2)


def without(model: Model, wrenches: Mapping[str, Array], q: Array, v: Array) -> Array:
    """Return h less Σ Jᵀ (τ, f) of the wrenches."""
    h = nonlinear_effects(model, q, v)
    for frame, wrench in wrenches.items():
        J = frame_jacobian(model, q, frame, "local_world_aligned")
        h = h - J.mT @ convert(wrench, q.dtype)
    return h
