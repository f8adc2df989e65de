"""Validation of the state that every algorithm takes.

The result is finite and stays so when multiplied, of one number type, of the right last axes,
broadcast to one batch shape, and its quaternions have norm 1: the recursions check nothing again.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array, as_array, as_arrays, as_constant, as_number_arrays, check_size, comparable, resolution
from ..arrays.conversion import ROUNDING_ATOL
from ..errors import ShapeError
from ..spatial._elementary import at_first_index

if TYPE_CHECKING:
    from .configuration import ConfigurationSpace
    from .model import Model

__all__ = ["check_arrays", "check_entries", "in_double", "joint_name_at", "with_number"]


def joint_name_at(model: Model, entry: int) -> str:
    """Return the name of the joint that an entry of v belongs to."""
    return next(name for name, s in zip(model.joint_names, model.v_slice) if s.start <= entry < s.stop)


def check_entries(
    model: ConfigurationSpace, any_number: bool = False, /, **named: ArrayLike | None
) -> tuple[Array, ...]:
    """Check a state and bring it to one dtype and one batch shape: see `Model.state`.

    With `any_number`, fractions, SymPy's numbers and the like pass, as arrays of objects: of these only shapes are
    checked, that each is a finite number, and no quaternion zero; any other length is divided out exactly.
    """
    arrays = list(check_arrays(model, any_number, **named))
    names = tuple(named)
    tails = [2 if name == "f_ext" else 1 for name in names]
    batches = [x.shape[: x.ndim - tail] for x, tail in zip(arrays, tails)]
    try:
        batch = np.broadcast_shapes(*batches)
    except ValueError:
        listed = ", ".join(f"{name} {shape}" for name, shape in zip(names, batches) if shape)
        raise ShapeError(f"batch axes do not broadcast: {listed}") from None
    for k, name in enumerate(names):
        if arrays[k].dtype == object:
            _refuse_zero(model, arrays[k], name)
            continue
        check_size(arrays[k], name)
        if name.startswith("q"):
            arrays[k] = _with_norm_1(model, arrays[k], name, given=np.asarray(named[name]).dtype)
    return tuple(np.broadcast_to(x, batch + x.shape[x.ndim - tail :]) for x, tail in zip(arrays, tails))


def with_number(
    model: ConfigurationSpace, checked: Mapping[str, Array], number: ArrayLike, name: str
) -> tuple[Array, ...]:
    """Return checked arguments with one more, which has batch axes alone, in one number type and one batch shape."""
    arrays = {**checked, name: as_array(number, name)}
    batches = {one: x.shape[: x.ndim - (one != name)] for one, x in arrays.items()}
    dtype = np.result_type(*arrays.values())
    try:
        batch = np.broadcast_shapes(*batches.values())
    except ValueError:
        listed = ", ".join(f"{one} {shape}" for one, shape in batches.items() if shape)
        raise ShapeError(f"batch axes do not broadcast: {listed}") from None
    for one, x in arrays.items():
        wider = resolution(x.dtype) > resolution(dtype)
        x = x.astype(dtype, copy=False)
        x = model.normalize(x) if wider and one.startswith("q") else x
        arrays[one] = np.broadcast_to(x, batch + x.shape[len(batches[one]) :])
    return tuple(arrays.values())


def in_double(model: ConfigurationSpace, q: Array) -> Array:
    """Return a copy of a checked q in double precision; reject complex numbers.

    Quaternions given in single precision are normalised to all the digits that they have now.
    """
    double = as_constant(q, "q")
    return double if q.dtype == double.dtype else model.normalize(double)


def check_arrays(
    model: ConfigurationSpace, any_number: bool = False, /, **named: ArrayLike | None
) -> tuple[Array, ...]:
    """Convert to finite arrays of one dtype with the right last axes, or raise.

    The name of an argument decides its shape: ``f_ext`` (..., nbodies, 6), names that begin with ``q``
    (..., nq), all others (..., nv).
    """
    expected: dict[str, tuple[Any, tuple[int, ...]]] = {}
    for name, value in named.items():
        if name == "f_ext":
            expected[name] = (_external(model, value), (model.nbodies, 6))
            continue
        _check_not_swapped(model, name, value)
        expected[name] = (value, (model.nq if name.startswith("q") else model.nv,))
    return (as_number_arrays if any_number else as_arrays)(**expected)


def _check_not_swapped(model: ConfigurationSpace, name: str, value: ArrayLike | None) -> None:
    """Raise with a hint where a v is given for a q, a q for a v, the joints without the base, or a column for a row."""
    (kind, size), (other, other_size) = ("q", model.nq), ("v", model.nv)
    if not name.startswith("q"):
        (kind, size), (other, other_size) = (other, other_size), (kind, size)
    shape = _shape(value)
    base = size - 7 if kind == "q" else size - 6
    if size != other_size and shape[-1:] == (other_size,):
        hint = f"this looks like n{other}: {kind} has n{kind} = {size}, {other} has n{other} = {other_size}"
    elif model.base == "floating" and shape[-1:] == (base,):
        hint = f"the {size - base} entries of the floating base come before those of the joints"
    elif len(shape) == 2 and shape[0] == size != shape[1]:
        hint = f"the axis of length {size} must be the last"
    else:
        return
    raise ShapeError(f"{name}: expected shape (..., {size}), got {shape}; {hint}")


def _external(model: ConfigurationSpace, f_ext: ArrayLike | None) -> ArrayLike:
    """Return the wrenches on the bodies, zero by default; reject a wrench on the world, or a missing row for it."""
    if f_ext is None:
        return np.zeros((model.nbodies, 6), int)  # integers do not affect the number type
    shape = _shape(f_ext)
    if shape[-2:] == (model.nbodies - 1, 6):
        raise ShapeError(f"f_ext: expected shape (..., {model.nbodies}, 6), got {shape}; row 0 is the world's, zero")
    world = np.asarray(f_ext)[..., 0, :] if shape[-2:] == (model.nbodies, 6) else np.zeros(6)
    if world.dtype == object:
        world = comparable(world)
        world = np.where(np.isnan(world), 1, world)  # a symbol without a value is not known to be zero
    if ((world != 0) & (world == world)).any():  # `as_arrays` raises for what is not a number
        raise ValueError("f_ext: row 0 is a wrench on the world, which nothing moves; expected zeros there")
    return f_ext


def _shape(value: Any) -> tuple[int, ...]:
    try:
        return np.shape(value)
    except ValueError:  # rows of different lengths: as_arrays raises for them
        return ()


def _refuse_zero(model: ConfigurationSpace, q: Array, name: str) -> None:
    """Raise for a quaternion or a (cos, sin) that is known to be zero, among numbers that are objects."""
    for joint, s in zip(model.joints, model.q_slice):
        if joint is None or joint.unit is None or not name.startswith("q"):
            continue
        part = slice(s.start + joint.unit.start, s.start + joint.unit.stop)
        bad = np.asarray((comparable(q[..., part]) == 0).all(-1))
        if bad.any():
            mend = "model.neutral() has the identity"
            what = f"{name}[{part.start}:{part.stop}]"
            raise ValueError(f"{name}: {what} is zero{at_first_index(bad)}, no direction; {mend}")


def _with_norm_1(model: ConfigurationSpace, q: Array, name: str, given: np.dtype[Any]) -> Array:
    """Raise for a quaternion or a (cos, sin) that is off norm 1 by more than half the digits it was given with.

    One given with fewer digits than it has now is normalised to all of these.
    """
    digits = resolution(given if given.kind in "fc" else np.float64)
    tolerance = max(np.sqrt(digits), ROUNDING_ATOL)
    for joint, joint_name, s in zip(model.joints, model.joint_names, model.q_slice):
        if joint is None or joint.unit is None:
            continue
        part = slice(s.start + joint.unit.start, s.start + joint.unit.stop)
        norm = np.hypot.reduce(q[..., part].real, axis=-1)
        bad = np.abs(norm - 1) > tolerance
        if bad.any():
            what = "(cos, sin)" if joint.unit.stop - joint.unit.start == 2 else "quaternion"
            first = float(norm[bad].flat[0])
            off = float((norm - 1)[bad].flat[0])
            close = f"which is 1 {off:+.2g}" if abs(off) < 1e-5 else "expected 1"
            mend = "normalize(q) repairs it" if first else "neutral() has the identity"
            raise ValueError(
                f"{name}: joint {joint_name!r}: the {what} {name}[{part.start}:{part.stop}] has norm {first:.6g}"
                f"{at_first_index(bad)}, {close}; model.{mend}"
            )
    return model.normalize(q) if digits > resolution(q.dtype) or tolerance == ROUNDING_ATOL else q
