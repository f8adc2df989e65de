"""The arguments of a call, checked, in the one kind of number that holds them all (49.1)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_number_arrays, check_size
from ..errors import ShapeError, no_model
from .arithmetic import Arithmetic
from .exact import Exact

__all__ = ["State", "take"]


@dataclass(frozen=True)
class State:
    """The checked arguments of a call, in one kind of number; zeros where an argument is not given."""

    model: Any
    number: Arithmetic
    q: Array
    v: Array
    a: Array
    tau: Array
    f_ext: Array


def take(model: Any, **given: ArrayLike | None) -> State:
    """Check the arguments of a call, and make them arrays of one kind of number.

    Parameters
    ----------
    model : Model
    **given : array_like or None
        `q`, and as needed `v`, `a`, `tau`, `f_ext`; None stands for zeros in `f_ext` only.

    Returns
    -------
    State
        mpmath's numbers take precedence over NumPy's, and so do fractions and SymPy's.

    Raises
    ------
    TypeError
        If `model` is not a Model.
    ShapeError
        If an argument is not that of one state of this model.
    ValueError
        If an argument is not numeric, not finite, so large that products overflow, or a wrench on the world.
    """
    if not hasattr(model, "joint_names") or hasattr(model, "laws"):  # joints that follow others are not supported here
        raise no_model(model)
    shapes = {"q": (model.nq,), "v": (model.nv,), "a": (model.nv,), "tau": (model.nv,), "f_ext": (model.nbodies, 6)}
    values = {name: _as_array(value, name) for name, value in given.items() if value is not None or name != "f_ext"}
    for name, x in values.items():
        if x.shape != shapes[name]:
            raise ShapeError(f"{name}: expected shape {shapes[name]}, got {x.shape}{_hint(model, name, x)}")
    if "f_ext" in values and (values["f_ext"][0] != 0).any():
        raise ValueError("f_ext: row 0 is the world's, which no wrench moves; expected zeros")
    number, arrays = _common(values)
    zeros = {name: number.zeros(*shape) for name, shape in shapes.items() if name not in arrays}
    return State(model, number, **arrays, **zeros)


def _common(values: dict[str, Array]) -> tuple[Arithmetic, dict[str, Array]]:
    """Convert all arguments to the one kind of number that holds them all."""
    entries = (entry for x in values.values() if x.dtype == object for entry in x.flat)
    context = next((entry.context for entry in entries if hasattr(entry, "context")), None)
    if context is None:
        converted = as_number_arrays(**{name: (x, x.shape) for name, x in values.items()})
        for name, x in zip(values, converted, strict=True):
            if x.dtype != object:
                check_size(x, name)
        kind = Exact if converted[0].dtype == object else Arithmetic
        return kind(converted[0].dtype), dict(zip(values, converted, strict=True))
    number = Arithmetic(np.dtype(object), context)
    arrays = {}
    for name, x in values.items():
        try:
            arrays[name] = number.array(x)
        except (TypeError, ValueError):
            raise ValueError(f"{name}: expected numbers of mpmath or NumPy, got others as well") from None
        if not all(context.isfinite(entry) for entry in arrays[name].flat):
            raise ValueError(f"{name}: expected finite numbers")
    return number, arrays


def _as_array(value: Any, name: str) -> Array:
    try:
        return np.asanyarray(value)  # a mask stays, for `as_arrays` to reject
    except ValueError:
        raise ShapeError(f"{name}: expected a rectangular array, got rows of different lengths") from None


def _hint(model: Any, name: str, x: Array) -> str:
    """Return a hint at what was probably meant."""
    if x.ndim > (2 if name == "f_ext" else 1):
        return "; this package takes one state per call: loop over a batch"
    if name == "q" and x.shape == (model.nv,):
        return f"; this looks like nv; q has nq = {model.nq}"
    if name in ("v", "a", "tau") and x.shape == (model.nq,):
        return f"; this looks like nq; {name} has nv = {model.nv}"
    return ""
