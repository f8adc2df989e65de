"""One state, a few or many: which implementation each takes.

Up to a few states are done one by one, always in double precision (`single`); more of them all at once (`batch`).
So are wrenches from outside, long double and complex numbers, however few the states are.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..algorithms.aba import aba
from ..algorithms.centroidal import centroidal_map
from ..arrays import Array
from ..errors import SingularError
from ..model import Model
from .arguments import PLAIN, validate
from .articulated import NearlySingular
from .batch import fill
from .contacts import contacts_of
from .kernels import forward_dynamics, inverse_dynamics, quantities
from .outputs import Tail, check_outputs, finish, targets
from .plan import plan_of
from .single import Parts, single_dynamics, single_rnea
from .single_aba import AbaPlan, make_aba_plan, single_aba
from .single_plan import ContactRows, SinglePlan, contact_rows, make_single_plan

__all__ = ["accelerations", "parts", "torques"]

FEW, FEW_ABA = 8, 4
"""Up to so many states are done one by one; with more, all at once is faster (measured with Go2 and a humanoid)."""

REMEMBERED = 32
"""Number of sets of contacts that a plan caches."""

DOUBLE = np.dtype(np.float64)


Given = Mapping[str, Array]
"""Arrays of the caller for some of the results, by name."""


def torques(model: Model, q: ArrayLike, v: ArrayLike, a: ArrayLike, f_ext: ArrayLike | None, given: Given) -> Array:
    """Return τ."""
    plan, states = validate(model, q, ("v", v), ("a", a), f_ext=f_ext)
    tails = {"tau": (plan.nv,)}
    if f_ext is None and _are_few(states[0], FEW):
        return _one_by_one(partial(_single_torques, _single_plan(model)), states, tails, given)["tau"]
    return fill(partial(inverse_dynamics, plan), states, tails, plan, given)["tau"]


def accelerations(
    model: Model, q: ArrayLike, v: ArrayLike, tau: ArrayLike, f_ext: ArrayLike | None, given: Given
) -> Array:
    """Return q̈."""
    plan, states = validate(model, q, ("v", v), ("tau", tau), f_ext=f_ext)
    tails = {"qdd": (plan.nv,)}
    try:
        if f_ext is None and _are_few(states[0], FEW_ABA):
            return _one_by_one(partial(_single_accelerations, model, _aba_plan(model)), states, tails, given)["qdd"]
        return fill(partial(forward_dynamics, model, plan), states, tails, plan, given)["qdd"]
    except SingularError:
        return aba(model, *states)  # raises, with the place in the batch


def parts(
    model: Model,
    q: ArrayLike,
    rates: tuple[tuple[str, ArrayLike], ...],
    want: tuple[str, ...],
    contacts: tuple[str, ...] | None,
    given: Given,
) -> Parts:
    """Return what is wanted of M, h, J_c and A_G, by name; of `rates` only v is used, and only for h."""
    plan, states = validate(model, q, *rates)
    if model.mass == 0 and "A_G" in want:
        centroidal_map(model, q)  # raises
    contacts = model.feet if contacts is None else contacts
    few = _are_few(states[0], FEW)
    if few:
        single = _single_plan(model)
        rows = _contact_rows(model, single, contacts) if "J_c" in want else None
        if states[0].ndim == 1 and _is_plain(states, given):
            return single_dynamics(single, want, rows, *states)
    nv = plan.nv
    tails: dict[str, Tail] = {"M": (nv, nv), "h": (nv,), "J_c": (3 * len(contacts), nv), "A_G": (6, nv)}
    tails = {name: tail for name, tail in tails.items() if name in want}
    if few:
        return _one_by_one(partial(single_dynamics, single, want, rows), states, tails, given)
    points = contacts_of(model, plan, contacts) if "J_c" in want else None
    return fill(partial(quantities, plan, points, tuple(tails)), states, tails, plan, given)


def _are_few(q: Array, few: int) -> bool:
    return (q.ndim == 1 or q.size <= few * q.shape[-1]) and q.dtype in PLAIN


def _is_plain(states: Sequence[Array], given: Given) -> bool:
    """Whether the result for one state can be returned without conversion."""
    return states[0].dtype == DOUBLE and not given


def _one_by_one(one: Callable[..., Parts], states: Sequence[Array], tails: Mapping[str, Tail], given: Given) -> Parts:
    """Return the results for a few states: of each, ``one(*state)`` in double precision."""
    batch, dtype = states[0].shape[:-1], states[0].dtype
    if not batch and _is_plain(states, given):
        return one(*states)
    given = {name: x for name, x in given.items() if name in tails}
    check_outputs(given, batch, tails, dtype)
    filled = targets(given, states, tails, dtype)
    states = [x.astype(DOUBLE) for x in states]
    for state in np.ndindex(batch):
        for name, x in one(*(x[state] for x in states)).items():
            filled[name][state] = x
    return finish(given, filled)


def _single_torques(plan: SinglePlan, q: Array, v: Array, a: Array) -> Parts:
    return {"tau": single_rnea(plan, q, v, a)}


def _single_accelerations(model: Model, plan: AbaPlan, q: Array, v: Array, tau: Array) -> Parts:
    try:
        return {"qdd": single_aba(plan, q, v, tau)}
    except NearlySingular:
        return {"qdd": aba(model, model.normalize(q), v, tau)}  # of norm 1 in the caller's number type


def _single_plan(model: Model) -> SinglePlan:
    made: dict[Any, Any] = model._constants
    plan: SinglePlan | None = made.get("fast, single")
    if plan is None:
        plan = made["fast, single"] = make_single_plan(plan_of(model, DOUBLE))
    return plan


def _aba_plan(model: Model) -> AbaPlan:
    made: dict[Any, Any] = model._constants
    plan: AbaPlan | None = made.get("fast, aba")
    if plan is None:
        plan = made["fast, aba"] = make_aba_plan(plan_of(model, DOUBLE), _single_plan(model))
    return plan


def _contact_rows(model: Model, plan: SinglePlan, contacts: tuple[str, ...]) -> ContactRows:
    """Return the rows of contacts, from the cache where they are in it."""
    known = plan.known.get(contacts) if all(isinstance(name, str) for name in contacts) else None
    if known is None:
        known = contact_rows(plan, contacts_of(model, plan_of(model, DOUBLE), contacts))
        if len(plan.known) >= REMEMBERED:
            plan.known.clear()
        plan.known[contacts] = known
    return known
