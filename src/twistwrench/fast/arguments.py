"""Input validation, cheap enough for one state.

Valid arguments of the common kind pass here: arrays of one float type, of the right shapes and of one batch shape,
finite and not huge, with quaternions and (cos, sin) of norm 1. All others, valid or not, go through the textbook's
validation (`Model.state`), which converts them or raises.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple, TypeGuard

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, resolution
from ..model import Model, floats_of
from .plan import Plan, plan_of

__all__ = ["validate"]


class Limits(NamedTuple):
    """How large the entries of q and those of v, a, tau may be, and how far off 1 a norm."""

    q: float
    rate: float
    norm: float


def _limits(dtype: type[np.floating[Any]]) -> Limits:
    largest = float(np.finfo(dtype).max)
    return Limits(0.9 * largest**0.25, 0.9 * largest**0.2, 0.9 * math.sqrt(resolution(dtype)))


PLAIN = {np.dtype(t): _limits(t) for t in (np.float32, np.float64)}
"""The number types that pass here, with limits a little narrower than the textbook's (`state`)."""


def validate(
    model: Model, q: ArrayLike, *rates: tuple[str, ArrayLike], f_ext: ArrayLike | None = None
) -> tuple[Plan, tuple[Array, ...]]:
    """Return the plan for the number type of the arguments; and q, the values of `rates`, and f_ext where it is given.

    The arrays are what `Model.state` returns: checked, of one type, broadcast to one batch shape.
    """
    if isinstance(model, Model) and f_ext is None and type(q) is np.ndarray and q.dtype in PLAIN:
        plan, batch, limits = plan_of(model, q.dtype), q.shape[:-1], PLAIN[q.dtype]
        plain = [x for _, x in rates if _is_plain(x, q, (*batch, plan.nv), limits.rate)]
        if len(plain) == len(rates) and _is_plain(q, q, (*batch, plan.nq), limits.q) and _has_norm_1(plan, q):
            return plan, (q, *plain)
    others = dict(rates) if f_ext is None else {**dict(rates), "f_ext": f_ext}
    arrays = floats_of(model, q, **others)
    return plan_of(model, arrays[0].real.dtype), arrays


def _is_plain(x: ArrayLike, q: Array, shape: tuple[int, ...], limit: float) -> TypeGuard[Array]:
    """Whether x is an array of q's type and of this shape, with no entry above the limit; a NaN counts as above."""
    if type(x) is not np.ndarray or x.dtype != q.dtype or x.shape != shape:  # a masked array is of another type
        return False
    if x.ndim == 1:
        return math.hypot(*x.tolist()) <= limit  # for so few Python's own is quicker, and no entry is larger
    return bool(-limit <= x.min(initial=0) and x.max(initial=0) <= limit)


def _has_norm_1(plan: Plan, q: Array) -> bool:
    """Whether quaternions and (cos, sin) are a little nearer to norm 1 than they must be."""
    allowed = PLAIN[q.dtype].norm
    for unit in plan.units:
        part = q[..., unit]
        if q.ndim == 1:
            off = abs(math.hypot(*part.tolist()) - 1)
        else:
            off = np.abs(np.sqrt(np.einsum("...i,...i->...", part, part)) - 1).max(initial=0)
        if off > allowed:
            return False
    return True
