"""The quantities of a robot, and every way of computing each (49.6 to 49.10)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench import bridge
from twistwrench import newton_euler_3d as ne
from twistwrench.algorithms.kinematics import Reference
from twistwrench.arrays import Array
from twistwrench.model import Model
from twistwrench.validate.oracle import Oracle

from .numbers import DIGITS, FLOATS, HARDWARE, PAIRS, sum_of_pair
from .quantity import Way

__all__ = ["REFERENCE", "WAYS", "Robot", "Truth", "Ways"]

REFERENCE: Reference = "local_world_aligned"
"""Of J̇ v: there it is the acceleration of a point, which does not vanish where only one joint turns."""

Truth = Callable[..., Array]


@dataclass(frozen=True)
class Robot:
    """A robot, here and in Pinocchio.

    Attributes
    ----------
    model : Model
    oracle : Oracle or None
        Pinocchio, if it is there.
    frame : str
        The frame whose J̇ v is computed.
    """

    model: Model
    oracle: Oracle | None
    frame: str

    def slow(self, truth: Truth) -> Way:
        """Return the way of 49.1: one state at a time, in any number type."""
        return Way("newton_euler_3d", truth, (*FLOATS, *DIGITS), batches=False)

    def compiled(
        self,
        name: str,
        after: Callable[[Array], Array] = lambda value: value,
        numbers: tuple[str, ...] = (*HARDWARE, PAIRS),
        **options: Any,
    ) -> list[Way]:
        """Return the programs of a quantity, one in each number type."""

        def way(number: str) -> Way:
            program = tw.compile(self.model, name, dtype=number, **options)
            read = (lambda pair: after(sum_of_pair(pair))) if number == PAIRS else after
            return Way(f"tw.compile {name}", program, (number,), after=read)

        return [way(number) for number in numbers]

    def pinocchio(self, name: str, compute: Callable[..., Any], after: Callable[[Oracle, Any], Array]) -> list[Way]:
        """Return a way of Pinocchio's in a list, or an empty one. Reordering is not timed.

        `compute` takes Pinocchio itself, its model and data, and the arguments.
        """
        oracle = self.oracle
        if oracle is None:
            return []

        def before(q: Array, *others: Array) -> tuple[Any, ...]:
            return q, *map(oracle.tangent, others)

        call = partial(compute, oracle.pin, oracle.model, oracle.data)
        return [Way(name, call, ("float64",), batches=False, before=before, after=partial(after, oracle))]


def inverse_dynamics(robot: Robot) -> tuple[Truth, list[Way]]:
    """Return the truth of τ, and the ways."""
    truth = partial(ne.inverse_dynamics, robot.model)
    return truth, [
        Way("tw.fast.rnea", partial(tw.fast.rnea, robot.model)),
        *robot.compiled("rnea"),
        Way("tw.rnea", partial(tw.rnea, robot.model)),
        robot.slow(truth),
        *robot.pinocchio("pin.rnea", lambda pin, m, d, q, v, a: pin.rnea(m, d, q, v, a), Oracle.vector),
    ]


def forward_dynamics(robot: Robot) -> tuple[Truth, list[Way]]:
    """Return the truth of v̇, and the ways: from the tips to the base and back, or M v̇ = τ − h solved."""
    model, truth = robot.model, partial(ne.forward_dynamics, robot.model)

    def solved(q: Array, v: Array, tau: Array) -> Array:
        return _solve(tw.crba(model, q), tau - tw.nonlinear_effects(model, q, v))

    def solved_fast(q: Array, v: Array, tau: Array) -> Array:
        M, h = _fast_M_h(model, q, v)
        return _solve(M, tau - h)

    def solved_pinocchio(pin: Any, m: Any, d: Any, q: Array, v: Array, tau: Array) -> Any:
        pin.crba(m, d, q)
        pin.cholesky.decompose(m, d)
        return pin.cholesky.solve(m, d, tau - pin.nonLinearEffects(m, d, q, v))

    return truth, [
        Way("tw.fast.aba", partial(tw.fast.aba, model)),
        *robot.compiled("aba"),
        Way("tw.aba", partial(tw.aba, model)),
        robot.slow(truth),
        *robot.pinocchio("pin.aba", lambda pin, m, d, q, v, tau: pin.aba(m, d, q, v, tau), Oracle.vector),
        Way("tw.fast M, h + Cholesky", solved_fast, HARDWARE),
        Way("tw.crba + Cholesky", solved, HARDWARE),
        *_solved_by_scipy(model),
        *robot.pinocchio("pin.crba + Cholesky", solved_pinocchio, Oracle.vector),
    ]


def _fast_M_h(model: Model, q: Array, v: Array) -> tuple[Any, Any]:
    d = tw.fast.dynamics(model, q, v, want=("M", "h"))
    return d.M, d.h


def _solve(M: Array, b: Array) -> Array:
    """Solve M x = b by NumPy: its Cholesky factor is triangular, but its solver does not use that."""
    L = np.linalg.cholesky(M)
    x: Array = np.linalg.solve(L.mT, np.linalg.solve(L, b[..., None]))[..., 0]
    return x


def _solved_by_scipy(model: Model) -> list[Way]:
    """Return the way with SciPy's Cholesky solver, which uses that; empty without SciPy."""
    try:
        from scipy.linalg import cho_factor, cho_solve
    except ImportError:
        return []

    def solved(q: Array, v: Array, tau: Array) -> Any:
        M, h = _fast_M_h(model, q, v)
        return cho_solve(cho_factor(M), tau - h)

    return [Way("tw.fast M, h + scipy's Cholesky", solved, HARDWARE, batches=False)]


