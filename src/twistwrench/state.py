"""The check at the door of every algorithm.

What comes out is finite, of one number type, of the right last axes, broadcast to one batch shape,
and its quaternions have norm 1: behind this door nothing is checked again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .checks import Array, as_arrays, resolution
from .errors import ShapeError

if TYPE_CHECKING:
    from .model import Model

__all__ = ["check_arrays", "check_state"]


def check_state(model: Model, **named: ArrayLike) -> tuple[Array, ...]:
    """Check a state and bring it to one dtype and one batch shape: see `Model.state`."""
    arrays, names = check_arrays(model, **named), tuple(named)
    tails = [2 if name == "f_ext" else 1 for name in names]
    batches = [x.shape[: x.ndim - tail] for x, tail in zip(arrays, tails)]
    try:
        batch = np.broadcast_shapes(*batches)
    except ValueError:
        listed = ", ".join(f"{name} {shape}" for name, shape in zip(names, batches))
        raise ShapeError(f"batch axes do not broadcast: {listed}") from None
    for name, x in zip(names, arrays):
        if name.startswith("q"):
            _check_unit(model, x, name)
    return tuple(np.broadcast_to(x, batch + x.shape[x.ndim - tail :]) for x, tail in zip(arrays, tails))


def check_arrays(model: Model, **named: ArrayLike) -> tuple[Array, ...]:
    """Convert to finite arrays of one dtype with the right last axes, or say what is wrong.

    The name of an argument says what it is: ``f_ext`` (..., nbodies, 6), names that begin with ``q``
    (..., nq), all others (..., nv).
    """
    expected: dict[str, tuple[ArrayLike, tuple[int, ...]]] = {}
    for name, value in named.items():
        if name == "f_ext":
            expected[name] = (value, (model.nbodies, 6))
            continue
        _check_not_swapped(model, name, value)
        expected[name] = (value, (model.nq if name.startswith("q") else model.nv,))
    return as_arrays(**expected)


def _check_not_swapped(model: Model, name: str, value: ArrayLike) -> None:
    """Say so where a v came for a q, or a q for a v."""
    (kind, size), (other, came) = ("q", model.nq), ("v", model.nv)
    if not name.startswith("q"):
        (kind, size), (other, came) = (other, came), (kind, size)
    try:
        shape = np.shape(value)
    except ValueError:  # rows of different lengths: as_arrays says so
        return
    if size != came and shape[-1:] == (came,):
        raise ShapeError(
            f"{name}: expected shape (..., {size}), got {shape}; this looks like n{other}: "
            f"{kind} has n{kind} = {size}, {other} has n{other} = {came}"
        )


def _check_unit(model: Model, q: Array, name: str) -> None:
    """Refuse a quaternion or a (cos, sin) that is off norm 1 by more than half the digits."""
    for joint, joint_name, s in zip(model.joints, model.joint_names, model.q_slice):
        if joint is None or joint.unit is None:
            continue
        part = slice(s.start + joint.unit.start, s.start + joint.unit.stop)
        norm = np.hypot.reduce(q[..., part].real, axis=-1)
        bad = np.abs(norm - 1) > np.sqrt(resolution(q.dtype))
        if bad.any():
            what = "(cos, sin)" if joint.unit.stop - joint.unit.start == 2 else "quaternion"
            raise ValueError(
                f"{name}: joint {joint_name!r}: the {what} {name}[{part.start}:{part.stop}] has norm "
                f"{float(norm[bad].flat[0]):.6g}, expected 1; model.normalize(q) repairs it"
            )
