"""The computation for each chunk of states. The states are the last axis of every array here."""

from __future__ import annotations

import numpy as np

from ..algorithms.aba import aba
from ..arrays import Array
from ..model import Model
from .articulated import NearlySingular, accelerations
from .contacts import Contacts, contact_jacobian
from .forces import forces
from .frames import frames_of, inertias_of, origins_of
from .masses import centroidal_matrix, composite, mass_matrix, momenta
from .plan import Plan

__all__ = ["forward_dynamics", "inverse_dynamics", "quantities"]


def inverse_dynamics(plan: Plan, q: Array, v: Array, a: Array, *rest: Array) -> None:
    """Fill τ, the last of `rest`; before it f_ext, shape (nbodies, 6, b), where it is given."""
    *f_ext, tau = rest
    frames = frames_of(plan, q)
    tau[...] = forces(plan, frames, inertias_of(plan, frames), v, a, *f_ext)


def forward_dynamics(model: Model, plan: Plan, q: Array, v: Array, tau: Array, *rest: Array) -> None:
    """Fill q̈, the last of `rest`; before it f_ext, shape (nbodies, 6, b), where it is given."""
    *f_ext, qdd = rest
    frames = frames_of(plan, q)
    try:
        qdd[...] = accelerations(plan, frames, inertias_of(plan, frames), v, tau, *f_ext)
    except NearlySingular:
        qdd[...] = np.moveaxis(aba(model, *(np.moveaxis(x, -1, 0) for x in (q, v, tau, *f_ext))), 0, -1)


def quantities(plan: Plan, contacts: Contacts | None, names: tuple[str, ...], q: Array, *rest: Array) -> None:
    """Fill the quantities of these names, the last arrays of `rest`; before them v, where it is given."""
    results = dict(zip(names, rest[-len(names) :]))
    frames = frames_of(plan, q, in_world="M" not in results and "h" not in results)
    if contacts is not None:
        contact_jacobian(plan, frames, origins_of(plan, frames), contacts, results["J_c"])
    if names == ("J_c",):
        return
    inertias = inertias_of(plan, frames)
    if "h" in results:
        results["h"][...] = forces(plan, frames, inertias, rest[0])
    if "M" in results or "A_G" in results:
        origin, carried = origins_of(plan, frames), composite(plan, frames, inertias)
        unit = momenta(plan, frames, carried)
        if "M" in results:
            mass_matrix(plan, frames, origin, carried, unit, results["M"])
        if "A_G" in results:
            centroidal_matrix(plan, frames, origin, carried, unit, results["A_G"])