def mass_matrix(robot: Robot) -> tuple[Truth, list[Way]]:
    """Return the truth of M, and the ways."""
    truth = partial(ne.mass_matrix, robot.model)
    return truth, [
        Way("tw.fast.crba", partial(tw.fast.crba, robot.model)),
        *robot.compiled("crba"),
        Way("tw.crba", partial(tw.crba, robot.model)),
        robot.slow(truth),
        *robot.pinocchio("pin.crba", lambda pin, m, d, q: pin.crba(m, d, q), Oracle.matrix),
    ]


def centroidal_map(robot: Robot) -> tuple[Truth, list[Way]]:
    """Return the truth of A_G, and the ways."""
    truth = partial(ne.centroidal_map, robot.model)

    def pinocchio(pin: Any, m: Any, d: Any, q: Array) -> Any:
        return pin.computeCentroidalMap(m, d, q)

    return truth, [
        Way("tw.fast.centroidal_map", partial(tw.fast.centroidal_map, robot.model)),
        *robot.compiled("centroidal_map"),
        Way("tw.centroidal_map", partial(tw.centroidal_map, robot.model)),
        robot.slow(truth),
        *robot.pinocchio("pin.computeCentroidalMap", pinocchio, Oracle.jacobian),
    ]


def momentum_rate(robot: Robot) -> tuple[Truth, list[Way]]:
    """Return the truth of ḣ_G, and the ways."""
    truth = partial(ne.centroidal_momentum_rate, robot.model)

    def pinocchio(pin: Any, m: Any, d: Any, q: Array, v: Array, a: Array) -> Any:
        return pin.computeCentroidalMomentumTimeVariation(m, d, q, v, a)

    return truth, [
        *robot.compiled("centroidal_momentum_rate"),
        Way("tw.centroidal_momentum_rate", partial(tw.centroidal_momentum_rate, robot.model)),
        robot.slow(truth),
        *robot.pinocchio(
            "pin.computeCentroidalMomentumTimeVariation", pinocchio, lambda _, F: bridge.from_pinocchio_force(F)
        ),
    ]


def bias_acceleration(robot: Robot) -> tuple[Truth, list[Way]]:
    """Return the truth of J̇ v, and the ways."""
    model, frame = robot.model, robot.frame
    at, zero = robot.oracle.frame(frame) if robot.oracle else 0, np.zeros(model.nv)

    def truth(q: Array, v: Array) -> Array:
        return ne.frame_bias_acceleration(model, q, v, frame, REFERENCE)

    def textbook(q: Array, v: Array) -> Array:
        return tw.frame_bias_acceleration(model, q, v, frame, REFERENCE)

    def pinocchio(pin: Any, m: Any, d: Any, q: Array, v: Array) -> Any:
        pin.forwardKinematics(m, d, q, v, zero)
        return pin.getFrameClassicalAcceleration(m, d, at, pin.LOCAL_WORLD_ALIGNED)

    return truth, [
        *robot.compiled("frame_bias_acceleration", lambda x: x[..., 0, :], frames=[frame], reference=REFERENCE),
        Way("tw.frame_bias_acceleration", textbook),
        robot.slow(truth),
        *robot.pinocchio("pin.getFrameClassicalAcceleration", pinocchio, lambda _, V: bridge.from_pinocchio_motion(V)),
    ]


Ways = Callable[[Robot], tuple[Truth, list[Way]]]

WAYS: dict[str, tuple[str, tuple[str, ...], Ways]] = {
    "ID": ("inverse dynamics τ", ("q", "v", "a"), inverse_dynamics),
    "FD": ("forward dynamics v̇", ("q", "v", "tau"), forward_dynamics),
    "M": ("mass matrix M", ("q",), mass_matrix),
    "A_G": ("centroidal map A_G", ("q",), centroidal_map),
    "dh_G": ("rate of momentum ḣ_G", ("q", "v", "a"), momentum_rate),
    "dJv": ("bias acceleration J̇v", ("q", "v"), bias_acceleration),
}
"""By its key: the name of a quantity, its arguments, and the function that returns its truth and its ways."""
