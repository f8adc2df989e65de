"""The implementations of a cell: the textbook, `tw.fast`, the textbook in single precision, Pinocchio."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench import bridge
from twistwrench.arrays import Array, resolution
from twistwrench.errors import SingularError
from twistwrench.model import Model

from .robots import State

__all__ = ["ALGORITHMS", "CANDIDATES", "Candidate", "candidates"]

CANDIDATES = ("textbook", "fast", "float32", "pinocchio")

ALGORITHMS = {
    "rnea": "tau",
    "crba": "M",
    "aba, steered": "steered",
    "aba, pushed": "pushed",
    "crba + solve, steered": "steered",
    "crba + solve, pushed": "pushed",
    "centroidal map": "A_G",
    "J̇v": "bias",
}
"""The quantities, and the right value that each is compared with (`truth.Truth`)."""

LONGEST = 350
"""With more joints Pinocchio is left out: its Data allocates 48 nv³ bytes, 50 GB at 1000 of them."""

Torques = dict[str, Array]


class Candidate(NamedTuple):
    """One way to one quantity."""

    algorithm: str
    who: str
    answer: Callable[[], Array]


def candidates(model: Model, s: State, torques: Torques, *, pinocchio: bool) -> Iterator[Candidate]:
    """Yield every way to every quantity."""
    single = State(*(x.astype(np.float32) for x in s))
    yield from _ours("textbook", tw, model, s, torques)
    yield from _ours("fast", tw.fast, model, s, torques)
    yield from _ours("float32", tw, model, single, {name: tau.astype(np.float32) for name, tau in torques.items()})
    if pinocchio and model.nv <= LONGEST:
        yield from _pinocchios(model, s, torques)


def _ours(who: str, by: Any, model: Model, s: State, torques: Torques) -> Iterator[Candidate]:
    yield Candidate("rnea", who, lambda: by.rnea(model, *s))
    yield Candidate("crba", who, lambda: by.crba(model, s.q))
    for name, tau in torques.items():
        yield Candidate(f"aba, {name}", who, partial(by.aba, model, s.q, s.v, tau))
        yield Candidate(f"crba + solve, {name}", who, partial(_solved, by, model, s, tau))
    yield Candidate("centroidal map", who, lambda: by.centroidal_map(model, s.q))
    if by is tw:
        tip = model.frame_names[-1]
        yield Candidate("J̇v", who, lambda: tw.frame_bias_acceleration(model, s.q, s.v, tip, "local_world_aligned"))


def _solved(by: Any, model: Model, s: State, tau: Array) -> Array:
    return solve(by.crba(model, s.q), tau - by.nonlinear_effects(model, s.q, s.v))


def solve(M: Array, b: Array) -> Array:
    """Return M⁻¹ b, the units of the rows divided out, by elimination from the tips to the base: M = Lᵀ D L.

    Raises
    ------
    SingularError
        If rounding has left M not positive definite.
    """
    own, n = np.diagonal(M), len(b)
    if (own <= 0).any():
        raise SingularError("M: a joint moves nothing that has inertia")
    unit = np.sqrt(own)
    left, x, ratio = M / unit[:, None] / unit, b / unit, np.zeros_like(M)
    for k in reversed(range(n)):  # the pivot is the apparent inertia at joint k
        if left[k, k] <= n * resolution(M.dtype):
            raise SingularError("M: not positive definite, to rounding")
        ratio[k, :k] = left[k, :k] / left[k, k]
        left[:k, :k] -= np.outer(left[k, :k], ratio[k, :k])
        x[:k] -= ratio[k, :k] * x[k]
    for k in range(n):
        x[k] = x[k] / left[k, k] - ratio[k, :k] @ x[:k]
    return np.asarray(x / unit)


def _pinocchios(model: Model, s: State, torques: Torques) -> Iterator[Candidate]:
    pin, there = bridge.import_pinocchio(), bridge.to_pinocchio_model(model)
    data, tip = there.createData(), there.getFrameId(model.frame_names[-1])
    q, v, a = s.q, *(bridge.to_pinocchio_tangent(model, x) for x in (s.v, s.a))

    def vector(x: Array) -> Array:
        return bridge.from_pinocchio_tangent(model, x) if np.isfinite(x).all() else np.full_like(x, np.nan)

    def pushed(tau: Array) -> Array:
        return vector(pin.aba(there, data, q, v, bridge.to_pinocchio_tangent(model, tau)))

    def solved(tau: Array) -> Array:
        pin.crba(there, data, q)
        pin.cholesky.decompose(there, data)
        return vector(
            pin.cholesky.solve(
                there, data, bridge.to_pinocchio_tangent(model, tau) - pin.nonLinearEffects(there, data, q, v)
            )
        )

    def bias() -> Array:
        pin.forwardKinematics(there, data, q, v, 0 * v)
        pin.updateFramePlacements(there, data)
        aligned = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        motion = pin.getFrameClassicalAcceleration(there, data, tip, aligned)
        return bridge.from_pinocchio_motion(motion)

    def momentum() -> Array:
        return bridge.from_pinocchio_jacobian(model, pin.computeCentroidalMap(there, data, q).reshape(6, -1))

    yield Candidate("rnea", "pinocchio", lambda: vector(pin.rnea(there, data, q, v, a)))
    yield Candidate("crba", "pinocchio", lambda: bridge.from_pinocchio_matrix(model, pin.crba(there, data, q)))
    for name, tau in torques.items():
        yield Candidate(f"aba, {name}", "pinocchio", partial(pushed, tau))
        yield Candidate(f"crba + solve, {name}", "pinocchio", partial(solved, tau))
    yield Candidate("centroidal map", "pinocchio", momentum)
    yield Candidate("J̇v", "pinocchio", bias)
