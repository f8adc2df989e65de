"""Motion of a robot some of whose joints follow others: the full robot moves, with a coupling for each of them.

The couplings are the laws themselves, and the forces at them are those of the gears. Policy, condition and result are
in the q, v and τ of the `MimicModel`; τ acts on the leaders, as τ = Gᵀ τ_full asks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.mimic import MimicModel
from ..arrays import Array, as_array
from ..contact import Contact, Coupling
from ..contact.rows import as_contacts
from ..errors import ShapeError
from .result import Simulation

__all__ = ["couplings", "simulate_following"]


def couplings(model: MimicModel) -> list[Coupling]:
    """Return what holds the joints that follow, for the full model."""
    return [Coupling(name, ((leader, multiplier),)) for name, (leader, multiplier, _) in model.laws.items()]


def simulate_following(
    simulate: Callable[..., Simulation],
    model: MimicModel,
    q: ArrayLike,
    v: ArrayLike,
    *,
    tau: Any,
    contacts: Iterable[Contact],
    stop: Any,
    **options: Any,
) -> Simulation:
    """Return what `simulate` does, which is called with the full model."""
    policy = tau
    condition = stop
    own = leading(model)

    def acts(t: float, q: Array, v: Array) -> Array:
        found = policy(t, q[..., model.kept_q], v[..., own])
        return at_leaders(model, found, "tau(t, q, v)", f" at t = {t:.6g}")

    def ends(t: float, q: Array, v: Array) -> Any:
        return condition(t, q[..., model.kept_q], v[..., own])

    if callable(tau):
        tau = acts
    elif tau is not None:
        tau = at_leaders(model, tau, "tau")
    stop = ends if callable(stop) else stop
    held = [*as_contacts(model.full, contacts), *couplings(model)]
    try:
        motion = simulate(model.full, *model.expand(q, v), tau=tau, contacts=held, stop=stop, **options)
    except (Exception, KeyboardInterrupt) as error:
        if isinstance(made := getattr(error, "motion", None), Simulation):
            error.motion = leader_motion(model, made)  # type: ignore[union-attr]
        raise
    return leader_motion(model, motion)


def leading(model: MimicModel) -> Array:
    """Return where the entries of v stand in that of the full model."""
    full = model.full
    slices = [full.v_slice[full.joint_id(name)] for name in model.joint_names[1:]]
    return np.concatenate([np.zeros(0, np.intp), *(np.arange(full.nv)[s] for s in slices)])


def at_leaders(model: MimicModel, tau: ArrayLike, name: str, when: str = "") -> Array:
    """Return the full joint forces that do the same work."""
    tau = as_array(tau, name)
    if tau.shape[-1:] != (model.nv,):
        raise ShapeError(f"{name}: expected shape (..., {model.nv}), of the joints that lead, got {tau.shape}{when}")
    full = np.zeros((*tau.shape[:-1], model.full.nv), tau.dtype)
    full[..., leading(model)] = tau
    return full


def leader_motion(model: MimicModel, motion: Simulation) -> Simulation:
    """Return the motion of the leaders."""
    own = leading(model)
    q = motion.q[..., model.kept_q]
    v = motion.v[..., own]
    tau = motion.tau[..., own]
    return replace(motion, q=q, v=v, tau=tau, follows=model)
