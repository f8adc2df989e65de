"""The functions timed in `speed`: every quantity by Pinocchio, by the textbook and by `tw.fast`, in the same states."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import DTypeLike

import twistwrench as tw
from twistwrench.arrays import Array

__all__ = ["QUANTITIES", "States", "ours", "pinocchio", "random_states"]

Call = Callable[[], object]

QUANTITIES = {
    "rnea": "inverse dynamics",
    "h": "bias forces",
    "crba": "mass matrix",
    "A_G": "centroidal momentum matrix",
    "set": "M, h, J_c of the feet, A_G",
    "aba": "forward dynamics",
}


class States(NamedTuple):
    """A batch: q (n, nq), and v and a (n, nv), in our order."""

    q: Array
    v: Array
    a: Array

    def first(self, n: int, dtype: DTypeLike = float) -> States:
        """Return the first n, in a number type; if n is 1, without a batch axis."""
        parts = (x[:n].astype(dtype) for x in self)
        return States(*(x[0] for x in parts)) if n == 1 else States(*parts)


def random_states(model: tw.Model, n: int, *, seed: int = 0) -> States:
    """Draw 1000 states, and repeat them as often as needed."""
    rng = np.random.default_rng(seed)
    some = min(n, 1000)
    q = np.stack([model.random_configuration(rng=rng) for _ in range(some)])
    v, a = rng.standard_normal((2, some, model.nv))
    times = -(-n // some)
    return States(*(np.tile(x, (times, 1))[:n] for x in (q, v, a)))


def ours(package: ModuleType, model: tw.Model, quantity: str, s: States, **options: Any) -> Call:
    """Return a call of `tw` or `tw.fast`."""
    calls: dict[str, Call] = {
        "rnea": lambda: package.rnea(model, s.q, s.v, s.a, **options),
        "h": lambda: package.nonlinear_effects(model, s.q, s.v, **options),
        "crba": lambda: package.crba(model, s.q, **options),
        "A_G": lambda: package.centroidal_map(model, s.q, **options),
        "set": lambda: package.dynamics(model, s.q, s.v, **options),
        "aba": lambda: package.aba(model, s.q, s.v, s.a, **options),
    }
    return calls[quantity]


def pinocchio(model: tw.Model, quantity: str, s: States) -> Call:
    """Return a loop of Pinocchio over states with a batch axis, called from Python one by one; it returns nothing."""
    import pinocchio as pin

    there = tw.bridge.to_pinocchio_model(model)
    data, feet = there.createData(), [there.getFrameId(name) for name in model.feet]
    v, a = (tw.bridge.to_pinocchio_tangent(model, x) for x in (s.v, s.a))
    states = list(zip(s.q, v, a, strict=True))

    def whole(q: Array, v: Array) -> None:
        pin.crba(there, data, q)
        pin.nonLinearEffects(there, data, q, v)
        pin.computeCentroidalMap(there, data, q)
        pin.computeJointJacobians(there, data, q)
        pin.updateFramePlacements(there, data)
        for foot in feet:
            pin.getFrameJacobian(there, data, foot, pin.LOCAL_WORLD_ALIGNED)

    def loop(call: Callable[..., object]) -> Call:
        def run() -> None:
            for q, v, a in states:
                call(q, v, a)

        return run

    calls: dict[str, Callable[..., object]] = {
        "rnea": lambda q, v, a: pin.rnea(there, data, q, v, a),
        "h": lambda q, v, a: pin.nonLinearEffects(there, data, q, v),
        "crba": lambda q, v, a: pin.crba(there, data, q),
        "A_G": lambda q, v, a: pin.computeCentroidalMap(there, data, q),
        "set": lambda q, v, a: whole(q, v),
        "aba": lambda q, v, a: pin.aba(there, data, q, v, a),
    }
    return loop(calls[quantity])
