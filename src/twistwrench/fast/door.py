"""The check at the door, in a form that one state can afford.

Whatever is plainly right passes here: finite arrays of one float type, of the right shapes and of one batch shape,
with quaternions and (cos, sin) of norm 1. All else, right or wrong, goes through the door of the textbook
(`Model.state`), which converts it or says what is wrong with it.
"""

from __future__ import annotations

import math
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import ArrayLike

from ..checks import Array, resolution
from ..inverse_dynamics import external
from ..model import Model
from .plan import Plan, plan_of

__all__ = ["admit"]

PLAIN = {np.dtype(t): 0.9 * math.sqrt(resolution(t)) for t in (np.float32, np.float64)}
"""The types that pass here, and how far a norm may be off 1: a little less than the textbook lets it."""


def admit(
    model: Model, q: ArrayLike, *rates: tuple[str, ArrayLike], f_ext: ArrayLike | None = None
) -> tuple[Plan, tuple[Array, ...]]:
    """Return the plan for the number type that came; and q, the (name, value) of `rates`, and f_ext where it came.

    The arrays are what `Model.state` returns: checked, of one type, broadcast to one batch shape.
    """
    if f_ext is None and isinstance(q, np.ndarray) and q.dtype in PLAIN:
        plan, batch = plan_of(model, q.dtype), q.shape[:-1]
        plain = [x for _, x in rates if _is_plain(x, q.dtype, (*batch, plan.nv))]
        if len(plain) == len(rates) and _is_plain(q, q.dtype, (*batch, plan.nq)) and _has_norm_1(plan, q):
            return plan, (q, *plain)
    others = dict(rates) if f_ext is None else {**dict(rates), "f_ext": external(model, f_ext)}
    arrays = model.state(q, **others)
    return plan_of(model, arrays[0].real.dtype), arrays


def _is_plain(x: ArrayLike, dtype: np.dtype[Any], shape: tuple[int, ...]) -> TypeGuard[Array]:
    """Whether x is an array of this type and shape, and finite."""
    if not isinstance(x, np.ndarray) or x.dtype != dtype or x.shape != shape:
        return False
    if x.ndim == 1:
        return math.isfinite(sum(x.tolist()))  # for so few numbers Python's own are quicker
    return bool(np.isfinite(x).all())


def _has_norm_1(plan: Plan, q: Array) -> bool:
    """Whether quaternions and (cos, sin) are a little nearer to norm 1 than they must be."""
    allowed = PLAIN[q.dtype]
    for unit in plan.units:
        part = q[..., unit]
        if q.ndim == 1:
            off = abs(math.hypot(*part.tolist()) - 1)
        else:
            off = np.abs(np.sqrt(np.einsum("...i,...i->...", part, part)) - 1).max(initial=0)
        if off > allowed:
            return False
    return True
