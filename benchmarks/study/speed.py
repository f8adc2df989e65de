"""``python -m benchmarks.study speed``: the textbook and `tw.fast` against Pinocchio called state by state from Python.

The long form, over batches and lengths and against other packages, is in benchmarks/.
"""

from collections.abc import Callable, Sequence
from importlib.util import find_spec
from types import ModuleType
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import DTypeLike

import twistwrench as tw
from twistwrench.arrays import Array
from twistwrench.validate.oracle import Oracle

from .quantities import QUANTITIES as OF_ROBOTS
from .quantities import Robot, pinocchio
from .record import BUSY, Record, table, time_in_turns

Call = Callable[[], object]

QUANTITIES = {
    "rnea": "inverse dynamics",
    "h": "bias forces",
    "crba": "mass matrix",
    "A_G": "centroidal momentum matrix",
    "set": "M, h, J_c of the feet, A_G",
    "aba": "forward dynamics",
}
KEYS = {"rnea": "ID", "h": "h", "crba": "M", "A_G": "A_G", "aba": "FD"}

BATCH = 1000
REFERENCE = 300  # states in a loop of Pinocchio


class States(NamedTuple):
    """A batch: q (n, nq), and v and a (n, nv), in our order."""

    q: Array
    v: Array
    a: Array

    def first(self, n: int, dtype: DTypeLike = float) -> Self:
        """Return the first n, in a number type; if n is 1, without a batch axis."""
        parts = (x[:n].astype(dtype) for x in self)
        return type(self)(*(x[0] for x in parts)) if n == 1 else type(self)(*parts)


def random_states(model: tw.Model, n: int, *, seed: int = 0) -> States:
    """Draw 1000 states, and repeat them as often as needed."""
    rng = np.random.default_rng(seed)
    some = min(n, 1000)
    q = np.stack([model.random_configuration(rng=rng) for _ in range(some)])
    v, a = rng.standard_normal((2, some, model.nv))
    return States(*(np.resize(x, (n, x.shape[-1])) for x in (q, v, a)))


def ours(package: ModuleType, model: tw.Model, quantity: str, s: States) -> Call:
    """Return a call of `tw` or `tw.fast`."""
    if quantity == "set":
        return lambda: package.dynamics(model, s.q, s.v)
    call = Robot(model, None).ours(KEYS[quantity], package)
    args = OF_ROBOTS[KEYS[quantity]].arguments(**s._asdict(), tau=s.a)
    return lambda: call(*args)


def theirs(model: tw.Model, quantity: str, s: States) -> Call:
    """Return a loop of Pinocchio over states with a batch axis, called from Python one by one; it returns nothing."""
    oracle = pinocchio(model)
    if oracle is None:
        raise ImportError("Pinocchio is not installed (pip install pin): there is nothing to compare with")
    if quantity == "set":
        arguments, call = [s.q, s.v], _whole(model, oracle)
    else:
        (way,) = Robot(model, oracle).pinocchio(KEYS[quantity])
        arguments, call = OF_ROBOTS[KEYS[quantity]].arguments(**s._asdict(), tau=s.a), way.compute
    states = list(zip(arguments[0], *map(oracle.tangent, arguments[1:]), strict=True))

    def run() -> None:
        for state in states:
            call(*state)

    return run


def _whole(model: tw.Model, oracle: Oracle) -> Callable[[Array, Array], None]:
    """Return Pinocchio's M, h, J_c of the feet and A_G of one state."""
    pin, m, d = oracle.pin, oracle.model, oracle.data
    feet = [m.getFrameId(name) for name in model.feet]

    def call(q: Array, v: Array) -> None:
        pin.crba(m, d, q)
        pin.nonLinearEffects(m, d, q, v)
        pin.computeCentroidalMap(m, d, q)
        pin.computeJointJacobians(m, d, q)
        pin.updateFramePlacements(m, d)
        for foot in feet:
            pin.getFrameJacobian(m, d, foot, pin.LOCAL_WORLD_ALIGNED)

    return call


def speed(
    model: tw.Model, *, rounds: int = 9, states: int = BATCH, after_round: Callable[[], object] = lambda: None
) -> list[Record]:
    """Time every quantity, all ways of one in turns.

    >>> import twistwrench as tw
    >>> found = speed(tw.load("pendulum"), rounds=1, states=10)
    >>> sorted({(r.way, r.number, r.states) for r in found if r.way != "Pinocchio"})
    [('fast', 'float32', 10), ('fast', 'float64', 1), ('fast', 'float64', 10), ('textbook', 'float64', 1)]
    """
    s = random_states(model, max(states, REFERENCE))
    found = []
    for quantity in QUANTITIES:
        started: list[tuple[Record, Call]] = []
        if find_spec("pinocchio"):
            reference = theirs(model, quantity, s.first(REFERENCE))
            started.append((Record(quantity, "Pinocchio", states=REFERENCE), reference))
        for way, package, number, n in (
            ("textbook", tw, "float64", 1),
            ("fast", tw.fast, "float64", 1),
            ("fast", tw.fast, "float64", states),
            ("fast", tw.fast, "float32", states),
        ):
            call = ours(package, model, quantity, s.first(n, number))
            started.append((Record(quantity, way, number, states=n), call))
        found += time_in_turns(started, rounds=rounds, after_round=after_round)
    return found


def shown(model: tw.Model, found: Sequence[Record]) -> str:
    """Return the records as a table, a column for each way."""
    pinocchios = {r.quantity: r.seconds for r in found if r.way == "Pinocchio"}
    rows: dict[str, dict[str, str]] = {quantity: {"": meaning} for quantity, meaning in QUANTITIES.items()}
    for r in found:
        theirs = pinocchios.get(r.quantity) if r.way != "Pinocchio" else None
        many = r.states > 1 and r.way == "fast"
        column = f"{r.states} {r.number.replace('float64', 'states')}" if many else r.way
        ratio = f" ({_short(r.seconds / theirs)})" if theirs else ""
        rows[r.quantity][column] = "~" * (not r.quiet) + _short(1e6 * r.seconds) + ratio
    against = "in brackets: how often that of Pinocchio, called from Python for one state at a time"
    return "\n".join(
        [
            f"{model.name}, nv = {model.nv}: microseconds for one state, median of rounds in turns",
            against if pinocchios else "Pinocchio is not installed (pip install pin): there is nothing to compare with",
            "",
            table([row for row in rows.values() if len(row) > 1], {k: k for row in rows.values() for k in row}),
            *([] if all(r.quiet for r in found) else ["", BUSY]),
        ]
    )


def _short(x: float) -> str:
    return f"{x:.3g}" if x < 1000 else f"{x:.0f}"
