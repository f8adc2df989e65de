"""M, h, J_c and A_G of a scene: a program of what is wanted, and of nothing else."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.floating_base import contact_jacobian
from ..algorithms.kinematics import Reference, frame_jacobian
from ..algorithms.rnea import gravity, nonlinear_effects, rnea
from ..algorithms.whole_body import QUANTITIES, Dynamics
from ..arrays import Array, convert
from ..contact import Contact
from ..contact.forward import contact_quantities
from ..fast.programs import ASKED, cached_program, states_of
from ..fast.quantities import Quantity, quantities
from ..fast.watch import with_watch
from ..model import Model

__all__ = ["scene_dynamics", "scene_quantities"]


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
    held = tuple(contacts) if "J_c" in want else ()
    pushed = tuple((frame, wrench.tobytes()) for frame, wrench in wrenches.items()) if "h" in want else ()

    def asked() -> list[Quantity]:
        known = scene_quantities(model, contacts, wrenches, dtype)
        return [*(known[name] for name in want), ASKED]

    found = cached_program(model, ("scene", want, dtype, held, pushed), dtype, asked)(*args)
    return Dynamics(**{name: getattr(found, name) for name in want})


def scene_quantities(
    model: Model,
    contacts: Sequence[Contact],
    wrenches: Mapping[str, Array],
    dtype: np.dtype[Any],
    frames: Sequence[str] = (),
    reference: Reference = "local",
) -> dict[str, Quantity]:
    """Return what can be computed of a scene, by symbol: of its model, with the rows of its contacts and its wrenches.

    q̈ is that under its contacts; λ, v⁺ and the impulse are there where it has some.
    """
    free = quantities(model, dtype)
    held = contact_quantities(model, contacts, dtype, partial(push, model, wrenches) if wrenches else None)
    pushed = [
        Quantity("h", ("q", "v"), lambda q, v: (nonlinear_effects(model, q, v) - push(model, wrenches, q), [])),
        Quantity("g", ("q",), lambda q: (gravity(model, q) - push(model, wrenches, q), [])),
        Quantity("tau", free["tau"].arguments, lambda q, *rest: (rnea(model, q, *rest) - push(model, wrenches, q), [])),
    ]
    rows = Quantity("J_c", ("q",), lambda q: with_watch(contact_jacobian(model, q, contacts), contacts))
    instead = [rows, *(pushed if wrenches else []), *(held if contacts else held[:1] if wrenches else [])]
    return quantities(model, dtype, (), frames, reference, instead=instead)


def push(model: Model, wrenches: Mapping[str, Array], q: Array) -> Array:
    """Return Σ Jᵀ (τ, f) of the wrenches, shape (..., nv)."""
    total = np.zeros((*q.shape[:-1], model.nv), q.dtype)
    for frame, wrench in wrenches.items():
        J = frame_jacobian(model, q, frame, "local_world_aligned")
        total = total + J.mT @ convert(wrench, q.dtype)
    return total
