"""The quantities of a robot, and every way of computing each (49.6 to 49.10)."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw
from twistwrench import bridge
from twistwrench import newton_euler_3d as ne
from twistwrench.arrays import Array
from twistwrench.validate.oracle import Oracle

from .numbers import DIGITS, FLOATS, HARDWARE, PAIRS, sum_of_pair
from .record import Way

REFERENCE = "local_world_aligned"
"""Of J̇ v: there it is the acceleration of a point, which does not vanish where only one joint turns."""

SOLVED = "FD by M"
"""Forward dynamics again: M v̇ = τ − h solved."""


class Quantity(NamedTuple):
    """What a quantity is called, what it takes, and who computes it."""

    name: str
    takes: str  # of q, v, a and tau
    ours: str  # the function of `tw`, `tw.fast` and `tw.compile`
    truth: Callable[..., Array]  # of the model and the arguments
    theirs: str  # the function of Pinocchio
    back: Callable[[Oracle, Any], Any]  # from what that returns to the order of this package

    def arguments(self, **state: Array) -> list[Array]:
        """Return those arrays of a state that it takes."""
        return [state[name] for name in self.takes.split()]


_ROWS = (
    ("ID", "inverse dynamics τ", "q v a", "rnea", ne.inverse_dynamics, "rnea", Oracle.vector),
    ("h", "bias forces h", "q v", "nonlinear_effects", ne.nonlinear_effects, "nonLinearEffects", Oracle.vector),
    ("FD", "forward dynamics v̇", "q v tau", "aba", ne.forward_dynamics, "aba", Oracle.vector),
    (SOLVED, "forward dynamics v̇", "q v tau", "aba", ne.forward_dynamics, "crba + Cholesky", Oracle.vector),
    ("M", "mass matrix M", "q", "crba", ne.mass_matrix, "crba", Oracle.matrix),
    ("A_G", "centroidal map A_G", "q", "centroidal_map", ne.centroidal_map, "computeCentroidalMap", Oracle.jacobian),
    (
        *("dh_G", "rate of momentum ḣ_G", "q v a", "centroidal_momentum_rate", ne.centroidal_momentum_rate),
        *("computeCentroidalMomentumTimeVariation", lambda _, force: bridge.from_pinocchio_force(force)),
    ),
    (
        *("dJv", "bias acceleration J̇v", "q v", "frame_bias_acceleration", ne.frame_bias_acceleration),
        *("getFrameClassicalAcceleration", lambda _, motion: bridge.from_pinocchio_motion(motion)),
    ),
)
QUANTITIES = {key: Quantity(*row) for key, *row in _ROWS}


@dataclass(frozen=True)
class Robot:
    """A robot, here and in Pinocchio, where that is installed; and the frame whose J̇ v is computed."""

    model: tw.Model
    oracle: Oracle | None
    frame: str = ""

    def truth(self, key: str) -> Callable[..., Array]:
        """Return the way of 49.1: one state at a time, in any number type."""
        return partial(QUANTITIES[key].truth, self.model, **self._options(key))

    def ours(self, key: str, package: ModuleType = tw) -> Callable[..., Any]:
        """Return the function of `tw` or `tw.fast`."""
        return partial(getattr(package, QUANTITIES[key].ours), self.model, **self._options(key))

    def _options(self, key: str) -> dict[str, Any]:
        return {"frame": self.frame, "reference": REFERENCE} if key == "dJv" else {}

    def compiled(self, key: str, name: str, numbers: tuple[str, ...] = (*HARDWARE, PAIRS)) -> list[Way]:
        """Return the programs of a quantity, one in each number type."""
        options = {"frames": [self.frame], "reference": REFERENCE} if key == "dJv" else {}

        def first(x: Array) -> Array:
            return x[..., 0, :] if key == "dJv" else x  # of one frame

        def way(number: str) -> Way:
            program = tw.compile(self.model, name, dtype=number, **options)
            after = (lambda pair: first(sum_of_pair(pair))) if number == PAIRS else first
            return Way(key, f"tw.compile {name}", program, number, after=after)

        return [way(number) for number in numbers]

    def pinocchio(self, key: str, name: str = "", after: Callable[[Any], Array] | None = None) -> list[Way]:
        """Return Pinocchio's way in a list, or an empty one: that of a quantity, or one of its functions by name."""
        if self.oracle is None:
            return []
        oracle, zero = self.oracle, np.zeros(self.model.nv)
        pin, m, d = oracle.pin, oracle.model, oracle.data
        at = oracle.frame(self.frame) if key == "dJv" else 0

        def before(q: Array, *others: Array) -> tuple[Array, ...]:
            return q, *map(oracle.tangent, others)

        def solved(q: Array, v: Array, tau: Array) -> Any:
            pin.crba(m, d, q)
            pin.cholesky.decompose(m, d)
            return pin.cholesky.solve(m, d, tau - pin.nonLinearEffects(m, d, q, v))

        def bias(q: Array, v: Array) -> Any:
            pin.forwardKinematics(m, d, q, v, zero)
            return pin.getFrameClassicalAcceleration(m, d, at, pin.LOCAL_WORLD_ALIGNED)

        name = name or QUANTITIES[key].theirs
        call = {"dJv": bias, SOLVED: solved}.get(key) or partial(getattr(pin, name), m, d)
        after = after or partial(QUANTITIES[key].back, oracle)
        return [Way(key.partition(" ")[0], f"pin.{name}", call, batches=False, before=before, after=after)]

    def ways(self, key: str) -> list[Way]:
        """Return every way of computing a quantity."""
        name = QUANTITIES[key].ours
        fast = in_each(FLOATS, key, f"tw.fast.{name}", self.ours(key, tw.fast)) if hasattr(tw.fast, name) else []
        return [
            *fast,
            *self.compiled(key, name),
            *in_each(FLOATS, key, f"tw.{name}", self.ours(key)),
            *in_each((*FLOATS, *DIGITS), key, "newton_euler_3d", self.truth(key), batches=False),
            *self.pinocchio(key),
            *(self._solved() if key == "FD" else []),
        ]

    def _solved(self) -> list[Way]:
        """Return the ways of forward dynamics that solve M v̇ = τ − h."""

        def slow(q: Array, v: Array) -> tuple[Any, Any]:
            return tw.crba(self.model, q), tw.nonlinear_effects(self.model, q, v)

        def fast(q: Array, v: Array) -> tuple[Any, Any]:
            d = tw.fast.dynamics(self.model, q, v, want=("M", "h"))
            return d.M, d.h

        def solved(solve: Callable[[Any, Any], Any], M_h: Callable[..., Any], q: Array, v: Array, tau: Array) -> Any:
            M, h = M_h(q, v)
            return solve(M, tau - h)

        ways = [
            *in_each(HARDWARE, "FD", "tw.fast M, h + Cholesky", partial(solved, _solve, fast)),
            *in_each(HARDWARE, "FD", "tw.crba + Cholesky", partial(solved, _solve, slow)),
            *self.pinocchio(SOLVED),
        ]
        try:
            from scipy.linalg import cho_factor, cho_solve
        except ImportError:
            return ways
        scipys = partial(solved, lambda M, b: cho_solve(cho_factor(M), b), fast)
        return [*ways, *in_each(HARDWARE, "FD", "tw.fast M, h + scipy's Cholesky", scipys, batches=False)]


def _solve(M: Array, b: Array) -> Array:
    """Solve M x = b by NumPy: its Cholesky factor is triangular, but its solver does not use that."""
    L = np.linalg.cholesky(M)
    x: Array = np.linalg.solve(L.mT, np.linalg.solve(L, b[..., None]))[..., 0]
    return x


def in_each(numbers: tuple[str, ...], key: str, name: str, compute: Callable[..., Any], **how: Any) -> list[Way]:
    """Return a way in each of the number types."""
    return [Way(key, name, compute, number, **how) for number in numbers]


def pinocchio(model: tw.Model) -> Oracle | None:
    """Return Pinocchio's model of a robot; None where it is not installed."""
    try:
        return Oracle(model, None)
    except ImportError:
        return None
